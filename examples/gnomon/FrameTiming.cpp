#include "FrameTiming.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
double median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

//------------------------------------------------------------------------------
std::vector<double> timeFrames(const std::vector<FrameVariant*>& variants, Motion motion,
  int frames, const std::function<void()>& roundDone)
{
  std::vector<std::vector<double>> times(variants.size());
  for (int frame = -warmUpFrames; frame < frames; ++frame)
  {
    for (std::size_t i = 0; i < variants.size(); ++i)
    {
      const double milliseconds = variants[i]->drawFrame(motion, frame + warmUpFrames + 1);
      if (frame >= 0)
      {
        times[i].push_back(milliseconds);
      }
    }
    roundDone();
  }
  std::vector<double> medians(variants.size());
  std::transform(times.begin(), times.end(), medians.begin(), median);
  return medians;
}

} // namespace gnomon::tool
