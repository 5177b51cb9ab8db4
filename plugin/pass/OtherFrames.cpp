#include "plugin/pass/OtherFrames.h"

#include <vtkCommand.h>
#include <vtkRenderer.h>

#include <utility>

namespace gnomon
{

OtherFrames::OtherFrames(std::function<void(vtkRenderer*)> tell)
  : tell_(std::move(tell))
{
}

OtherFrames::~OtherFrames()
{
  this->forget();
}

void OtherFrames::drawn(vtkRenderer* renderer)
{
  if (renderer != this->renderer_)
  {
    this->forget();
    this->renderer_ = renderer;
    this->observer_ = renderer->AddObserver(vtkCommand::EndEvent, this, &OtherFrames::endFrame);
  }
  this->drawn_ = true;
}

void OtherFrames::endFrame()
{
  if (!std::exchange(this->drawn_, false))
  {
    vtkRenderer* const renderer = this->renderer_;
    this->forget();
    this->tell_(renderer);
  }
}

void OtherFrames::forget()
{
  if (this->renderer_)
  {
    this->renderer_->RemoveObserver(this->observer_);
  }
  this->renderer_ = nullptr;
}

} // namespace gnomon
