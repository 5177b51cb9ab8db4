// Impostor mappers: their spheres and sticks cast and receive with their visible shape.

#include "PassScene.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkMolecule.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLMoleculeMapper.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkOpenGLStickMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointGaussianMapper.h>
#include <vtkUnsignedCharArray.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

struct Ball
{
  glm::dvec3 centre;
  double radius;

  /// Return the distance from the surface, negative inside.
  double off(const glm::dvec3& at) const { return glm::distance(at, this->centre) - this->radius; }
};

struct Stick
{
  glm::dvec3 centre, axis;
  double length, radius;

  double off(const glm::dvec3& at) const
  {
    const glm::dvec3 from = at - this->centre;
    const double along = glm::dot(from, this->axis);
    const glm::dvec2 beyond(
      glm::length(from - along * this->axis) - this->radius, std::abs(along) - 0.5 * this->length);
    return std::min(std::max(beyond.x, beyond.y), 0.0) + glm::length(glm::max(beyond, 0.0));
  }
};

vtkFloatArray* addArray(vtkPolyData* data, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  data->GetPointData()->AddArray(array);
  return array;
}

/// Give each point a colour. Without them VTK's sticks crash.
void whiten(vtkPolyData* data)
{
  vtkNew<vtkUnsignedCharArray> white;
  white->SetNumberOfComponents(3);
  white->SetNumberOfTuples(data->GetNumberOfPoints());
  white->Fill(255.0);
  data->GetPointData()->SetScalars(white);
}

/// Add a point with a vertex: VTK takes a mapper's bounds from cells, and draws nothing without.
void addPoint(vtkPolyData* data, const glm::dvec3& position)
{
  const vtkIdType point = data->GetPoints()->InsertNextPoint(&position.x);
  data->GetVerts()->InsertNextCell(1, &point);
}

/// Balls and sticks above a floor, at random places.
class SolidsScene : public PassScene
{
public:
  static constexpr double floorSize = 12.0;

  explicit SolidsScene(int seed = 1, int count = 40, int side = 240)
    : PassScene(side, side)
  {
    this->addFloor(floorSize);
    std::mt19937 random(static_cast<unsigned int>(seed));
    const auto uniform = [&](double lower, double upper)
    { return std::uniform_real_distribution<double>(lower, upper)(random); };
    const auto round = [](double value) { return static_cast<double>(static_cast<float>(value)); };
    const auto place = [&]
    { return glm::dvec3(round(uniform(-5, 5)), round(uniform(-5, 5)), round(uniform(0.2, 4))); };
    for (vtkPolyData* data : { this->ballData.Get(), this->stickData.Get() })
    {
      data->SetPoints(vtkNew<vtkPoints>());
      data->SetVerts(vtkNew<vtkCellArray>());
    }
    this->radii = addArray(this->ballData, "radii", 1);
    vtkFloatArray* sizes = addArray(this->stickData, "sizes", 3);
    vtkFloatArray* axes = addArray(this->stickData, "axes", 3);
    for (int i = 0; i < count; ++i)
    {
      const Ball ball{ place(), round(std::exp2(uniform(-3.0, 0.0))) };
      addPoint(this->ballData, ball.centre);
      this->radii->InsertNextTuple1(ball.radius);
      this->balls.push_back(ball);
      const Stick stick{ place(),
        glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))),
        round(uniform(0.3, 3.0)), round(std::exp2(uniform(-4.0, -1.0))) };
      addPoint(this->stickData, stick.centre);
      sizes->InsertNextTuple3(stick.length, stick.radius, 0.0);
      axes->InsertNextTuple3(stick.axis.x, stick.axis.y, stick.axis.z);
      this->sticks.push_back(stick);
    }
    whiten(this->stickData);
    this->ballMapper->SetInputData(this->ballData);
    this->ballMapper->SetScaleArray("radii");
    this->ballActor->SetMapper(this->ballMapper);
    this->stickMapper->SetInputData(this->stickData);
    this->stickMapper->SetScaleArray("sizes");
    this->stickMapper->SetOrientationArray("axes");
    this->stickActor->SetMapper(this->stickMapper);
    this->renderer->AddActor(this->ballActor);
    this->renderer->AddActor(this->stickActor);
    this->lookFrom({ 6.0, -9.0, 8.0 }, { 0.0, 0.0, 1.0 });
    this->choose(tracedWay);
  }

  /// Return the distance from the solids.
  double off(const glm::dvec3& at) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : this->balls)
    {
      least = std::min(least, ball.off(at));
    }
    for (const Stick& stick : this->sticks)
    {
      least = std::min(least, stick.off(at));
    }
    return least;
  }
  /// Return the normal of the nearest surface.
  glm::dvec3 normal(const glm::dvec3& at) const
  {
    const glm::dvec3 x(1e-5, 0.0, 0.0), y(0.0, 1e-5, 0.0), z(0.0, 0.0, 1e-5);
    return at.z < this->off(at)
      ? glm::dvec3(0.0, 0.0, 1.0)
      : glm::normalize(glm::dvec3(this->off(at + x) - this->off(at - x),
          this->off(at + y) - this->off(at - y), this->off(at + z) - this->off(at - z)));
  }
  /// Return the least distance from the solids on the way to a light, over the way so far; negative
  /// if it leads through them.
  double clearance(
    const glm::dvec3& from, const glm::dvec3& normal, const glm::dvec3& toLight, double end) const
  {
    double least = 1.0;
    for (double along = 1e-3; along < end;)
    {
      const double off = this->off(from + 1e-3 * normal + along * toLight);
      least = std::min(least, off / along);
      along += std::max(std::abs(off), 1e-3);
    }
    return least;
  }

  std::vector<Ball> balls;
  std::vector<Stick> sticks;
  vtkNew<vtkPolyData> ballData, stickData;
  vtkFloatArray* radii = nullptr;
  vtkNew<vtkOpenGLSphereMapper> ballMapper;
  vtkNew<vtkOpenGLStickMapper> stickMapper;
  vtkNew<vtkActor> ballActor, stickActor;
};

