#include "lights/LightViews.h"

#include "lights/CasterViews.h"
#include "lights/Lispsm.h"
#include "lights/SettingsTable.h"
#include "lights/Splits.h"
#include "lights/Trapezoid.h"
#include "lights/VisibleBody.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

glm::dmat3 scaling(double factor)
{
  MapFit fit;
  fit.scale = glm::dvec2(factor);
  return fit.matrix();
}

/// Return half spaces around a view's map and its border.
std::vector<HalfSpace> mapHalfSpaces(const LightView& view, const MapTexels& texels)
{
  const glm::dmat3 rows = glm::transpose(scaling(texels.inside()) * view.mapFromAcross);
  std::vector<HalfSpace> result;
  for (int axis = 0; axis < 2; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const glm::dvec3 plane = rows[2] + side * rows[axis];
      result.emplace_back(plane.x, plane.y, view.rays.positional ? plane.z : 0.0,
        view.rays.positional ? 0.0 : plane.z);
    }
  }
  return result;
}

/// Return the view with its map fitted to the visible points; nothing without visible points.
std::optional<LightView> fitted(
  LightView view, const std::vector<glm::dvec3>& visibleView, const MapTexels& texels, bool snap)
{
  const Rectangle visible = rangeOf(view.mapFromAcross, view.rays.across(visibleView));
  // A view is wider than its casters by its border.
  const Rectangle covered = texels.covered();
  const std::optional<MapFit> fit =
    snap ? fitSnappedTo(visible, texels, covered) : fitTo(visible, texels, covered);
  if (!fit)
  {
    return std::nullopt;
  }
  view.mapFromAcross = fit->matrix() * view.mapFromAcross;
  return view;
}

/// Return the part that may be read of a map that is fitted to part of the visible range: the range
/// and its border. A snapped map is larger by up to 2^(1/4) and a texel, and a fit widens ranges
/// that are too small.
/// @param coarsest largest ratio of a border texel's side to its side on the uniform map
Rectangle readableOf(const Rectangle& visible, const MapTexels& texels, double coarsest)
{
  const glm::dvec2 centre = 0.5 * (visible.lower + visible.upper);
  const double grown = 1.25 / texels.inside() + coarsest * 2.0 * texels.border / texels.side;
  const glm::dvec2 half = grown * (0.5 * (visible.upper - visible.lower) + 2.0 * leastVisibleShare);
  return { centre - half, centre + half };
}

/// Return the views before their fit to receivers, around all that is visible.
std::vector<LightView> awaitingViews(const ShadowLight& light, const LightView& view,
  const std::vector<glm::dvec3>& visibleView, const MapTexels& texels)
{
  LightView waiting = view;
  waiting.readable = readableOf(rangeOf(view.mapFromAcross, view.rays.across(visibleView)), texels,
    view.warps.empty() ? 0.0 : coarsestOfSeries);
  const bool splits = light.projection == Projection::Splits;
  return std::vector<LightView>(splits ? static_cast<std::size_t>(light.splits) : 1, waiting);
}

