// Shadows of surfaces on the samples of volumes, against a march in double precision.

#include "PassScene.h"

#include "plugin/frame/CastingLights.h"
#include "plugin/frame/VolumeHook.h"
#include "plugin/vtk_versions/VolumeLights.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

namespace gnomon::test
{
namespace
{

constexpr double step = 0.02;        // of VTK's samples
constexpr double unitOpacity = 0.08; // of 0.1 of the slab

/// A slab of constant opacity, white, whose scalars rise along its own z, so that all of it faces
/// the same way. A card is above it, seen from straight above.
struct VolumeReceivers : PassTest
{
  VolumeReceivers()
  {
    this->card = this->scene.addBox(this->cardBox.lower, this->cardBox.upper);
    this->scene.lookDown(1.6);
    this->scene.choose("raytraced");
  }

  void SetUp() override
  {
    if (!numbersLightsAlike)
    {
      GTEST_SKIP() << "volumes are not served";
    }
  }

  /// Add a slab, with scalars of points or of cells.
  void addSlab(vtkVolumeMapper* mapper, bool ofCells = false)
  {
    vtkNew<vtkImageData> image;
    image->SetOrigin(this->slab.lower.x, this->slab.lower.y, this->slab.lower.z);
    image->SetDimensions(9, 11, 6);
    image->SetSpacing(0.25, 0.2, 0.2);
    vtkNew<vtkFloatArray> heights;
    const int layers = ofCells ? 5 : 6;
    const int inLayer = ofCells ? 8 * 10 : 9 * 11;
    for (int i = 0; i < layers * inLayer; ++i)
    {
      heights->InsertNextValue(static_cast<float>(i / inLayer));
    }
    ofCells ? image->GetCellData()->SetScalars(heights)
            : image->GetPointData()->SetScalars(heights);
    mapper->SetInputDataObject(image);
    ofCells ? mapper->SetScalarModeToUseCellData() : mapper->SetScalarModeToUsePointData();
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0.0, unitOpacity);
    opacity->AddPoint(9.0, unitOpacity);
    vtkNew<vtkColorTransferFunction> white;
    white->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
    vtkVolumeProperty* const property = this->volume->GetProperty();
    property->SetScalarOpacity(opacity);
    property->SetScalarOpacityUnitDistance(0.1);
    property->SetColor(white);
    property->SetAmbient(0.0);
    property->SetDiffuse(1.0);
    property->SetSpecular(0.0);
    property->ShadeOn();
    this->volume->SetMapper(mapper);
    this->scene.renderer->AddVolume(this->volume);
  }
  void addSlab() { this->addSlab(this->mapper); }
  vtkLight* addLamp(double coneAngleDegrees)
  {
    return this->scene.addSpot({ -1.5, 0.2, 6.0 }, { 0.4, 0.0, 0.5 }, coneAngleDegrees);
  }

  /// Return the red value of a ray through the slab, by the samples that VTK takes.
  /// @param shadows true if the card hides lights that cast
  double march(const glm::dvec2& place, bool shadows) const
  {
    const glm::dmat4 worldFromSlab = glm::transpose(
      glm::make_mat4(&const_cast<vtkVolume*>(this->volume.Get())->GetMatrix()->Element[0][0]));
    const glm::dmat4 slabFromWorld = glm::inverse(worldFromSlab);
    const glm::dvec3 start(slabFromWorld * glm::dvec4(place, 10.0, 1.0));
    const glm::dvec3 ray(slabFromWorld * glm::dvec4(0.0, 0.0, -1.0, 0.0));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(worldFromSlab[2]));
    const auto [enter, leave] = spanIn(this->slab, start, ray);
    double value = 0.0;
    double through = 1.0;
    const double left = std::pow(1.0 - unitOpacity, step / 0.1);
    for (double along = enter + this->firstSample; along < leave; along += step)
    {
      const glm::dvec3 sample(place, 10.0 - along);
      for (vtkLight* light : this->lights)
      {
        const glm::dvec3 position = glm::make_vec3(light->GetPosition());
        const glm::dvec3 axis = glm::make_vec3(light->GetFocalPoint()) - position;
        const bool isLamp = light->GetPositional();
        const glm::dvec3 toLight = isLamp ? position - sample : -axis;
        const double cosine = std::abs(glm::dot(normal, glm::normalize(toLight)));
        const bool reaches = !isLamp || light->GetConeAngle() > 90.0 ||
          glm::dot(glm::normalize(-toLight), glm::normalize(axis)) >
            std::cos(glm::radians(light->GetConeAngle()));
        const bool hidden = shadows && vtkGnomonLightKeys::GetCasts(light) != 0 &&
          meetsCard(sample, toLight, isLamp ? 1.0 : 1e3);
        value += reaches && !hidden ? light->GetIntensity() * cosine * through * (1.0 - left) : 0.0;
      }
      through *= left;
    }
    return 255.0 * value;
  }
  bool meetsCard(const glm::dvec3& from, const glm::dvec3& along, double end) const
  {
    const double at = (this->cardBox.lower.z - from.z) / along.z;
    return at > 0.0 && at < end && isUnder(from + at * along, this->cardBox);
  }

