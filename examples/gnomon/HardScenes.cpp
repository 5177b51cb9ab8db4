#include "HardScenes.h"

#include "BuiltinParts.h"
#include "MeshBuilder.h"
#include "Vec3.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <cmath>

namespace gnomon::tool
{
namespace
{

constexpr Vec3 floorColor{ { 0.7, 0.7, 0.7 } };
constexpr Vec3 casterColor{ { 0.75, 0.5, 0.4 } };

Vec3 vec(double x, double y, double z)
{
  return { { x, y, z } };
}

/// Return separate triangles, from three corners each.
SceneModel makeTriangles(const std::string& name, const std::vector<Vec3>& corners)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    cells->InsertNextCell(3);
    for (std::size_t k = 0; k < 3; ++k)
    {
      cells->InsertCellPoint(points->InsertNextPoint(corners[i + k].data()));
    }
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return makeModel(name, surface, casterColor);
}

/// Return a parallelogram.
SceneModel makeSheet(const Vec3& corner, const Vec3& right, const Vec3& forward)
{
  const Vec3 far = corner + right + forward;
  return makeTriangles("sheet", { corner, corner + right, far, corner, far, corner + forward });
}

SceneModel makeBox(const Vec3& low, const Vec3& high)
{
  MeshBuilder mesh;
  mesh.addBox(low, high);
  return makeModel("box", mesh.build(), casterColor);
}

SceneModel makeBall(const Vec3& center, double radius, int slices = 32, int stacks = 16)
{
  MeshBuilder mesh;
  mesh.addSphere(center, radius, slices, stacks);
  return makeModel("ball", mesh.build(), casterColor);
}

SceneModel makeFloor(double halfSide, double height = 0.0)
{
  SceneModel floor = makePlane(vec(0.0, height, 0.0), 2.0 * halfSide);
  floor.name = "floor";
  return floor;
}

/// Return casters over a floor, under a sun from the upper left.
Scene overFloor(std::vector<SceneModel> casters, const Vec3& sun = { { 1.0, -1.5, -0.4 } })
{
  Scene scene;
  scene.models = std::move(casters);
  scene.models.push_back(makeFloor(4.0));
  scene.lights = { makeSun(sun) };
  scene.camera = makeCamera(vec(0.0, 7.0, 9.0), origin, 45.0);
  return scene;
}

std::vector<SceneModel> boxAndBall()
{
  return { makeBox(vec(-2.0, 0.5, -1.0), vec(-0.5, 2.0, 1.0)), makeBall(vec(1.5, 1.2, 0.0), 0.8) };
}

Scene underSun(const Vec3& sun)
{
  return overFloor(boxAndBall(), sun);
}

Scene underSpot(const Vec3& position, const Vec3& target, double coneAngleDegrees)
{
  Scene scene = overFloor(boxAndBall());
  SceneLight light;
  light.type = SceneLight::Type::Spot;
  light.position = position;
  light.target = target;
  light.coneAngleDegrees = coneAngleDegrees;
  scene.lights = { light };
  return scene;
}

Scene underLampAt(const Vec3& position)
{
  Scene scene = overFloor(boxAndBall());
  scene.lights = { makeLamp(position) };
  return scene;
}

/// Return the box and the ball, `unit` times as large and moved.
Scene scaled(double unit, const Vec3& offset)
{
  Scene scene = underSun(vec(1.0, -1.5, -0.4));
  for (SceneModel& model : scene.models)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      model.matrix[5 * i] = unit;
      model.matrix[4 * i + 3] = offset[i];
    }
  }
  scene.camera.position = unit * scene.camera.position + offset;
  scene.camera.target = unit * scene.camera.target + offset;
  return scene;
}

/// Return posts of about a texel's width, with decreasing gaps.
Scene makeThinPosts()
{
  std::vector<SceneModel> posts;
  for (int i = 0; i < 24; ++i)
  {
    const double x = -3.0 + 0.25 * i;
    const double half = 0.001 * (1 + i);
    posts.push_back(makeBox(vec(x - half, 0.0, -half), vec(x + half, 1.5, half)));
  }
  return overFloor(std::move(posts));
}

