// Drivers number triangles for fragment shaders. The pass checks the numbers and replaces wrong
// ones.

#include "MatrixScene.h"

#include <vtkAxesActor.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>

namespace gnomon::test
{
namespace
{

/// VTK's mapper on a driver that gives fragment shaders other numbers. It has the class name of
/// VTK's own mapper, so Gnomon treats it as that.
class GarblingMapper : public vtkOpenGLPolyDataMapper
{
public:
  static GarblingMapper* New() { VTK_STANDARD_NEW_BODY(GarblingMapper); }

  std::string number = "gl_PrimitiveID"; ///< the driver's number

protected:
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override
  {
    this->vtkOpenGLPolyDataMapper::ReplaceShaderValues(shaders, renderer, actor);
    vtkShaderProgram::Substitute(
      shaders[vtkShader::Fragment], "gl_PrimitiveID", "(" + this->number + ")");
  }
};

/// Two squares above each other, 0.2 apart: triangles 0 and 1, 2 and 3.
vtkSmartPointer<vtkPolyData> makeSquares()
{
  std::vector<glm::dvec3> corners;
  for (const double z : { 1.5, 1.3 })
  {
    corners.insert(
      corners.end(), { { -1.0, -1.0, z }, { 1.0, -1.0, z }, { 1.0, 1.0, z }, { -1.0, 1.0, z } });
  }
  return meshOf(corners, { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } });
}

/// Return a mapper of the squares with such numbers of a driver.
vtkSmartPointer<GarblingMapper> garbledSquares(const char* number)
{
  const auto mapper = vtk::TakeSmartPointer(GarblingMapper::New());
  mapper->number = number;
  mapper->SetInputDataObject(makeSquares());
  mapper->ScalarVisibilityOff();
  return mapper;
}

struct Garbling
{
  const char* name;
  const char* number;
};

/// The squares over a floor, from straight above.
struct TriangleNumbers : PassTestOf<Garbling>
{
  TriangleNumbers()
  {
    for (PassScene* scene : { &this->right, &this->garbled })
    {
      scene->addFloor(3.0);
      vtkActor* const actor = scene->add(makeSquares());
      if (scene == &this->garbled)
      {
        actor->SetMapper(garbledSquares(GetParam().number));
      }
      scene->addSun({ 1.0, 0.2, -1.0 });
      scene->lookDown(3.0);
    }
    this->garbled.numbersAreWrong = true;
  }

  void expectSamePictures(int route)
  {
    for (PassScene* scene : { &this->right, &this->garbled })
    {
      scene->choose({ "raytraced", route });
    }
    const Picture picture = this->garbled.render();
    EXPECT_TRUE(picture == this->right.render());
    EXPECT_TRUE(this->garbled.report().numbersByGeometryShaders);
    EXPECT_EQ(this->garbled.report().notes, std::vector<std::string>());
    EXPECT_GT(this->garbled.report().numbersChecked, 0);
    EXPECT_GT(this->garbled.report().numbersWrong, 0);
    EXPECT_FALSE(this->right.report().numbersByGeometryShaders);
    EXPECT_GT(this->right.report().numbersChecked, 0);
    // The second frame knows that the numbers are wrong.
    this->garbled.numbersAreWrong = false;
    EXPECT_TRUE(this->garbled.render() == picture);
    EXPECT_EQ(this->garbled.report().programCompiles, 0);
  }

