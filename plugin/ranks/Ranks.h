#pragma once

#include "lights/Bounds.h"
#include "lights/vtkGnomonVersions.h"

#include <tbb/global_control.h>

#include <vtkSmartPointer.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkMultiProcessController;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Thrown on all ranks where one of them failed. The text names the rank and its error.
struct RankFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The processes that draw one picture, each its own part of the scene (sort-last rendering).
///
/// All functions from beginFrame() to endFrame() are collective: every rank calls the same ones in
/// the same order, ranks without data included. Whatever a stage decides between them must hold for
/// all ranks; isAny() makes it so. A rank that fails between two calls calls fail() in place of
/// the next one, and that call throws a RankFailure on the others.
class Ranks
{
public:
  /// Count the ranks, and limit this rank's threads to its share of its machine's cores.
  explicit Ranks(vtkMultiProcessController* controller);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const { return this->count_; }
  int own() const { return this->own_; }
  vtkMultiProcessController* controller() const;

  /// Begin a frame.
  /// @param whyNot why this rank cannot draw shadows; empty if it can
  /// @return the reason of the first rank that cannot, with its number; the frame has ended then
  std::string beginFrame(const std::string& whyNot);
  /// End a frame: this rank needs no other any more.
  /// @throws RankFailure
  void endFrame()
  {
    this->agree();
    this->isOpen_ = false;
  }
  /// Tell the others of an error; not collective, and without effect after the frame's end or after
  /// a RankFailure.
  void fail(const std::string& error);

  ///@{
  /// @throws RankFailure
  /// True if it is on any rank.
  bool isAny(bool mine);
  /// Throw on all ranks unless a number is the same on all.
  /// @param what it is of, as a subject: "lights"
  void requireSame(std::uint64_t hash, const std::string& what);
  /// Return the sum over all ranks.
  std::int64_t sum(std::int64_t mine);
  /// Unite the boxes of all ranks.
  Bounds united(const Bounds& mine);
  /// Replace each number by the least of all ranks'.
  void takeLeast(std::vector<float>& numbers);
  /// Replace bits by those that any rank has set.
  void uniteBits(std::vector<std::uint64_t>& bits);
  ///@}

  /// The elements of all ranks, in the order of the ranks.
  template <typename Element>
  struct Gathered
  {
    std::vector<Element> elements;
    std::vector<std::size_t> firsts; ///< of each rank, and the number of all
  };
  /// Gather the elements of all ranks.
  /// @param all overwritten
  /// @throws RankFailure
  template <typename Element>
  void gather(const std::vector<Element>& mine, Gathered<Element>& all)
  {
    const std::vector<std::size_t> counts = this->counts(mine.size());
    all.firsts.assign(1, 0);
    for (const std::size_t count : counts)
    {
      all.firsts.push_back(all.firsts.back() + count);
    }
    all.elements.resize(all.firsts.back());
    this->gatherBytes(mine.data(), all.elements.data(), sizeof(Element), all.firsts);
  }

  /// Return the bytes that this rank has received of others in the frame, with its own among them.
  std::size_t bytesShared() const { return this->bytesShared_; }

private:
  std::string firstFailure(const std::string& mine);
  void agree();
  std::vector<std::size_t> counts(std::size_t mine);
  void gatherBytes(
    const void* mine, void* all, std::size_t elementBytes, const std::vector<std::size_t>& firsts);
  void limitThreads();

  vtkSmartPointer<vtkMultiProcessController> controller_;
  int count_;
  int own_;
  bool isOpen_ = false; ///< true while other ranks may wait for this one
  std::size_t bytesShared_ = 0;
  std::optional<tbb::global_control> threads_;
};

} // namespace gnomon
