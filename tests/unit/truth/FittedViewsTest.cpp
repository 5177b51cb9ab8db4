// Estimators whose views have their last fit in a texture, against the same with the fit in the
// views.

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "shadowtech/Registry.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

constexpr int fittedSide = 128;

/// An estimator with its settings.
struct Way
{
  const char* name;
  std::map<std::string, std::string> settings;
};

std::ostream& operator<<(std::ostream& stream, const Way& way)
{
  return stream << way.name;
}

/// Return a fit that is narrow along one axis, and different for each view.
MapFit fitOf(std::size_t view)
{
  const double step = static_cast<double>(view);
  return { { 1.25 + 0.5 * step, 2.5 - 0.25 * step }, { 0.125 * step - 0.25, 0.5 } };
}

/// Views that await a fit, and the same views with the fit applied.
struct BothViews
{
  LightViews awaiting;
  LightViews fitted;
  /// The GPU's result for `awaiting`, as ReceiverFit stores it.
  GlTexture found;
};

void makeBoth(ShadowLight light, const Occluders& occluders, const CameraView& camera,
  int borderTexels, BothViews& both)
{
  light.fittedToReceivers = true;
  both.awaiting = fitLightViews(light,
    { occluders.frame.centre, occluders.allCentred, occluders.allCentred,
      { fittedSide, borderTexels }, camera });
  both.fitted = both.awaiting;
  both.fitted.awaitFit = false;
  const std::size_t count = both.awaiting.views.size();
  std::vector<glm::vec4> rows(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapFit fit = fitOf(i);
    LightView& view = both.fitted.views[i];
    if (!view.warps.empty())
    {
      ASSERT_EQ(count, 1u);
      view.mapFromAcross = view.warps.at(15);
      view.warps.clear();
      const std::vector<glm::vec4> chosen =
        chosenWarpRows(both.awaiting.views[i], view.mapFromAcross, fittedSide);
      rows.insert(rows.end(), chosen.begin(), chosen.end());
    }
    view.mapFromAcross = fit.matrix() * view.mapFromAcross;
    rows[i] = glm::vec4(fit.scale, fit.offset);
    rows[count + i] = glm::vec4(fit.scale, 0.5 * fittedSide * (fit.offset + 1.0 - fit.scale));
  }
  ASSERT_GT(count, 0u);
  fillTexture(both.found, GL_RGBA, { count, rows.size() / count, 0 }, rows.data());
}

Occluders floorAndBoxes()
{
  return makeOccluders({ { makePlane(6.0) }, { makeBox({ -0.5, -0.5, 1.0 }, { 0.5, 0.5, 2.0 }) },
    { makeBox({ 1.0, -2.0, 0.0 }, { 1.3, -1.0, 0.8 }) } });
}

CameraView cameraAbove()
{
  return { glm::lookAt(glm::dvec3(-1.0, -5.0, 3.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0)),
    glm::perspective(glm::radians(60.0), 1.3, 0.5, 50.0) };
}

/// Return lights whose views have all layouts.
std::vector<ShadowLight> lightsOfAllLayouts()
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
    light.technique = "nsm"; // replaced by the way's estimator
    light.fit = ViewFit::Frame;
    light.splits = 3;
    light.mapSizeTexels = fittedSide;
  }
  return result;
}

class FittedViews : public GlslTestOf<Way>
{
protected:
  /// Bake, then compute visibility.
  /// @return per point of the floor and the box, in view coordinates
  std::vector<float> visibility(const ShadowLight& light, const LightViews& views,
    const Occluders& occluders, const TextureBinding& viewFits, const glm::dmat4& centredFromView)
  {
    ShaderLibrary library;
    OccluderBuffers buffers;
    buffers.update(occluders);
    const AnyTechnique made = estimatorOf(light).create();
    const auto& technique = std::get<std::unique_ptr<PointwiseTechnique>>(made);
    technique->bake({ light, views, occluders, buffers, library, viewFits });

    const glm::dmat4 viewFromCentred = glm::inverse(centredFromView);
    std::vector<glm::vec4> inputs;
    for (std::size_t i = 0; i < points; ++i)
    {
      const double x = -3.0 + 6.0 * std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
      const double y = -3.0 + 6.0 * std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      const bool above = std::max(std::abs(x), std::abs(y)) < 0.5;
      const glm::dvec3 centred = glm::dvec3(x, y, above ? 2.0 : 0.0) - occluders.frame.centre;
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
    Way{ "single_exponential", { { "estimator", "single_exponential" }, { "kernel_size", "5" } } },
    Way{ "exponential", { { "estimator", "exponential" }, { "kernel_size", "5" } } },
    Way{ "moments", { { "estimator", "moments" } } }),
  byName);

} // namespace

