// Conservative maps against ray tracing: what they say for certain is never wrong.

#include "shadowtech/conservative/ConservativeMaps.h"

#include "SyntheticScene.h"

#include "lights/ShadowSettings.h"
#include "shadowtech/base/RayTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace gnomon::test
{
namespace
{

using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

glm::dvec3 unitVector(Random& random)
{
  const double z = uniform(random, -1.0, 1.0);
  const double angle = uniform(random, 0.0, 6.283185307179586);
  const double radius = std::sqrt(1.0 - z * z);
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}

glm::dmat4 placed(Random& random, double spread, double scale)
{
  const glm::dvec3 position(
    uniform(random, -spread, spread), uniform(random, -spread, spread), uniform(random, 0.2, 1.6));
  return glm::rotate(at(position, scale), uniform(random, 0.0, 6.28), unitVector(random));
}

/// A fan of triangles around one corner, some of them nearly without area.
Mesh makeNeedles(Random& random, int count)
{
  Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 from(
      uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -0.5, 0.5));
    const glm::dvec3 along = unitVector(random);
    const double width = std::pow(10.0, uniform(random, -7.0, -1.0));
    const auto first = static_cast<unsigned int>(mesh.points.size());
    mesh.points.push_back(from);
    mesh.points.push_back(from + along);
    mesh.points.push_back(from + 0.5 * along + width * unitVector(random));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

/// A sphere without its upper part.
Mesh makeCup(int rings, int segments)
{
  Mesh mesh = makeSphere(rings, segments);
  std::vector<glm::uvec3> kept;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    if (mesh.points[triangle.x].z < 0.3 && mesh.points[triangle.y].z < 0.3 &&
      mesh.points[triangle.z].z < 0.3)
    {
      kept.push_back(triangle);
    }
  }
  mesh.triangles = kept;
  return mesh;
}

/// A sheet that is folded to and fro, with every fold nearly closed.
Mesh makeFolds(int folds)
{
  Mesh mesh;
  for (int i = 0; i <= folds; ++i)
  {
    const double x = 0.05 * i;
    const double z = (i % 2) ? 0.8 : 0.0;
    mesh.points.emplace_back(x, -0.7, z);
    mesh.points.emplace_back(x, 0.7, z);
    if (i > 0)
    {
      const auto last = static_cast<unsigned int>(2 * i);
      mesh.triangles.emplace_back(last - 2, last, last + 1);
      mesh.triangles.emplace_back(last - 2, last + 1, last - 1);
    }
  }
  return mesh;
}

/// A square whose halves are cut differently, so that vertices lie on edges.
Mesh makeTJunctions()
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 0.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 }, { -1.0, 1.0, 0.0 },
    { 0.0, 0.25, 0.0 }, { 1.0, -1.0, 0.0 }, { 1.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 5, 4 }, { 4, 5, 6 }, { 4, 6, 2 } };
  return mesh;
}

/// Triangles that are there twice, once turned over.
Mesh makeDuplicates(Random& random, int count)
{
  Mesh mesh = makeTriangleSoup(count, random());
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += 2)
  {
    const glm::uvec3 triangle = mesh.triangles[i];
    mesh.triangles.push_back((i % 4) ? triangle : glm::uvec3(triangle.y, triangle.x, triangle.z));
  }
  return mesh;
}

const char* const sceneNames[] = { "one triangle", "spheres", "soup", "needles", "cups", "folds",
  "junctions", "duplicates", "touching boxes", "crossing boxes", "terrain", "perforated",
  "one-sided", "sheets", "lamp" };