/// Return triangles thousands of times as long as high.
Scene makeSlivers()
{
  std::vector<Vec3> corners;
  for (int i = 0; i < 20; ++i)
  {
    const double z = -3.0 + 0.3 * i;
    corners.insert(
      corners.end(), { vec(-3.0, 1.0, z), vec(3.0, 1.001, z + 0.06), vec(3.0, 1.0, z + 1e-5 * i) });
  }
  return overFloor({ makeTriangles("slivers", corners) });
}

/// Return three sheets that share an edge, and a fourth that cuts them.
Scene makeFan()
{
  std::vector<SceneModel> sheets;
  for (int i = 0; i < 3; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * i / 3.0;
    sheets.push_back(makeSheet(
      vec(-1.5, 1.5, 0.0), vec(3.0, 0.0, 0.0), vec(0.0, std::cos(angle), std::sin(angle))));
  }
  sheets.push_back(makeSheet(vec(0.0, 0.2, -1.5), vec(0.0, 0.0, 3.0), vec(0.0, 2.5, 0.0)));
  return overFloor(std::move(sheets));
}

/// Return two equal sheets, one at a float's distance, and triangles without area.
Scene makeCoplanarSheets()
{
  const auto sheet = [](double height, double x)
  { return makeSheet(vec(x, height, -1.0), vec(1.6, 0.0, 0.0), vec(0.0, 0.0, 2.0)); };
  std::vector<SceneModel> sheets = { sheet(1.0, -2.0), sheet(1.0, -2.0), sheet(1.0, 0.5),
    sheet(1.0 + 1e-6, 0.5) };
  sheets.push_back(makeTriangles("without area",
    { vec(0.0, 1.5, 0.0), vec(1.0, 1.5, 0.0), vec(2.0, 1.5, 0.0), vec(0.0, 1.5, 1.0),
      vec(0.0, 1.5, 1.0), vec(0.0, 1.5, 2.0) }));
  return overFloor(std::move(sheets));
}

/// Return sheets that contain the sun's direction, so it sees them edge-on.
Scene makeEdgeOnSheets()
{
  std::vector<SceneModel> sheets;
  for (int i = 0; i < 7; ++i)
  {
    const double tilt = i < 4 ? 0.0 : std::pow(10.0, -i);
    sheets.push_back(
      makeSheet(vec(-3.0 + i, 0.0, -1.0), vec(1.0, -1.0 + tilt, 0.0), vec(0.0, 0.0, 2.0)));
    sheets.back().matrix[7] = 1.5;
  }
  return overFloor(std::move(sheets), vec(1.0, -1.0, 0.0));
}

/// Return a box that is open towards the sun, and one that is open towards the floor.
Scene makeOpenBoxes()
{
  std::vector<SceneModel> sides;
  for (int i = 0; i < 2; ++i)
  {
    const double x = -2.2 + 2.8 * i;
    const double height = 0.4 + 1.2 * i;
    sides.push_back(makeSheet(vec(x, height, -0.8), vec(1.6, 0.0, 0.0), vec(0.0, 0.0, 1.6)));
    sides.push_back(makeSheet(vec(x, 0.4, -0.8), vec(1.6, 0.0, 0.0), vec(0.0, 1.2, 0.0)));
    sides.push_back(makeSheet(vec(x, 0.4, 0.8), vec(1.6, 0.0, 0.0), vec(0.0, 1.2, 0.0)));
    sides.push_back(makeSheet(vec(x, 0.4, -0.8), vec(0.0, 0.0, 1.6), vec(0.0, 1.2, 0.0)));
    sides.push_back(makeSheet(vec(x + 1.6, 0.4, -0.8), vec(0.0, 0.0, 1.6), vec(0.0, 1.2, 0.0)));
  }
  return overFloor(std::move(sides));
}

