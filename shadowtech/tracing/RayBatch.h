#pragma once

#include "shadowtech/base/Gl.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon
{

/// A ray as the GPU reads it, in centred coordinates. It counts from its origin to `rayFar`
/// times its direction, which has any length.
struct TracedRay
{
  glm::vec3 origin;
  float rayFar = std::numeric_limits<float>::infinity(); ///< >= 0
  glm::vec3 direction;
  std::uint32_t pixel = 0; ///< whose ray it is; nobody looks at it while it is traced
};

static_assert(sizeof(TracedRay) == 32, "as trace_rays.comp.glsl reads it");

/// How rays get to the GPU and answers back.
enum class RayTransfer
{
  Mapped, ///< through memory that both sides see all the time (OpenGL 4.4)
  Copied  ///< through copies that OpenGL makes
};

/// A bounded number of rays on their way to the GPU, and their answers, a bit for each, on their
/// way back. While one batch is on its way others can be filled. All calls want the context to be
/// current.
class RayBatch
{
public:
  /// 4 MB: enough to keep a GPU busy, and so few that no driver's watchdog finds it busy for too
  /// long.
  static constexpr std::size_t mostRays = std::size_t(1) << 17;

  RayBatch() = default;
  ~RayBatch() { this->deleteFence(); }
  RayBatch(RayBatch&& other) = delete;

  /// Takes the memory for rays and answers, unless it has.
  /// @throws TextureMemoryError
  void reserve(RayTransfer transfer);

  /// Writes rays, at most `mostRays`, and binds them and their answers, all unblocked so far, for
  /// shaders. Memory must have been reserved.
  void send(const TracedRay* rays, std::size_t count, GLuint rayBinding, GLuint answerBinding);
  /// To be called when the work on what was sent has been given to OpenGL.
  void markSent();

  /// Waits for the answers and writes them, in the order of the rays: 1 for one that is blocked,
  /// else 0.
  /// @param blocked has room for as many as were sent
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