/// Compare the frame after each change with that of a pass without earlier frames.
std::vector<float> expectFresh(PassScene& scene)
{
  const std::vector<float> seen = drawKept(scene).visibility[0];
  EXPECT_EQ(scene.drawAnew().visibility[0], seen);
  return seen;
}

using SolidsTest = PassTest;

} // namespace

TEST_F(SolidsTest, agreeWithClosedForms)
{
  for (const bool parallel : { false, true })
  {
    for (const bool sun : { true, false })
    {
      SCOPED_TRACE(testing::Message() << parallel << sun);
      SolidsScene scene(sun ? 1 : 2);
      vtkLight* light =
        sun ? scene.addSun({ 0.5, 0.3, -1.0 }) : scene.addSpot({ 3, 4, 9 }, { 0, 0, 0 }, 80.0);
      scene.renderer->GetActiveCamera()->SetParallelProjection(parallel);
      scene.renderer->GetActiveCamera()->SetParallelScale(5.0);
      const VisibilityImages& kept = drawKept(scene);
      EXPECT_EQ(scene.report().instances, 80u);
      EXPECT_THAT(scene.report().notes, testing::IsEmpty());
      const glm::dvec3 place = glm::make_vec3(light->GetPosition());
      std::size_t dark = 0;
      std::size_t wrong = 0;
      const std::size_t certain = countPixels(kept,
        [&](std::size_t i)
        {
          if (kept.coverage[i] == 0.0f)
          {
            return false;
          }
          const glm::dvec3 at = positionOf(kept, i);
          EXPECT_LT(std::min(std::abs(at.z), std::abs(scene.off(at))), 1e-3) << "no surface";
          const glm::dvec3 normal = scene.normal(at);
          const glm::dvec3 way = sun ? place : place - at;
          const double cosine = glm::dot(normal, glm::normalize(way));
          const double clear =
            scene.clearance(at, normal, glm::normalize(way), sun ? 20.0 : glm::length(way));
          if (glm::dot(normal, normalOf(kept, i)) < 0.999 || std::abs(cosine) < 1e-2 ||
            std::abs(clear) < 2e-2)
          {
            return false; // at a rim or a shadow's edge
          }
          const bool isDark = cosine < 0.0 || clear < 0.0;
          dark += isDark ? 1 : 0;
          wrong += kept.visibility[0][i] != (isDark ? 0.0f : 1.0f) ? 1 : 0;
          return true;
        });
      EXPECT_GT(certain, 50000u);
      EXPECT_GT(dark, 8000u);
      EXPECT_EQ(wrong, 0u);
    }
  }
}

