// Casters on surfaces whose normals are averaged keep their shadows. Without the casters, smooth
// terminators may light facets; what the casters take away does not depend on them.

#include "PassScene.h"

#include <vtkAppendPolyData.h>
#include <vtkCleanPolyData.h>
#include <vtkCylinderSource.h>
#include <vtkLineSource.h>
#include <vtkPolyDataNormals.h>
#include <vtkStaticCellLocator.h>
#include <vtkTriangleFilter.h>
#include <vtkTubeFilter.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;

Mesh ball(const glm::dvec3& centre, double radius)
{
  return outputOf(ballOf(centre, radius, 60, 40));
}

Mesh cube(const glm::dvec3& lower, const glm::dvec3& upper)
{
  return outputOf(boxOf(lower, upper));
}

/// A cylinder along z.
Mesh stick(const glm::dvec3& centre, double radius, double halfHeight)
{
  vtkNew<vtkCylinderSource> along; // y
  along->SetRadius(radius);
  along->SetHeight(2.0 * halfHeight);
  along->SetResolution(60);
  const Mesh mesh = outputOf(along);
  movePoints(mesh, [&](const glm::dvec3& at) { return centre + glm::dvec3(at.x, -at.z, at.y); });
  return mesh;
}

/// A receiver, and its casters.
struct CasterScene
{
  Mesh ground;
  std::vector<Mesh> casters;
  bool isAppended; ///< the casters are in the ground's polydata
  glm::dvec3 eye, target;
  glm::dvec3 towardsSun;
};

/// Return a square sheet with posts `step` apart.
template <typename Height>
Mesh sheet(double half, double step, const Height& height)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(
    squareOf(half, 0.0, static_cast<int>(std::lround(2.0 * half / step)))->GetOutputPort());
  const Mesh mesh = outputOf(triangles);
  movePoints(
    mesh, [&](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, height(at.x, at.y)); });
  return mesh;
}

/// Return the height of a sheet's triangles at a place.
double heightOf(vtkPolyData* mesh, double x, double y)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  const glm::dvec3 above(x, y, 10.0), below(x, y, -10.0);
  double along = 0.0;
  glm::dvec3 at(0.0), inCell(0.0);
  int part = 0;
  locator->IntersectWithLine(&above.x, &below.x, 0.0, along, &at.x, &inCell.x, part);
  return at.z;
}

CasterScene slab()
{
  return { cube({ -4.0, -4.0, -0.5 }, { 4.0, 4.0, 0.0 }),
    { ball({ 0.0, 0.0, 0.4 }, 0.4), cube({ -1.7, 0.2, 0.0 }, { -1.3, 0.8, 0.3 }),
      stick({ 1.3, 0.3, 0.5 }, 0.06, 0.5) },
    false, { 0.0, -6.0, 5.0 }, { 0.0, 0.0, 0.0 }, { 1.0, -0.6, 0.9 } };
}

/// Stones of 1 to 5 cm between posts of 2 m on a hill.
CasterScene terrain()
{
  CasterScene scene{ sheet(10.0, 2.0,
                       [](double x, double y)
                       { return 1.2 * std::cos(0.25 * (x - 1.0)) * std::cos(0.25 * (y - 1.0)); }),
    {}, true, { 0.4, -0.4, 2.4 }, { 1.0, 1.0, 1.2 }, { 1.0, -0.5, 0.8 } };
  const double sizes[] = { 0.01, 0.02, 0.03, 0.04, 0.05 };
  for (int i = 0; i < 25; ++i)
  {
    const double half = 0.5 * sizes[i % 5];
    const double x = 0.5 + 0.21 * (i / 5), y = 0.55 + 0.21 * (i % 5);
    const glm::dvec3 at(x, y, heightOf(scene.ground, x, y) + half);
    const Mesh stones[] = { ball(at, half), cube(at - half, at + half), stick(at, half, half) };
    scene.casters.push_back(stones[i % 3]);
  }
  return scene;
}

CasterScene spheresOnSpheres()
{
  CasterScene scene{ outputOf(ballOf(glm::dvec3(0.0), 1.0, 12, 12)), {}, true, { 0.9, -2.2, 1.6 },
    { 0.0, 0.0, 0.2 }, { 1.0, 0.2, 0.8 } };
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 0.35 + 0.2 * (i % 4), azimuth = -2.2 + 0.9 * (i / 4);
    const glm::dvec3 up(
      std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle));
    scene.casters.push_back(ball(1.0 * up, 0.06));
  }
  return scene;
}

struct NamedScene
{
  const char* name;
  CasterScene (*make)();
};

/// True: the normals are averaged; false: each facet has its own.
using Averaged = bool;
using Cell = std::tuple<NamedScene, Averaged, const char*>;

