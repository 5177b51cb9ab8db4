#pragma once

#include "ImageFile.h"

#include "lights/LightManager.h"
#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "plugin/scene/OccluderCollector.h"
#include "plugin/scene/ShownView.h"
#include "shadowtech/Registry.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::tool
{

/// A casting light as its technique sees it, and the views of its map.
struct LightSight
{
  ShadowLight light;
  LightViews views; ///< none of a technique without a map
};

/// Return the view of a point, by the rule of LightViews.h; null if there is none.
inline const LightView* viewOf(const LightViews& views, const glm::dvec3& positionCentred)
{
  if (views.layout == ViewLayout::Cube)
  {
    const int face =
      cubeFaceOf(glm::dvec3(views.lightFromCentred * glm::dvec4(positionCentred, 1.0)));
    const int view = views.viewOfFace[static_cast<std::size_t>(face)];
    return view == LightViews::noView ? nullptr : &views.views[static_cast<std::size_t>(view)];
  }
  for (const LightView& view : views.views)
  {
    const glm::dvec3 seen(view.rays.viewFromCentred * glm::dvec4(positionCentred, 1.0));
    if (view.rays.positional && seen.z <= 0.0)
    {
      continue;
    }
    const glm::dvec3 map = view.mapFromAcross * glm::dvec3(view.rays.across(seen), 1.0);
    if (map.z > 0.0 && std::abs(map.x) < map.z && std::abs(map.y) < map.z)
    {
      return &view;
    }
  }
  return nullptr;
}

/// Return a texel's side at a point, across the light, in world units; 0 if no view contains it.
/// @param sizeTexels of the map
inline double texelSide(const LightViews& views, int sizeTexels, const glm::dvec3& positionCentred)
{
  const LightView* const view = viewOf(views, positionCentred);
  if (!view)
  {
    return 0.0;
  }
  // The determinant of a homography's derivative at a point is its own over w^3; a step across a
  // positional light at a distance z is a step of 1/z in slopes.
  const glm::dvec3 seen(view->rays.viewFromCentred * glm::dvec4(positionCentred, 1.0));
  const glm::dmat3 matrix = texelFromAcross(*view, sizeTexels);
  const glm::dvec3 image = matrix * glm::dvec3(view->rays.across(seen), 1.0);
  const double texelsPerArea = std::abs(glm::determinant(matrix) / (image.z * image.z * image.z)) /
    (view->rays.positional ? seen.z * seen.z : 1.0);
  return texelsPerArea > 0.0 ? 1.0 / std::sqrt(texelsPerArea) : 0.0;
}

inline glm::dvec3 colourOfView(std::size_t view)
{
  static constexpr std::array<std::array<double, 3>, 8> colours = { { { 1.0, 0.55, 0.1 },
    { 0.2, 0.75, 1.0 }, { 0.45, 0.85, 0.25 }, { 0.95, 0.3, 0.6 }, { 0.95, 0.9, 0.2 },
    { 0.6, 0.45, 1.0 }, { 0.2, 0.9, 0.75 }, { 0.8, 0.8, 0.8 } } };
  const auto& colour = colours[view % colours.size()];
  return { colour[0], colour[1], colour[2] };
}

/// Complete a light. Return true if its technique has a map; false if it refuses the light.
inline bool bakesMap(ShadowLight& light)
{
  try
  {
    return compose(light).info.bakesMap();
  }
  catch (const CompositionError&)
  {
    return false;
  }
}

/// Return a corner of a view's volume, in centred coordinates.
inline glm::dvec3 cornerOf(const LightView& view, double x, double y, double z)
{
  const glm::dvec2 across = mapped(glm::inverse(view.mapFromAcross), { x, y });
  const glm::dvec3 seen = view.rays.positional ? glm::dvec3(z * across, z) : glm::dvec3(across, z);
  return glm::dvec3(glm::inverse(view.rays.viewFromCentred) * glm::dvec4(seen, 1.0));
}

/// @param steps log2 of a texel's side in pixels
inline glm::dvec3 colourOf(double steps)
{
  constexpr double mostSteps = 2.0;
  const glm::dvec3 fine(0.1, 0.3, 1.0);
  const glm::dvec3 even(1.0);
  const glm::dvec3 coarse(1.0, 0.15, 0.1);
  const double share = std::clamp(steps / mostSteps, -1.0, 1.0);
  return glm::mix(even, share < 0.0 ? fine : coarse, std::abs(share));
}

/// The views of a renderer's lights for overlays, from the same snapshot as the pass.
///
/// A view that the pass fits to receivers (the setting `fit`) is fitted to the camera's frustum
/// here, which contains it: the pass fits on the GPU and does not read the fit back.
class LightSights
{
public:
  /// @param settings the pass's, for settings that a light lacks
  void update(vtkRenderer* renderer, const ShadowSettings& settings)
  {
    this->collector_.collect(renderer);
    const Occluders& occluders = this->collector_.occluders();
    this->lights_.clear();
    for (ShadowLight& light : LightManager().collect(renderer, settings).lights)
    {
      if (!enterFrame(light, occluders.frame).empty())
      {
        continue;
      }
      LightViews views;
      if (bakesMap(light))
      {
        ViewFitting fitting;
        fitting.centreWorld = occluders.frame.centre;
        fitting.castersCentred = occluders.castersCentred;
        fitting.receiversCentred = occluders.allCentred;
        fitting.texels = { light.mapSizeTexels, 1 };
        if (isFittedToCamera(light))
        {
          fitting.camera = shownView(renderer, occluders.frame).camera;
        }
        views = fitLightViews(light, fitting);
      }
      this->lights_.push_back({ std::move(light), std::move(views) });
    }
  }

  const std::vector<LightSight>& lights() const { return this->lights_; }
  /// Return the light of that number in the renderer's collection; null if it does not cast.
  const LightSight* find(int sceneIndex) const
  {
    const auto found = std::find_if(this->lights_.begin(), this->lights_.end(),
      [sceneIndex](const LightSight& sight) { return sight.light.sceneIndex == sceneIndex; });
    return found == this->lights_.end() ? nullptr : &*found;
  }

  const OccluderCollector& snapshot() const { return this->collector_; }

private:
  OccluderCollector collector_;
  std::vector<LightSight> lights_;
};

/// Return the edges of the view volumes of a light's map, in world coordinates, in a colour for
/// each view.
inline vtkSmartPointer<vtkPolyData> frustumLines(const LightViews& views, const SceneFrame& frame)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < views.views.size(); ++i)
  {
    const LightView& view = views.views[i];
    const double nearest = std::max(view.beginsAt, -view.depthOffset / view.depthScale);
    const double farthest = (1.0 - view.depthOffset) / view.depthScale;
    const vtkIdType first = points->GetNumberOfPoints();
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec3 world = frame.toWorld(cornerOf(
        view, corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? farthest : nearest));
      points->InsertNextPoint(world.x, world.y, world.z);
    }
    const glm::dvec3 colour = 255.0 * colourOfView(i);
    for (int from = 0; from < 8; ++from)
    {
      for (const int axis : { 1, 2, 4 })
      {
        if (!(from & axis)) // each edge once
        {
          const vtkIdType ends[2] = { first + from, first + (from | axis) };
          lines->InsertNextCell(2, ends);
          colours->InsertNextTuple3(colour.x, colour.y, colour.z);
        }
      }
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetLines(lines);
  result->GetCellData()->SetScalars(colours);
  return result;
}