std::vector<Prop> makeScene(const std::string& name, Random& random)
{
  std::vector<Prop> props{ { makePlane(6.0, 1 + static_cast<int>(random() % 4)) } };
  const auto add = [&](Mesh mesh, double scale) {
    props.push_back({ std::move(mesh), placed(random, 1.2, scale) });
  };
  if (name == "one triangle")
  {
    props.clear();
    Mesh mesh;
    mesh.points = { unitVector(random), unitVector(random), unitVector(random) };
    mesh.triangles = { { 0, 1, 2 } };
    props.push_back({ mesh });
  }
  for (int i = 0; i < 4; ++i)
  {
    if (name == "spheres")
    {
      add(makeSphere(6 + 5 * i, 12 + 10 * i, 0.2 * i), 0.3);
    }
    else if (name == "soup")
    {
      add(makeTriangleSoup(60, random()), 1.0);
    }
    else if (name == "needles")
    {
      add(makeNeedles(random, 40), 0.8);
    }
    else if (name == "cups")
    {
      add(makeCup(12, 16), 0.4);
    }
    else if (name == "folds")
    {
      add(makeFolds(8 + i), 0.9);
    }
    else if (name == "junctions")
    {
      add(makeTJunctions(), 0.6);
    }
    else if (name == "duplicates")
    {
      add(makeDuplicates(random, 30), 1.0);
    }
    else if (name == "perforated")
    {
      props.push_back(makePerforatedPlane(1.2, 1 + i, placed(random, 0.8, 1.0)));
    }
    else if (name == "one-sided")
    {
      add(makeSphere(8, 12), 0.4);
      props.back().oneSided = true;
    }
    else if (name == "sheets")
    {
      // Close to each other, the last in the same place as the one before.
      const double height = i == 3 ? 0.52 : 0.5 + 0.01 * i;
      props.push_back({ makePlane(1.5, 1 + i), at({ 0.1 * i, 0.0, height }) });
    }
  }
  if (name == "one-sided")
  {
    // The plane is seen from its back, where it casts nothing.
    props.front().worldFromMesh =
      glm::rotate(glm::dmat4(1.0), 3.141592653589793, { 1.0, 0.0, 0.0 });
    props.front().oneSided = true;
  }
  else if (name == "touching boxes")
  {
    props.push_back({ makeBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 }) });
    props.push_back({ makeBox({ 0.5, -0.2, 0.0 }, { 1.0, 0.7, 0.6 }) });
    props.push_back({ makeBox({ -0.2, -0.2, 1.0 }, { 0.3, 0.3, 1.2 }) });
  }
  else if (name == "crossing boxes")
  {
    for (int i = 0; i < 4; ++i)
    {
      props.push_back({ makeBox(glm::dvec3(-0.4), glm::dvec3(0.4)), placed(random, 0.4, 1.0) });
    }
  }
  else if (name == "lamp")
  {
    // The shade around a light is small against the scene, which rounding is in proportion to.
    props.push_back(
      { makeCup(8, 24), glm::rotate(at({ 0.1, -0.2, 1.0 }, 0.15), 3.0, { 1.0, 0.2, 0.0 }) });
    props.push_back({ makeBox(glm::dvec3(20.0), glm::dvec3(25.0)) });
  }
  else if (name == "terrain")
  {
    props.front() = { makeTerrain(6.0, 24, 0.5) };
    props.push_back({ makeBox({ -0.2, -0.2, 0.0 }, { 0.2, 0.2, 1.5 }) });
  }
  return props;
}

ShadowLight makeLight(Random& random)
{
  const glm::dvec3 direction = unitVector(random) * glm::dvec3(1.0, 1.0, -1.0);
  const glm::dvec3 downwards(direction.x, direction.y, -std::abs(direction.z) - 0.05);
  switch (random() % 6)
  {
    case 0:
      return directionalLight({ 0.0, 0.0, -1.0 });
    case 1:
      return pointLight(
        { uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.3, 4.0) });
    case 2:
      return spotLight(
        -4.0 * glm::normalize(downwards), glm::dvec3(0.0, 0.0, 0.3), uniform(random, 5.0, 80.0));
    case 3:
      return boxLight(downwards, -1.2 * glm::normalize(downwards),
        { uniform(random, 1.0, 4.0), uniform(random, 1.0, 4.0), uniform(random, 1.0, 4.0) });
    default:
      return directionalLight(downwards);
  }
}

/// What a run found.
struct Tally
{
  std::size_t receivers = 0; ///< that get a shadow ray
  std::size_t traced = 0;
  std::size_t leftOut = 0; ///< decided before they were made
  std::size_t wrong = 0;
};

/// How a map and a full trace differ.
Tally compareWithTruth(const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const Receivers& receivers, Covering covering = Covering::Silhouette)
{
  ConservativeMaps maps(covering);
  maps.bake(light, views, occluders);
  RayTracer tracer;
  tracer.update(occluders);
  Tally tally;
  std::vector<float> truth, visibility;
  tally.receivers = tracer.trace(light, occluders, receivers, truth);
  tally.traced = tracer.trace(light, occluders, receivers, visibility, &maps);
  tally.wrong = countDifferent(truth, visibility);
  std::atomic<std::size_t> leftOut{ 0 };
  receivers.visitTiles(
    [&](const ReceiverTile& tile)
    {
      leftOut += static_cast<std::size_t>(std::count_if(
        tile.known.begin(), tile.known.end(), [](Certainty known) { return isDecided(known); }));
    },
    &maps);
  tally.leftOut = leftOut;
  return tally;
}

