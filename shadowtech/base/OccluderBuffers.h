#ifndef gnomon_shadowtech_base_OccluderBuffers_h
#define gnomon_shadowtech_base_OccluderBuffers_h

#include "lights/LightView.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The snapshot's casting surfaces on the GPU, for drawing maps.
class OccluderBuffers
{
public:
  /// Brings the buffers up to date; only what changed is sent.
  void update(const Occluders& occluders);

  /// Draws the casting triangles with the program in use, whose vertex shader includes
  /// occluder_vertex.glsl.
  /// Surfaces that a perspective view cannot see are left out; an affine one is taken to see all.
  /// One-sided surfaces are drawn with their back faces culled, "front" being what the current view
  /// sees counter-clockwise.
  void draw(const LightView& view) const;

  /// On the GPU, and what is remembered of each surface.
  std::size_t bytes() const;

private:
  /// One surface's indices, and the box around what they lead to.
  struct Part
  {
    GLsizei first;
    GLsizei count;
    std::uint64_t positionsVersion; ///< as sent
    Bounds boundsCentred;
    GLuint firstInstance = 0; ///< in instances_; 0 is the identity, which what is drawn once takes
    GLsizei instances = 0;    ///< 0: drawn once
  };
  void sendAll(const Occluders& occluders);
  void sendInstances(const Occluders& occluders);
  void sendMoved(const Occluders& occluders);
  std::vector<Part>& partsOf(const Surface& surface);
  void drawParts(const std::vector<Part>& parts, const LightView& view) const;

  GlVertexArray vertexArray_;
  GlBuffer positions_;
  GlBuffer indices_;
  GlBuffer instances_; ///< matrices: the identity, then those of all drawn surfaces with instances
  std::vector<Part> twoSided_;
  std::vector<Part> oneSided_;
  std::size_t bytesOnGpu_ = 0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon

#endif
