#include "plugin/ranks/ManyRanks.h"

#include "shadowtech/base/System.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>
#include <atomic>
#include <thread>

namespace gnomon
{
namespace
{

std::atomic<std::uint64_t> lastSerial{ 0 };

} // namespace

ManyRanks::ManyRanks(vtkMultiProcessController* controller)
  : controller_(controller)
  , count_(controller->GetNumberOfProcesses())
  , own_(controller->GetLocalProcessId())
  , serial_(++lastSerial)
{
  const auto name = nameOfMachine();
  std::vector<char> names(name.size() * static_cast<std::size_t>(this->count_));
  if (!controller->AllGather(name.data(), names.data(), static_cast<vtkIdType>(name.size())))
  {
    this->giveUp();
  }
  std::size_t neighbours = 0; // this rank included
  for (auto other = names.begin(); other != names.end(); other += name.size())
  {
    neighbours += std::equal(name.begin(), name.end(), other) ? 1 : 0;
  }
  this->threads_ = std::max<std::size_t>(std::thread::hardware_concurrency() / neighbours, 1);
}

ManyRanks::~ManyRanks() = default;

vtkMultiProcessController* ManyRanks::controller() const
{
  return this->controller_;
}

void ManyRanks::giveUp()
{
  this->othersWait_ = false;
  throw RankFailure("the processes cannot reach each other");
}

/// Return the error of the first rank that has one, with its number; empty if none has.
std::string ManyRanks::firstFailure(const std::string& mine)
{
  const int own = mine.empty() ? this->count_ : this->own_;
  int failed = 0;
  if (!this->controller_->AllReduce(&own, &failed, 1, vtkCommunicator::MIN_OP))
  {
    this->giveUp();
  }
  if (failed == this->count_)
  {
    return {};
  }
  std::string error = mine;
  auto length = static_cast<vtkIdType>(error.size());
  const bool isSent = this->controller_->Broadcast(&length, 1, failed) != 0;
  error.resize(isSent ? static_cast<std::size_t>(length) : 0);
  if (!isSent || !this->controller_->Broadcast(error.data(), length, failed))
  {
    this->giveUp();
  }
  return "process " + std::to_string(failed) + " of " + std::to_string(this->count_) +
    " failed: " + error;
}

/// Throw on all ranks if one of them fails in place of this call. Between it and the call that
/// follows, nothing may throw.
void ManyRanks::agree()
{
  const std::string error = this->firstFailure({});
  if (!error.empty())
  {
    this->othersWait_ = false;
    throw RankFailure(error);
  }
}

/// Reduce numbers over all ranks, in place.
template <typename Number>
void ManyRanks::reduce(std::vector<Number>& numbers, int operation)
{
  std::vector<Number> all(numbers.size());
  this->agree();
  if (!this->controller_->AllReduce(
        numbers.data(), all.data(), static_cast<vtkIdType>(numbers.size()), operation))
  {
    this->giveUp();
  }
  numbers = std::move(all);
}

std::string ManyRanks::beginFrame(const std::string& whyNot)
{
  this->bytesShared_ = 0;
  const std::string error = this->firstFailure(whyNot);
  this->othersWait_ = error.empty();
  return error;
}

void ManyRanks::endFrame()
{
  this->agree();
  this->othersWait_ = false;
}

void ManyRanks::fail(const std::string& error) noexcept
{
  if (this->othersWait_)
  {
    this->othersWait_ = false;
    try
    {
      this->firstFailure(error.empty() ? "unknown error" : error);
    }
    catch (const std::exception&)
    {
      // The others cannot be told.
    }
  }
}

bool ManyRanks::isAny(bool mine)
{
  std::vector<int> any{ mine ? 1 : 0 };
  this->reduce(any, vtkCommunicator::MAX_OP);
  return any.front() != 0;
}

void ManyRanks::requireSame(const std::function<std::uint64_t()>& number, const std::string& what)
{
  const std::uint64_t mine = number();
  std::vector<std::uint64_t> extremes{ mine, ~mine };
  this->reduce(extremes, vtkCommunicator::MIN_OP);
  if (extremes[0] != ~extremes[1])
  {
    this->othersWait_ = false; // all ranks throw here
    throw RankFailure("the processes have different " + what);
  }
}

std::int64_t ManyRanks::sum(std::int64_t mine)
{
  std::vector<long long> sum{ mine };
  this->reduce(sum, vtkCommunicator::SUM_OP);
  return sum.front();
}

Bounds ManyRanks::united(const Bounds& mine)
{
  std::vector<double> extremes{ mine.lower.x, mine.lower.y, mine.lower.z, -mine.upper.x,
    -mine.upper.y, -mine.upper.z };
  this->reduce(extremes, vtkCommunicator::MIN_OP);
  return { { extremes[0], extremes[1], extremes[2] },
    { -extremes[3], -extremes[4], -extremes[5] } };
}

void ManyRanks::reduceToLeast(std::vector<float>& numbers)
{
  this->reduce(numbers, vtkCommunicator::MIN_OP);
  this->bytesShared_ += sizeof(float) * numbers.size();
}

void ManyRanks::uniteBits(std::vector<std::uint64_t>& bits)
{
  this->reduce(bits, vtkCommunicator::BITWISE_OR_OP);
  this->bytesShared_ += sizeof(std::uint64_t) * bits.size();
}

std::vector<std::size_t> ManyRanks::firstsOf(std::size_t mine)
{
  const auto own = static_cast<vtkIdType>(mine);
  std::vector<vtkIdType> counts(static_cast<std::size_t>(this->count_));
  std::vector<std::size_t> firsts(counts.size() + 1, 0);
  this->agree();
  if (!this->controller_->AllGather(&own, counts.data(), 1))
  {
    this->giveUp();
  }
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    firsts[rank + 1] = firsts[rank] + static_cast<std::size_t>(counts[rank]);
  }
  return firsts;
}

void ManyRanks::gatherBytes(
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
  this->agree();
  if (!this->controller_->AllGatherV(static_cast<const char*>(mine), static_cast<char*>(all), own,
        lengths.data(), offsets.data()))
  {
    this->giveUp();
  }
  this->bytesShared_ += elementBytes * firsts.back();
}

} // namespace gnomon