/// One picture of one scene in one light, by maps of one size.
Tally run(const std::string& name, unsigned int seed, Covering covering, const glm::dmat4& world)
{
  Random random(seed);
  std::vector<Prop> props = makeScene(name, random);
  const double scale = glm::length(glm::dvec3(world[0]));
  for (Prop& prop : props)
  {
    prop.worldFromMesh = world * prop.worldFromMesh;
  }
  const Occluders occluders = makeOccluders(props);
  const auto toWorld = [&](const glm::dvec3& point)
  { return glm::dvec3(world * glm::dvec4(point, 1.0)); };

  Camera camera;
  camera.width = camera.height = 96;
  camera.position =
    toWorld(3.5 * unitVector(random) * glm::dvec3(1.0, 1.0, 0.5) + glm::dvec3(0.0, 0.0, 2.0));
  camera.target = toWorld({ 0.0, 0.0, uniform(random, 0.0, 0.8) });
  camera.fovDegrees = uniform(random, 10.0, 60.0);
  // Not yet made, so that maps are asked about triangles and lines, too.
  const View view = makeView(occluders, camera);
  ReceiverPixels stored;
  const Receivers receivers(view.images, view.drawnSurfaces, occluders, stored);

  ShadowLight light = makeLight(random);
  if (name == "lamp")
  {
    const glm::dvec3 bulb(0.12, -0.21, 1.0);
    light = random() % 2 ? pointLight(bulb) : spotLight(bulb, { 0.0, 0.0, 0.0 }, 80.0);
  }
  light.positionWorld = toWorld(light.positionWorld);
  if (light.box)
  {
    light.box->width *= scale;
    light.box->height *= scale;
    light.box->depth *= scale;
  }
  const char* const projections[] = { "uniform", "uniform", "lispsm", "tsm", "pssm" };
  findSetting("projection")->set(light, projections[random() % 5]);
  if (!refusedProjection(light).empty())
  {
    findSetting("projection")->set(light, light.kind == LightKind::Point ? "cube" : "uniform");
  }
  light.fit = random() % 2 ? ViewFit::Frame : ViewFit::Off;
  const int sizes[] = { 16, 64, 129, 512 };
  light.mapSizeTexels = sizes[random() % 4];

  ViewFitting fitting;
  fitting.centreWorld = occluders.centreWorld;
  fitting.castersCentred = occluders.castersCentred;
  fitting.receiversCentred = occluders.allCentred;
  fitting.texels = { light.mapSizeTexels, 1 };
  if (isFittedToCamera(light))
  {
    const glm::dmat4 viewFromCentred = glm::lookAt(
      camera.position - occluders.centreWorld, camera.target - occluders.centreWorld, camera.up);
    fitting.camera = CameraView{ viewFromCentred,
      glm::perspective(glm::radians(camera.fovDegrees), 1.0, 0.05 * scale, 20.0 * scale) };
  }
  const Tally tally =
    compareWithTruth(light, fitLightViews(light, fitting), occluders, receivers, covering);
  if (tally.wrong > 0)
  {
    ADD_FAILURE() << name << ", seed " << seed << ": " << tally.wrong << " wrong pixels, light "
                  << static_cast<int>(light.kind) << (light.box ? " with a box" : "") << ", "
                  << findSetting("projection")->get(light) << ", map " << light.mapSizeTexels;
  }
  return tally;
}

/// Runs of each scene: few by default; more where GNOMON_EXACT_RUNS says so.
unsigned int runs()
{
  const char* const asked = std::getenv("GNOMON_EXACT_RUNS");
  return asked ? static_cast<unsigned int>(std::max(1, std::atoi(asked))) : 24u;
}

class ConservativeMapsIn : public testing::TestWithParam<std::tuple<const char*, Covering>>
{
};

TEST_P(ConservativeMapsIn, areNeverWrong)
{
  const auto& [name, covering] = GetParam();
  Tally sum;
  for (unsigned int seed = 1; seed <= runs(); ++seed)
  {
    const Tally tally = run(name, seed, covering, glm::dmat4(1.0));
    sum.receivers += tally.receivers;
    sum.traced += tally.traced;
    sum.wrong += tally.wrong;
    sum.leftOut += tally.leftOut;
  }
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_GT(sum.leftOut, sum.receivers / 20) << "triangles and lines are asked about";
  EXPECT_GT(sum.receivers, runs() * 300u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4); // it does decide something
  std::cout << name << ": left out " << sum.leftOut << ", traced "
            << 100.0 * static_cast<double>(sum.traced) / static_cast<double>(sum.receivers)
            << " % of " << sum.receivers << std::endl;
}

