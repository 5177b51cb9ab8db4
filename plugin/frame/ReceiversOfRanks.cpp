#include "plugin/frame/ReceiversOnCpu.h"
#include "shadowtech/base/SeenTriangle.h"

#include <iterator>
#include <set>

namespace gnomon
{

ReceiversOfRanks::ReceiversOfRanks(Frame& frame, const OccluderCollector& collector,
  const std::vector<SurfaceName>& names, SharedPatches& patches)
  : ReceiversOnCpu(frame, collector, names)
  , patches_(patches)
{
}

/// Surfaces of several ranks have no names that all know.
const std::vector<SurfaceName>& ReceiversOfRanks::names() const
{
  static const std::vector<SurfaceName> none;
  return none;
}

SharedReceivers& ReceiversOfRanks::shared()
{
  ReceiversValue& value = this->frame_.view->receivers;
  if (!value.shared.areShared())
  {
    this->readImages();
    std::vector<float> depths;
    value.target.readDepths(depths);
    this->frame_.endStage("visibility: read receivers");
    keepNearest(*this->frame_.ranks, depths, value.images.fragments);
    this->frame_.endStage("visibility: nearest");
    Receivers own(
      value.images, value.drawnSurfaces, this->collector_.occluders(), value.pixels, true);
    const ReceiverPixels& pixels = own.all();
    this->frame_.endStage("visibility: own receivers");
    this->share(pixels, value.shared);
    this->frame_.endStage("visibility: share receivers");
  }
  return value.shared;
}

/// Share some receivers of this process, and the curves above them.
void ReceiversOfRanks::share(const ReceiverPixels& own, SharedReceivers& shared)
{
  Ranks& ranks = *this->frame_.ranks;
  const Occluders& occluders = this->collector_.occluders();
  std::vector<SharedName> names;
  for (const SurfaceName& name : this->names_)
  {
    names.push_back(name.shared);
  }
  shared.share(ranks, own, occluders);
  if (this->patches_.update(ranks, occluders, names, own))
  {
    shared.shareCurves(ranks, own, occluders, this->patches_.names());
  }
}

void ReceiversOfRanks::prepare()
{
  ReceiversValue& value = this->frame_.view->receivers;
  value.boxes.reset(); // other processes' casters would reach their tiles, too
  SharedReceivers& shared = this->shared();
  if (smoothsEdges(this->frame_.lights) && shared.surfaceOfPixel().empty())
  {
    std::vector<SharedName> own;
    for (const DrawnSurface& drawn : value.drawnSurfaces)
    {
      own.push_back(this->names_[drawn.blocks.front().surface].shared);
    }
    Ranks::Gathered<SharedName> all;
    this->frame_.ranks->gather(own, all);
    const std::set<SharedName> different(all.elements.begin(), all.elements.end());
    std::vector<std::size_t> numbers;
    for (const SharedName& name : own)
    {
      numbers.push_back(
        static_cast<std::size_t>(std::distance(different.begin(), different.find(name))));
    }
    shared.shareSurfaces(*this->frame_.ranks, value.images.fragments, numbers);
    this->frame_.endStage("visibility: share surfaces");
  }
}

void ReceiversOfRanks::smoothEdges(const std::function<void(const SharedPicture* several)>& smooth)
{
  Ranks& ranks = *this->frame_.ranks;
  const ReceiversValue& value = this->frame_.view->receivers;
  const Drawn drawn(value.images, value.drawnSurfaces, this->collector_.occluders(), nullptr, true);
  const SharedPicture several{ drawn, value.shared.surfaceOfPixel(), value.shared.pixels(),
    [&ranks](std::vector<float>& numbers) { ranks.reduceToLeast(numbers); },
    [this](const ReceiverPixels& own) -> const ReceiverPixels&
    {
      this->share(own, this->samples_);
      return this->samples_.pixels();
    },
    [&ranks](std::vector<std::uint64_t>& bits) { ranks.uniteBits(bits); } };
  smooth(&several);
}

} // namespace gnomon
