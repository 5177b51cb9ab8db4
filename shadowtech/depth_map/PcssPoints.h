#pragma once

#include "lights/LightArea.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

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
/// Return the numbers of points of a quality.
PcssCounts pcssCounts(PcssSamples samples);

/// Return these numbers for shaders: PCSS_SEARCH_POINTS_LIGHT and PCSS_FILTER_POINTS_LIGHT.
std::string pcssCountsDefines(PcssSamples samples);

/// Return the points of both steps, one after the other, on the shape of radius or half side 1:
/// Poisson sets (poissonSquare()), mapped to disks by the concentric map.
std::vector<glm::vec2> pcssPoints(PcssSamples samples, LightArea::Shape shape);

/// The points of pcssPoints() on the GPU: one row of a texture, the shaders' `lightPoints_LIGHT`.
class PcssPoints
{
public:
  /// Upload the points.
  /// @throws TextureMemoryError
  void upload(PcssSamples samples, LightArea::Shape shape);
  /// Free the texture.
  void release() { this->texture_.reset(); }
  /// Return the uniform of the texture.
  Uniform uniform() const;
  std::size_t bytes() const { return this->texture_.bytes(); }

private:
  SizedTexture texture_;
};

} // namespace gnomon