/// Return stacked plates with decreasing gaps and sizes.
Scene makeStackedPlates()
{
  std::vector<SceneModel> plates;
  for (int i = 0; i < 6; ++i)
  {
    const double half = 2.0 - 0.3 * i;
    const double height = 0.05 * std::pow(2.0, i);
    plates.push_back(makeBox(vec(-half, height, -half), vec(half, height + 0.01 * (1 + i), half)));
  }
  return overFloor(std::move(plates));
}

/// Return walls in the sun's plane: parallel to it to the last bit, and nearly parallel.
Scene makeWallsAlongTheSun()
{
  return overFloor({ makeBox(vec(-2.0, 0.0, -1.0), vec(-1.0, 2.0, 1.0)),
                     makeSheet(vec(0.5, 0.0, -1.0), vec(0.0, 2.0, 0.0), vec(1e-5, 0.0, 2.0)) },
    vec(0.0, -1.0, -1.0));
}

/// Return a mirrored ball, and one flattened along an oblique axis.
Scene makeMirroredBalls()
{
  SceneModel mirrored = makeBall(vec(1.5, 1.0, 0.0), 0.8);
  mirrored.matrix[0] = -1.0;
  SceneModel flat = makeBall(vec(0.0, 0.0, 0.0), 0.8);
  flat.matrix = { { 1.0, 0.9, 0.0, 1.5, 0.0, 0.2, 0.3, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
    1.0 } };
  return overFloor({ mirrored, flat });
}

/// Return a lamp in a closed box, seen from inside.
Scene makeLampInBox()
{
  Scene scene;
  scene.models = { makeBox(vec(-2.0, 0.0, -2.0), vec(2.0, 3.0, 2.0)),
    makeBox(vec(-0.5, 0.0, -0.3), vec(0.3, 1.0, 0.5)) };
  scene.lights = { makeLamp(vec(0.7, 2.2, 0.4)) };
  scene.camera = makeCamera(vec(1.7, 1.8, 1.7), vec(-0.3, 0.6, -0.3), 70.0);
  return scene;
}

/// Return a scene in which the camera sees the sky, and a strip of floor at its lower edge.
Scene makeCameraThatLooksAway()
{
  Scene scene = underSun(vec(1.0, -1.5, -0.4));
  scene.camera = makeCamera(vec(0.0, 0.5, 3.5), vec(0.0, 2.4, 2.0), 60.0);
  return scene;
}

/// Return a scene whose caster is behind the camera.
Scene makeCasterBehindTheCamera()
{
  Scene scene =
    overFloor({ makeBox(vec(-0.3, 0.0, 5.0), vec(0.3, 8.0, 5.6)) }, vec(0.1, -1.0, -1.0));
  scene.models.back() = makeFloor(12.0);
  scene.camera = makeCamera(vec(0.0, 2.0, 4.0), vec(0.0, 0.0, -2.0), 50.0);
  return scene;
}

/// Return a scene without casters.
Scene makeNoCasters()
{
  Scene scene = overFloor({});
  return scene;
}

/// Return a ball of few facets with smooth shading.
Scene makeCoarseBall()
{
  return overFloor({ makeBall(vec(0.0, 1.2, 0.0), 1.0, 8, 4) });
}

/// Return a caster of a few millimetres on a floor of kilometres.
Scene makeSmallOnLarge()
{
  Scene scene = overFloor({ makeBox(vec(-0.2, 0.0, -0.2), vec(0.2, 0.4, 0.2)) });
  scene.models.back() = makeFloor(2e4);
  scene.camera = makeCamera(vec(0.0, 1.2, 1.6), origin, 45.0);
  return scene;
}

/// Return two one-sided sheets, one of which faces the sun, and two that cast with both sides.
Scene makeOneSidedSheets()
{
  std::vector<SceneModel> sheets;
  for (int i = 0; i < 4; ++i)
  {
    const Vec3 right = vec(1.2, 0.0, 0.0);
    const Vec3 forward = vec(0.0, 0.0, 1.6);
    const bool isFlipped = i % 2 == 1;
    const Vec3 corner = vec(-3.0 + 1.5 * i, 1.0, -0.8);
    sheets.push_back(makeSheet(corner, isFlipped ? forward : right, isFlipped ? right : forward));
    sheets.back().oneSided = i < 2;
  }
  return overFloor(std::move(sheets));
}

