#include "plugin/scene/PlainProps.h"

#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/MapperKind.h"
#include "plugin/scene/PropStamps.h"
#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCuller.h"
#include "vtkCullerCollection.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"

namespace gnomon
{
namespace
{

/// True if a plain prop draws the same data, after its filters have run.
bool drawsSameData(const PlainProp& known, bool inputsHaveRun)
{
  if (!known.isFiltered)
  {
    return known.producer->GetMTime() == known.dataTime;
  }
  if (!inputsHaveRun)
  {
    runInput(known.mapper, MapperKind::PlainPolyData);
  }
  return known.mapper->GetInputDataObject(0, 0) == known.data &&
    known.data->GetMTime() == known.dataTime;
}

/// True if a prop is a plain one and unchanged.
bool isSame(const PlainProp& known, vtkProp* prop, bool inputsHaveRun)
{
  // Checked in order of ownership: an unchanged object still holds the next one.
  return known.actor == prop && known.actor->GetMTime() == known.actorTime &&
    known.mapper->GetMTime() == known.mapperTime && drawsSameData(known, inputsHaveRun) &&
    known.code->GetMTime() == known.codeTime && known.keys == keysOf(prop);
}

bool hasNoSurface(vtkProp* prop)
{
  return !prop->GetVisibility() || (!isPlainActor(prop) && vtkActor2D::SafeDownCast(prop));
}

} // namespace

//------------------------------------------------------------------------------
bool haveInputsRun(vtkRenderer* renderer)
{
  vtkCullerCollection* const cullers = renderer->GetCullers();
  vtkCollectionSimpleIterator iterator;
  cullers->InitTraversal(iterator);
  vtkCuller* culler = cullers->GetNextCuller(iterator);
  while (culler && !culler->IsA("vtkFrustumCoverageCuller"))
  {
    culler = cullers->GetNextCuller(iterator);
  }
  return culler != nullptr;
}

//------------------------------------------------------------------------------
bool PlainProps::beginFrame(vtkPropCollection* props, bool inputsHaveRun)
{
  const auto count = static_cast<std::size_t>(props->GetNumberOfItems());
  bool areSame = count == this->props_.size();
  this->props_.resize(count);
  vtkCollectionSimpleIterator iterator;
  props->InitTraversal(iterator);
  for (Known& known : this->props_)
  {
    vtkProp* const prop = props->GetNextProp(iterator);
    if (!prop || !isSame(known.plain, prop, inputsHaveRun))
    {
      vtkProp* const withoutSurface = prop && hasNoSurface(prop) ? prop : nullptr;
      areSame = areSame && withoutSurface && withoutSurface == known.withoutSurface;
      known = { {}, withoutSurface };
    }
  }
  return areSame;
}

//------------------------------------------------------------------------------
const PlainProp* PlainProps::unchanged(std::size_t number) const
{
  const bool is = number < this->props_.size() && this->props_[number].plain.actor;
  return is ? &this->props_[number].plain : nullptr;
}

//------------------------------------------------------------------------------
bool PlainProps::remember(std::size_t number, vtkActor* actor)
{
  vtkMapper* const mapper = actor->GetMapper();
  const bool textured = actor->GetTexture() || actor->GetProperty()->GetNumberOfTextures() > 0;
  if (number >= this->props_.size() || textured || mapper->GetStatic() ||
    mapper->GetNumberOfClippingPlanes() > 0)
  {
    return false;
  }
  auto* const data = vtkPolyData::SafeDownCast(mapper->GetInputDataObject(0, 0));
  if (data)
  {
    vtkAlgorithm* const producer = mapper->GetInputAlgorithm();
    const bool isFiltered = !producer->IsA("vtkTrivialProducer");
    vtkShaderProperty* const code = actor->GetShaderProperty();
    this->props_[number].plain = { actor, mapper, producer, isFiltered, keysOf(actor), data, code,
      actor->GetMTime(), mapper->GetMTime(), isFiltered ? data->GetMTime() : producer->GetMTime(),
      code->GetMTime() };
  }
  return data != nullptr;
}

//------------------------------------------------------------------------------
std::size_t PlainProps::bytes() const
{
  return bytesOf(this->props_);
}

} // namespace gnomon
