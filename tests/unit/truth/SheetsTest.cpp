// Light through translucent sheets against closed forms, and against every triangle in double.

#include "EstimatorGlsl.h"
#include "RandomScenes.h"

#include "shadowtech/base/CutoutMask.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Sheet.h"
#include "shadowtech/transmittance/SheetMap.h"
#include "shadowtech/transmittance/Sheets.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr float endless = std::numeric_limits<float>::infinity();

Sheet sheetOf(double opacity, const glm::vec3& colour = glm::vec3(0.0f), bool isColoured = false)
{
  Sheet sheet;
  sheet.colour = glm::vec4(colour, static_cast<float>(opacity));
  sheet.isColoured = isColoured;
  return sheet;
}

/// Have a surface of a snapshot transmit. The snapshot's box is enlarged for the tests' rays.
void setSheet(Occluders& occluders, std::size_t surface, Sheet sheet)
{
  occluders.allCentred.add({ glm::dvec3(-12.0), glm::dvec3(12.0) });
  sheet.prop = static_cast<std::uint32_t>(surface);
  occluders.surfaces[surface].casts = false;
  occluders.surfaces[surface].sheet = std::make_shared<const Sheet>(std::move(sheet));
}

/// Return a snapshot whose surfaces are alike sheets.
Occluders makeSheets(const std::vector<Prop>& props, const Sheet& sheet = sheetOf(0.5))
{
  Occluders occluders = makeOccluders(props);
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    setSheet(occluders, i, sheet);
  }
  return occluders;
}

/// The sheets of a snapshot.
struct SheetsOf : Sheets
{
  explicit SheetsOf(const Occluders& occluders) { this->update(occluders); }
};

/// A ray in centred coordinates.
struct TestRay
{
  glm::vec3 origin, direction;
};

/// Return the number of sheets of opacity 0.5 that a ray crosses.
double countCrossings(const Sheets& sheets, const TestRay& ray, float rayFar = endless)
{
  return -std::log2(sheets.transmittanceOf(ray.origin, ray.direction, rayFar).x);
}

/// Count the rays that do not cross as many sheets of opacity 0.5.
/// @param makeRay called with a generator, by several threads at once
template <typename MakeRay>
std::size_t countWrong(
  const Occluders& occluders, std::size_t rays, double crossings, const MakeRay& makeRay)
{
  const SheetsOf sheets(occluders);
  std::atomic<std::size_t> wrong{ 0 };
  constexpr std::size_t batch = 1000;
  tbb::parallel_for(std::size_t(0), rays / batch,
    [&](std::size_t number)
    {
      Random random(static_cast<unsigned int>(number));
      wrong += countBelow(
        batch, [&](std::size_t) { return countCrossings(sheets, makeRay(random)) != crossings; });
    });
  return wrong;
}

/// Return a point between two: an end, the middle or any.
glm::vec3 between(const glm::vec3& a, const glm::vec3& b, Random& random)
{
  const float shares[] = { 0.0f, 0.5f, static_cast<float>(uniform(random, 0.0, 1.0)) };
  return glm::mix(a, b, shares[random() % 3]);
}

/// Return a point on a random edge of a snapshot's triangles.
glm::vec3 onEdge(const Occluders& occluders, Random& random)
{
  const glm::uvec3 triangle = occluders.triangles[random() % occluders.triangles.size()];
  const auto corner = static_cast<glm::length_t>(random() % 3);
  return between(occluders.positionsCentred[triangle[corner]],
    occluders.positionsCentred[triangle[(corner + 1) % 3]], random);
}

/// Return triangles around a corner, in the plane z = 0.
Mesh makeFan(int triangles)
{
  Mesh fan;
  fan.points.emplace_back(0.0);
  for (int i = 0; i < triangles; ++i)
  {
    const double angle = 2.0 * glm::pi<double>() * i / triangles;
    fan.points.emplace_back(3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0);
    fan.triangles.emplace_back(0, i + 1, (i + 1) % triangles + 1);
  }
  return fan;
}

/// Return needles between two rows of corners, in the plane z = 0.
Mesh makeStrip(int needles)
{
  Mesh strip;
  for (int i = 0; i <= needles + 1; ++i)
  {
    strip.points.emplace_back(-3.0 + 6.0 * i / (needles + 1), i % 2 == 0 ? -3.0 : 3.0, 0.0);
  }
  for (int i = 0; i < needles; ++i)
  {
    const auto first = static_cast<unsigned int>(i);
    strip.triangles.emplace_back(first, first + 1 + i % 2, first + 2 - i % 2);
  }
  return strip;
}

