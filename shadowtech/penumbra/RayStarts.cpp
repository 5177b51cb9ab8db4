#include "shadowtech/penumbra/RayStarts.h"

#include <algorithm>
#include <limits>

namespace gnomon
{

void RayStarts::clear()
{
  this->starts_.clear();
  this->bounds_ = {};
}

void RayStarts::add(const glm::vec3& start)
{
  this->starts_.push_back(start);
  this->bounds_.add(glm::dvec3(start));
}

void RayStarts::finish()
{
  const std::size_t padded = (this->starts_.size() + together - 1) / together * together;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->axes_[axis].resize(padded);
    for (std::size_t i = 0; i < padded; ++i)
    {
      this->axes_[axis][i] =
        this->starts_[std::min(i, this->starts_.size() - 1)][static_cast<glm::length_t>(axis)];
    }
  }
}

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
glm::dvec2
RayStarts::behind(const EdgeTriangle& triangle) const
{
  const float *const x = this->axes_[0].data(), *const y = this->axes_[1].data(),
                     *const z = this->axes_[2].data();
  const std::size_t count = this->axes_[0].size();
  const glm::dvec3 corner(triangle.corner);
  const glm::dvec3 normal = triangle.normal;
  std::array<double, together> least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t first = 0; first < count; first += together)
  {
    for (std::size_t i = 0; i < together; ++i)
    {
      const double behind = (corner.x - static_cast<double>(x[first + i])) * normal.x +
        (corner.y - static_cast<double>(y[first + i])) * normal.y +
        (corner.z - static_cast<double>(z[first + i])) * normal.z;
      least[i] = behind < least[i] ? behind : least[i];
      most[i] = behind > most[i] ? behind : most[i];
    }
  }
  return { *std::min_element(least.begin(), least.end()),
    *std::max_element(most.begin(), most.end()) };
}

} // namespace gnomon