/// A map of triangles alone would miss the solids.
TEST_F(SolidsTest, conservativeMapsAreNotAsked)
{
  SolidsScene scene(3);
  scene.addSun({ 0.5, 0.3, -1.0 });
  const std::vector<float> truth = scene.visibilityBy("raytraced");
  EXPECT_EQ(scene.visibilityBy("crsm"), truth);
  EXPECT_EQ(scene.report().mapBakes, 0);
  EXPECT_THAT(scene.report().lights[0].mapReason, testing::HasSubstr("spheres or cylinders"));
  scene.ballActor->VisibilityOff();
  scene.stickActor->VisibilityOff();
  scene.addBox({ -1.0, -1.0, 1.0 }, { 1.0, 1.0, 2.0 });
  scene.render();
  EXPECT_EQ(scene.report().mapBakes, 1);
}

/// A map holds meshes inside the solids, so no solid shadows itself.
TEST_F(SolidsTest, mapsShowThemWithoutAcne)
{
  SolidsScene scene(6, 1);
  scene.ballData->GetPoints()->SetPoint(0, -1.5, 0.0, 2.0);
  scene.radii->SetTuple1(0, 1.0);
  scene.stickData->GetPoints()->SetPoint(0, 1.5, 0.0, 2.0);
  scene.stickData->GetPointData()->GetArray("sizes")->SetTuple3(0, 2.0, 0.5, 0.0);
  scene.stickData->GetPointData()->GetArray("axes")->SetTuple3(0, 0.6, 0.0, 0.8);
  vtkLight* light = scene.addSun({ 0.5, 0.3, -1.0 });
  scene.lookFrom({ 1.0, -5.0, 8.0 }, { 0.0, 0.0, 1.5 });
  const std::vector<float> truth = scene.visibilityBy("raytraced");
  EXPECT_GT(std::count(truth.begin(), truth.end(), 0.0f), 3000);
  for (const char* technique : { "nsm", "pcf", "vsm", "pssm", "selective", "montecarlo" })
  {
    SCOPED_TRACE(technique);
    const VisibilityImages& kept = drawKept(scene, technique);
    const auto isDarkSolid = [&](std::size_t i)
    {
      return positionOf(kept, i).z > 0.5 && cosineTowards(kept, i, light) > 0.05 &&
        kept.visibility[0][i] < 0.5f;
    };
    EXPECT_EQ(countPixels(kept, isDarkSolid), 0u);
    EXPECT_LT(countDifferences(kept.visibility[0], truth, 0.5), truth.size() / 100);
  }
}

/// While the picture moves, `auto` takes a map, or few samples of an area light. These are probed
/// on the solids, too: without the floor there is nothing else.
TEST_F(SolidsTest, movingPicturesAreProbedOnSolids)
{
  for (const bool hasFloor : { true, false })
  {
    SolidsScene scene(8, 10);
    scene.addSun({ 0.5, 0.3, -1.0 });
    scene.floor()->SetVisibility(hasFloor);
    scene.choose({ "auto", vtkGnomonShadowPass::ROUTE_AUTO });
    scene.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    scene.render();
    EXPECT_GT(scene.report().probes, 300) << hasFloor;
    EXPECT_TRUE(!hasFloor || scene.report().lights[0].technique == "nsm") << scene.report().choice;
    scene.render("light_radius=10");
    EXPECT_GT(scene.report().lights[0].lightSamples, 1) << "if no probe finds a shadow";
    EXPECT_LT(scene.report().lights[0].lightSamples, 64);
  }
}

