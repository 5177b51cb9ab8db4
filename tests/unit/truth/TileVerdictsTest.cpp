// Verdicts on whole tiles without rays agree with tracing.

#include "shadowtech/tracing/TileVerdicts.h"

#include "RandomScenes.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/TracedTiles.h"
#include "shadowtech/tracing/UmbraProof.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

// Blockers around the rays from a box to a light, tight or not quite. Receivers that are proved to
// be blocked are blocked when traced.

/// Return a light of any kind at some distance, with an area or none.
ShadowLight farLight(Random& random, const glm::dvec3& towards)
{
  ShadowLight light;
  switch (random() % 4)
  {
    case 0:
      light = pointLight(towards);
      break;
    case 1:
      light = spotLight(towards, glm::dvec3(0.0), 80.0);
      break;
    case 2:
      light = boxLight(-towards, towards, glm::dvec3(30.0));
      break;
    default:
      light = directionalLight(-towards);
      break;
  }
  if (random() % 2)
  {
    light.area =
      diskArea(light.kind == LightKind::Point ? -glm::normalize(towards) : light.directionWorld,
        light.kind == LightKind::Directional ? 0.05 : 0.4);
  }
  return light;
}

/// Return a polygon that stands across the rays from a box to a light, around all of them.
/// @param more its enlargement, as a share of its size
std::vector<glm::dvec3> polygonAround(
  const Bounds& box, const RayEnds& ends, int corners, double more, Random& random)
{
  const glm::dvec3 towards =
    glm::normalize(ends.isDirectional ? ends.corners[0] : ends.corners[0] - box.centre());
  const glm::dvec3 normal = glm::normalize(towards + 0.5 * inCube(random));
  const glm::dvec3 onPlane = uniform(random, 2.0, 5.0) * towards;
  const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8)));
  const glm::dvec3 y = glm::cross(normal, x);
  std::vector<glm::dvec2> passes; // where rays pass the plane
  for (const glm::dvec3& start : box.corners())
  {
    for (const glm::dvec3& end : ends.corners)
    {
      const glm::dvec3 direction = ends.isDirectional ? end : end - start;
      const double t = glm::dot(onPlane - start, normal) / glm::dot(direction, normal);
      const glm::dvec3 at = start + t * direction - onPlane;
      passes.emplace_back(glm::dot(at, x), glm::dot(at, y));
    }
  }
  // Lines on all sides, each next to the farthest of these; the corners are where they meet.
  std::vector<glm::dvec3> lines;
  const double turn = uniform(random, 0.0, 6.28);
  for (int i = 0; i < corners; ++i)
  {
    const double angle = turn + 6.283185307179586 * i / corners + uniform(random, -0.2, 0.2);
    const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
    double farthest = -std::numeric_limits<double>::infinity();
    for (const glm::dvec2& at : passes)
    {
      farthest = std::max(farthest, glm::dot(at, outwards));
    }
    lines.emplace_back(outwards, -farthest - more);
  }
  std::vector<glm::dvec3> polygon;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const glm::dvec3 meet = glm::cross(lines[i], lines[(i + 1) % lines.size()]);
    polygon.push_back(onPlane + meet.x / meet.z * x + meet.y / meet.z * y);
  }
  return polygon;
}

Mesh fanOf(const std::vector<glm::dvec3>& polygon)
{
  Mesh mesh{ polygon, {} };
  for (unsigned int i = 2; i < polygon.size(); ++i)
  {
    mesh.triangles.emplace_back(0, i - 1, i);
  }
  return mesh;
}

/// Return receivers in the corners of a box, facing the light.
ReceiverPixels cornersOf(const Bounds& box, const ShadowLight& light, const glm::dvec3& centreWorld)
{
  std::vector<PlacedReceiver> receivers;
  for (const glm::dvec3& corner : box.corners())
  {
    const glm::dvec3 toLight = light.kind == LightKind::Directional
      ? -light.directionWorld
      : glm::normalize(light.positionWorld - centreWorld - corner);
    receivers.push_back({ glm::vec3(corner), glm::vec3(toLight), 0.0f });
  }
  return rowOf(receivers);
}

