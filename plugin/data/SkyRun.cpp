#include "plugin/data/SkyRun.h"

#include "plugin/data/VisibilityRun.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon
{
/// The rays of an element.
struct SkyRun::Rays
{
  std::array<std::vector<float>, 3> origins;
  std::array<std::vector<float>, 3> directions;
  std::vector<std::uint8_t> blocked;

  explicit Rays(std::size_t count)
    : blocked(count)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->origins[axis].resize(count);
      this->directions[axis].resize(count);
    }
  }
  void set(std::size_t i, const glm::vec3& origin, const glm::vec3& direction)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->origins[axis][i] = origin[static_cast<glm::length_t>(axis)];
      this->directions[axis][i] = direction[static_cast<glm::length_t>(axis)];
    }
  }
};

//------------------------------------------------------------------------------
SkyRun::SkyRun(const ReceiverStarts& starts, const EmbreeTracer& tracer, const Sky& sky,
  int directions, bool bothSides, const Arrays& arrays)
  : receivers_(starts)
  , tracer_(tracer)
  , sky_(sky)
  , directions_(directions)
  , bothSides_(bothSides)
  , arrays_(arrays)
  , order_(starts.order())
{
}

//------------------------------------------------------------------------------
std::uint64_t SkyRun::rays() const
{
  return std::uint64_t(this->done_) * static_cast<std::uint64_t>(this->directions_.count()) *
    (this->bothSides_ ? 2 : 1);
}

//------------------------------------------------------------------------------
bool SkyRun::go(const std::function<bool(double)>& goOn)
{
  const auto count = static_cast<std::size_t>(this->directions_.count());
  while (this->done_ < this->order_.size())
  {
    const std::size_t end =
      std::min(this->done_ + std::max<std::size_t>(1, raysOfPart / count), this->order_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(this->done_, end, 4),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        SampleStarts starts; // their memory and the rays' is shared
        Rays rays(count);
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          this->see(this->order_[i], starts, rays);
        }
      });
    this->done_ = end;
    if (!goOn(static_cast<double>(end) / static_cast<double>(this->order_.size())) &&
      end < this->order_.size())
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void SkyRun::see(std::size_t element, SampleStarts& starts, Rays& rays) const
{
  starts.clear();
  this->receivers_.append(element, starts);
  this->arrays_.view[element] = -1.0f;
  for (const float side : { 1.0f, -1.0f })
  {
    double open = 0.0;
    for (const glm::vec3& normal : starts.normal)
    {
      open += openView(this->sky_, side * normal) / static_cast<double>(starts.normal.size());
    }
    const SkySums sums = this->trace(element, starts, side, rays);
    const auto view = static_cast<float>(sums.view(open));
    if (view > this->arrays_.view[element])
    {
      this->arrays_.view[element] = view;
      this->arrays_.error[element] = static_cast<float>(sums.error(open));
    }
    if (!this->bothSides_)
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
/// Trace an element's rays, each from one of its starts by chance.
SkySums SkyRun::trace(std::size_t element, const SampleStarts& starts, float side, Rays& rays) const
{
  const SamplePixel pixel = pixelOf(this->directions_.points(), element);
  const int count = this->directions_.count();
  glm::mat3 rotation(1.0f);
  std::size_t from = starts.normal.size(); // none
  for (int i = 0; i < count; ++i)
  {
    const std::size_t chosen =
      std::uint64_t(this->directions_.chance(i, pixel)) * starts.normal.size() >> 32;
    const glm::vec3 normal = side * starts.normal[chosen];
    if (chosen != from)
    {
      from = chosen;
      rotation = rotationFromZ(normal);
    }
    rays.set(static_cast<std::size_t>(i), starts.position[chosen] + starts.offset[chosen] * normal,
      rotation * this->directions_.local(i, pixel));
  }
  const auto arrays = [](const std::array<std::vector<float>, 3>& of) {
    return PointArrays{ of[0].data(), of[1].data(), of[2].data() };
  };
  this->tracer_.areBlocked(static_cast<std::size_t>(count), arrays(rays.origins),
    arrays(rays.directions), this->sky_.farthest, rays.blocked.data());
  SkySums sums;
  for (int i = 0; i < count; ++i)
  {
    const auto ray = static_cast<std::size_t>(i);
    const glm::vec3 direction(
      rays.directions[0][ray], rays.directions[1][ray], rays.directions[2][ray]);
    sums.add(
      this->directions_.batchOf(i), radianceOf(this->sky_, direction), rays.blocked[ray] == 0);
  }
  return sums;
}

} // namespace gnomon