/// A pass with earlier frames shows the same as a new one.
TEST_F(SolidsTest, changesAreSeen)
{
  SolidsScene scene(8);
  scene.addSun({ 0.5, 0.3, -1.0 });
  std::vector<float> before = drawKept(scene).visibility[0];
  const auto expectChange = [&](const char* what)
  {
    SCOPED_TRACE(what);
    const std::vector<float> after = expectFresh(scene);
    EXPECT_NE(after, before);
    before = after;
  };
  scene.radii->SetValue(3, 1.5f);
  scene.radii->Modified();
  expectChange("a radius");
  scene.ballData->GetPoints()->SetPoint(5, 0.0, 0.0, 5.0);
  scene.ballData->GetPoints()->Modified();
  expectChange("a place");
  scene.stickActor->SetPosition(0.5, 0.2, 0.3);
  expectChange("a prop's place");
  EXPECT_EQ(scene.report().bvhRefits, 1);
  scene.stickActor->RotateZ(40.0);
  expectChange("a prop's turn");
  scene.ballActor->SetScale(1.2); // moves balls apart without resizing them, as VTK does
  expectChange("a scale");
  scene.ballMapper->SetScaleArray(nullptr);
  scene.ballMapper->SetRadius(0.4f);
  expectChange("one radius for all");
  addPoint(scene.ballData, { 0.0, 0.0, 3.0 });
  scene.ballData->GetPoints()->Modified();
  expectChange("another one");
  scene.stickActor->VisibilityOff();
  expectChange("fewer");
}