/// Return the box of the same corners in float.
Bounds inFloat(const Bounds& box)
{
  return { glm::dvec3(glm::vec3(box.lower)), glm::dvec3(glm::vec3(box.upper)) };
}

/// A small box, a light, and the blockers between them.
struct Blocked
{
  ShadowLight light;
  Occluders occluders;
  Bounds box;
};
Blocked makeBlocked(Random& random, int corners, double more)
{
  Blocked blocked;
  blocked.light = farLight(random, uniform(random, 7.0, 12.0) * unitVector(random));
  const glm::dvec3 half = 0.4 * glm::abs(inCube(random));
  const Bounds box{ -half, half };
  const std::vector<glm::dvec3> polygon =
    polygonAround(box, RayEnds(blocked.light, Occluders()), corners, more, random);
  blocked.occluders = makeOccluders({ { fanOf(polygon) } });
  const glm::dvec3 centre = blocked.occluders.frame.centre;
  blocked.box = inFloat({ box.lower - centre, box.upper - centre });
  return blocked;
}

/// @param tracer gets the scene
bool isProved(const Blocked& blocked, EmbreeTracer& tracer)
{
  tracer.update(blocked.occluders);
  const RayEnds ends(blocked.light, blocked.occluders);
  std::optional<std::uint32_t> triangle;
  return UmbraProof(blocked.box, ends, blocked.occluders, tracer).finds(triangle);
}

TEST(UmbraProof, FindsBlockersThatAreLargeEnough)
{
  Random random(1);
  int proved = 0;
  constexpr int cases = 400;
  for (int i = 0; i < cases; ++i)
  {
    const Blocked blocked = makeBlocked(random, 3 + i % 4, 0.05);
    EmbreeTracer tracer;
    proved += isProved(blocked, tracer) ? 1 : 0;
  }
  EXPECT_EQ(proved, cases);
}

TEST(UmbraProof, ProvesNoLitReceiverDark)
{
  Random random(2);
  int proved = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i)
  {
    // Some blockers miss rays, some touch them to within rounding, some surround them.
    const double size = std::pow(10.0, uniform(random, -9.0, -1.0));
    const Blocked blocked = makeBlocked(random, 3 + i % 4, random() % 4 ? size : -size);
    EmbreeTracer tracer;
    if (!isProved(blocked, tracer))
    {
      ++refused;
      continue;
    }
    ++proved;
    ShadowLight light = blocked.light;
    const ReceiverPixels receivers = cornersOf(blocked.box, light, blocked.occluders.frame.centre);
    std::vector<float> visibility;
    light.lightSamples = 64;
    light.area ? tracer.traceArea(light, blocked.occluders, Receivers(receivers), visibility)
               : tracer.trace(light, blocked.occluders, Receivers(receivers), visibility);
    EXPECT_EQ(visibility, std::vector<float>(8, 0.0f)) << i;
  }
  EXPECT_GT(proved, 500);
  EXPECT_GT(refused, 500);
}

TEST(UmbraProof, LeavesOutBlockersBehindTheReceiversOrTheLight)
{
  const Bounds box{ glm::dvec3(-0.1), glm::dvec3(0.1) };
  const auto isHidden = [&](double height, const ShadowLight& light)
  {
    Blocked blocked{ light, makeOccluders({ { makePlane(20.0), at({ 0.0, 0.0, height }) } }), box };
    blocked.occluders.frame.centre = glm::dvec3(0.0);
    moveSurface(blocked.occluders, 0, { 0.0, 0.0, height });
    EmbreeTracer tracer;
    return isProved(blocked, tracer);
  };
  const ShadowLight lamp = pointLight({ 0.0, 0.0, 4.0 });
  const ShadowLight sun = directionalLight({ 0.0, 0.0, -1.0 });
  const ShadowLight boxed = boxLight({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, 4.0 }, glm::dvec3(9.0));
  for (const ShadowLight& light : { lamp, sun, boxed })
  {
    EXPECT_TRUE(isHidden(2.0, light));
    EXPECT_FALSE(isHidden(-2.0, light));
    EXPECT_FALSE(isHidden(0.1, light)) << "in the box's side";
    EXPECT_EQ(isHidden(5.0, light), light.kind == LightKind::Directional && !light.box);
    EXPECT_EQ(isHidden(4.0, light), light.kind == LightKind::Directional && !light.box);
  }
}

