#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/frame/VisibilityStage.h"
#include "plugin/plan/CostModel.h"
#include "plugin/plan/Slowness.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/probing/Probes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// Chooses techniques for lights that leave theirs to the pass (`auto`), between the stages of
/// lights and route. At rest they are exact. In motion they are as FrameWishes asks.
///
/// In motion, area lights have hard shadows if the error allows it, else as few samples as it
/// allows. Lights with hard shadows use maps if all of them can, and if rays would take more than
/// 1.3 times as long (CostModel.h): rays are expected in as large a part of the picture as when its
/// tiles were last counted. A map is compared with rays at some pixels (Probes.h) before it is
/// shown, and again from time to time, over several frames. It grows until its error is kept, and
/// shrinks between motions. If no map keeps it, all lights use rays, and maps are tried again after
/// 30 frames at the earliest.
class TechniqueChoice
{
public:
  /// @param occluders the snapshot, which must outlive this
  TechniqueChoice(
    Frame& frame, const Occluders& occluders, VisibilityStage& visibility, ShaderLibrary& shaders);

  /// Choose for this frame.
  /// @param bake bakes a light's map if it is stale
  void choose(const std::function<void(CastingLight&)>& bake);

  /// Record how much of the picture had rays and, with a time budget, the time of the frame, which
  /// OpenGL must have finished.
  void endFrame(double milliseconds);

  std::size_t bytes() const { return this->probes_.bytes(); }

private:
  /// The request that a choice answers.
  struct Request
  {
    bool isSoft = false;
    int mapSizeTexels = 0;
    int lightSamples = 0;
    double errorLimit = 0.0;
    double areaRadius = 0.0; ///< 0 without an area

    /// True if one choice answers both: an area's size may differ by a tenth.
    bool isLike(const Request& other) const;
  };
  /// A probe of a map that may take several frames.
  struct Probing
  {
    WrongProbes found;
    std::size_t looks = 0;
  };
  /// The state of one light's choice while the picture moves.
  struct LightChoice
  {
    int step = 0;          ///< doublings of its map's side, or the step of its samples (0: hard)
    int samples = 0;       ///< with which an area light begins at rest; 0: all
    bool isProbed = false; ///< true if that keeps the error
    int sinceProbed = 0;   ///< frames
    Probing probing;
    double tracedShare = 1.0; ///< of its tiles, as last counted, that had rays; 1: not known
    RayIdentity identity;     ///< in the last frame
    Request request;          ///< that was proved, or is being proved
  };

  FrameCounters takeChanges(const std::vector<CastingLight*>& hard);
  void rest();
  void chooseMoving(const std::vector<CastingLight*>& hard, const FrameCounters& counters,
    const std::function<void(CastingLight&)>& bake);
  std::string whyNoMaps() const;
  std::string whyRaysAreFast(double byMaps, double byRays) const;
  std::string tryMap(CastingLight& casting, const std::function<void(CastingLight&)>& bake);
  bool probe(const CastingLight& casting, double limit, LightChoice& choice);
  void takeSamples(CastingLight& casting);
  bool keepsError(const ShadowLight& other, const ShadowLight& light, double limit);
  void refine(CastingLight& casting);
  void look();

  Frame& frame_;
  const Occluders& occluders_;
  VisibilityStage& visibility_;
  ShaderLibrary& shaders_;
  std::map<int, LightChoice> lights_;               ///< by their indices in the scene
  std::size_t view_ = 0;                            ///< of the last frame, as a hash
  std::pair<std::uint64_t, std::uint64_t> casters_; ///< their versions in the last frame
  int byRays_ = 0;                                  ///< frames in a row by rays
  std::string whyRays_;                             ///< why, as a clause
  int byMaps_ = 0;                                  ///< frames in a row by maps
  int patience_ = 0;                                ///< frames by rays until maps are tried
  Probes probes_;
  bool looked_ = false; ///< true if the probes are this frame's
  std::uint32_t looks_ = 0;
  Slowness slowness_;
};

} // namespace gnomon