/// Return balls that VTK draws as impostors: on the floor, above it, and intersecting each other.
Scene makeImpostors()
{
  Scene scene = overFloor({});
  scene.props.push_back({ "balls",
    []() -> vtkSmartPointer<vtkProp3D>
    {
      vtkNew<vtkPoints> points;
      vtkNew<vtkCellArray> vertices;
      vtkNew<vtkFloatArray> radii;
      radii->SetName("radius");
      for (int i = 0; i < 6; ++i)
      {
        const float radius = 0.3f + 0.1f * static_cast<float>(i);
        const vtkIdType point =
          points->InsertNextPoint(-2.5 + 0.9 * i, i % 2 == 0 ? radius : 1.6, 0.3 * (i % 3));
        vertices->InsertNextCell(1, &point);
        radii->InsertNextValue(radius);
      }
      vtkNew<vtkPolyData> centres;
      centres->SetPoints(points);
      centres->SetVerts(vertices);
      centres->GetPointData()->AddArray(radii);
      vtkNew<vtkOpenGLSphereMapper> mapper;
      mapper->SetInputData(centres);
      mapper->SetScaleArray("radius");
      mapper->ScalarVisibilityOff();
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      return actor.Get();
    } });
  return scene;
}

/// Return a plain with objects up to its end, seen along it. Warps are strong here.
Scene makePlain()
{
  std::vector<SceneModel> boxes;
  for (const double z : { 94.0, 85.0, 70.0, 40.0, -10.0, -80.0 })
  {
    const double size = 0.1 * (104.0 - z);
    boxes.push_back(makeBox(vec(-size, 0.0, z), vec(0.0, 2.0 * size, z + size)));
  }
  Scene scene = overFloor(std::move(boxes), vec(1.0, -0.8, -0.3));
  scene.models.back() = makeFloor(100.0);
  scene.camera = makeCamera(vec(3.0, 2.0, 98.0), origin, 45.0);
  return scene;
}

Scene makeCameraInsideACaster()
{
  Scene scene = underSun(vec(1.0, -1.5, -0.4));
  scene.models.push_back(makeBox(vec(-3.0, 5.0, 8.0), vec(3.0, 9.0, 10.0)));
  return scene;
}

Scene makeOneTriangle()
{
  Scene scene = underSun(vec(1.0, -1.5, -0.4));
  scene.models = { makeTriangles(
    "triangle", { vec(-2.0, 0.0, 2.0), vec(2.0, 0.0, 2.0), vec(0.0, 0.0, -2.0) }) };
  return scene;
}

/// Return a lamp that touches a ball.
Scene makeLampOnBall()
{
  return underLampAt(vec(1.5, 2.0 + 1e-4, 0.0));
}

