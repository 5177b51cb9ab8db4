#pragma once

#include "lights/LightViews.h"
#include "shadowtech/moment_map/MomentMapTechnique.h"

#include <cmath>

namespace gnomon
{

/// Return why `blur` sat is refused; empty for other blurs. It is for moments beyond the integers
/// of a summed-area table (MomentEstimator::largest is 0).
inline std::string refusedSums(const ShadowLight& light)
{
  return light.momentMap.blur == MapBlur::Sat ? "'" + light.estimator +
      "' has moments beyond the range of the 32-bit integers that a summed-area table holds; use "
      "'blur' box"
                                              : "";
}

inline std::string refusedLevels(const ShadowLight& light)
{
  const MomentMapSettings& settings = light.momentMap;
  return settings.blur == MapBlur::Sat && settings.mipMaps
    ? "a summed-area table has no levels; 'mip_maps' is for 'blur' box"
    : "";
}

/// Return the bytes per texel of all layers with their levels, their depth buffer, a layer's
/// samples, and the summed-area table or the blur's layer.
inline double bytesPerTexelOf(int moments, const ShadowLight& light)
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
inline TechniqueInfo infoOfMoments(const char* name, int moments)
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

///@{
/// Factors of depths in exponents, as in exponential_warps.glsl. `single_exponential` uses the
/// positive one.
constexpr double exponentPositive = 40.0;
constexpr double exponentNegative = 5.0;
///@}

// docs/theory/moment_maps.md says what each bounds, and where receivers are compared on slopes.

/// `single_exponential`: exponential shadow maps with one moment, as in vtkShadowMapPass (Annen,
/// Mertens, Seidel, Flerackers and Kautz 2008, "Exponential Shadow Maps", section 3). Light leaks
/// at contacts, within a few percent of the map's depth range.
inline MomentEstimator singleExponential()
{
  TechniqueInfo info = infoOfMoments("single_exponential", 1);
  info.refused = { refusedSums, refusedLevels };
  return { std::move(info), 1, "shadowtech/moment_map/single_exponential_moments.glsl",
    "shadowtech/moment_map/single_exponential_estimator.glsl",
    glm::vec4(std::exp(exponentPositive), 0.0, 0.0, 0.0), glm::vec4(0.0f) };
}

/// `variance`: variance shadow maps (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). The
/// bound is exact if one plane shadows another, both across the light. If a third plane lies
/// between them, light bleeds through it. Bounds below the setting `bleeding` count as shadow.
///
/// **The variance's floor.** On a flat part of the map, the receiver's depth z and the mean differ
/// by rounding. The difference d is less than 2^-20 of the depth range (CasterDrawing.h). A
/// visibility above 0.99 needs a variance of 99 d^2, or 1e-10. Rounding of a variance of 0, up to
/// 2^-23 of [-1, 1] squared, only adds light. So a point is half lit at most as far behind its
/// caster as the root of the floor. For the default of 1e-6, that is 0.1 % of the depth range.
inline MomentEstimator variance()
{
  TechniqueInfo info = infoOfMoments("variance", 2);
  info.settings.push_back(&varianceSettings());
  return { std::move(info), 2, "shadowtech/moment_map/variance_moments.glsl",
    "shadowtech/moment_map/variance_estimator.glsl", glm::vec4(1.0f), { 1.0f, 2.0f, 1.0f, 1.0f } };
}

/// `exponential`: exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance
/// Shadow Maps", section 7): variance shadow maps of two functions of depth, exp(c d) and -exp(-c
/// d), of which the lesser bound counts. The first shrinks depths near the light, so less light
/// bleeds through. The second bounds light that the first lets through where a receiver's own
/// depths differ within the kernel.
///
/// **No exponent overflows.** For d in [-1, 1] the largest number is the first function's mean
/// square, exp(2 c) with c = 40, and twice that on slopes: 1e35. Float ends at 3e38, and c at 44.
/// The second function needs a smaller c only, and a larger one darkens slopes.
inline MomentEstimator exponential()
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

/// `moments`: moment shadow maps with four moments in 32-bit floats (Peters and Klein 2015, "Moment
/// Shadow Mapping"). The bound is the sharpest that four moments allow, so an occluder before
/// another one lets no light through.
inline MomentEstimator fourMoments()
{
  return { infoOfMoments("moments", 4), 4, "shadowtech/moment_map/four_moments.glsl",
    "shadowtech/moment_map/moments_estimator.glsl", glm::vec4(1.0f), { 1.0f, 2.0f, 4.0f, 8.0f } };
}

} // namespace gnomon
