// Volumes that cast: media against closed forms, and stacks against rays that march.

#include "shadowtech/transmittance/VolumeStack.h"

#include "SyntheticScene.h"

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A grid over the cube from -1 to 1 with scalars of a formula.
Volume volumeOf(const std::function<double(const glm::dvec3&)>& scalarAt, const glm::ivec3& samples)
{
  Volume volume;
  volume.samples = samples;
  const glm::dvec3 step = 2.0 / glm::dvec3(samples - 1);
  volume.modelFromIndex = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)), step);
  const auto scalars = std::make_shared<std::vector<float>>();
  for (int z = 0; z < samples.z; ++z)
  {
    for (int y = 0; y < samples.y; ++y)
    {
      for (int x = 0; x < samples.x; ++x)
      {
        scalars->push_back(static_cast<float>(scalarAt(glm::dvec3(x, y, z) * step - 1.0)));
      }
    }
  }
  volume.scalars = { scalars, scalars->data() };
  return volume;
}

/// An extinction of the scalars above 0; below there is none.
VolumeOpacity inside(double extinction)
{
  VolumeOpacity opacity;
  opacity.range = { -4.0, 4.0 };
  opacity.extinctions.assign(2048, 0.0f);
  std::fill(
    opacity.extinctions.begin() + 1024, opacity.extinctions.end(), static_cast<float>(extinction));
  return opacity;
}

/// A body of constant extinction, where a formula is above 0.
Volume bodyOf(const std::function<double(const glm::dvec3&)>& heightAt, double extinction)
{
  Volume volume = volumeOf(heightAt, glm::ivec3(64));
  volume.opacities = { inside(extinction) };
  return volume;
}

Volume slabOf(double extinction)
{
  return bodyOf([](const glm::dvec3&) { return 1.0; }, extinction);
}

Volumes castersOf(const std::vector<Volume>& volumes, const SceneFrame& frame = {})
{
  Occluders occluders;
  occluders.frame = frame;
  for (const Volume& volume : volumes)
  {
    occluders.volumes.push_back(std::make_shared<const Volume>(volume));
  }
  Volumes casters;
  casters.update(occluders);
  return casters;
}

/// Return what a ray keeps.
double left(const Volumes& casters, const glm::vec3& origin, const glm::vec3& direction)
{
  return casters.transmittanceOf(origin, direction, std::numeric_limits<float>::infinity()).x;
}

TEST(Volumes, SlabsBallsAndWedgesKeepWhatTheFormulasSay)
{
  constexpr double extinction = 0.8;
  const Volumes slab = castersOf({ slabOf(extinction) });
  const Volumes ball =
    castersOf({ bodyOf([](const glm::dvec3& at) { return 0.8 - glm::length(at); }, extinction) });
  // Between the planes z = -1 and z = x / 2.
  const Volumes wedge =
    castersOf({ bodyOf([](const glm::dvec3& at) { return 0.5 * at.x - at.z; }, extinction) });
  std::mt19937 random(1);
  std::uniform_real_distribution<float> within(-0.9f, 0.9f);
  for (int i = 0; i < 200; ++i)
  {
    const glm::vec3 at(within(random), within(random), -1.0f);
    EXPECT_NEAR(
      left(wedge, at, { 0.0f, 0.0f, 1.0f }), std::exp(-extinction * (1.0 + 0.5 * at.x)), 0.01);
    const glm::vec3 towards(within(random), within(random), 1.0f);
    const glm::vec3 middle(0.1f * at.x, 0.1f * at.y, 0.0f);
    const glm::vec3 from = middle - 3.0f * towards;
    const double slope = std::max(std::abs(towards.x), std::abs(towards.y));
    if (slope < 0.8) // through both of the slab's faces
    {
      EXPECT_NEAR(
        left(slab, from, towards), std::exp(-extinction * 2.0 * glm::length(towards)), 1e-6);
    }
    const double passes =
      glm::length(glm::cross(glm::dvec3(middle), glm::normalize(glm::dvec3(towards))));
    EXPECT_NEAR(left(ball, from, towards),
      std::exp(-extinction * 2.0 * std::sqrt(0.64 - passes * passes)), 0.01);
  }
}

