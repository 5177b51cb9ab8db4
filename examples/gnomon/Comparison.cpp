#include "Comparison.h"

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

/// Return a unit vector; zero for a vector without length.
glm::dvec3 unitOrZero(const glm::dvec3& v)
{
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// True if a point lies in a light's box, or if the light has no box.
/// @param fromLight the point minus the light's position
bool inBox(const SceneLight& light, const glm::dvec3& axis, const glm::dvec3& fromLight)
{
  if (!light.box)
  {
    return true;
  }
  const glm::dvec3 right = unitOrZero(glm::cross(toGlm(light.box->up), axis));
  const double depth = glm::dot(fromLight, axis);
  return 2.0 * std::abs(glm::dot(fromLight, right)) <= light.box->width &&
    2.0 * std::abs(glm::dot(fromLight, glm::cross(axis, right))) <= light.box->height &&
    depth >= 0.0 && depth <= light.box->depth;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<unsigned char> facingPixels(const VisibilityImages& images, const SceneLight& light)
{
  const glm::dvec3 lightPosition =
    toGlm(light.position) - glm::dvec3(images.origin[0], images.origin[1], images.origin[2]);
  const glm::dvec3 axis = unitOrZero(toGlm(light.target) - toGlm(light.position));
  const bool directional = light.type == SceneLight::Type::Directional;
  const double cosineOfCone = std::cos(glm::radians(light.coneAngleDegrees));

  std::vector<unsigned char> facing(images.coverage.size(), 0);
  for (std::size_t i = 0; i < facing.size(); ++i)
  {
    if (images.coverage[i] != 1.0f)
    {
      continue;
    }
    const glm::dvec3 position(images.positionX[i], images.positionY[i], images.positionZ[i]);
    const glm::dvec3 normal(images.normalX[i], images.normalY[i], images.normalZ[i]);
    const glm::dvec3 toLight = directional ? -axis : unitOrZero(lightPosition - position);
    const bool reached =
      light.type != SceneLight::Type::Spot || glm::dot(-toLight, axis) >= cosineOfCone;
    facing[i] =
      reached && inBox(light, axis, position - lightPosition) && facesLight(normal, toLight);
  }
  return facing;
}

//------------------------------------------------------------------------------
VisibilityError measureError(const VisibilityImages& technique, const VisibilityImages& truth,
  const std::vector<SceneLight>& lights, std::vector<PixelVerdict>* verdicts,
  std::vector<float>* differences)
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
  std::vector<PixelVerdict> ownVerdicts;
  std::vector<float> ownDifferences;
  std::vector<PixelVerdict>& found = verdicts ? *verdicts : ownVerdicts;
  std::vector<float>& greatest = differences ? *differences : ownDifferences;
  found.assign(truth.coverage.size(), PixelVerdict::NotCounted);
  greatest.assign(truth.coverage.size(), 0.0f);
  VisibilityError error;
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
      greatest[i] = std::max(greatest[i], std::fabs(difference));
      found[i] = std::max(found[i],
        isLit      ? PixelVerdict::FalseLight
          : isDark ? PixelVerdict::FalseShadow
                   : PixelVerdict::Right);
    }
  }
  for (const ClassImage& image : technique.classes)
  {
    for (std::size_t i = 0; i < image.ofPixels.size(); ++i)
    {
      found[i] = image.classes[image.ofPixels[i]].traced ? std::max(found[i], PixelVerdict::Traced)
                                                         : found[i];
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

//------------------------------------------------------------------------------
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