TEST_F(SolidsTest, atomsAndBondsCast)
{
  PassScene scene(200, 200);
  scene.addFloor(8.0, -2.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  vtkNew<vtkMolecule> molecule;
  const vtkAtom carbon = molecule->AppendAtom(6, -2.0, 0.0, 0.0);
  molecule->AppendBond(carbon, molecule->AppendAtom(8, 2.0, 0.0, 0.0), 1);
  vtkNew<vtkOpenGLMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->UseBallAndStickSettings();
  scene.add(mapper);
  // From the side, so the molecule hides none of its shadow.
  scene.lookFrom({ 0.0, -9.0, 2.0 }, { 0.0, 0.0, -2.0 });
  const auto inShadow = [&]
  {
    const VisibilityImages& kept = drawKept(scene, "raytraced");
    return countPixels(kept,
      [&](std::size_t i) { return positionOf(kept, i).z < -1.9 && kept.visibility[0][i] == 0.0f; });
  };
  const std::size_t all = inShadow();
  mapper->RenderBondsOff();
  const std::size_t atoms = inShadow();
  mapper->RenderBondsOn();
  mapper->RenderAtomsOff();
  const std::size_t bonds = inShadow();
  EXPECT_GT(atoms, 50u);
  EXPECT_GT(bonds, 50u);
  EXPECT_GT(all, std::max(atoms, bonds));
  EXPECT_LE(all, atoms + bonds);
}

namespace
{

/// Points on a ring and a line through them, over a floor.
class RingScene : public PassScene
{
public:
  static constexpr float pointSize = 14.0f; // pixels
  static constexpr float lineWidth = 8.0f;
  static constexpr double height = 1.5;

  explicit RingScene(int points = 60)
    : PassScene(300, 300)
  {
    this->addFloor(12.0);
    this->sun = this->addSun({ 0.4, 0.2, -1.0 });
    this->data->SetPoints(vtkNew<vtkPoints>());
    this->data->SetVerts(vtkNew<vtkCellArray>());
    this->data->SetLines(vtkNew<vtkCellArray>());
    this->data->GetLines()->InsertNextCell(points + 1);
    for (int i = 0; i < points; ++i)
    {
      const double angle = glm::two_pi<double>() * i / points;
      addPoint(this->data, { 3.0 * std::cos(angle), 3.0 * std::sin(angle), height });
      this->data->GetLines()->InsertCellPoint(i);
    }
    this->data->GetLines()->InsertCellPoint(0);
    this->actor = this->add(this->data);
    this->actor->GetProperty()->SetPointSize(pointSize);
    this->actor->GetProperty()->SetLineWidth(lineWidth);
    this->lookFrom({ 1.0, -9.0, 7.0 }, { 0.5, 0.0, 0.5 });
    this->pass->SetTechnique("raytraced");
  }

  void showPoints() { this->actor->GetProperty()->RenderPointsAsSpheresOn(); }
  void showTubes() { this->actor->GetProperty()->RenderLinesAsTubesOn(); }
  /// Show splats with discs, which look like spheres.
  void showSplats(vtkDataObject* input)
  {
    vtkNew<vtkPointGaussianMapper> mapper;
    mapper->SetInputDataObject(input);
    mapper->EmissiveOff();
    mapper->SetScaleFactor(0.5);
    mapper->SetScaleArray("sizes");
    mapper->SetScaleArrayComponent(1);
    mapper->SetSplatShaderCode("//VTK::Color::Impl\n"
                               "if (length(offsetVCVSOutput.xy) > 1.0) { discard; }\n");
    this->splats = mapper;
    this->actor->SetMapper(mapper);
  }
  /// Return the world size of half of `pixels` at a point.
  double radiusAt(const glm::dvec3& point, double pixels)
  {
    vtkCamera* camera = this->renderer->GetActiveCamera();
    const double depth = glm::dot(point - glm::make_vec3(camera->GetPosition()),
      glm::make_vec3(camera->GetDirectionOfProjection()));
    const double halfHeight = camera->GetParallelProjection()
      ? camera->GetParallelScale()
      : depth * std::tan(glm::radians(0.5 * camera->GetViewAngle()));
    return pixels * halfHeight / 300.0;
  }

  vtkNew<vtkPolyData> data;
  vtkSmartPointer<vtkPointGaussianMapper> splats;
  vtkActor* actor;
  vtkLight* sun;
};

/// The shadows of two pictures where both show the floor.
struct FloorDifference
{
  std::size_t dark = 0;
  std::size_t different = 0;
};

FloorDifference differenceOnFloor(const VisibilityImages& a, const VisibilityImages& b)
{
  const auto isFloor = [&](std::size_t i)
  { return positionOf(a, i).z < 0.1 && positionOf(b, i).z < 0.1; };
  const std::vector<float>& inA = a.visibility[0];
  const std::vector<float>& inB = b.visibility[0];
  return { countPixels(a, [&](std::size_t i) { return isFloor(i) && inA[i] == 0.0f; }),
    countPixels(a, [&](std::size_t i) { return isFloor(i) && inA[i] != inB[i]; }) };
}

/// Draw the same points as spheres, of radii by the points' numbers.
template <typename RadiusOf>
VisibilityImages drawAsSpheres(RingScene& scene, const RadiusOf& radiusOf)
{
  vtkFloatArray* array = addArray(scene.data, "radii", 1);
  for (vtkIdType i = 0; i < scene.data->GetNumberOfPoints(); ++i)
  {
    array->InsertNextTuple1(radiusOf(i));
  }
  vtkNew<vtkOpenGLSphereMapper> spheres;
  spheres->SetInputData(scene.data);
  spheres->SetScaleArray("radii");
  scene.actor->SetMapper(spheres);
  return drawKept(scene);
}

void expectAllServed(const PassScene& scene, std::size_t instances)
{
  EXPECT_EQ(scene.report().instances, instances);
  EXPECT_THAT(scene.report().notes, testing::IsEmpty());
}

} // namespace

TEST_F(SolidsTest, pointsAsSpheresCastAsSpheres)
{
  for (const bool parallel : { false, true })
  {
    SCOPED_TRACE(parallel);
    RingScene scene;
    scene.showPoints();
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel);
    scene.renderer->GetActiveCamera()->SetParallelScale(5.0);
    const VisibilityImages points = drawKept(scene);
    expectAllServed(scene, 60);
    const auto radiusOf = [&](vtkIdType i)
    { return scene.radiusAt(glm::make_vec3(scene.data->GetPoint(i)), scene.pointSize); };
    const FloorDifference difference = differenceOnFloor(drawAsSpheres(scene, radiusOf), points);
    EXPECT_GT(difference.dark, 1000u);
    EXPECT_LE(difference.different, 5u); // outlines, to within a rounding of the radius
  }
}

