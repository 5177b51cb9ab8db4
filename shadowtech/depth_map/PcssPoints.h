#ifndef gnomon_shadowtech_depth_map_PcssPoints_h
#define gnomon_shadowtech_depth_map_PcssPoints_h

#include "lights/LightArea.h"
#include "lights/ShadowSettings.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// How many points the blocker search and the filter take.
struct PcssCounts
{
  int search;
  int filter;
};
PcssCounts pcssCounts(PcssSamples samples);

/// The same for shaders: PCSS_SEARCH_POINTS_LIGHT and PCSS_FILTER_POINTS_LIGHT.
std::string pcssCountsDefines(PcssSamples samples);

/// The points of both steps, one after the other, on the shape of radius or half side 1: Poisson sets (PoissonSquare.h), on
/// disks by the concentric map.
std::vector<glm::vec2> pcssPoints(PcssSamples samples, LightArea::Shape shape);

/// These points on the GPU: one row of a texture, the shaders' `lightPoints_LIGHT`.
class PcssPoints
{
public:
  void upload(PcssSamples samples, LightArea::Shape shape);
  void release();
  Uniform uniform() const;
  std::size_t bytes() const { return this->bytes_; }

private:
  GlTexture texture_;
  std::size_t bytes_ = 0;
};

} // namespace gnomon

#endif
