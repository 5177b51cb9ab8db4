#pragma once

#include "lights/CameraView.h"
#include "lights/LightSpace.h"
#include "lights/LightView.h"
#include "lights/MapFit.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// How the view that sees a point is found among a light's views.
enum class ViewLayout
{
  Single, ///< there is one at most
  Cube,   ///< by the point's longest coordinate in light space: cubeFaceOf()
  Splits  ///< the first that holds the point and the border around it; they grow from near to far
};

/// Everything that a light sees: one view per layer of its map.
struct LightViews
{
  ViewLayout layout = ViewLayout::Single;
  /// Light space, in which the view of a point is chosen: of a single view its own.
  glm::dmat4 lightFromCentred{ 1.0 };
  /// Empty where there is nothing to see (no casters, or none that the light shines on): every
  /// receiver that the light reaches is lit, and no map is needed.
  std::vector<LightView> views;
  /// Layout Cube: the view of each face, `noView` where no caster can be seen through it.
  std::array<int, cubeFaces> viewOfFace{ { noView, noView, noView, noView, noView, noView } };

  static constexpr int noView = -1;

  /// Whether the views still wait for the last fit, F of MapFit.h, which the receivers that are
  /// drawn will give (ShadowLight::fittedToReceivers). Their maps are then in device coordinates
  /// before F: around all casters of a uniform view or split, around what the camera can see of a
  /// warped one. A view whose warp is to be chosen, too, is uniform until then.
  bool awaitFit = false;

  /// Texels around a point that are read with it, which a split's view has to hold, too.
  int borderTexels = 1;

  /// What the light shines on: the squared tangent of half a spot light's cone; half the width,
  /// half the height and the depth of a box. 0 of lights without.
  double coneTangentSquared = 0.0;
  glm::dvec3 box{ 0.0 };

  bool operator==(const LightViews& other) const
  {
    return this->layout == other.layout && this->lightFromCentred == other.lightFromCentred &&
      this->views == other.views && this->viewOfFace == other.viewOfFace &&
      this->awaitFit == other.awaitFit && this->borderTexels == other.borderTexels &&
      this->coneTangentSquared == other.coneTangentSquared && this->box == other.box;
  }
  bool operator!=(const LightViews& other) const { return !(*this == other); }
};

/// Half angles in degrees up to which a spot light gets a single view. A map on a plane has its
/// texels at the border stretched by 1 / cos^2: 4 times at 60 degrees, 3 at the corners of a cube.
constexpr double largestSingleViewConeDegrees = 60.0;

/// Point and wide spot lights have a cube's views, others a single one or splits. It is known from
/// the light alone, so that shaders can be built before the casters are known.
ViewLayout viewLayout(const ShadowLight& light);

/// Whether the light's projection is a perspective towards the camera, so that texels are of
/// different sizes across the light.
bool isWarped(const ShadowLight& light);

/// Whether that perspective is chosen together with the last fit, by the receivers that are drawn
/// (LightView::warps).
bool choosesWarp(const ShadowLight& light);

/// Whether the light's views are made for what a camera sees, rather than for all of the scene.
bool isFittedToCamera(const ShadowLight& light);

/// How many views there can be.
int mostViews(const ShadowLight& light);

/// Why the light's projection makes no sense for a light of its kind; empty where it does.
std::string refusedProjection(const ShadowLight& light);

/// What views are fitted to, in centred coordinates.
struct ViewFitting
{
  glm::dvec3 centreWorld{ 0.0 }; ///< the origin of centred coordinates, in world coordinates
  Bounds castersCentred;         ///< the box around all casters
  Bounds receiversCentred;       ///< the box around all that receives, casters with it
  MapTexels texels;              ///< of each layer
  /// Whose picture the views are for; none: for all of the scene.
  std::optional<CameraView> camera;
};

/// Fits a light's views.
///
/// Without a camera a view covers the casters, and no more than the light reaches; projections are
/// uniform. With one, it covers what the camera can see of that (VisibleBody.h): uniform views by
/// scale and offset (MapFit.h), snapped to texels if the light asks for it; warped ones by their
/// own mathematics (Lispsm.h, Trapezoid.h); splits each a part of the distance from the camera
/// (Splits.h). Depths always cover all casters, so that those between the light and what is visible
/// are kept.
///
/// For a light that is fitted to receivers, all of this is done but for the fit itself, and what
/// the camera can see at most becomes the views' readable part.
///
/// A view keeps a border on every side, so that what a technique reads around a receiver lies in
/// the same layer. The faces of a cube see 90 degrees between those borders, less where there are
/// no casters.
///
/// Degenerate cases: no casters, or none that the light shines on, or nothing visible below them,
/// give no view; bounds without extent along an axis are widened relative to the box's own size.
/// Casters nearer to a positional light than nearestShare of the farthest one are not seen.
LightViews fitLightViews(const ShadowLight& light, const ViewFitting& fitting);

/// Moves what all views show, by a share of a texel, so that maps of much the same view do not
/// round a caster's edges to the same texels.
/// @param texels up to half a texel: the views' border has to hold one more than is read of it
/// @param sideTexels of the maps
void moveTexels(LightViews& views, const glm::dvec2& texels, int sideTexels);

} // namespace gnomon