/// Split or warp one view of casters by the light's projection.
/// @param view around the casters, without a border
/// @param reach half spaces, in view space, of the light's reach through this view
std::vector<LightView> layViews(const ShadowLight& light, const ViewFitting& fitting,
  LightView view, std::vector<HalfSpace> reach)
{
  if (!fitting.camera && !fitting.holdsReceiversAlone)
  {
    view.mapFromAcross = scaling(fitting.texels.inside()) * view.mapFromAcross;
    return { view };
  }
  const std::vector<HalfSpace> map = mapHalfSpaces(view, fitting.texels);
  reach.insert(reach.end(), map.begin(), map.end());
  if (!fitting.camera)
  {
    const std::vector<glm::dvec3> receivers =
      ConvexBody(fitting.receiversCentred, view.rays.viewFromCentred).clipped(reach).vertices();
    const auto fit = fitted(view, receivers, fitting.texels, light.snap);
    return fit ? std::vector<LightView>{ *fit } : std::vector<LightView>();
  }
  const CameraView& camera = *fitting.camera;
  const ConvexBody body = visibleBody(camera, fitting.receiversCentred, view.rays, reach);
  const std::vector<glm::dvec3> visible = body.vertices();
  if (visible.empty())
  {
    return {};
  }
  if (choosesWarp(light))
  {
    for (const glm::dmat3& warp : lispsmSeries(visible, camera, view.rays))
    {
      view.warps.push_back(scaling(fitting.texels.inside()) * warp);
    }
    view.mapFromAcross = view.warps.front();
  }
  else if (isWarped(light))
  {
    const glm::dmat3 warp = light.projection == Projection::Lispsm
      ? lispsmFromAcross(visible, camera, view.rays)
      : trapezoidFromAcross(visible, camera, view.rays);
    view.mapFromAcross = scaling(fitting.texels.inside()) * warp;
  }
  if (light.fittedToReceivers)
  {
    return awaitingViews(light, view, visible, fitting.texels);
  }
  std::vector<LightView> views;
  const auto add = [&](const std::vector<glm::dvec3>& points)
  {
    if (const auto fit = fitted(view, points, fitting.texels, light.snap))
    {
      views.push_back(*fit);
    }
  };
  if (isWarped(light))
  {
    views.push_back(view);
  }
  else if (light.projection == Projection::Splits)
  {
    const DistanceRange range = distancesOf(visible, camera, view.rays);
    const std::vector<double> distances =
      splitDistances({ range.lower, range.upper }, light.splits, light.splitLambda);
    for (std::size_t i = 0; i + 1 < distances.size(); ++i)
    {
      const double shared = i == 0 ? 0.0 : light.splitBlend * (distances[i] - distances[i - 1]);
      add(sliced(body, camera, view.rays, distances[i] - shared, distances[i + 1]).vertices());
    }
  }
  else
  {
    add(visible);
  }
  return views;
}

/// Fit a directional light's views to its casters; with a box, to the casters' part inside it.
void fitDirectional(
  Bounds castersLight, const ShadowLight& light, const ViewFitting& fitting, LightViews& result)
{
  const double radius = castersLight.radius();
  std::vector<HalfSpace> reach;
  double beginsAt = -std::numeric_limits<double>::infinity();
  if (light.box)
  {
    const glm::dvec3& box = result.box;
    if (castersLight.lower.z < 0.0)
    {
      beginsAt = 0.0;
    }
    castersLight.lower = glm::max(castersLight.lower, glm::dvec3(-box.x, -box.y, 0.0));
    castersLight.upper = glm::min(castersLight.upper, box);
    reach = boxHalfSpaces(box);
    if (castersLight.empty())
    {
      return;
    }
  }
  else
  {
    // Floats are finest for small depths.
    result.lightFromCentred =
      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -castersLight.lower.z)) *
      result.lightFromCentred;
    castersLight.upper.z -= castersLight.lower.z;
    castersLight.lower.z = 0.0;
  }
  LightView view = parallelCasterView(castersLight, radius, result.lightFromCentred);
  view.beginsAt = beginsAt;
  result.views = layViews(light, fitting, view, reach);
}

void fitSpot(const Bounds& castersLight, const ShadowLight& light, const ViewFitting& fitting,
  LightViews& result)
{
  const double tangent = std::sqrt(result.coneTangentSquared);
  if (const auto view = spotCasterView(castersLight, result.lightFromCentred, tangent))
  {
    const double nearest = nearestOf(fitting.receiversCentred, view->rays);
    result.views = layViews(light, fitting, *view, coneHalfSpaces(tangent, nearest));
  }
}