  /// True if the camera sees the card, or nearly.
  bool isUnderCard(const glm::dvec2& place) const
  {
    return isUnder(place, { this->cardBox.lower - 0.05, this->cardBox.upper + 0.05 });
  }

  /// Compare the picture with the march, away from the card and from the slab's border.
  /// @param isTurned true if VTK shades the slab as if it faced elsewhere; then shares of the light
  /// are compared
  void expectLikeMarch(const std::string& what, bool isTurned = false)
  {
    vtkGnomonPropKeys::SetCasts(this->card, true);
    const Picture picture = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->card, false);
    const Picture lit = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->card, true);
    std::size_t shaded = 0;
    std::size_t changed = 0;
    double squares = 0.0;
    double worst = 0.0;
    const std::size_t counted = countPixels(picture,
      [&](int x, int y)
      {
        const glm::dvec2 place = this->scene.floorAt(x, y);
        const double without = this->march(place, false);
        if (this->isUnderCard(place) ||
          glm::any(glm::greaterThan(glm::abs(place), glm::dvec2(isTurned ? 0.6 : 0.85))))
        {
          return false;
        }
        const double expected = this->march(place, true);
        const double scale = isTurned ? lit.red(x, y) / without : 1.0;
        const double difference = picture.red(x, y) - scale * expected;
        shaded += expected < 0.8 * without ? 1 : 0;
        squares += difference * difference;
        worst = std::max(worst, std::abs(difference));
        EXPECT_TRUE(isTurned || std::abs(lit.red(x, y) - without) <= 2.0)
          << "lit, " << what << " at " << x << ", " << y;
        bool isClear = true; // and the samples around are
        for (int side = 0; side < 9; ++side)
        {
          const glm::dvec2 near = place + 0.06 * glm::dvec2(side % 3 - 1, side / 3 - 1);
          isClear = isClear && this->march(near, true) == this->march(near, false);
        }
        changed += isClear && picture.red(x, y) != lit.red(x, y) ? 1 : 0;
        return true;
      });
    const double rms = std::sqrt(squares / static_cast<double>(counted));
    EXPECT_GT(counted, 500u) << what;
    EXPECT_GT(shaded, counted / 20) << what;
    EXPECT_EQ(changed, 0u) << what << ": samples that nothing hides";
    EXPECT_LT(rms, 1.2) << what;
    EXPECT_LT(worst, 8.0) << what;
  }
  void expectPlain(const std::string& what)
  {
    const Picture picture = this->scene.render();
    EXPECT_EQ(differingPixels(picture, this->scene.renderPlain()), 0u) << what;
  }
  std::string told() { return testing::PrintToString(this->scene.report().leftOut); }

  static vtkNew<vtkOpenGLGPUVolumeRayCastMapper> makeMapper()
  {
    vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
    mapper->AutoAdjustSampleDistancesOff();
    mapper->SetSampleDistance(static_cast<float>(step));
    return mapper;
  }

  const Box slab{ { -1.0, -1.0, 0.0 }, { 1.0, 1.0, 1.0 } };
  const Box cardBox{ { -0.6, -0.5, 2.0 }, { 0.0, 0.6, 2.001 } };
  PassScene scene{ 96, 96 };
  vtkActor* card;
  vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper = makeMapper();
  vtkNew<vtkVolume> volume;
  std::vector<vtkLight*> lights;
  double firstSample = step; // from where VTK's rays enter
};

