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
  void move(std::size_t surface, const glm::dvec3& by)
  {
    moveSurface(this->occluders_, surface, by);
    this->tracer_.update(this->occluders_);
  }
  const ReceiverPixels& receivers() const { return this->receivers_; }
  Occluders& occluders() { return this->occluders_; }

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

/// Give a light an area of some shape, or none.
void addArea(ShadowLight& light, Random& random)
{
  const glm::dvec3 travel =
    light.kind == LightKind::Point ? glm::dvec3(0.0, 0.0, -1.0) : light.directionWorld;
  const double size = light.kind == LightKind::Directional ? 0.05 : uniform(random, 0.05, 0.4);
  switch (random() % 5)
  {
    case 0:
      light.area = diskArea(travel, size);
      break;
    case 1:
      light.area = rectangleArea(travel, { 0.3, 0.5, 0.7 }, { size, 0.5 * size });
      break;
    case 2:
      light.area = ballArea(size);
      break;
    default:
      return;
  }
  light.lightSamples = 4;
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

ShadowLight anyLight(Random& random)
{
  ShadowLight light = makeRandomLight(random);
  if (random() % 4 == 0)
  {
    light = pointLight(uniform(random, 1.0, 5.0) * unitVector(random));
  }
  addArea(light, random);
  return light;
}

Camera cameraAround(Random& random)
{
  Camera camera;
  camera.width = 150;
  camera.height = 110;
  camera.position = 4.0 * unitVector(random) + glm::dvec3(0.0, 0.0, 1.0);
  camera.target = { 0.0, 0.0, uniform(random, 0.0, 0.8) };
  camera.fovDegrees = uniform(random, 10.0, 60.0);
  return camera;
}

} // namespace

//------------------------------------------------------------------------------
TEST(TileVerdicts, AreWhatTracingFinds)
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

namespace
{

/// Return a floor that does not cast, and over its half with x > 0 a wall between it and the lamp.
std::vector<Prop> makeWallAndFloor()
{
  Prop floor{ makePlane(8.0) };
  floor.casts = false;
  return { floor, { makePlane(60.0), at({ 0.0, 0.0, 1.0 }) } };
}

Camera cameraOverFloor()
{
  Camera camera;
  camera.position = { 1.0, 0.0, 0.8 };
  camera.target = { 0.0, 0.2, 0.0 };
  camera.fovDegrees = 50.0;
  return camera;
}

const ShadowLight lampOverWall = pointLight({ 0.0, 0.0, 9.0 });

} // namespace

