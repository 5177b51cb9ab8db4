#include "Errors.h"
#include "ModelFile.h"
#include "Noise.h"
#include "SceneFraming.h"
#include "SceneParts.h"
#include "Vec3.h"

#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace gnomon::tool
{

void addModelOnPlane(Scene& scene, const std::string& file, const Vec3& color)
{
  const char* folder = std::getenv("GNOMON_MODELS");
  const std::filesystem::path path =
    std::filesystem::path(folder && *folder ? folder : "/usr/share/glmark2/models") / file;
  std::error_code error;
  if (!std::filesystem::exists(path, error))
  {
    throw BadInput(path.string() +
      ": no such file; it comes with the Debian package glmark2-data, or the environment variable "
      "GNOMON_MODELS names its folder");
  }
  for (const SceneModel& part : readModelFile(path.string()).surfaces)
  {
    scene.models.push_back(makeModel(part.name, part.surface, color));
  }
  const std::array<double, 6> bounds = boundsWorld(scene);
  const double extent = std::max(bounds[1] - bounds[0], bounds[5] - bounds[4]);
  const double height = bounds[3] - bounds[2];
  // The plane lies at the model's lowest point.
  const Vec3 foot{ 0.5 * (bounds[0] + bounds[1]), bounds[2], 0.5 * (bounds[4] + bounds[5]) };
  scene.models.push_back(makePlane(foot, 4.0 * extent));

  // The view from the front shows the whole model and its whole shadow, which falls to the left and
  // back.
  const Vec3 target = foot + (0.5 * height) * up;
  scene.camera =
    makeCamera(target + std::max(extent, height) * Vec3{ -1.2, 1.6, 2.4 }, target, 40.0);
  scene.lights = { makeSun({ -1.0, -1.6, -1.0 }) };
}

// The building: rooms in rows of pairs. Doors join the rooms of a pair and consecutive rows, so a
// few rooms are visible from each. Lengths are metres.

void addRooms(Scene& scene)
{
  MeshBuilder mesh;
  mesh.addBox({ 0.0, -0.2, 0.0 }, { 40.0, 0.0, 40.0 });
  mesh.addBox({ 0.0, 2.8, 0.0 }, { 40.0, 3.0, 40.0 });
  /// Add a part of a wall along x or z, from a height up to the ceiling.
  const auto addPart = [&](const Vec3& start, bool alongX, double from, double to, double low)
  {
    mesh.addBox(start + (alongX ? Vec3{ from, low, -0.1 } : Vec3{ -0.1, low, from }),
      start + (alongX ? Vec3{ to, 2.8, 0.1 } : Vec3{ 0.1, 2.8, to }));
  };
  for (int i = 0; i < 9 * 8; ++i)
  {
    const int wall = i / 8;
    const double room = 5.0 * (i % 8);
    for (const bool alongX : { true, false })
    {
      const Vec3 start = alongX ? Vec3{ room, 0.0, 5.0 * wall } : Vec3{ 5.0 * wall, 0.0, room };
      if (!alongX && wall % 2 == 0)
      {
        addPart(start, alongX, 0.0, 5.0, 0.0);
        continue;
      }
      const double door = alongX && wall % 2 ? 0.7 : 3.4;
      addPart(start, alongX, 0.0, door, 0.0);
      addPart(start, alongX, door, door + 0.9, 2.0);
      addPart(start, alongX, door + 0.9, 5.0, 0.0);
    }
  }
  add(scene, "rooms", mesh, { 0.8, 0.78, 0.72 });
}

void addBuildingLamps(Scene& scene)
{
  for (int i = 0; i < 64; ++i)
  {
    SceneLight lamp;
    lamp.type = SceneLight::Type::Point;
    lamp.position = { (i % 8 + 0.5) * 5.0, 2.5, (i / 8 + 0.5) * 5.0 };
    lamp.target = lamp.position - up;
    lamp.intensity = 0.5;
    scene.lights.push_back(lamp);
  }
}

// The office

/// Some books lean out of line.
void addBooks(Scene& scene)
{
  MeshBuilder red, blue;
  Random random(7);
  for (int shelf = 0; shelf < 5; ++shelf)
  {
    const Vec3 board{ -0.8, 0.05 + 0.38 * shelf + 0.025, -1.87 };
    for (double x = 0.05; x < 2.85;)
    {
      const double width = random.between(0.02, 0.06);
      const double height = random.between(0.2, 0.32);
      if (random.between(0.0, 1.0) < 0.85)
      {
        MeshBuilder& books = random.between(0.0, 1.0) < 0.5 ? red : blue;
        books.addBox(board + Vec3{ x, 0.0, 0.02 },
          board + Vec3{ x + width, height, random.between(0.2, 0.27) });
      }
      x += width + 0.004;
    }
  }
  add(scene, "red books", red, { 0.6, 0.25, 0.22 });
  add(scene, "blue books", blue, { 0.26, 0.38, 0.52 });
}

void addDeskThings(Scene& scene)
{
  const Vec3 top{ 0.5, 0.75, -1.0 }; // of the desk
  MeshBuilder pencils, paper;
  for (int i = 0; i < 5; ++i)
  {
    const Vec3 lean{ 0.2 * std::cos(1.3 * i), 1.0, 0.2 * std::sin(1.3 * i) };
    pencils.addLathe({ top + Vec3{ 0.1, 0.006, 0.12 }, normalized(lean) },
      { { 0.004, 0.0 }, { 0.004, 0.16 }, { 0.0, 0.18 } }, 6);
  }
  for (int i = 0; i < 12; ++i)
  {
    // Single sheets, a millimetre apart, the upper ones curled.
    const double angle = 0.2 + 0.04 * ((i * 5) % 12);
    const Vec3 middle = top + Vec3{ -0.38, 0.001 * (i + 1), 0.2 };
    const Vec3 right{ std::cos(angle), 0.0, -std::sin(angle) };
    const Vec3 back{ std::sin(angle), 0.0, std::cos(angle) };
    paper.addSheet(6, 6,
      [&](double u, double v)
      {
        const double curl = 0.002 * i * (2.0 * u - 1.0) * (2.0 * u - 1.0) * v;
        return middle + (0.21 * (u - 0.5)) * right - (0.297 * (v - 0.5)) * back + curl * up;
      });
  }
  add(scene, "pencils", pencils, { 0.85, 0.65, 0.2 });
  add(scene, "paper", paper, { 0.92, 0.92, 0.9 });
}

// The terrain: a square kilometre

namespace
{

constexpr double sideMetres = 1000.0;

/// Return the ground's point: hills of at most 250 m. Each octave is half as wide and 0.4 times as
/// high.
Vec3 onGround(double x, double z)
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
  return { x, height, z };
}

/// Return a place on the terrain for object i of a kind.
Vec3 scattered(int i, std::uint32_t kind)
{
  constexpr double range = 0.96 * sideMetres;
  return onGround((hashed(i, 0, kind) - 0.5) * range, (hashed(i, 1, kind) - 0.5) * range);
}

} // namespace

