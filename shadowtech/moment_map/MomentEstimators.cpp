#include "shadowtech/moment_map/MomentEstimators.h"

#include "lights/LightViews.h"

#include <cmath>

namespace gnomon
{
namespace
{

/// Return why `blur` sat is refused; empty for other blurs. It is for moments beyond the integers
/// of a summed-area table (MomentEstimator::largest is 0).
std::string refusedSums(const ShadowLight& light)
{
  return light.momentMap.blur == MapBlur::Sat ? "'" + light.estimator +
      "' has moments beyond the range of the 32-bit integers that a summed-area table holds; use "
      "'blur' box"
                                              : "";
}

std::string refusedLevels(const ShadowLight& light)
{
  const MomentMapSettings& settings = light.momentMap;
  return settings.blur == MapBlur::Sat && settings.mipMaps
    ? "a summed-area table has no levels; 'mip_maps' is for 'blur' box"
    : "";
}

/// Return the bytes per texel of all layers with their levels, their depth buffer, a layer's
/// samples, and the summed-area table or the blur's layer.
double bytesPerTexelOf(int moments, const ShadowLight& light)
{
  const MomentMapSettings& settings = light.momentMap;
  const bool summed = settings.blur == MapBlur::Sat;
  const double views = mostViews(light);
  const double layers = (summed ? 1.0 : views) * (settings.mipMaps ? 4.0 / 3.0 : 1.0);
  const double samples = settings.samples > 1 ? settings.samples : 0.0;
  const double images = moments * (layers + samples + (summed ? views : 1.0)) + 1.0;
  return images * sizeof(float);
}

/// Return the common part of the estimators' info.
TechniqueInfo infoOfMoments(const char* name, int moments)
{
  TechniqueInfo info;
  info.name = name;
  info.bytesPerTexel = [moments](const ShadowLight& light)
  { return bytesPerTexelOf(moments, light); };
  info.settings = { &viewSettings(), &kernelSettings(), &momentMapSettings() };
  info.refused = { refusedLevels };
  info.kernel = "square";
  return info;
}

} // namespace

//------------------------------------------------------------------------------
MomentEstimator singleExponential()
{
  TechniqueInfo info = infoOfMoments("single_exponential", 1);
  info.refused = { refusedSums, refusedLevels };
  return { std::move(info), 1, "shadowtech/moment_map/single_exponential_moments.glsl",
    "shadowtech/moment_map/single_exponential_estimator.glsl",
    glm::vec4(std::exp(exponentPositive), 0.0, 0.0, 0.0), glm::vec4(0.0f) };
}

//------------------------------------------------------------------------------
MomentEstimator variance()
{
  TechniqueInfo info = infoOfMoments("variance", 2);
  info.settings.push_back(&varianceSettings());
  return { std::move(info), 2, "shadowtech/moment_map/variance_moments.glsl",
    "shadowtech/moment_map/variance_estimator.glsl", glm::vec4(1.0f), { 1.0f, 2.0f, 1.0f, 1.0f } };
}

//------------------------------------------------------------------------------
MomentEstimator exponential()
{
  TechniqueInfo info = infoOfMoments("exponential", 4);
  info.settings.push_back(&varianceSettings());
  info.refused = { refusedSums, refusedLevels };
  const double positive = std::exp(exponentPositive);
  const double negative = -std::exp(-exponentNegative);
  return { std::move(info), 4, "shadowtech/moment_map/exponential_moments.glsl",
    "shadowtech/moment_map/exponential_estimator.glsl",
    glm::vec4(positive, positive * positive, negative, negative * negative), glm::vec4(0.0f) };
}

//------------------------------------------------------------------------------
MomentEstimator fourMoments()
{
  return { infoOfMoments("moments", 4), 4, "shadowtech/moment_map/four_moments.glsl",
    "shadowtech/moment_map/moments_estimator.glsl", glm::vec4(1.0f), { 1.0f, 2.0f, 4.0f, 8.0f } };
}

} // namespace gnomon