/// A mapper of composite data, as ParaView's, draws the same spheres and tubes of each block.
TEST_F(SolidsTest, pixelSizedSolidsOfBlocksAreThoseOfTheirData)
{
  RingScene scene;
  scene.showPoints();
  scene.showTubes();
  const std::vector<float> truth = drawKept(scene).visibility[0];
  vtkNew<gnomon::SharedBlocksMapper> mapper;
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  mapper->SetInputDataObject(blocksOf({ scene.data, vtkNew<vtkPolyData>() }));
  scene.actor->SetMapper(mapper);
  EXPECT_LE(countDifferences(drawKept(scene).visibility[0], truth), 5u); // outlines
  expectAllServed(scene, 120);
  EXPECT_GT(std::count(truth.begin(), truth.end(), 0.0f), 1000);
}

/// Their shadows on the floor are as wide as the tubes look, all along.
TEST_F(SolidsTest, linesAsTubesCastAsTubes)
{
  RingScene scene;
  scene.showTubes();
  scene.lookDown(5.0);
  const VisibilityImages& kept = drawKept(scene);
  expectAllServed(scene, 60);
  const double radius = scene.radiusAt(glm::dvec3(0.0), scene.lineWidth);
  /// Return the distance from the ring that shades a pixel, in radii; none near the shadow's edge.
  const auto off = [&](std::size_t i)
  {
    // A tube is about as wide along the light, which is nearly upright, as across.
    const glm::dvec3 at = positionOf(kept, i);
    const glm::dvec2 lifted = glm::dvec2(at) - glm::dvec2(0.4, 0.2) * RingScene::height;
    const double radii = std::abs(glm::length(lifted) - 3.0) / radius;
    return at.z < 0.1 && (radii < 0.9 || radii > 1.25) ? radii : std::nan("");
  };
  const std::size_t dark = countPixels(kept, [&](std::size_t i) { return off(i) < 1.0; });
  const std::size_t wrong = countPixels(kept,
    [&](std::size_t i)
    {
      return off(i) < 1.0 ? kept.visibility[0][i] != 0.0f
                          : off(i) > 1.0 && kept.visibility[0][i] != 1.0f;
    });
  EXPECT_GT(dark, 2000u);
  EXPECT_EQ(wrong, 0u);
}

/// Tubes and points are darkened neither by themselves nor by the next part of a bent line.
TEST_F(SolidsTest, pixelSizedSolidsHaveNoSpecks)
{
  for (const bool tubes : { false, true })
  {
    RingScene scene;
    tubes ? scene.showTubes() : scene.showPoints();
    for (const char* technique : { "raytraced", "nsm", "silhouette" })
    {
      SCOPED_TRACE(testing::Message() << tubes << technique);
      const VisibilityImages& kept = drawKept(scene, technique);
      const auto faces = [&](std::size_t i)
      { return positionOf(kept, i).z > 0.5 && cosineTowards(kept, i, scene.sun) > 0.02; };
      const auto isDark = [&](std::size_t i) { return faces(i) && kept.visibility[0][i] < 0.5f; };
      const std::size_t facing = countPixels(kept, faces);
      const std::size_t dark = countPixels(kept, isDark);
      EXPECT_GT(facing, 1000u);
      // Neighbouring spheres shadow each other. At bends, a map cannot tell a tube from the next.
      const bool none = tubes && technique != std::string("nsm");
      EXPECT_LE(dark, none ? 0u : facing / 10);
    }
  }
}

TEST_F(SolidsTest, pixelSizedSolidsFollowTheCamera)
{
  RingScene scene;
  scene.showPoints();
  scene.showTubes();
  expectFresh(scene);
  scene.lookFrom({ 4.0, -3.0, 3.0 });
  expectFresh(scene);
  scene.render();
  EXPECT_EQ(scene.report().surfacesExtracted, 0);
  scene.lookFrom({ 0.5, 0.0, 1.6 }, { 3.0, 0.5, 1.5 }); // some of them are behind the camera
  expectFresh(scene);
  scene.actor->GetProperty()->SetPointSize(30.0f);
  expectFresh(scene);
  scene.actor->GetProperty()->RenderLinesAsTubesOff();
  expectFresh(scene);
  scene.window->SetSize(200, 260);
  expectFresh(scene);
}

