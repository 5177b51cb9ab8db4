#include "plugin/ranks/Ranks.h"

#include <cstring>

namespace gnomon
{
namespace
{

/// Answers with what it is asked: no other rank waits.
class OneRank : public Ranks
{
public:
  int count() const override { return 1; }
  int own() const override { return 0; }
  std::uint64_t serial() const override { return 0; }
  std::size_t threads() const override { return 0; }

  std::string beginFrame(const std::string& whyNot) override { return whyNot; }
  void endFrame() override {}
  void fail(const std::string&) noexcept override {}

  bool isAny(bool mine) override { return mine; }
  void requireSame(const std::function<std::uint64_t()>&, const std::string&) override {}
  std::int64_t sum(std::int64_t mine) override { return mine; }
  Bounds united(const Bounds& mine) override { return mine; }
  void reduceToLeast(std::vector<float>&) override {}
  void uniteBits(std::vector<std::uint64_t>&) override {}
  std::function<void(std::vector<std::uint64_t>&)> rayExchange() override { return nullptr; }
  std::size_t bytesShared() const override { return 0; }

private:
  std::vector<std::size_t> firstsOf(std::size_t mine) override { return { 0, mine }; }
  void gatherBytes(const void* mine, void* all, std::size_t elementBytes,
    const std::vector<std::size_t>& firsts) override
  {
    if (firsts.back() > 0)
    {
      std::memcpy(all, mine, elementBytes * firsts.back());
    }
  }
};

} // namespace

Ranks& alone()
{
  static OneRank rank;
  return rank;
}

} // namespace gnomon
