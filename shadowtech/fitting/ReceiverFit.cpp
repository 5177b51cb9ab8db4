#include "shadowtech/fitting/ReceiverFit.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <array>
#include <cstdint>

namespace gnomon
{
namespace
{

/// Neighbours that go along a row together, and the rows that they take: eight are as many as software
/// OpenGL works on at once, and read memory in its order (of 8, 32 and 64 these took the least time, by
/// half). Few enough groups that the atomic operations at their end do not count.
constexpr int invocationsPerGroup = 8;
constexpr int rowsPerGroup = 8;
constexpr int numbersPerBox = 6;
constexpr int fitRows = 2;

/// Puts back what computing binds, besides what GlStateGuard does.
class ComputeBindingsGuard
{
public:
  ComputeBindingsGuard()
  {
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &this->buffer_);
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &this->indexedBuffer_);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 0, &this->start_);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 0, &this->size_);
    glGetIntegeri_v(GL_IMAGE_BINDING_NAME, 0, &this->image_);
    glGetIntegeri_v(GL_IMAGE_BINDING_LEVEL, 0, &this->level_);
    glGetIntegeri_v(GL_IMAGE_BINDING_LAYERED, 0, &this->layered_);
    glGetIntegeri_v(GL_IMAGE_BINDING_LAYER, 0, &this->layer_);
    glGetIntegeri_v(GL_IMAGE_BINDING_ACCESS, 0, &this->access_);
    glGetIntegeri_v(GL_IMAGE_BINDING_FORMAT, 0, &this->format_);
  }
  ~ComputeBindingsGuard()
  {
    glBindImageTexture(0, static_cast<GLuint>(this->image_), this->level_,
      static_cast<GLboolean>(this->layered_), this->layer_, static_cast<GLenum>(this->access_),
      static_cast<GLenum>(this->format_));
    const auto indexed = static_cast<GLuint>(this->indexedBuffer_);
    this->size_ > 0 ? glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, indexed,
                        static_cast<GLintptr>(this->start_), static_cast<GLsizeiptr>(this->size_))
                    : glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, indexed);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(this->buffer_));
  }
  ComputeBindingsGuard(const ComputeBindingsGuard&) = delete;
  ComputeBindingsGuard& operator=(const ComputeBindingsGuard&) = delete;

private:
  GLint buffer_ = 0, indexedBuffer_ = 0;
  GLint64 start_ = 0, size_ = 0;
  GLint image_ = 0, level_ = 0, layered_ = 0, layer_ = 0, access_ = 0, format_ = 0;
};

/// What there can be to see on the map before the last fit. A warp is laid around that, and has its border
/// inside; other maps are laid around the casters.
Rectangle coveredBeforeFit(const ShadowLight& light, const MapTexels& texels)
{
  return isWarped(light) ? wholeMap : texels.covered();
}

/// Adds all receivers to the boxes.
void reduce(const ShadowLight& light, const std::vector<Uniform>& uniforms,
  const ReceiverTextures& receivers, ShaderLibrary& shaders, std::vector<std::string> defines)
{
  const std::string source = numberedForLight(lightViewsDefines(light) +
      ShaderLibrary::source("shadowtech/fitting/receiver_bounds.comp.glsl"),
    0);
  defines.push_back("GROUP " + std::to_string(invocationsPerGroup));
  defines.push_back("ROWS " + std::to_string(rowsPerGroup));
  const GLuint program = shaders.program({ { GL_COMPUTE_SHADER, source } }, defines);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  const int groups = (receivers.height + rowsPerGroup - 1) / rowsPerGroup;
  glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

} // namespace

//------------------------------------------------------------------------------
void ReceiverFit::allocate(int views)
{
  if (this->views_ == views)
  {
    return;
  }
  // One box more, for the distances from the camera.
  const GLsizeiptr bytes = (views + 1) * numbersPerBox * GLsizeiptr(sizeof(GLuint));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->bounds_.create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_COPY);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->fits_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, views, fitRows, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  this->views_ = views;
}

