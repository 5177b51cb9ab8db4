// Verdicts on whole tiles without rays agree with tracing.

#include "shadowtech/tracing/TileVerdicts.h"

#include "InstancedScene.h"
#include "RandomScenes.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// A picture's visibility, its classes and its rays.
struct Shown
{
  std::vector<float> visibility;
  std::vector<std::uint8_t> classes;
  std::size_t rays = 0;

  TracedClass of(std::size_t pixel) const { return static_cast<TracedClass>(this->classes[pixel]); }
};

/// A scene with its receivers, ready for any light.
class Judged
{
public:
  Judged(Occluders occluders, const View& view)
    : occluders_(std::move(occluders))
  {
    this->tracer_.update(this->occluders_);
    Receivers(view.images, view.drawnSurfaces, this->occluders_, this->receivers_).all();
  }
  Judged(const std::vector<Prop>& props, const Camera& camera)
    : Judged(makeOccluders(props), makeView(makeOccluders(props), camera))
  {
  }

  TileVerdicts judge(const ShadowLight& light)
  {
    this->boxes_.emplace(this->receivers_, this->occluders_);
    return { light, this->occluders_, *this->boxes_, this->tracer_ };
  }
  /// @param verdicts null: all receivers are traced
  Shown trace(const ShadowLight& light, const TileVerdicts* verdicts)
  {
    Shown shown;
    const Receivers receivers(this->receivers_);
    shown.rays = light.area
      ? this->tracer_.traceArea(light, this->occluders_, receivers, shown.visibility, nullptr,
          &shown.classes, nullptr, nullptr, verdicts)
      : this->tracer_.trace(light, this->occluders_, receivers, shown.visibility, nullptr,
          &shown.classes, nullptr, verdicts);
    return shown;
  }
  LightReport report(const ShadowLight& light)
  {
    LightReport report;
    this->judge(light).tell(light, report);
    return report;
  }

private:
  Occluders occluders_;
  EmbreeTracer tracer_;
  ReceiverPixels receivers_;
  std::optional<ReceiverBoxes> boxes_;
};

/// Compare a light's visibility with verdicts and without, pixel by pixel.
void expectSame(const Shown& judged, const Shown& traced, const std::string& where)
{
  ASSERT_EQ(judged.visibility, traced.visibility) << where;
  for (std::size_t i = 0; i < traced.classes.size(); ++i)
  {
    const TracedClass of = judged.of(i);
    const float visibility = traced.visibility[i];
    const bool isDecided = (of == TracedClass::Lit && visibility == 1.0f) ||
      (of == TracedClass::Shadow && visibility == 0.0f);
    const bool mayBeDecided = traced.of(i) == TracedClass::Traced ||
      (traced.of(i) == TracedClass::Unreached && of == TracedClass::Shadow);
    ASSERT_TRUE(of == traced.of(i) || (isDecided && mayBeDecided)) << where << ", pixel " << i;
  }
}

/// Counts of pixels by the way in which they are decided.
using DecidedPixels = std::array<std::size_t, 5>; // by TracedClass
void countDecided(const TileVerdicts& verdicts, const Shown& judged, DecidedPixels& counts)
{
  for (std::size_t i = 0; i < judged.classes.size(); ++i)
  {
    counts[judged.classes[i]] += judged.of(i) != TracedClass::Unreached ? 1 : 0;
  }
  // Pixels turned away have this class as well, but not as whole dark tiles.
  std::vector<std::uint8_t> dark(judged.classes.size(), 0);
  for (std::size_t tile = 0; tile < verdicts.darkTiles().size(); ++tile)
  {
    if (verdicts.darkTiles()[tile] != 0)
    {
      verdicts.classifyDark(tile, dark);
    }
  }
  counts[static_cast<std::size_t>(TracedClass::Unreached)] += static_cast<std::size_t>(
    std::count(dark.begin(), dark.end(), static_cast<std::uint8_t>(TracedClass::Unreached)));
}

/// Return a light of any kind, with an area of some shape, or none.
ShadowLight anyLight(Random& random)
{
  const ShadowLight light = random() % 4 == 0
    ? pointLight(uniform(random, 1.0, 5.0) * unitVector(random))
    : makeRandomLight(random);
  const glm::dvec3 travel =
    light.kind == LightKind::Point ? glm::dvec3(0.0, 0.0, -1.0) : light.directionWorld;
  const double size = light.kind == LightKind::Directional ? 0.05 : uniform(random, 0.05, 0.4);
  switch (random() % 5)
  {
    case 0:
      return withArea(light, diskArea(travel, size), 4);
    case 1:
      return withArea(light, rectangleArea(travel, { 0.3, 0.5, 0.7 }, { size, 0.5 * size }), 4);
    case 2:
      return withArea(light, ballArea(size), 4);
    default:
      return light;
  }
}

