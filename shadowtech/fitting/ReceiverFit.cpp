#include "shadowtech/fitting/ReceiverFit.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{
namespace
{

/// The invocations that go along a row side by side, and the rows of a group. Software OpenGL works
/// on eight invocations at once, and reads memory in its order (of 8, 32 and 64, eight took the
/// least time, by half). Groups are few enough that the atomic operations at their end do not
/// count.
constexpr int invocationsPerGroup = 8;
constexpr int rowsPerGroup = 8;
constexpr int numbersPerBox = 6;
/// The rows of fit_rows.glsl: of the fits alone, and with the chosen warp.
constexpr int fitRows = 2;
constexpr int chosenRows = fitRows + 9;
/// A warp's own rows: mapFromAcross, and the rows of a chosen warp (fit_rows.glsl).
constexpr int warpRows = 3 + 9;
/// Warps are compared on pixels of a grid of this many columns and rows. A power of two.
constexpr int samplesAcross = 64;

/// Restores the bindings of compute shaders that GlStateGuard does not restore.
class ComputeBindingsGuard
{
public:
  ComputeBindingsGuard()
  {
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
  }
  ComputeBindingsGuard& operator=(ComputeBindingsGuard&&) = delete; ///< nor copied

private:
  StorageBindingsGuard buffer_;
  GLint image_ = 0, level_ = 0, layered_ = 0, layer_ = 0, access_ = 0, format_ = 0;
};

/// Return the part of the map that can be visible before the last fit. A warp is laid around that
/// part, and has its border inside; other maps are laid around the casters.
Rectangle coveredBeforeFit(const ShadowLight& light, const MapTexels& texels)
{
  return isWarped(light) ? wholeMap : texels.covered();
}

void useProgram(const char* path, const ShadowLight& light, const std::vector<Uniform>& uniforms,
  ShaderLibrary& shaders, const std::vector<std::string>& defines)
{
  const std::string source =
    numberedForLight(lightViewsDefines(light) + ShaderLibrary::source(path), 0);
  const GLuint program = shaders.program({ { GL_COMPUTE_SHADER, source } }, defines);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
}

/// Add all receivers to the boxes.
void reduce(const ShadowLight& light, const std::vector<Uniform>& uniforms,
  const ReceiverTextures& receivers, ShaderLibrary& shaders, std::vector<std::string> defines)
{
  defines.push_back("GROUP " + std::to_string(invocationsPerGroup));
  defines.push_back("ROWS " + std::to_string(rowsPerGroup));
  useProgram("shadowtech/fitting/receiver_bounds.comp.glsl", light, uniforms, shaders, defines);
  const int groups = (receivers.height + rowsPerGroup - 1) / rowsPerGroup;
  glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void addColumns(const glm::dmat3& matrix, std::vector<glm::vec4>& rows)
{
  for (int column = 0; column < 3; ++column)
  {
    rows.emplace_back(glm::dvec4(matrix[column], 0.0));
  }
}

void setNearest()
{
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

} // namespace

std::vector<glm::vec4> chosenWarpRows(
  const LightView& view, const glm::dmat3& mapFromAcross, int sizeTexels)
{
  const glm::dmat3 texels = texelFromAcross(mapFromAcross, sizeTexels);
  std::vector<glm::vec4> rows;
  addColumns(texels, rows);
  addColumns(glm::inverse(texels), rows);
  addColumns(mapFromAcross * glm::inverse(view.mapFromAcross), rows);
  return rows;
}

void ReceiverFit::allocate(int views, int rows)
{
  if (this->views_ == views && this->rows_ == rows)
  {
    return;
  }
  // One box more, for the distances from the camera.
  const GLsizeiptr bytes = (views + 1) * numbersPerBox * GLsizeiptr(sizeof(GLuint));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->bounds_.create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_COPY);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->fits_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, views, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
  setNearest();
  this->views_ = views;
  this->rows_ = rows;
}

/// Choose the view's warp by the pixels of a grid.
void ReceiverFit::chooseWarp(const ShadowLight& light, const LightView& view,
  std::vector<Uniform> uniforms, ShaderLibrary& shaders)
{
  const auto count = static_cast<GLsizei>(view.warps.size());
  std::vector<glm::vec4> texels(view.warps.size() * warpRows);
  for (std::size_t i = 0; i < view.warps.size(); ++i)
  {
    std::vector<glm::vec4> rows;
    addColumns(view.warps[i], rows);
    const std::vector<glm::vec4> chosen = chosenWarpRows(view, view.warps[i], light.mapSizeTexels);
    rows.insert(rows.end(), chosen.begin(), chosen.end());
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      texels[row * view.warps.size() + i] = rows[row];
    }
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->warps_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, count, warpRows, 0, GL_RGBA, GL_FLOAT, texels.data());
  setNearest();
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->sides_.create());
  glBufferData(
    GL_SHADER_STORAGE_BUFFER, count * GLsizeiptr(sizeof(float)), nullptr, GL_DYNAMIC_COPY);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, this->sides_.name());

  const TextureBinding warps{ GL_TEXTURE_2D, this->warps_.name() };
  uniforms.push_back({ "warps", warps });
  useProgram("shadowtech/fitting/texel_sides.comp.glsl", light, uniforms, shaders,
    { "SAMPLES " + std::to_string(samplesAcross) });
  glDispatchCompute(static_cast<GLuint>(count), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

  const GLuint program = shaders.program(
    { { GL_COMPUTE_SHADER, ShaderLibrary::source("shadowtech/fitting/choose_warp.comp.glsl") } });
  glUseProgram(program);
  ShaderLibrary::setUniforms(program,
    { { "warps", warps }, { "largestShare", static_cast<float>(largestSideShare) } }, 0, 0);
  glBindImageTexture(0, this->fits_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ReceiverFit::compute(const ShadowLight& light, const LightViews& views,
  const ReceiverTextures& receivers, const glm::dmat4& centredFromView, ShaderLibrary& shaders)
{
  if (views.views.empty())
  {
    return;
  }
  const GlStateGuard guard;
  const ComputeBindingsGuard computeGuard;
  // As many as the shaders' arrays have; a cube may not use all of them.
  const int count = mostViews(light);
  this->allocate(count, choosesWarp(light) ? chosenRows : fitRows);
  const MapTexels texels{ light.mapSizeTexels, views.borderTexels };
  const Rectangle covered = coveredBeforeFit(light, texels);
  std::vector<Uniform> uniforms =
    lightViewsUniforms(views, texels.side, { centredFromView }, this->fits());
  uniforms.push_back({ "receiverFragments", TextureBinding{ GL_TEXTURE_2D, receivers.fragments } });
  uniforms.push_back({ "receiverPoints", TextureBinding{ GL_TEXTURE_2D, receivers.points } });
  if (choosesWarp(light))
  {
    this->chooseWarp(light, views.views.front(), uniforms, shaders);
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, this->bounds_.name());
  const GLuint keyOfNone = 0xffffffffu;
  glClearBufferData(
    GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &keyOfNone);
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

} // namespace gnomon
