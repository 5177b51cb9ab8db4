#pragma once

#include <any>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace gnomon
{

/// The named inputs of a stage's value. The same key means the same value, so a stage reuses its
/// last value while its key is equal.
class ValueKey
{
public:
  /// Add a part. Parts are the same if they are of the same type and equal by ==.
  /// @param name for the report: "the camera"
  template <typename Part>
  void add(const char* name, Part part)
  {
    this->parts_[name] = { std::move(part),
      [](const std::any& a, const std::any& b)
      {
        const auto* of = std::any_cast<Part>(&b);
        return of && *of == *std::any_cast<Part>(&a);
      } };
  }

  /// Return the names of the parts that differ from another key.
  std::set<std::string> changedParts(const ValueKey& other) const;
  /// Return the same as text: "the camera, the props"; empty if none.
  std::string changesFrom(const ValueKey& other) const;

private:
  struct AnyPart
  {
    std::any value;
    bool (*areEqual)(const std::any& ofThis, const std::any& ofOther);
  };
  std::map<std::string, AnyPart> parts_; ///< by name
};

} // namespace gnomon
