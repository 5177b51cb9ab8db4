#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/tracing/CasterBvh.h"
#include "shadowtech/tracing/RayBatch.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// True if OpenGL draws on the CPU, by the name of its renderer (GL_RENDERER). Compute shaders
/// would then trace on the CPU, more slowly than Embree.
bool isSoftwareRenderer(const std::string& renderer);

/// Traces shadow rays against the casting surfaces on the GPU, by compute shaders (OpenGL 4.3).
///
/// Its answers are EmbreeTracer's, except for rays that pass an edge of a triangle, or end on a
/// triangle, to within a rounding. There it has no cracks: a ray through a closed surface is
/// blocked, at corners too. The answers depend neither on the tree nor on the GPU, if it rounds as
/// IEEE 754 requires.
///
/// All calls need the context to be current. They restore OpenGL's state.
class GpuTracer
{
public:
  /// Use the fastest transfer of rays and answers that the context supports.
  GpuTracer();
  explicit GpuTracer(RayTransfer transfer);

  /// Return what the current context lacks; empty if it lacks nothing.
  static std::string whyUnsupported();

  /// Update the acceleration structure for the snapshot.
  /// @param buffers of the same snapshot. They must live until the next update, because tracing
  /// reads their positions
  /// @throws TextureMemoryError if there is no room, and std::runtime_error like
  /// CasterBvh::update(). Nothing blocks rays then
  CasterBvh::Change update(const Occluders& occluders, const OccluderBuffers& buffers);

  /// True if nothing casts.
  bool empty() const { return this->bvh_.empty(); }

  /// Trace rays from their origin (shadowRayNear) to their far end. Both sides of a triangle block
  /// unless its surface is one-sided; holes do not block. Rays without a direction, or with numbers
  /// that are not finite, are not blocked; the far end may be infinite.
  ///
  /// @param blocked resized to the rays, in their order: 1 if a caster blocks the ray, else 0
  /// @throws ShaderError; std::runtime_error if the context is lost
  void trace(const TracedRay* rays, std::size_t count, ShaderLibrary& shaders,
    std::vector<std::uint8_t>& blocked);

  std::size_t bytes() const { return this->bvh_.bytes(); }
  /// Return the bytes on the GPU, without the snapshot's positions.
  std::size_t bytesOnGpu() const;

private:
  void sendScene(const Occluders& occluders);
  GLuint useProgram(ShaderLibrary& shaders) const;
  void bindScene() const;

  RayTransfer transfer_;
  CasterBvh bvh_;
  GLuint positions_ = 0; ///< of the OccluderBuffers
  GlBuffer nodes_;
  GlBuffer records_;
  GlBuffer instances_;
  GlBuffer cutouts_;
  GlBuffer textureCoordinates_;
  std::size_t bytesOfScene_ = 0;
  std::array<RayBatch, 3> batches_; ///< one is written, one traced, one read
};

} // namespace gnomon
