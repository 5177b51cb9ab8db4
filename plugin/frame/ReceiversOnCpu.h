#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/ranks/SharedPatches.h"
#include "plugin/ranks/SharedReceivers.h"
#include "plugin/scene/OccluderCollector.h"
#include "plugin/scene/SurfaceNames.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/tracing/EdgeSamples.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace gnomon
{

/// The receivers of the view's picture on the CPU, for techniques that trace: those of this process
/// alone (OwnReceivers) or of several (ReceiversOfRanks). They are read back where a stage first
/// asks.
class ReceiversOnCpu
{
public:
  /// @param names of the snapshot's surfaces, if the plan names them
  ReceiversOnCpu(
    Frame& frame, const OccluderCollector& collector, const std::vector<SurfaceName>& names);
  virtual ~ReceiversOnCpu() = default;

  virtual Receivers& receivers() = 0;
  /// Return the snapshot that has the receivers' surfaces, and the names of these.
  virtual const Occluders& surfaces() = 0;
  virtual const std::vector<SurfaceName>& names() const = 0;
  /// Make ready for this frame's tracing.
  virtual void prepare() = 0;
  /// Call a function that smooths edges (EdgeSamples::smooth()).
  /// @param smooth is given the picture that several processes draw; null for one
  virtual void smoothEdges(const std::function<void(const SharedPicture* several)>& smooth) = 0;
  virtual std::size_t bytes() const { return 0; }

protected:
  void readImages();

  Frame& frame_;
  const OccluderCollector& collector_;
  const std::vector<SurfaceName>& names_;
};

/// All receivers are this process's.
class OwnReceivers : public ReceiversOnCpu
{
public:
  using ReceiversOnCpu::ReceiversOnCpu;

  Receivers& receivers() override;
  const Occluders& surfaces() override { return this->collector_.occluders(); }
  const std::vector<SurfaceName>& names() const override { return this->names_; }
  /// Store receivers that serve several images: those of several lights, or of a light that moves
  /// over them.
  void prepare() override;
  void smoothEdges(const std::function<void(const SharedPicture* several)>& smooth) override
  {
    smooth(nullptr);
  }
};

/// Each rank draws receivers of its own and shares them.
class ReceiversOfRanks : public ReceiversOnCpu
{
public:
  /// @param patches of the snapshot, which this names
  ReceiversOfRanks(Frame& frame, const OccluderCollector& collector,
    const std::vector<SurfaceName>& names, SharedPatches& patches);

  Receivers& receivers() override { return this->shared().receivers(); }
  const Occluders& surfaces() override { return this->shared().surfaces(); }
  const std::vector<SurfaceName>& names() const override;
  /// Share the receivers; and the surface of each pixel, if edges of lights are smoothed.
  void prepare() override;
  void smoothEdges(const std::function<void(const SharedPicture* several)>& smooth) override;
  std::size_t bytes() const override { return this->samples_.bytes(); }

private:
  SharedReceivers& shared();
  void share(const ReceiverPixels& own, SharedReceivers& shared);

  SharedPatches& patches_;
  SharedReceivers samples_; ///< of edges
};

} // namespace gnomon
