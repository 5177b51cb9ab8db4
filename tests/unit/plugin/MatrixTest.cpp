// Mapper x look x light x way: the visibility that reaches the picture is the one that is kept.

#include "PassScene.h"

#include <vtkCellData.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLODActor.h>
#include <vtkMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPBRLUTTexture.h>
#include <vtkPBRPrefilterTexture.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTexture.h>
#include <vtkTextureMapToSphere.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <cstdlib>
#include <tuple>

using namespace gnomon::test;

namespace
{

/// An array of RGB tuples that change from one to the next.
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
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, 0.0, radius);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(12);
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

vtkSmartPointer<vtkActor> actorWith(vtkMapper* mapper)
{
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkPolyData* data)
{
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  return mapper;
}

/// A way to bring a ball or a few into the scene.
struct Kind
{
  const char* name;
  vtkSmartPointer<vtkActor> (*make)(vtkRenderer* renderer);
  bool served = true;
};

vtkSmartPointer<vtkActor> makePolygons(vtkRenderer*)
{
  return actorWith(mapperOf(makeBall(0.0, 1.2)));
}

vtkSmartPointer<vtkActor> makeStrips(vtkRenderer*)
{
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(makeBall(0.0, 1.2));
  stripper->PassCellDataAsFieldDataOn();
  stripper->Update();
  return actorWith(mapperOf(stripper->GetOutput()));
}

vtkSmartPointer<vtkActor> makeComposite(vtkRenderer*)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, makeBall(-1.0, 0.9));
  blocks->SetBlock(1, makeBall(1.0, 0.9));
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  return actorWith(mapper);
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
  return actorWith(mapper);
}

vtkSmartPointer<vtkActor> makeFollower(vtkRenderer* renderer)
{
  const auto follower = vtkSmartPointer<vtkFollower>::New();
  follower->SetMapper(mapperOf(makeBall(0.0, 1.0)));
  follower->SetPosition(0.0, 0.0, 1.0);
  follower->SetCamera(renderer->GetActiveCamera());
  return follower;
}

vtkSmartPointer<vtkActor> makeLevels(vtkRenderer*)
{
  const auto actor = vtkSmartPointer<vtkLODActor>::New();
  actor->SetMapper(mapperOf(makeBall(0.0, 1.2)));
  return actor;
}

vtkSmartPointer<vtkActor> makeCulledGlyphs(vtkRenderer* renderer)
{
  const auto actor = makeGlyphs(renderer);
  vtkGlyph3DMapper::SafeDownCast(actor->GetMapper())->SetCullingAndLOD(true);
  return actor;
}

constexpr Kind kinds[] = { { "Polygons", makePolygons }, { "Strips", makeStrips },
  { "Composite", makeComposite }, { "Glyphs", makeGlyphs }, { "Follower", makeFollower },
  { "Levels", makeLevels }, { "CulledGlyphs", makeCulledGlyphs, false } };

std::ostream& operator<<(std::ostream& stream, const Kind& kind)
{
  return stream << kind.name;
}

/// A way to colour and shade them.
struct Look
{
  const char* name;
  void (*apply)(vtkActor* actor, vtkRenderer* renderer);
};

std::ostream& operator<<(std::ostream& stream, const Look& look)
{
  return stream << look.name;
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
  const auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

void shadePhysically(vtkActor* actor)
{
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetMetallic(0.2);
  actor->GetProperty()->SetRoughness(0.6);
}

/// The light of a small picture all around, which is never shadowed.
void lightByImage(vtkRenderer* renderer)
{
  auto* openGl = vtkOpenGLRenderer::SafeDownCast(renderer);
  openGl->UseImageBasedLightingOn();
  openGl->SetEnvironmentTexture(makeTexture());
  openGl->GetEnvMapLookupTable()->SetLUTSize(16);
  openGl->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(16);
  openGl->GetEnvMapPrefiltered()->SetPrefilterLevels(3);
}

const Look looks[] = {
  { "Flat", [](vtkActor* actor, vtkRenderer*) { actor->GetProperty()->SetInterpolationToFlat(); } },
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
  { "PhysicallyBased", [](vtkActor* actor, vtkRenderer*) { shadePhysically(actor); } },
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
    [](vtkActor* actor, vtkRenderer*)
    {
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(0.0, 0.4, 0.0);
      plane->SetNormal(0.1, -1.0, 0.3);
      actor->GetMapper()->AddClippingPlane(plane);
    } },
};

/// Takes VTK a second or two to prepare, and so is tried on few.
const Look imageBased = { "ImageBased",
  [](vtkActor* actor, vtkRenderer* renderer)
  {
    shadePhysically(actor);
    lightByImage(renderer);
  } };

