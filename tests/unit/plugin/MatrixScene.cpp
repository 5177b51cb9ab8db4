#include "MatrixScene.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkCellData.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLODActor.h>
#include <vtkMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPBRLUTTexture.h>
#include <vtkPBRPrefilterTexture.h>
#include <vtkStripper.h>
#include <vtkTextureMapToSphere.h>
#include <vtkUnsignedCharArray.h>

#include <locale>

namespace gnomon::test
{
namespace
{

/// Return an array of RGB tuples, each different from the next.
vtkSmartPointer<vtkUnsignedCharArray> makeColours(vtkIdType count)
{
  const auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colours->SetName("colours");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    colours->SetTuple3(i, 150 + i % 100, 100 + (7 * i) % 150, (3 * i) % 250);
  }
  return colours;
}

/// A sphere, open at its poles, with normals, texture coordinates, and colours for points and
/// cells.
vtkSmartPointer<vtkPolyData> makeBall(double x, double radius)
{
  const auto sphere = ballOf({ x, 0.0, radius }, radius, 24, 12);
  sphere->SetStartPhi(45.0);
  sphere->SetEndPhi(135.0);
  vtkNew<vtkTextureMapToSphere> textured;
  textured->SetInputConnection(sphere->GetOutputPort());
  textured->Update();
  vtkSmartPointer<vtkPolyData> ball = vtkPolyData::SafeDownCast(textured->GetOutput());
  ball->GetPointData()->AddArray(makeColours(ball->GetNumberOfPoints()));
  ball->GetCellData()->AddArray(makeColours(ball->GetNumberOfCells()));
  return ball;
}

vtkSmartPointer<vtkActor> makePolygons(vtkRenderer*)
{
  return actorOf(mapperOf(makeBall(0.0, 1.2)));
}

vtkSmartPointer<vtkActor> makeStrips(vtkRenderer*)
{
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(makeBall(0.0, 1.2));
  stripper->PassCellDataAsFieldDataOn();
  stripper->Update();
  return actorOf(mapperOf(stripper->GetOutput()));
}

vtkSmartPointer<vtkActor> makeComposite(vtkRenderer*)
{
  vtkNew<SharedBlocksMapper> mapper;
  mapper->SetInputDataObject(blocksOf({ makeBall(-1.0, 0.9), makeBall(1.0, 0.9) }));
  return actorOf(mapper);
}

vtkSmartPointer<vtkActor> makeGlyphs(vtkRenderer*)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkFloatArray> sizes;
  sizes->SetName("sizes");
  for (const double x : { -1.2, 0.0, 1.2 })
  {
    places->InsertNextPoint(x, 0.2 * x, 0.1);
    sizes->InsertNextValue(static_cast<float>(0.7 - 0.1 * x));
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(places);
  points->GetPointData()->AddArray(sizes);
  points->GetPointData()->AddArray(makeColours(3));
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetSourceData(makeBall(0.0, 0.9));
  mapper->SetScaleArray("sizes");
  mapper->SetScaleModeToScaleByMagnitude();
  return actorOf(mapper);
}

vtkSmartPointer<vtkActor> makeFollower(vtkRenderer* renderer)
{
  const auto follower = actorOf<vtkFollower>(mapperOf(makeBall(0.0, 1.0)));
  follower->SetPosition(0.0, 0.0, 1.0);
  follower->SetCamera(renderer->GetActiveCamera());
  return follower;
}

vtkSmartPointer<vtkActor> makeLevels(vtkRenderer*)
{
  return actorOf<vtkLODActor>(mapperOf(makeBall(0.0, 1.2)));
}

vtkSmartPointer<vtkActor> makeCulledGlyphs(vtkRenderer* renderer)
{
  const auto actor = makeGlyphs(renderer);
  vtkGlyph3DMapper::SafeDownCast(actor->GetMapper())->SetCullingAndLOD(true);
  return actor;
}

void colour(vtkActor* actor, int mode)
{
  actor->GetMapper()->SetScalarMode(mode);
  actor->GetMapper()->SelectColorArray("colours");
}

vtkSmartPointer<vtkTexture> makeTexture()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 48; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] =
      static_cast<unsigned char>(120 + (i * 37) % 130);
  }
  return textureOf(image);
}

void shadePhysically(vtkActor* actor)
{
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetMetallic(0.2);
  actor->GetProperty()->SetRoughness(0.6);
}

/// Light the scene by a small environment picture; its light is never shadowed.
void lightByImage(vtkRenderer* renderer)
{
  auto* openGl = vtkOpenGLRenderer::SafeDownCast(renderer);
  std::locale::global(std::locale::classic()); // which VTK's shaders of this light follow
  openGl->UseImageBasedLightingOn();
  openGl->SetEnvironmentTexture(makeTexture());
  openGl->GetEnvMapLookupTable()->SetLUTSize(16);
  openGl->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(16);
  openGl->GetEnvMapPrefiltered()->SetPrefilterLevels(3);
}

