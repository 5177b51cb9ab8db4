#pragma once

#include "shadowtech/base/SmoothFacet.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// What rays meet first of the casting triangles, with holes skipped and both sides counted.
struct FirstHits
{
  std::vector<float> distance; ///< in lengths of the ray's direction; infinite: nothing is met
  std::vector<glm::vec3> normalCentred; ///< of the triangle, of any length, on either side
  std::vector<std::uint32_t> surface;   ///< Occluders::surfaces index
};

/// Who finds them.
class FirstHitFinder
{
public:
  virtual ~FirstHitFinder() = default;
  /// @param origins, directions `count` each, centred; directions of any length
  /// @param hits resized
  virtual void find(std::size_t count, const PointArrays& origins, const PointArrays& directions,
    FirstHits& hits) const = 0;
};

} // namespace gnomon
