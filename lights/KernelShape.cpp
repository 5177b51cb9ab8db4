#include "lights/KernelShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

constexpr std::array<glm::dvec2, 4> mapCorners = { glm::dvec2(-1.0, -1.0), { 1.0, -1.0 },
  { -1.0, 1.0 }, { 1.0, 1.0 } };

/// Return the larger singular value: a 2 x 2 matrix is the sum of a scaled rotation and a scaled
/// reflection, and their scales are half the sum and half the difference of the singular values.
double largestSingularValue(const glm::dmat2& matrix)
{
  return 0.5 *
    (glm::length(glm::dvec2(matrix[0].x + matrix[1].y, matrix[0].y - matrix[1].x)) +
      glm::length(glm::dvec2(matrix[0].x - matrix[1].y, matrix[0].y + matrix[1].x)));
}

} // namespace

glm::dmat2 texelJacobian(const glm::dmat3& texelFromAcross, const glm::dvec2& across)
{
  const glm::dvec3 image = texelFromAcross * glm::dvec3(across, 1.0);
  const glm::dvec2 texel = glm::dvec2(image) / image.z;
  const auto column = [&](int i)
  { return (glm::dvec2(texelFromAcross[i]) - texel * texelFromAcross[i].z) / image.z; };
  return { column(0), column(1) };
}

double largestStretch(int kernelTexels)
{
  return std::min(0.5 * (kernelTexels + 1), 4.0);
}

double mostTexelsAcross(const LightViews& views, int sizeTexels)
{
  double most = 0.0;
  for (const LightView& view : views.views)
  {
    const glm::dmat3 acrossFromMap = glm::inverse(view.mapFromAcross);
    for (const glm::dvec2& corner : mapCorners)
    {
      most = std::max(most,
        largestSingularValue(
          texelJacobian(texelFromAcross(view, sizeTexels), mapped(acrossFromMap, corner))));
    }
  }
  return most;
}

double reachOfArea(const LightArea& area, const LightViews& views, const Bounds& castersCentred,
  const Bounds& receiversCentred)
{
  const glm::dvec3 lightCentred(glm::inverse(views.lightFromCentred)[3]);
  const double clearance = glm::distance(
    lightCentred, glm::clamp(lightCentred, castersCentred.lower, castersCentred.upper));
  double widest = 0.0;
  for (const LightView& view : views.views)
  {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : receiversCentred.corners())
    {
      farthest = std::max(farthest, (view.rays.viewFromCentred * glm::dvec4(corner, 1.0)).z);
    }
    // A cube's face may see the casters' box from the face's plane on, but nothing nearer than the
    // box.
    const double longest = longestRay(view);
    const double nearest = view.rays.positional ? std::max(view.beginsAt, clearance / longest)
                                                : -view.depthOffset / view.depthScale;
    if (nearest < farthest)
    {
      const double slant = views.layout == ViewLayout::Cube ? longest : 1.0;
      widest = std::max(widest,
        view.rays.positional ? slant * (1.0 / nearest - 1.0 / farthest) : farthest - nearest);
    }
  }
  return area.radius() * widest;
}

double longestRay(const LightView& view)
{
  const glm::dmat3 acrossFromMap = glm::inverse(view.mapFromAcross);
  double longest = 1.0;
  for (const glm::dvec2& corner : mapCorners)
  {
    longest = std::max(longest, glm::length(glm::dvec3(mapped(acrossFromMap, corner), 1.0)));
  }
  return longest;
}

} // namespace gnomon
