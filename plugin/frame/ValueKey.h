#ifndef gnomon_plugin_frame_ValueKey_h
#define gnomon_plugin_frame_ValueKey_h

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// What a stage's value is made from: named parts, each with a hash. The same key means the same
/// value, so a stage whose key is that of its last value reuses it.
class ValueKey
{
public:
  /// Adds a part.
  /// @param name as the report says it: "the camera"
  void add(const char* name, std::size_t hash) { this->parts_.push_back({ name, hash }); }

  /// Adds all parts of another key.
  void add(const ValueKey& other)
  {
    this->parts_.insert(this->parts_.end(), other.parts_.begin(), other.parts_.end());
  }

  /// One number for all parts.
  std::size_t hash() const;

  /// The names of the parts that differ from another key's, "the camera, the props"; empty if none.
  std::string changesFrom(const ValueKey& other) const;

  bool operator==(const ValueKey& other) const { return this->parts_ == other.parts_; }
  bool operator!=(const ValueKey& other) const { return !(*this == other); }

private:
  struct Part
  {
    std::string name;
    std::size_t hash;

    bool operator==(const Part& other) const
    {
      return this->name == other.name && this->hash == other.hash;
    }
  };
  std::vector<Part> parts_;
};

} // namespace gnomon

#endif
