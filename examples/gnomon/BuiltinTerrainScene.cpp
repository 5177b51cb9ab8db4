#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include "Vec3.h"

#include <cstdint>

namespace gnomon::tool
{

namespace
{

constexpr double sideMetres = 1000.0;
constexpr int cells = 256;

/// Return the ground's height: hills of at most 250 m. Each octave is half as wide and 0.4 times as
/// high.
double groundHeight(double x, double z)
{
  double height = 0.0;
  double amplitude = 55.0;
  double frequency = 1.0 / 250.0;
  for (std::uint32_t octave = 0; octave < 5; ++octave)
  {
    height += amplitude * (noise(x * frequency, z * frequency, octave) - 0.5);
    amplitude *= 0.4;
    frequency *= 2.0;
  }
  return height;
}

Vec3 onGround(double x, double z)
{
  return { { x, groundHeight(x, z), z } };
}

SceneModel makeGround()
{
  MeshBuilder mesh;
  mesh.addPatch(cells, cells,
    [](double u, double v)
    {
      // v runs towards -z, so the front faces up.
      const double x = (u - 0.5) * sideMetres;
      const double z = (0.5 - v) * sideMetres;
      const double step = 0.5 * sideMetres / cells;
      const double slopeX = (groundHeight(x + step, z) - groundHeight(x - step, z)) / (2.0 * step);
      const double slopeZ = (groundHeight(x, z + step) - groundHeight(x, z - step)) / (2.0 * step);
      return SurfacePoint{ onGround(x, z), normalized({ { -slopeX, 1.0, -slopeZ } }) };
    });
  return makeModel("ground", mesh.build(), { { 0.6, 0.62, 0.4 } });
}

/// Return a place on the terrain for object i of a kind.
Vec3 scattered(int i, std::uint32_t kind)
{
  const double range = 0.96 * sideMetres;
  return onGround((hashed(i, 0, kind) - 0.5) * range, (hashed(i, 1, kind) - 0.5) * range);
}

SceneModel makeTrees()
{
  constexpr std::uint32_t kind = 100;
  MeshBuilder mesh;
  for (int i = 0; i < 400; ++i)
  {
    const Vec3 foot = scattered(i, kind);
    const double height = 6.0 + 8.0 * hashed(i, 2, kind);
    // The trunk starts below the ground, as slopes fall away.
    mesh.addCone(foot - 0.5 * up, 0.3 * height + 0.5, 0.02 * height, 0.02 * height, 8);
    mesh.addCone(foot + (0.25 * height) * up, 0.45 * height, 0.22 * height, 0.0, 10);
    mesh.addCone(foot + (0.55 * height) * up, 0.45 * height, 0.16 * height, 0.0, 10);
  }
  return makeModel("trees", mesh.build(), { { 0.35, 0.5, 0.3 } });
}

SceneModel makeRocks()
{
  constexpr std::uint32_t kind = 200;
  MeshBuilder mesh;
  for (int i = 0; i < 200; ++i)
  {
    mesh.addSphere(scattered(i, kind), 0.4 + 1.6 * hashed(i, 2, kind), 10, 6);
  }
  return makeModel("rocks", mesh.build(), { { 0.55, 0.53, 0.5 } });
}

/// Return posts of 12 cm width along a path from the camera into the distance.
SceneModel makePosts(const Vec3& start, const Vec3& direction)
{
  MeshBuilder mesh;
  for (int i = 0; i < 40; ++i)
  {
    const Vec3 place = start + (6.0 + 5.0 * i) * direction;
    const Vec3 foot = onGround(place[0] - 3.0, place[2]);
    mesh.addBox(foot - Vec3{ { 0.06, 0.5, 0.06 } }, foot + Vec3{ { 0.06, 1.5, 0.06 } });
  }
  return makeModel("posts", mesh.build(), { { 0.7, 0.5, 0.35 } });
}

} // namespace

//------------------------------------------------------------------------------
Scene makeTerrainScene()
{
  Scene scene;
  const Vec3 ahead = normalized({ { 0.15, 0.0, -1.0 } });
  const Vec3 eye = onGround(220.0, 440.0) + Vec3{ { 0.0, 2.0, 0.0 } };
  scene.models = { makeGround(), makeTrees(), makeRocks(), makePosts(eye, ahead) };
  scene.camera = makeCamera(eye, eye + 100.0 * (ahead + Vec3{ { 0.0, -0.05, 0.0 } }), 50.0);
  scene.lights = { makeSun({ { 0.9, -0.36, -0.1 } }, { { 1.0, 0.95, 0.85 } }, 1.8) };
  scene.background = { { 0.75, 0.85, 0.95 } };
  return scene;
}

} // namespace gnomon::tool