void addTerrain(Scene& scene)
{
  constexpr int cells = 256;
  constexpr std::uint32_t tree = 100;
  constexpr std::uint32_t rock = 200;
  MeshBuilder ground, trees, rocks, posts;
  ground.addPatch(cells, cells,
    [](double u, double v)
    {
      // v runs towards -z, so the front faces up.
      const double x = (u - 0.5) * sideMetres;
      const double z = (0.5 - v) * sideMetres;
      constexpr double step = 0.5 * sideMetres / cells;
      const double slopeX = (onGround(x + step, z)[1] - onGround(x - step, z)[1]) / (2.0 * step);
      const double slopeZ = (onGround(x, z + step)[1] - onGround(x, z - step)[1]) / (2.0 * step);
      return SurfacePoint{ onGround(x, z), normalized({ -slopeX, 1.0, -slopeZ }) };
    });
  for (int i = 0; i < 400; ++i)
  {
    const Vec3 foot = scattered(i, tree);
    const double height = 6.0 + 8.0 * hashed(i, 2, tree);
    // The trunk starts below the ground, as slopes fall away.
    trees.addCone(foot - 0.5 * up, 0.3 * height + 0.5, 0.02 * height, 0.02 * height, 8);
    trees.addCone(foot + (0.25 * height) * up, 0.45 * height, 0.22 * height, 0.0, 10);
    trees.addCone(foot + (0.55 * height) * up, 0.45 * height, 0.16 * height, 0.0, 10);
  }
  for (int i = 0; i < 200; ++i)
  {
    rocks.addSphere(scattered(i, rock), 0.4 + 1.6 * hashed(i, 2, rock), 10, 6);
  }
  // Posts of 12 cm width along a path from the camera into the distance.
  const Vec3 ahead = normalized({ 0.15, 0.0, -1.0 });
  for (int i = 0; i < 40; ++i)
  {
    const Vec3 place = Vec3{ 220.0, 0.0, 440.0 } + (6.0 + 5.0 * i) * ahead;
    const Vec3 foot = onGround(place[0] - 3.0, place[2]);
    posts.addBox(foot - Vec3{ 0.06, 0.5, 0.06 }, foot + Vec3{ 0.06, 1.5, 0.06 });
  }
  add(scene, "ground", ground, { 0.6, 0.62, 0.4 });
  add(scene, "trees", trees, { 0.35, 0.5, 0.3 });
  add(scene, "rocks", rocks, { 0.55, 0.53, 0.5 });
  add(scene, "posts", posts, { 0.7, 0.5, 0.35 });
}

