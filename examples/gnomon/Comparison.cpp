#include "Comparison.h"

#include "Vec3.h"

#include "shadowtech/base/ShadowRay.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

glm::dvec3 toGlm(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}

} // namespace

std::vector<unsigned char> facingPixels(const VisibilityImages& images, const SceneLight& light)
{
  ShadowLight source;
  source.kind = light.type;
  source.positionWorld = toGlm(light.position);
  source.directionWorld = toGlm(normalized(light.target - light.position));
  source.coneAngleDegrees = light.coneAngleDegrees;
  if (light.box)
  {
    source.box = { light.box->width, light.box->height, light.box->depth, toGlm(light.box->up) };
  }
  std::vector<unsigned char> facing(images.coverage.size(), 0);
  visitShadowRays(ShadowRayLight(source, toGlm(images.origin)),
    [&](const auto& make, float)
    {
      for (std::size_t i = 0; i < facing.size(); ++i)
      {
        facing[i] = images.coverage[i] == 1.0f &&
          make({ images.positionX[i], images.positionY[i], images.positionZ[i] },
            { images.normalX[i], images.normalY[i], images.normalZ[i] }, 0.0f)
            .traced;
      }
    });
  return facing;
}

VisibilityError measureError(const VisibilityImages& technique, const VisibilityImages& truth,
  const std::vector<SceneLight>& lights)
{
  const auto hasAllPixels = [&](const std::vector<float>& plane)
  { return plane.size() == truth.coverage.size(); };
  if (technique.width != truth.width || technique.height != truth.height ||
    technique.sceneIndices != truth.sceneIndices || technique.channels != truth.channels ||
    technique.visibility.size() != truth.visibility.size() ||
    !std::all_of(technique.visibility.begin(), technique.visibility.end(), hasAllPixels))
  {
    throw std::invalid_argument("visibility images differ in size or lights");
  }
  VisibilityError error;
  error.verdicts.assign(truth.coverage.size(), PixelVerdict::NotCounted);
  error.differences.assign(truth.coverage.size(), 0.0f);
  double sumOfAbsolutes = 0.0;
  double sumOfSquares = 0.0;
  for (std::size_t k = 0; k < truth.visibility.size(); ++k)
  {
    const std::vector<unsigned char> facing =
      facingPixels(truth, lights.at(static_cast<std::size_t>(truth.sceneIndices[k])));
    for (std::size_t i = 0; i < facing.size(); ++i)
    {
      if (!facing[i])
      {
        continue;
      }
      const float value = technique.visibility[k][i];
      // NaN counts as a full error.
      const float difference = std::isnan(value) ? -1.0f : value - truth.visibility[k][i];
      const bool isLit = difference > 0.5f;
      const bool isDark = difference < -0.5f;
      ++error.facingPixels;
      error.falseLight += isLit;
      error.falseShadow += isDark;
      error.betweenPixels +=
        value > VisibilityError::darkBelow && value < VisibilityError::litAbove;
      sumOfAbsolutes += std::fabs(difference);
      sumOfSquares += static_cast<double>(difference) * difference;
      error.differences[i] = std::max(error.differences[i], std::fabs(difference));
      error.verdicts[i] = std::max(error.verdicts[i],
        isLit      ? PixelVerdict::FalseLight
          : isDark ? PixelVerdict::FalseShadow
                   : PixelVerdict::Right);
    }
  }
  for (const ClassImage& image : technique.classes)
  {
    for (std::size_t i = 0; i < image.ofPixels.size(); ++i)
    {
      if (image.classes[image.ofPixels[i]].traced)
      {
        error.verdicts[i] = std::max(error.verdicts[i], PixelVerdict::Traced);
      }
    }
  }
  if (error.facingPixels > 0)
  {
    const auto count = static_cast<double>(error.facingPixels);
    error.meanAbsolute = sumOfAbsolutes / count;
    error.rootMeanSquare = std::sqrt(sumOfSquares / count);
  }
  return error;
}

Picture errorPicture(const Picture& picture, const std::vector<PixelVerdict>& verdicts)
{
  Picture result = picture;
  for (std::size_t i = 0; i < verdicts.size(); ++i)
  {
    unsigned char* const pixel = &result.rgb[3 * i];
    // Dimmed to grey, so only errors have colours.
    const int grey = (pixel[0] * 54 + pixel[1] * 183 + pixel[2] * 19) / 256 * 2 / 5;
    std::array<int, 3> colour = { grey, grey, grey };
    if (verdicts[i] == PixelVerdict::FalseLight)
    {
      colour = { 64, 128, 255 };
    }
    else if (verdicts[i] == PixelVerdict::FalseShadow)
    {
      colour = { 255, 48, 48 };
    }
    else if (verdicts[i] == PixelVerdict::Traced)
    {
      colour = { grey / 2 + 78, grey / 2 + 10, grey / 2 + 105 }; // shows the picture beneath
    }
    std::copy(colour.begin(), colour.end(), pixel);
  }
  return result;
}

} // namespace gnomon::tool
