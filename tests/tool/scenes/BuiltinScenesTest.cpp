#include "BuiltinScenes.h"
#include "../TestFiles.h"
#include "Errors.h"
#include "SceneFraming.h"
#include "Vec3.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDataArrayRange.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

namespace gnomon::tool
{
namespace
{

using Names = std::vector<std::string>;

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

/// Return a scene with one of its models alone.
Scene alone(Scene scene, const std::string& name)
{
  scene.models.erase(std::remove_if(scene.models.begin(), scene.models.end(),
                       [&](const SceneModel& model) { return model.name != name; }),
    scene.models.end());
  EXPECT_FALSE(scene.models.empty()) << name;
  return scene;
}

Vec3 pointOf(vtkDataArray* array, vtkIdType i)
{
  Vec3 point;
  array->GetTuple(i, point.data());
  return point;
}

std::vector<double> valuesOf(vtkDataArray* array)
{
  const auto values = vtk::DataArrayValueRange(array);
  return { values.begin(), values.end() };
}

/// Call `visit` with the numbers of each triangle's corners.
template <class Visit>
void visitTriangles(vtkPolyData* surface, const Visit& visit)
{
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    surface->GetPolys()->GetCellAtId(i, size, ids);
    visit(ids);
  }
}

/// Edges of a surface, by the places of their ends, in one direction each: how often more they are
/// passed forwards than backwards. All zero for a closed surface.
vtkIdType countOpenEdges(vtkPolyData* surface)
{
  std::map<std::pair<Vec3, Vec3>, vtkIdType> passes;
  vtkDataArray* const points = surface->GetPoints()->GetData();
  visitTriangles(surface,
    [&](const vtkIdType* ids)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vec3 a = pointOf(points, ids[k]);
        const Vec3 b = pointOf(points, ids[(k + 1) % 3]);
        a < b ? ++passes[{ a, b }] : --passes[{ b, a }];
      }
    });
  return std::count_if(
    passes.begin(), passes.end(), [](const auto& edge) { return edge.second != 0; });
}

/// The scenes that are small enough for tests that look at all of them.
Names smallScenes()
{
  Names names;
  for (const auto* scenes : { &builtinScenes(), &hardScenes() })
  {
    for (const BuiltinScene& scene : *scenes)
    {
      names.push_back(scene.name);
    }
  }
  names.erase(std::find(names.begin(), names.end(), "city"));
  return names;
}

