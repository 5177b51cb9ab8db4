#include "plugin/scene/PlainProps.h"

#include "plugin/scene/MapperKind.h"
#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkCuller.h"
#include "vtkCullerCollection.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
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
void PlainProps::beginFrame(bool inputsHaveRun)
{
  this->next_ = 0;
  this->inputsHaveRun_ = inputsHaveRun;
}

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
    known.mapper->GetMTime() == known.mapperTime && drawsSameData(known, this->inputsHaveRun_) &&
    known.code->GetMTime() == known.codeTime;
  if (!same)
  {
    known = {};
  }
  return same ? &known : nullptr;
}

//------------------------------------------------------------------------------
void PlainProps::remember(vtkActor* actor)
{
  vtkMapper* const mapper = actor->GetMapper();
  const bool textured = actor->GetTexture() || actor->GetProperty()->GetNumberOfTextures() > 0;
  if (textured || mapper->GetStatic() || mapper->GetNumberOfClippingPlanes() > 0)
  {
    return;
  }
  if (auto* const data = vtkPolyData::SafeDownCast(mapper->GetInputDataObject(0, 0)))
  {
    vtkAlgorithm* const producer = mapper->GetInputAlgorithm();
    const bool isFiltered = !producer->IsA("vtkTrivialProducer");
    vtkShaderProperty* const code = actor->GetShaderProperty();
    this->props_[this->next_ - 1] = { actor, mapper, producer, isFiltered, data, code,
      actor->GetMTime(), mapper->GetMTime(), isFiltered ? data->GetMTime() : producer->GetMTime(),
      code->GetMTime() };
  }
}

//------------------------------------------------------------------------------
std::size_t PlainProps::bytes() const
{
  return bytesOf(this->props_);
}

} // namespace gnomon