TEST_F(VolumeReceivers, samplesBehindACardAreDarkByAllLightsAndRoutes)
{
  this->addSlab();
  vtkActor* const floor = this->scene.addFloor(1.5, -0.5);
  floor->GetProperty()->SetColor(0.0, 1.0, 0.0);
  for (const auto& [name, cone] :
    { std::pair("sun", 0.0), { "spot", 30.0 }, { "lamp", allDirections } })
  {
    this->scene.renderer->RemoveAllLights();
    this->lights = { cone > 0.0 ? this->addLamp(cone) : this->scene.addSun({ 0.5, 0.1, -1.0 }) };
    for (const auto& [technique, route, taken] :
      { std::tuple("nsm", vtkGnomonShadowPass::ROUTE_INLINE, "inline"),
        std::tuple("nsm", vtkGnomonShadowPass::ROUTE_IMAGE, "image"),
        std::tuple("raytraced", vtkGnomonShadowPass::ROUTE_IMAGE, "image"),
        std::tuple("silhouette", vtkGnomonShadowPass::ROUTE_AUTO, "deferred") })
    {
      this->scene.choose(Way{ technique, route });
      this->expectLikeMarch(name + std::string(" ") + technique + " " + taken);
      EXPECT_EQ(this->scene.report().route, taken) << this->scene.report().routeReason;
    }
  }
}

/// Between the pictures without and with an opaque card, by what the card leaves.
TEST_F(VolumeReceivers, samplesBehindGlassAreDimmed)
{
  this->addSlab();
  this->scene.pass->TranslucentCastersOn();
  const double opacity = 0.4;
  const glm::dvec3 colour(0.9, 0.5, 0.0);
  for (const bool isLamp : { false, true })
  {
    this->scene.renderer->RemoveAllLights();
    isLamp ? this->addLamp(allDirections) : this->scene.addSun({ 0.5, 0.1, -1.0 });
    vtkProperty* const property = this->card->GetProperty();
    property->SetOpacity(1.0);
    const Picture dark = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->card, false);
    const Picture lit = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->card, true);
    property->SetColor(colour.r, colour.g, colour.b);
    property->SetOpacity(opacity);
    for (const bool isColoured : { false, true })
    {
      vtkGnomonPropKeys::SetTransmits(this->card,
        isColoured ? vtkGnomonPropKeys::TRANSMITS_COLORED : vtkGnomonPropKeys::TRANSMITS_GREY);
      const Picture glass = this->scene.render();
      double squares = 0.0;
      double dimmed = 0.0;
      const std::size_t counted = countPixels(glass,
        [&](int x, int y)
        {
          const glm::dvec2 place = this->scene.floorAt(x, y);
          if (this->isUnderCard(place))
          {
            return false;
          }
          const glm::dvec3 takes = isColoured ? opacity * (1.0 - colour) : glm::dvec3(opacity);
          const glm::dvec3 left = 1.0 - takes;
          const glm::dvec3 walls = left * left; // of the card
          const glm::dvec3 open(lit.at(x, y));
          const glm::dvec3 expected = glm::mix(glm::dvec3(dark.at(x, y)), open, walls);
          const glm::dvec3 off = glm::dvec3(glass.at(x, y)) - expected;
          squares += glm::dot(off, off);
          dimmed += open.g - expected.g;
          return true;
        });
      EXPECT_GT(dimmed, 2.0 * static_cast<double>(counted)) << isLamp << isColoured;
      EXPECT_LT(std::sqrt(squares / (3.0 * static_cast<double>(counted))), 1.5)
        << isLamp << isColoured;
    }
    property->SetColor(1.0, 1.0, 1.0);
    vtkGnomonPropKeys::SetTransmits(this->card, vtkGnomonPropKeys::TRANSMITS_GREY);
  }
}

