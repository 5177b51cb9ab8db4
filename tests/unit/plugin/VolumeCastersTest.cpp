// Shadows of volumes: what they let through, as VTK draws them.

#include "AreaLights.h"

#include "plugin/vtk_versions/VolumeLights.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkExtractVOI.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockVolumeMapper.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

namespace gnomon::test
{
namespace
{

/// A volume of black smoke whose parts can be changed before it is drawn.
struct Smoke
{
  vtkNew<vtkImageData> image;
  vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
  vtkNew<vtkPiecewiseFunction> opacity;
  vtkNew<vtkVolume> volume;

  /// Fill the cube of side 2 above (0, 0, 0.5).
  explicit Smoke(const glm::ivec3& samples = glm::ivec3(33))
  {
    const glm::dvec3 spacing = 2.0 / glm::dvec3(samples - 1);
    this->image->SetDimensions(samples.x, samples.y, samples.z);
    this->image->SetSpacing(spacing.x, spacing.y, spacing.z);
    this->image->SetOrigin(-1.0, -1.0, 0.5);
    this->mapper->SetInputData(this->image);
    this->mapper->SetAutoAdjustSampleDistances(false);
    this->mapper->SetSampleDistance(0.01f);
    this->volume->SetMapper(this->mapper);
    this->setScalars(1, [](int, const glm::dvec3&) { return 100.0; });
    this->opacity->AddPoint(0.0, 0.0);
    this->opacity->AddPoint(200.0, 0.8);
    vtkNew<vtkColorTransferFunction> black;
    black->AddRGBPoint(0.0, 0.0, 0.0, 0.0);
    for (int component = 0; component < 4; ++component)
    {
      this->property()->SetColor(component, black);
      this->property()->SetScalarOpacity(component, this->opacity);
    }
    this->property()->SetInterpolationTypeToLinear();
    this->property()->ShadeOff();
  }

  vtkVolumeProperty* property() { return this->volume->GetProperty(); }
  /// Set scalars by a formula of places from -1 to 1. One corner has 0 and the opposite one 200, so
  /// that they span the range.
  template <typename ScalarAt>
  void setScalars(int components, const ScalarAt& scalarAt, int type = VTK_FLOAT)
  {
    this->image->AllocateScalars(type, components);
    const glm::ivec3 size = glm::make_vec3(this->image->GetDimensions());
    for (int i = 0; i < components * size.x * size.y * size.z; ++i)
    {
      const int point = i / components;
      const glm::ivec3 at(point % size.x, point / size.x % size.y, point / size.x / size.y);
      this->image->SetScalarComponentFromDouble(at.x, at.y, at.z, i % components,
        scalarAt(i % components, 2.0 * glm::dvec3(at) / glm::dvec3(size - 1) - 1.0));
    }
    for (int c = 0; c < components; ++c)
    {
      this->image->SetScalarComponentFromDouble(0, 0, 0, c, 0.0);
      this->image->SetScalarComponentFromDouble(size.x - 1, size.y - 1, size.z - 1, c, 200.0);
    }
  }
  /// Scalars that vary in all directions.
  void setWaves(int components, int type = VTK_FLOAT)
  {
    const auto wave = [](int c, const glm::dvec3& at)
    { return 100.0 + 60.0 * std::sin(3.0 * at.x + c) * std::cos(2.0 * at.y + at.z - c); };
    this->setScalars(components, wave, type);
  }
};

/// A lit floor under smoke, seen from above.
struct VolumeCasters : PassTest
{
  VolumeCasters()
  {
    this->scene.addFloor(8.0);
    this->sun = this->scene.addSun({ 0.0, 0.0, -1.0 });
    this->scene.lookDown(2.0);
    this->scene.pass->VolumeCastersOn();
  }

  void add(Smoke& smoke) { this->scene.renderer->AddVolume(smoke.volume); }
  /// Return the visibility of the floor at a pixel of the middle row.
  float seen(const char* text = "", int column = 24)
  {
    const VisibilityImages& kept = drawKept(this->scene, text);
    return kept.visibility[0][static_cast<std::size_t>(24 * 48 + column)];
  }
  std::string notes() { return testing::PrintToString(this->scene.report().notes); }

