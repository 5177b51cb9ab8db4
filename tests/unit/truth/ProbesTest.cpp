#include "shadowtech/probing/Probes.h"

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace gnomon::test
{
namespace
{

constexpr int sidePixels = 256;

/// Has the same visibility everywhere.
class Constant : public PointwiseTechnique
{
public:
  explicit Constant(const char* visibility)
    : visibility_(visibility)
  {
  }
  std::string visibilityGlsl(const ShadowLight&) const override
  {
    return std::string("float visibility_LIGHT(vec3 p, vec3 n) { return ") + this->visibility_ +
      "; }\n";
  }
  std::vector<Uniform> uniforms(const ReceiverSpace&) const override { return {}; }

private:
  const char* visibility_;
};

/// A scene, its camera, and the visibility of the picture's own receivers.
struct ProbedScene
{
  Occluders occluders;
  Camera camera;
  CameraView view;
  EmbreeTracer tracer;

  explicit ProbedScene(Occluders of)
    : occluders(std::move(of))
  {
    this->camera.position = { 3.0, -5.0, 4.0 };
    this->camera.target = { 0.0, 0.0, 0.4 };
    this->camera.width = this->camera.height = sidePixels;
    this->view.viewFromCentred = glm::lookAt(this->camera.position - this->occluders.frame.centre,
      this->camera.target - this->occluders.frame.centre, this->camera.up);
    this->view.clipFromView =
      glm::perspective(glm::radians(this->camera.fovDegrees), 1.0, 0.1, 100.0);
    this->tracer.update(this->occluders);
  }
  ReceiverSpace space() const
  {
    return { glm::inverse(this->view.viewFromCentred),
      this->view.pixelSide({ sidePixels, sidePixels }) };
  }
  void look(Probes& probes, std::uint32_t number)
  {
    probes.look(this->view, { sidePixels, sidePixels }, this->occluders, this->tracer, number);
  }
  /// Return the share of the pixels facing the light that are in shadow.
  double shadowShare(const ShadowLight& light)
  {
    std::vector<float> visibility;
    std::vector<std::uint8_t> classes;
    const Occluders triangles = expanded(this->occluders);
    const ReceiverPixels receivers = makeReceivers(triangles, this->camera);
    EmbreeTracer tracerOfTriangles;
    tracerOfTriangles.update(triangles);
    tracerOfTriangles.trace(light, triangles, Receivers(receivers), visibility, nullptr, &classes);
    double facing = 0.0;
    double hidden = 0.0;
    for (std::size_t i = 0; i < visibility.size(); ++i)
    {
      const bool isTraced = classes[i] == static_cast<std::uint8_t>(TracedClass::Traced);
      facing += isTraced ? 1.0 : 0.0;
      hidden += isTraced && visibility[i] == 0.0f ? 1.0 : 0.0;
    }
    return hidden / facing;
  }
};

std::vector<Occluders> probedScenes()
{
  const Prop plane{ makePlane(6.0) };
  Prop unseen{ makePlane(1.0), at({ 0.0, 0.0, 2.0 }) };
  unseen.receives = false;
  return { makeOccluders({ plane, { makeSphere(12, 24), at({ 0.0, 0.0, 1.0 }) } }),
    makeOccluders({ plane, makePerforatedPlane(1.6, 3, at({ 0.0, 0.0, 1.0 })), unseen }),
    cupsOverFloor(true, false) };
}

class ProbesTest : public GlslTest
{
protected:
  Probes probes_;
  ShaderLibrary library_;
};

} // namespace

// Probes are the picture's own pixels, with the picture's visibility.
TEST_F(ProbesTest, areASampleOfThePicture)
{
  const ShadowLight lights[] = { directionalLight({ -1.0, 0.5, -1.5 }),
    spotLight({ 2.0, 1.0, 5.0 }, { 0.0, 0.0, 0.0 }, 25.0), pointLight({ -1.5, 0.7, 2.2 }) };
  for (const Occluders& occluders : probedScenes())
  {
    ProbedScene scene(occluders);
    for (const ShadowLight& light : lights)
    {
      WrongProbes lit;
      for (std::uint32_t number = 0; number < 4; ++number)
      {
        scene.look(this->probes_, number);
        const auto wrongOf = [&](const char* visibility)
        {
          return this->probes_.wrongOf(Constant(visibility), light, scene.space(), scene.occluders,
            scene.tracer, this->library_);
        };
        const WrongProbes ofLit = wrongOf("1.0");
        const WrongProbes ofDark = wrongOf("0.0");
        EXPECT_EQ(ofLit.asked, ofDark.asked);
        EXPECT_EQ(ofLit.wrong + ofDark.wrong, ofLit.asked);
        EXPECT_EQ(wrongOf("0.5").wrong, 0u) << "half is not more than a half off";
        lit.asked += ofLit.asked;
        lit.wrong += ofLit.wrong;
      }
      const double share = scene.shadowShare(light);
      const double deviation =
        std::sqrt(share * (1.0 - share) / static_cast<double>(lit.asked)) + 0.002;
      EXPECT_GT(lit.asked, 1000u);
      EXPECT_GT(lit.wrong, 20u);
      EXPECT_NEAR(lit.share(), share, 3.0 * deviation) << lit.asked;
    }
  }
}

// Looks aimed at what faces the light find more of it, with the same visibility.
TEST_F(ProbesTest, aimedLooksFindMoreOfWhatFacesTheLight)
{
  ProbedScene scene(probedScenes()[0]);
  const ShadowLight light = spotLight({ 2.0, 1.0, 5.0 }, { -0.5, -0.4, 0.0 }, 6.0);
  const auto sum = [&](std::uint32_t first)
  {
    WrongProbes all;
    for (std::uint32_t number = first; number < first + 4; ++number)
    {
      scene.look(this->probes_, number);
      const WrongProbes lit = this->probes_.wrongOf(
        Constant("1.0"), light, scene.space(), scene.occluders, scene.tracer, this->library_);
      all.asked += lit.asked;
      all.wrong += lit.wrong;
    }
    return all;
  };
  const WrongProbes everywhere = sum(0);
  this->probes_.aimAtFacing();
  const WrongProbes aimed = sum(4);
  EXPECT_GT(aimed.asked, 4 * everywhere.asked);
  EXPECT_LT(aimed.asked, 4 * Probes::count);
  const double share = scene.shadowShare(light);
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.9);
  EXPECT_NEAR(aimed.share(), share, 0.03);

  this->probes_.aimEverywhere();
  EXPECT_EQ(sum(0).asked, everywhere.asked);
  EXPECT_EQ(sum(0).wrong, everywhere.wrong);
}