  PassScene right{ 120, 90 };
  PassScene garbled{ 120, 90 };
};

INSTANTIATE_TEST_SUITE_P(Kinds, TriangleNumbers,
  testing::Values(Garbling{ "neighbours", "gl_PrimitiveID ^ 1" },
    Garbling{ "behind", "(gl_PrimitiveID + 2) % 4" }, Garbling{ "beyond", "gl_PrimitiveID + 1000" },
    Garbling{ "negative", "-1 - gl_PrimitiveID" }, Garbling{ "huge", "gl_PrimitiveID + 20000000" }),
  byName);

TEST_P(TriangleNumbers, areReplacedWhereReceiversAreDrawnAlone)
{
  this->expectSamePictures(vtkGnomonShadowPass::ROUTE_IMAGE);
}

TEST_P(TriangleNumbers, areReplacedWhereReceiversAreDrawnWithThePicture)
{
  this->expectSamePictures(vtkGnomonShadowPass::ROUTE_DEFERRED);
}

/// A prop that blends over others, on the deferred route.
TEST_P(TriangleNumbers, areReplacedWherePropsBlend)
{
  for (PassScene* scene : { &this->right, &this->garbled })
  {
    vtkActor* const veil = scene->addFloor(0.5, 2.0); // over a part of the squares
    veil->SetTexture(textureOf(makeVeil(2, 2, [](int, int) { return 128; })));
    veil->ForceOpaqueOn();
  }
  this->expectSamePictures(vtkGnomonShadowPass::ROUTE_DEFERRED);
}

/// Squares whose mapper's numbers are wrong.
struct LateNumbers : PassTest
{
  LateNumbers()
  {
    this->squares->SetMapper(garbledSquares("(gl_PrimitiveID + 2) % 4"));
    this->scene.addFloor(3.0);
    this->scene.addSun({ 1.0, 0.2, -1.0 });
    this->scene.lookDown(3.0);
    this->scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
  }

