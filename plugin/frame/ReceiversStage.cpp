#include "plugin/frame/ReceiversStage.h"

#include "plugin/scene/ShownView.h"
#include "plugin/window/PictureTarget.h"

#include <vtkMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

namespace gnomon
{

ReceiversStage::ReceiversStage(Frame& frame, OccluderCollector& collector, PassPrograms& programs,
  ShaderManager::StageValues& values)
  : frame_(frame)
  , collector_(collector)
  , programs_(programs)
  , values_(values)
{
}

bool ReceiversStage::readsPoints() const
{
  return std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(),
    [](const CastingLight& casting) { return !casting.isOnCpu(); });
}

const ShownProps& ReceiversStage::shownProps(const vtkRenderState* s)
{
  if (!this->shownProps_)
  {
    this->shownProps_ = readShownProps(s, this->collector_.props());
    const std::vector<std::string> notes = this->collector_.props().notes();
    this->frame_.counts.notes.insert(this->frame_.counts.notes.end(), notes.begin(), notes.end());
  }
  return *this->shownProps_;
}

/// Return the key of the picture of the receivers.
ValueKey ReceiversStage::keyOf(const vtkRenderState* s)
{
  const Scene& scene = this->frame_.scene;
  ValueKey key;
  key.add("the camera", scene.picture.view);
  key.add(propsPart, this->shownProps(s).hash);
  key.add(snapshotPart, scene.props.casters);
  key.add("what is read of receivers", this->readsPoints());
  key.add("the processes", this->frame_.ranks->serial());
  key.add("where they are drawn", std::tuple(this->frame_.route(), originOf(s)));
  return key;
}

void ReceiversStage::findStale(const vtkRenderState* s)
{
  ReceiversValue& value = this->frame_.view->receivers;
  ValueKey key = this->keyOf(s);
  const std::string changes = value.key ? key.changesFrom(*value.key) : "there were none";
  this->frame_.noteReuse("receivers", changes);
  if (changes.empty())
  {
    this->due_.reset();
    return;
  }
  this->due_ = std::move(key);
  value.key.reset(); // in case of an error
  value.onCpu.reset();
  value.shared.clear();
  value.framesTraced = 0;
}

int ReceiversStage::countRest()
{
  this->restingFrames_ = this->due_ ? 0 : this->restingFrames_ + 1;
  return this->restingFrames_;
}

void ReceiversStage::begin(const vtkRenderState* s)
{
  this->values_.receiversStage = true;
  this->programs_.numbers.beginStage();
  this->programs_.shaders.beginStage(
    vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow()), this->values_);
}

void ReceiversStage::update(const vtkRenderState* s, vtkObjectBase* pass)
{
  const bool areDue = this->due_.has_value() || !this->frame_.view->receivers.shared.areShared();
  if (this->frame_.ranks->isAny(areDue))
  {
    this->frame_.view->receivers.shared.clear();
  }
  if (this->due_)
  {
    const auto draw = [&]
    {
      this->begin(s);
      drawReceivers(
        s, pass, this->frame_.size, this->readsPoints(), this->frame_.view->receivers.target);
      this->programs_.shaders.endStage();
    };
    do
    {
      draw();
      this->frame_.endStage("receivers");
    } while (!this->ensureRightNumbers(s));
  }
  else
  {
    this->frame_.endStage("receivers"); // reused
  }
  this->take();
  this->values_.depths = { GL_TEXTURE_2D, this->frame_.view->receivers.target.depths() };
}

/// Compare the triangle numbers that new programs have drawn with the depths.
NumberCheck ReceiversStage::checkNumbers(const vtkRenderState* s)
{
  const ReceiversValue& receivers = this->frame_.view->receivers;
  const Occluders& occluders = this->collector_.occluders();
  ReceiverImages images;
  NumberTruth truth;
  // Parts without numbers may be nearer, and VTK may offset depths.
  const bool comparesDepths = !this->shownProps(s).partsOfBothKinds &&
    vtkMapper::GetResolveCoincidentTopology() == VTK_RESOLVE_OFF;
  const auto read = [&](const auto& from)
  {
    from.read(images);
    if (comparesDepths)
    {
      from.readDepths(truth.windowDepths);
    }
  };
  this->frame_.route() == Route::Deferred ? read(receivers.deferred) : read(receivers.target);
  images.rays = pixelRays(this->frame_.camera.clipFromView, this->frame_.space.centredFromView,
    images.width, images.height);
  truth.clipFromCentred = this->frame_.camera.clipFromCentred();
  // VTK multiplies vertices in float. It shifts those that are farther off than 1,000 extents.
  const double extent = 2.0 * occluders.allCentred.radius();
  const double farthest = glm::length(occluders.frame.centre) + extent;
  truth.vertexNoise = 8.0 / 16777216.0 *
    (std::min(farthest, 1000.0 * extent) + glm::length(this->frame_.camera.eyeCentred()));
  return this->programs_.numbers.check(images, truth, this->collector_.drawnSurfaces(), occluders);
}

bool ReceiversStage::ensureRightNumbers(const vtkRenderState* s)
{
  const std::int64_t wrongByDriver = std::exchange(this->wrongByDriver_, 0);
  if (!this->programs_.numbers.isDue())
  {
    return true;
  }
  FrameCounts& counts = this->frame_.counts;
  ShaderManager& shaders = this->programs_.shaders;
  const NumberCheck check = this->checkNumbers(s);
  this->frame_.endStage("receivers: check numbers");
  counts.numbersChecked += check.allPixels();
  if (wrongByDriver > 0)
  {
    const bool isBetter = check.allWrong() < wrongByDriver;
    counts.numbersWrong = isBetter ? wrongByDriver : 0;
    shaders.numberByGeometryShaders(isBetter);
    return isBetter;
  }
  if (check.allWrong() > 0 && !shaders.numbersByGeometryShaders())
  {
    this->wrongByDriver_ = check.allWrong();
    shaders.numberByGeometryShaders(true);
    return false;
  }
  return true;
}

void ReceiversStage::take()
{
  if (this->due_)
  {
    ReceiversValue& value = this->frame_.view->receivers;
    if (value.drawnSurfaces != this->collector_.drawnSurfaces())
    {
      value.drawnSurfaces = this->collector_.drawnSurfaces();
      value.numberOfImages = 0; // the fragments that were read have other names
    }
    value.key = std::move(this->due_);
    value.number = ++this->numbered_;
    ++this->frame_.counts.receiversDrawn;
  }
}

} // namespace gnomon