std::string nameOfRun(const testing::TestParamInfo<ConservativeMapsIn::ParamType>& run)
{
  const char* const coverings[] = { "Triangle", "Ring", "Silhouette" };
  std::string name = std::get<0>(run.param);
  const auto isSeparator = [](unsigned char letter) { return !std::isalpha(letter); };
  name.erase(std::remove_if(name.begin(), name.end(), isSeparator), name.end());
  return name + coverings[static_cast<int>(std::get<1>(run.param))];
}

INSTANTIATE_TEST_SUITE_P(Scenes, ConservativeMapsIn,
  testing::Combine(testing::ValuesIn(sceneNames),
    testing::Values(Covering::Triangle, Covering::Ring, Covering::Silhouette)),
  nameOfRun);

TEST(ConservativeMaps, areNeverWrongFarAwayAndAtAnyScale)
{
  const glm::dmat4 worlds[] = { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
    at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) };
  for (const glm::dmat4& world : worlds)
  {
    for (const char* name : sceneNames)
    {
      for (unsigned int seed = 100; seed < 100 + runs() / 4; ++seed)
      {
        EXPECT_EQ(run(name, seed, Covering::Silhouette, world).wrong, 0u);
      }
    }
  }
}

/// Receivers that are put where a test wants them.
struct ChosenReceivers
{
  ReceiverPixels pixels;

  /// @param surface that they count as points of
  explicit ChosenReceivers(int count, std::uint32_t surface)
  {
    this->pixels.resize(count, 1);
    std::fill(this->pixels.surface.begin(), this->pixels.surface.end(), surface);
  }
  void set(std::size_t i, const glm::dvec3& centred, const glm::dvec3& normal, float offset)
  {
    this->pixels.positionX[i] = static_cast<float>(centred.x);
    this->pixels.positionY[i] = static_cast<float>(centred.y);
    this->pixels.positionZ[i] = static_cast<float>(centred.z);
    this->pixels.normalX[i] = static_cast<float>(normal.x);
    this->pixels.normalY[i] = static_cast<float>(normal.y);
    this->pixels.normalZ[i] = static_cast<float>(normal.z);
    this->pixels.offset[i] = offset;
  }
};

TEST(ConservativeMaps, areNeverWrongInTheBottomOfAValley)
{
  // Both sides face the light, and rays from one start behind the other near the bottom.
  for (const double steepness : { 0.5, 1.0, 3.0 })
  {
    const double side = 2.0;
    Mesh valley;
    for (const double y : { -1.0, 1.0 })
    {
      valley.points.emplace_back(-side, y, steepness * side);
      valley.points.emplace_back(0.0, y, 0.0);
      valley.points.emplace_back(side, y, steepness * side);
    }
    valley.triangles = { { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 } };
    const Occluders occluders = makeOccluders({ { valley } });
    ShadowLight light = directionalLight({ 0.05, 0.02, -1.0 });
    light.mapSizeTexels = 32;
    constexpr int count = 4000;
    ChosenReceivers chosen(count, 0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(steepness, 0.0, 1.0));
    for (int i = 0; i < count; ++i)
    {
      const double x = -std::pow(10.0, -8.0 + 8.0 * i / count);
      const double y = -0.9 + 1.8 * std::fmod(0.618 * i, 1.0);
      chosen.set(static_cast<std::size_t>(i),
        glm::dvec3(x, y, -steepness * x) - occluders.centreWorld, normal, 3e-5f);
    }
    const Tally tally = compareWithTruth(light,
      fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
      occluders, chosen.pixels);
    EXPECT_EQ(tally.wrong, 0u) << steepness;
    EXPECT_LT(tally.traced, tally.receivers) << steepness;
  }
}

