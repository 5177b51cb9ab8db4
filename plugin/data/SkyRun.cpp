#include "plugin/data/SkyRun.h"

#include "plugin/data/VisibilityTile.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon
{

/// A thread's memory, shared by its elements.
struct SkyRun::Scratch
{
  SampleStarts starts;
  std::vector<std::uint8_t> isFree; ///< by direction
  std::vector<float> radiance;      ///< likewise
};

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

std::uint64_t SkyRun::rays() const
{
  return std::uint64_t(this->done_) * static_cast<std::uint64_t>(this->directions_.count()) *
    (this->bothSides_ ? 2 : 1);
}

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
        Scratch scratch;
        scratch.radiance.resize(count);
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          this->see(this->order_[i], scratch);
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

void SkyRun::see(std::size_t element, Scratch& scratch) const
{
  SampleStarts& starts = scratch.starts;
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
    const SkySums sums = this->trace(element, side, scratch);
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

/// Trace an element's rays, each from one of its starts by chance.
SkySums SkyRun::trace(std::size_t element, float side, Scratch& scratch) const
{
  const SampleStarts& starts = scratch.starts;
  const SamplePixel pixel = pixelOf(this->directions_.points(), element);
  const int count = this->directions_.count();
  scratch.isFree.assign(static_cast<std::size_t>(count), 0);
  WaitingRays rays(this->tracer_, scratch.isFree.data());
  rays.setFar(this->sky_.farthest);
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
    const glm::vec3 direction = rotation * this->directions_.local(i, pixel);
    const auto number = static_cast<std::size_t>(i);
    rays.add({ starts.position[chosen] + starts.offset[chosen] * normal, direction, true }, number);
    scratch.radiance[number] = radianceOf(this->sky_, direction);
  }
  rays.flush();
  SkySums sums;
  for (int i = 0; i < count; ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    sums.add(this->directions_.batchOf(i), scratch.radiance[number], scratch.isFree[number] != 0);
  }
  return sums;
}

} // namespace gnomon
