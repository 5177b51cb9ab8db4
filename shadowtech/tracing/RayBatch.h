#pragma once

#include "shadowtech/base/Gl.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon
{

/// A ray in the GPU's layout, in centred coordinates. It counts from its origin to `rayFar` times
/// its direction, which has any length.
struct TracedRay
{
  glm::vec3 origin;
  float rayFar = std::numeric_limits<float>::infinity(); ///< >= 0
  glm::vec3 direction;
  std::uint32_t pixel = 0; ///< the ray's pixel; unused by the tracer
};

static_assert(sizeof(TracedRay) == 32, "as trace_rays.comp.glsl reads it");

/// How rays are sent to the GPU and answers are read back.
enum class RayTransfer
{
  Mapped, ///< by persistently mapped memory (OpenGL 4.4)
  Copied  ///< by copies that OpenGL makes
};

/// A bounded number of rays on their way to the GPU, and their answers, a bit each, on their way
/// back. Other batches can be filled meanwhile. All calls need the context to be current.
class RayBatch
{
public:
  /// 4 MB of rays: enough to keep a GPU busy, but too few to trigger a driver's watchdog.
  static constexpr std::size_t mostRays = std::size_t(1) << 17;

  RayBatch() = default;
  ~RayBatch() { this->deleteFence(); }
  RayBatch(RayBatch&& other) = delete;

  /// Allocate the memory for rays and answers, unless already done.
  /// @throws TextureMemoryError
  void reserve(RayTransfer transfer);

  /// Write rays, at most `mostRays`, and bind them and their cleared answers for shaders. Memory
  /// must have been reserved.
  void send(const TracedRay* rays, std::size_t count, GLuint rayBinding, GLuint answerBinding);
  /// Mark the end of the work on the sent rays. Called after its dispatch.
  void markSent();

  /// Wait for the answers and write them, in the order of the rays: 1 for a blocked ray, else 0.
  /// @param blocked has room for the sent rays
  /// @throws std::runtime_error if the context is lost
  void receive(std::uint8_t* blocked);

  std::size_t bytesOnGpu() const;

private:
  void wait();
  void deleteFence();

  GlBuffer rays_;
  GlBuffer answers_;
  TracedRay* mappedRays_ = nullptr;              ///< null where they are copied
  const std::uint32_t* mappedAnswers_ = nullptr; ///< null where they are copied
  GLsync fence_ = nullptr;
  std::size_t count_ = 0;
};

} // namespace gnomon
