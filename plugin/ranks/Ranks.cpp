#include "plugin/ranks/Ranks.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>
#include <array>
#include <thread>

#include <unistd.h>

namespace gnomon
{
namespace
{

/// Reduce numbers over all ranks, in place.
template <typename Number>
void reduce(vtkMultiProcessController& controller, std::vector<Number>& numbers, int operation)
{
  std::vector<Number> all(numbers.size());
  if (!controller.AllReduce(
        numbers.data(), all.data(), static_cast<vtkIdType>(numbers.size()), operation))
  {
    throw RankFailure("the processes cannot reach each other");
  }
  numbers = std::move(all);
}

} // namespace

//------------------------------------------------------------------------------
Ranks::Ranks(vtkMultiProcessController* controller)
  : controller_(controller)
  , count_(controller->GetNumberOfProcesses())
  , own_(controller->GetLocalProcessId())
{
  this->limitThreads();
}

//------------------------------------------------------------------------------
Ranks::~Ranks() = default;

//------------------------------------------------------------------------------
vtkMultiProcessController* Ranks::controller() const
{
  return this->controller_;
}

//------------------------------------------------------------------------------
void Ranks::limitThreads()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  std::vector<char> names(name.size() * static_cast<std::size_t>(this->count_));
  this->controller_->AllGather(name.data(), names.data(), static_cast<vtkIdType>(name.size()));
  int neighbours = 0; // this rank included
  for (int rank = 0; rank < this->count_; ++rank)
  {
    const char* const other = &names[name.size() * static_cast<std::size_t>(rank)];
    neighbours += std::equal(name.begin(), name.end(), other) ? 1 : 0;
  }
  const unsigned int cores = std::max(std::thread::hardware_concurrency(), 1u);
  this->threads_.emplace(tbb::global_control::max_allowed_parallelism,
    std::max(cores / static_cast<unsigned int>(std::max(neighbours, 1)), 1u));
}

//------------------------------------------------------------------------------
/// Return the error of the first rank that has one, with its number; empty if none has.
std::string Ranks::firstFailure(const std::string& mine)
{
  std::vector<int> first{ mine.empty() ? this->count_ : this->own_ };
  reduce(*this->controller_, first, vtkCommunicator::MIN_OP);
  const int failed = first.front();
  if (failed == this->count_)
  {
    return {};
  }
  std::string error = mine;
  vtkIdType length = static_cast<vtkIdType>(error.size());
  this->controller_->Broadcast(&length, 1, failed);
  error.resize(static_cast<std::size_t>(length));
  this->controller_->Broadcast(error.data(), length, failed);
  return "process " + std::to_string(failed) + " of " + std::to_string(this->count_) +
    " failed: " + error;
}

//------------------------------------------------------------------------------
/// Throw on all ranks if one of them fails in place of this call.
void Ranks::agree()
{
  const std::string error = this->firstFailure({});
  if (!error.empty())
  {
    this->isOpen_ = false;
    throw RankFailure(error);
  }
}

//------------------------------------------------------------------------------
std::string Ranks::beginFrame(const std::string& whyNot)
{
  this->bytesShared_ = 0;
  const std::string error = this->firstFailure(whyNot);
  this->isOpen_ = error.empty();
  return error;
}

//------------------------------------------------------------------------------
void Ranks::fail(const std::string& error)
{
  if (this->isOpen_)
  {
    this->isOpen_ = false;
    this->firstFailure(error.empty() ? "unknown error" : error);
  }
}

//------------------------------------------------------------------------------
bool Ranks::isAny(bool mine)
{
  this->agree();
  std::vector<int> any{ mine ? 1 : 0 };
  reduce(*this->controller_, any, vtkCommunicator::MAX_OP);
  return any.front() != 0;
}

//------------------------------------------------------------------------------
std::int64_t Ranks::sum(std::int64_t mine)
{
  this->agree();
  std::vector<long long> sum{ mine };
  reduce(*this->controller_, sum, vtkCommunicator::SUM_OP);
  return sum.front();
}

//------------------------------------------------------------------------------
void Ranks::requireSame(std::uint64_t hash, const std::string& what)
{
  this->agree();
  std::vector<unsigned long long> extremes{ hash, ~static_cast<unsigned long long>(hash) };
  reduce(*this->controller_, extremes, vtkCommunicator::MIN_OP);
  if (extremes[0] != ~extremes[1])
  {
    this->isOpen_ = false; // all ranks throw here
    throw RankFailure("the processes have different " + what);
  }
}

//------------------------------------------------------------------------------
Bounds Ranks::united(const Bounds& mine)
{
  this->agree();
  std::vector<double> extremes;
  for (int axis = 0; axis < 3; ++axis)
  {
    extremes.push_back(mine.lower[axis]);
    extremes.push_back(-mine.upper[axis]);
  }
  reduce(*this->controller_, extremes, vtkCommunicator::MIN_OP);
  return { { extremes[0], extremes[2], extremes[4] },
    -glm::dvec3(extremes[1], extremes[3], extremes[5]) };
}

//------------------------------------------------------------------------------
void Ranks::takeLeast(std::vector<float>& numbers)
{
  this->agree();
  reduce(*this->controller_, numbers, vtkCommunicator::MIN_OP);
  this->bytesShared_ += sizeof(float) * numbers.size();
}

//------------------------------------------------------------------------------
void Ranks::uniteBits(std::vector<std::uint64_t>& bits)
{
  static_assert(sizeof(unsigned long) == sizeof(std::uint64_t), "the controller's type of 64 bits");
  this->agree();
  std::vector<std::uint64_t> all(bits.size());
  if (!this->controller_->AllReduce(reinterpret_cast<const unsigned long*>(bits.data()),
        reinterpret_cast<unsigned long*>(all.data()), static_cast<vtkIdType>(bits.size()),
        vtkCommunicator::BITWISE_OR_OP))
  {
    throw RankFailure("the processes cannot reach each other");
  }
  bits = std::move(all);
  this->bytesShared_ += sizeof(std::uint64_t) * bits.size();
}

//------------------------------------------------------------------------------
std::vector<std::size_t> Ranks::counts(std::size_t mine)
{
  this->agree();
  const auto own = static_cast<vtkIdType>(mine);
  std::vector<vtkIdType> all(static_cast<std::size_t>(this->count_));
  this->controller_->AllGather(&own, all.data(), 1);
  return { all.begin(), all.end() };
}

//------------------------------------------------------------------------------
/// @param firsts of each rank's elements, and the number of all
void Ranks::gatherBytes(
  const void* mine, void* all, std::size_t elementBytes, const std::vector<std::size_t>& firsts)
{
  const auto ranks = static_cast<std::size_t>(this->count_);
  std::vector<vtkIdType> lengths(ranks);
  std::vector<vtkIdType> offsets(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    lengths[rank] = static_cast<vtkIdType>((firsts[rank + 1] - firsts[rank]) * elementBytes);
    offsets[rank] = static_cast<vtkIdType>(firsts[rank] * elementBytes);
  }
  const vtkIdType own = lengths[static_cast<std::size_t>(this->own_)];
  if (!this->controller_->AllGatherV(static_cast<const char*>(mine), static_cast<char*>(all), own,
        lengths.data(), offsets.data()))
  {
    throw RankFailure("the processes cannot reach each other");
  }
  this->bytesShared_ += elementBytes * firsts.back();
}

} // namespace gnomon
