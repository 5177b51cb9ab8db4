// Every technique with a map on the scenes that break shadow maps: the numbers stay finite, OpenGL
// has nothing to complain about, and the visibility differs from the ray-traced one by no more than
// is stated here.

#include "PassScene.h"

#include "plugin/VisibilityImages.h"
#include "shadowtech/Registry.h"

#include <vtkCellArray.h>
#include <vtkLight.h>
#include <vtkPoints.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// Sets up casters, receivers, one light and the camera.
using Build = std::function<vtkLight*(PassScene&)>;

vtkSmartPointer<vtkPolyData> triangles(const std::vector<glm::dvec3>& corners)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    vtkIdType ids[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec3& corner = corners[i + k];
      ids[k] = points->InsertNextPoint(corner.x, corner.y, corner.z);
    }
    cells->InsertNextCell(3, ids);
  }
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

const glm::dvec3 slanting(1.0, 0.4, -1.5);

/// A box and a sphere over a slab, seen from a side, `unit` times as large as elsewhere and moved
/// by `offset`.
void addBoxAndSphere(
  PassScene& scene, double unit = 1.0, const glm::dvec3& offset = glm::dvec3(0.0))
{
  const auto place = [&](double x, double y, double z)
  { return offset + unit * glm::dvec3(x, y, z); };
  scene.addBox(place(-4.0, -4.0, -0.2), place(4.0, 4.0, 0.0));
  scene.addBox(place(-2.0, -1.0, 0.5), place(-0.5, 1.0, 2.0));
  scene.addSphere(place(1.5, 0.0, 1.2), 0.8 * unit);
  scene.lookFrom(place(0.0, -9.0, 7.0), place(0.0, 0.0, 0.0));
}

Build underSun(
  const glm::dvec3& direction, double unit = 1.0, const glm::dvec3& offset = glm::dvec3(0.0))
{
  return [=](PassScene& scene)
  {
    addBoxAndSphere(scene, unit, offset);
    return scene.addSun(direction);
  };
}

Build underSpot(const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    addBoxAndSphere(scene);
    return scene.addSpot(position, target, coneAngleDegrees);
  };
}

struct HardCase
{
  const char* name;
  /// The share of the pixels that face the light which may be wrong, of techniques that compare and
  /// of those that filter.
  double hard;
  double filtered;
  Build build;
  bool singleView = true; ///< the light has no cube, so that views may be warped or split
};
std::ostream& operator<<(std::ostream& stream, const HardCase& hardCase)
{
  return stream << hardCase.name;
}

const std::vector<HardCase>& hardCases()
{
  static const std::vector<HardCase> cases = {
    { "sunAlongTheView", 0.001, 0.001, underSun({ 0.0, 9.0, -7.0 }) },
    { "sunAgainstTheView", 0.001, 0.001, underSun({ 0.0, -9.0, -0.7 }) },
    { "sunParallelToTheWalls", 0.001, 0.004, underSun({ 1.0, 0.0, -1.0 }) },
    { "sunParallelToTheFloor", 0.001, 0.006, underSun({ 1.0, 0.0, 0.0 }) },
    { "sunStraightDown", 0.001, 0.001, underSun({ 0.0, 0.0, -1.0 }) },
    { "sunAlongPlusY", 0.001, 0.001, underSun({ 0.0, 1.0, 0.0 }) },
    { "sunAlongMinusY", 0.001, 0.001, underSun({ 0.0, -1.0, 0.0 }) },
    { "coneOfATenthOfADegree", 0.001, 0.001,
      underSpot({ 1.0, -3.0, 900.0 }, { 0.0, 0.0, 0.0 }, 0.1) },
    { "coneOf89Degrees", 0.002, 0.005, underSpot({ 0.0, 1.0, 4.0 }, { 0.0, 0.0, 0.0 }, 89.0),
      false },
    { "receiversBehindTheLight", 0.001, 0.002,
      underSpot({ 0.0, 0.0, 1.0 }, { 3.0, 0.0, 0.0 }, 50.0) },
    { "cameraInsideACaster", 0.003, 0.006,
      [](PassScene& scene)
      {
        addBoxAndSphere(scene);
        scene.addBox({ -3.0, -10.0, 5.0 }, { 3.0, -8.0, 9.0 });
        return scene.addSun(slanting);
      } },
    { "singleTriangle", 0.0, 0.0,
      [](PassScene& scene)
      {
        scene.add(triangles({ { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } }));
        scene.lookFrom({ 0.0, -4.0, 4.0 });
        return scene.addSun(slanting);
      } },
    { "slivers", 0.04, 0.05,
      [](PassScene& scene)
      {
        // Three texels wide, 6,000 times as long as high.
        std::vector<glm::dvec3> corners;
        for (int i = 0; i < 20; ++i)
        {
          const double y = -3.0 + 0.3 * i;
          corners.insert(corners.end(),
            { { -3.0, y, 1.0 }, { 3.0, y + 1e-5 * i, 1.0 }, { 3.0, y + 0.06, 1.001 } });
        }
        scene.addFloor(4.0);
        scene.add(triangles(corners));
        scene.lookFrom({ 0.0, -9.0, 7.0 });
        return scene.addSun(slanting);
      } },
    { "coplanarSheets", 0.001, 0.002,
      [](PassScene& scene)
      {
        addBoxAndSphere(scene);
        scene.addFloor(3.0, 2.5);
        scene.addFloor(2.0, 2.5);
        return scene.addSun(slanting);
      } },
    { "postsOfATexel", 0.012, 0.02,
      [](PassScene& scene)
      {
        // The map sees about 11 units.
        scene.pass->SetMapSize(256);
        scene.addFloor(4.0);
        for (int i = 0; i < 15; ++i)
        {
          const double x = -3.5 + 0.5 * i;
          scene.addBox({ x, -0.02, 0.0 }, { x + 0.04, 0.02, 1.5 });
        }
        scene.lookFrom({ 0.0, -9.0, 7.0 });
        return scene.addSun({ 0.3, 1.0, -1.0 });
      } },
    { "plainSeenAlongItself", 0.01, 0.012,
      [](PassScene& scene)
      {
        // Warps are strong here.
        scene.addFloor(100.0);
        for (const double y : { -94.0, -85.0, -70.0, -40.0, 10.0, 80.0 })
        {
          const double size = 0.1 * (y + 104.0);
          scene.addBox({ -size, y, 0.0 }, { 0.0, y + size, 2.0 * size });
        }
        scene.lookFrom({ 3.0, -98.0, 2.0 });
        return scene.addSun({ 1.0, 0.3, -0.8 });
      } },
    { "unitsOfAThousandth", 0.002, 0.004, underSun(slanting, 1e-3) },
    { "unitsOfAMillion", 0.002, 0.004, underSun(slanting, 1e6) },
    { "aMillionAway", 0.003, 0.006, underSun(slanting, 1.0, { 1e6, -1e6, 1e6 }) },
  };
  return cases;
}

