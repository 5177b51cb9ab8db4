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

struct TurnAndMirror
{
  glm::dvec2 turn;
  glm::dvec2 mirror;
};

TurnAndMirror partsOf(const glm::dmat2& matrix)
{
  return { 0.5 * glm::dvec2(matrix[0].x + matrix[1].y, matrix[0].y - matrix[1].x),
    0.5 * glm::dvec2(matrix[0].x - matrix[1].y, matrix[0].y + matrix[1].x) };
}

} // namespace

//------------------------------------------------------------------------------
glm::dmat2 texelJacobian(const glm::dmat3& texelFromAcross, const glm::dvec2& across)
{
  const glm::dvec3 image = texelFromAcross * glm::dvec3(across, 1.0);
  const glm::dvec2 texel = glm::dvec2(image) / image.z;
  const auto column = [&](int i)
  { return (glm::dvec2(texelFromAcross[i]) - texel * texelFromAcross[i].z) / image.z; };
  return { column(0), column(1) };
}

//------------------------------------------------------------------------------
glm::dmat2 evenShape(const glm::dmat2& jacobian, double largestStretch)
{
  auto [turn, mirror] = partsOf(jacobian);
  const double turned = glm::length(turn);
  const double mirrored = glm::length(mirror);
  const double least = std::max(turned - mirrored, 1e-12 * turned);
  const double stretch = std::min(std::sqrt((turned + mirrored) / least), largestStretch);
  turn *= 0.5 * (stretch + 1.0 / stretch) / turned;
  mirror *= mirrored > 0.0 ? 0.5 * (stretch - 1.0 / stretch) / mirrored : 0.0;
  return { turn.x + mirror.x, turn.y + mirror.y, mirror.y - turn.y, turn.x - mirror.x };
}

//------------------------------------------------------------------------------
double largestStretch(int kernelTexels)
{
  return std::min(0.5 * (kernelTexels + 1), 4.0);
}

//------------------------------------------------------------------------------
double mostTexelsAcross(const LightViews& views, int sizeTexels)
{
  double most = 0.0;
  for (const LightView& view : views.views)
  {
    const glm::dmat3 acrossFromMap = glm::inverse(view.mapFromAcross);
    for (const glm::dvec2& corner : mapCorners)
    {
      const TurnAndMirror parts =
        partsOf(texelJacobian(texelFromAcross(view, sizeTexels), mapped(acrossFromMap, corner)));
      most = std::max(most, glm::length(parts.turn) + glm::length(parts.mirror));
    }
  }
  return most;
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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