/// Return the points of a mesh's inner edges, those of two triangles.
std::vector<std::pair<glm::dvec3, glm::dvec3>> innerEdges(const Mesh& mesh)
{
  std::vector<std::pair<glm::uint, glm::uint>> edges;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      edges.push_back(std::minmax(triangle[corner], triangle[(corner + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::pair<glm::dvec3, glm::dvec3>> inner;
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    if (edges[i] == edges[i - 1])
    {
      inner.emplace_back(mesh.points[edges[i].first], mesh.points[edges[i].second]);
    }
  }
  return inner;
}

/// Meshes whose inner edges and corners are aimed at.
struct AimedMesh
{
  const char* name;
  Mesh mesh;
};
const AimedMesh aimedMeshes[] = { { "Fan", makeFan(97) }, { "Strip", makeStrip(300) },
  { "Grid", makePlane(6.0, 24) }, { "Terrain", makeTerrain(6.0, 24, 0.2) } };

struct AimedSheets : testing::TestWithParam<int>
{
  const Mesh& mesh() const { return aimedMeshes[this->GetParam()].mesh; }
};

/// All rays from below to an inner edge or corner cross a surface once, as it is and rotated.
TEST_P(AimedSheets, LoseAndRepeatNoRay)
{
  const auto edges = innerEdges(this->mesh());
  Random anyTurn(7);
  for (int i = 0; i < 5; ++i)
  {
    const glm::dmat4 turn = i == 0
      ? glm::dmat4(1.0)
      : glm::translate(
          glm::rotate(glm::dmat4(1.0), uniform(anyTurn, -3.0, 3.0), unitVector(anyTurn)),
          inCube(anyTurn, 5.0));
    const Occluders occluders = makeSheets({ { this->mesh(), turn } });
    const glm::dmat4 centredFromMesh =
      glm::translate(glm::dmat4(1.0), -occluders.frame.centre) * turn;
    const auto placed = [&](const glm::dvec3& point)
    { return glm::vec3(centredFromMesh * glm::dvec4(point, 1.0)); };
    EXPECT_EQ(countWrong(occluders, i == 0 ? 1000000 : 250000, 1.0,
                [&](Random& random) -> TestRay
                {
                  const auto& [from, to] = edges[random() % edges.size()];
                  glm::vec3 point = between(placed(from), placed(to), random);
                  // Rounded rays to the border may pass beside it.
                  const glm::vec3 middle = placed(glm::dvec3(0.0));
                  point = glm::distance(point, middle) > 2.9f ? middle : point;
                  const glm::vec3 below = placed(inCube(random) + glm::dvec3(0.0, 0.0, -9.0));
                  const glm::vec3 origin =
                    random() % 2 != 0 ? glm::round(4.0f * below) / 4.0f : below;
                  return { origin, point - origin };
                }),
      0u)
      << i;
  }
}

TEST_P(AimedSheets, LoseAndRepeatNoRayAsInstances)
{
  Random random(8);
  Occluders occluders = makeSheets({ { this->mesh() } });
  std::vector<glm::dmat4> instances;
  for (int i = 0; i < 3; ++i)
  {
    // One above the other, so that rays to an edge of one cross three.
    instances.push_back(
      glm::translate(glm::rotate(glm::dmat4(1.0), uniform(random, -0.3, 0.3), unitVector(random)),
        { 0.0, 0.0, 0.7 * i }));
  }
  makeInstanced(occluders, 0, instances);
  EXPECT_EQ(countWrong(occluders, 1000000, 3.0,
              [&](Random& generator) -> TestRay
              {
                const glm::vec3 point = 0.4f * onEdge(occluders, generator);
                const glm::vec3 target(
                  instances[generator() % 3] * glm::dvec4(glm::dvec3(point), 1.0));
                const glm::vec3 origin(0.2 * inCube(generator) + glm::dvec3(0.0, 0.0, -9.0));
                return { origin, target - origin };
              }),
    0u);
}

TEST_P(AimedSheets, LoseAndRepeatNoRayAfterDeformation)
{
  Occluders occluders = makeSheets({ { this->mesh() } });
  SheetsOf sheets(occluders);
  Random random(9);
  for (int step = 0; step < 3; ++step)
  {
    for (std::uint32_t i = 0; i < occluders.surfaces[0].vertexCount; ++i)
    {
      occluders.positionsCentred[i].z += static_cast<float>(uniform(random, -0.003, 0.003));
    }
    occluders.surfaces[0].patches = std::make_shared<Patches>();
    occluders.surfaces[0].positionsVersion += 100;
    occluders.positionsVersion += 100;
    sheets.update(occluders);
    std::size_t wrong = 0;
    for (int i = 0; i < 100000; ++i)
    {
      const glm::vec3 point = 0.9f * onEdge(occluders, random);
      const TestRay ray{ point + glm::vec3(0.25f, -0.5f, -9.0f), { -0.25f, 0.5f, 9.0f } };
      wrong += countCrossings(sheets, ray) != 1.0 ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(, AimedSheets, testing::Range(0, 4),
  [](const auto& mesh) { return aimedMeshes[mesh.param].name; });

TEST(Sheets, ClosedSurfacesAreCrossedOnceFromInsideAndEvenlyFromOutside)
{
  for (Mesh mesh : { makeBox(glm::dvec3(-1.0), { 1.0, 0.5, 0.01 }), makeSphere(24, 40) })
  {
    for (glm::dvec3& point : mesh.points)
    {
      point = glm::round(point * 0x1p40) / 0x1p40; // closes the sphere's pole
    }
    const Occluders occluders = makeSheets({ { mesh } });
    const glm::vec3 middle(glm::dvec3(0.0, -0.25, -0.4) * 0.01 - occluders.frame.centre);
    EXPECT_EQ(countWrong(occluders, 1000000, 1.0,
                [&](Random& random) -> TestRay
                {
                  const glm::vec3 origin =
                    middle + glm::vec3(inCube(random, random() % 2 != 0 ? 0.001 : 0.0));
                  return { origin, onEdge(occluders, random) - origin };
                }),
      0u);
    SheetsOf sheets(occluders);
    Random random(3);
    for (int i = 0; i < 100000; ++i)
    {
      const glm::vec3 origin(10.0 * unitVector(random));
      const TestRay ray{ origin, onEdge(occluders, random) - origin };
      ASSERT_THAT(countCrossings(sheets, ray), testing::AnyOf(0.0, 2.0));
    }
  }
}

TEST(Sheets, CopiesOfATriangleCountOnceWithinAProp)
{
  Mesh twice = makePlane(4.0, 4);
  const Mesh other = apart(twice);
  for (const glm::uvec3& triangle : other.triangles)
  {
    const auto first = static_cast<glm::uint>(makePlane(4.0, 4).points.size());
    twice.triangles.push_back(glm::uvec3(triangle.z, triangle.x, triangle.y) + first);
  }
  twice.points.insert(twice.points.end(), other.points.begin(), other.points.end());
  Occluders occluders = makeSheets({ { twice }, { makePlane(4.0, 4) } });
  const TestRay ray{ { 0.3f, 0.2f, -2.0f }, { 0.0f, 0.0f, 1.0f } };
  EXPECT_EQ(countCrossings(SheetsOf(occluders), ray), 2.0) << "two props";
  Sheet ofFirst = *occluders.surfaces[0].sheet;
  occluders.surfaces[1].sheet = std::make_shared<const Sheet>(std::move(ofFirst));
  SheetsOf sheets(occluders);
  EXPECT_EQ(countCrossings(sheets, ray), 1.0) << "two surfaces of a prop";
  // Once the copies move apart, both count.
  moveSurface(occluders, 1, { 0.0, 0.0, 0.5 });
  occluders.surfaces[1].patches = std::make_shared<Patches>();
  sheets.update(occluders);
  EXPECT_EQ(countCrossings(sheets, ray), 2.0) << "apart";
}

TEST(Sheets, ColouredPanesMultiplyByChannel)
{
  Occluders occluders =
    makeOccluders({ { makePlane(4.0) }, { makePlane(4.0), at({ 0.0, 0.0, 1.0 }) } });
  setSheet(occluders, 0, sheetOf(0.75, { 1.0f, 0.5f, 0.0f }, true));
  setSheet(occluders, 1, sheetOf(0.5, { 0.0f, 0.25f, 1.0f }, true));
  SheetsOf sheets(occluders);
  const glm::dvec3 found =
    sheets.transmittanceOf({ 0.1f, 0.2f, -3.0f }, { 0.0f, 0.0f, 1.0f }, endless);
  EXPECT_EQ(found, glm::dvec3(0.5, (1.0 - 0.75 * 0.5) * (1.0 - 0.5 * 0.75), 0.25));
}

TEST(Sheets, OpacityIsThatOfVerticesTrianglesAndHoles)
{
  Occluders occluders = makeOccluders({ { makePlane(2.0) } });
  Sheet sheet = sheetOf(0.5);
  sheet.ofVertices.assign(4, glm::u8vec4(255, 255, 255, 0));
  for (std::uint32_t i = 0; i < 4; ++i)
  {
    // Opaque to the right, by half of the property.
    sheet.ofVertices[i].a = occluders.positionsCentred[i].x > 0.0f ? 255 : 0;
  }
  setSheet(occluders, 0, sheet);
  const auto at = [&](float x, float y) {
    return SheetsOf(occluders).transmittanceOf({ x, y, -3.0f }, { 0.0f, 0.0f, 1.0f }, endless).x;
  };
  for (const float x : { -0.75f, 0.0f, 0.3f })
  {
    EXPECT_NEAR(at(x, 0.1f), 1.0 - 0.5 * (0.5 + 0.5 * static_cast<double>(x)), 1e-12);
  }

  sheet.ofVertices.clear();
  sheet.ofTriangles = { glm::u8vec4(0, 0, 0, 51), glm::u8vec4(0, 0, 0, 255) };
  setSheet(occluders, 0, sheet);
  EXPECT_THAT(at(0.5f, -0.5f) * at(-0.5f, 0.5f), testing::DoubleNear(0.9 * 0.5, 1e-12));

  CutoutMask left;
  left.width = 2;
  left.height = 1;
  left.texels = { 255, 0 };
  occluders.surfaces[0].cutout = std::make_shared<const CutoutMask>(left);
  for (std::uint32_t i = 0; i < 4; ++i)
  {
    occluders.surfaces[0].textureCoordinates.push_back(
      0.5f * glm::vec2(occluders.positionsCentred[i]) + 0.5f);
  }
  setSheet(occluders, 0, sheetOf(0.5));
  EXPECT_EQ(at(-0.5f, 0.2f), 0.5);
  EXPECT_EQ(at(0.5f, 0.2f), 1.0) << "a hole";
}

TEST(Sheets, OneSidedSheetsTakeLightWhereTheirFrontFacesIt)
{
  Occluders occluders = makeSheets({ { makePlane(2.0), glm::dmat4(1.0), true, true, true } });
  for (const char* const as : { "drawn once", "a mirrored instance" })
  {
    SheetsOf sheets(occluders);
    const auto crossings = [&](float towards) {
      return countCrossings(sheets, { { 0.1f, 0.2f, -towards }, { 0.0f, 0.0f, towards } });
    };
    const bool isMirrored = occluders.surfaces[0].mirrored;
    EXPECT_EQ(crossings(1.0f), isMirrored ? 0.0 : 1.0) << as;
    EXPECT_EQ(crossings(-1.0f), isMirrored ? 1.0 : 0.0) << as;
    occluders.surfaces[0].topologyVersion += 50;
    occluders.topologyVersion += 50;
    makeInstanced(occluders, 0, { glm::scale(glm::dmat4(1.0), { -1.0, 1.0, 1.0 }) }, true);
  }
}

TEST(Sheets, RaysEndAtTheLight)
{
  const Occluders occluders = makeSheets({ { makePlane(2.0) } });
  SheetsOf sheets(occluders);
  EXPECT_EQ(countCrossings(sheets, { { 0.1f, 0.2f, -2.0f }, { 0.0f, 0.0f, 1.5f } }, 1.0f), 0.0);
  EXPECT_EQ(countCrossings(sheets, { { 0.1f, 0.2f, -2.0f }, { 0.0f, 0.0f, 2.5f } }, 1.0f), 1.0);
  EXPECT_EQ(countCrossings(sheets, { { 0.1f, 0.2f, 0.5f }, { 0.0f, 0.0f, 2.5f } }, 1.0f), 0.0);
}

TEST(Sheets, RandomScenesTransmitAsEveryTriangleInDouble)
{
  for (const char* const name : randomSceneNames())
  {
    Random random(11);
    Occluders occluders = makeOccluders(makeRandomScene(name, random));
    for (Surface& surface : occluders.surfaces)
    {
      surface.oneSided = false;
      surface.cutout.reset();
      surface.casts = true; // castingTriangles() lists all
    }
    const std::vector<CastingTriangle> triangles = castingTriangles(occluders);
    for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
    {
      setSheet(occluders, i, sheetOf(0.1 + 0.05 * static_cast<double>(i % 17)));
    }
    SheetsOf sheets(occluders);
    std::vector<CastingTriangle> once; // without copies within a surface
    for (const CastingTriangle& triangle : triangles)
    {
      const auto isCopy = [&](const CastingTriangle& other)
      {
        return other.surface == triangle.surface &&
          std::is_permutation(other.corners.begin(), other.corners.end(), triangle.corners.begin());
      };
      if (std::none_of(once.begin(), once.end(), isCopy))
      {
        once.push_back(triangle);
      }
    }
    int compared = 0;
    for (int i = 0; i < 300; ++i)
    {
      const glm::vec3 origin(inCube(random, 3.0));
      const glm::vec3 direction(unitVector(random));
      double expected = 1.0;
      bool isClear = true; // no edge within rounding
      for (const CastingTriangle& triangle : once)
      {
        const auto hit = meet(triangle, glm::dvec3(origin), glm::dvec3(direction));
        if (hit && hit->at > 0.0)
        {
          isClear = isClear && std::abs(hit->leastWeight()) > 1e-9 && hit->at > 1e-6;
          const double opacity = occluders.surfaces[triangle.surface].sheet->colour.a;
          expected *= hit->isInside() ? 1.0 - opacity : 1.0;
        }
      }
      if (isClear)
      {
        ++compared;
        ASSERT_NEAR(sheets.transmittanceOf(origin, direction, endless).x, expected, 1e-12)
          << name << ", ray " << i;
      }
    }
    EXPECT_GT(compared, 200) << name;
  }
}

// The map of sheets that shaders read at points, against rays through the same sheets.

Bounds boxOf(const Occluders& occluders)
{
  Bounds bounds;
  for (const Surface& surface : occluders.surfaces)
  {
    bounds.add(surface.boundsCentred);
  }
  return bounds;
}

/// A point on a sheet, with its normal on the light's side.
struct SheetPoint
{
  glm::vec4 position, normal;
};

/// Shares that shaders read at points.
std::vector<glm::vec4> sheetSharesAt(const SheetMap& map, const std::vector<SheetPoint>& points)
{
  ShaderLibrary library;
  return runCompute<glm::vec4>(library,
    computeGlsl(map.glsl(), "mat2x4", "vec4",
      "result[i] = vec4(vec3(gnomonSheets_LIGHT(given[i][0].xyz, given[i][1].xyz)), 1.0);\n"),
    points, map.uniforms({}));
}

/// Differences between shaders and rays, weighted by the points' cosines to the light.
struct SheetErrors
{
  double mean = 0.0;  ///< of absolute values
  double wrong = 0.0; ///< share of those above 0.02
  double truth = 0.0; ///< mean share of rays
};

/// Compare the shares at random points of all sheets.
SheetErrors compareAtPoints(const Occluders& occluders, const ShadowLight& light, int texels)
{
  Sheets sheets;
  sheets.update(occluders);
  const ShadowRayLight rays(light, occluders.frame.centre);
  const SheetMap map(sheets, boxOf(occluders), rays, texels);
  Random random(1);
  std::vector<SheetPoint> points;
  std::vector<glm::dvec3> truths;
  std::vector<double> cosines;
  const auto wayFrom = [&](const glm::dvec3& point)
  {
    const glm::dvec3 along(rays.toLight);
    const glm::dvec3 way = glm::dvec3(rays.position) - point;
    return rays.kind != LightKind::Directional ? way
      : rays.hasBox                            ? glm::dot(way, along) * along
                                               : 20.0 * along;
  };
  while (points.size() < 8000)
  {
    const glm::uvec3 triangle = occluders.triangles[random() % occluders.triangles.size()];
    const auto corner = [&](int i) { return glm::dvec3(occluders.positionsCentred[triangle[i]]); };
    const double u = std::sqrt(uniform(random, 0.0, 1.0));
    const double v = uniform(random, 0.0, 1.0);
    const glm::dvec3 point = (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
    glm::dvec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const glm::dvec3 toLight = wayFrom(point);
    if (rays.hasBox && glm::dot(toLight, glm::dvec3(rays.toLight)) < 0.01)
    {
      continue; // before its near face
    }
    normal = glm::dot(normal, toLight) < 0.0 ? -normal : normal;
    points.push_back({ glm::vec4(point, 1.0f), glm::vec4(normal, 0.0f) });
    cosines.push_back(glm::dot(normal, glm::normalize(toLight)));
    truths.push_back(
      sheets.transmittanceOf(glm::vec3(point + 1e-4 * normal), glm::vec3(toLight), 1.0f));
  }
  const std::vector<glm::vec4> found = sheetSharesAt(map, points);
  SheetErrors errors;
  double weights = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 off = glm::abs(glm::dvec3(found[i]) - truths[i]);
    const double most = std::max({ off.x, off.y, off.z });
    errors.mean += cosines[i] * most;
    errors.wrong += most > 0.02 ? cosines[i] : 0.0;
    errors.truth += cosines[i] * truths[i].x;
    weights += cosines[i];
  }
  return { errors.mean / weights, errors.wrong / weights, errors.truth / weights };
}

struct SheetLight
{
  const char* name;
  ShadowLight light;
};
const SheetLight sheetLights[] = { { "sun", directionalLight({ 0.3, -0.2, -1.0 }) },
  { "lamp", pointLight({ -1.0, 0.5, 6.0 }) }, { "within", pointLight({ 0.1, 0.05, 0.15 }) },
  { "box", boxLight({ 0.3, -0.2, -1.0 }, { 0.0, 0.0, 0.2 }, glm::dvec3(6.0)) } };

/// Sheets one behind the other: panes, or closed shells.
std::vector<Prop> makeNestedSheets(bool areShells, int sheets)
{
  std::vector<Prop> props;
  for (int i = 0; i < sheets; ++i)
  {
    if (areShells)
    {
      props.push_back({ makeSphere(48, 96), at(glm::dvec3(0.0), 1.0 - 0.13 * i) });
    }
    else
    {
      const glm::dmat4 turn =
        glm::rotate(at({ 0.1 * i, 0.0, 0.35 * i - 0.7 }), 0.1 * i - 0.2, { 1, 0.5, 0 });
      props.push_back({ makePlane(3.0, 6), turn });
    }
  }
  return props;
}

using SheetMapCase = std::tuple<int, double, int, bool>;
struct SheetMaps : GlslTestOf<SheetMapCase>
{
};

TEST_P(SheetMaps, HoldWhatRaysFindBeforeEachSheet)
{
  const auto [sheets, opacity, lightNumber, areShells] = GetParam();
  const ShadowLight& light = sheetLights[lightNumber].light;
  const Occluders occluders = makeSheets(
    makeNestedSheets(areShells, sheets), sheetOf(opacity, { 0.25f, 0.5f, 1.0f }, sheets == 2));
  const SheetErrors errors = compareAtPoints(occluders, light, 512);
  // A texel's last crossing stands for more of five shells' ten.
  const bool merges = areShells && sheets == 5;
  // The light begins at a texel's accuracy where its box cuts a shell.
  const bool isCut = light.box.has_value();
  EXPECT_LT(errors.mean, merges ? 0.008 : isCut ? 0.004 : 0.002);
  EXPECT_LT(errors.wrong, merges ? 0.12 : isCut ? 0.02 : 0.01);
  EXPECT_LT(errors.truth, sheets > 1 ? 1.0 - 0.15 * opacity : 1.0001);
}

TEST_F(GlslTest, SheetMapsOfMoreTexelsAreCloserToRays)
{
  const Occluders occluders = makeSheets(makeNestedSheets(true, 2));
  for (const SheetLight& of : { sheetLights[0], sheetLights[1] })
  {
    double last = 1.0;
    for (const int texels : { 32, 128, 512 })
    {
      const double mean = compareAtPoints(occluders, of.light, texels).mean;
      EXPECT_LT(mean, 0.5 * last) << of.name << ", " << texels;
      last = mean;
    }
  }
}

std::string nameOfSheets(const testing::TestParamInfo<SheetMapCase>& of)
{
  const auto [sheets, opacity, light, areShells] = of.param;
  return std::to_string(sheets) + (areShells ? "Shells" : "Panes") +
    std::to_string(static_cast<int>(10.0 * opacity)) + "By_" + sheetLights[light].name;
}

INSTANTIATE_TEST_SUITE_P(, SheetMaps,
  testing::Combine(testing::Values(1, 2, 5), testing::Values(0.1, 0.5, 0.9), testing::Range(0, 4),
    testing::Bool()),
  nameOfSheets);

} // namespace
} // namespace gnomon::test
