#include "shadowtech/tracing/GpuTracer.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <map>

namespace gnomon
{
namespace
{

/// Bindings of buffers, as in the shaders.
enum TracerBinding : GLuint
{
  nodesBinding,
  recordsBinding,
  positionsBinding,
  raysBinding,
  blockedBinding,
  instancesBinding,
  cutoutsBinding,
  textureCoordinatesBinding,
  tracerBindings
};

constexpr int raysPerGroup = 64;

/// Stack sizes are multiples of this, so that scenes share programs.
constexpr int stackStep = 16;

/// Allocate and fill a buffer; without elements, release it.
/// @return its bytes
template <typename Element>
std::size_t send(GlBuffer& buffer, const std::vector<Element>& elements, const char* what)
{
  const std::size_t bytes = elements.size() * sizeof(Element);
  elements.empty() ? buffer.reset() : allocateStorage(buffer, bytes, elements.data(), what);
  return bytes;
}

/// Overwrite a buffer with as many elements as it has.
template <typename Element>
void resend(const GlBuffer& buffer, const std::vector<Element>& elements)
{
  if (!elements.empty())
  {
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
      static_cast<GLsizeiptr>(elements.size() * sizeof(Element)), elements.data());
  }
}

void bind(TracerBinding binding, GLuint buffer)
{
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

/// The data by which cutout_mask.glsl finds a surface's mask, and all masks as bits. Surfaces may
/// share masks.
class CutoutTable
{
public:
  explicit CutoutTable(std::size_t surfaces)
    : numbers_(surfaces * numbersOfSurface)
  {
  }

  void add(const Surface& surface)
  {
    const CutoutMask& mask = *surface.cutout;
    const auto [found, isNew] = this->firstWords_.emplace(&mask, this->numbers_.size());
    if (isNew)
    {
      this->appendBits(mask);
    }
    const std::uint32_t reading = static_cast<std::uint32_t>(mask.wrap) |
      (mask.interpolated ? 4u : 0u) | (mask.borderDrawn ? 8u : 0u);
    const std::array<std::uint32_t, numbersOfSurface> numbers = { static_cast<std::uint32_t>(
                                                                    this->coordinates_.size()) -
        surface.firstVertex, // may wrap around
      static_cast<std::uint32_t>(found->second), reading, static_cast<std::uint32_t>(mask.width),
      static_cast<std::uint32_t>(mask.height) };
    std::copy(numbers.begin(), numbers.end(), &this->numbers_[this->added_++ * numbersOfSurface]);
    this->coordinates_.insert(this->coordinates_.end(), surface.textureCoordinates.begin(),
      surface.textureCoordinates.end());
  }

  const std::vector<std::uint32_t>& numbers() const { return this->numbers_; }
  const std::vector<glm::vec2>& coordinates() const { return this->coordinates_; }

private:
  static constexpr std::size_t numbersOfSurface = 5;

  void appendBits(const CutoutMask& mask)
  {
    const std::size_t first = this->numbers_.size();
    this->numbers_.resize(first + (mask.texels.size() + 31) / 32);
    for (std::size_t i = 0; i < mask.texels.size(); ++i)
    {
      this->numbers_[first + i / 32] |= (mask.texels[i] > 0 ? 1u : 0u) << (i % 32);
    }
  }

  std::vector<std::uint32_t> numbers_;
  std::vector<glm::vec2> coordinates_;
  std::map<const CutoutMask*, std::size_t> firstWords_;
  std::size_t added_ = 0;
};

} // namespace

//------------------------------------------------------------------------------
bool isSoftwareRenderer(const std::string& renderer)
{
  // The software renderers of Mesa, Google and Microsoft.
  const std::array<const char*, 7> names = { "llvmpipe", "softpipe", "SWR", "Software Rasterizer",
    "SwiftShader", "GDI Generic", "Microsoft Basic Render" };
  return std::any_of(names.begin(), names.end(),
    [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

//------------------------------------------------------------------------------
GpuTracer::GpuTracer()
  : GpuTracer(GNOMON_HAS_GL(VERSION_4_4) || GNOMON_HAS_GL(ARB_buffer_storage) ? RayTransfer::Mapped
                                                                              : RayTransfer::Copied)
{
}

//------------------------------------------------------------------------------
GpuTracer::GpuTracer(RayTransfer transfer)
  : transfer_(transfer)
{
}

//------------------------------------------------------------------------------
std::string GpuTracer::whyUnsupported()
{
  if (!GNOMON_HAS_GL(VERSION_4_3))
  {
    const GLubyte* version = glGetString(GL_VERSION);
    return std::string("tracing on the GPU needs OpenGL 4.3, and this is ") +
      (version ? reinterpret_cast<const char*>(version) : "none");
  }
  GLint buffers = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &buffers);
  return buffers >= static_cast<GLint>(tracerBindings) ? std::string()
                                                       : "compute shaders support too few buffers";
}

//------------------------------------------------------------------------------
CasterBvh::Change GpuTracer::update(const Occluders& occluders, const OccluderBuffers& buffers)
{
  this->positions_ = buffers.positions();
  const CasterBvh::Change change = this->bvh_.update(occluders);
  const StorageBindingsGuard guard(0);
  if (change == CasterBvh::Change::Built)
  {
    this->sendScene(occluders);
  }
  else if (change == CasterBvh::Change::Refitted)
  {
    resend(this->nodes_, this->bvh_.nodes());
    resend(this->instances_, this->bvh_.instances());
  }
  return change;
}

//------------------------------------------------------------------------------
void GpuTracer::sendScene(const Occluders& occluders)
{
  CutoutTable cutouts(this->bvh_.cutoutSurfaces().size());
  for (const std::size_t surface : this->bvh_.cutoutSurfaces())
  {
    cutouts.add(occluders.surfaces[surface]);
  }
  try
  {
    requireRoomForStorage(
      occluders.positionsCentred.size() * sizeof(glm::vec3), "the ray tracer's vertices");
    this->bytesOfScene_ = send(this->nodes_, this->bvh_.nodes(), "the ray tracer's boxes") +
      send(this->records_, this->bvh_.records(), "the ray tracer's triangles") +
      send(this->instances_, this->bvh_.instances(), "the ray tracer's instances") +
      send(this->cutouts_, cutouts.numbers(), "the ray tracer's textures with holes") +
      send(
        this->textureCoordinates_, cutouts.coordinates(), "the ray tracer's texture coordinates");
    for (RayBatch& batch : this->batches_)
    {
      batch.reserve(this->transfer_);
    }
  }
  catch (const TextureMemoryError&)
  {
    this->bvh_ = CasterBvh(); // the next update builds again
    this->bytesOfScene_ = 0;
    throw;
  }
}

//------------------------------------------------------------------------------
GLuint GpuTracer::useProgram(ShaderLibrary& shaders) const
{
  const int stack = (this->bvh_.stackSize() + stackStep - 1) / stackStep * stackStep;
  std::vector<std::string> defines{ "GROUP " + std::to_string(raysPerGroup),
    "STACK " + std::to_string(stack) };
  if (!this->bvh_.instances().empty())
  {
    defines.emplace_back("INSTANCES");
  }
  if (!this->bvh_.cutoutSurfaces().empty())
  {
    defines.emplace_back("CUTOUTS");
  }
  static const std::string source =
    ShaderLibrary::source("shadowtech/tracing/trace_rays.comp.glsl");
  const GLuint program = shaders.program({ { GL_COMPUTE_SHADER, source } }, defines);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program,
    { { "root", static_cast<int>(this->bvh_.root()) },
      { "lowerCentred", glm::vec3(this->bvh_.bounds().lower) },
      { "upperCentred", glm::vec3(this->bvh_.bounds().upper) } },
    0, 0);
  return program;
}

//------------------------------------------------------------------------------
void GpuTracer::bindScene() const
{
  bind(nodesBinding, this->nodes_.name());
  bind(recordsBinding, this->records_.name());
  bind(positionsBinding, this->positions_);
  bind(instancesBinding, this->instances_.name());
  bind(cutoutsBinding, this->cutouts_.name());
  bind(textureCoordinatesBinding, this->textureCoordinates_.name());
}

//------------------------------------------------------------------------------
void GpuTracer::trace(const TracedRay* rays, std::size_t count, ShaderLibrary& shaders,
  std::vector<std::uint8_t>& blocked)
{
  blocked.assign(count, 0);
  if (this->bvh_.empty() || count == 0)
  {
    return;
  }
  const GlStateGuard guard;
  const StorageBindingsGuard bindingsGuard(tracerBindings);
  const GLuint program = this->useProgram(shaders);
  this->bindScene();
  const auto firstOf = [](std::size_t batch) { return batch * RayBatch::mostRays; };
  const std::size_t batches = (count + RayBatch::mostRays - 1) / RayBatch::mostRays;
  const std::size_t atOnce = std::min(batches, this->batches_.size());
  for (std::size_t i = 0; i < batches; ++i)
  {
    RayBatch& batch = this->batches_[i % this->batches_.size()];
    if (i >= atOnce)
    {
      batch.receive(&blocked[firstOf(i - atOnce)]);
    }
    const std::size_t size = std::min(count - firstOf(i), RayBatch::mostRays);
    batch.send(rays + firstOf(i), size, raysBinding, blockedBinding);
    ShaderLibrary::setUniform(program, { "rayCount", static_cast<int>(size) });
    glDispatchCompute(static_cast<GLuint>((size + raysPerGroup - 1) / raysPerGroup), 1, 1);
    batch.markSent();
  }
  for (std::size_t i = batches - atOnce; i < batches; ++i)
  {
    this->batches_[i % this->batches_.size()].receive(&blocked[firstOf(i)]);
  }
}

//------------------------------------------------------------------------------
std::size_t GpuTracer::bytesOnGpu() const
{
  return this->bytesOfScene_ + bytesOfAll(this->batches_, &RayBatch::bytesOnGpu);
}

} // namespace gnomon