//------------------------------------------------------------------------------
TEST(TileVerdicts, SayWhyALightTakesNoRays)
{
  Judged scene(makeWallAndFloor(), cameraOverFloor());
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

//------------------------------------------------------------------------------
TEST(TileVerdicts, AreNewWhereACasterMoved)
{
  Judged scene(makeWallAndFloor(), cameraOverFloor());
  const auto areSame = [&]
  {
    const TileVerdicts verdicts = scene.judge(lampOverWall);
    return scene.trace(lampOverWall, &verdicts).visibility ==
      scene.trace(lampOverWall, nullptr).visibility;
  };
  EXPECT_TRUE(scene.judge(lampOverWall).areAllDark());
  scene.move(1, { 30.0, 0.0, 0.0 });
  EXPECT_FALSE(scene.judge(lampOverWall).areAllDark());
  EXPECT_TRUE(areSame());
  scene.move(1, { 0.0, 0.0, 20.0 });
  EXPECT_EQ(scene.report(lampOverWall).tilesDark, 0);
  EXPECT_TRUE(areSame());
}

//------------------------------------------------------------------------------
/// Only a sure blocker hides a light.
TEST(TileVerdicts, DoNotTrustWallsWithHolesOrOneSide)
{
  const auto isDark = [](const Prop& wall)
  {
    std::vector<Prop> props = makeWallAndFloor();
    props[1] = wall;
    return Judged(props, cameraOverFloor()).judge(lampOverWall).areAllDark();
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
  const View view = makeView(occluders, cameraOverFloor());
  makeInstanced(occluders, 1, { glm::dmat4(1.0) });
  EXPECT_FALSE(Judged(occluders, view).judge(lampOverWall).areAllDark());
}

namespace
{

constexpr int roomsAcross = 8;
constexpr double sideOfRoom = 5.0;
constexpr double heightOfRoom = 3.0;

void addQuad(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& up)
{
  const auto first = static_cast<unsigned int>(mesh.points.size());
  mesh.points.insert(
    mesh.points.end(), { corner, corner + along, corner + along + up, corner + up });
  mesh.triangles.insert(
    mesh.triangles.end(), { { first, first + 1, first + 2 }, { first, first + 2, first + 3 } });
}

/// Return a wall of a room with a door, which is nearer to its end.
void addWallWithDoor(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& direction)
{
  const glm::dvec3 up(0.0, 0.0, 1.0);
  constexpr double doorFrom = 3.2, doorTo = 4.2, doorHeight = 2.1;
  addQuad(mesh, corner, doorFrom * direction, heightOfRoom * up);
  addQuad(mesh, corner + doorTo * direction, (sideOfRoom - doorTo) * direction, heightOfRoom * up);
  addQuad(mesh, corner + doorFrom * direction + doorHeight * up, (doorTo - doorFrom) * direction,
    (heightOfRoom - doorHeight) * up);
}

/// Floor, ceiling and walls of 8 x 8 rooms.
Mesh makeRooms()
{
  constexpr double side = roomsAcross * sideOfRoom;
  Mesh mesh;
  addQuad(mesh, glm::dvec3(0.0), { side, 0.0, 0.0 }, { 0.0, side, 0.0 });
  addQuad(mesh, { 0.0, 0.0, heightOfRoom }, { 0.0, side, 0.0 }, { side, 0.0, 0.0 });
  for (int wall = 0; wall <= roomsAcross; ++wall)
  {
    for (int room = 0; room < roomsAcross; ++room)
    {
      addWallWithDoor(mesh, { wall * sideOfRoom, room * sideOfRoom, 0.0 }, { 0.0, 1.0, 0.0 });
      addWallWithDoor(mesh, { room * sideOfRoom, wall * sideOfRoom, 0.0 }, { 1.0, 0.0, 0.0 });
    }
  }
  return mesh;
}

} // namespace

//------------------------------------------------------------------------------
TEST(TileVerdicts, OfABuildingTraceOnlyLampsInSight)
{
  Camera camera;
  camera.position = { 15.5, 15.6, 1.6 };
  camera.target = { 18.5, 19.0, 1.2 };
  camera.fovDegrees = 60.0;
  camera.width = 640;
  camera.height = 480;
  Judged scene({ { makeRooms() } }, camera);
  int inSight = 0;
  int withoutRays = 0;
  std::size_t raysOfHidden = 0;
  for (int i = 0; i < roomsAcross * roomsAcross; ++i)
  {
    const ShadowLight lamp = pointLight(
      { (i % roomsAcross + 0.5) * sideOfRoom, (i / roomsAcross + 0.5) * sideOfRoom, 2.7 });
    const TileVerdicts verdicts = scene.judge(lamp);
    const Shown judged = scene.trace(lamp, &verdicts);
    const Shown traced = scene.trace(lamp, nullptr);
    expectSame(judged, traced, "lamp " + std::to_string(i));
    const bool isInSight = std::find(traced.visibility.begin(), traced.visibility.end(), 1.0f) !=
      traced.visibility.end();
    inSight += isInSight ? 1 : 0;
    withoutRays += judged.rays == 0 ? 1 : 0;
    raysOfHidden += isInSight ? 0 : judged.rays;
  }
  // Rays are still traced where a door's jamb or lintel is between: the lamp's own room is open
  // there.
  const int hidden = roomsAcross * roomsAcross - inSight;
  EXPECT_GT(inSight, 4);
  EXPECT_GT(withoutRays, hidden * 3 / 4);
  EXPECT_LT(raysOfHidden / static_cast<std::size_t>(hidden), scene.receivers().size() / 200);
}

} // namespace gnomon::test
