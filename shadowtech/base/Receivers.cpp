#include "shadowtech/base/Receivers.h"

namespace gnomon
{

void projectReceivers(const ReceiverImages& images, const std::vector<DrawnSurface>&,
  const Occluders&, ReceiverPixels& receivers)
{
  receivers.resize(images.width, images.height);
}

} // namespace gnomon
