// A picture's view of the sky against rays in double.

#include "RandomScenes.h"

#include "shadowtech/sky/SkyImage.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

Sky skyOf(SkyModel model)
{
  Sky sky;
  sky.model = model;
  sky.up = { 0.0f, 0.0f, 1.0f };
  return sky;
}

/// Return the view of the open sky by the mean of many directions.
/// @param isFree called with each direction
template <typename IsFree>
double viewInDouble(const Sky& sky, const glm::dvec3& normal, int side, const IsFree& isFree)
{
  const glm::dvec3 aside = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, aside));
  const glm::dvec3 v = glm::cross(normal, u);
  double sum = 0.0;
  for (int i = 0; i < side * side; ++i)
  {
    // The middles of strata: squares of the sine, and angles.
    const double sineSquared = (i / side + 0.5) / side;
    const double turn = 2.0 * glm::pi<double>() * (i % side + 0.5) / side;
    const glm::dvec3 direction =
      std::sqrt(sineSquared) * (std::cos(turn) * u + std::sin(turn) * v) +
      std::sqrt(1.0 - sineSquared) * normal;
    sum += isFree(direction) ? radianceOf(sky, glm::vec3(direction)) : 0.0;
  }
  return sum / (side * side);
}

TEST(Sky, OpenViewsAreMeansOfRadiance)
{
  Random random(1);
  for (const SkyModel model : { SkyModel::Uniform, SkyModel::Dome, SkyModel::Overcast })
  {
    for (int i = 0; i < 40; ++i)
    {
      const glm::dvec3 normal = unitVector(random);
      const auto all = [](const glm::dvec3&) { return true; };
      EXPECT_NEAR(
        openView(skyOf(model), normal), viewInDouble(skyOf(model), normal, 256, all), 2e-3)
        << normal.z;
    }
  }
}

TEST(Sky, DirectionsAreSpreadByTheCosine)
{
  for (const int count : { 16, 64, 128, 1024 })
  {
    const SkyDirections directions(count);
    std::vector<int> ofBatch(SkyDirections::batches, 0);
    glm::dvec3 mean(0.0);
    constexpr int pixels = 64;
    for (int pixel = 0; pixel < pixels; ++pixel)
    {
      const SamplePixel own = directions.points().pixel(
        static_cast<std::uint32_t>(pixel % 8), static_cast<std::uint32_t>(pixel / 8));
      for (int i = 0; i < count; ++i)
      {
        const glm::vec3 local = directions.local(i, own);
        EXPECT_NEAR(glm::length(local), 1.0f, 1e-3f);
        EXPECT_GT(local.z, 0.0f);
        mean += glm::dvec3(local) / static_cast<double>(count * pixels);
        ++ofBatch[directions.batchOf(i)];
      }
    }
    EXPECT_NEAR(mean.z, 2.0 / 3.0, 2e-3); // of the cosine, by the cosine
    EXPECT_NEAR(glm::length(glm::dvec2(mean)), 0.0, 2e-3);
    EXPECT_THAT(ofBatch, testing::Each(count * pixels / static_cast<int>(SkyDirections::batches)));
  }
}

/// A scene and its picture.
struct SkyScene
{
  std::string name;
  std::vector<Prop> props;
  Camera camera;
};

std::vector<SkyScene> skyScenes()
{
  const Prop ground{ makePlane(20.0) };
  const Prop box{ makeBox({ -1, -1, 0 }, { 1, 1, 2 }) };
  const Prop roof{ makeBox({ -3, -3, 2.5 }, { 3, 1, 2.6 }) };
  const Prop room{ makeBox({ -4, -4, -0.1 }, { 4, 4, 3 }) };
  const Prop ball{ makeSphere(8, 12), at({ 0.3, 0.2, 1.1 }) };
  return { { "a box on the ground", { ground, box }, { { 5, 4, 5 }, { 0, 0, 0.5 } } },
    { "below a roof", { ground, box, roof }, { { 6, 7, 2 }, { 0, 0, 0.5 } } },
    { "a closed room", { ground, room, ball }, { { 3, 3, 2 }, { 0, 0, 0.5 } } },
    { "a ball above the ground", { ground, ball }, { { 4, 1, 3 }, { 0, 0, 0.5 } } },
    { "hills", { { makeTerrain(6.0, 5, 1.5) } }, { { 4, 3, 4 }, { 0, 0, 0 } } },
    { "triangles", { { makeTriangleSoup(40, 3), at(glm::dvec3(0), 3.0) } },
      { { 6, 6, 6 }, { 1.5, 1.5, 1.5 } } } };
}

/// A scene's receivers in a picture, ready for rays.
struct SeenScene
{
  Occluders occluders;
  ReceiverPixels receivers;
  EmbreeTracer tracer;

  /// @param width of the picture, whose sides are as 4 to 3
  explicit SeenScene(const SkyScene& scene, int width = 32)
    : occluders(makeOccluders(scene.props))
  {
    Camera camera = scene.camera;
    camera.width = width;
    camera.height = 3 * width / 4;
    this->receivers = makeReceivers(this->occluders, camera);
    this->tracer.update(this->occluders);
  }
  std::size_t trace(SkyImage& image, SkyModel model, std::size_t batches = SkyDirections::batches)
  {
    return image.trace(skyOf(model), this->receivers, this->occluders, this->tracer, batches);
  }
  std::size_t traceFew(SkyImage& image, SkyModel model)
  {
    return image.traceFew(skyOf(model), this->receivers, this->occluders, this->tracer);
  }
};

std::vector<float> viewOf(const SkyImage& image)
{
  std::vector<float> view;
  image.view(view);
  return view;
}

