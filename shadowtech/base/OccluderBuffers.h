#ifndef gnomon_shadowtech_base_OccluderBuffers_h
#define gnomon_shadowtech_base_OccluderBuffers_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>

namespace gnomon
{

/// The snapshot's casting surfaces on the GPU, for drawing maps.
class OccluderBuffers
{
public:
  /// Brings the buffers up to date; only what changed is sent.
  void update(const Occluders& occluders);

  /// Draws all casting triangles with the program in use; the position is attribute 0, a vec3.
  /// One-sided surfaces are drawn with their back faces culled, "front" being what the current view
  /// sees counter-clockwise.
  void draw() const;

  std::size_t bytes() const { return this->bytes_; }

private:
  GlVertexArray vertexArray_;
  GlBuffer positions_;
  GlBuffer indices_;
  GLsizei twoSidedCount_ = 0;
  GLsizei oneSidedCount_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon

#endif