/// Colour a grey picture by the size of the texels of a light's map: blue for a quarter of a pixel
/// or less, white for one pixel, red for four or more. Pixels outside of all views stay grey.
/// @param images the picture's receivers
/// @param camera the picture's, for the snapshot's centre
inline Picture texelPicture(const Picture& picture, const VisibilityImages& images,
  const LightSight& sight, const SceneFrame& frame, const CameraView& camera)
{
  Picture result = picture;
  const glm::dvec2 pixelSide = camera.pixelSide({ images.width, images.height });
  const glm::dvec3 origin(images.origin[0], images.origin[1], images.origin[2]);
  for (std::size_t i = 0; i < images.coverage.size(); ++i)
  {
    unsigned char* const pixel = &result.rgb[3 * i];
    const double grey = (0.21 * pixel[0] + 0.72 * pixel[1] + 0.07 * pixel[2]) / 255.0;
    glm::dvec3 colour(0.5);
    if (images.coverage[i] == 1.0f)
    {
      const glm::dvec3 position = frame.fromWorld(
        origin + glm::dvec3(images.positionX[i], images.positionY[i], images.positionZ[i]));
      const double side = texelSide(sight.views, sight.light.mapSizeTexels, position);
      const double distance = -(camera.viewFromCentred * glm::dvec4(position, 1.0)).z;
      if (side > 0.0)
      {
        colour = colourOf(std::log2(side / (pixelSide.x + pixelSide.y * distance)));
      }
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      pixel[channel] =
        static_cast<unsigned char>(255.0 * colour[channel] * (0.25 + 0.75 * grey) + 0.5);
    }
  }
  return result;
}

} // namespace gnomon::tool
