#pragma once

#include "lights/Bounds.h"
#include "lights/vtkGnomonVersions.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkMultiProcessController;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Thrown on all ranks where one of them failed. The text names the process and its error.
struct RankFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The ranks: processes that draw one picture, each its own part of the scene (sort-last
/// rendering).
///
/// All functions from beginFrame() to endFrame() are collective: every rank calls the same ones in
/// the same order, also ranks without data. Between two calls all ranks must decide alike; isAny()
/// makes them. A rank that fails between two calls calls fail() in place of the next one, which
/// then throws a RankFailure on the others.
class Ranks
{
public:
  /// Count the ranks, and those on this rank's machine; collective.
  /// @throws RankFailure if the ranks cannot reach each other
  explicit Ranks(vtkMultiProcessController* controller);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const { return this->count_; }
  int own() const { return this->own_; } ///< this rank's number
  vtkMultiProcessController* controller() const;
  /// Return a number that no other object of this process has, had, or will have.
  std::uint64_t serial() const { return this->serial_; }
  /// Return this rank's share of the cores of its machine.
  std::size_t threads() const { return this->threads_; }

  /// Begin a frame.
  /// @param whyNot why this rank cannot draw shadows; empty if it can
  /// @return the reason of the first rank that cannot, with its number; the frame has ended then
  /// @throws RankFailure as the functions below
  std::string beginFrame(const std::string& whyNot);
  /// End a frame: this rank needs no other any more.
  void endFrame();
  /// Tell the others of an error. Not collective; has no effect after the frame's end or after a
  /// RankFailure.
  void fail(const std::string& error) noexcept;

  /// True if it is on any rank.
  bool isAny(bool mine);
  /// Throw on all ranks unless a number is the same on all.
  /// @param what for the error, what differs: "lights"
  void requireSame(std::uint64_t number, const std::string& what);
  /// Return the sum over all ranks.
  std::int64_t sum(std::int64_t mine);
  /// Return the box around those of all ranks.
  Bounds united(const Bounds& mine);
  /// Replace each number by the least of all ranks'.
  void reduceToLeast(std::vector<float>& numbers);
  /// Replace bits by those that any rank has set.
  void uniteBits(std::vector<std::uint64_t>& bits);

  /// The elements of all ranks, in the order of the ranks.
  template <typename Element>
  struct Gathered
  {
    std::vector<Element> elements;
    std::vector<std::size_t> firsts; ///< of each rank, and the number of all
  };
  /// Gather the elements of all ranks.
  /// @param all overwritten
  template <typename Element>
  void gather(const std::vector<Element>& mine, Gathered<Element>& all)
  {
    all.firsts = this->firstsOf(mine.size());
    all.elements.resize(all.firsts.back());
    this->gatherBytes(mine.data(), all.elements.data(), sizeof(Element), all.firsts);
  }

  /// Return the bytes that this rank has received in the frame, its own among them.
  std::size_t bytesShared() const { return this->bytesShared_; }

private:
  std::string firstFailure(const std::string& mine);
  void agree();
  [[noreturn]] void giveUp();
  template <typename Number>
  void reduce(std::vector<Number>& numbers, int operation);
  std::vector<std::size_t> firstsOf(std::size_t mine);
  void gatherBytes(
    const void* mine, void* all, std::size_t elementBytes, const std::vector<std::size_t>& firsts);

  vtkSmartPointer<vtkMultiProcessController> controller_;
  int count_;
  int own_;
  std::uint64_t serial_;
  std::size_t threads_ = 1;
  bool othersWait_ = false; ///< true while other ranks may wait for this one
  std::size_t bytesShared_ = 0;
};

} // namespace gnomon
