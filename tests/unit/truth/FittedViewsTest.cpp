// Estimators whose views have their last fit in a texture, against the same with the fit in their views.

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "shadowtech/Registry.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

constexpr int side = 128;

/// A way to decide points.
struct Way
{
  const char* name;
  std::map<std::string, std::string> settings;
};

std::ostream& operator<<(std::ostream& stream, const Way& way)
{
  return stream << way.name;
}

class FittedViews
  : public GlslTest
  , public testing::WithParamInterface<Way>
{
protected:
  /// Lights whose views lie in all ways.
  static std::vector<ShadowLight> lights()
  {
    std::vector<ShadowLight> result;
    for (const char* projection : { "uniform", "lispsm", "tsm", "pssm" })
    {
      for (ShadowLight light : { directionalLight({ 0.7, 0.2, -1.0 }),
             spotLight({ -3.0, 1.0, 5.0 }, glm::dvec3(0.0), 45.0) })
      {
        findSetting("projection")->set(light, projection);
        result.push_back(light);
      }
    }
    result.push_back(pointLight({ -0.9, 0.4, 3.0 }));
    for (ShadowLight& light : result)
    {
      light.fit = ViewFit::Frame;
      light.splits = 3;
      light.mapSizeTexels = side;
      for (const auto& [name, value] : GetParam().settings)
      {
        findSetting(name)->set(light, value);
      }
    }
    return result;
  }

  /// A fit that is narrow one way, and none of which is like another's.
  static MapFit fitOf(std::size_t view)
  {
    const double step = static_cast<double>(view);
    return { { 1.25 + 0.5 * step, 2.5 - 0.25 * step }, { 0.125 * step - 0.25, 0.5 } };
  }

  /// Bakes and asks.
  /// @return per point of the floor and the box, in view coordinates
  std::vector<float> visibility(const ShadowLight& light, const LightViews& views,
    const Occluders& occluders, const TextureBinding& viewFits, const glm::dmat4& centredFromView)
  {
    ShaderLibrary library;
    OccluderBuffers buffers;
    buffers.update(occluders);
    const std::unique_ptr<Technique> technique = estimatorOf(light).create();
    technique->bake({ light, views, occluders, buffers, library, viewFits });

    const glm::dmat4 viewFromCentred = glm::inverse(centredFromView);
    std::vector<glm::vec4> inputs;
    for (std::size_t i = 0; i < points; ++i)
    {
      const double x = -3.0 + 6.0 * std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
      const double y = -3.0 + 6.0 * std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      const bool above = std::max(std::abs(x), std::abs(y)) < 0.5;
      const glm::dvec3 centred = glm::dvec3(x, y, above ? 2.0 : 0.0) - occluders.centreWorld;
      inputs.emplace_back(viewFromCentred * glm::dvec4(centred, 1.0));
    }
    const std::vector<float> outputs = visibilityAt(*technique, light, library, std::move(inputs),
      glm::vec3(glm::dmat3(viewFromCentred) * glm::dvec3(0.0, 0.0, 1.0)),
      technique->uniforms({ centredFromView, { 0.0, 0.05 } }));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return outputs;
  }

  static constexpr std::size_t points = 64 * 256;
};

