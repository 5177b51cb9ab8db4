// `sampled`: the memory and the uniforms of its maps. SoftLightsTest and RefiningTest compare its
// shadows.

#include "PassScene.h"

#include "shadowtech/base/Gl.h"

namespace gnomon::test
{
namespace
{

struct Sampled : PassTest
{
  Sampled()
  {
    this->scene.addThings();
    this->light->SetPosition(-2.0, -2.5, 6.0);
    this->light->SetFocalPoint(0.0, 0.0, 0.0);
    this->light->SetConeAngle(50.0);
    this->scene.renderer->AddLight(this->light);
    this->scene.choose("sampled light_samples=32");
  }
  PassScene scene{ 140, 100 };
  vtkNew<vtkGnomonAreaLight> light;
};

} // namespace

TEST_F(Sampled, takesBoundedMemory)
{
  const std::size_t map = 64 * 64 * 4;
  const std::size_t images = 2 * 140 * 100 * 4;
  this->scene.set("map_size", 64);
  const auto expectMaps = [&](std::size_t maps, int samples)
  {
    this->scene.set("light_samples", samples);
    this->scene.render();
    EXPECT_EQ(this->scene.report().bytesMaps, maps * map + images);
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, samples);
  };
  expectMaps(9, 64);
  expectMaps(9, 256);
  this->scene.set("batch", 2);
  expectMaps(3, 255);
}

/// OpenGL guarantees 1,024 uniform components, where hardware stores each array element as a vector
/// of four, and 16 textures. Nine lights that see all around must fit into these.
TEST_F(Sampled, batchesFitIntoTheUniformsThatOpenGlPromises)
{
  this->light->SetConeAngle(allDirections);
  this->light->SetPosition(0.3, -0.6, 1.5); // among the casters, so all faces see some
  this->light->SetShapeToRectangle();
  const auto image = makeImage(2, 2, [](int, int) { return glm::dvec3(0.8); });
  for (const bool textured : { false, true })
  {
    this->light->SetTexture(textured ? image.Get() : nullptr);
    this->scene.render();
    EXPECT_EQ(this->scene.report().mapBakes, textured ? 32 : 33);
    int programs = 0;
    for (GLuint program = 1; program < 1000; ++program)
    {
      if (!glIsProgram(program) || glGetUniformLocation(program, "batchShine") < 0)
      {
        continue;
      }
      ++programs;
      int components = 0;
      int textures = 0;
      GLint uniforms = 0;
      glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &uniforms);
      for (GLint i = 0; i < uniforms; ++i)
      {
        GLint size = 0;
        GLenum type = GL_NONE;
        GLchar name[64];
        glGetActiveUniform(
          program, static_cast<GLuint>(i), sizeof(name), nullptr, &size, &type, name);
        const bool isTexture = type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_ARRAY;
        const int vectors = type == GL_FLOAT_MAT4 ? 4 : type == GL_FLOAT_MAT3 ? 3 : 1;
        textures += isTexture ? size : 0;
        components += isTexture ? 0 : 4 * vectors * size;
      }
      EXPECT_LE(components, 1024) << textured;
      EXPECT_LE(textures, 16) << textured;
      EXPECT_GT(components, 9 * 4 * (4 + 6)) << "all lights' matrices and views";
    }
    EXPECT_GE(programs, 1);
  }
}

} // namespace gnomon::test
