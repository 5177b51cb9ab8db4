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

/// Whether OpenGL draws on the CPU, by the name of its renderer (GL_RENDERER): there, tracing on
/// the GPU is tracing on the CPU by a slower road.
bool isSoftwareRenderer(const std::string& renderer);

/// Shadow rays against the casting surfaces on the GPU, by compute shaders (OpenGL 4.3).
///
/// It answers as EmbreeTracer does, but for rays that pass an edge of a triangle, or end on one, to
/// within a rounding. There it has no cracks: a ray that goes through a closed surface is blocked,
/// at corners too. The answers are the same whatever tree is built, on any GPU that rounds as IEEE
/// 754 says.
///
/// All calls want the context to be current. They leave OpenGL's state as it was.
class GpuTracer
{
public:
  /// Takes the fastest way for rays and answers that the context knows.
  GpuTracer();
  explicit GpuTracer(RayTransfer transfer);

  /// What the current context lacks; empty where it has all.
  static std::string whyUnsupported();

  /// Brings the acceleration structure up to date with the snapshot.
  /// @param buffers up to date with it, too; they must stay until the next update, as their
  /// positions are read while rays are traced
  /// @throws TextureMemoryError where there is no room, and std::runtime_error as
  /// CasterBvh::update(); nothing blocks rays then
  CasterBvh::Change update(const Occluders& occluders, const OccluderBuffers& buffers);

  /// Whether nothing casts.
  bool empty() const { return this->bvh_.empty(); }

  /// Traces rays from their origin (shadowRayNear) to their far end. Both sides of a triangle block
  /// unless its surface is one-sided; holes do not. Rays with numbers that are not finite, other
  /// than the far end, or without a direction are not blocked.
  ///
  /// @param blocked resized to the rays, in their order: 1 where something is in the way, else 0
  /// @throws ShaderError; std::runtime_error if the context is lost
  void trace(const TracedRay* rays, std::size_t count, ShaderLibrary& shaders,
    std::vector<std::uint8_t>& blocked);

  std::size_t bytes() const { return this->bvh_.bytes(); }
  /// What is kept on the GPU, the snapshot's positions excepted.
  std::size_t bytesOnGpu() const;

private:
  void sendScene(const Occluders& occluders);
  GLuint useProgram(ShaderLibrary& shaders) const;
  void bindScene() const;

  RayTransfer transfer_;
  CasterBvh bvh_;
  GLuint positions_ = 0; ///< the OccluderBuffers'
  GlBuffer nodes_;
  GlBuffer records_;
  GlBuffer instances_;
  GlBuffer cutouts_;
  GlBuffer textureCoordinates_;
  std::size_t bytesOfScene_ = 0;
  std::array<RayBatch, 3> batches_; ///< one is filled, one traced, one read
};

} // namespace gnomon
