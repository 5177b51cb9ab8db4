#pragma once

#include "plugin/frame/CostModel.h"
#include "plugin/frame/Frame.h"
#include "plugin/frame/Slowness.h"
#include "plugin/frame/VisibilityStage.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/probing/Probes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon
{

/// Chooses for lights that leave their technique to the pass (`auto`), between the lights and the
/// route: exact ones while the picture rests, and while it moves what FrameWishes asks for.
///
/// While it moves, area lights take as few samples as the error allows. Lights with hard shadows
/// take maps if all of them can, and if rays would take more than 1.3 times as long (CostModel.h).
/// A map is compared with rays at some pixels (Probes.h) before it is shown, and again from time to
/// time. It grows until its error is kept. If no map keeps it, all lights take rays, and maps are
/// tried again after 30 frames at the earliest.
class TechniqueChoice
{
public:
  /// @param occluders the snapshot, which lives as long as this
  TechniqueChoice(
    Frame& frame, const Occluders& occluders, VisibilityStage& visibility, ShaderLibrary& shaders);

  /// Chooses for this frame.
  /// @param bake bakes a light's map if it is stale
  void choose(const std::function<void(CastingLight&)>& bake);

  /// Takes note of how long a frame took that has a time budget. OpenGL has finished it.
  void endFrame(double milliseconds);

  std::size_t bytes() const { return this->probes_.bytes(); }

private:
  /// Where a light is: position, direction, half the cone.
  using Place = std::tuple<glm::dvec3, glm::dvec3, double>;
  /// The request that a choice answers: soft or hard, map side in texels, samples, error limit.
  using Asked = std::tuple<bool, int, int, double>;
  /// The state of one light's choice while the picture moves.
  struct LightChoice
  {
    int step = 0;              ///< times 2 of its map's side, or 4 of its samples
    int samples = 0;           ///< of an area light in the last frame that moved; 0: all
    bool isProbed = false;     ///< whether that keeps the error
    bool mayBeCoarser = false; ///< whether one step less would, too
    int sinceProbed = 0;       ///< frames
    Place place{};             ///< in the frame before
    Asked asked{};             ///< likewise
  };

  FrameCounters takeChanges(const std::vector<CastingLight*>& hard);
  void rest();
  void chooseMoving(const std::vector<CastingLight*>& hard, const FrameCounters& counters,
    const std::function<void(CastingLight&)>& bake);
  std::string whyNoMaps() const;
  std::string whyRaysAreFast(double byMaps, double byRays) const;
  std::string tryMap(CastingLight& casting, const std::function<void(CastingLight&)>& bake);
  std::optional<WrongProbes> probe(const CastingLight& casting, double limit);
  void takeSamples(CastingLight& casting);
  void refine(CastingLight& casting);
  bool look();

  Frame& frame_;
  const Occluders& occluders_;
  VisibilityStage& visibility_;
  ShaderLibrary& shaders_;
  std::map<int, LightChoice> lights_;               ///< by their places in the scene
  std::size_t view_ = 0;                            ///< of the frame before, as a hash
  std::pair<std::uint64_t, std::uint64_t> casters_; ///< of the frame before: their versions
  int byRays_ = 0;                                  ///< frames in a row that took rays
  std::string whyRays_;                             ///< and why, as a clause
  int byMaps_ = 0;                                  ///< and maps
  int patience_ = 0;                                ///< how many frames of rays come before maps
  Probes probes_;
  bool looked_ = false; ///< whether the probes are this frame's
  std::uint32_t looks_ = 0;
  Slowness slowness_;
};

} // namespace gnomon
