#include "shadowtech/depth_map/PcssPoints.h"

#include "lights/LightSamples.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/depth_map/KernelPoints.h"

#include <array>

namespace gnomon
{

//------------------------------------------------------------------------------
PcssCounts pcssCounts(PcssSamples samples)
{
  static constexpr std::array<PcssCounts, 3> counts = { { { 4 * 4, 4 * 4 }, { 6 * 6, 8 * 8 },
    { 8 * 8, 16 * 16 } } };
  return counts[static_cast<std::size_t>(samples)];
}

//------------------------------------------------------------------------------
std::string pcssCountsDefines(PcssSamples samples)
{
  const PcssCounts counts = pcssCounts(samples);
  return glslDefine("PCSS_SEARCH_POINTS_LIGHT", counts.search) +
    glslDefine("PCSS_FILTER_POINTS_LIGHT", counts.filter);
}

//------------------------------------------------------------------------------
std::vector<glm::vec2> pcssPoints(PcssSamples samples, LightArea::Shape shape)
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

//------------------------------------------------------------------------------
void PcssPoints::upload(PcssSamples samples, LightArea::Shape shape)
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

//------------------------------------------------------------------------------
Uniform PcssPoints::uniform() const
{
  return { "lightPoints_LIGHT", TextureBinding{ GL_TEXTURE_2D, this->texture_.name() } };
}

} // namespace gnomon
