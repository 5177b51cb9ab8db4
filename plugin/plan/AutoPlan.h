#pragma once

#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/MotionTimes.h"
#include "plugin/plan/RayIdentity.h"
#include "plugin/plan/Scene.h"
#include "shadowtech/probing/ProbeCounts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// A probe of a map that may take several frames.
struct MapProbe
{
  WrongProbes found;
  std::size_t looks = 0;
};

/// Evidence that a plan needs: how wrong a light's map is, or whether fewer samples of an area
/// light keep the error.
struct EvidenceRequest
{
  int sceneIndex = 0;
  int mapSizeTexels = 0; ///< of a map; 0: of samples
  int lightSamples = 0;  ///< of these samples; 0: of the hard shadows of the light's centre
  double errorLimit = 0.0;
  MapProbe before;      ///< of the same map, by earlier frames
  bool isShown = false; ///< the map kept the error before, so that one look a frame suffices
};
struct Evidence
{
  std::string failure;     ///< why it could not be had, as a clause
  MapProbe probe;          ///< of a map
  bool isClear = false;    ///< on which side of the limit the error of a map is
  bool keepsError = false; ///< of samples
};

/// State from one frame's choice to the next one's. A light is known by its scene index.
struct AutoHistory
{
  /// The request that a choice answers.
  struct Request
  {
    bool isSoft = false;
    int mapSizeTexels = 0;
    int lightSamples = 0;
    double errorLimit = 0.0;
    double areaRadius = 0.0; ///< 0 without an area

    /// True if one choice answers both: an area's size may differ by a tenth.
    bool isLike(const Request& other) const
    {
      const auto [least, most] = std::minmax(this->areaRadius, other.areaRadius);
      return this->isSoft == other.isSoft && this->mapSizeTexels == other.mapSizeTexels &&
        this->lightSamples == other.lightSamples && this->errorLimit == other.errorLimit &&
        most <= 1.1 * least;
    }
  };
  struct Light
  {
    int step = 0;          ///< doublings of its map's side, or the step of its samples (0: hard)
    int samples = 0;       ///< with which an area light begins at rest; 0: all
    bool isProbed = false; ///< true if that keeps the error
    int sinceProbed = 0;   ///< frames
    MapProbe probe;
    double tracedShare = 1.0; ///< of its tiles, as last counted, that had rays; 1: not known
    RayIdentity identity;     ///< in the last frame
    Request request;
  };
  std::map<int, Light> lights;
  std::size_t view = 0;                            ///< ScenePicture::view of the last frame
  std::pair<std::uint64_t, std::uint64_t> casters; ///< and its casters
  int byRays = 0;                                  ///< frames in a row by rays
  std::string whyRays;                             ///< why, as a clause
  int byMaps = 0;                                  ///< frames in a row by maps
  int patience = 0;                                ///< frames by rays until maps are tried
  MotionTimes times;
};

/// The technique of one light that leaves it to the pass.
struct AutoChoice
{
  enum class Way
  {
    Resting, ///< its resting technique
    Map,
    Centre ///< exact hard shadows of its area's centre
  };
  int sceneIndex = 0;
  Way way = Way::Resting;
  int mapSizeTexels = 0; ///< of a map
  int lightSamples = 0;  ///< of the resting technique in motion; 0: all
  int firstSamples = 0;  ///< of the first frame at rest; 0: all
};

struct AutoPlan
{
  std::vector<AutoChoice> choices;
  std::string choice; ///< FrameReport::choice
  AutoHistory history;
  /// If set, the plan is not complete: it is to be made again with this evidence.
  std::optional<EvidenceRequest> needs;
};

/// Choose techniques for lights that leave theirs to the pass (`auto`). At rest they are exact. In
/// motion they are as FrameWishes asks.
///
/// In motion, area lights have hard shadows if the error allows it, else as few samples as it
/// allows. Lights with hard shadows use maps if all of them can, and if rays would take more than
/// 1.3 times as long (CostModel.h): rays are expected in as large a part of the picture as when its
/// tiles were last counted. A map is compared with rays at some pixels before it is shown, and
/// again from time to time, over several frames. It grows until its error is kept, and shrinks
/// between motions. If no map keeps it, all lights use rays, and maps are tried again after 30
/// frames at the earliest.
///
/// While the window asks for a rate (FrameWishes::windowTime), that time comes before errors: area
/// lights have as many samples as fit, else hard shadows of the centre. Where these do not fit,
/// either, planTechniques() replaces the choices by maps.
///
/// @param lights that cast, with their resting techniques
/// @param evidence of this frame, in the order of the plan's needs
AutoPlan planAuto(const Scene& scene, const std::vector<LightPlan>& lights,
  const FrameWishes& wishes, const AutoHistory& history, const std::vector<Evidence>& evidence);

/// The most sets of pixels that are probed to decide whether the error is kept, by maps and under
/// area lights: 32 sets of these take as long as one or two frames.
inline constexpr std::size_t mostLooks = 8;
inline constexpr std::size_t mostSoftLooks = 32;

} // namespace gnomon
