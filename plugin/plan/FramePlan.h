#pragma once

#include "plugin/plan/AutoPlan.h"
#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/PicturePlan.h"
#include "plugin/plan/Scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// How a frame shows the sky.
struct SkyPlan
{
  Sky sky;
  glm::vec3 light{ 0.0f }; ///< colour times intensity
  int directions = 0;
  int layer = 0; ///< of its view
  /// How a frame finds views.
  enum class Rays
  {
    None, ///< everything sees all of the sky
    Few,  ///< few directions and neighbours (SkyImage::traceFew())
    All
  };
  Rays rays = Rays::All;
  std::size_t batchesOfFrame = 0; ///< of directions that a frame adds (SkyDirections)
};

/// All that is decided of a frame before anything is drawn.
struct FramePlan
{
  std::vector<LightPlan> lights; ///< that cast, in the scene's order
  std::optional<SkyPlan> sky;    ///< none: VTK's ambient light
  int layers = 0;                ///< of visibility
  int bits = 0;
  int edgeBit = noBit; ///< of these, the one of pixels at edges that pictures smooth
  std::vector<SkippedLight> skipped;
  std::vector<std::string> misfits; ///< FrameReport::misfits
  std::vector<std::string> notes;   ///< FrameReport::notes
  bool headlightIsAlone = false;    ///< FrameReport::headlightIsAlone
  std::string choice;               ///< FrameReport::choice
  bool hasShadows = true;           ///< false: nothing casts, and no visibility is kept
  PicturePlan picture;              ///< if it has shadows
  bool namesSurfaces = false;       ///< true if the snapshot's surfaces need names
  /// True if tiles of an image stay while this process's casters near them do: it has all casters.
  bool reusesTiles = true;
  bool transmits = false;     ///< true if translucent casters scale the lights' visibility
  bool colours = false;       ///< and do so by channel
  bool moves = false;         ///< true if the frame is one of a moving picture
  bool isApproximate = false; ///< true if a picture at rest may differ from it
  AutoHistory history;        ///< for the next frame

  /// If set, its lights have their resting techniques until they are planned with this evidence.
  std::optional<EvidenceRequest> needs;
  bool needsDeferredFacts = false; ///< true if its drawing depends on Scene::deferred
};

///@{
/// Plan a frame, in three steps: its lights with the techniques of a picture at rest, and its sky;
/// the techniques of lights that leave them to the pass; how the picture is drawn. Each takes the
/// plan of the one before.
/// @param history that the last frame left
/// @param evidence of this frame, in the order in which plans needed it. While
///        FramePlan::needs is set, techniques are to be planned again with more.
FramePlan planAtRest(const Scene& scene, const FrameWishes& wishes, const AutoHistory& history);
FramePlan planTechniques(FramePlan plan, const Scene& scene, const FrameWishes& wishes,
  const std::vector<Evidence>& evidence);
FramePlan planDrawing(FramePlan plan, const Scene& scene, const FrameWishes& wishes);
///@}

/// Facts that decide which programs write triangle numbers.
struct NumberingFacts
{
  Route route = Route::Deferred; ///< that draws receivers
  bool inSoftware = false;       ///< ScenePicture::inSoftware
  int restingFrames = 0;         ///< in a row that kept their receivers
  bool severalViews = false;
  std::size_t triangles = 0;
  std::size_t surfaces = 0;
};
/// Return the programs that write triangle numbers. On llvmpipe numbers cost 25 ns a triangle or
/// more, even where no image takes them. To change the programs, VTK rebuilds their shaders, which
/// takes 0.05 to 0.2 ms a surface: large meshes alone pay for that. On llvmpipe the image route
/// changes them within each frame that draws receivers. A GPU would lose by that, and the deferred
/// route has one drawing, so there the change waits until receivers rest.
Numbering numberingOf(const NumberingFacts& facts);

/// Facts that decide if receivers are stored before rays start from them.
struct TracingFacts
{
  int frames = 0;       ///< in a row, with this one
  int images = 0;       ///< of lights, in this frame
  int imagesByMaps = 0; ///< and of lights whose conservative map decides most receivers
};
/// True if receivers are stored before rays start from them. Storing takes half as long as tracing
/// an image. From then on an image takes a third less, and there are boxes by which tiles need no
/// rays. A map that decides whole triangles spares most receivers of the first two images.
bool storesReceivers(const TracingFacts& facts);

} // namespace gnomon