TEST_F(VolumeReceivers, lightsKeepTheirNumbers)
{
  this->addSlab();
  this->scene.addSun({ 0.0, 1.0, -1.0 })->SwitchOff();
  vtkLight* const plain = this->scene.addSun({ -0.4, 0.2, -1.0 });
  vtkGnomonLightKeys::SetCasts(plain, false);
  this->lights = { plain, this->scene.addSun({ 0.5, 0.1, -1.0 }) };
  this->lights[0]->SetIntensity(0.3); // VTK clamps the sum of all lights
  this->lights[1]->SetIntensity(0.5);
  this->expectLikeMarch("two suns");
  this->lights.push_back(this->addLamp(allDirections));
  this->lights[2]->SetIntensity(0.2);
  this->mapper->Modified(); // else VTK takes the lamp for a sun
  this->expectLikeMarch("and a lamp");
  EXPECT_THAT(this->told(), testing::HasSubstr("vtkVolume (casts nothing)"));
  vtkGnomonPropKeys::SetCasts(this->volume, false);
  this->scene.render();
  EXPECT_EQ(this->told(), "{}");
}

TEST_F(VolumeReceivers, placesOfSamplesAreThoseOfTheData)
{
  this->lights = { this->scene.addSun({ 0.5, 0.1, -1.0 }) };
  this->addSlab();
  this->volume->SetOrientation(15.0, -10.0, 30.0);
  this->volume->SetPosition(0.05, 0.1, -0.2);
  this->expectLikeMarch("turned", true);
  this->volume->SetOrientation(0.0, 0.0, 0.0);
  this->volume->SetPosition(0.0, 0.0, 0.0);
  this->scene.renderer->RemoveVolume(this->volume);
  this->addSlab(makeMapper(), true);
  this->expectLikeMarch("scalars of cells");
  this->scene.renderer->RemoveVolume(this->volume);
  vtkNew<vtkSmartVolumeMapper> smart;
  smart->AutoAdjustSampleDistancesOff();
  smart->SetSampleDistance(static_cast<float>(step));
  this->addSlab(smart);
  this->expectLikeMarch("smart mapper");
  EXPECT_EQ(smart->GetLastUsedRenderMode(), vtkSmartVolumeMapper::GPURenderMode);
}

TEST_F(VolumeReceivers, samplesBetweenPeelsAreLikeOthers)
{
  this->lights = { this->scene.addSun({ 0.5, 0.1, -1.0 }) };
  vtkActor* const pane = this->scene.addBox({ 1.2, -0.1, 0.2 }, { 1.4, 0.1, 0.4 });
  pane->GetProperty()->SetOpacity(0.5); // or else VTK peels nothing
  this->scene.renderer->UseDepthPeelingOn();
  this->scene.renderer->UseDepthPeelingForVolumesOn();
  this->addSlab();
  this->firstSample = 2.0 * step; // in the volume, between two peels
  this->expectLikeMarch("peeled");
}

