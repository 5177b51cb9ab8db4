#pragma once

#include "lights/LightArea.h"
#include "lights/LightSamples.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/depth_map/KernelPoints.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// The numbers of points of the blocker search and the filter.
struct PcssCounts
{
  int search;
  int filter;
};
inline PcssCounts pcssCounts(PcssSamples samples)
{
  static constexpr std::array<PcssCounts, 3> counts = { { { 4 * 4, 4 * 4 }, { 6 * 6, 8 * 8 },
    { 8 * 8, 16 * 16 } } };
  return counts[static_cast<std::size_t>(samples)];
}

/// Return these numbers for shaders: PCSS_SEARCH_POINTS_LIGHT and PCSS_FILTER_POINTS_LIGHT.
inline std::string pcssCountsDefines(PcssSamples samples)
{
  const PcssCounts counts = pcssCounts(samples);
  return glslDefine("PCSS_SEARCH_POINTS_LIGHT", counts.search) +
    glslDefine("PCSS_FILTER_POINTS_LIGHT", counts.filter);
}

/// Return the points of both steps, one after the other, on the shape of radius or half side 1:
/// Poisson sets (poissonSquare()), mapped to disks by the concentric map.
inline std::vector<glm::vec2> pcssPoints(PcssSamples samples, LightArea::Shape shape)
{
  const PcssCounts counts = pcssCounts(samples);
  std::vector<glm::vec2> points;
  for (const int count : { counts.search, counts.filter })
  {
    for (const glm::dvec2& point : poissonSquare(count))
    {
      points.push_back(
        shape == LightArea::Shape::Rectangle ? glm::vec2(point) : diskPoint(glm::vec2(point)));
    }
  }
  return points;
}

/// The points of pcssPoints() on the GPU: one row of a texture, the shaders' `lightPoints_LIGHT`.
class PcssPoints
{
public:
  /// Upload the points.
  /// @throws TextureMemoryError
  void upload(PcssSamples samples, LightArea::Shape shape)
  {
    const GlStateGuard guard;
    const std::vector<glm::vec2> points = pcssPoints(samples, shape);
    const int count = static_cast<int>(points.size());
    this->texture_.allocate({ GL_RG32F, GL_RG, 2 }, count, 1, 0, "points of a light");
    glBindTexture(GL_TEXTURE_2D, this->texture_.name());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, count, 1, GL_RG, GL_FLOAT, points.data());
  }

  void release() { this->texture_.reset(); }
  Uniform uniform() const
  {
    return { "lightPoints_LIGHT", TextureBinding{ GL_TEXTURE_2D, this->texture_.name() } };
  }

  std::size_t bytes() const { return this->texture_.bytes(); }

private:
  SizedTexture texture_;
};

} // namespace gnomon