std::vector<HardScene> makeHardScenes()
{
  return {
    { { "hard-grazing-sun", "the sun is 5 degrees above the floor",
        [] { return underSun(vec(1.0, -0.0875, 0.2)); } },
      { "survey 7.12a", "survey 1", "survey 4", "apelles N8", "apelles N9", "montecarlo 5.3",
        "selective 5.2.4" } },
    { { "hard-walls-along-sun", "walls stand in the plane of the sun", makeWallsAlongTheSun },
      { "survey 7.12b", "selective 5.1.3", "crsm N10" } },
    { { "hard-huge", "a million times as large", [] { return scaled(1e6, origin); } },
      { "survey 7.12c", "apelles N5", "crsm N6" } },
    { { "hard-tiny", "a thousand times as small", [] { return scaled(1e-3, origin); } },
      { "survey 7.12d" } },
    { { "hard-far-away", "a million units from the origin",
        [] { return scaled(1.0, vec(1e6, -3e5, 7e5)); } },
      { "apelles N29", "apelles N16" } },
    { { "hard-camera-looks-away", "the camera sees only a strip of floor",
        makeCameraThatLooksAway },
      { "survey 7.12e", "apelles N22", "selective 5.2.9" } },
    { { "hard-lamp-in-box", "a lamp in a closed box", makeLampInBox },
      { "survey 7.12f", "survey 18", "montecarlo 5.16", "apelles N19" } },
    { { "hard-coplanar", "sheets in one plane, and triangles without area", makeCoplanarSheets },
      { "survey 7.12g", "montecarlo 5.15", "selective 5.2.7", "selective 5.2.10", "crsm N12" } },
    { { "hard-thin-posts", "posts of a texel and less", makeThinPosts },
      { "survey 7.12h", "survey 3", "apelles N12", "montecarlo 5.9", "montecarlo 5.7" } },
    { { "hard-sun-along-view", "the sun shines along the view",
        [] { return underSun(vec(0.0, -7.0, -9.0)); } },
      { "apelles N1" } },
    { { "hard-sun-against-view", "the sun shines against the view",
        [] { return underSun(vec(0.0, -0.7, 9.0)); } },
      { "apelles N23" } },
    { { "hard-sun-straight-down", "the sun shines along -y, the usual up vector",
        [] { return underSun(vec(0.0, -1.0, 0.0)); } },
      { "apelles N28" } },
    { { "hard-narrow-cone", "a spot light of a tenth of a degree",
        [] { return underSpot(vec(1.0, 900.0, 3.0), origin, 0.1); } },
      { "apelles N2", "apelles N14" } },
    { { "hard-wide-cone", "a spot light of 89 degrees",
        [] { return underSpot(vec(0.0, 4.0, 1.0), origin, 89.0); } },
      { "survey 16", "crsm N13" } },
    { { "hard-behind-light", "a spot light below objects that it does not light",
        [] { return underSpot(vec(0.0, 1.0, 0.0), vec(3.0, 0.0, 0.0), 50.0); } },
      { "apelles N10", "montecarlo 5.11", "montecarlo 5.13" } },
    { { "hard-lamp-on-ball", "a lamp that touches a ball", makeLampOnBall },
      { "apelles N7", "montecarlo 5.12" } },
    { { "hard-slivers", "triangles 6,000 times as long as high", makeSlivers },
      { "crsm N1", "crsm N3" } },
    { { "hard-edge-on", "sheets that the sun sees edge-on", makeEdgeOnSheets }, { "crsm N2" } },
    { { "hard-fan", "three sheets at one edge and one through them", makeFan },
      { "selective 5.2.10", "crsm N11" } },
    { { "hard-open-boxes", "boxes that are open towards the sun and the floor", makeOpenBoxes },
      { "apelles N13", "montecarlo 5.14", "selective 5.2.6", "apelles N26" } },
    { { "hard-stacked-plates", "stacked plates with decreasing gaps", makeStackedPlates },
      { "survey 8", "survey 2", "montecarlo 5.2", "apelles N27", "survey 9" } },
    { { "hard-mirrored", "a mirrored ball, and one flattened along an oblique axis",
        makeMirroredBalls },
      { "apelles N17" } },
    { { "hard-caster-behind-camera", "a pole behind the camera", makeCasterBehindTheCamera },
      { "survey 12" } },
    { { "hard-no-casters", "nothing blocks the light", makeNoCasters }, { "apelles N6" } },
    { { "hard-coarse-ball", "a ball of few facets with smooth shading", makeCoarseBall },
      { "apelles N11", "selective 5.2.3" } },
    { { "hard-small-on-large", "a box on a floor of forty kilometres", makeSmallOnLarge },
      { "crsm N8", "selective 5.2.2" } },
    { { "hard-sun-along-floor", "the sun shines along the floor",
        [] { return underSun(vec(1.0, 0.0, 0.0)); } },
      { "survey 1" } },
    { { "hard-camera-inside", "the camera is inside a caster", makeCameraInsideACaster },
      { "survey 7.12f" } },
    { { "hard-one-triangle", "one triangle and nothing else", makeOneTriangle }, { "apelles N6" } },
    { { "hard-plain", "a plain with objects, seen along it", makePlain }, { "apelles N1" } },
    { { "hard-one-sided", "sheets that cast with one side only, and with both",
        makeOneSidedSheets },
      { "selective 5.2.6" } },
    { { "hard-impostors", "balls that VTK draws without triangles", makeImpostors },
      { "apelles N13" } },
    { { "hard-wide-lamp", "stack under a lamp of three times its size",
        []
        {
          Scene scene = underLamp(makeStackScene(), 6.0);
          for (SceneLight& light : scene.lights)
          {
            light.area->width *= 6.0;
            light.area->height *= 6.0;
          }
          return scene;
        } },
      { "montecarlo 5.6", "survey 13", "survey 14", "apelles N20", "apelles N21" } },
    { { "hard-soft-long-box", "a long box that hovers under a lamp",
        [] { return underLamp(makeLongCubeScene(), 14.0); } },
      { "montecarlo 5.10", "montecarlo 5.1", "montecarlo 5.4", "montecarlo 5.8", "apelles N3" } },
  };
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<HardScene>& hardScenes()
{
  static const std::vector<HardScene> scenes = makeHardScenes();
  return scenes;
}

//------------------------------------------------------------------------------
const std::vector<HardCaseElsewhere>& hardCasesElsewhere()
{
  static const std::vector<HardCaseElsewhere> cases = {
    { "apelles N4", "no map has signed depth" },
    { "apelles N15", "VTK shades" },
    { "apelles N18", "Penumbras.areThoseOfGeometry" },
    { "apelles N24", "ReceiverFitTest.boundsMatchBruteForceOnImagesOfAnySize" },
    { "apelles N25", "TextureMemoryTest.cpp" },
    { "crsm N4", "PublishedMap.erodesTrianglesAsTheirNeighboursSay" },
    { "crsm N5", "TexelCells.areThoseThatATriangleMeetsAndContainsAndHardlyMore" },
    { "crsm N7", "TexelCells.boundTheDepthsThatATriangleHasInThem" },
    { "crsm N9", "all techniques of a frame have one tracer" },
    { "crsm N14", "RandomCells.areThoseOfShapesOneByOne" },
    { "crsm N15", "RandomCells.areThoseOfShapesOneByOne" },
    { "montecarlo 5.5", "MonteCarloGlsl.searchesAsAWalkFromTexelToTexel" },
    { "selective 5.1.1", "maps hold both faces" },
    { "selective 5.1.2", "ShadowRay.FacingIsAMatterOfMoreThanRounding" },
    { "selective 5.1.4", "DepthMap.slopeBiasIsAFactorOnWhatASlopeSpans" },
    { "selective 5.1.5", "the movements among the rows" },
    { "selective 5.1.6", "Embree intersects" },
    { "selective 5.1.7", "PlaneNoise.BoundsWhatRoundingDoes" },
    { "selective 5.2.1", "all techniques of a frame have one tracer" },
    { "selective 5.2.5", "DepthMap.slopeBiasIsAFactorOnWhatASlopeSpans" },
    { "selective 5.2.8", "Chain.withoutCoherenceIsNeverWrong" },
    { "selective 5.2.11", "TriangleMap.hasTheFirstTriangleAtEveryTexelsCentre" },
    { "selective 5.2.12", "TriangleMap.hasTheFirstTriangleAtEveryTexelsCentre" },
    { "survey 5", "KernelShapeGlsl.aBoxOfAnyWidthHasOneLevelMoreThanTaps" },
    { "survey 6", "AdaptiveGlsl.theRingIsBlindToAHoleThatTheExactEarlyOutSees" },
    { "survey 7", "AdaptiveGlsl.theNoiseRepeatsAfterAsManyCellsAsThereAreDiscs" },
    { "survey 10", "MomentsGlsl.filterAsASquareAroundThePlaceDoes" },
    { "survey 11", "the movements among the rows" },
    { "survey 15", "Planar.shadowsEndWhereTheirReceiverEnds" },
    { "survey 17", "pages state milliseconds" },
  };
  return cases;
}

} // namespace gnomon::tool