  PassScene scene{ 120, 90 };
  vtkNew<vtkActor> squares;
};

TEST_F(LateNumbers, areFoundOnceTheirSurfaceIsSeen)
{
  this->squares->SetPosition(0.0, 0.0, -5.0); // below the floor
  this->scene.renderer->AddActor(this->squares);
  this->scene.renderer->GetActiveCamera()->SetClippingRange(1.0, 100.0);
  this->scene.render();
  EXPECT_FALSE(this->scene.report().numbersByGeometryShaders);
  this->squares->SetPosition(0.0, 0.0, 0.0);
  this->scene.numbersAreWrong = true;
  this->scene.render();
  EXPECT_TRUE(this->scene.report().numbersByGeometryShaders);
}

TEST_F(LateNumbers, areFoundBesideAnnotations)
{
  vtkNew<vtkAxesActor> axes;
  this->scene.renderer->AddActor(axes);
  this->scene.renderer->AddActor(this->squares);
  this->scene.numbersAreWrong = true;
  this->scene.render();
  EXPECT_TRUE(this->scene.report().numbersByGeometryShaders);
}

/// Right numbers count as right where VTK's floats are coarse, and where depths are offset.
using RightNumbers = PassTest;

TEST_F(RightNumbers, areBelievedAwayFromTheOrigin)
{
  for (const double away : { 0.0, 300.0, 900.0 })
  {
    PassScene scene(300, 200);
    for (vtkActor* actor : { scene.addFloor(0.5), scene.addSphere({ 0.0, 0.0, 0.6 }, 0.2) })
    {
      actor->SetPosition(away, 0.7 * away, 0.0);
    }
    scene.addSun({ 1.0, 0.3, -1.5 });
    const glm::dvec3 middle(away, 0.7 * away, 0.2);
    for (const glm::dvec3& from : { glm::dvec3(0.0, -0.1, 2.0), glm::dvec3(0.3, -2.0, 0.5) })
    {
      scene.lookFrom(middle + from, middle);
      scene.renderer->ResetCameraClippingRange();
      for (const int route :
        { vtkGnomonShadowPass::ROUTE_IMAGE, vtkGnomonShadowPass::ROUTE_DEFERRED })
      {
        scene.choose({ "raytraced", route });
        scene.render(); // expects no wrong number
      }
    }
  }
}

TEST_F(RightNumbers, areBelievedWhereVtkOffsetsPolygons)
{
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  PassScene scene(120, 90);
  scene.addFloor(3.0);
  scene.addBox({ -1.0, -1.0, 0.5 }, { 1.0, 1.0, 1.0 });
  scene.addSun({ 1.0, 0.2, -1.0 });
  scene.lookDown(3.0);
  scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
  scene.render();
  EXPECT_GT(scene.report().numbersChecked, 0);
  vtkMapper::SetResolveCoincidentTopologyToDefault();
}

/// Read too soon, the image would be as the frame before left it, which shows nothing (llvmpipe).
/// From inside a sphere all pixels are drawn.
TEST_F(RightNumbers, areReadOnceTheyAreDrawn)
{
  PassScene scene(64, 48);
  scene.addSphere(glm::dvec3(0.0), 0.7);
  scene.addSun({ 1.0, 0.4, -1.5 });
  const auto drawBy = [&](int route)
  {
    scene.choose({ "esm", route });
    scene.render();
    return scene.report().numbersChecked;
  };
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  drawBy(vtkGnomonShadowPass::ROUTE_INLINE);
  scene.lookFrom({ 0.0, -9.0, 7.0 }, { 0.0, -20.0, 20.0 });
  EXPECT_EQ(drawBy(vtkGnomonShadowPass::ROUTE_IMAGE), 0);
  drawBy(vtkGnomonShadowPass::ROUTE_INLINE);
  scene.lookFrom(glm::dvec3(0.0), { 1.0, 1.0, 0.0 });
  EXPECT_EQ(drawBy(vtkGnomonShadowPass::ROUTE_IMAGE), 64 * 48);
}

/// All ways to draw receivers, in turn with all looks, with wrong numbers from one mapper.
using NumberedKinds = PassTestOf<std::size_t>;

INSTANTIATE_TEST_SUITE_P(KindsAndLooks, NumberedKinds,
  testing::Range(std::size_t(0), std::max(matrixKinds().size(), imageBasedLook())),
  [](const testing::TestParamInfo<std::size_t>& turn)
  {
    return std::string(matrixKinds()[turn.param % matrixKinds().size()].name) +
      matrixLooks()[turn.param % imageBasedLook()].name;
  });

TEST_P(NumberedKinds, areSeenTheSameByGeometryShaders)
{
  const MatrixKind& kind = matrixKinds()[GetParam() % matrixKinds().size()];
  const MatrixLook& look = matrixLooks()[GetParam() % imageBasedLook()];
  MatrixScene right(kind, look);
  MatrixScene garbled(kind, look);
  for (MatrixScene* scene : { &right, &garbled })
  {
    vtkActor* const squares = scene->add(makeSquares());
    squares->SetPosition(2.0, -2.0, 0.0);
    if (scene == &garbled)
    {
      squares->SetMapper(garbledSquares("gl_PrimitiveID ^ 1"));
    }
    matrixLights().front().add(*scene);
    scene->choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
  }
  const std::vector<float> expected = drawKept(right).visibility.at(0);
  garbled.numbersAreWrong = true;
  EXPECT_EQ(drawKept(garbled).visibility.at(0), expected);
  EXPECT_TRUE(garbled.report().numbersByGeometryShaders);
  EXPECT_FALSE(right.report().numbersByGeometryShaders);
}

/// With many triangles a surface, llvmpipe draws receivers by programs that VTK rebuilds.
TEST_P(NumberedKinds, areSeenTheSameByProgramsOfTheirOwn)
{
  const MatrixKind& kind = matrixKinds()[GetParam() % matrixKinds().size()];
  const MatrixLook& look = matrixLooks()[GetParam() % imageBasedLook()];
  std::vector<Picture> pictures;
  std::vector<std::vector<float>> visibility;
  for (const int around : { 8, 240 })
  {
    MatrixScene scene(kind, look);
    scene.add(ballOf({ 0.0, 0.0, -0.5 }, 0.01, around, around / 2)); // under the floor
    matrixLights().front().add(scene);
    scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
    drawKept(scene);
    scene.renderer->GetActiveCamera()->Azimuth(5.0);
    visibility.push_back(drawKept(scene).visibility.at(0));
    EXPECT_EQ(scene.report().programCompiles > 0, around == 240 && !isOnGpu());
    pictures.push_back(scene.render());
  }
  EXPECT_EQ(visibility[0], visibility[1]);
  EXPECT_EQ(differingPixels(pictures[0], pictures[1]), 0u);
}

} // namespace
} // namespace gnomon::test