bool isHard(const std::string& name)
{
  return name.rfind("hard-", 0) == 0;
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

TEST(BuiltinScenes, AreListedOnceEach)
{
  std::set<std::string> names;
  for (const auto* scenes : { &builtinScenes(), &hardScenes() })
  {
    for (const BuiltinScene& scene : *scenes)
    {
      EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
      EXPECT_FALSE(scene.summary.empty()) << scene.name;
      EXPECT_LT(scene.summary.size(), 80u) << scene.name;
      EXPECT_EQ(findBuiltinScene(scene.name), &scene);
      EXPECT_EQ(isHard(scene.name), scenes == &hardScenes()) << scene.name;
      EXPECT_EQ(isHard(scene.name), !scene.cases.empty()) << scene.name;
    }
  }
  EXPECT_EQ(builtinScenes().size(), 40u);
}

/// The literature's hard cases: apelles N1 to N29, crsm N1 to N15, and so on. Those without a scene
/// are rows of tests/acceptance.tsv.
TEST(BuiltinScenes, EveryHardCaseHasASceneOrATest)
{
  std::set<std::string> expected;
  for (const auto& [begin, count] :
    std::map<std::string, int>{ { "apelles N", 29 }, { "crsm N", 15 }, { "selective 5.1.", 7 },
      { "selective 5.2.", 12 }, { "montecarlo 5.", 16 }, { "survey ", 18 } })
  {
    for (int i = 1; i <= count; ++i)
    {
      expected.insert(begin + std::to_string(i));
    }
  }
  for (const char part : std::string("abcdefgh"))
  {
    expected.insert(std::string("survey 7.12") + part);
  }
  std::set<std::string> named;
  for (const BuiltinScene& scene : hardScenes())
  {
    named.insert(scene.cases.begin(), scene.cases.end());
  }
  std::ifstream rows(GNOMON_SOURCE_DIR "/tests/acceptance.tsv");
  for (std::string spec, hardCase, rest; std::getline(rows, spec, '\t') &&
       std::getline(rows, hardCase, '\t') && std::getline(rows, rest);)
  {
    if (spec == "hard")
    {
      EXPECT_TRUE(named.insert(hardCase).second) << hardCase << " has a scene";
    }
  }
  EXPECT_EQ(named, expected);
}

TEST_P(BuiltinSceneTest, IsFiniteInFrontOfItsCameraAndTheSameEveryTime)
{
  const Scene scene = loadScene(GetParam());
  const Scene again = loadScene(GetParam());
  EXPECT_EQ(scene.name, GetParam());
  const std::map<std::string, std::size_t> lights = { { "office", 2 }, { "building", 64 },
    { "building-lit", 4 } };
  const auto several = lights.find(GetParam());
  EXPECT_EQ(scene.lights.size(), several == lights.end() ? 1u : several->second);
  EXPECT_GT(countTriangles(scene), 0);
  ASSERT_EQ(again.models.size(), scene.models.size());
  for (std::size_t i = 0; i < scene.models.size(); ++i)
  {
    const std::vector<double> points = valuesOf(scene.models[i].surface->GetPoints()->GetData());
    EXPECT_EQ(points, valuesOf(again.models[i].surface->GetPoints()->GetData()));
    EXPECT_TRUE(
      std::all_of(points.begin(), points.end(), [](double x) { return std::isfinite(x); }));
  }
  const DepthRange depths = visibleDepths(scene, 1.0);
  EXPECT_GT(depths.nearest, 0.0);
  EXPECT_GT(depths.farthest, depths.nearest);
}

TEST(BuiltinScenes, HaveTheTrianglesThatTheyPromise)
{
  for (const auto& [name, count] : std::map<std::string, vtkIdType>{ { "bunny", 69668 },
         { "cube", 14 }, { "half-plane", 4 }, { "panels", 12 }, { "screens", 196 },
         { "long-cube", 14 }, { "cups", 8834 }, { "atrium", 259668 }, { "bench-with", 55026 },
         { "flowers-side", 55026 }, { "primitives", 4944 }, { "primitives-against", 4944 } })
  {
    EXPECT_EQ(countTriangles(loadScene(name)), count) << name;
  }
  for (const auto& [name, count] : std::map<std::string, vtkIdType>{ { "plane", 2 },
         { "pyramid", 6 }, { "cylinder", 128 }, { "torus", 3072 }, { "sphere", 1736 } })
  {
    EXPECT_EQ(countTriangles(alone(loadScene("primitives"), name)), count) << name;
  }
}

// Cosines between the cameras' directions and the light's, of Moderno's table 3.
TEST(BuiltinScenes, PrimitivesAreSeenAcrossWithAndAgainstTheLight)
{
  for (const auto& [name, cosine] : std::map<std::string, double>{
         { "primitives", 0.37 }, { "primitives-with", 0.93 }, { "primitives-against", -0.35 } })
  {
    const Scene scene = loadScene(name);
    const Vec3 forward = normalized(scene.camera.target - scene.camera.position);
    const SceneLight& sun = scene.lights[0];
    EXPECT_NEAR(dot(forward, normalized(sun.target - sun.position)), cosine, 0.005) << name;
  }
}

TEST(BuiltinScenes, ModelsStandOnAPlaneOfFourTimesTheirSize)
{
  for (const char* name : { "bunny", "horse", "cat" })
  {
    Scene model = loadScene(name);
    const std::array<double, 6> ground = boundsWorld(alone(model, "plane"));
    model.models.pop_back();
    const std::array<double, 6> own = boundsWorld(model);
    const double extent = std::max(own[1] - own[0], own[5] - own[4]);
    EXPECT_NEAR(ground[1] - ground[0], 4.0 * extent, 1e-5 * extent) << name;
    EXPECT_NEAR(ground[3], own[2], 1e-6 * extent) << name;
  }
}

// The front of every triangle, counter-clockwise, is the side that its normals show, and no
// triangle is without area.
TEST(BuiltinScenes, TrianglesFaceTheWayOfTheirNormals)
{
  for (const std::string& name : smallScenes())
  {
    if (isHard(name) || name == "bunny" || name == "horse" || name == "cat")
    {
      continue; // sheets without normals, and models of others
    }
    for (const SceneModel& model : loadScene(name).models)
    {
      vtkDataArray* points = model.surface->GetPoints()->GetData();
      vtkDataArray* normals = model.surface->GetPointData()->GetNormals();
      ASSERT_TRUE(normals);
      int wrong = 0;
      visitTriangles(model.surface,
        [&](const vtkIdType* ids)
        {
          const Vec3 a = pointOf(points, ids[0]);
          const Vec3 face = cross(pointOf(points, ids[1]) - a, pointOf(points, ids[2]) - a);
          const Vec3 shading =
            pointOf(normals, ids[0]) + pointOf(normals, ids[1]) + pointOf(normals, ids[2]);
          wrong += dot(face, shading) > 0.0 ? 0 : 1;
        });
      EXPECT_EQ(wrong, 0) << name << ": " << model.name;
    }
  }
}

TEST(BuiltinScenes, TheTerrainIsSeenFromTwoMetresAboveTheGround)
{
  const Scene scene = loadScene("terrain");
  const std::array<double, 6> bounds = boundsWorld(scene);
  EXPECT_NEAR(bounds[1] - bounds[0], 1000.0, 20.0);
  // The nearest ground vertices are less than a cell, 4 m, away.
  vtkDataArray* ground = alone(scene, "ground").models[0].surface->GetPoints()->GetData();
  const Vec3 eye = scene.camera.position;
  std::pair<double, double> nearest{ 1e9, 0.0 }; // distance and height below the eye
  for (vtkIdType i = 0; i < ground->GetNumberOfTuples(); ++i)
  {
    const Vec3 to = eye - pointOf(ground, i);
    nearest = std::min(nearest, { std::hypot(to[0], to[2]), to[1] });
  }
  EXPECT_NEAR(nearest.second, 2.0, 0.7);
}

TEST(BuiltinScenes, SolidsAreClosedAndSheetsAreOpen)
{
  struct Case
  {
    const char* scene;
    Names solids;
    Names sheets;
  };
  const Case cases[] = {
    { "cube", { "cube" }, {} },
    { "stack", { "cube", "sphere" }, {} },
    { "long-cube", { "cube" }, {} },
    { "letter", { "letter" }, {} },
    { "pole", { "pole" }, {} },
    { "half-plane", {}, { "half plane" } },
    { "screens", {}, { "lattice", "bent sheet" } },
    { "panels", {}, { "top", "middle", "bottom", "panel" } },
    { "cups", {}, { "standing cups", "hovering cups" } },
    { "bench-with", { "earth", "paving", "bench slats", "flower box", "soil", "lamp globe" },
      { "leaves", "tulip", "daisy", "anemone", "grass", "lamp hood" } },
    { "atrium", { "shell", "wall relief", "light paving", "dark paving" },
      { "red cloth", "green cloth", "blue cloth", "awnings", "pots", "plants" } },
    { "office", { "building", "desks", "lamp", "red books" }, { "shade", "mug", "paper" } },
  };
  for (const Case& of : cases)
  {
    const Scene scene = loadScene(of.scene);
    const auto openEdges = [&](const std::string& model)
    { return countOpenEdges(alone(scene, model).models[0].surface); };
    for (const std::string& model : of.solids)
    {
      EXPECT_EQ(openEdges(model), 0) << of.scene << ": " << model;
    }
    for (const std::string& model : of.sheets)
    {
      EXPECT_GT(openEdges(model), 3) << of.scene << ": " << model;
    }
  }
}

// No background in any picture of the garden: the rays through the corners of pictures up to 16:9
// meet the lawn. The corners see farthest. In Morais' views of the trees, only their shadows show.
TEST(BuiltinScenes, TheGardensLawnFillsEveryView)
{
  for (const std::string object : { "bench", "trees", "flowers" })
  {
    for (const char* way : { "-with", "-side", "-against" })
    {
      SCOPED_TRACE(object + way);
      const Scene scene = loadScene(object + way);
      const std::array<double, 6> lawn = boundsWorld(alone(scene, "lawn, light stripes"));
      const Vec3 forward = normalized(scene.camera.target - scene.camera.position);
      const Vec3 right = normalized(cross(forward, scene.camera.up));
      const double tangent = std::tan(0.5 * vtkMath::RadiansFromDegrees(scene.camera.fovDegrees));
      for (const double x : { -16.0 / 9.0, 16.0 / 9.0 })
      {
        const Vec3 ray = forward + (tangent * x) * right + tangent * cross(right, forward);
        ASSERT_LT(ray[1], 0.0);
        const Vec3 hit = scene.camera.position + (scene.camera.position[1] / -ray[1]) * ray;
        EXPECT_GT(hit[0], lawn[0]);
        EXPECT_LT(hit[0], lawn[1]);
        EXPECT_GT(hit[2], lawn[4]);
        EXPECT_LT(hit[2], lawn[5]);
      }
      for (const SceneModel& model : scene.models)
      {
        const DepthRange depths = visibleDepths(alone(scene, model.name), 1.0);
        const bool ground = model.name.substr(0, 4) == "lawn" || model.name == "earth";
        EXPECT_TRUE(object != "trees" || ground == (depths.nearest <= depths.farthest))
          << model.name;
      }
    }
  }
}

TEST(BuiltinScenes, TheHalfPlanesShadowEndsAtTheKnownLine)
{
  Scene scene = loadScene("half-plane");
  scene.lights[0].settings["technique"] = "raytraced";
  const auto window = makeOffScreenWindow();
  window->SetSize(300, 300);
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, 1.0);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetKeepVisibility(true);
  renderer->SetPass(shadows);
  window->AddRenderer(renderer);
  window->Render();

  const VisibilityImages& images = shadows->GetVisibility();
  ASSERT_EQ(images.visibility.size(), 1u);
  int counts[2] = {}; // dark, lit
  int wrong = 0;
  for (std::size_t i = 0; i < images.coverage.size(); ++i)
  {
    const double x = images.origin[0] + images.positionX[i];
    const double y = images.origin[1] + images.positionY[i];
    // A pixel is 0.02 wide; closer than a hundredth of that, float may decide.
    if (images.coverage[i] != 0.0f && y <= 0.1 && std::abs(x - halfPlaneShadowEdge) >= 2e-4)
    {
      const bool lit = x > halfPlaneShadowEdge;
      wrong += (images.visibility[0][i] > 0.5f) == lit ? 0 : 1;
      ++counts[lit];
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(std::min(counts[0], counts[1]), 9000);
}

// With what it takes to hold them: coordinates shared along walls, no normals, indices of 32 bits.
TEST(BuiltinScenes, TheCityHasTenMillionTrianglesOfLessThan30BytesEach)
{
  const Scene scene = loadScene("city");
  double kibibytes = 0.0;
  for (const SceneModel& model : scene.models)
  {
    kibibytes += static_cast<double>(model.surface->GetActualMemorySize());
  }
  const auto triangles = static_cast<double>(countTriangles(scene));
  EXPECT_NEAR(triangles, 10e6, 0.1e6);
  EXPECT_LT(1024.0 * kibibytes / triangles, 30.0);
  EXPECT_GT(scene.models.size(), 100u);
}

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