/// Balls on a green floor, half in the shadow of a beam.
class Matrix
  : public PassTest
  , public testing::WithParamInterface<std::tuple<Kind, Look>>
{
protected:
  Matrix()
  {
    vtkActor* floor = this->scene.addFloor(4.0);
    floor->GetProperty()->SetColor(0.0, 1.0, 0.0);
    vtkActor* beam = this->scene.addBox({ -0.3, -4.0, 3.6 }, { 0.5, 4.0, 3.8 });
    beam->GetProperty()->SetColor(0.0, 0.0, 1.0);
    this->scene.lookFrom({ 1.5, -5.0, 5.5 }, { 0.0, 0.0, 0.8 });
    const auto [kind, look] = GetParam();
    this->actor = kind.make(this->scene.renderer);
    this->actor->GetProperty()->SetColor(1.0, 0.9, 0.8);
    look.apply(this->actor, this->scene.renderer);
    this->scene.renderer->AddActor(this->actor);
    this->scene.renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  }

  /// Draws the scene as VTK does, and without the light.
  std::pair<Picture, Picture> drawPlain(vtkLight* light)
  {
    this->scene.usePlain();
    const Picture lit = this->scene.render();
    const double intensity = light->GetIntensity();
    light->SetIntensity(0.0);
    const Picture unlit = this->scene.render();
    light->SetIntensity(intensity);
    this->scene.useGnomon();
    return { lit, unlit };
  }

  /// The technique's visibility of the light, from the bottom row up.
  std::vector<float> keptVisibility(const Way& way)
  {
    this->scene.choose({ way.technique, vtkGnomonShadowPass::ROUTE_IMAGE });
    this->scene.pass->KeepVisibilityOn();
    this->scene.render();
    const gnomon::VisibilityImages& kept = this->scene.pass->GetVisibility();
    std::vector<float> bottomFirst;
    for (int y = kept.height - 1; y >= 0; --y)
    {
      const auto row = kept.visibility.at(0).begin() + static_cast<std::ptrdiff_t>(y) * kept.width;
      bottomFirst.insert(bottomFirst.end(), row, row + kept.width);
    }
    this->scene.pass->KeepVisibilityOff();
    this->scene.choose(way);
    return bottomFirst;
  }

  static bool near(const glm::ivec3& a, const glm::ivec3& b)
  {
    return std::abs(a.r - b.r) <= 1 && std::abs(a.g - b.g) <= 1 && std::abs(a.b - b.b) <= 1;
  }

  /// Compares the picture with the visibility, pixel by pixel.
  /// @return the visibility
  std::vector<float> check(vtkLight* light, const Way& way, bool served)
  {
    const auto [lit, unlit] = this->drawPlain(light);
    const std::vector<float> visibility = this->keptVisibility(way);
    const Picture picture = this->scene.render();
    EXPECT_EQ(this->scene.report().notes.size(), served ? 0u : 1u);
    std::size_t wrong = 0;
    std::size_t onBallLit = 0;
    std::size_t onBallDark = 0;
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        const float v = visibility.at(static_cast<std::size_t>(y * picture.width + x));
        EXPECT_TRUE(v == 0.0f || v == 1.0f) << v;
        wrong += near(picture.at(x, y), (v == 0.0f ? unlit : lit).at(x, y)) ? 0 : 1;
        const glm::ivec3 brightness = lit.at(x, y) - unlit.at(x, y);
        if (brightness.r > 2) // the floor is green and the beam is blue
        {
          (v == 0.0f ? onBallDark : onBallLit) += 1;
        }
      }
    }
    EXPECT_LE(wrong, 1u); // the routes may differ where rounding decides
    EXPECT_GT(onBallLit, 15u);
    if (served)
    {
      EXPECT_GT(onBallDark, 15u);
    }
    else
    {
      EXPECT_EQ(onBallDark, 0u);
    }
    return visibility;
  }

  PassScene scene{ 96, 72 };
  vtkSmartPointer<vtkActor> actor;
};

std::string nameOfPair(const testing::TestParamInfo<std::tuple<Kind, Look>>& info)
{
  return std::string(std::get<0>(info.param).name) + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(
  All, Matrix, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(looks)), nameOfPair);
INSTANTIATE_TEST_SUITE_P(Some, Matrix,
  testing::Combine(testing::Values(kinds[0], kinds[3]), testing::Values(imageBased)), nameOfPair);

} // namespace

//------------------------------------------------------------------------------
TEST_P(Matrix, pictureShowsTheVisibilityThatIsKept)
{
  const Kind kind = std::get<0>(GetParam());
  const auto ways = { Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
    Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
    Way{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE } };
  for (const bool isSpot : { false, true })
  {
    this->scene.renderer->RemoveAllLights();
    vtkLight* light = isSpot ? this->scene.addSpot({ -1.0, -2.0, 8.0 }, { 0.0, 0.0, 0.0 }, 25.0)
                             : this->scene.addSun({ 0.1, 0.3, -1.0 });
    SCOPED_TRACE(isSpot ? "spot light" : "sun");
    std::vector<std::vector<float>> visibilities;
    for (const Way& way : ways)
    {
      SCOPED_TRACE(testing::Message() << way);
      visibilities.push_back(this->check(light, way, kind.served));
    }
    // The map's are the ray-traced ones but for shadows' edges.
    std::size_t different = 0;
    for (std::size_t i = 0; i < visibilities[0].size(); ++i)
    {
      different += visibilities[0][i] != visibilities[2][i] ? 1 : 0;
    }
    EXPECT_LE(different, visibilities[0].size() / 50);
  }
}