/// Solids of both sizes, with one sample per pixel and several: both routes show the same, and all
/// is dark in another prop's shadow, to its outline.
TEST_F(SolidsTest, bothRoutesAgree)
{
  SolidsScene solids(7);
  solids.addSun({ 0.5, 0.3, -1.0 });
  RingScene ring;
  ring.showPoints();
  ring.showTubes();
  for (PassScene* scene : { static_cast<PassScene*>(&solids), static_cast<PassScene*>(&ring) })
  {
    vtkActor* lid = scene->addBox({ -60.0, -60.0, 30.0 }, { 60.0, 60.0, 31.0 });
    for (const auto& [technique, samples] : { std::pair("nsm", 0), { "pcf", 0 }, { "nsm", 4 } })
    {
      SCOPED_TRACE(std::string(technique) + " " + std::to_string(samples));
      scene->window->SetMultiSamples(samples);
      lid->VisibilityOff();
      scene->choose({ technique, vtkGnomonShadowPass::ROUTE_INLINE });
      const Picture within = scene->render();
      scene->choose({ technique, vtkGnomonShadowPass::ROUTE_IMAGE });
      const Picture fetched = scene->render();
      EXPECT_TRUE(samples > 0 || differingPixels(within, fetched, 2) <= within.pixels() / 5000);
      EXPECT_GT(*std::max_element(fetched.rgb.begin(), fetched.rgb.end()), 200);
      lid->VisibilityOn();
      for (const Way& way : { Way{ technique, vtkGnomonShadowPass::ROUTE_IMAGE },
             Way{ technique, vtkGnomonShadowPass::ROUTE_INLINE }, tracedWay })
      {
        scene->choose(way);
        const Picture dark = scene->render();
        EXPECT_EQ(*std::max_element(dark.rgb.begin(), dark.rgb.end()), 0) << way;
      }
    }
  }
}

/// Sized by one component of an array, by a function of it, and block by block.
TEST_F(SolidsTest, splatsWithDiscsCastAsSpheres)
{
  RingScene scene(40);
  scene.actor->SetPosition(0.1, 0.2, 0.3);
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("sizes");
  sizes->SetNumberOfComponents(2);
  const int count = static_cast<int>(scene.data->GetNumberOfPoints());
  for (int i = 0; i < count; ++i)
  {
    sizes->InsertNextTuple2(0.0, 0.2 + 0.6 * i / count);
  }
  scene.data->GetPointData()->AddArray(sizes);
  const auto expectSpheres = [&](const auto& radiusOf)
  {
    const VisibilityImages drawn = drawKept(scene);
    EXPECT_THAT(scene.report().notes, testing::IsEmpty());
    const VisibilityImages truth =
      drawAsSpheres(scene, [&](vtkIdType i) { return radiusOf(sizes->GetComponent(i, 1)); });
    const FloorDifference difference = differenceOnFloor(truth, drawn);
    EXPECT_GT(difference.dark, 1000u);
    EXPECT_EQ(difference.different, 0u);
    scene.actor->SetMapper(scene.splats);
  };
  scene.showSplats(scene.data);
  expectSpheres([](double size) { return 0.5 * size; });

  vtkNew<vtkPiecewiseFunction> function;
  function->AddPoint(0.4, 1.0);
  function->AddPoint(0.6, 0.5);
  scene.splats->SetScaleFunction(function);
  const auto byFunction = [](double last)
  {
    return [last](double size)
    {
      return 0.5 *
        glm::clamp(
          glm::mix(1.0, last, (size - 0.4) / 0.2), std::min(1.0, last), std::max(1.0, last));
    };
  };
  expectSpheres(byFunction(0.5));
  drawKept(scene);
  function->RemovePoint(0.6);
  function->AddPoint(0.6, 0.2); // without notice to the mapper
  expectFresh(scene);
  expectSpheres(byFunction(0.2));

  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const int first : { 0, 1 })
  {
    // Vertex cells choose points, each point three times. From VTK 9.4 on, VTK writes a size for
    // each point into an array with room for one per vertex.
    vtkNew<vtkPolyData> half;
    half->ShallowCopy(scene.data);
    half->SetVerts(vtkNew<vtkCellArray>());
    for (vtkIdType i = first; i < count; i += 2)
    {
      for (int time = 0; time < 3; ++time)
      {
        half->GetVerts()->InsertNextCell(1, &i);
      }
    }
    blocks->SetBlock(first, half);
  }
  scene.showSplats(blocks);
  expectSpheres([](double size) { return 0.5 * size; });

  vtkNew<vtkPolyData> bare; // without vertex cells, all points are drawn
  bare->ShallowCopy(scene.data);
  bare->SetVerts(nullptr);
  scene.showSplats(bare);
  expectSpheres([](double size) { return 0.5 * size; });
}