TEST_F(VolumeReceivers, otherVolumesStayAsTheyAre)
{
  this->lights = { this->scene.addSun({ 0.5, 0.1, -1.0 }) };
  this->addSlab();
  this->scene.pass->VolumesReceiveOff();
  this->expectPlain("switched off");
  EXPECT_THAT(this->told(), testing::HasSubstr("vtkVolume (casts nothing)"));
  this->scene.pass->VolumesReceiveOn();
  EXPECT_GT(differingPixels(this->scene.render(), this->scene.renderPlain()), 100u);
  vtkGnomonPropKeys::SetReceives(this->volume, false);
  this->expectPlain("by its key");
  vtkGnomonPropKeys::SetReceives(this->volume, true);
  vtkGnomonPropKeys::SetCasts(this->card, false);
  this->expectPlain("where nothing casts");
  vtkGnomonPropKeys::SetCasts(this->card, true);
  this->volume->GetProperty()->ShadeOff();
  this->expectPlain("ShadeOff");
  EXPECT_THAT(this->told(), testing::HasSubstr("vtkOpenGLGPUVolumeRayCastMapper (ShadeOff)"));
  this->volume->GetProperty()->ShadeOn();
  for (const int mode : { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND,
         vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, vtkVolumeMapper::ADDITIVE_BLEND })
  {
    this->mapper->SetBlendMode(mode);
    this->expectPlain("blended by mode " + std::to_string(mode));
    EXPECT_THAT(this->told(), testing::HasSubstr("not blended by opacity"));
  }
  this->mapper->SetBlendModeToComposite();
  vtkNew<vtkFixedPointVolumeRayCastMapper> software;
  software->AutoAdjustSampleDistancesOff(); // a busy machine then draws the same picture
  software->SetInputDataObject(this->mapper->GetInputDataObject(0, 0));
  this->volume->SetMapper(software);
  this->expectPlain("on the CPU");
  EXPECT_THAT(
    this->told(), testing::HasSubstr("vtkFixedPointVolumeRayCastMapper (mapper not served)"));
  this->volume->SetMapper(this->mapper);
  EXPECT_GT(differingPixels(this->scene.render(), this->scene.renderPlain()), 100u);
}

TEST_F(VolumeReceivers, surfacesInsideAndCroppingAreVtks)
{
  this->lights = { this->scene.addSun({ 0.5, 0.1, -1.0 }) };
  this->scene.addBox({ 0.2, -0.9, 0.3 }, { 0.8, 0.2, 0.6 });
  this->addSlab();
  this->mapper->CroppingOn();
  this->mapper->SetCroppingRegionPlanes(-0.9, 0.9, -0.9, 0.5, 0.0, 0.9);
  this->lights[0]->SetShadowAttenuation(0.0f);
  this->expectPlain("without shadows");
  this->lights[0]->SetShadowAttenuation(1.0f);
  EXPECT_GT(differingPixels(this->scene.render(), this->scene.renderPlain()), 100u);
}

TEST_F(VolumeReceivers, headlightsOfVolumesCast)
{
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  vtkGnomonLightKeys::SetCasts(headlight, true);
  this->scene.renderer->AddLight(headlight);
  this->addSlab();
  this->expectPlain("the card hides from the camera what it hides from the light");
  EXPECT_EQ(this->scene.report().lights.size(), 1u);
}

TEST(VolumeHookText, hasNoLightThatVtkHasNoRoomFor)
{
  std::vector<LightPlan> plans(2);
  for (LightPlan& plan : plans)
  {
    plan.estimator = plan.resting = findEstimator("pcf");
    plan.shadedBy = ShadedBy::Own;
    plan.light.shaderIndex = &plan == &plans.front() ? 1 : 6;
  }
  TechniqueCache cache;
  CastingLights lights;
  lights.begin(plans, cache);
  lights.take(plans);
  const VolumeHook hook(true, lights);
  std::string lit = "uniform vec3 in_lightDiffuseColor[6];\n"
                    "vec4 computeLighting(vec4 color, int component, float label)\n  {\n"
                    "  color.rgb *= in_lightDiffuseColor[0];\n  }\nvoid main()\n{\n";
  hook.fill(lit);
  EXPECT_THAT(lit, testing::HasSubstr("(in_lightDiffuseColor[0] * gnomonShare(0))"));
  EXPECT_THAT(lit, testing::HasSubstr("gnomonShare1 = "));
  EXPECT_THAT(lit, testing::Not(testing::HasSubstr("gnomonShare6")));
  EXPECT_THAT(lit, testing::HasSubstr("gnomonPlaceSamples();"));
  const std::string other = "uniform vec3 in_lightDiffuseColor[COUNT];\nvoid main() {}\n";
  std::string filled = other;
  hook.fill(filled);
  EXPECT_EQ(filled, other);
}

} // namespace
} // namespace gnomon::test
