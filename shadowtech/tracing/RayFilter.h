#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon
{

struct Occluders;
class Receivers;
struct ShadowLight;

/// Casters that let a part of the light through, beside those that block it.
class RayFilter
{
public:
  virtual ~RayFilter() = default;

  /// True if the channels of transmittanceOf() may differ.
  virtual bool isColoured() const = 0;

  /// Return the share of light, by channel, that such casters leave of a ray. Called from several
  /// threads at once.
  /// @param origin, direction centred; the origin in the box around the snapshot
  /// (Occluders::allCentred), the direction of any length but 0
  /// @param rayFar far end of the ray, in lengths of its direction (ShadowRay.h)
  virtual glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const = 0;
};

/// Several filters, each of which leaves its share.
class RayFilters : public RayFilter
{
public:
  /// @param filters none null; they must outlive this
  explicit RayFilters(std::vector<const RayFilter*> filters)
    : filters_(std::move(filters))
  {
  }
  bool isColoured() const override
  {
    return std::any_of(this->filters_.begin(), this->filters_.end(),
      [](const RayFilter* filter) { return filter->isColoured(); });
  }
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const override
  {
    glm::dvec3 left(1.0);
    for (const RayFilter* const filter : this->filters_)
    {
      left *= filter->transmittanceOf(origin, direction, rayFar);
    }
    return left;
  }

private:
  std::vector<const RayFilter*> filters_;
};

/// Multiply a picture's visibility by what a filter leaves of each pixel's shadow ray to the
/// light's centre. Only rays of pixels that are not dark are asked.
/// @param visibility one value per pixel of the picture. With a coloured filter it becomes three
/// images, one after the other
/// @return the number of rays
std::size_t scaleByFilter(const RayFilter& filter, const ShadowLight& light,
  const Occluders& occluders, const Receivers& receivers, std::vector<float>& visibility);

} // namespace gnomon
