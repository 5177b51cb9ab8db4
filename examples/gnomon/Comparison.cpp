#include "Comparison.h"

#include "shadowtech/base/ShadowRay.h"

#include <glm/glm.hpp>

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

void requireSameImages(const VisibilityImages& technique, const VisibilityImages& truth)
{
  const std::size_t pixelCount =
    static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  if (technique.width != truth.width || technique.height != truth.height)
  {
    throw std::invalid_argument("visibility images of different sizes cannot be compared");
  }
  if (technique.sceneIndices != truth.sceneIndices || technique.channels != truth.channels)
  {
    throw std::invalid_argument("visibility images of different lights cannot be compared");
  }
  for (const VisibilityImages* images : { &technique, &truth })
  {
    if (images->visibility.size() != images->sceneIndices.size())
    {
      throw std::invalid_argument("visibility images do not have one image per light");
    }
    for (const std::vector<float>& plane : images->visibility)
    {
      if (plane.size() != pixelCount)
      {
        throw std::invalid_argument("visibility images do not have one value per pixel");
      }
    }
  }
}

/// Append the names of numbers that the list lacks.
template <typename Number>
void addNames(
  const std::vector<std::pair<std::string, Number>>& numbers, std::vector<std::string>& names)
{
  for (const auto& [name, number] : numbers)
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  }
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
  requireSameImages(technique, truth);
  if (differences)
  {
    differences->assign(truth.coverage.size(), 0.0f);
  }
  if (verdicts)
  {
    verdicts->assign(truth.coverage.size(), PixelVerdict::NotCounted);
  }
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
      PixelVerdict verdict = PixelVerdict::Right;
      ++error.facingPixels;
      if (difference > 0.5f)
      {
        ++error.falseLight;
        verdict = PixelVerdict::FalseLight;
      }
      else if (difference < -0.5f)
      {
        ++error.falseShadow;
        verdict = PixelVerdict::FalseShadow;
      }
      error.betweenPixels +=
        value > VisibilityError::darkBelow && value < VisibilityError::litAbove;
      sumOfAbsolutes += std::fabs(difference);
      sumOfSquares += static_cast<double>(difference) * difference;
      if (differences)
      {
        (*differences)[i] = std::max((*differences)[i], std::fabs(difference));
      }
      if (verdicts)
      {
        (*verdicts)[i] = std::max((*verdicts)[i], verdict);
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

//------------------------------------------------------------------------------
std::vector<unsigned char> tracedMask(const VisibilityImages& images)
{
  std::vector<unsigned char> traced(images.coverage.size(), 0);
  for (const ClassImage& image : images.classes)
  {
    for (std::size_t i = 0; i < image.ofPixels.size(); ++i)
    {
      traced[i] |= image.classes[image.ofPixels[i]].traced ? 1 : 0;
    }
  }
  return traced;
}

//------------------------------------------------------------------------------
Picture errorPicture(const Picture& picture, const std::vector<PixelVerdict>& verdicts,
  const std::vector<unsigned char>* traced)
{
  if (verdicts.size() != picture.pixelCount() || (traced && traced->size() != verdicts.size()))
  {
    throw std::invalid_argument("a picture and its errors have different sizes");
  }
  Picture result = picture;
  for (std::size_t i = 0; i < verdicts.size(); ++i)
  {
    unsigned char* const pixel = &result.rgb[3 * i];
    const auto paint = [pixel](unsigned char red, unsigned char green, unsigned char blue)
    {
      pixel[0] = red;
      pixel[1] = green;
      pixel[2] = blue;
    };
    // Dimmed to grey, so only errors have colours.
    const auto grey =
      static_cast<unsigned char>((pixel[0] * 54 + pixel[1] * 183 + pixel[2] * 19) / 256 * 2 / 5);
    if (verdicts[i] == PixelVerdict::FalseLight)
    {
      paint(64, 128, 255);
    }
    else if (verdicts[i] == PixelVerdict::FalseShadow)
    {
      paint(255, 48, 48);
    }
    else if (traced && (*traced)[i])
    {
      // The picture stays visible, as whole regions may be traced.
      paint(static_cast<unsigned char>(grey / 2 + 78), static_cast<unsigned char>(grey / 2 + 10),
        static_cast<unsigned char>(grey / 2 + 105));
    }
    else
    {
      paint(grey, grey, grey);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
const char* motionName(Motion motion)
{
  static constexpr std::array names = { "static", "camera moving", "light moving" };
  return names[static_cast<std::size_t>(motion)];
}

//------------------------------------------------------------------------------
std::string motionKey(Motion motion)
{
  std::string key = motionName(motion);
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

//------------------------------------------------------------------------------
std::vector<Motion> timedMotions(const ComparisonResults& results)
{
  return results.frames > 0 ? std::vector<Motion>(allMotions.begin(), allMotions.end())
                            : std::vector<Motion>();
}

//------------------------------------------------------------------------------
std::vector<std::string> classNames(const ComparisonResults& results)
{
  std::vector<std::string> names;
  for (const VariantResult& variant : results.variants)
  {
    addNames(variant.classes, names);
  }
  return names;
}

//------------------------------------------------------------------------------
std::vector<std::string> stageNames(
  const ComparisonResults& results, const std::vector<Motion>& motions)
{
  std::vector<std::string> names;
  for (const VariantResult& variant : results.variants)
  {
    for (const Motion motion : motions)
    {
      addNames(variant.timings[static_cast<std::size_t>(motion)].stages, names);
    }
  }
  return names;
}

} // namespace gnomon::tool