Mesh withNormals(const Mesh& mesh, bool averaged)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clean->GetOutputPort());
  normals->SetSplitting(!averaged);
  normals->SetFeatureAngle(0.0);
  return outputOf(normals);
}

void addTo(PassScene& view, const CasterScene& scene, bool averaged)
{
  vtkNew<vtkAppendPolyData> ground;
  ground->AddInputData(withNormals(scene.ground, averaged));
  view.add(ground); // the first prop
  for (const Mesh& caster : scene.casters)
  {
    scene.isAppended ? ground->AddInputData(withNormals(caster, false))
                     : void(view.add(caster.Get()));
  }
  view.lookFrom(scene.eye, scene.target);
  view.addSun(-scene.towardsSun);
  view.pass->SmoothTerminatorsOn();
  view.pass->KeepVisibilityOn();
}

using SmoothCastersTest = PassTestOf<Cell>;

const auto scenes = testing::Values(NamedScene{ "slab", slab }, NamedScene{ "terrain", terrain },
  NamedScene{ "spheresOnSpheres", spheresOnSpheres });

std::string nameOfCell(const testing::TestParamInfo<Cell>& tested)
{
  return std::get<0>(tested.param).name +
    std::string(std::get<1>(tested.param) ? "Averaged_" : "Faceted_") + std::get<2>(tested.param);
}

} // namespace

TEST_P(SmoothCastersTest, castersKeepTheirShadows)
{
  const auto& [named, averaged, technique] = GetParam();
  const CasterScene scene = named.make();
  CasterScene bare = scene;
  bare.casters.clear();
  const auto draw = [averaged = averaged](const CasterScene& of, bool smooth, const char* by)
  {
    PassScene view(400, 300);
    addTo(view, of, averaged);
    view.pass->SetSmoothTerminators(smooth);
    view.pass->SetTechnique(by);
    return drawKept(view);
  };
  const VisibilityImages flat = draw(scene, false, "raytraced");
  const VisibilityImages without = draw(bare, false, "raytraced");
  const VisibilityImages seen = draw(scene, true, technique);
  int counted[2] = { 0, 0 }; // dark and lit pixels of the ground that faces the sun
  int wrong = 0;
  for (std::size_t i = 0; i < flat.prop.size(); ++i)
  {
    if (flat.prop[i] == 0 && flat.cell[i] == without.cell[i] && without.visibility[0][i] == 1.0f)
    {
      ++counted[flat.visibility[0][i] == 1.0f];
      wrong += seen.visibility[0][i] != flat.visibility[0][i] ? 1 : 0;
    }
  }
  EXPECT_GT(counted[0], 100);
  EXPECT_GT(counted[1], 1000);
  // Outside of its contours, `selective` misses casters that are smaller than texels.
  EXPECT_LE(wrong, technique == std::string("selective") ? counted[0] : 0);
}

INSTANTIATE_TEST_SUITE_P(Table, SmoothCastersTest,
  testing::Combine(scenes, testing::Bool(),
    testing::Values("auto", "raytraced", "silhouette", "crsm", "selective", "penumbra")),
  nameOfCell);

namespace
{

/// A rod with caps, whose sides turn the sun's light into a smooth terminator.
Mesh rod()
{
  vtkNew<vtkLineSource> axis;
  axis->SetPoint1(-1.5, 0.0, 1.2);
  axis->SetPoint2(1.5, 0.0, 1.2);
  axis->SetResolution(6);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputConnection(axis->GetOutputPort());
  tube->SetRadius(0.7);
  tube->SetNumberOfSides(24);
  tube->CappingOn();
  return outputOf(tube);
}

using TurnedFacesTest = PassTestOf<Averaged>;

} // namespace

/// Facets whose averaged normals face the sun, but imply no curve, are dark.
TEST_P(TurnedFacesTest, areDarkOnMapsInShaders)
{
  PassScene view(400, 300);
  view.add(withNormals(rod(), GetParam()));
  view.addFloor(4.0);
  view.lookFrom({ 7.0, -4.0, 3.5 }, { 0.0, 0.0, 0.6 });
  view.addSun({ 0.25, -0.1, -1.0 });
  view.pass->SmoothTerminatorsOn();
  view.pass->SetTechnique("raytraced");
  const Picture truth = view.render();
  int techniques = 0;
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    view.pass->SetTechnique(technique.name.c_str());
    const Picture picture = view.render();
    if (std::string(view.pass->GetReport().route) != "inline")
    {
      continue;
    }
    const std::size_t lit = countPixels(
      truth, [&](int x, int y) { return truth.red(x, y) == 0 && picture.red(x, y) > 20; });
    EXPECT_LT(lit, 200u) << technique.name; // at the edges of shadows
    ++techniques;
  }
  EXPECT_GE(techniques, 9);
}

INSTANTIATE_TEST_SUITE_P(Normals, TurnedFacesTest, testing::Bool());
