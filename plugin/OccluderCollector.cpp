#include "plugin/OccluderCollector.h"

namespace gnomon
{

struct OccluderCollector::Impl
{
  Occluders occluders;
  std::vector<DrawnSurface> drawn;
};
OccluderCollector::OccluderCollector() : impl_(new Impl) {}
OccluderCollector::~OccluderCollector() = default;
OccluderCollector::Change OccluderCollector::collect(vtkRenderer*) { return {}; }
const Occluders& OccluderCollector::occluders() const { return impl_->occluders; }
OccluderCollector::Drawn OccluderCollector::drawn(vtkAbstractMapper*, vtkProp*) { return {}; }
const std::vector<DrawnSurface>& OccluderCollector::drawnSurfaces() const { return impl_->drawn; }

} // namespace gnomon
