#include "plugin/frame/Frame.h"

#include "shadowtech/base/Gl.h"

namespace gnomon
{

void Frame::endStage(const std::string& name)
{
  if (this->wishes.measureStages)
  {
    glFinish();
    this->counts.stages.push_back({ name, steadyMilliseconds() - this->stageStart });
    this->stageStart = steadyMilliseconds();
  }
}

void Frame::noteReuse(const std::string& value, const std::string& changes)
{
  this->counts.values.push_back({ value, changes.empty(), changes });
}

} // namespace gnomon
