#ifndef gnomon_lights_LightViews_h
#define gnomon_lights_LightViews_h

#include "lights/LightSpace.h"
#include "lights/LightView.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace gnomon
{

/// How the view that sees a point is found among a light's views.
enum class ViewLayout
{
  Single, ///< there is one at most
  Cube    ///< by the point's longest coordinate in light space: cubeFaceOf()
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

  /// What the light shines on: the squared tangent of half a spot light's cone; half the width, half
  /// the height and the depth of a box. 0 of lights without.
  double coneTangentSquared = 0.0;
  glm::dvec3 box{ 0.0 };

  bool operator==(const LightViews& other) const
  {
    return this->layout == other.layout && this->lightFromCentred == other.lightFromCentred &&
      this->views == other.views && this->viewOfFace == other.viewOfFace &&
      this->coneTangentSquared == other.coneTangentSquared && this->box == other.box;
  }
  bool operator!=(const LightViews& other) const { return !(*this == other); }
};

/// Half angles in degrees up to which a spot light gets a single view. A map on a plane has its
/// texels at the border stretched by 1 / cos^2: 4 times at 60 degrees, 3 at the corners of a cube.
constexpr double largestSingleViewConeDegrees = 60.0;

/// The far plane lies this share of the depth range behind the last caster: what a technique writes
/// for it, pushed back as that may be, stays apart from the depth 1 of texels without a caster.
constexpr double roomBehindCasters = 0.125;

/// Directional and narrow spot lights have a single view, point and wide spot lights a cube's. It is
/// known from the light alone, so that shaders can be built before the casters are known.
ViewLayout viewLayout(const ShadowLight& light);

/// The uniform projections, fitted to the casters' bounds as the light sees them. A view covers the
/// casters and no more than the light reaches, and keeps a border on every side, so that what a
/// technique reads around a receiver lies in the same layer. The faces of a cube see 90 degrees
/// between those borders, less where there are no casters. A face whose only casters lie beyond its
/// edge, but no farther than the border, sees them, too; and where casters are near an edge, the texels
/// of the faces that meet there are not smaller than half of the cube's largest.
///
/// @param centreWorld the origin of centred coordinates, in world coordinates
/// @param castersCentred the box around all casters, in centred coordinates
/// @param mapSizeTexels the side of each layer
/// @param borderTexels the border's width; no more than a quarter of the side is kept
///
/// Degenerate cases: no casters, or none that the light shines on, give no view; bounds without
/// extent along an axis are widened relative to the box's own size. Casters nearer to a positional
/// light than 1e-5 of the farthest one are not seen.
LightViews fitLightViews(const ShadowLight& light, const glm::dvec3& centreWorld,
  const Bounds& castersCentred, int mapSizeTexels, int borderTexels = 1);

} // namespace gnomon

#endif
