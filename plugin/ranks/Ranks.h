#pragma once

#include "lights/Bounds.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon
{

/// Thrown on all ranks where one of them failed. The text names the process and its error.
struct RankFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The ranks: processes that draw one picture, each its own part of the scene (sort-last
/// rendering). There are several (ManyRanks), or there is one, alone().
///
/// All functions from beginFrame() to endFrame() are collective: every rank calls the same ones in
/// the same order, also ranks without data. Between two calls all ranks must decide alike; isAny()
/// makes them. A rank that fails between two calls calls fail() in place of the next one, which
/// then throws a RankFailure on the others.
class Ranks
{
public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int count() const = 0;
  virtual int own() const = 0; ///< this rank's number
  /// Return a number that no other ranks of this process have, had, or will have.
  virtual std::uint64_t serial() const = 0;
  /// Return this rank's share of the cores of its machine; 0: as many as there are.
  virtual std::size_t threads() const = 0;

  /// Begin a frame.
  /// @param whyNot why this rank cannot draw shadows; empty if it can
  /// @return the reason of the first rank that cannot, with its number if there are several; the
  /// frame has ended then
  /// @throws RankFailure as the functions below
  virtual std::string beginFrame(const std::string& whyNot) = 0;
  /// End a frame: this rank needs no other any more.
  virtual void endFrame() = 0;
  /// Tell the others of an error. Not collective; has no effect after the frame's end or after a
  /// RankFailure.
  virtual void fail(const std::string& error) noexcept = 0;

  /// True if it is on any rank.
  virtual bool isAny(bool mine) = 0;
  /// Throw on all ranks unless a number is the same on all.
  /// @param number computes it, if there is another to compare it with
  /// @param what for the error, what differs: "lights"
  virtual void requireSame(
    const std::function<std::uint64_t()>& number, const std::string& what) = 0;
  /// Return the sum over all ranks.
  virtual std::int64_t sum(std::int64_t mine) = 0;
  /// Return the box around those of all ranks.
  virtual Bounds united(const Bounds& mine) = 0;
  /// Replace each number by the least of all ranks'.
  virtual void reduceToLeast(std::vector<float>& numbers) = 0;
  /// Replace bits by those that any rank has set.
  virtual void uniteBits(std::vector<std::uint64_t>& bits) = 0;
  /// Return uniteBits() for rays; null where this rank has all casters.
  virtual std::function<void(std::vector<std::uint64_t>& bits)> rayExchange() = 0;

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

  /// Return the numbers of the first rank; every rank has as many.
  std::vector<double> ofFirst(const std::vector<double>& mine)
  {
    Gathered<double> all;
    this->gather(mine, all);
    all.elements.resize(mine.size());
    return all.elements;
  }

  /// Return the bytes that this rank has received in the frame, its own among them.
  virtual std::size_t bytesShared() const = 0;

private:
  /// Return the first of each rank's elements among those of all, and the number of all.
  /// @param mine the number of this rank's
  virtual std::vector<std::size_t> firstsOf(std::size_t mine) = 0;
  /// @param firsts of firstsOf()
  virtual void gatherBytes(const void* mine, void* all, std::size_t elementBytes,
    const std::vector<std::size_t>& firsts) = 0;
};

/// Return the ranks of a process that draws its pictures alone.
Ranks& alone();

} // namespace gnomon
