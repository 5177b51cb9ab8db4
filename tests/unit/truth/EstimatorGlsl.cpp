#include "EstimatorGlsl.h"

#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <utility>

namespace gnomon::test
{

void fillTexture(GlTexture& texture, GLenum format, const glm::ivec3& size, const void* texels)
{
  const GLenum target = size.z > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  const GLint stored = format == GL_RED ? GL_R32F : format == GL_RG ? GL_RG32F : GL_RGBA32F;
  glBindTexture(target, texture.create());
  if (size.z > 0)
  {
    glTexImage3D(target, 0, stored, size.x, size.y, size.z, 0, format, GL_FLOAT, texels);
  }
  else
  {
    glTexImage2D(target, 0, stored, size.x, size.y, 0, format, GL_FLOAT, texels);
  }
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

LightViews sunViews(const ShadowLight& light)
{
  return fitLightViews(
    light, { glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, {}, { mapSize, 1 }, {} });
}

std::string computeGlsl(const std::string& declarations, const std::string& in,
  const std::string& out, const std::string& body)
{
  return numberedForLight(declarations, 0) +
    "layout(local_size_x = 64) in;\nuniform int inputCount;\n"
    "layout(std430, binding = 0) readonly buffer In { " +
    in + " given[]; };\nlayout(std430, binding = 1) writeonly buffer Out { " + out +
    " result[]; };\nvoid main()\n{\n  uint i = gl_GlobalInvocationID.x;\n"
    "  if (i < uint(inputCount))\n  {\n" +
    numberedForLight(body, 0) + "  }\n}\n";
}

void runCompute(ShaderLibrary& library, const std::string& glsl, std::size_t count,
  const void* given, std::size_t givenBytes, void* result, std::size_t resultBytes,
  const std::vector<Uniform>& uniforms, const std::vector<std::string>& defines)
{
  const GLuint program = library.program({ { GL_COMPUTE_SHADER, glsl } }, defines);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  ShaderLibrary::setUniform(program, { "inputCount", static_cast<int>(count) });
  GlBuffer buffers[2];
  const auto bind = [&](GLuint binding, std::size_t bytes, const void* data)
  {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffers[binding].create());
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  };
  bind(0, givenBytes, given);
  bind(1, resultBytes, nullptr);
  glDispatchCompute(static_cast<GLuint>((count + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(resultBytes), result);
  glUseProgram(0);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

std::vector<float> visibilityAt(const PointwiseTechnique& technique, const ShadowLight& light,
  ShaderLibrary& library, std::vector<glm::vec4> pointsView, const glm::vec3& normalView,
  std::vector<Uniform> uniforms)
{
  uniforms.push_back({ "normal", normalView });
  return runCompute<float>(library,
    computeGlsl(technique.visibilityGlsl(light) + "uniform vec3 normal;\n", "vec4", "float",
      "result[i] = visibility_LIGHT(given[i].xyz, normal);\n"),
    pointsView, uniforms);
}

std::vector<float> runGlsl(const PointwiseTechnique& technique, const ShadowLight& light,
  const LightViews& views, const Map& map, const std::vector<glm::dvec2>& places)
{
  const LightView& view = views.views.front();
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, mapSize));
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const double distance = (0.5 - view.depthOffset) / view.depthScale;
  std::vector<glm::vec4> points;
  for (const glm::dvec2& place : places)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, place);
    points.emplace_back(centredFromView * glm::dvec4(across, distance, 1.0));
  }
  GlTexture texture;
  std::vector<float> depths;
  for (int i = 0; i < mapSize * mapSize; ++i)
  {
    depths.push_back(map({ i % mapSize, i / mapSize }) ? 0.25f : 1.0f);
  }
  fillTexture(texture, GL_RED, { mapSize, mapSize, 1 }, depths.data());
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, {});
  uniforms.push_back({ "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, texture.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(1e-6, 0.0) });
  uniforms.push_back(kernelUnit(technique.mapReach(light)));
  ShaderLibrary library;
  return visibilityAt(
    technique, light, library, points, glm::vec3(-light.directionWorld), std::move(uniforms));
}

} // namespace gnomon::test
