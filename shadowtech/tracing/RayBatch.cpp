#include "shadowtech/tracing/RayBatch.h"

#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace gnomon
{
namespace
{

constexpr GLenum target = GL_SHADER_STORAGE_BUFFER;
constexpr std::size_t bytesOfRays = RayBatch::mostRays * sizeof(TracedRay);
constexpr std::size_t bytesOfAnswers = RayBatch::mostRays / 8;

} // namespace

//------------------------------------------------------------------------------
void RayBatch::reserve(RayTransfer transfer)
{
  if (this->answers_)
  {
    return;
  }
  const char* const rays = "a batch's rays";
  const char* const answers = "a batch's answers";
  if (transfer == RayTransfer::Mapped)
  {
    this->mappedRays_ = static_cast<TracedRay*>(
      allocateMappedStorage(this->rays_, bytesOfRays, GL_MAP_WRITE_BIT, rays));
    this->mappedAnswers_ = static_cast<const std::uint32_t*>(
      allocateMappedStorage(this->answers_, bytesOfAnswers, GL_MAP_READ_BIT, answers));
    return;
  }
  allocateStorage(this->rays_, bytesOfRays, nullptr, rays);
  allocateStorage(this->answers_, bytesOfAnswers, nullptr, answers);
}

//------------------------------------------------------------------------------
void RayBatch::send(
  const TracedRay* rays, std::size_t count, GLuint rayBinding, GLuint answerBinding)
{
  this->wait(); // for rays without a receive(), which the GPU may still read
  glBindBufferBase(target, answerBinding, this->answers_.name());
  const GLuint unblocked = 0;
  glClearBufferData(target, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &unblocked);
  glBindBufferBase(target, rayBinding, this->rays_.name());
  if (this->mappedRays_)
  {
    std::copy_n(rays, count, this->mappedRays_);
  }
  else
  {
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(count * sizeof(TracedRay)), rays);
  }
  this->count_ = count;
}

//------------------------------------------------------------------------------
void RayBatch::markSent()
{
  glMemoryBarrier(
    this->mappedAnswers_ ? GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT : GL_BUFFER_UPDATE_BARRIER_BIT);
  this->fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

//------------------------------------------------------------------------------
void RayBatch::wait()
{
  GLenum state = this->fence_ ? GL_TIMEOUT_EXPIRED : GL_ALREADY_SIGNALED;
  while (state == GL_TIMEOUT_EXPIRED)
  {
    constexpr GLuint64 second = 1000000000;
    state = glClientWaitSync(this->fence_, GL_SYNC_FLUSH_COMMANDS_BIT, second);
  }
  this->deleteFence();
  if (state == GL_WAIT_FAILED)
  {
    throw std::runtime_error("OpenGL failed while the GPU was tracing rays");
  }
}

//------------------------------------------------------------------------------
void RayBatch::receive(std::uint8_t* blocked)
{
  this->wait();
  std::vector<std::uint32_t> copied;
  const std::uint32_t* bits = this->mappedAnswers_;
  if (!bits)
  {
    copied.resize((this->count_ + 31) / 32);
    glBindBuffer(target, this->answers_.name());
    glGetBufferSubData(
      target, 0, static_cast<GLsizeiptr>(copied.size() * sizeof(copied[0])), copied.data());
    bits = copied.data();
  }
  for (std::size_t i = 0; i < this->count_; ++i)
  {
    blocked[i] = static_cast<std::uint8_t>((bits[i / 32] >> (i % 32)) & 1u);
  }
}

//------------------------------------------------------------------------------
void RayBatch::deleteFence()
{
  if (this->fence_ && !GlContextLost::lost)
  {
    glDeleteSync(this->fence_);
  }
  this->fence_ = nullptr;
}

//------------------------------------------------------------------------------
std::size_t RayBatch::bytesOnGpu() const
{
  return this->answers_ ? bytesOfRays + bytesOfAnswers : 0;
}

} // namespace gnomon
