#pragma once

#include <any>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace gnomon
{

/// What a stage's value is made from: named parts. The same key means the same value, so a stage
/// whose key is that of its last value reuses it.
class ValueKey
{
public:
  /// Adds a part. Parts are the same if they are of the same type and equal by ==.
  /// @param name as the report says it: "the camera"
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

  /// The names of the parts that are not as in another key.
  std::set<std::string> changedParts(const ValueKey& other) const;
  /// The same as text: "the camera, the props"; empty if none.
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