using Settings = std::map<std::string, std::string>;
INSTANTIATE_TEST_SUITE_P(Estimators, FittedViews,
  testing::Values(Way{ "compare", {} }, Way{ "euclidean", { { "metric", "euclidean" } } },
    Way{ "second", { { "depth", "second" } } }, Way{ "midpoint", { { "depth", "midpoint" } } },
    Way{ "biased", { { "bias_constant", "0.01" }, { "bias_slope", "2" } } },
    Way{ "bilinear", { { "estimator", "pcf" }, { "kernel_size", "5" } } },
    Way{ "castano", { { "estimator", "pcf" }, { "kernel", "castano" } } },
    Way{ "poisson", { { "estimator", "pcf" }, { "kernel", "poisson" }, { "kernel_size", "9" } } },
    Way{ "box", { { "estimator", "pcf" }, { "kernel", "box" }, { "kernel_size", "7" } } },
    Way{ "width", { { "estimator", "pcf" }, { "kernel_width", "0.3" } } },
    Way{ "adaptive", { { "estimator", "adaptive" }, { "kernel_size", "6" } } },
    Way{ "variance", { { "estimator", "variance" } } },
    Way{
      "variance_sat", { { "estimator", "variance" }, { "blur", "sat" }, { "kernel_size", "7" } } },
    Way{ "moments_sat", { { "estimator", "moments" }, { "blur", "sat" }, { "kernel_size", "4" } } },
    Way{ "mip_maps", { { "estimator", "moments" }, { "mip_maps", "on" } } },
    Way{ "exponential", { { "estimator", "exponential" }, { "kernel_size", "5" } } },
    Way{ "moments", { { "estimator", "moments" } } }),
  [](const testing::TestParamInfo<Way>& way) { return std::string(way.param.name); });

} // namespace

//------------------------------------------------------------------------------
TEST_P(FittedViews, decideAsIfTheFitWereInTheView)
{
  const Occluders occluders =
    makeOccluders({ { makePlane(6.0) }, { makeBox({ -0.5, -0.5, 1.0 }, { 0.5, 0.5, 2.0 }) },
      { makeBox({ 1.0, -2.0, 0.0 }, { 1.3, -1.0, 0.8 }) } });
  CameraView camera;
  camera.viewFromCentred =
    glm::lookAt(glm::dvec3(-1.0, -5.0, 3.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
  camera.clipFromView = glm::perspective(glm::radians(60.0), 1.3, 0.5, 50.0);
  const glm::dmat4 centredFromView = glm::inverse(camera.viewFromCentred);
  for (ShadowLight light : this->lights())
  {
    SCOPED_TRACE(findSetting("projection")->get(light) + ", kind " +
      std::to_string(static_cast<int>(light.kind)));
    const MapReach reach = estimatorOf(light).create()->mapReach(light);
    ViewFitting fitting;
    fitting.centreWorld = occluders.centreWorld;
    fitting.castersCentred = occluders.allCentred;
    fitting.receiversCentred = occluders.allCentred;
    fitting.texels = { side, reach.borderTexels(20.0) };
    fitting.camera = camera;
    light.fittedToReceivers = true;
    const LightViews awaiting = fitLightViews(light, fitting);
    ASSERT_FALSE(awaiting.views.empty());
    LightViews fitted = awaiting;
    fitted.awaitFit = false;
    std::vector<glm::vec4> fits(2 * awaiting.views.size());
    for (std::size_t i = 0; i < awaiting.views.size(); ++i)
    {
      const MapFit fit = fitOf(i);
      fitted.views[i].mapFromAcross = fit.matrix() * fitted.views[i].mapFromAcross;
      fits[i] = glm::vec4(fit.scale, fit.offset);
      fits[awaiting.views.size() + i] =
        glm::vec4(fit.scale, 0.5 * side * (fit.offset + 1.0 - fit.scale));
    }
    GlTexture texture;
    glBindTexture(GL_TEXTURE_2D, texture.create());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, static_cast<GLsizei>(awaiting.views.size()), 2, 0,
      GL_RGBA, GL_FLOAT, fits.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

    const std::vector<float> byTexture = this->visibility(
      light, awaiting, occluders, { GL_TEXTURE_2D, texture.name() }, centredFromView);
    light.fittedToReceivers = false;
    const std::vector<float> byView =
      this->visibility(light, fitted, occluders, {}, centredFromView);
    std::size_t dark = 0;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < byView.size(); ++i)
    {
      dark += byView[i] < 0.5f ? 1 : 0;
      differing += std::abs(byView[i] - byTexture[i]) > 0.02f ? 1 : 0;
    }
    EXPECT_GT(dark, points / 100);
    EXPECT_LT(dark, points / 2);
    // A point on the border of texels, and a disc that is turned by the place, may round either way.
    EXPECT_LE(differing, points / 500);
  }
}

} // namespace gnomon::test
