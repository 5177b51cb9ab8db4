#pragma once

#include <string>

namespace gnomon
{

/// Decides when to bake a map that a technique can do without (TechniqueInfo::mapIsOptional). The
/// picture is the same with and without the map, so the decision changes times only.
///
/// A map is baked once `patience()` frames in a row were traced in which the light and the casters
/// rested. The patience starts at `leastPatience`. It doubles, up to `mostPatience`, each time that
/// a map goes stale before it has served as many frames as the patience. It halves, down to
/// `leastPatience`, each time that a map has served as many.
///
/// So n frames bake at most n / (2 leastPatience) + 1/2 maps: a map that fails at the least
/// patience costs leastPatience + 2 frames at least, and the one after it twice as many.
class BakeBackoff
{
public:
  /// Maps pay for themselves after 7 to 30 frames (docs/techniques/exact.md): between these.
  static constexpr int leastPatience = 16;
  static constexpr int mostPatience = 1024;

  /// Decides about the next frame. Call once a frame whose visibility is to be computed.
  /// @param rested true if the map would be baked from the same light and casters as a frame ago
  /// @param baked true if there is a map that can be reused
  /// @return true if the frame uses the map: the caller bakes it if there is none
  bool usesMap(bool rested, bool baked);

  /// Why the last frame was traced, as a sentence without a full stop; empty if it used the map.
  std::string reason() const;

  int patience() const { return this->patience_; }

private:
  int patience_ = leastPatience; ///< in frames
  int rested_ = 0;               ///< frames traced in a row in which nothing changed
  int served_ = 0;               ///< frames that used the map; 0 if there is none
};

} // namespace gnomon