// Textures

namespace
{

/// Add a sheet of columns x rows cells that repeats a texture `across` and `upward` times. The
/// texture is white, with alpha 0 in its holes.
void addScreen(Scene& scene, const std::string& name, int columns, int rows,
  const std::function<Vec3(double u, double v)>& place, double across, double upward, int texels,
  const std::function<bool(double u, double v)>& isHole)
{
  MeshBuilder mesh;
  mesh.addSheet(columns, rows, place);
  add(scene, name, mesh, { 0.62, 0.5, 0.36 });
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TextureCoordinates");
  coordinates->SetNumberOfComponents(2);
  for (int i = 0; i < (rows + 1) * (columns + 1); ++i)
  {
    coordinates->InsertNextTuple2(
      across * (i % (columns + 1)) / columns, upward * (i / (columns + 1)) / rows);
  }
  scene.models.back().surface->GetPointData()->SetTCoords(coordinates);

  vtkNew<vtkImageData> image;
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* texel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int i = 0; i < texels * texels; ++i)
  {
    texel = std::fill_n(texel, 3, static_cast<unsigned char>(255));
    *texel++ = isHole((i % texels + 0.5) / texels, (i / texels + 0.5) / texels) ? 0 : 255;
  }
  scene.models.back().texture = vtkSmartPointer<vtkTexture>::New();
  scene.models.back().texture->SetInputData(image);
}

} // namespace

void addScreens(Scene& scene)
{
  addScreen(
    scene, "lattice", 1, 1,
    [](double u, double v) {
      return Vec3{ -3.2 + 3.4 * u, 2.4 * v, 0.9 - 0.5 * v };
    },
    8.0, 6.0, 16,
    [](double u, double v) { return std::abs(u - 0.5) < 0.36 && std::abs(v - 0.5) < 0.36; });
  addScreen(
    scene, "bent sheet", 24, 4,
    [](double u, double v)
    {
      const double angle = vtkMath::Pi() * (1.15 - 1.1 * u);
      return Vec3{ 1.7 + 1.2 * std::cos(angle), 0.15 + 2.3 * v, -0.6 + 1.2 * std::sin(angle) };
    },
    12.0, 7.0, 64, [](double u, double v) { return std::hypot(u - 0.5, v - 0.5) < 0.37; });
}

vtkSmartPointer<vtkImageData> makePanes()
{
  constexpr int texels = 40; // of a side
  using Colour = std::array<unsigned char, 3>;
  constexpr Colour dark = { 10, 10, 10 };
  constexpr std::array<Colour, 4> panes = { { // the lower row first
    { 40, 200, 60 }, { 50, 80, 255 }, { 255, 50, 40 }, { 255, 220, 70 } } };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  const auto isBar = [](int place) { return (place + 2) % (texels / 2) < 4; };
  for (int i = 0; i < texels * texels; ++i)
  {
    const int x = i % texels;
    const int y = i / texels;
    const int pane = 2 * (2 * y / texels) + 2 * x / texels;
    const Colour& colour = isBar(x) || isBar(y) ? dark : panes[static_cast<std::size_t>(pane)];
    to = std::copy(colour.begin(), colour.end(), to);
  }
  return image;
}

// Hard cases

void addThinPosts(Scene& scene)
{
  for (int i = 0; i < 24; ++i)
  {
    const double x = -3.0 + 0.25 * i;
    const double half = 0.001 * (1 + i);
    MeshBuilder mesh;
    mesh.addBox({ x - half, 0.0, -half }, { x + half, 1.5, half });
    add(scene, "box", mesh);
  }
}

void addSlivers(Scene& scene)
{
  std::vector<Vec3> corners;
  for (int i = 0; i < 20; ++i)
  {
    const double z = -3.0 + 0.3 * i;
    corners.insert(
      corners.end(), { { -3.0, 1.0, z }, { 3.0, 1.001, z + 0.06 }, { 3.0, 1.0, z + 1e-5 * i } });
  }
  scene.models.push_back(makeTriangles("slivers", corners));
}

} // namespace gnomon::tool
