#include "shadowtech/base/RayBatch.h"

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

/// Gives a buffer memory that stays visible to the CPU. It is taken back with the buffer.
void* allocateMapped(GlBuffer& buffer, std::size_t bytes, GLbitfield access)
{
  const GLbitfield flags = access | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const auto size = static_cast<GLsizeiptr>(bytes);
  buffer.reset();
  glBindBuffer(target, buffer.create());
  glBufferStorage(target, size, nullptr, flags);
  void* mapped = glMapBufferRange(target, 0, size, flags);
  if (!mapped)
  {
    buffer.reset();
    throw TextureMemoryError("OpenGL has no memory for a batch of rays, or does not map it");
  }
  return mapped;
}

} // namespace

//------------------------------------------------------------------------------
void RayBatch::allocate(RayTransfer transfer)
{
  if (transfer == RayTransfer::Mapped)
  {
    this->mappedRays_ =
      static_cast<TracedRay*>(allocateMapped(this->rays_, bytesOfRays, GL_MAP_WRITE_BIT));
    this->mappedAnswers_ = static_cast<const std::uint32_t*>(
      allocateMapped(this->answers_, bytesOfAnswers, GL_MAP_READ_BIT));
    return;
  }
  allocateStorage(this->rays_, bytesOfRays, nullptr, "a batch's rays");
  allocateStorage(this->answers_, bytesOfAnswers, nullptr, "a batch's answers");
}

//------------------------------------------------------------------------------
void RayBatch::send(const TracedRay* rays, std::size_t count, RayTransfer transfer,
  GLuint rayBinding, GLuint answerBinding)
{
  if (!this->answers_)
  {
    this->allocate(transfer);
  }
  this->wait(); // for what nobody received, which may still be read
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