//------------------------------------------------------------------------------
void ReceiverFit::compute(const ShadowLight& light, const LightViews& views,
  const ReceiverTextures& receivers, const glm::dmat4& centredFromView, ShaderLibrary& shaders)
{
  if (views.views.empty())
  {
    return;
  }
  const GlStateGuard guard;
  const ComputeBindingsGuard computeGuard;
  // As many as the shaders' arrays have, some of which a cube may not use.
  const int count = mostViews(light);
  this->allocate(count);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, this->bounds_.name());
  const GLuint keyOfNone = 0xffffffffu;
  glClearBufferData(
    GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &keyOfNone);

  const MapTexels texels{ light.mapSizeTexels, views.borderTexels };
  const Rectangle covered = coveredBeforeFit(light, texels);
  std::vector<Uniform> uniforms = lightViewsUniforms(views, texels.side, { centredFromView });
  uniforms.push_back({ "receiverFragments", TextureBinding{ GL_TEXTURE_2D, receivers.fragments } });
  uniforms.push_back({ "receiverPoints", TextureBinding{ GL_TEXTURE_2D, receivers.points } });
  uniforms.push_back({ "splitLambda", static_cast<float>(light.splitLambda) });
  uniforms.push_back({ "coveredTexels",
    glm::vec2(0.5 * texels.side * (glm::dvec2(covered.lower.x, covered.upper.x) + 1.0)) });
  if (views.layout == ViewLayout::Splits)
  {
    reduce(light, uniforms, receivers, shaders, { "DISTANCES" });
  }
  reduce(light, uniforms, receivers, shaders, {});

  const GLuint program = shaders.program(
    { { GL_COMPUTE_SHADER, ShaderLibrary::source("shadowtech/fitting/fit_views.comp.glsl") } });
  glUseProgram(program);
  ShaderLibrary::setUniforms(program,
    { { "side", static_cast<float>(texels.side) },
      { "inside", static_cast<float>(texels.inside()) },
      { "covered", static_cast<float>(covered.upper.x) },
      { "leastShare", static_cast<float>(leastVisibleShare) },
      { "snapped", light.snap && !isWarped(light) ? 1 : 0 } },
    0, 0);
  glBindImageTexture(0, this->fits_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glDispatchCompute(static_cast<GLuint>(count), 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

//------------------------------------------------------------------------------
std::vector<Bounds> ReceiverFit::readBounds() const
{
  const GlStateGuard guard;
  const ComputeBindingsGuard computeGuard;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::array<std::uint32_t, numbersPerBox>> keys(
    static_cast<std::size_t>(this->views_));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->bounds_.name());
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
    static_cast<GLsizeiptr>(keys.size() * sizeof(keys[0])), keys.data());
  // ofKey() of bounds_buffer.glsl.
  const auto number = [](std::uint32_t key)
  {
    const std::uint32_t bits = (key & 0x80000000u) ? key & 0x7fffffffu : ~key;
    return static_cast<double>(glm::uintBitsToFloat(bits));
  };
  std::vector<Bounds> result(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    if (keys[i][0] != 0xffffffffu)
    {
      result[i].lower = { number(keys[i][0]), number(keys[i][1]), number(keys[i][2]) };
      result[i].upper = { -number(keys[i][3]), -number(keys[i][4]), -number(keys[i][5]) };
    }
  }
  return result;
}

//------------------------------------------------------------------------------
std::vector<MapFit> ReceiverFit::readFits() const
{
  const GlStateGuard guard;
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  std::vector<glm::vec4> texels(static_cast<std::size_t>(this->views_ * fitRows));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->fits_.name());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, texels.data());
  std::vector<MapFit> result;
  for (int view = 0; view < this->views_; ++view)
  {
    const glm::dvec4 fit(texels[static_cast<std::size_t>(view)]);
    result.push_back({ { fit.x, fit.y }, { fit.z, fit.w } });
  }
  return result;
}

} // namespace gnomon