/// VTK draws solids and splats alike in all representations.
TEST_F(SolidsTest, castAlikeInAllRepresentations)
{
  RingScene scene(40);
  vtkNew<vtkOpenGLSphereMapper> spheres;
  spheres->SetInputData(scene.data);
  spheres->SetRadius(0.5);
  vtkNew<vtkOpenGLStickMapper> sticks;
  sticks->SetInputData(scene.data);
  vtkFloatArray* const along = addArray(scene.data, "along", 3);
  vtkFloatArray* const size = addArray(scene.data, "size", 3);
  for (vtkIdType i = 0; i < scene.data->GetNumberOfPoints(); ++i)
  {
    along->InsertTuple3(i, 0.3, 0.2, 1.0);
    size->InsertTuple3(i, 1.0, 0.3, 0.0);
  }
  sticks->SetOrientationArray("along");
  sticks->SetScaleArray("size");
  scene.showSplats(scene.data);
  scene.splats->SetScaleArray(nullptr);
  whiten(scene.data);
  for (vtkMapper* const mapper : std::initializer_list<vtkMapper*>{ scene.splats, spheres, sticks })
  {
    scene.actor->SetMapper(mapper);
    vtkProperty* const property = scene.actor->GetProperty();
    for (const bool asSpheres : { false, true })
    {
      property->SetRenderPointsAsSpheres(asSpheres);
      property->SetRepresentationToSurface();
      const VisibilityImages asSurface = drawKept(scene);
      EXPECT_GT(differenceOnFloor(asSurface, asSurface).dark, 500u) << mapper->GetClassName();
      for (const int representation : { VTK_WIREFRAME, VTK_POINTS })
      {
        property->SetRepresentation(representation);
        const VisibilityImages drawn = drawKept(scene);
        EXPECT_EQ(differenceOnFloor(asSurface, drawn).different, 0u)
          << mapper->GetClassName() << " " << representation << " " << asSpheres;
        EXPECT_THAT(scene.report().notes, testing::IsEmpty());
      }
    }
  }
}

TEST_F(SolidsTest, unservedSolidsAreListed)
{
  RingScene scene(40);
  scene.showSplats(scene.data);
  const auto expectListed = [&](const char* reason)
  {
    scene.window->Render();
    EXPECT_THAT(scene.report().notes,
      testing::ElementsAre(
        testing::HasSubstr("vtkOpenGLPointGaussianMapper (" + std::string(reason))));
  };
  scene.window->Render();
  EXPECT_THAT(scene.report().notes, testing::IsEmpty());
  scene.splats->EmissiveOn();
  expectListed("its splats glow");
  scene.splats->EmissiveOff();
  scene.splats->SetOpacityArray("sizes");
  expectListed("its splats are blended");
  scene.splats->SetOpacityArray(nullptr);
  scene.splats->SetSplatShaderCode(nullptr);
  expectListed("its splat shader code (SetSplatShaderCode) discards nothing, so it has no discs");
  scene.splats->SetScaleFactor(0.0);
  expectListed("points");
  SolidsScene solids(9, 4);
  solids.addSun({ 0.5, 0.3, -1.0 });
  solids.stickActor->SetScale(2.0);
  solids.ballMapper->AddClippingPlane(vtkNew<vtkPlane>());
  solids.render();
  EXPECT_THAT(testing::PrintToString(solids.report().notes),
    testing::AllOf(testing::HasSubstr("vtkOpenGLStickMapper (its actor is scaled"),
      testing::HasSubstr("vtkOpenGLSphereMapper (clipped)")));
}