TEST(Volumes, Multiply)
{
  Volume other = slabOf(0.3);
  other.worldFromModel = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.0, 2.5));
  const Volumes both = castersOf({ slabOf(0.2), other });
  EXPECT_NEAR(left(both, { 0.0f, 0.0f, -3.0f }, { 0.0f, 0.0f, 1.0f }), std::exp(-1.0), 1e-6);
  EXPECT_NEAR(left(both, { -0.7f, 0.0f, -3.0f }, { 0.0f, 0.0f, 1.0f }), std::exp(-0.4), 1e-6);
  EXPECT_EQ(left(both, { 0.0f, 0.0f, 4.0f }, { 0.0f, 0.0f, 1.0f }), 1.0) << "from behind both";
}

TEST(Volumes, ARayBeginsAndEndsWithin)
{
  const Volumes slab = castersOf({ slabOf(0.5) });
  EXPECT_NEAR(slab.opticalDepth(glm::dvec3(0.0), { 0.0, 0.0, 2.0 }, 0.0, infinite), 0.5, 1e-9);
  EXPECT_NEAR(slab.opticalDepth(glm::dvec3(0.0), { 0.0, 0.0, 2.0 }, 0.0, 0.25), 0.25, 1e-9);
  EXPECT_EQ(slab.opticalDepth({ 0.0, 0.0, -9.0 }, { 0.0, 0.0, 1.0 }, 0.0, 7.9), 0.0);
  EXPECT_EQ(slab.opticalDepth({ 2.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 0.0, infinite), 0.0);
  EXPECT_EQ(left(castersOf({ slabOf(1e30) }), glm::vec3(0.0f), { 0.0f, 0.0f, 1.0f }), 0.0);
}

TEST(Volumes, LengthsAreTheVolumesOwn)
{
  Volume volume = slabOf(0.5);
  volume.worldFromModel = glm::scale(
    glm::translate(glm::dmat4(1.0), glm::dvec3(1e6, 0.0, 0.0)), glm::dvec3(3.0, 3.0, 7.0));
  SceneFrame frame;
  frame.exponent = -30;
  frame.centre = glm::dvec3(1e6, 0.0, 0.0) * frame.unitsPerWorld();
  const Volumes casters = castersOf({ volume }, frame);
  EXPECT_NEAR(casters.opticalDepth({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 0.0, infinite), 0.5, 1e-9);
}

/// A way in which VTK decides opacity, and the depth of the ray upwards through a point.
struct Row
{
  std::string name;
  std::function<void(Volume&)> change; ///< of the slab with an extinction of 0.5
  glm::dvec3 at;
  double depth;
};

VolumeOpacity ofComponent(int component, double extinction, double weight = 1.0)
{
  VolumeOpacity opacity;
  opacity.component = component;
  opacity.extinctions.assign(1024, 0.0f);
  opacity.extinctions.back() = static_cast<float>(extinction);
  opacity.weight = weight;
  return opacity;
}

/// Give each sample several components: 0, but for those that are 1.
void setComponents(Volume& volume, const std::vector<float>& ofSample)
{
  volume.components = static_cast<int>(ofSample.size());
  const auto scalars = std::make_shared<std::vector<float>>();
  for (int i = 0; i < volume.samples.x * volume.samples.y * volume.samples.z; ++i)
  {
    scalars->insert(scalars->end(), ofSample.begin(), ofSample.end());
  }
  volume.scalars = { scalars, scalars->data() };
}

/// Have scalars rise along x, from -1 to 1, with constant extinction.
void addGradient(Volume& volume, float factor)
{
  const glm::dmat4 worldFromModel = volume.worldFromModel;
  volume = volumeOf([](const glm::dvec3& at) { return at.x; }, { 33, 17, 65 });
  volume.worldFromModel = worldFromModel;
  VolumeOpacity opacity;
  opacity.range = { -1.0, 1.0 };
  opacity.extinctions.assign(1024, 0.5f);
  // A difference of 1/16 a sample; the mean spacing is 7/96, that along x 6/96. VTK's samples are
  // 33/32 apart.
  const double gradient = 1.0 / 16.0 * (33.0 / 32.0) * (7.0 / 6.0);
  opacity.ofGradients.assign(1024, 0.0f);
  opacity.ofGradients[static_cast<std::size_t>(gradient / 0.5 * 1024.0 - 0.5)] = factor;
  opacity.ofGradients[static_cast<std::size_t>(gradient / 0.5 * 1024.0 + 0.5)] = factor;
  volume.opacities = { opacity };
}

const std::vector<Row>& rows()
{
  static const std::vector<Row> all = {
    { "Plain", [](Volume&) {}, { 0.3, 0.2, 0.0 }, 1.0 },
    { "Rotated",
      [](Volume& volume)
      {
        volume.worldFromModel =
          glm::rotate(glm::dmat4(1.0), glm::radians(45.0), glm::dvec3(1.0, 0.0, 0.0));
      },
      { 0.0, 0.4, 0.0 }, std::sqrt(2.0) - 0.4 },
    { "Anisotropic",
      [](Volume& volume)
      { volume.modelFromIndex = glm::scale(volume.modelFromIndex, glm::dvec3(0.5, 1.0, 3.0)); },
      { -0.5, 0.2, 0.0 }, 3.0 },
    { "OfCells", [](Volume& volume) { volume.isOfCells = true; }, { 1.01, 0.0, 0.0 }, 64.0 / 63.0 },
    { "Nearest",
      [](Volume& volume)
      {
        volume = volumeOf([](const glm::dvec3& at) { return at.z < -0.5 ? 1.0 : -1.0; },
          glm::ivec3(33)); // the eighth sample is the last below
        volume.opacities = { inside(0.5) };
        volume.interpolates = false;
      },
      { 0.0, 0.0, 0.0 }, 0.5 * 7.5 / 16.0 },
    { "GradientOpacity", [](Volume& volume) { addGradient(volume, 0.25f); }, { 0.0, 0.0, 0.0 },
      0.25 },
    { "NoGradientOpacity", [](Volume& volume) { addGradient(volume, 0.0f); }, { 0.0, 0.0, 0.0 },
      0.0 },
    { "Masked",
      [](Volume& volume)
      {
        volume.maskTexels = { 1, 1, 4 };
        static const std::uint8_t shown[] = { 0, 1, 255, 0 };
        volume.mask = { std::shared_ptr<void>(), shown };
      },
      { 0.0, 0.0, 0.0 }, 0.5 * 2.0 * 32.0 / 63.0 },
    { "CroppedToTheMiddle",
      [](Volume& volume)
      {
        volume.cropIndices.fill({ 63.0 / 4.0, 63.0 / 2.0 });
        volume.cropFlags = 1u << 13;
      },
      { -0.2, -0.2, 0.0 }, 0.25 },
    { "CroppedToACorner",
      [](Volume& volume)
      {
        volume.cropIndices.fill({ 63.0 / 4.0, 63.0 / 2.0 });
        volume.cropFlags = 1u << (2 + 0 * 3 + 1 * 9); // right, front, middle
      },
      { 0.3, -0.8, 0.0 }, 0.25 },
    { "Clipped",
      [](Volume& volume)
      {
        const double slant = std::sqrt(0.5);
        volume.clipPlanesWorld = { { slant, 0.0, -slant, 0.0 }, { 0.0, 0.0, 1.0, 0.25 } };
      },
      { 0.5, 0.0, 0.0 }, 0.5 * 0.75 },
    { "DependentOfTwo",
      [](Volume& volume)
      {
        setComponents(volume, { 0.0f, 1.0f });
        volume.opacities = { ofComponent(1, 0.25) };
      },
      { 0.0, 0.0, 0.0 }, 0.5 },
    { "DependentOfFour",
      [](Volume& volume)
      {
        setComponents(volume, { 0.0f, 0.0f, 0.0f, 1.0f });
        volume.opacities = { ofComponent(3, 0.75) };
      },
      { 0.0, 0.0, 0.0 }, 1.5 },
    { "Independent",
      [](Volume& volume)
      {
        setComponents(volume, { 1.0f, 0.0f, 1.0f });
        volume.opacities = { ofComponent(0, 0.5, 0.25), ofComponent(1, 9.0),
          ofComponent(2, 1.0, 0.5) };
      },
      { 0.0, 0.0, 0.0 }, 2.0 * (0.25 + 1.0) / (0.25 * 0.5 + 0.5 * 1.0) },
    { "IndependentWithoutWeight",
      [](Volume& volume)
      {
        setComponents(volume, { 1.0f, 1.0f });
        volume.opacities = { ofComponent(0, 0.5), ofComponent(1, 9.0, 0.0) };
      },
      { 0.0, 0.0, 0.0 }, 1.0 },
  };
  return all;
}

struct VolumeRows : testing::TestWithParam<Row>
{
};

TEST_P(VolumeRows, HaveTheDepthOfVtksDefinition)
{
  Volume volume = slabOf(0.5);
  this->GetParam().change(volume);
  const Volumes casters = castersOf({ volume });
  const glm::dvec3 from = this->GetParam().at - glm::dvec3(0.0, 0.0, 10.0);
  EXPECT_NEAR(
    casters.opticalDepth(from, { 0.0, 0.0, 1.0 }, 0.0, infinite), this->GetParam().depth, 0.006);
}

INSTANTIATE_TEST_SUITE_P(
  , VolumeRows, testing::ValuesIn(rows()), [](const auto& row) { return row.param.name; });

/// Errors of stacks, against rays that march to the light.
struct StackErrors
{
  double mean;
  double of99Percent;
};

StackErrors errorsOf(const Volumes& casters, const ShadowLight& light, int resolution)
{
  const ShadowRayLight ofRays(light, glm::dvec3(0.0));
  const VolumeStack stack(casters, ofRays, resolution);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> within(-1.0f, 1.0f);
  std::vector<double> errors;
  double sum = 0.0;
  for (int i = 0; i < 4000; ++i)
  {
    glm::vec3 at(within(random), within(random), within(random));
    if (i % 2 == 0) // on a ground below
    {
      at = glm::vec3(1.5f * glm::vec2(at), -1.2f);
    }
    const bool isLamp = light.kind != LightKind::Directional;
    const glm::vec3 toLight = isLamp ? ofRays.position - at : ofRays.toLight;
    const float rayFar = isLamp ? shadowRayFarAtLight : shadowRayFarDirectional;
    errors.push_back(std::abs(stack.transmittanceOf(at, toLight, rayFar).x -
      casters.transmittanceOf(at, toLight, rayFar).x));
    sum += errors.back();
  }
  const auto most = errors.begin() + static_cast<std::ptrdiff_t>(0.99 * errors.size());
  std::nth_element(errors.begin(), most, errors.end());
  return { sum / static_cast<double>(errors.size()), *most };
}

/// A name with a value of any type.
template <typename Value>
struct Named
{
  std::string name;
  Value value;
};

/// Marschner and Lobb's signal, as an opacity that rises with it.
Volume signal()
{
  Volume volume = volumeOf(
    [](const glm::dvec3& at)
    {
      constexpr double pi = 3.14159265358979;
      const double radius = std::hypot(at.x, at.y);
      const double ripple = std::cos(12.0 * pi * std::cos(0.5 * pi * radius));
      return (1.0 - std::sin(0.5 * pi * at.z) + 0.25 * (1.0 + ripple)) / 2.5;
    },
    glm::ivec3(64));
  VolumeOpacity opacity;
  for (int i = 0; i < 1024; ++i)
  {
    const double scalar = i / 1023.0;
    opacity.extinctions.push_back(static_cast<float>(scalar > 0.3 ? 6.0 * (scalar - 0.3) : 0.0));
  }
  volume.opacities = { opacity };
  return volume;
}

/// Porous bone, after Schoen's gyroid.
Volume bone()
{
  return bodyOf(
    [](const glm::dvec3& at)
    {
      const glm::dvec3 phase = 7.0 * at;
      return 0.3 *
        (0.2 + std::sin(phase.x) * std::cos(phase.y) + std::sin(phase.y) * std::cos(phase.z) +
          std::sin(phase.z) * std::cos(phase.x));
    },
    2.0);
}

const Named<Volume (*)()> scans[] = { { "Signal", signal }, { "Bone", bone },
  { "Slab", [] { return slabOf(0.7); } } };

/// A light with the bound of its errors: 99 % are smaller.
struct BoundedLight
{
  ShadowLight light;
  double bound = 0.03;
};

const Named<BoundedLight> stackLights[] = { { "SunAlongAnAxis",
                                              { directionalLight({ 0.0, 0.0, -1.0 }) } },
  { "Sun", { directionalLight({ -0.4, 0.5, -1.0 }) } },
  { "Lamp", { pointLight({ 1.5, -1.0, 4.0 }) } },
  { "LampNearby", { pointLight({ 0.3, 0.2, 1.3 }), 0.05 } },
  { "LampInside", { pointLight({ 0.1, -0.2, 0.3 }) } } };

using StackCase = std::tuple<Named<Volume (*)()>, Named<BoundedLight>>;
struct VolumeStacks : testing::TestWithParam<StackCase>
{
};

TEST_P(VolumeStacks, AreNearTheMarch)
{
  const auto& [scan, light] = this->GetParam();
  const StackErrors errors = errorsOf(castersOf({ scan.value() }), light.value.light, 256);
  this->RecordProperty("mean", std::to_string(errors.mean));
  EXPECT_LE(errors.mean, 0.01);
  EXPECT_LE(errors.of99Percent, light.value.bound);
}

INSTANTIATE_TEST_SUITE_P(, VolumeStacks,
  testing::Combine(testing::ValuesIn(scans), testing::ValuesIn(stackLights)),
  [](const auto& of) { return std::get<0>(of.param).name + std::get<1>(of.param).name; });

/// Nothing shines through the near face of a light's box.
TEST(VolumeStack, BeginsAtTheBoxOfALight)
{
  const Volumes casters = castersOf({ slabOf(0.5) });
  ShadowLight sun = directionalLight({ 0.0, 0.0, -1.0 });
  sun.box = LightBox{ 4.0, 4.0, 9.0 };
  for (const auto& [height, depth] : { std::pair(3.0, 1.0), { 0.0, 0.5 }, { -1.5, 0.0 } })
  {
    sun.positionWorld = { 0.0, 0.0, height };
    const VolumeStack stack(casters, ShadowRayLight(sun, glm::dvec3(0.0)), 32);
    EXPECT_NEAR(stack.transmittanceOf({ 0.1f, 0.1f, -2.0f }, { 0.0f, 0.0f, 1.0f }, 1.0f).x,
      std::exp(-depth), 1e-4);
  }
}

TEST(Volumes, OpacityAtTheUnitDistanceIsKept)
{
  for (const double opacity : { 0.0, 0.01, 0.5, 0.99 })
  {
    EXPECT_NEAR(std::exp(-extinctionOf(opacity, 0.25) * 0.25), 1.0 - opacity, 1e-6);
  }
  EXPECT_EQ(std::exp(-1e-9 * extinctionOf(1.0, 1.0)), 0.0);
}

} // namespace
} // namespace gnomon::test
