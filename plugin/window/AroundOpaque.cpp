#include "plugin/window/AroundOpaque.h"

#include <vtkObjectFactory.h>
#include <vtkProp.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace gnomon
{
namespace
{

/// Draws nothing. It calls a function when VTK draws it among the opaque props.
class CallingProp : public vtkProp
{
public:
  static CallingProp* New();
  vtkTypeMacro(CallingProp, vtkProp);

  int RenderOpaqueGeometry(vtkViewport*) override
  {
    this->Call();
    return 0;
  }

  std::function<void()> Call;
};

vtkStandardNewMacro(CallingProp);

vtkProp* makeCallingProp(std::function<void()> call)
{
  CallingProp* prop = CallingProp::New();
  prop->Call = std::move(call);
  return prop;
}

/// The props that a renderer is about to draw. Naming the members through a subclass gives access
/// to them.
struct RendererAccess : vtkRenderer
{
  static vtkProp**& props(vtkRenderer* renderer) { return renderer->*(&RendererAccess::PropArray); }
  static int& count(vtkRenderer* renderer) { return renderer->*(&RendererAccess::PropArrayCount); }
};

} // namespace

AroundOpaque::AroundOpaque(const vtkRenderState* s, const std::function<bool(vtkProp*)>& isAmong,
  std::function<void()> before, std::function<void()> afterwards)
  : renderer_(s->GetRenderer())
  , propsBefore_(RendererAccess::props(this->renderer_))
  , countBefore_(RendererAccess::count(this->renderer_))
  , functions_{ std::move(before), std::move(afterwards) }
  , state_(this->renderer_)
{
  vtkProp** const first = s->GetPropArray();
  vtkProp** const last = first + s->GetPropArrayCount();
  this->own_ = { makeCallingProp([this] { this->call(0); }),
    makeCallingProp([this] { this->call(1); }) };
  this->props_.push_back(this->own_[0]);
  std::copy_if(first, last, std::back_inserter(this->props_), isAmong);
  this->props_.push_back(this->own_[1]);
  std::remove_copy_if(first, last, std::back_inserter(this->props_), isAmong);
  const int count = static_cast<int>(this->props_.size());
  this->state_.SetPropArrayAndCount(this->props_.data(), count);
  this->state_.SetFrameBuffer(s->GetFrameBuffer());
  this->state_.SetRequiredKeys(s->GetRequiredKeys());
  RendererAccess::props(this->renderer_) = this->props_.data();
  RendererAccess::count(this->renderer_) = count;
}

AroundOpaque::~AroundOpaque()
{
  RendererAccess::props(this->renderer_) = this->propsBefore_;
  RendererAccess::count(this->renderer_) = this->countBefore_;
  for (vtkProp* own : this->own_)
  {
    own->Delete();
  }
}

/// Call a function unless it was called, or an earlier one has failed. Its errors are caught, since
/// VTK's code around it must not see exceptions.
void AroundOpaque::call(std::size_t which)
{
  if (this->called_ != which || this->error_)
  {
    return;
  }
  ++this->called_;
  try
  {
    this->functions_[which]();
  }
  catch (...)
  {
    this->error_ = std::current_exception();
  }
}

void AroundOpaque::end() const
{
  if (this->error_)
  {
    std::rethrow_exception(this->error_);
  }
  if (this->called_ < 2)
  {
    throw std::runtime_error("its opaque props were not drawn");
  }
}

} // namespace gnomon
