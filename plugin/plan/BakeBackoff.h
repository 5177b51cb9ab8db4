#pragma once

#include <string>

namespace gnomon
{

/// Decides when to bake a map that a technique can do without (TechniqueInfo::mapIsOptional). The
/// picture is the same with and without the map, so the decision changes times only.
///
/// A map is baked once `patience()` frames in a row were traced while the light and the casters
/// rested, in the next frame that may bake. The patience starts at `leastPatience`. It doubles, up
/// to `mostPatience`, when a map goes stale after fewer frames than the patience. It halves, down
/// to `leastPatience`, when a map has lasted at least as many.
///
/// So n frames bake at most n / (2 leastPatience) + 1/2 maps: a map that fails at the least
/// patience costs leastPatience + 2 frames at least, and the one after it twice as many.
class BakeBackoff
{
public:
  /// Bounds of the patience, in frames. When maps pay: docs/techniques/exact.md.
  static constexpr int leastPatience = 16;
  static constexpr int mostPatience = 1024;

  /// Decide about the next frame. Call once per frame that computes visibility.
  /// @param rested true if the map would be baked from the same light and casters as in the last
  /// frame
  /// @param baked true if there is a map that can be reused
  /// @param mayBake false: the bake waits for a later frame
  /// @return true if the frame uses the map: the caller bakes it if there is none
  bool usesMap(bool rested, bool baked, bool mayBake);

  /// Return why the last frame was traced, as a clause; empty if it used the map.
  std::string reason() const;

  int patience() const { return this->patience_; }

private:
  int patience_ = leastPatience; ///< in frames
  int rested_ = 0;               ///< frames traced in a row without a change
  int served_ = 0;               ///< frames that used the map; 0 if there is none
};

} // namespace gnomon
