#include "plugin/frame/ReceiversOnCpu.h"

namespace gnomon
{

ReceiversOnCpu::ReceiversOnCpu(
  Frame& frame, const OccluderCollector& collector, const std::vector<SurfaceName>& names)
  : frame_(frame)
  , collector_(collector)
  , names_(names)
{
}

/// Read back what VTK drew.
void ReceiversOnCpu::readImages()
{
  ReceiversValue& value = this->frame_.view->receivers;
  value.images.rays = pixelRays(this->frame_.camera.clipFromView,
    this->frame_.space.centredFromView, this->frame_.size.x, this->frame_.size.y);
  if (this->frame_.route() == Route::Deferred)
  {
    value.deferred.read(value.images);
  }
  else
  {
    value.target.read(value.images);
  }
}

} // namespace gnomon
