#include "plugin/frame/ViewValues.h"

#include "shadowtech/base/Bytes.h"

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace gnomon
{

void VisibilityValue::dropTiles()
{
  this->classes.clear();
  this->tiles.forget();
  this->onCpu = {};
}

std::size_t VisibilityValue::bytes() const
{
  return bytesOf(this->classes) + bytesOf(this->edges) + bytesOf(this->onCpu) + this->tiles.bytes();
}

std::size_t ViewValues::bytesOfImages() const
{
  return this->receivers.target.bytes() + this->receivers.deferred.bytes() +
    bytesOf(this->receivers.images.fragments) + bytesOf(this->receivers.fragmentsBefore) +
    this->receivers.pixels.bytes() + this->receivers.shared.bytes() + this->layers.bytes() +
    (this->receivers.boxes ? this->receivers.boxes->bytes() : 0) +
    bytesOfAll(this->visibility, &VisibilityValue::bytes) + this->edges.bytes() +
    (this->sky.image ? this->sky.image->bytes() : 0);
}

ViewValues& RendererViews::of(vtkRenderer* renderer)
{
  Name name{ renderer->GetActiveCamera()->GetLeftEye(), {} };
  renderer->GetRenderWindow()->GetTileViewport(name.tile.data());
  ++this->count_;
  auto view = std::find_if(this->views_.begin(), this->views_.end(),
    [&](const View& known) { return known.name == name; });
  if (view == this->views_.end())
  {
    view = this->views_.emplace(this->views_.end());
    view->name = name;
  }
  view->lastDrawn = this->count_;
  constexpr std::uint64_t patience = 8; // both eyes of four tiles
  this->views_.remove_if(
    [this](const View& known) { return known.lastDrawn + patience <= this->count_; });
  return view->values;
}

std::size_t RendererViews::bytesOfImages() const
{
  return bytesOfAll(this->views_, [](const View& view) { return view.values.bytesOfImages(); });
}

std::size_t RendererViews::bytesOfMaps() const
{
  return bytesOfAll(
    this->views_, [](const View& view) { return view.values.techniques.bytesOfMaps(); });
}

} // namespace gnomon