/// Return the views by rays in double: a stratified direction for each of side * side parts.
std::vector<double> viewsInDouble(
  const Sky& sky, const Occluders& occluders, const ReceiverPixels& receivers, int side)
{
  const std::vector<CastingTriangle> triangles = castingTriangles(occluders);
  std::vector<double> views(receivers.size(), 1.0);
  tbb::parallel_for(std::size_t(0), views.size(),
    [&](std::size_t i)
    {
      if (receivers.surface[i] == ReceiverPixels::notCovered)
      {
        return;
      }
      const glm::dvec3 normal = receivers.normal(i);
      const glm::dvec3 origin =
        glm::dvec3(receivers.position(i)) + double(receivers.offset[i]) * normal;
      views[i] = viewInDouble(sky, normal, side,
        [&](const glm::dvec3& direction)
        {
          return std::none_of(triangles.begin(), triangles.end(),
            [&](const CastingTriangle& triangle)
            {
              const std::optional<LineHit> hit = meet(triangle, origin, direction);
              return hit && hit->at > 0.0 && hit->isInside();
            });
        });
    });
  return views;
}

struct SkyErrors
{
  double rms = 0.0, bias = 0.0;
};
SkyErrors errorsOf(
  const std::vector<float>& view, const std::vector<double>& truth, const ReceiverPixels& receivers)
{
  SkyErrors errors;
  for (std::size_t i = 0; i < view.size(); ++i)
  {
    const double off = view[i] - truth[i];
    errors.rms += off * off;
    errors.bias += off;
  }
  const auto count = static_cast<double>(countCovered(receivers));
  return { std::sqrt(errors.rms / count), errors.bias / count };
}

TEST(SkyImage, ConvergesToRaysInDouble)
{
  double bias = 0.0;
  for (const SkyScene& scene : skyScenes())
  {
    SeenScene seen(scene);
    for (const SkyModel model : { SkyModel::Uniform, SkyModel::Overcast })
    {
      if (model != SkyModel::Uniform && scene.name != "below a roof")
      {
        continue; // radiance does not depend on the scene
      }
      const std::vector<double> truth =
        viewsInDouble(skyOf(model), seen.occluders, seen.receivers, 48);
      for (const int directions : { 64, 256 })
      {
        SkyImage image(directions);
        EXPECT_EQ(seen.trace(image, model),
          countCovered(seen.receivers) * static_cast<std::size_t>(directions));
        const SkyErrors errors = errorsOf(viewOf(image), truth, seen.receivers);
        EXPECT_LT(errors.rms, directions == 64 ? 0.02 : 0.008) << scene.name << " " << directions;
        if (directions == 256)
        {
          EXPECT_LT(std::abs(errors.bias), 0.003) << scene.name;
          bias += errors.bias / 7.0;
        }
      }
    }
  }
  EXPECT_LT(std::abs(bias), 0.001);
}

TEST(SkyImage, StepsEndAsOneImage)
{
  SeenScene seen(skyScenes().front());
  for (const SkyModel model : { SkyModel::Uniform, SkyModel::Dome, SkyModel::Overcast })
  {
    SkyImage whole(64), image(64);
    seen.trace(whole, model);
    seen.traceFew(image, model); // of a moving picture
    for (std::size_t batches = 1; batches <= SkyDirections::batches; batches += 3)
    {
      seen.trace(image, model, batches);
      EXPECT_EQ(image.batches(), batches);
    }
    EXPECT_EQ(viewOf(image), viewOf(whole));
  }
}

TEST(SkyImage, FewDirectionsAndNeighboursComeNear)
{
  for (const SkyScene& scene : skyScenes())
  {
    SeenScene seen(scene, 512);
    SkyImage image(256);
    EXPECT_EQ(seen.traceFew(image, SkyModel::Uniform), 2 * countCovered(seen.receivers));
    const std::vector<float> few = viewOf(image);
    seen.trace(image, SkyModel::Uniform);
    const std::vector<float> view = viewOf(image);
    const SkyErrors errors =
      errorsOf(few, std::vector<double>(view.begin(), view.end()), seen.receivers);
    // Facets with few pixels have few neighbours.
    EXPECT_LT(errors.rms, scene.name == "hills" ? 0.035 : 0.03) << scene.name;
    RecordProperty(scene.name.substr(scene.name.rfind(' ') + 1), std::to_string(errors.rms));
    EXPECT_LT(std::abs(errors.bias), 0.003) << scene.name;
  }
}

/// Every ray leaves a convex body, whether its curve's normal or its facet's leads.
TEST(SkyImage, ConvexBodiesSeeAll)
{
  SeenScene seen({ "ball", { { makeSphere(8, 12) } }, { { 4, 3, 2 } } }, 256);
  ReceiverPixels& receivers = seen.receivers;
  receivers.curves.resize(receivers.size());
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    receivers.curved[i] = receivers.surface[i] != ReceiverPixels::notCovered ? 1 : 0;
    receivers.curves[i].normal = glm::normalize(receivers.position(i) + glm::vec3(1e-9f));
  }
  SkyImage even(64), dome(64);
  seen.trace(even, SkyModel::Uniform);
  EXPECT_THAT(viewOf(even), testing::Each(1.0f));
  // Facets do not show in a sky that is not even.
  seen.trace(dome, SkyModel::Dome);
  const std::vector<float> view = viewOf(dome);
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const float expected =
      receivers.curved[i] != 0 ? 0.5f * (1.0f + receivers.curves[i].normal.z) : 1.0f;
    EXPECT_NEAR(view[i], expected, 1e-5f);
  }
}

} // namespace
} // namespace gnomon::test
