#pragma once

// The GLSL of estimators on given maps, for comparison with twins.

#include "lights/LightViews.h"
#include "lights/SettingsTable.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/Technique.h"

#include "vtkGnomonOffScreenWindow.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test
{

constexpr int mapSize = 64;

/// True if a texel holds a caster that hides the points below.
using Map = std::function<bool(const glm::ivec2&)>;

/// Fill a texture of floats, which is read without interpolation.
/// @param format GL_RED, GL_RG or GL_RGBA
/// @param size width, height, and the number of layers if it is an array; else 0
void fillTexture(GlTexture& texture, GLenum format, const glm::ivec3& size, const void* texels);

/// Return the views of a sun around the cube [-1, 1]^3.
LightViews sunViews(const ShadowLight& light);

/// Return the source of a compute shader that maps `given[i]` to `result[i]`.
/// @param declarations before `main`
/// @param in,out the types of `given` and `result`
/// @param body statements that may use `i`
std::string computeGlsl(const std::string& declarations, const std::string& in,
  const std::string& out, const std::string& body);

/// Run a shader of computeGlsl().
void runCompute(ShaderLibrary& library, const std::string& glsl, std::size_t count,
  const void* given, std::size_t givenBytes, void* result, std::size_t resultBytes,
  const std::vector<Uniform>& uniforms, const std::vector<std::string>& defines);

template <typename Out, typename In>
std::vector<Out> runCompute(ShaderLibrary& library, const std::string& glsl,
  const std::vector<In>& in, const std::vector<Uniform>& uniforms = {},
  const std::vector<std::string>& defines = {})
{
  std::vector<Out> out(in.size());
  runCompute(library, glsl, in.size(), in.data(), in.size() * sizeof(In), out.data(),
    out.size() * sizeof(Out), uniforms, defines);
  return out;
}

/// Run a technique's GLSL at points on a plane.
/// @param pointsView in the camera's view coordinates
/// @param normalView of the plane
/// @param uniforms of the technique
std::vector<float> visibilityAt(const PointwiseTechnique& technique, const ShadowLight& light,
  ShaderLibrary& library, std::vector<glm::vec4> pointsView, const glm::vec3& normalView,
  std::vector<Uniform> uniforms);

/// Run the shader at places of the first view's map, on a plane across the light.
std::vector<float> runGlsl(const PointwiseTechnique& technique, const ShadowLight& light,
  const LightViews& views, const Map& map, const std::vector<glm::dvec2>& places);

/// Return a sun along -z.
inline ShadowLight filteredSun(const char* kernel, int texels)
{
  ShadowLight light;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  findSetting("kernel")->set(light, kernel);
  light.kernel.sizeTexels = texels;
  return light;
}

/// Return places of a map whose kernels stay inside the map. They are exact in float, so both sides
/// round alike.
inline std::vector<glm::dvec2> randomPlaces(int texels)
{
  std::mt19937 random(5);
  const double margin = 0.5 * texels + 2.0;
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 2000; ++i)
  {
    const auto coordinate = [&]
    { return margin + (mapSize - 2.0 * margin) * (random() / 4294967296.0); };
    const double x = coordinate();
    places.emplace_back(x, coordinate());
  }
  return places;
}

/// A map of which about half is covered, each texel independent of its neighbours.
inline bool scattered(const glm::ivec2& texel)
{
  const auto bits = static_cast<unsigned>(texel.x * 73 + texel.y * 1009);
  return (bits * 2654435761u) >> 31u != 0u;
}

/// Return the part of a texel that a square of side `width` around a place covers.
inline double covered(const glm::ivec2& texel, const glm::dvec2& place, double width)
{
  const glm::dvec2 lower = glm::max(glm::dvec2(texel), place - 0.5 * width);
  const glm::dvec2 upper = glm::min(glm::dvec2(texel) + 1.0, place + 0.5 * width);
  const glm::dvec2 size = glm::max(upper - lower, 0.0);
  return size.x * size.y;
}

/// Return the lit share of a map around a place, with a weight per texel.
template <typename Weight>
double litShare(const Map& map, const Weight& weight)
{
  double lit = 0.0;
  double all = 0.0;
  for (int y = 0; y < mapSize; ++y)
  {
    for (int x = 0; x < mapSize; ++x)
    {
      const double share = weight(glm::ivec2(x, y));
      lit += map({ x, y }) ? 0.0 : share;
      all += share;
    }
  }
  return lit / all;
}

/// Return the name of a test's value of any type with a member `name`.
inline constexpr auto byName = [](const auto& info) { return std::string(info.param.name); };

class GlslTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
  }
  vtkSmartPointer<vtkOpenGLRenderWindow> window_ = makeOffScreenWindow();
};
template <typename Parameter>
class GlslTestOf
  : public GlslTest
  , public testing::WithParamInterface<Parameter>
{
};

} // namespace gnomon::test
