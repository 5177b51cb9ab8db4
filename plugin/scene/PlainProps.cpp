#include "plugin/scene/PlainProps.h"

#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkTrivialProducer.h"

namespace gnomon
{

//------------------------------------------------------------------------------
const PlainProp* PlainProps::next(vtkProp* prop)
{
  if (this->next_ == this->props_.size())
  {
    this->props_.emplace_back();
  }
  PlainProp& known = this->props_[this->next_++];
  // Checked in order of ownership: an unchanged object still holds the next one.
  const bool same = known.actor == prop && known.actor->GetMTime() == known.actorTime &&
    known.mapper->GetMTime() == known.mapperTime &&
    known.producer->GetMTime() == known.producerTime && known.code->GetMTime() == known.codeTime;
  if (!same)
  {
    known = {};
  }
  return same ? &known : nullptr;
}

//------------------------------------------------------------------------------
void PlainProps::remember(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  auto* producer = vtkTrivialProducer::SafeDownCast(mapper->GetInputAlgorithm());
  const bool textured = actor->GetTexture() || actor->GetProperty()->GetNumberOfTextures() > 0;
  if (!producer || textured || mapper->GetNumberOfClippingPlanes() > 0)
  {
    return;
  }
  if (auto* data = vtkPolyData::SafeDownCast(producer->GetOutputDataObject(0)))
  {
    vtkShaderProperty* code = actor->GetShaderProperty();
    this->props_[this->next_ - 1] = { actor, mapper, producer, data, code, actor->GetMTime(),
      mapper->GetMTime(), producer->GetMTime(), code->GetMTime() };
  }
}

//------------------------------------------------------------------------------
std::size_t PlainProps::bytes() const
{
  return bytesOf(this->props_);
}

} // namespace gnomon