const glm::dvec3 sunDirection(0.1, 0.3, -1.0);
const glm::dvec3 lampPosition(-1.0, -2.0, 8.0);

/// A sun that starts above the beam and does not reach the floor's far parts.
vtkLight* addSunInABox(PassScene& scene)
{
  vtkLight* sun = scene.addSun(sunDirection);
  const glm::dvec3 position = -7.0 * sunDirection;
  sun->SetPosition(position.x, position.y, position.z);
  const double up[3] = { 0.0, 1.0, 0.0 };
  vtkGnomonLightKeys::SetBox(sun, 5.0, 5.0, 12.0, up);
  return sun;
}

} // namespace

const std::vector<MatrixKind>& matrixKinds()
{
  static const std::vector<MatrixKind> kinds = { { "Polygons", makePolygons },
    { "Strips", makeStrips }, { "Composite", makeComposite }, { "Glyphs", makeGlyphs },
    { "Follower", makeFollower }, { "Levels", makeLevels },
    { "CulledGlyphs", makeCulledGlyphs, false } };
  return kinds;
}

const std::vector<MatrixLook>& matrixLooks()
{
  static const std::vector<MatrixLook> looks = {
    { "Flat",
      [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->SetInterpolationToFlat(); } },
    { "Gouraud",
      [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->SetInterpolationToGouraud(); } },
    { "Shiny",
      [](vtkActor* actor, vtkRenderer*)
      {
        actor->GetProperty()->SetInterpolationToPhong();
        actor->GetProperty()->SetSpecular(0.6);
        actor->GetProperty()->SetSpecularPower(20.0);
      } },
    { "Ambient", [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->SetAmbient(0.3); } },
    { "PhysicallyBased", [](vtkActor* actor, vtkRenderer*) { shadePhysically(actor); }, true },
    { "PointColours",
      [](vtkActor* actor, vtkRenderer*) { colour(actor, VTK_SCALAR_MODE_USE_POINT_FIELD_DATA); } },
    { "CellColours",
      [](vtkActor* actor, vtkRenderer*) { colour(actor, VTK_SCALAR_MODE_USE_CELL_FIELD_DATA); } },
    { "Textured", [](vtkActor* actor, vtkRenderer*) { actor->SetTexture(makeTexture()); } },
    { "Edges", [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->EdgeVisibilityOn(); } },
    { "FrontsCulled",
      [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->FrontfaceCullingOn(); } },
    { "BacksOtherwise",
      [](vtkActor* actor, vtkRenderer*)
      {
        vtkNew<vtkProperty> back;
        back->SetColor(0.9, 0.3, 0.1);
        actor->SetBackfaceProperty(back);
      } },
    { "Clipped",
      [](vtkActor* actor, vtkRenderer*) {
        clip(actor->GetMapper(), { 0.0, 0.4, 0.0 }, { 0.1, -1.0, 0.3 });
      } },
    { "ImageBased",
      [](vtkActor* actor, vtkRenderer* renderer)
      {
        shadePhysically(actor);
        lightByImage(renderer);
      },
      true },
  };
  return looks;
}

std::size_t imageBasedLook()
{
  return matrixLooks().size() - 1;
}

const std::vector<MatrixLight>& matrixLights()
{
  static const std::vector<MatrixLight> lights = {
    { "sun", [](PassScene& scene) { return scene.addSun(sunDirection); } },
    { "spot light",
      [](PassScene& scene) { return scene.addSpot(lampPosition, glm::dvec3(0.0), 25.0); } },
    { "sun in a box", addSunInABox },
    { "wide spot light",
      [](PassScene& scene) { return scene.addSpot(lampPosition, glm::dvec3(0.0), 75.0); } },
    { "point light",
      [](PassScene& scene)
      { return scene.addSpot(lampPosition, glm::dvec3(0.0), allDirections); } },
  };
  return lights;
}

MatrixScene::MatrixScene(const MatrixKind& kind, const MatrixLook& look)
  : PassScene(width, height)
{
  vtkActor* floor = this->addFloor(4.0);
  floor->GetProperty()->SetColor(0.0, 1.0, 0.0);
  vtkActor* beam = this->addBox({ -0.3, -4.0, 3.6 }, { 0.5, 4.0, 3.8 });
  beam->GetProperty()->SetColor(0.0, 0.0, 1.0);
  this->lookFrom({ 1.5, -5.0, 5.5 }, { 0.0, 0.0, 0.8 });
  const vtkSmartPointer<vtkActor> actor = kind.make(this->renderer);
  actor->GetProperty()->SetColor(1.0, 0.9, 0.8);
  look.apply(actor, this->renderer);
  this->renderer->AddActor(actor);
  this->renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
}

} // namespace gnomon::test