void fitCube(
  Bounds castersLight, const ShadowLight& light, const ViewFitting& fitting, LightViews& result)
{
  if (light.kind == LightKind::Spot)
  {
    castersLight.lower.z = std::max(castersLight.lower.z, 0.0); // a cone lights nothing behind it
  }
  if (castersLight.empty())
  {
    return;
  }
  const auto views =
    cubeCasterViews(castersLight, result.lightFromCentred, fitting.texels.inside());
  for (std::size_t face = 0; face < views.size(); ++face)
  {
    if (!views[face])
    {
      continue;
    }
    const double nearest = nearestOf(fitting.receiversCentred, views[face]->rays);
    for (const LightView& laid :
      layViews(light, fitting, *views[face], cubeFaceHalfSpaces(nearest)))
    {
      result.viewOfFace[face] = static_cast<int>(result.views.size());
      result.views.push_back(laid);
    }
  }
}

} // namespace

ViewLayout viewLayout(const ShadowLight& light)
{
  const bool wide =
    light.kind == LightKind::Spot && light.coneAngleDegrees > largestSingleViewConeDegrees;
  if (wide || light.kind == LightKind::Point || light.projection == Projection::Cube)
  {
    return ViewLayout::Cube;
  }
  return light.projection == Projection::Splits ? ViewLayout::Splits : ViewLayout::Single;
}

bool isWarped(const ShadowLight& light)
{
  return light.projection == Projection::Lispsm || light.projection == Projection::Trapezoid;
}

bool choosesWarp(const ShadowLight& light)
{
  return light.fittedToReceivers && light.projection == Projection::Lispsm;
}

bool isFittedToCamera(const ShadowLight& light)
{
  return isWarped(light) || light.projection == Projection::Splits || light.fit != ViewFit::Off;
}

int mostViews(const ShadowLight& light)
{
  const ViewLayout layout = viewLayout(light);
  return layout == ViewLayout::Cube ? cubeFaces : layout == ViewLayout::Splits ? light.splits : 1;
}

std::string refusedProjection(const ShadowLight& light)
{
  const std::string name = findSetting("projection")->get(light);
  if (light.projection == Projection::Cube && light.kind == LightKind::Directional)
  {
    return "the projection '" + name +
      "' stands around a light, and a directional one has no place";
  }
  const bool single =
    light.projection != Projection::Cube && light.projection != Projection::Uniform;
  if (single && viewLayout(light) == ViewLayout::Cube)
  {
    return "the projection '" + name +
      "' divides or warps a single view, and a point light, or a spot light of more than " +
      std::to_string(static_cast<int>(largestSingleViewConeDegrees)) +
      " degrees half angle, has the faces of a cube";
  }
  return {};
}

LightViews fitLightViews(const ShadowLight& light, const ViewFitting& fitting)
{
  LightViews result;
  result.layout = viewLayout(light);
  result.awaitFit = light.fittedToReceivers;
  result.borderTexels = fitting.texels.border;
  result.lightFromCentred = lightFromCentred(light, fitting.centreWorld);
  const double coneTangent = std::tan(glm::radians(light.coneAngleDegrees));
  if (light.kind == LightKind::Spot)
  {
    result.coneTangentSquared = coneTangent * coneTangent;
  }
  if (light.box)
  {
    result.box = { 0.5 * light.box->width, 0.5 * light.box->height, light.box->depth };
  }
  if (fitting.castersCentred.empty())
  {
    return result;
  }
  const Bounds castersLight = affinelyTransformed(fitting.castersCentred, result.lightFromCentred);
  if (light.kind == LightKind::Directional)
  {
    fitDirectional(castersLight, light, fitting, result);
  }
  else if (result.layout == ViewLayout::Cube)
  {
    fitCube(castersLight, light, fitting, result);
  }
  else
  {
    fitSpot(castersLight, light, fitting, result);
  }
  return result;
}

void moveTexels(LightViews& views, const glm::dvec2& texels, int sideTexels)
{
  MapFit move;
  move.offset = 2.0 * texels / static_cast<double>(sideTexels);
  for (LightView& view : views.views)
  {
    view.mapFromAcross = move.matrix() * view.mapFromAcross;
  }
}

} // namespace gnomon
