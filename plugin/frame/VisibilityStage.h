#pragma once

#include "plugin/frame/Frame.h"
#include "plugin/frame/ReceiversOnCpu.h"
#include "plugin/frame/SnapshotTracer.h"
#include "plugin/frame/ValueKey.h"
#include "plugin/scene/SurfaceNames.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/tracing/EdgeSamples.h"
#include "shadowtech/tracing/SharedTracer.h"
#include "shadowtech/tracing/TileVerdicts.h"
#include "shadowtech/tracing/TracedTiles.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// The visibility stage of a renderer's frames: one image for each light, or three, in the view's
/// layers.
class VisibilityStage
{
public:
  /// @param occluders the snapshot, which lives as long as this
  /// @param buffers of the snapshot
  VisibilityStage(Frame& frame, const Occluders& occluders, OccluderBuffers& buffers,
    SnapshotTracer& tracer, ShaderLibrary& shaders);

  /// Decide for each light whether this frame computes its visibility or reuses it. The
  /// receivers are there.
  void findStale();

  /// Computes what is stale, and keeps a copy of all if asked to.
  /// @throws std::runtime_error if there is no tracer
  void compute();

  ///@{
  /// The copy of the last frame that was asked for one.
  const VisibilityImages& images() const { return this->images_; }
  void dropImages();
  ///@}

  /// Return the bytes of the rays at edges.
  std::size_t bytesOfRays() const { return this->edges_.bytes() + this->frame_.onCpu->bytes(); }

private:
  ValueKey keyOf(const CastingLight& casting) const;
  bool classifies() const;
  std::string whyUnfinished(const CastingLight& casting, const VisibilityValue& value) const;
  void agreeOnStale();
  void judge();
  TracedTiles* beginTiles(
    const CastingLight& casting, const ShadowLight& traced, VisibilityValue& value);
  void fill(CastingLight& casting, const TileVerdicts* verdicts, VisibilityValue& value);
  void trace(CastingLight& casting, const TileVerdicts* verdicts, VisibilityValue& value);
  void updateEdges();

  Frame& frame_;
  const Occluders& occluders_;
  OccluderBuffers& buffers_;
  SnapshotTracer& tracer_;
  ShaderLibrary& shaders_;
  EdgeSamples edges_;
  std::vector<float> onCpu_; ///< a light's; kept, as new memory costs more than old
  ///@{
  /// The verdicts on this frame's tiles by light, and the bits of lights that are dark everywhere.
  std::vector<std::optional<TileVerdicts>> verdicts_;
  std::vector<int> darkBits_;
  ///@}
  VisibilityImages images_;
  const ViewValues* imagesOf_ = nullptr; ///< the view that they are of
  std::vector<SurfaceName> imageNames_;  ///< and the names of its surfaces
};

} // namespace gnomon
