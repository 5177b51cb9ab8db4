#include "BuiltinScenes.h"
#include "../TestFiles.h"
#include "Errors.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

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

//------------------------------------------------------------------------------
TEST(BuiltinScenes, AreListedAndLoadable)
{
  EXPECT_EQ(builtinScenes().size(), 9u);
  for (const BuiltinScene& line : builtinScenes())
  {
    SCOPED_TRACE(line.name);
    EXPECT_FALSE(line.summary.empty());
    const Scene scene = loadScene(line.name);
    EXPECT_EQ(scene.name, line.name);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_GT(countTriangles(scene), 0);
  }
}

//------------------------------------------------------------------------------
TEST(BuiltinScenes, HaveTheTrianglesThatTheyPromise)
{
  EXPECT_EQ(countTriangles(loadScene("bunny")), 69668);
  EXPECT_EQ(countTriangles(loadScene("cube")), 14);
  const Scene primitives = loadScene("primitives");
  EXPECT_EQ(countTriangles(primitives), 4944);
  const std::map<std::string, vtkIdType> parts = { { "plane", 2 }, { "pyramid", 6 },
    { "cylinder", 128 }, { "torus", 3072 }, { "sphere", 1736 } };
  for (const auto& [name, count] : parts)
  {
    EXPECT_EQ(findModel(primitives, name).surface->GetNumberOfPolys(), count) << name;
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
TEST(BuiltinScenes, AreTheSameEveryTime)
{
  for (const char* name : { "primitives", "posts", "plates", "terrain", "bunny" })
  {
    SCOPED_TRACE(name);
    const Scene a = loadScene(name);
    const Scene b = loadScene(name);
    ASSERT_EQ(a.models.size(), b.models.size());
    for (std::size_t m = 0; m < a.models.size(); ++m)
    {
      vtkDataArray* pointsA = a.models[m].surface->GetPoints()->GetData();
      vtkDataArray* pointsB = b.models[m].surface->GetPoints()->GetData();
      ASSERT_EQ(pointsA->GetDataType(), VTK_FLOAT);
      ASSERT_EQ(pointsA->GetNumberOfTuples(), pointsB->GetNumberOfTuples());
      EXPECT_EQ(std::memcmp(pointsA->GetVoidPointer(0), pointsB->GetVoidPointer(0),
                  sizeof(float) * static_cast<std::size_t>(pointsA->GetNumberOfValues())),
        0);
    }
  }
}

//------------------------------------------------------------------------------
// The front of every triangle, counter-clockwise, is the side that its normals show, and no
// triangle is without area.
TEST(BuiltinScenes, TrianglesFaceTheWayOfTheirNormals)
{
  for (const char* name : { "cube", "primitives", "posts", "plates", "room", "terrain" })
  {
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