TEST_P(FittedViews, matchViewsWithTheFitApplied)
{
  const Occluders occluders = floorAndBoxes();
  const CameraView camera = cameraAbove();
  const glm::dmat4 centredFromView = glm::inverse(camera.viewFromCentred);
  for (ShadowLight light : lightsOfAllLayouts())
  {
    SCOPED_TRACE(findSetting("projection")->get(light) + ", kind " +
      std::to_string(static_cast<int>(light.kind)));
    for (const auto& [name, value] : GetParam().settings)
    {
      findSetting(name)->set(light, value);
    }
    const MapReach reach = baseOf(estimatorOf(light).create()).mapReach(light);
    BothViews both;
    ASSERT_NO_FATAL_FAILURE(makeBoth(light, occluders, camera, reach.borderTexels(20.0), both));
    light.fittedToReceivers = true;
    const std::vector<float> byTexture = this->visibility(
      light, both.awaiting, occluders, { GL_TEXTURE_2D, both.found.name() }, centredFromView);
    light.fittedToReceivers = false;
    const std::vector<float> byView =
      this->visibility(light, both.fitted, occluders, {}, centredFromView);
    const std::size_t dark =
      countBelow(byView.size(), [&](std::size_t i) { return byView[i] < 0.5f; });
    const std::size_t differing = countBelow(
      byView.size(), [&](std::size_t i) { return std::abs(byView[i] - byTexture[i]) > 0.02f; });
    EXPECT_GT(dark, points / 100);
    EXPECT_LT(dark, points / 2);
    // A point on the border of texels, or a disc that the place turns, may round either way.
    EXPECT_LE(differing, points / 500);
  }
}

/// Values of caster_map.glsl at the casters' fragments. They determine how far casters are pushed
/// back, which shadows show too little of.
class FittedCasters : public GlslTest
{
protected:
  static std::vector<glm::vec4> drawn(const char* shown, const ShadowLight& light,
    const LightViews& views, const Occluders& occluders, const TextureBinding& viewFits)
  {
    ShaderLibrary library;
    OccluderBuffers buffers;
    buffers.update(occluders);
    GlTexture picture;
    GlFramebuffer framebuffer;
    fillTexture(picture, GL_RGBA, { fittedSide, fittedSide, 0 }, nullptr);
    std::vector<glm::vec4> result(static_cast<std::size_t>(fittedSide) * fittedSide);
    const GlStateGuard guard;
    const glm::vec4 nothing(0.0f);
    beginCasters(framebuffer.create(), fittedSide);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.name(), 0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glClearBufferfv(GL_COLOR, 0, &nothing.x);
    drawCasters(0, { light, views, occluders, buffers, library, viewFits },
      { ShaderLibrary::source("shadowtech/base/caster_map.glsl") +
          "out vec4 shown;\nvoid main()\n{\n" + shown + "}\n",
        {} });
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, fittedSide, fittedSide, GL_RGBA, GL_FLOAT, result.data());
    return result;
  }
};

TEST_F(FittedCasters, matchViewsWithTheFitApplied)
{
  const Occluders occluders = floorAndBoxes();
  for (ShadowLight light : lightsOfAllLayouts())
  {
    SCOPED_TRACE(findSetting("projection")->get(light) + ", kind " +
      std::to_string(static_cast<int>(light.kind)));
    BothViews both;
    ASSERT_NO_FATAL_FAILURE(makeBoth(light, occluders, cameraAbove(), 1, both));
    for (const char* shown : { "shown = vec4(across(), 0.0, 1.0);\n",
           "mat2 jacobian = texelJacobian(); shown = vec4(jacobian[0], jacobian[1]);\n",
           "shown = vec4(texelScale(), 1.0);\n" })
    {
      SCOPED_TRACE(shown);
      const std::vector<glm::vec4> byTexture =
        this->drawn(shown, light, both.awaiting, occluders, { GL_TEXTURE_2D, both.found.name() });
      const std::vector<glm::vec4> byView = this->drawn(shown, light, both.fitted, occluders, {});
      glm::vec4 largest(0.0f);
      for (const glm::vec4& value : byView)
      {
        largest = glm::max(largest, glm::abs(value));
      }
      const glm::vec4 most(1e-4f * std::max({ largest.x, largest.y, largest.z }));
      const std::size_t differing = countBelow(byView.size(),
        [&](std::size_t i)
        { return !glm::all(glm::lessThanEqual(glm::abs(byTexture[i] - byView[i]), most)); });
      const std::size_t covered =
        countBelow(byView.size(), [&](std::size_t i) { return byView[i] != glm::vec4(0.0f); });
      EXPECT_GT(covered, byView.size() / 4);
      EXPECT_LE(differing, byView.size() / 500); // where a caster's edge takes another texel
    }
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

} // namespace gnomon::test
