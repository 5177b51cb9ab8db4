#pragma once

#include "lights/Bounds.h"
#include "lights/LightManager.h"
#include "lights/SceneFrame.h"
#include "plugin/plan/CostModel.h"
#include "plugin/plan/RayIdentity.h"
#include "shadowtech/Registry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// A light whose settings are completed for an estimator.
struct Composition
{
  ShadowLight light;
  const EstimatorEntry* estimator = nullptr; ///< null: refused
  std::string refusal;                       ///< why, as a clause
};

/// Traits of a light's map that its estimator decides.
struct MapTraits
{
  bool isFittedToCamera = false; ///< Technique::lightOfMap() is
  bool reachDependsOnViews = false;
};

/// The lights of a renderer, in world coordinates.
struct SceneLights
{
  LightSet set;
  std::vector<RayIdentity> identities; ///< of its lights
  std::vector<std::string> misfits;    ///< settings without effect (FrameReport::misfits)
  std::vector<std::string> notes;      ///< FrameReport::notes
  /// Completes a light on this machine. The same light gives the same composition.
  std::function<Composition(ShadowLight)> compose;
  std::function<MapTraits(const EstimatorEntry&, const ShadowLight&)> traitsOf;
  int mostMapSamples = 1; ///< that OpenGL supports for maps of moments, if any light has several
  Bounds seenWorld;       ///< of visible props; needed under a memory budget alone
};

/// The snapshot of the renderer's props.
struct SceneProps
{
  SceneFrame frame;
  std::pair<std::uint64_t, std::uint64_t> casters; ///< their versions
  std::size_t triangles = 0; ///< of a map; as FrameCounters has them, like the next
  std::size_t drawn = 0;
  bool unseenReceiver = false; ///< a surface receives where no probe finds it
  bool seenThrough = false;    ///< the receivers lack a prop (DrawnProps::seenThrough)
  bool catcher = false;        ///< a prop shows nothing but shadows
  bool translucent = false;    ///< translucent surfaces receive
  bool volumes = false;        ///< volumes receive, from casters that exist
  bool transmits = false;      ///< a caster lets a part of the light through
  bool sheets = false;         ///< and is a surface, so that rays alone can tell how much
  bool colours = false;        ///< and colours it
};

/// Further facts for the deferred route, which a walk over the props in view finds.
struct DeferredFacts
{
  bool ownShaders = false;       ///< a prop may have shaders that are not VTK's
  bool partsOfBothKinds = false; ///< an assembly has parts that passes cannot reach
  bool physicallyBased = false;  ///< a prop's shading ends in a gamma
  std::string whyUnsupported;    ///< why OpenGL cannot draw such a picture; empty if it can
};

/// The picture that is drawn, and the OpenGL that draws it.
struct ScenePicture
{
  std::size_t view = 0; ///< of camera and picture size, as a hash
  std::size_t pixels = 0;
  int samples = 1;           ///< of a pixel
  bool severalViews = false; ///< the pass draws other views, too
  bool moves = false;        ///< the frame is one of a moving picture
  bool mayRefine = false;    ///< more frames at rest follow an unfinished one
  bool drawnPlainly = true;  ///< no pass and no mode of the renderer draws props in its own way
  bool drawsMaps = true;     ///< OpenGL is new enough for techniques on the GPU
  bool inSoftware = false;   ///< OpenGL draws on the CPU
  CostFactors factors{};
};

/// All that a frame's plan depends on, beside wishes and history.
struct Scene
{
  SceneLights lights;
  SceneProps props;
  ScenePicture picture;
  std::optional<DeferredFacts> deferred; ///< none: a plan may need them
};

} // namespace gnomon