Bounds boxAround(const glm::dvec3& middle, const glm::dvec3& half)
{
  return { middle - half, middle + half };
}

const glm::dvec3 centreWorld(10.0, 20.0, 30.0);

/// A light at a centred place, or from its direction.
ShadowLight lightFrom(LightKind kind, const glm::dvec3& place)
{
  return kind == LightKind::Directional ? directionalLight(-place)
    : kind == LightKind::Point          ? pointLight(place + centreWorld)
                                        : spotLight(place + centreWorld, centreWorld, 30.0);
}

TEST(SweptBox, meetsWhatIsOnTheWayToTheLight)
{
  const Bounds start = boxAround({ 0.0, 0.0, 0.0 }, glm::dvec3(0.5));
  for (const LightKind kind : { LightKind::Directional, LightKind::Point, LightKind::Spot })
  {
    const SweptBox swept(start, lightFrom(kind, { 0.0, 0.0, 10.0 }), centreWorld);
    EXPECT_TRUE(swept.meets(boxAround({ 0.0, 0.0, 5.0 }, glm::dvec3(0.1))));
    EXPECT_TRUE(swept.meets(start));
    EXPECT_FALSE(swept.meets(boxAround({ 0.7, 0.0, 5.0 }, glm::dvec3(0.1)))) << "beside";
    EXPECT_FALSE(swept.meets(boxAround({ 0.0, 0.0, -1.0 }, glm::dvec3(0.4)))) << "behind";
    EXPECT_EQ(
      swept.meets(boxAround({ 0.0, 0.0, 12.0 }, glm::dvec3(0.4))), kind == LightKind::Directional)
      << "beyond the light";
    // Rays towards a point converge; rays along a direction do not.
    EXPECT_EQ(
      swept.meets(boxAround({ 0.4, 0.0, 8.0 }, glm::dvec3(0.1))), kind == LightKind::Directional);
  }
}

TEST(SweptBox, holdsAllRays)
{
  Random random(3);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const LightKind kind = i % 2 == 0 ? LightKind::Directional : LightKind::Point;
    const Bounds start = boxAround(inCube(random), 0.3 * glm::abs(inCube(random)));
    const glm::dvec3 place = 4.0 * inCube(random);
    ShadowLight light = lightFrom(kind, place);
    if (i % 3 == 0)
    {
      light.area = diskArea({ 0.0, 0.0, 1.0 }, 0.5);
    }
    const Bounds other = boxAround(0.5 * place + inCube(random), 0.5 * glm::abs(inCube(random)));
    const SweptBox swept(start, light, centreWorld);
    bool isHit = false;
    for (int ray = 0; ray < 50; ++ray)
    {
      const glm::dvec3 from = start.centre() + inCube(random) * (start.upper - start.centre());
      const glm::dvec3 onLight =
        light.area ? light.area->worldFromUnit * (0.7 * inCube(random)) : glm::dvec3(0.0);
      const bool isSun = kind == LightKind::Directional;
      const glm::dvec3 direction = isSun ? glm::normalize(place) + onLight : place + onLight - from;
      for (int step = 0; step <= 40; ++step)
      {
        const glm::dvec3 at = from + (isSun ? 0.2 : 1.0 / 40.0) * step * direction;
        isHit = isHit ||
          glm::all(glm::lessThanEqual(glm::abs(at - other.centre()), other.upper - other.centre()));
      }
    }
    met += isHit ? 1 : 0;
    EXPECT_TRUE(!isHit || swept.meets(other)) << i;
  }
  EXPECT_GT(met, 100);
}

} // namespace
} // namespace gnomon::test
