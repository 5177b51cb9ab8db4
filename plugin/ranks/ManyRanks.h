#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/ranks/Ranks.h"

#include <vtkSmartPointer.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkMultiProcessController;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The ranks of VTK's controller.
class ManyRanks : public Ranks
{
public:
  /// Count the ranks, and those on this rank's machine; collective.
  /// @throws RankFailure if the ranks cannot reach each other
  explicit ManyRanks(vtkMultiProcessController* controller);
  ~ManyRanks() override;

  vtkMultiProcessController* controller() const;

  int count() const override { return this->count_; }
  int own() const override { return this->own_; }
  std::uint64_t serial() const override { return this->serial_; }
  std::size_t threads() const override { return this->threads_; }

  std::string beginFrame(const std::string& whyNot) override;
  void endFrame() override;
  void fail(const std::string& error) noexcept override;

  bool isAny(bool mine) override;
  void requireSame(const std::function<std::uint64_t()>& number, const std::string& what) override;
  std::int64_t sum(std::int64_t mine) override;
  Bounds united(const Bounds& mine) override;
  void reduceToLeast(std::vector<float>& numbers) override;
  void uniteBits(std::vector<std::uint64_t>& bits) override;
  std::function<void(std::vector<std::uint64_t>& bits)> rayExchange() override
  {
    return [this](std::vector<std::uint64_t>& bits) { this->uniteBits(bits); };
  }
  std::size_t bytesShared() const override { return this->bytesShared_; }

private:
  std::string firstFailure(const std::string& mine);
  void agree();
  [[noreturn]] void giveUp();
  template <typename Number>
  void reduce(std::vector<Number>& numbers, int operation);
  std::vector<std::size_t> firstsOf(std::size_t mine) override;
  void gatherBytes(const void* mine, void* all, std::size_t elementBytes,
    const std::vector<std::size_t>& firsts) override;

  vtkSmartPointer<vtkMultiProcessController> controller_;
  int count_;
  int own_;
  std::uint64_t serial_;
  std::size_t threads_ = 1;
  bool othersWait_ = false; ///< true while other ranks may wait for this one
  std::size_t bytesShared_ = 0;
};

} // namespace gnomon
