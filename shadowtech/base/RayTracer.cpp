#include "shadowtech/base/RayTracer.h"

namespace gnomon
{

struct RayTracer::Impl
{
};
RayTracer::RayTracer() = default;
RayTracer::~RayTracer() = default;
RayTracer::Update RayTracer::update(const Occluders&)
{
  return {};
}
std::size_t RayTracer::trace(const ShadowLight&, const Occluders&, const ReceiverPixels& receivers,
  std::vector<float>& visibility) const
{
  visibility.assign(receivers.size(), 1.0f);
  return 0;
}
std::size_t RayTracer::bytes() const
{
  return 0;
}

} // namespace gnomon