  PassScene scene{ 48, 48 };
  vtkLight* sun;
};

TEST_F(VolumeCasters, LeaveWhatTheSlabsFormulaSays)
{
  Smoke smoke; // opacity 0.4 a unit, 2 high
  this->add(smoke);
  for (const char* const technique :
    { "raytraced", "silhouette", "crsm", "selective", "raytraced edge_samples=4", "auto" })
  {
    EXPECT_NEAR(this->seen(technique), 0.36, 1e-3) << technique;
    EXPECT_EQ(this->seen("", 2), 1.0f) << technique;
  }
  this->scene.choose("raytraced");
  // Light and camera both look through the smoke.
  EXPECT_NEAR(this->scene.redAt(this->scene.render(), 0.0, 0.0), 255.0 * 0.36 * 0.36, 1.5);
}

TEST_F(VolumeCasters, DarkenTheirOwnSamplesAndThoseOfOthers)
{
  if (!numbersLightsAlike)
  {
    GTEST_SKIP() << "volumes do not receive";
  }
  Smoke lit;
  lit.setScalars(1, [](int, const glm::dvec3& at) { return 100.0 + 40.0 * at.z; });
  vtkNew<vtkColorTransferFunction> white;
  white->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  lit.property()->SetColor(0, white);
  lit.property()->ShadeOn();
  this->add(lit);
  this->scene.lookFrom({ 0.0, -9.0, 1.5 }, { 0.0, 0.0, 1.5 });
  Smoke above;
  above.volume->SetPosition(0.0, 0.0, 3.0);
  for (const char* const technique : { "nsm", "raytraced" })
  {
    SCOPED_TRACE(technique);
    this->scene.pass->VolumeCastersOff();
    const int open = this->scene.render(technique).red(24, 24);
    this->scene.pass->VolumeCastersOn();
    const int own = this->scene.render().red(24, 24);
    EXPECT_LT(own, 0.9 * open);
    this->add(above);
    EXPECT_NEAR(this->scene.render().red(24, 24), 0.36 * own, 0.02 * open);
    this->scene.renderer->RemoveVolume(above.volume);
  }
}

TEST_F(VolumeCasters, TechniquesThatDrawOnTheScreenTakeRaysAndSayWhy)
{
  Smoke smoke;
  this->add(smoke);
  for (const char* const technique : { "planar", "montecarlo", "sampled" })
  {
    EXPECT_NEAR(this->seen(technique), 0.36, 1e-3) << technique;
    EXPECT_THAT(this->notes(), testing::HasSubstr("cannot show how much light")) << technique;
  }
}

TEST_F(VolumeCasters, LeaveTheLightThatRaysFindInShaders)
{
  Smoke smoke;
  smoke.setWaves(1);
  this->add(smoke);
  this->scene.lookFrom({ 3.0, -5.0, 6.0 });
  constexpr int within = vtkGnomonShadowPass::ROUTE_INLINE;
  constexpr int onImage = vtkGnomonShadowPass::ROUTE_IMAGE;
  for (const auto& [position, isLamp] : { std::pair(glm::dvec3(0.5, -0.3, 1.0), false),
         { { 1.5, -0.3, 7.0 }, true }, { { 0.2, -0.3, 1.7 }, true } }) // the last is inside
  {
    aim(this->sun, position);
    this->sun->SetPositional(isLamp);
    this->sun->SetConeAngle(isLamp ? allDirections : 30.0);
    const Picture traced = this->scene.render(tracedWay);
    EXPECT_GT(meanDifference(channelsOf(this->scene.renderPlain()), channelsOf(traced)), 5.0)
      << "darkness";
    for (const Way& way :
      { Way{ "nsm", within }, Way{ "vsm", onImage }, Way{ "pcf", within }, Way{ "nsm", onImage } })
    {
      SCOPED_TRACE(testing::Message() << way << " " << position.x);
      const Picture shaded = this->scene.render(way);
      EXPECT_EQ(this->scene.report().lights[0].technique, way.technique);
      EXPECT_LT(meanDifference(channelsOf(shaded), channelsOf(traced)), 0.5);
    }
  }
}

/// Shaders of translucent surfaces read the stack, too.
TEST_F(VolumeCasters, DarkenGlassBelow)
{
  Smoke smoke;
  this->add(smoke);
  vtkActor* const pane = this->scene.addFloor(4.0, 0.2);
  pane->GetProperty()->SetOpacity(0.5);
  const int lit = this->scene.redAt(this->scene.render("raytraced"), 1.9, 0.0);
  EXPECT_NEAR(this->scene.redAt(this->scene.render(), 0.0, 0.0), 0.36 * 0.36 * lit, 2.5);
}

/// Volumes behind the face where a light's box begins take nothing of it, in shaders either.
TEST_F(VolumeCasters, BehindALightTakeNothing)
{
  Smoke smoke;
  this->add(smoke);
  aim(this->sun, { 0.0, 0.0, 0.4 });
  const double up[3] = { 0.0, 1.0, 0.0 };
  vtkGnomonLightKeys::SetBox(this->sun, 8.0, 8.0, 1.0, up);
  for (const char* const technique : { "raytraced", "crsm", "nsm" })
  {
    EXPECT_EQ(this->seen(technique), 1.0f) << technique;
  }
}

TEST_F(VolumeCasters, MultiplyWithGlassAndEndAtOpaqueProps)
{
  Smoke smoke;
  this->add(smoke);
  vtkActor* const pane = this->scene.addFloor(4.0, 3.0);
  pane->GetProperty()->SetOpacity(0.5);
  vtkGnomonPropKeys::SetCasts(pane, true);
  EXPECT_NEAR(this->seen("raytraced"), 0.18, 1e-3);
  this->scene.addBox({ 1.0, -1.0, 3.5 }, { 2.0, 1.0, 3.6 });
  EXPECT_NEAR(this->seen(), 0.18, 1e-3);
  aim(this->sun, { 1.5, 0.0, 3.5 });
  EXPECT_EQ(this->seen(), 0.0f);
}

/// Rays that march are the truth of those that read the stacks of the lamp's points.
TEST_F(VolumeCasters, StacksOfAnAreaAreNearTheMarch)
{
  this->scene.renderer->RemoveAllLights();
  vtkGnomonAreaLight* const lamp =
    addDisk(this->scene, { 1.0, 2.0, 6.0 }, glm::dvec3(0.0), 1.0, 90.0);
  Smoke smoke;
  smoke.setWaves(1);
  this->add(smoke);
  for (const bool isLamp : { true, false })
  {
    lamp->SetPositional(isLamp);
    lamp->SetRadius(isLamp ? 1.0 : 0.15);
    const std::vector<float> march = this->scene.visibilityBy("raytraced");
    const double error = meanDifference(march, this->scene.visibilityBy("penumbra"));
    EXPECT_LT(error, 0.01);
    EXPECT_GT(error, 0.0) << "one of them reads no stack, or both do";
    EXPECT_GT(meanDifference(march, std::vector<float>(march.size(), 1.0f)), 0.05) << "darkness";
  }
}

TEST_F(VolumeCasters, TakeTheirShareOfTheSky)
{
  aim(this->sun, { 0.0, 0.0, -1.0 }); // from below
  this->scene.pass->SetSkyIntensity(1.0);
  this->scene.pass->SetSkyDirections(64);
  Smoke smoke;
  smoke.volume->SetScale(6.0, 6.0, 0.02); // nearly all rays cross it, all as long in its own space
  this->add(smoke);
  EXPECT_NEAR(this->scene.redAt(this->scene.render(), 0.0, 0.0), 255.0 * 0.36 * 0.36, 2.0);
}

TEST_F(VolumeCasters, CastOnlyIfAsked)
{
  Smoke smoke;
  this->add(smoke);
  EXPECT_LT(this->seen("raytraced"), 0.5f);
  vtkGnomonPropKeys::SetCasts(smoke.volume, false);
  EXPECT_EQ(this->seen(), 1.0f);
  this->scene.pass->VolumeCastersOff();
  EXPECT_EQ(this->seen(), 1.0f);
  vtkGnomonPropKeys::SetCasts(smoke.volume, true);
  EXPECT_LT(this->seen(), 0.5f);
  smoke.volume->GetPropertyKeys()->Clear();
  EXPECT_EQ(this->seen(), 1.0f);
  EXPECT_THAT(this->notes(), testing::HasSubstr("SetVolumeCasters()"));
  smoke.volume->VisibilityOff();
  this->scene.pass->VolumeCastersOn();
  EXPECT_EQ(this->seen(), 1.0f);
}

TEST_F(VolumeCasters, FollowChanges)
{
  Smoke smoke;
  this->add(smoke);
  EXPECT_NEAR(this->seen("raytraced"), 0.36, 1e-3);
  smoke.property()->SetScalarOpacityUnitDistance(2.0);
  EXPECT_NEAR(this->seen(), 0.6, 1e-3);
  smoke.opacity->AddPoint(200.0, 0.4);
  EXPECT_NEAR(this->seen(), 0.8, 1e-3);
  smoke.setScalars(1, [](int, const glm::dvec3&) { return 0.0; });
  smoke.image->Modified();
  EXPECT_NEAR(this->seen(), 1.0, 1e-6);
  smoke.setScalars(1, [](int, const glm::dvec3&) { return 100.0; });
  smoke.image->Modified();
  EXPECT_NEAR(this->seen(), 0.8, 1e-3);
  smoke.volume->SetPosition(-1.2, 0.0, 0.0);
  EXPECT_EQ(this->seen(), 1.0f);
  EXPECT_NEAR(this->seen("", 8), 0.8, 1e-3);
}

/// A way in which VTK decides the opacity of a sample.
struct OpacityWay
{
  const char* name;
  void (*change)(Smoke&);
};

using DrawnVolumes = PassTestOf<OpacityWay, VolumeCasters>;

TEST_P(DrawnVolumes, CastWhatVtkDraws)
{
  Smoke smoke({ 33, 17, 25 });
  smoke.setWaves(1);
  this->GetParam().change(smoke);
  this->add(smoke);
  this->scene.choose("raytraced");
  std::vector<float> truth = channelsOf(this->scene.renderPlain());
  for (float& value : truth)
  {
    value *= value / 255.0f; // the light takes the camera's way
  }
  const std::vector<float> seen = channelsOf(this->scene.render());
  EXPECT_LT(meanDifference(seen, truth), 0.35);
  EXPECT_LT(countDifferences(seen, truth, 6.0), 3u * 20u) << "but for pixels at edges";
  EXPECT_GT(std::count_if(truth.begin(), truth.end(), [](float v) { return v < 230.0f; }), 3 * 100);
  EXPECT_EQ(this->scene.report().notes.size(), 0u) << this->notes();
}

const OpacityWay drawnWays[] = {
  { "Plain", [](Smoke&) {} },
  { "Shorts", [](Smoke& smoke) { smoke.setWaves(1, VTK_SHORT); } },
  { "Doubles", [](Smoke& smoke) { smoke.setWaves(1, VTK_DOUBLE); } },
  { "Nearest", [](Smoke& smoke) { smoke.property()->SetInterpolationTypeToNearest(); } },
  { "UnitDistance", [](Smoke& smoke) { smoke.property()->SetScalarOpacityUnitDistance(0.5); } },
  { "Steps",
    [](Smoke& smoke)
    {
      smoke.opacity->RemoveAllPoints();
      smoke.opacity->AddPoint(0.0, 0.0);
      smoke.opacity->AddPoint(119.9, 0.0);
      smoke.opacity->AddPoint(120.0, 1.0);
    } },
  { "GradientOpacity",
    [](Smoke& smoke)
    {
      vtkNew<vtkPiecewiseFunction> gradient;
      gradient->AddPoint(0.0, 0.0);
      gradient->AddPoint(10.0, 1.0);
      smoke.property()->SetGradientOpacity(gradient);
    } },
  { "NoGradientOpacity",
    [](Smoke& smoke)
    {
      vtkNew<vtkPiecewiseFunction> gradient;
      gradient->AddPoint(0.0, 0.0);
      smoke.property()->SetGradientOpacity(gradient);
      smoke.property()->DisableGradientOpacityOn();
    } },
  { "Rotated", [](Smoke& smoke) { smoke.volume->RotateWXYZ(30.0, 1.0, 2.0, 3.0); } },
  { "Scaled", [](Smoke& smoke) { smoke.volume->SetScale(0.7, 1.2, 0.6); } },
  { "Directed",
    [](Smoke& smoke)
    {
      smoke.image->SetDirectionMatrix(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
      smoke.image->SetOrigin(1.0, -1.0, 0.5);
    } },
  { "Masked",
    [](Smoke& smoke)
    {
      vtkNew<vtkImageData> mask;
      mask->CopyStructure(smoke.image);
      mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
      auto* const texels = static_cast<unsigned char*>(mask->GetScalarPointer());
      for (int i = 0; i < 33 * 17 * 25; ++i)
      {
        texels[i] = i % 33 < 20 ? 255 : 0;
      }
      smoke.mapper->SetMaskInput(mask);
      smoke.mapper->SetMaskTypeToBinary();
    } },
  { "Cropped",
    [](Smoke& smoke)
    {
      smoke.mapper->CroppingOn();
      smoke.mapper->SetCroppingRegionPlanes(-0.5, 0.25, -0.3, 0.6, 0.9, 2.0);
      smoke.mapper->SetCroppingRegionFlagsToFence();
    } },
  { "Clipped",
    [](Smoke& smoke) {
      clip(smoke.mapper, { 0.2, 0.0, 1.0 }, { -1.0, 0.3, 0.5 });
    } },
  { "TwoIndependent",
    [](Smoke& smoke)
    {
      smoke.setWaves(2);
      smoke.property()->SetComponentWeight(0, 0.7);
      smoke.property()->SetComponentWeight(1, 0.4);
    } },
  { "FourIndependent",
    [](Smoke& smoke)
    {
      smoke.setWaves(4);
      for (int component = 0; component < 4; ++component)
      {
        smoke.property()->SetComponentWeight(component, 0.25);
      }
    } },
  { "TwoDependent",
    [](Smoke& smoke)
    {
      smoke.setWaves(2);
      smoke.property()->IndependentComponentsOff();
    } },
  { "FourDependent",
    [](Smoke& smoke)
    {
      smoke.setScalars(
        4, // black
        [](int c, const glm::dvec3& at) { return c < 3 ? 0.0 : 100.0 + 80.0 * at.x * at.y; },
        VTK_UNSIGNED_CHAR);
      for (int colour = 0; colour < 3; ++colour)
      {
        smoke.image->SetScalarComponentFromDouble(32, 16, 24, colour, 0.0);
      }
      smoke.property()->IndependentComponentsOff();
    } },
};
INSTANTIATE_TEST_SUITE_P(, DrawnVolumes, testing::ValuesIn(drawnWays), byName);

TEST_F(VolumeCasters, ScalarsOfCellsFillTheCells)
{
  Smoke smoke;
  smoke.image->GetPointData()->SetScalars(nullptr);
  vtkNew<vtkFloatArray> scalars;
  for (int i = 0; i < 32 * 32 * 32; ++i)
  {
    scalars->InsertNextValue(i == 0 ? 0.0f : i == 1 ? 200.0f : 100.0f);
  }
  smoke.image->GetCellData()->SetScalars(scalars);
  this->add(smoke);
  EXPECT_NEAR(this->seen("raytraced"), 0.36, 1e-3);
}

TEST_F(VolumeCasters, OfOtherMappersCastAlike)
{
  Smoke smoke;
  this->add(smoke);
  vtkNew<vtkSmartVolumeMapper> smart;
  vtkNew<vtkFixedPointVolumeRayCastMapper> fixed;
  for (vtkVolumeMapper* const mapper :
    { static_cast<vtkVolumeMapper*>(smart), static_cast<vtkVolumeMapper*>(fixed) })
  {
    mapper->SetInputDataObject(smoke.image);
    smoke.volume->SetMapper(mapper);
    EXPECT_NEAR(this->seen("raytraced"), 0.36, 1e-3) << mapper->GetClassName();
  }
}

TEST_F(VolumeCasters, InBlocksCastAsTheWhole)
{
  Smoke smoke;
  smoke.setWaves(1);
  this->add(smoke);
  aim(this->sun, { 1.0, 0.5, 3.0 });
  const std::vector<const char*> techniques{ "raytraced", "silhouette", "pcf" };
  std::vector<std::vector<float>> whole;
  for (const char* const technique : techniques)
  {
    whole.push_back(this->scene.visibilityBy(technique));
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int half = 0; half < 2; ++half)
  {
    vtkNew<vtkExtractVOI> part;
    part->SetInputData(smoke.image);
    half == 0 ? part->SetVOI(0, 12, 0, 32, 0, 32) : part->SetVOI(12, 32, 0, 32, 0, 32);
    part->Update();
    blocks->SetBlock(2 * half, part->GetOutput()); // one is empty
  }
  vtkNew<vtkMultiBlockVolumeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  smoke.volume->SetMapper(mapper);
  for (std::size_t i = 0; i < techniques.size(); ++i)
  {
    const std::vector<float> inBlocks = this->scene.visibilityBy(techniques[i]);
    EXPECT_LT(largestDifference(whole[i], inBlocks), i == 0 ? 0.002 : 0.03) << techniques[i];
  }
  EXPECT_THAT(this->notes(), testing::Not(testing::HasSubstr("volume")));
  blocks->SetBlock(2, nullptr);
  EXPECT_GT(this->seen("raytraced"), whole[0][24 * 48 + 24]);
  const float half = this->seen("raytraced");
  mapper->SetVectorMode(vtkSmartVolumeMapper::MAGNITUDE); // as ParaView does, too
  EXPECT_EQ(this->seen("raytraced"), half);
}

TEST_F(VolumeCasters, ThatCannotBeServedAreNamed)
{
  Smoke smoke;
  this->add(smoke);
  const auto expectNamed = [this](const char* why)
  {
    EXPECT_EQ(this->seen("raytraced"), 1.0f) << why;
    EXPECT_THAT(this->notes(), testing::HasSubstr(why));
    this->takeErrors(); // VTK's own, of volumes that it does not draw either
  };
  smoke.mapper->SetBlendModeToMaximumIntensity();
  expectNamed("not composited");
  smoke.mapper->SetBlendModeToComposite();
  smoke.setWaves(3);
  smoke.property()->IndependentComponentsOff();
  expectNamed("its components decide no opacity");
  smoke.property()->IndependentComponentsOn();
  vtkNew<vtkSmartVolumeMapper> smart;
  smart->SetInputData(smoke.image);
  smart->SetVectorMode(vtkSmartVolumeMapper::MAGNITUDE);
  smoke.volume->SetMapper(smart);
  expectNamed("it shows a component or the length of vectors");
  smoke.volume->SetMapper(smoke.mapper);
  smoke.setWaves(1);
  vtkNew<vtkImageData> labels;
  labels->CopyStructure(smoke.image);
  labels->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  smoke.mapper->SetMaskInput(labels);
  smoke.mapper->SetMaskTypeToLabelMap();
  expectNamed("its mask is not binary");
  smoke.mapper->SetMaskInput(nullptr);
  vtkNew<vtkRectilinearGrid> grid;
  smoke.mapper->SetInputDataObject(grid);
  expectNamed("its grid is no image");
}

} // namespace
} // namespace gnomon::test
