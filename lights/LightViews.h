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

/// How a point's view is found among a light's views.
enum class ViewLayout
{
  Single, ///< at most one view
  Cube,   ///< by the point's longest coordinate in light space: cubeFaceOf()
  Splits  ///< the first view that holds the point and its border; views go from near to far
};

/// All views of a light: one for each layer of its map.
struct LightViews
{
  ViewLayout layout = ViewLayout::Single;
  /// The transformation to light space, in which a point's view is chosen. For a single view, its
  /// view space.
  glm::dmat4 lightFromCentred{ 1.0 };
  /// Empty without casters that the light reaches. Then every receiver in the light's reach is lit,
  /// and no map is needed.
  std::vector<LightView> views;
  /// Layout Cube: the index of each face's view, `noView` for a face that sees no caster.
  std::array<int, cubeFaces> viewOfFace{ { noView, noView, noView, noView, noView, noView } };

  static constexpr int noView = -1;

  /// True while the last fit, F of MapFit.h, is pending. It follows from this frame's receivers
  /// (ShadowLight::fittedToReceivers). Until then, maps are in device coordinates before F. Uniform
  /// views and splits hold all casters; warped views hold the camera's view. A view whose warp is
  /// also pending is uniform.
  bool awaitFit = false;

  /// Texels that are read around a point. A split's view must hold them, too.
  int borderTexels = 1;

  /// The light's reach: the squared tangent of half a spot light's cone; half the width, half the
  /// height and the depth of a box. 0 for lights without a cone or box.
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

/// The largest half angle, in degrees, of a spot light with a single view. Texels at a planar map's
/// border are stretched by 1 / cos^2: 4 times at 60 degrees, 3 times at a cube's corners.
constexpr double largestSingleViewConeDegrees = 60.0;

/// Return the layout of a light's views: a cube for point lights and wide spot lights, else a
/// single view or splits. It depends on the light only, so shaders can be built before the casters
/// are known.
ViewLayout viewLayout(const ShadowLight& light);

/// True if the light's projection is a perspective towards the camera, so that texels have
/// different sizes across the light.
bool isWarped(const ShadowLight& light);

/// True if the last fit, to receivers, also chooses the perspective (LightView::warps).
bool choosesWarp(const ShadowLight& light);

/// True if the light's views depend on the camera. Else they hold the whole scene.
bool isFittedToCamera(const ShadowLight& light);

/// Return the largest number of views that the light may have.
int mostViews(const ShadowLight& light);

/// Return why the light's projection is refused for a light of its kind, as a clause; empty if it
/// is not.
std::string refusedProjection(const ShadowLight& light);

/// The scene and camera that views are fitted to, in centred coordinates.
struct ViewFitting
{
  glm::dvec3 centreWorld{ 0.0 }; ///< the origin of centred coordinates, in world coordinates
  Bounds castersCentred;         ///< the box around all casters
  Bounds receiversCentred;       ///< the box around all receivers, casters included
  MapTexels texels;              ///< of each layer
  /// The camera that the views are for; none: the views hold the whole scene.
  std::optional<CameraView> camera;
  /// Without a camera: true if views hold the receivers alone.
  bool holdsReceiversAlone = false;
};

/// Fit a light's views.
///
/// Without a camera, a view covers the casters in the light's reach, or the part of them that is in
/// front of receivers (ViewFitting::holdsReceiversAlone), and projections are uniform.
/// With a camera, it covers what the camera may see in the light's reach (VisibleBody.h). Depths
/// always cover all casters, so casters between the light and the visible receivers are kept.
///
/// - Uniform views are fitted by scale and offset (MapFit.h), and snap to texels if the light asks
///   for it.
/// - Warped views are fitted by a perspective (Lispsm.h, Trapezoid.h).
/// - Each split covers an interval of distances from the camera (Splits.h).
///
/// For a light that is fitted to receivers, the last fit stays pending. The part that the camera
/// may see becomes the views' readable part.
///
/// A view has a border on every side, so all texels that a technique reads around a receiver lie in
/// one layer. A cube's faces see 90 degrees between these borders, or less if casters fill less.
///
/// Degenerate cases: there is no view without casters in the light's reach, or without visible
/// points in their range. Bounds without extent along an axis are widened relative to the box's
/// size. Casters nearer to a positional light than nearestShare of the farthest one are cut off.
LightViews fitLightViews(const ShadowLight& light, const ViewFitting& fitting);

/// Shift all views by a share of a texel, so maps of nearly equal views round a caster's edges
/// differently.
/// @param texels the shift, up to half a texel; the views' border must hold one texel more than is
/// read
/// @param sideTexels side of the maps
void moveTexels(LightViews& views, const glm::dvec2& texels, int sideTexels);

} // namespace gnomon