/// Of the pixels of two frames that face a light, those that are wrong.
struct Wrong
{
  std::size_t facing = 0;
  std::size_t wrong = 0;
};
Wrong countWrong(const VisibilityImages& kept, const VisibilityImages& truth, vtkLight* light)
{
  Wrong result;
  for (std::size_t i = 0; i < truth.coverage.size(); ++i)
  {
    // The normals of the image route are known to this. What is parallel to the light has no shade.
    constexpr double leastCosine = 1e-5;
    if (truth.coverage[i] > 0.5f && cosineTowards(truth, i, light) > leastCosine)
    {
      ++result.facing;
      result.wrong += std::abs(kept.visibility[0][i] - truth.visibility[0][i]) > 0.5f ? 1 : 0;
    }
  }
  return result;
}

class HardCases
  : public PassTest
  , public testing::WithParamInterface<HardCase>
{
protected:
  /// Light leaks through one exponential moment within some percent of the map's depth range
  /// (MomentEstimators.h): under a narrow cone over most of a contact's shadow.
  static constexpr double leaks = 0.03;

  /// The share of the pixels that face the light that may be wrong.
  static double mostWrong(const gnomon::TechniqueInfo& info)
  {
    return info.exact                     ? 0.0
      : info.name == "compare"            ? GetParam().hard
      : info.name == "single_exponential" ? leaks
                                          : GetParam().filtered;
  }
};

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(hardCases()),
  [](const testing::TestParamInfo<HardCase>& hardCase)
  { return std::string(hardCase.param.name); });

} // namespace

//------------------------------------------------------------------------------
TEST_P(HardCases, stayFiniteAndNearTheTruth)
{
  PassScene scene(320, 240);
  scene.pass->SetMapSize(512);
  vtkLight* const light = GetParam().build(scene);
  scene.pass->SetTechnique("raytraced");
  const VisibilityImages truth = drawKept(scene);
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    const bool warps = technique.projection != gnomon::Projection::Uniform;
    if (!technique.estimator->info.bakesMap() || (warps && !GetParam().singleView))
    {
      continue;
    }
    SCOPED_TRACE(technique.name);
    scene.pass->SetTechnique(technique.name.c_str());
    const VisibilityImages& kept = drawKept(scene);
    EXPECT_EQ(kept.coverage, truth.coverage);
    const Wrong found = countWrong(kept, truth, light);
    EXPECT_GT(found.facing, 100u);
    const double share = static_cast<double>(found.wrong) / static_cast<double>(found.facing);
    RecordProperty("wrongPercentBy_" + technique.name, std::to_string(100.0 * share));
    EXPECT_LE(share, mostWrong(technique.estimator->info));
  }
}
