#include "BuiltinScenes.h"
#include "../TestFiles.h"
#include "Errors.h"
#include "SceneExport.h"
#include "SceneFraming.h"
#include "Vec3.h"
#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

namespace gnomon::tool
{
namespace
{

vtkIdType countTriangles(const Scene& scene)
{
  vtkIdType count = 0;
  for (const SceneModel& model : scene.models)
  {
    EXPECT_EQ(model.surface->GetPolys()->GetMaxCellSize(), 3);
    count += model.surface->GetNumberOfPolys();
  }
  return count;
}

const SceneModel& findModel(const Scene& scene, const std::string& name)
{
  for (const SceneModel& model : scene.models)
  {
    if (model.name == name)
    {
      return model;
    }
  }
  throw std::runtime_error("no model " + name);
}

Vec3 pointOf(vtkDataArray* array, vtkIdType i)
{
  Vec3 point;
  array->GetTuple(i, point.data());
  return point;
}

/// Edges of a surface, by the places of their ends, in one direction each: how often more they are
/// passed forwards than backwards. All zero for a closed surface.
vtkIdType countOpenEdges(vtkPolyData* surface)
{
  std::map<std::pair<Vec3, Vec3>, vtkIdType> passes;
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    surface->GetPolys()->GetCellAtId(i, size, ids);
    for (vtkIdType k = 0; k < size; ++k)
    {
      const Vec3 a = pointOf(surface->GetPoints()->GetData(), ids[k]);
      const Vec3 b = pointOf(surface->GetPoints()->GetData(), ids[(k + 1) % size]);
      a < b ? ++passes[{ a, b }] : --passes[{ b, a }];
    }
  }
  return std::count_if(
    passes.begin(), passes.end(), [](const auto& edge) { return edge.second != 0; });
}

/// The colours of a picture; empty without one.
std::vector<double> texelsOf(vtkImageData* image)
{
  std::vector<double> texels;
  vtkDataArray* const scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  for (vtkIdType i = 0; scalars && i < scalars->GetNumberOfValues(); ++i)
  {
    texels.push_back(scalars->GetVariantValue(i).ToDouble());
  }
  return texels;
}

/// The built-in scenes that are small enough for tests that look at all of them.
std::vector<std::string> smallScenes()
{
  std::vector<std::string> names;
  for (const BuiltinScene& line : builtinScenes())
  {
    if (line.name != "city")
    {
      names.push_back(line.name);
    }
  }
  return names;
}

class BuiltinSceneTest : public testing::TestWithParam<std::string>
{
};
INSTANTIATE_TEST_SUITE_P(BuiltinScenes, BuiltinSceneTest, testing::ValuesIn(smallScenes()),
  [](const auto& scene)
  {
    std::string name = scene.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

//------------------------------------------------------------------------------
TEST(BuiltinScenes, AreListedOnceEach)
{
  std::set<std::string> names;
  for (const BuiltinScene& line : builtinScenes())
  {
    EXPECT_TRUE(names.insert(line.name).second) << line.name;
    EXPECT_FALSE(line.summary.empty()) << line.name;
    EXPECT_LT(line.summary.size(), 80u) << line.name;
  }
  EXPECT_EQ(names.size(), 40u);
}

//------------------------------------------------------------------------------
TEST_P(BuiltinSceneTest, IsLoadedByItsName)
{
  const Scene scene = loadScene(GetParam());
  EXPECT_EQ(scene.name, GetParam());
  const std::map<std::string, std::size_t> lights = { { "office", 2 }, { "building", 64 },
    { "building-lit", 4 } };
  const auto several = lights.find(GetParam());
  EXPECT_EQ(scene.lights.size(), several == lights.end() ? 1u : several->second);
  EXPECT_GT(countTriangles(scene), 0);
}

//------------------------------------------------------------------------------
TEST_P(BuiltinSceneTest, IsFiniteAndInFrontOfItsCamera)
{
  const Scene scene = loadScene(GetParam());
  for (const SceneModel& model : scene.models)
  {
    vtkDataArray* points = model.surface->GetPoints()->GetData();
    for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
    {
      const Vec3 point = pointOf(points, i);
      ASSERT_TRUE(std::isfinite(length(point))) << model.name << " point " << i;
    }
  }
  const DepthRange depths = visibleDepths(scene, 1.0);
  EXPECT_GT(depths.nearest, 0.0);
  EXPECT_GT(depths.farthest, depths.nearest);
}

//------------------------------------------------------------------------------
TEST_P(BuiltinSceneTest, IsReadBackFromItsExport)
{
  const Scene scene = loadScene(GetParam());
  const TestFolder folder;
  if (!scene.props.empty())
  {
    EXPECT_THROW(exportScene(scene, folder.path()), BadInput);
    return;
  }
  const Scene read = loadScene(exportScene(scene, folder.path()));
  EXPECT_EQ(read.name, scene.name);
  EXPECT_EQ(read.camera.position, scene.camera.position);
  EXPECT_EQ(read.camera.target, scene.camera.target);
  EXPECT_EQ(read.camera.fovDegrees, scene.camera.fovDegrees);
  ASSERT_EQ(read.lights.size(), scene.lights.size());
  for (std::size_t i = 0; i < read.lights.size(); ++i)
  {
    EXPECT_EQ(read.lights[i].type, scene.lights[i].type);
    ASSERT_EQ(read.lights[i].area.has_value(), scene.lights[i].area.has_value());
    if (read.lights[i].area)
    {
      EXPECT_EQ(read.lights[i].area->rectangle, scene.lights[i].area->rectangle);
      EXPECT_EQ(read.lights[i].area->width, scene.lights[i].area->width);
      EXPECT_EQ(read.lights[i].area->height, scene.lights[i].area->height);
      EXPECT_EQ(read.lights[i].area->up, scene.lights[i].area->up);
      EXPECT_EQ(read.lights[i].position, scene.lights[i].position);
      EXPECT_EQ(read.lights[i].target, scene.lights[i].target);
      EXPECT_EQ(texelsOf(read.lights[i].area->texture), texelsOf(scene.lights[i].area->texture));
    }
  }
  EXPECT_EQ(read.models.size(), scene.models.size());
  EXPECT_EQ(countTriangles(read), countTriangles(scene));
  EXPECT_EQ(boundsWorld(read), boundsWorld(scene));
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, HaveTheTrianglesThatTheyPromise)
{
  EXPECT_EQ(countTriangles(loadScene("bunny")), 69668);
  EXPECT_EQ(countTriangles(loadScene("cube")), 14);
  EXPECT_EQ(countTriangles(loadScene("half-plane")), 4);
  EXPECT_EQ(countTriangles(loadScene("panels")), 12);
  EXPECT_EQ(countTriangles(loadScene("screens")), 196);
  EXPECT_EQ(countTriangles(loadScene("long-cube")), 14);
  EXPECT_NEAR(static_cast<double>(countTriangles(loadScene("cups"))), 9241.0, 500.0);
  EXPECT_NEAR(static_cast<double>(countTriangles(loadScene("atrium"))), 260000.0, 2000.0);
  for (const SceneView& view : gardenViews())
  {
    EXPECT_EQ(countTriangles(loadScene(view.name)), 55026) << view.name;
  }
  for (const SceneView& view : primitivesViews())
  {
    EXPECT_EQ(countTriangles(loadScene(view.name)), 4944) << view.name;
  }
  const Scene primitives = loadScene("primitives");
  const std::map<std::string, vtkIdType> parts = { { "plane", 2 }, { "pyramid", 6 },
    { "cylinder", 128 }, { "torus", 3072 }, { "sphere", 1736 } };
  for (const auto& [name, count] : parts)
  {
    EXPECT_EQ(findModel(primitives, name).surface->GetNumberOfPolys(), count) << name;
  }
}

//------------------------------------------------------------------------------
// Cosines between the cameras' directions and the light's, of Moderno's table 3.
TEST(BuiltinScenes, PrimitivesAreSeenAcrossWithAndAgainstTheLight)
{
  const std::map<std::string, double> cosines = { { "primitives", 0.37 },
    { "primitives-with", 0.93 }, { "primitives-against", -0.35 } };
  ASSERT_EQ(primitivesViews().size(), cosines.size());
  for (const auto& [name, cosine] : cosines)
  {
    const Scene scene = loadScene(name);
    const Vec3 forward = normalized(scene.camera.target - scene.camera.position);
    EXPECT_NEAR(
      dot(forward, normalized(scene.lights[0].target - scene.lights[0].position)), cosine, 0.005)
      << name;
  }
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, StandOnAPlaneOfFourTimesTheirSize)
{
  for (const char* name : { "bunny", "horse", "cat" })
  {
    SCOPED_TRACE(name);
    const Scene scene = loadScene(name);
    Scene model = scene;
    model.models.pop_back();
    Scene plane = scene;
    plane.models = { findModel(scene, "plane") };
    const std::array<double, 6> own = boundsWorld(model);
    const std::array<double, 6> ground = boundsWorld(plane);
    const double extent = std::max(own[1] - own[0], own[5] - own[4]);
    EXPECT_NEAR(ground[1] - ground[0], 4.0 * extent, 1e-5 * extent);
    EXPECT_NEAR(ground[3], own[2], 1e-6 * extent);
    EXPECT_TRUE(plane.models[0].casts);
  }
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, SunElevationOfTheBunnyIsBetween45And50Degrees)
{
  const SceneLight sun = loadScene("bunny").lights[0];
  const Vec3 travel = normalized(sun.target - sun.position);
  const double elevation = vtkMath::DegreesFromRadians(std::asin(-travel[1]));
  EXPECT_GT(elevation, 45.0);
  EXPECT_LT(elevation, 50.0);
}

//------------------------------------------------------------------------------
TEST_P(BuiltinSceneTest, IsTheSameEveryTime)
{
  const Scene a = loadScene(GetParam());
  const Scene b = loadScene(GetParam());
  ASSERT_EQ(a.models.size(), b.models.size());
  for (std::size_t m = 0; m < a.models.size(); ++m)
  {
    vtkDataArray* pointsA = a.models[m].surface->GetPoints()->GetData();
    vtkDataArray* pointsB = b.models[m].surface->GetPoints()->GetData();
    ASSERT_EQ(pointsA->GetDataType(), pointsB->GetDataType());
    ASSERT_EQ(pointsA->GetNumberOfTuples(), pointsB->GetNumberOfTuples());
    EXPECT_EQ(std::memcmp(pointsA->GetVoidPointer(0), pointsB->GetVoidPointer(0),
                static_cast<std::size_t>(pointsA->GetDataTypeSize()) *
                  static_cast<std::size_t>(pointsA->GetNumberOfValues())),
      0);
  }
}

//------------------------------------------------------------------------------
// The front of every triangle, counter-clockwise, is the side that its normals show, and no
// triangle is without area.
TEST(BuiltinScenes, TrianglesFaceTheWayOfTheirNormals)
{
  for (const std::string& name : smallScenes())
  {
    if (name == "bunny" || name == "horse" || name == "cat")
    {
      continue; // models of others
    }
    SCOPED_TRACE(name);
    for (const SceneModel& model : loadScene(name).models)
    {
      vtkDataArray* points = model.surface->GetPoints()->GetData();
      vtkDataArray* normals = model.surface->GetPointData()->GetNormals();
      ASSERT_TRUE(normals);
      int wrong = 0;
      for (vtkIdType i = 0; i < model.surface->GetNumberOfPolys(); ++i)
      {
        vtkIdType size = 0;
        const vtkIdType* ids = nullptr;
        model.surface->GetPolys()->GetCellAtId(i, size, ids);
        const Vec3 a = pointOf(points, ids[0]);
        const Vec3 face = cross(pointOf(points, ids[1]) - a, pointOf(points, ids[2]) - a);
        const Vec3 shading =
          pointOf(normals, ids[0]) + pointOf(normals, ids[1]) + pointOf(normals, ids[2]);
        wrong += dot(face, shading) > 0.0 ? 0 : 1;
      }
      EXPECT_EQ(wrong, 0) << model.name;
    }
  }
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, TheTerrainIsSeenFromTwoMetresAboveTheGround)
{
  const Scene scene = loadScene("terrain");
  const std::array<double, 6> bounds = boundsWorld(scene);
  EXPECT_NEAR(bounds[1] - bounds[0], 1000.0, 20.0);
  // The nearest ground vertices are less than a cell, 4 m, away.
  vtkPolyData* ground = findModel(scene, "ground").surface;
  const Vec3 eye = scene.camera.position;
  double nearest = 1e9;
  double height = 0.0;
  for (vtkIdType i = 0; i < ground->GetNumberOfPoints(); ++i)
  {
    const Vec3 point = pointOf(ground->GetPoints()->GetData(), i);
    const double distance = std::hypot(point[0] - eye[0], point[2] - eye[2]);
    if (distance < nearest)
    {
      nearest = distance;
      height = eye[1] - point[1];
    }
  }
  EXPECT_NEAR(height, 2.0, 0.7);
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, SolidsAreClosedAndSheetsAreOpen)
{
  const std::map<std::string, std::vector<std::string>> solids = {
    { "cube", { "cube" } },
    { "stack", { "cube", "sphere" } },
    { "long-cube", { "cube" } },
    { "letter", { "letter" } },
    { "pole", { "pole" } },
    { "bench-with", { "earth", "paving", "bench slats", "flower box", "soil", "lamp globe" } },
    { "atrium", { "shell", "wall relief", "light paving", "dark paving" } },
    { "office", { "building", "desks", "lamp", "red books" } },
  };
  for (const auto& [name, models] : solids)
  {
    const Scene scene = loadScene(name);
    for (const std::string& model : models)
    {
      EXPECT_EQ(countOpenEdges(findModel(scene, model).surface), 0) << name << ": " << model;
    }
  }
  const std::map<std::string, std::vector<std::string>> sheets = {
    { "half-plane", { "half plane" } },
    { "screens", { "lattice", "bent sheet" } },
    { "panels", { "top", "middle", "bottom", "panel" } },
    { "cups", { "standing cups", "hovering cups" } },
    { "flowers-with", { "leaves", "tulip", "daisy", "anemone", "grass", "lamp hood" } },
    { "atrium", { "red cloth", "green cloth", "blue cloth", "awnings", "pots", "plants" } },
    { "office", { "shade", "mug", "paper" } },
  };
  for (const auto& [name, models] : sheets)
  {
    const Scene scene = loadScene(name);
    for (const std::string& model : models)
    {
      EXPECT_GT(countOpenEdges(findModel(scene, model).surface), 3) << name << ": " << model;
    }
  }
}

//------------------------------------------------------------------------------
// No background in any picture of the garden: the rays through the corners of pictures up to 16:9
// meet the lawn. The corners see farthest.
TEST(BuiltinScenes, TheGardensLawnFillsEveryView)
{
  for (const SceneView& view : gardenViews())
  {
    SCOPED_TRACE(view.name);
    const Scene scene = loadScene(view.name);
    Scene lawn = scene;
    lawn.models = { findModel(scene, "lawn, light stripes"),
      findModel(scene, "lawn, dark stripes") };
    const std::array<double, 6> bounds = boundsWorld(lawn);
    const Vec3 forward = normalized(scene.camera.target - scene.camera.position);
    const Vec3 right = normalized(cross(forward, scene.camera.up));
    const Vec3 top = cross(right, forward);
    const double tangent = std::tan(0.5 * vtkMath::RadiansFromDegrees(scene.camera.fovDegrees));
    for (const double x : { -16.0 / 9.0, 16.0 / 9.0 })
    {
      for (const double y : { -1.0, 1.0 })
      {
        const Vec3 ray = forward + (tangent * x) * right + (tangent * y) * top;
        ASSERT_LT(ray[1], 0.0);
        const Vec3 hit = scene.camera.position + (scene.camera.position[1] / -ray[1]) * ray;
        EXPECT_GT(hit[0], bounds[0]);
        EXPECT_LT(hit[0], bounds[1]);
        EXPECT_GT(hit[2], bounds[4]);
        EXPECT_LT(hit[2], bounds[5]);
      }
    }
  }
}

//------------------------------------------------------------------------------
// In Morais' views of the trees, only their shadows show.
TEST(BuiltinScenes, OnlyTheLawnStandsInTheViewsOfTheTrees)
{
  for (const std::string name : { "trees-with", "trees-side", "trees-against" })
  {
    const Scene scene = loadScene(name);
    for (const SceneModel& model : scene.models)
    {
      Scene alone = scene;
      alone.models = { model };
      const DepthRange depths = visibleDepths(alone, 1.0);
      const bool seen = depths.nearest <= depths.farthest;
      const bool ground = model.name.substr(0, 4) == "lawn" || model.name == "earth";
      EXPECT_EQ(seen, ground) << name << ": " << model.name;
    }
  }
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, TheHalfPlanesShadowEndsAtTheKnownLine)
{
  Scene scene = loadScene("half-plane");
  scene.lights[0].settings["technique"] = "raytraced";
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetSize(300, 300);
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, 1.0);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetKeepVisibility(true);
  renderer->SetPass(shadows);
  window->AddRenderer(renderer);
  window->Render();

  const VisibilityImages& images = shadows->GetVisibility();
  ASSERT_EQ(images.visibility.size(), 1u);
  int lit = 0;
  int dark = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < images.coverage.size(); ++i)
  {
    const double x = images.origin[0] + images.positionX[i];
    const double y = images.origin[1] + images.positionY[i];
    // A pixel is 0.02 wide; closer than a hundredth of that, float may decide.
    if (images.coverage[i] == 0.0f || y > 0.1 || std::abs(x - halfPlaneShadowEdge) < 2e-4)
    {
      continue;
    }
    const bool expected = x > halfPlaneShadowEdge;
    wrong += (images.visibility[0][i] > 0.5f) == expected ? 0 : 1;
    expected ? ++lit : ++dark;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(lit, 9000);
  EXPECT_GT(dark, 9000);
}

//------------------------------------------------------------------------------
// With what it takes to hold them: coordinates shared along walls, no normals, indices of 32 bits.
TEST(BuiltinScenes, TheCityHasTenMillionTrianglesOfLessThan30BytesEach)
{
  const Scene scene = loadScene("city");
  double triangles = 0.0;
  double kibibytes = 0.0;
  for (const SceneModel& model : scene.models)
  {
    triangles += static_cast<double>(model.surface->GetNumberOfPolys());
    kibibytes += static_cast<double>(model.surface->GetActualMemorySize());
  }
  EXPECT_NEAR(triangles, 10e6, 0.1e6);
  EXPECT_LT(1024.0 * kibibytes / triangles, 30.0);
  EXPECT_GT(scene.models.size(), 100u);
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, AMissingPackageIsNamed)
{
  TestFolder folder;
  setenv("GNOMON_MODELS", folder.path().c_str(), 1);
  const std::string message = messageOf<BadInput>([] { loadScene("bunny"); });
  unsetenv("GNOMON_MODELS");
  EXPECT_NE(message.find("glmark2-data"), std::string::npos) << message;
  EXPECT_NE(message.find(folder / "bunny.obj"), std::string::npos) << message;
}

} // namespace
} // namespace gnomon::tool