TEST_F(ProbesTest, fewerSamplesHaveALargerErrorAndNoAreaTheLargest)
{
  ProbedScene scene(probedScenes()[0]);
  const ShadowLight centre = pointLight({ -1.5, 0.7, 2.9 });
  ShadowLight light = centre;
  light.area = ballArea(0.5);
  light.lightSamples = 64;
  scene.look(this->probes_, 0);
  const auto errorsOf = [&](const ShadowLight& other)
  { return this->probes_.errorsOf(other, light, scene.occluders, scene.tracer); };
  const auto errorsOfFew = [&](int few)
  {
    ShadowLight sparse = light;
    sparse.lightSamples = few;
    return errorsOf(sparse);
  };
  const SquaredErrors of4 = errorsOfFew(4);
  const SquaredErrors of16 = errorsOfFew(16);
  const SquaredErrors hard = errorsOf(centre);
  EXPECT_GT(hard.leastRms(), of4.mostRms());
  EXPECT_LT(hard.mostRms(), 0.5);
  EXPECT_NEAR(static_cast<double>(hard.points), 4.0 * static_cast<double>(of4.points), 100.0);
  light.lightSamples = 16;
  EXPECT_EQ(errorsOf(centre).sum, hard.sum);
  EXPECT_GT(of16.leastRms(), 0.001);
  EXPECT_GT(of4.leastRms(), 1.5 * of16.mostRms());
  EXPECT_LT(of4.mostRms(), 0.2);
}

// At the bounds the count found is two standard deviations too small or too large.
TEST(WrongProbes, boundsAreWilsons)
{
  for (const std::size_t asked : { 100u, 4096u })
  {
    for (const std::size_t wrong : { 0u, 1u, 20u, 99u })
    {
      const WrongProbes probes{ asked, wrong };
      const auto deviation = [&](double share)
      { return std::sqrt(share * (1.0 - share) / static_cast<double>(asked)); };
      const double most = probes.mostShare();
      EXPECT_NEAR(most - probes.share(), 2.0 * deviation(most), 1e-9);
      const double least = probes.leastShare();
      EXPECT_NEAR(probes.share() - least, 2.0 * deviation(least), 1e-9);
    }
  }
  EXPECT_EQ(WrongProbes().mostShare(), 1.0);
  EXPECT_EQ(WrongProbes().leastShare(), 0.0);
}

// If all squares but zeros are of one size, their share has Wilson's bounds: the one that errs is
// three standard deviations below the upper one, two above the lower one.
TEST(SquaredErrors, boundsAreThoseOfTheShareThatErrs)
{
  SquaredErrors errors;
  for (int i = 0; i < 900; ++i)
  {
    const double square = i % 10 == 0 ? 0.25 : 0.0;
    errors.add({ 1, square, square * square });
  }
  const auto shareOf = [](double rms) { return rms * rms / 0.25; };
  const auto deviation = [](double share) { return std::sqrt(share * (1.0 - share) / 900.0); };
  const double most = shareOf(errors.mostRms());
  EXPECT_NEAR(most - 0.1, 3.0 * deviation(most), 1e-9);
  const double least = shareOf(errors.leastRms());
  EXPECT_NEAR(0.1 - least, 2.0 * deviation(least), 1e-9);

  // All may have missed the only ones that err.
  SquaredErrors none{ 900 };
  none.expected = 0.25;
  EXPECT_NEAR(shareOf(none.mostRms()), 9.0 / 909.0, 1e-9);
  EXPECT_EQ(none.leastRms(), 0.0);
  none.points = 0; // nothing faces the light
  EXPECT_EQ(none.mostRms(), 0.0);
}

} // namespace gnomon::test