TEST(ConservativeMaps, areNeverWrongWhereEdgesLieOnTexelsBorders)
{
  // A row of plates whose edges lie exactly between texels, high above receivers that lie there, too. The
  // light's direction is rounded for shadow rays, which counts over the distance.
  ShadowLight light = directionalLight({ 0.3, -0.2, -1.0 });
  light.mapSizeTexels = 64;
  const std::vector<Prop> corners{ { makeBox(glm::dvec3(-500.0), glm::dvec3(-499.0)) },
    { makeBox(glm::dvec3(499.0), glm::dvec3(500.0)) } };
  const Occluders frame = makeOccluders(corners);
  const LightViews views =
    fitLightViews(light, frame.centreWorld, frame.castersCentred, light.mapSizeTexels);
  const LightView& view = views.views.front();
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, light.mapSizeTexels));
  const auto centred = [&](double texelX, double texelY, double z)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, { texelX, texelY });
    return glm::dvec3(centredFromView * glm::dvec4(across, z, 1.0));
  };
  // The middle of the box as seen by the light.
  const double middle = (view.rays.viewFromCentred * glm::dvec4(0.0, 0.0, 0.0, 1.0)).z;
  Mesh plates;
  for (int x = 24; x < 40; x += 8)
  {
    const auto first = static_cast<unsigned int>(plates.points.size());
    for (const auto& [cornerX, cornerY] :
      { std::pair(x, 24), { x + 4, 24 }, { x + 4, 40 }, { x, 40 } })
    {
      plates.points.push_back(centred(cornerX, cornerY, middle - 300.0) + frame.centreWorld);
    }
    plates.triangles.emplace_back(first, first + 1, first + 2);
    plates.triangles.emplace_back(first, first + 2, first + 3);
  }
  // What receives is no caster, so that it may be anywhere.
  const Prop receiver{ makePlane(1.0), glm::dmat4(1.0), false };
  const Occluders occluders = makeOccluders({ corners[0], corners[1], { plates }, receiver });
  ASSERT_EQ(occluders.castersCentred.upper, frame.castersCentred.upper);
  constexpr int count = 20000;
  ChosenReceivers chosen(count, 3);
  Random random(5);
  for (int i = 0; i < count; ++i)
  {
    const double beside = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -8.0, -0.4));
    chosen.set(static_cast<std::size_t>(i),
      centred(24.0 + static_cast<double>(random() % 16) + beside, uniform(random, 25.0, 39.0),
        middle + 300.0),
      -light.directionWorld, 1e-4f);
  }
  const Tally tally = compareWithTruth(light, views, occluders, chosen.pixels);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_LT(tally.traced, tally.receivers);
}

TEST(ConservativeMaps, areNeverWrongWhereCastersTouchTheLight)
{
  // A lamp that lies in the ceiling, and a box of light that begins in a plate, where rays end to within rounding.
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.3, { 1.0, 0.5, 0.2 });
  for (const glm::dmat4& world : { glm::dmat4(1.0), turn })
  {
    const glm::dvec3 lamp(world * glm::dvec4(0.31, 0.12, 2.0, 1.0));
    const glm::dvec3 floor(world * glm::dvec4(0.3, 0.1, 0.0, 1.0));
    const Occluders occluders =
      makeOccluders({ { makePlane(4.0), world }, { makePlane(3.0), world * at({ 0.0, 0.0, 2.0 }) },
        { makeSphere(8, 12), world * at({ 0.4, 0.3, 0.7 }, 0.3) } });
    Camera camera;
    camera.width = camera.height = 96;
    camera.position = glm::dvec3(world * glm::dvec4(0.5, -5.0, 1.5, 1.0));
    camera.target = floor;
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    std::vector<ShadowLight> lights{ pointLight(lamp), spotLight(lamp, floor, 30.0),
      spotLight(lamp, floor, 75.0) };
    for (const double before : { 0.0, 1e-8, 3e-8, 1e-7 })
    {
      // Along the plate's normal, so that its near face lies in the plate all over.
      const glm::dvec3 normal(world * glm::dvec4(0.0, 0.0, -1.0, 0.0));
      lights.push_back(boxLight(normal, lamp - before * normal, { 2.0, 2.0, 3.0 }));
      lights.back().box->upWorld = glm::dvec3(world * glm::dvec4(0.0, 1.0, 0.0, 0.0));
    }
    for (ShadowLight light : lights)
    {
      light.mapSizeTexels = 128;
      const Tally tally = compareWithTruth(light,
        fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
        occluders, receivers);
      EXPECT_GT(tally.receivers, 500u);
      EXPECT_EQ(tally.wrong, 0u) << static_cast<int>(light.kind) << " " << light.coneAngleDegrees;
    }
  }
}

} // namespace
} // namespace gnomon::test
