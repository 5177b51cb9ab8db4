#include "plugin/scene/PropRecords.h"

#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/MapperKind.h"
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

#include <algorithm>
#include <map>

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

bool PropRecords::beginFrame(vtkPropCollection* props, bool inputsHaveRun)
{
  const auto count = static_cast<std::size_t>(props->GetNumberOfItems());
  bool areSame = count == this->records_.size();
  bool areNumbered = areSame;
  this->records_.resize(count);
  this->due_.clear();
  vtkCollectionSimpleIterator iterator;
  props->InitTraversal(iterator);
  for (Record& record : this->records_)
  {
    vtkProp* const prop = props->GetNextProp(iterator);
    if (prop && isSame(record.plain, prop, inputsHaveRun))
    {
      continue;
    }
    if (prop != record.prop)
    {
      areNumbered = false;
      record = {};
      record.prop = prop;
    }
    const bool withoutSurface = prop && hasNoSurface(prop);
    areSame = areSame && withoutSurface && record.withoutSurface;
    record.plain = {};
    record.withoutSurface = withoutSurface;
    record.isStamped = false;
  }
  if (!areNumbered)
  {
    ++this->numberings_;
    this->numbers_.clear();
  }
  return areSame;
}

const PlainProp* PropRecords::unchanged(std::size_t number) const
{
  const bool is = number < this->records_.size() && this->records_[number].plain.actor;
  return is ? &this->records_[number].plain : nullptr;
}

bool PropRecords::remember(std::size_t number, vtkActor* actor)
{
  vtkMapper* const mapper = actor->GetMapper();
  const bool textured = actor->GetTexture() || actor->GetProperty()->GetNumberOfTextures() > 0;
  if (number >= this->records_.size() || textured || mapper->GetStatic() ||
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
    this->records_[number].plain = { actor, mapper, producer, isFiltered, keysOf(actor), data, code,
      actor->GetMTime(), mapper->GetMTime(), isFiltered ? data->GetMTime() : producer->GetMTime(),
      code->GetMTime() };
  }
  return data != nullptr;
}

std::optional<std::size_t> PropRecords::numberOf(const vtkProp* prop)
{
  this->next_ = this->next_ < this->records_.size() ? this->next_ : 0;
  if (this->records_.empty() || this->records_[this->next_].prop != prop)
  {
    for (std::size_t i = this->numbers_.size(); i < this->records_.size(); ++i)
    {
      this->numbers_.emplace(this->records_[i].prop, i);
    }
    const auto known = this->numbers_.find(prop);
    if (known == this->numbers_.end())
    {
      return std::nullopt;
    }
    this->next_ = known->second;
  }
  return this->next_++;
}

std::size_t PropRecords::stamp(vtkProp* prop, vtkRenderer* renderer)
{
  const std::optional<std::size_t> number = this->numberOf(prop);
  if (!number)
  {
    return stampOf(prop, renderer).hash;
  }
  Record& record = this->records_[*number];
  if (!record.isStamped)
  {
    const PropStamp now = stampOf(prop, renderer);
    if (now.hash != record.last.hash)
    {
      record.stamp = now.hash;
      record.mayChangeInDrawing = true;
      record.wasDrawn = false;
    }
    record.last = now;
    record.isStamped = true;
  }
  if (record.mayChangeInDrawing)
  {
    this->due_.emplace_back(*number, prop);
  }
  return record.stamp;
}

void PropRecords::endFrame(vtkRenderer* renderer)
{
  for (const auto& [number, prop] : this->due_)
  {
    Record& record = this->records_[number];
    const PropStamp after = stampOf(prop, renderer);
    record.mayChangeInDrawing = after.hash != record.last.hash;
    if (!record.wasDrawn)
    {
      record.stamp = after.hash; // VTK places some props only while it first draws them
    }
    record.wasDrawn = true;
    record.last = after;
  }
  this->due_.clear();
}

std::vector<std::string> PropRecords::notes() const
{
  std::map<std::string, int> counts;
  for (const Record& record : this->records_)
  {
    if (record.isStamped && record.last.unknown)
    {
      ++counts[record.last.unknown];
    }
  }
  std::vector<std::string> notes;
  for (const auto& [name, count] : counts)
  {
    notes.push_back("only VTK's redraw time tells of changes of " + name + " (" +
      std::to_string(count) + (count == 1 ? " prop)" : " props)"));
  }
  return notes;
}

std::size_t PropRecords::bytes() const
{
  return bytesOf(this->records_) + bytesOfTable(this->numbers_);
}

} // namespace gnomon
