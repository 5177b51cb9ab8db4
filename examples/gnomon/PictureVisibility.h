#pragma once

#include "Comparison.h"
#include "Pictures.h"
#include "Scene.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonVisibilityImages.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderPass.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace gnomon::tool
{

/// Each exposure begins where the previous one has 16 of its 256 steps left.
inline constexpr std::array<double, 4> exposureFactors = { 1.0, 16.0, 256.0, 4096.0 };

/// Return a white texture with the source's alpha; null without a texture or without alpha.
inline vtkSmartPointer<vtkTexture> whiteTexture(vtkTexture* source)
{
  vtkImageData* image = source ? source->GetInput() : nullptr;
  const int components = image ? image->GetNumberOfScalarComponents() : 1;
  if (components % 2 != 0)
  {
    return nullptr;
  }
  vtkNew<vtkImageData> white;
  white->DeepCopy(image);
  for (int i = 0; i + 1 < components; ++i)
  {
    white->GetPointData()->GetScalars()->FillComponent(i, image->GetScalarTypeMax());
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(white);
  texture->SetInterpolate(source->GetInterpolate());
  texture->SetWrap(source->GetWrap());
  return texture;
}

/// Return the scene with white, flat, diffuse surfaces and one white light.
inline Scene whiteScene(const Scene& scene, std::size_t light)
{
  Scene white = scene;
  white.background = { { 0.0, 0.0, 0.0 } };
  white.lights = { scene.lights.at(light) };
  white.lights[0].color = { { 1.0, 1.0, 1.0 } };
  white.lights[0].intensity = 1.0;
  white.models.erase(std::remove_if(white.models.begin(), white.models.end(),
                       [](const SceneModel& model) { return model.property->GetOpacity() < 1.0; }),
    white.models.end());
  for (SceneModel& model : white.models)
  {
    const bool cullsBack = model.property->GetBackfaceCulling();
    const bool cullsFront = model.property->GetFrontfaceCulling();
    model.texture = whiteTexture(model.texture);
    model.property = vtkSmartPointer<vtkProperty>::New();
    model.property->SetInterpolationToFlat();
    model.property->SetColor(1.0, 1.0, 1.0);
    model.property->SetAmbient(0.0);
    model.property->SetDiffuse(1.0);
    model.property->SetSpecular(0.0);
    model.property->SetBackfaceCulling(cullsBack);
    model.property->SetFrontfaceCulling(cullsFront);
  }
  return white;
}

/// Return one picture per exposure.
inline std::vector<Picture> expose(vtkRenderer* renderer, int width, int height)
{
  const auto window = makeOffScreenWindow();
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  vtkLight* const light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  std::vector<Picture> pictures;
  for (double factor : exposureFactors)
  {
    light->SetIntensity(factor);
    window->Render();
    pictures.push_back(capture(window));
  }
  window->RemoveRenderer(renderer);
  return pictures;
}

/// Return visibility as the quotient of pictures of white, diffuse, flat surfaces under one light:
/// the share of light that the shadows leave; NaN if no light arrives.
///
/// A picture has only 8 bits and saturates at white, so several exposures go from dark to bright.
/// Each pixel uses the brightest exposure that is not white without shadows. Values above 1 (some
/// passes brighten) count as 1.
/// @param lit, shadowed the exposures without and with shadows
/// @param colour channel of the pictures: 0 red, 1 green, 2 blue
inline std::vector<float> visibilityFromPictures(
  const std::vector<Picture>& lit, const std::vector<Picture>& shadowed, std::size_t colour)
{
  std::vector<float> visibility(lit.front().pixelCount(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < visibility.size(); ++i)
  {
    const std::size_t byte = 3 * i + colour;
    for (std::size_t k = 0; k < lit.size() && lit[k].rgb[byte] < 255; ++k)
    {
      if (lit[k].rgb[byte] > 0)
      {
        visibility[i] = std::min(
          1.0f, static_cast<float>(shadowed[k].rgb[byte]) / static_cast<float>(lit[k].rgb[byte]));
      }
    }
  }
  return visibility;
}

struct PictureVisibility
{
  /// The truth's positions, normals and coverage with the measured visibility.
  VisibilityImages images;
  std::int64_t unreadable = 0; ///< pixels that count but cannot be measured
};

/// Measure, from pictures, the visibility that `addShadows` gives a scene. This serves renderers
/// that shade with visibility but do not export it. For each light of the truth, the scene is
/// rendered with white surfaces and only this light. Translucent models are left out.
///
/// VTK shades some pixels black although facingPixels() counts them: the light grazes them, and
/// both disagree on the side. Such pixels cannot be measured and get the truth's visibility.
///
/// @param addShadows adds shadows to a new renderer; called once per light
inline PictureVisibility measureVisibility(const Scene& scene, const VisibilityImages& truth,
  const std::function<void(vtkRenderer*)>& addShadows)
{
  PictureVisibility result;
  result.images = truth;
  result.images.classes.clear();
  const double aspect = static_cast<double>(truth.width) / truth.height;
  for (std::size_t k = 0; k < truth.sceneIndices.size(); ++k)
  {
    const Scene white = whiteScene(scene, static_cast<std::size_t>(truth.sceneIndices[k]));
    const std::vector<Picture> lit = expose(makeRenderer(white, aspect), truth.width, truth.height);
    const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(white, aspect);
    addShadows(renderer);
    const std::vector<Picture> shadowed = expose(renderer, truth.width, truth.height);
    // A light without texture is white here, so all channels are equal.
    const LightChannel channel = truth.channels[k];
    const std::size_t colour = channel == LightChannel::Blue ? 2 : channel == LightChannel::Green;
    const std::vector<float> found = visibilityFromPictures(lit, shadowed, colour);
    const std::vector<unsigned char> facing = facingPixels(truth, white.lights[0]);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const bool isUnreadable = std::isnan(found[i]);
      result.unreadable += isUnreadable && facing[i];
      float& visibility = result.images.visibility[k][i];
      visibility = isUnreadable ? visibility : found[i];
    }
  }
  return result;
}

} // namespace gnomon::tool
