#include "GpuRaster.h"

#include "shadowtech/base/GlState.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>

namespace gnomon
{
/// Generated from the .glsl files of this folder.
const std::map<std::string, std::string>& conservativeRasterShaders();
}

namespace gnomon::test
{
namespace
{

/// Bindings of buffers, as the shaders have them.
enum Binding : GLuint
{
  positionsBinding,
  trianglesBinding,
  minimaBinding,
  largeBinding,
  bindings
};

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double unitRoundoff = 5.9604644775390625e-8; // 2^-24
constexpr int invocationsPerGroup = 64;
/// Among how many work groups large triangles are shared out, and the rows of each.
constexpr GLuint groupsForTriangles = 64;
constexpr GLuint groupsForRows = 16;

/// Shader sources of this folder, one after the other.
std::string sourceOf(std::initializer_list<const char*> files)
{
  std::string source;
  for (const char* file : files)
  {
    source +=
      conservativeRasterShaders().at(std::string("tests/benchmarks/conservative_raster/") + file);
  }
  return source;
}

/// The extension's switch; 0 where there is none.
GLenum conservativeSwitch()
{
  return GLEW_NV_conservative_raster        ? GL_CONSERVATIVE_RASTERIZATION_NV
    : GLEW_INTEL_conservative_rasterization ? GL_CONSERVATIVE_RASTERIZATION_INTEL
                                            : 0;
}

/// Bits that are ordered as the numbers are, and back (scatter.comp.glsl).
std::uint32_t orderedBits(float number)
{
  std::uint32_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}
float numberOf(std::uint32_t ordered)
{
  const std::uint32_t bits = ordered & 0x80000000u ? ordered & 0x7fffffffu : ~ordered;
  float number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

/// Texels as they are counted on the GPU: from the map's middle.
glm::dmat4 fromMiddle(const glm::dmat4& mapFromCentred, int sizeTexels)
{
  glm::dmat4 result = mapFromCentred;
  for (int column = 0; column < 4; ++column)
  {
    result[column].x -= 0.5 * sizeTexels * result[column].w;
    result[column].y -= 0.5 * sizeTexels * result[column].w;
  }
  return result;
}

/// Whether a path goes by compute shaders alone.
bool isComputed(RasterPath path)
{
  return path == RasterPath::Compute;
}

template <typename Element>
void sendTo(GlBuffer& buffer, const std::vector<Element>& elements)
{
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(elements.size() * sizeof(Element)),
    elements.data(), GL_STATIC_DRAW);
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<RasterPath>& allRasterPaths()
{
  static const std::vector<RasterPath> paths{ RasterPath::GeometryShader,
    RasterPath::PulledRectangles, RasterPath::PulledTriangles, RasterPath::Compute,
    RasterPath::Extension };
  return paths;
}

//------------------------------------------------------------------------------
const char* nameOf(RasterPath path)
{
  switch (path)
  {
    case RasterPath::GeometryShader:
      return "GeometryShader";
    case RasterPath::PulledRectangles:
      return "PulledRectangles";
    case RasterPath::PulledTriangles:
      return "PulledTriangles";
    case RasterPath::Compute:
      return "Compute";
    case RasterPath::Extension:
      return "Extension";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string whyUnsupported(RasterPath path)
{
  if (!GLEW_VERSION_4_3)
  {
    return "this takes OpenGL 4.3";
  }
  return path == RasterPath::Extension && conservativeSwitch() == 0
    ? "neither GL_NV_conservative_raster nor GL_INTEL_conservative_rasterization is here"
    : "";
}

//------------------------------------------------------------------------------
GpuRaster::GpuRaster(RasterPath path)
  : path_(path)
{
  const std::string why = whyUnsupported(path);
  if (!why.empty())
  {
    throw std::invalid_argument(std::string(nameOf(path)) + ": " + why);
  }
}

//------------------------------------------------------------------------------
void GpuRaster::send(
  const std::vector<glm::vec3>& positionsCentred, const std::vector<glm::uvec3>& triangles)
{
  this->largestCentred_ = glm::dvec3(0.0);
  for (const glm::vec3& position : positionsCentred)
  {
    if (!(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)))
    {
      throw std::invalid_argument("conservative rasterisation: a vertex is not finite");
    }
    this->largestCentred_ = glm::max(this->largestCentred_, glm::abs(glm::dvec3(position)));
  }
  this->triangleCount_ = triangles.size();
  const StorageBindingsGuard guard(0);
  sendTo(this->positions_, positionsCentred);
  sendTo(this->triangles_, triangles);
}

//------------------------------------------------------------------------------
void GpuRaster::draw(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
  std::vector<TexelDepths>& texels)
{
  const GlStateGuard guard;
  const StorageBindingsGuard bindingsGuard(bindings);
  texels.resize(static_cast<std::size_t>(sizeTexels) * static_cast<std::size_t>(sizeTexels));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, positionsBinding, this->positions_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, trianglesBinding, this->triangles_.name());
  isComputed(this->path_) ? this->compute(mapFromCentred, sizeTexels, marginTexels, texels)
                          : this->drawShapes(mapFromCentred, sizeTexels, marginTexels, texels);
}

//------------------------------------------------------------------------------
void GpuRaster::setUniforms(
  GLuint program, const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels) const
{
  const glm::dmat4 matrix = fromMiddle(mapFromCentred, sizeTexels);
  // Of sums of four products, by the sizes of these.
  const glm::dvec4 largest(this->largestCentred_, 1.0);
  glm::dvec4 rounding(0.0);
  for (int column = 0; column < 4; ++column)
  {
    rounding += 8.0 * unitRoundoff * glm::abs(matrix[column]) * largest[column];
  }
  GLint subpixelBits = 4;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
  const double snap = std::ldexp(1.0, -subpixelBits) + 32.0 * unitRoundoff * sizeTexels;
  const bool findsTouched = this->path_ == RasterPath::Extension;
  ShaderLibrary::setUniforms(program,
    { { "mapFromCentred", glm::mat4(matrix) },
      // Rows of X, Y, Q, W; upwards, as floats are rounded.
      { "rounding", glm::vec4(rounding * (1.0 + 1e-6)) },
      { "margin", static_cast<float>(marginTexels * (1.0 + 1e-6)) },
      { "size", static_cast<float>(sizeTexels) }, { "snap", static_cast<float>(snap) },
      { "halfTexel", findsTouched ? 0.0f : 0.5f },
      { "triangleCount", static_cast<int>(this->triangleCount_) } },
    0, 0);
}

//------------------------------------------------------------------------------
GLuint GpuRaster::shapesProgram()
{
  const ShaderLibrary::Stage fragments{ GL_FRAGMENT_SHADER,
    sourceOf({ "cover.glsl", "gather.frag.glsl" }) };
  if (this->path_ == RasterPath::GeometryShader)
  {
    return this->shaders_.program({ { GL_VERTEX_SHADER, sourceOf({ "corner.vert.glsl" }) },
      { GL_GEOMETRY_SHADER, sourceOf({ "cover.glsl", "shapes.glsl", "rectangle.geom.glsl" }) },
      fragments });
  }
  const ShaderLibrary::Stage pulled{ GL_VERTEX_SHADER,
    sourceOf({ "cover.glsl", "triangles.glsl", "shapes.glsl", "pulled.vert.glsl" }) };
  return this->path_ == RasterPath::PulledRectangles
    ? this->shaders_.program({ pulled, fragments }, { "RECTANGLES" })
    : this->shaders_.program({ pulled, fragments });
}

//------------------------------------------------------------------------------
void GpuRaster::drawShapes(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
  std::vector<TexelDepths>& texels)
{
  glBindTexture(GL_TEXTURE_2D, this->depths_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, sizeTexels, sizeTexels, 0, GL_RG, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->depths_.name(), 0);
  glViewport(0, 0, sizeTexels, sizeTexels);
  for (const GLenum off : { GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_MULTISAMPLE })
  {
    glDisable(off);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnablei(GL_BLEND, 0);
  glBlendEquation(GL_MIN);
  const GLfloat nothing[4] = { infinity, infinity, infinity, infinity };
  glClearBufferfv(GL_COLOR, 0, nothing);

  const GLuint program = this->shapesProgram();
  glUseProgram(program);
  this->setUniforms(program, mapFromCentred, sizeTexels, marginTexels);
  glBindVertexArray(this->vertexArray_.create());
  const auto triangles = static_cast<GLsizei>(this->triangleCount_);
  if (this->path_ == RasterPath::GeometryShader)
  {
    glBindBuffer(GL_ARRAY_BUFFER, this->positions_.name());
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, this->triangles_.name());
    glDrawElements(GL_TRIANGLES, 3 * triangles, GL_UNSIGNED_INT, nullptr);
  }
  else if (this->path_ == RasterPath::PulledRectangles)
  {
    glDrawArrays(GL_TRIANGLES, 0, 6 * triangles);
  }
  else
  {
    const GLenum conservative = this->path_ == RasterPath::Extension ? conservativeSwitch() : 0;
    conservative ? glEnable(conservative) : void();
    glDrawArrays(GL_TRIANGLES, 0, 3 * triangles);
    conservative ? glDisable(conservative) : void();
  }
  glBlendEquation(GL_FUNC_ADD);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, sizeTexels, sizeTexels, GL_RG, GL_FLOAT, texels.data());
}

//------------------------------------------------------------------------------
GLuint GpuRaster::computeProgram(bool large)
{
  std::vector<std::string> defines{ "GROUP " + std::to_string(invocationsPerGroup) };
  if (large)
  {
    defines.emplace_back("LARGE");
  }
  return this->shaders_.program(
    { { GL_COMPUTE_SHADER,
      sourceOf({ "cover.glsl", "triangles.glsl", "shapes.glsl", "scatter.comp.glsl" }) } },
    defines);
}

//------------------------------------------------------------------------------
void GpuRaster::compute(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
  std::vector<TexelDepths>& texels)
{
  const std::size_t groups = (this->triangleCount_ + invocationsPerGroup - 1) / invocationsPerGroup;
  if (groups > 65535)
  {
    throw std::invalid_argument("conservative rasterisation: too many triangles for one dispatch");
  }
  const auto bytes = static_cast<GLsizeiptr>(texels.size() * sizeof(TexelDepths));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, minimaBinding, this->minima_.create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
  const std::uint32_t nothing = orderedBits(infinity);
  glClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, largeBinding, this->large_.create());
  glBufferData(GL_SHADER_STORAGE_BUFFER,
    static_cast<GLsizeiptr>((1 + this->triangleCount_) * sizeof(std::uint32_t)), nullptr,
    GL_DYNAMIC_COPY);
  const std::uint32_t none = 0;
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof(none), &none);

  for (const bool large : { false, true })
  {
    const GLuint program = this->computeProgram(large);
    glUseProgram(program);
    this->setUniforms(program, mapFromCentred, sizeTexels, marginTexels);
    large ? glDispatchCompute(groupsForTriangles, groupsForRows, 1)
          : glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  std::vector<std::uint32_t> minima(2 * texels.size());
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->minima_.name());
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, minima.data());
  for (std::size_t i = 0; i < texels.size(); ++i)
  {
    texels[i] = { numberOf(minima[2 * i]), numberOf(minima[2 * i + 1]) };
  }
}

} // namespace gnomon::test