/// Large walls around random scenes, some of which neither cast nor receive.
void addWalls(std::vector<Prop>& props, Random& random)
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 direction = unitVector(random);
    glm::dmat4 place = at(uniform(random, 1.5, 4.0) * direction);
    place = glm::rotate(place, uniform(random, 0.0, 3.1), unitVector(random));
    Prop wall{ makePlane(uniform(random, 1.0, 6.0), 1 + static_cast<int>(random() % 2)), place };
    wall.casts = random() % 5 != 0;
    wall.receives = random() % 5 != 0;
    wall.oneSided = random() % 5 == 0;
    props.push_back(wall);
  }
}

Camera cameraAround(Random& random)
{
  const glm::dvec3 position = 4.0 * unitVector(random) + glm::dvec3(0.0, 0.0, 1.0);
  const double target = uniform(random, 0.0, 0.8);
  return { position, { 0.0, 0.0, target }, { 0.0, 0.0, 1.0 }, uniform(random, 10.0, 60.0), 0.0, 150,
    110 };
}

TEST(TileVerdicts, MatchTracing)
{
  DecidedPixels counts{};
  for (const char* const name : randomSceneNames())
  {
    for (unsigned int seed = 0; seed < exactRuns(6); ++seed)
    {
      Random random(1000 * seed + 17);
      std::vector<Prop> props = makeRandomScene(name, random);
      if (seed % 2 == 0)
      {
        addWalls(props, random);
      }
      Judged scene(props, cameraAround(random));
      for (int i = 0; i < 8; ++i)
      {
        const ShadowLight light = anyLight(random);
        const TileVerdicts verdicts = scene.judge(light);
        const Shown judged = scene.trace(light, &verdicts);
        const Shown traced = scene.trace(light, nullptr);
        expectSame(judged, traced,
          std::string(name) + ", seed " + std::to_string(seed) + ", light " + std::to_string(i));
        EXPECT_LE(judged.rays, traced.rays);
        countDecided(verdicts, judged, counts);
      }
    }
  }
  for (const TracedClass of : { TracedClass::Traced, TracedClass::Lit, TracedClass::Shadow,
         TracedClass::Unreached, TracedClass::NoReceiver })
  {
    EXPECT_GT(counts[static_cast<std::size_t>(of)], 10000u) << static_cast<int>(of);
  }
}

/// Return a floor that does not cast, and over its half with x > 0 a wall between it and the lamp.
std::vector<Prop> makeWallAndFloor()
{
  Prop floor{ makePlane(8.0) };
  floor.casts = false;
  return { floor, { makePlane(60.0), at({ 0.0, 0.0, 1.0 }) } };
}

const Camera cameraOverFloor{ { 1.0, 0.0, 0.8 }, { 0.0, 0.2, 0.0 }, { 0.0, 0.0, 1.0 }, 50.0 };

const ShadowLight lampOverWall = pointLight({ 0.0, 0.0, 9.0 });

TEST(TileVerdicts, GiveReasonsForSkippedLights)
{
  Judged scene(makeWallAndFloor(), cameraOverFloor);
  EXPECT_EQ(scene.report(lampOverWall).skipReason, "casters hide it from all that is visible");
  EXPECT_GT(scene.report(lampOverWall).tilesDark, 0);
  EXPECT_EQ(scene.report(lampOverWall).tilesTraced, 0);
  EXPECT_EQ(scene.report(pointLight({ 0.0, 0.0, 0.5 })).skipReason,
    "no caster is between it and what is visible");
  EXPECT_EQ(scene.report(spotLight({ 0.0, 0.0, 9.0 }, { 0.0, 0.0, 20.0 }, 30.0)).skipReason,
    "its cone reaches nothing visible");
  EXPECT_EQ(
    scene.report(boxLight({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, -3.0 }, glm::dvec3(2.0))).skipReason,
    "its box reaches nothing visible");
}

/// Only a sure blocker hides a light.
TEST(TileVerdicts, DoNotTrustWallsWithHolesOrOneSide)
{
  const auto isDark = [](const Prop& wall)
  {
    std::vector<Prop> props = makeWallAndFloor();
    props[1] = wall;
    return Judged(props, cameraOverFloor).judge(lampOverWall).areAllDark();
  };
  Prop wall = makeWallAndFloor()[1];
  EXPECT_TRUE(isDark(wall));
  wall.oneSided = true; // its front faces the lamp
  EXPECT_TRUE(isDark(wall));
  wall.worldFromMesh = glm::rotate(wall.worldFromMesh, 3.0, { 1.0, 0.0, 0.0 }); // turned over;
  EXPECT_FALSE(isDark(wall));
  wall.oneSided = false;
  EXPECT_TRUE(isDark(wall));
  wall.casts = false;
  EXPECT_FALSE(isDark(wall));
  EXPECT_FALSE(isDark(makePerforatedPlane(60.0, 1, at({ 0.0, 0.0, 1.0 }))));

  std::vector<Prop> props = makeWallAndFloor();
  Occluders occluders = makeOccluders(props);
  const View view = makeView(occluders, cameraOverFloor);
  makeInstanced(occluders, 1, { glm::dmat4(1.0) });
  EXPECT_FALSE(Judged(occluders, view).judge(lampOverWall).areAllDark());
}

} // namespace
} // namespace gnomon::test
