// vtkGnomonLightSamplingPass: shading from each of many points of the light.

#include "PassScene.h"

#include "lights/LightManager.h"
#include "lights/LightSamples.h"
#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonLightSamplingPass.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/base/TextureMemory.h"
#include "vtkGnomonShadowSettings.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDepthPeelingPass.h>
#include <vtkFloatArray.h>
#include <vtkHardwareSelector.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLightCollection.h>
#include <vtkLookupTable.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderState.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkSSAOPass.h>
#include <vtkScalarBarActor.h>
#include <vtkSelection.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkToneMappingPass.h>
#include <vtkTransform.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

/// Counts the pictures that the delegate pass draws.
class CountingPass : public vtkRenderPass
{
public:
  static CountingPass* New();
  vtkTypeMacro(CountingPass, vtkRenderPass);
  void Render(const vtkRenderState* s) override
  {
    ++this->Count;
    this->Inner->Render(s);
    this->NumberOfRenderedProps = this->Inner->GetNumberOfRenderedProps();
  }
  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Inner->ReleaseGraphicsResources(window);
  }

  vtkSmartPointer<vtkRenderPass> Inner;
  int Count = 0;
};
vtkStandardNewMacro(CountingPass);

/// A picture's channels, unrounded.
using Channels = std::vector<double>;

Channels channelsOf(const Picture& picture)
{
  return Channels(picture.rgb.begin(), picture.rgb.end());
}

double largestDifference(const Channels& a, const Channels& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

double meanOf(const Channels& channels)
{
  return std::accumulate(channels.begin(), channels.end(), 0.0) /
    static_cast<double>(channels.size());
}

/// A lamp or sun with an area.
struct Named
{
  const char* name;
  std::function<vtkSmartPointer<vtkLight>()> make;
};
std::ostream& operator<<(std::ostream& stream, const Named& named)
{
  return stream << named.name;
}
std::string nameOfLight(const testing::TestParamInfo<Named>& info)
{
  return info.param.name;
}

const glm::dvec3 lampPlace(-2.0, -2.5, 4.0);

/// @param change further changes to the light
vtkSmartPointer<vtkGnomonAreaLight> rectangle(
  double coneAngleDegrees, const std::function<void(vtkGnomonAreaLight*)>& change = {})
{
  auto light = vtkSmartPointer<vtkGnomonAreaLight>::New();
  light->SetPosition(lampPlace.x, lampPlace.y, lampPlace.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetConeAngle(coneAngleDegrees);
  light->SetShapeToRectangle();
  light->SetWidth(2.0);
  light->SetHeight(1.0);
  if (change)
  {
    change(light);
  }
  return light;
}

/// Two rows of grey, red and dark, and of blue, white and black. No mean of them equals the
/// middle's colour.
vtkSmartPointer<vtkImageData> makePanes()
{
  constexpr std::array<std::array<unsigned char, 3>, 6> panes = { { { 90, 90, 90 }, { 255, 20, 10 },
    { 12, 25, 10 }, { 10, 50, 255 }, { 255, 255, 255 }, { 0, 0, 0 } } };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  for (const auto& pane : panes)
  {
    to = std::copy(pane.begin(), pane.end(), to);
  }
  return image;
}

/// So dim that no point's picture is clipped.
void addPanes(vtkGnomonAreaLight* light)
{
  light->SetIntensity(0.5);
  light->SetTexture(makePanes());
}
void makeDisk(vtkGnomonAreaLight* light, double radius)
{
  light->SetShapeToDisk();
  light->SetRadius(radius);
}

vtkSmartPointer<vtkLight> withRadius(
  const char* radius, const std::function<void(vtkLight*)>& change = {})
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetPosition(lampPlace.x, lampPlace.y, lampPlace.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  vtkGnomonLightKeys::SetSetting(light, "light_radius", radius);
  if (change)
  {
    change(light);
  }
  return light;
}

std::vector<Named> allLights()
{
  const auto inABox = [](vtkLight* light)
  {
    const double up[3] = { 0.3, 1.0, 0.0 };
    vtkGnomonLightKeys::SetBox(light, 5.0, 4.0, 9.0, up);
  };
  const auto fading = [](vtkGnomonAreaLight* light)
  {
    light->SetExponent(4.0);
    light->SetAttenuationValues(0.2, 0.1, 0.02);
    light->SetDiffuseColor(1.0, 0.8, 0.5);
    light->SetSpecularColor(0.3, 0.6, 1.0);
    light->SetAmbientColor(0.1, 0.1, 0.2);
  };
  const auto window = [](vtkGnomonAreaLight* light)
  {
    light->SetDiffuseColor(1.0, 0.8, 0.9);
    light->SetSpecularColor(0.5, 1.0, 0.7);
    addPanes(light);
  };
  const auto roundWindow = [](vtkGnomonAreaLight* light)
  {
    makeDisk(light, 1.2);
    addPanes(light);
  };
  const auto windowOfTheSky = [=](vtkGnomonAreaLight* light)
  {
    window(light);
    light->PositionalOff();
    light->SetWidth(24.0); // degrees
    light->SetHeight(16.0);
  };
  const auto lamp = [](vtkLight* light)
  {
    light->PositionalOn();
    light->SetConeAngle(allDirections);
  };
  const auto byAMatrix = [](vtkGnomonAreaLight* light)
  {
    vtkNew<vtkTransform> transform;
    transform->RotateZ(25.0);
    transform->Translate(0.3, 0.2, 0.1);
    light->SetTransformMatrix(transform->GetMatrix());
  };
  const auto castingHeadlight = [](vtkLight* light)
  {
    light->SetLightTypeToHeadlight();
    vtkGnomonLightKeys::SetCasts(light, true); // a headlight that is alone needs the key
  };
  const auto ofTheCamera = [](vtkGnomonAreaLight* light)
  {
    light->SetLightTypeToCameraLight();
    light->SetPosition(0.2, 0.3, 1.0);
  };
  return {
    { "sun", [] { return withRadius("15"); } },
    { "sunInABox", [=] { return withRadius("15", inABox); } },
    { "rectangle", [] { return rectangle(35.0); } },
    { "rectangleThatFades", [=] { return rectangle(50.0, fading); } },
    { "disk",
      [] { return rectangle(70.0, [](vtkGnomonAreaLight* light) { makeDisk(light, 0.8); }); } },
    { "window", [=] { return rectangle(60.0, window); } },
    { "roundWindow", [=] { return rectangle(70.0, roundWindow); } },
    { "windowOfTheSky", [=] { return rectangle(90.0, windowOfTheSky); } },
    { "ball", [=] { return withRadius("0.7", lamp); } },
    { "placedByAMatrix", [=] { return rectangle(60.0, byAMatrix); } },
    { "headlight", [=] { return withRadius("20", castingHeadlight); } },
    { "cameraLight", [=] { return rectangle(80.0, ofTheCamera); } },
  };
}

/// Return the colours of a light's points: those of its texture there, all scaled until their mean
/// is that of the texture.
std::vector<glm::dvec3> shineByHand(
  const gnomon::ShadowLight& light, const std::vector<glm::dvec3>& offsets)
{
  std::vector<glm::dvec3> shine(offsets.size(), glm::dvec3(1.0));
  if (light.texture)
  {
    glm::dvec3 mean(0.0);
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      shine[i] = glm::dvec3(light.texture->colourAt(offsets[i])) / 255.0;
      mean += shine[i] / static_cast<double>(offsets.size());
    }
    for (glm::dvec3& colour : shine)
    {
      colour *= glm::dvec3(light.texture->mean) / mean;
    }
  }
  return shine;
}

/// A box, a shining sphere and a floor, lit by an area light and shaded from each of its points.
class LightSamplingScene : public PassTest
{
protected:
  LightSamplingScene()
  {
    this->floor = this->scene.addFloor(4.0);
    this->box = this->scene.addBox({ -0.9, -0.7, 0.0 }, { 0.3, 0.5, 1.0 });
    this->sphere = this->scene.addSphere({ 1.3, 0.8, 0.9 }, 0.6);
    this->sphere->GetProperty()->SetColor(0.6, 0.5, 0.3);
    this->sphere->GetProperty()->SetSpecular(0.6);
    this->sphere->GetProperty()->SetSpecularPower(20.0);
    this->sphere->GetProperty()->SetAmbient(0.1);
    this->scene.lookFrom({ 2.0, -8.0, 7.0 });
    this->counting->Inner = this->scene.pass;
    this->sampling->SetDelegatePass(this->counting);
    this->sampling->SetSamples(8);
    this->scene.renderer->SetPass(this->sampling);
    this->scene.pass->SetTechnique("nsm");
  }

  void add(vtkLight* areaLight)
  {
    this->light = areaLight;
    this->scene.renderer->AddLight(areaLight);
  }

  /// Expect the delegate's picture from the centre, bit for bit; where the light has a texture,
  /// the delegate may have rounded its mean elsewhere.
  void expectHard(const Picture& picture, const Picture& hard)
  {
    auto* area = vtkGnomonAreaLight::SafeDownCast(this->light);
    EXPECT_EQ(differingPixels(picture, hard, area && area->GetTexture() ? 1 : 0), 0u);
  }

  Picture pictureOf(vtkRenderPass* pass)
  {
    vtkSmartPointer<vtkRenderPass> before = this->scene.renderer->GetPass();
    this->scene.renderer->SetPass(pass);
    Picture picture = this->scene.render();
    this->scene.renderer->SetPass(before);
    return picture;
  }

  /// Draw a picture of a pass for each point of the light, by a VTK light placed there by hand.
  /// @param add called with each picture
  void forEachPoint(vtkRenderPass* pass, const std::function<void(const Picture&)>& add)
  {
    this->scene.render(); // head lights follow the camera
    std::vector<gnomon::ShadowLight> areas =
      gnomon::LightManager().collectAreas(this->scene.renderer, {}).lights;
    ASSERT_EQ(areas.size(), 1u);
    gnomon::ShadowLight& area = areas[0];
    area.lightSamples = this->sampling->GetSamples();
    vtkNew<vtkLight> point;
    point->DeepCopy(this->light);
    point->SetTransformMatrix(nullptr);
    point->SetLightTypeToSceneLight();
    vtkGnomonLightKeys::SetSetting(point, "light_radius", "0");
    this->scene.renderer->RemoveLight(this->light);
    this->scene.renderer->AddLight(point);
    const std::vector<glm::dvec3> offsets = gnomon::pairedLightSamples(area);
    const std::vector<glm::dvec3> shine = shineByHand(area, offsets);
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      const glm::dvec3& offset = offsets[i];
      const glm::dvec3 diffuse = glm::make_vec3(this->light->GetDiffuseColor()) * shine[i];
      const glm::dvec3 specular = glm::make_vec3(this->light->GetSpecularColor()) * shine[i];
      point->SetDiffuseColor(diffuse.x, diffuse.y, diffuse.z);
      point->SetSpecularColor(specular.x, specular.y, specular.z);
      const bool sun = area.kind == gnomon::LightKind::Directional;
      const glm::dvec3 place = area.positionWorld + (sun ? glm::dvec3(0.0) : offset);
      const glm::dvec3 target =
        place + 3.0 * (sun ? area.directionWorld - offset : area.directionWorld);
      point->SetPosition(place.x, place.y, place.z);
      point->SetFocalPoint(target.x, target.y, target.z);
      add(this->pictureOf(pass));
    }
    this->scene.renderer->RemoveLight(point);
    this->scene.renderer->AddLight(this->light);
  }

  /// Return the pictures' mean.
  /// @param gamma the pictures' values to this power are linear light
  Channels meanByHand(vtkRenderPass* pass, double gamma = 1.0)
  {
    Channels sum;
    int pictures = 0;
    this->forEachPoint(pass,
      [&](const Picture& picture)
      {
        sum.resize(picture.rgb.size(), 0.0);
        for (std::size_t i = 0; i < sum.size(); ++i)
        {
          sum[i] += std::pow(picture.rgb[i] / 255.0, gamma);
        }
        ++pictures;
      });
    for (double& value : sum)
    {
      value = 255.0 * std::pow(value / pictures, 1.0 / gamma);
    }
    return sum;
  }

  /// Expect a picture to be that mean except for roundings: each of the pictures and the mean are
  /// rounded to eight bits.
  void expectMean(const Picture& seen, vtkRenderPass* pass, double tolerance = 1.0)
  {
    EXPECT_LE(largestDifference(channelsOf(seen), this->meanByHand(pass)), tolerance);
  }

  PassScene scene{ 140, 100 };
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  vtkNew<CountingPass> counting;
  vtkSmartPointer<vtkLight> light;
  vtkActor* floor = nullptr;
  vtkActor* box = nullptr;
  vtkActor* sphere = nullptr;
};

class LightSamplingOf
  : public LightSamplingScene
  , public testing::WithParamInterface<Named>
{
protected:
  LightSamplingOf() { this->add(GetParam().make()); }
};

INSTANTIATE_TEST_SUITE_P(Lights, LightSamplingOf, testing::ValuesIn(allLights()), nameOfLight);

//------------------------------------------------------------------------------
/// With one sample it is the hard picture, bit for bit, however the delegate treats area lights.
TEST_P(LightSamplingOf, oneSampleIsTheHardPicture)
{
  this->sampling->SetSamples(1);
  this->expectHard(this->scene.render(), this->pictureOf(this->scene.pass));
  this->scene.pass->SetTechnique("silhouette");
  const Picture hard = this->pictureOf(this->scene.pass);
  this->scene.pass->SetTechnique("raytraced");
  EXPECT_GT(differingPixels(this->pictureOf(this->scene.pass), hard, 20), 0u);
  this->expectHard(this->scene.render(), hard);
}

//------------------------------------------------------------------------------
/// The picture equals the mean of pictures with VTK's own lights at the points.
TEST_P(LightSamplingOf, meanIsThatOfPicturesByHand)
{
  for (const int samples : { 6, 7 })
  {
    this->sampling->SetSamples(samples);
    const Picture seen = this->scene.render();
    EXPECT_GT(differingPixels(seen, this->pictureOf(this->scene.pass), 10), 100u) << "soft";
    this->expectMean(seen, this->scene.pass);
  }
  // Also without a delegate, that is without shadows.
  this->sampling->SetDelegatePass(nullptr);
  this->expectMean(this->scene.render(), nullptr);
}

//------------------------------------------------------------------------------
TEST_P(LightSamplingOf, lightsAreAsTheyWere)
{
  const Picture plain = this->pictureOf(nullptr);
  this->scene.render();
  vtkLightCollection* lights = this->scene.renderer->GetLights();
  vtkMatrix4x4* matrix = this->light->GetTransformMatrix();
  const glm::dvec3 position = glm::make_vec3(this->light->GetPosition());
  const vtkMTimeType keysTime = this->light->GetInformation()->GetMTime();
  int modified = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&modified);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* counter, void*) { ++*static_cast<int*>(counter); });
  this->light->AddObserver(vtkCommand::ModifiedEvent, count);
  this->scene.renderer->AddObserver(vtkCommand::ModifiedEvent, count);
  for (int frame = 0; frame < 2; ++frame)
  {
    this->scene.render();
    EXPECT_EQ(this->scene.renderer->GetLights(), lights);
    EXPECT_EQ(lights->GetNumberOfItems(), 1);
    EXPECT_EQ(lights->GetItemAsObject(0), this->light);
    EXPECT_EQ(this->light->GetTransformMatrix(), matrix);
    EXPECT_EQ(glm::make_vec3(this->light->GetPosition()), position);
    EXPECT_EQ(this->light->GetInformation()->GetMTime(), keysTime);
  }
  EXPECT_EQ(modified, 0);
  // Shaders keep no former light places, with a delegate or without.
  EXPECT_EQ(this->pictureOf(nullptr), plain);
  this->sampling->SetDelegatePass(nullptr);
  this->scene.render();
  EXPECT_EQ(this->pictureOf(nullptr), plain);
}

//------------------------------------------------------------------------------
TEST_P(LightSamplingOf, refinesToWhatOneFrameShows)
{
  for (const int samples : { 16, 17 })
  {
    this->sampling->SetSamples(samples);
    this->sampling->SetSamplesPerFrame(0);
    const Picture whole = this->scene.render();
    EXPECT_EQ(this->sampling->GetProgress(), 1.0);
    this->sampling->SetSamplesPerFrame(5);
    this->counting->Count = 0;
    this->expectHard(this->scene.render(), this->pictureOf(this->scene.pass)); // the centre's
    EXPECT_EQ(this->sampling->GetProgress(), 0.0);
    EXPECT_EQ(this->counting->Count, 1);
    for (int frame = 1; this->sampling->GetProgress() < 1.0; ++frame)
    {
      ASSERT_LT(frame, 10);
      this->scene.render();
      const int pictures = std::min(samples, 6 * frame - samples % 2);
      EXPECT_EQ(this->sampling->GetProgress(), static_cast<double>(pictures) / samples);
      EXPECT_EQ(this->counting->Count, pictures + 1);
    }
    EXPECT_EQ(this->scene.render(), whole);
    EXPECT_EQ(this->counting->Count, samples + 1) << "nothing is drawn again";
  }
}

//------------------------------------------------------------------------------
class LightSampling : public LightSamplingScene
{
protected:
  LightSampling() { this->add(rectangle(50.0)); }

  void leaveFloorAlone()
  {
    this->box->VisibilityOff();
    this->sphere->VisibilityOff();
  }

  /// Render until the picture is complete.
  void finish()
  {
    int frame = 0;
    do
    {
      this->scene.render();
      ASSERT_LT(frame++, 20);
    } while (this->sampling->GetProgress() < 1.0);
  }
};

//------------------------------------------------------------------------------
/// Without occlusion, frames differ in brightness only by the effect of the light's size.
TEST_F(LightSampling, refinesAtConstantBrightness)
{
  this->leaveFloorAlone();
  this->sampling->SetSamples(64);
  this->sampling->SetSamplesPerFrame(2);
  std::vector<double> means;
  do
  {
    means.push_back(meanOf(channelsOf(this->scene.render())));
  } while (this->sampling->GetProgress() < 1.0);
  EXPECT_EQ(means.size(), 33u);
  for (const double mean : means)
  {
    EXPECT_NEAR(mean, means.back(), 0.02 * means.back());
  }
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, refinesAnewWhenSomethingChanges)
{
  this->sampling->SetSamplesPerFrame(4);
  vtkNew<vtkTextActor> text;
  text->SetInput("3");
  this->scene.renderer->AddViewProp(text);
  // A caster outside the camera's view.
  vtkNew<vtkPlaneSource> behind;
  behind->SetOrigin(-2.2, -3.0, 3.0);
  behind->SetPoint1(-1.8, -3.0, 3.0);
  behind->SetPoint2(-2.2, -2.6, 3.0);
  this->scene.add(behind);
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(this->light);
  vtkNew<vtkLight> other;
  other->SetIntensity(0.1);
  vtkNew<vtkImageData> colour;
  colour->SetDimensions(1, 1, 1);
  colour->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  vtkNew<vtkGnomonAreaLight> point;
  point->SetRadius(0.0);
  point->SetIntensity(0.1);
  point->SetTexture(colour);
  this->scene.pass->ObeyUseShadowsOn();
  this->scene.renderer->UseShadowsOn();
  vtkNew<vtkGnomonShadowSettings> settings;
  vtkNew<vtkTexture> sky;
  sky->SetInputData(colour);
  vtkNew<vtkLookupTable> table;
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  this->scene.renderer->AddViewProp(bar);
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "camera",
      [&] {
        this->scene.lookFrom({ 2.1, -8.0, 7.0 });
      } },
    { "light", [&] { lamp->SetPosition(-2.0, -2.6, 4.0); } },
    { "size", [&] { lamp->SetWidth(0.8); } },
    { "colour", [&] { lamp->SetDiffuseColor(1.0, 0.9, 0.8); } },
    { "seed", [&] { vtkGnomonLightKeys::SetSetting(lamp, "light_seed", "3"); } },
    { "another light", [&] { this->scene.renderer->AddLight(other); } },
    { "no other light", [&] { this->scene.renderer->RemoveLight(other); } },
    { "caster", [&] { this->box->SetPosition(0.1, 0.0, 0.0); } },
    { "material", [&] { this->sphere->GetProperty()->SetSpecular(0.3); } },
    { "casting", [&] { vtkGnomonPropKeys::SetCasts(this->box, false); } },
    { "receiving", [&] { vtkGnomonPropKeys::SetReceives(this->sphere, false); } },
    { "caster out of view", [&] { behind->SetCenter(-1.9, -2.8, 3.0); } },
    { "visible", [&] { this->box->VisibilityOff(); } },
    { "text", [&] { text->SetInput("4"); } },
    { "background", [&] { this->scene.renderer->SetBackground(0.1, 0.2, 0.3); } },
    { "samples", [&] { this->sampling->SetSamples(10); } },
    { "delegate's setting", [&] { this->counting->Modified(); } },
    { "delegate", [&] { this->sampling->SetDelegatePass(this->scene.pass); } },
    { "technique", [&] { this->scene.pass->SetTechnique("pcf"); } },
    { "window", [&] { this->scene.window->SetSize(120, 90); } },
    { "samples of a pixel", [&] { this->scene.window->SetMultiSamples(4); } },
    { "one sample of a pixel", [&] { this->scene.window->SetMultiSamples(0); } },
    { "shadows", [&] { this->scene.renderer->UseShadowsOff(); } },
    { "a point with a texture", [&] { this->scene.renderer->AddLight(point); } },
    { "its texture",
      [&]
      {
        colour->SetScalarComponentFromDouble(0, 0, 0, 0, 200.0);
        colour->GetPointData()->GetScalars()->Modified();
      } },
    { "no point", [&] { this->scene.renderer->RemoveLight(point); } },
    { "pass's settings", [&] { this->scene.pass->GetSettings()->SetMapSize(200); } },
    { "light's settings", [&] { vtkGnomonLightKeys::SetSettings(lamp, settings); } },
    { "one of them", [&] { settings->SetMapSize(300); } },
    { "scalar bar's table", [&] { table->SetHueRange(0.2, 0.4); } },
    { "scalar bar's text", [&] { bar->GetLabelTextProperty()->SetOpacity(0.5); } },
    { "background's texture",
      [&]
      {
        this->scene.renderer->SetBackgroundTexture(sky);
        this->scene.renderer->TexturedBackgroundOn();
      } },
    { "its pixels",
      [&]
      {
        colour->SetScalarComponentFromDouble(0, 0, 0, 0, 100.0);
        colour->Modified();
      } },
  };
  for (const auto& [what, change] : changes)
  {
    this->finish();
    change();
    this->scene.render();
    EXPECT_EQ(this->sampling->GetProgress(), 0.0) << what;
    this->scene.render();
    EXPECT_GT(this->sampling->GetProgress(), 0.3) << what;
  }
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, tellsOfItsProgress)
{
  std::vector<double> told;
  listenToProgress(this->sampling, told);
  this->scene.render();
  EXPECT_EQ(told, std::vector<double>());
  this->sampling->SetSamplesPerFrame(4);
  for (int frame = 0; frame < 5; ++frame)
  {
    this->scene.render();
  }
  EXPECT_EQ(told, std::vector<double>({ 0.0, 0.5, 1.0, 2.0 }));
}

//------------------------------------------------------------------------------
/// Lambert and 1 / d^2 under a large near light. The mean over a rectangle of h / d^3 is its solid
/// angle over its area.
TEST_F(LightSampling, attenuatedCosinesAreThoseOfGeometry)
{
  this->leaveFloorAlone();
  const double height = 1.0;
  const glm::dvec2 half(1.5, 1.0);
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(this->light);
  lamp->SetConeAngle(90.0);
  lamp->SetPosition(0.0, 0.0, height);
  lamp->SetUp(0.0, 1.0, 0.0);
  lamp->SetWidth(2.0 * half.x);
  lamp->SetHeight(2.0 * half.y);
  const double area = 4.0 * half.x * half.y;
  const auto corner = [&](double x, double y)
  { return std::atan2(x * y, height * std::sqrt(x * x + y * y + height * height)); };
  const auto exact = [&](const glm::dvec2& at)
  {
    return (corner(at.x + half.x, at.y + half.y) - corner(at.x - half.x, at.y + half.y) -
             corner(at.x + half.x, at.y - half.y) + corner(at.x - half.x, at.y - half.y)) /
      area;
  };
  lamp->SetAttenuationValues(0.0, 0.0, 1.0);
  lamp->SetIntensity(0.95 / exact(glm::dvec2(0.0)));
  this->scene.lookDown(2.0);
  this->sampling->SetSamples(256);
  this->sampling->SetDelegatePass(nullptr);
  const Picture seen = this->scene.render();
  double worst = 0.0;
  double worstOfCentre = 0.0;
  for (int y = 0; y < seen.height; ++y)
  {
    for (int x = 0; x < seen.width; ++x)
    {
      const glm::dvec2 at = this->scene.floorAt(x, y);
      const double value = 255.0 * lamp->GetIntensity() * exact(at);
      if (value < 60.0)
      {
        continue; // rounding exceeds a percent
      }
      worst = std::max(worst, (std::abs(seen.red(x, y) - value) - 0.5) / value);
      const double distance = glm::length(glm::dvec3(at, height));
      worstOfCentre = std::max(worstOfCentre,
        std::abs(255.0 * lamp->GetIntensity() * height / std::pow(distance, 3.0) - value) / value);
    }
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(worstOfCentre, 0.5); // the error of shading from the centre
}

//------------------------------------------------------------------------------
/// VTK's physically based shading outputs light to the power 1 / 2.2. Light is averaged.
TEST_F(LightSampling, physicallyBasedShadingIsAveragedAsLight)
{
  for (vtkActor* actor : { this->floor, this->box, this->sphere })
  {
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(0.4);
    actor->GetProperty()->SetMetallic(0.3);
    actor->GetProperty()->SetCoatStrength(0.5);
  }
  this->light->SetIntensity(0.7); // no picture is then clipped
  const Channels seen = channelsOf(this->scene.render());
  // In dark pixels, the root enlarges the rounding to eight bits.
  EXPECT_LE(largestDifference(seen, this->meanByHand(this->scene.pass, 2.2)), 1.5);
  this->sampling->SetGamma(1.0);
  const Channels asShown = channelsOf(this->scene.render());
  EXPECT_GT(largestDifference(seen, asShown), 30.0);
  EXPECT_LE(largestDifference(asShown, this->meanByHand(this->scene.pass)), 1.0);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, lightsWithoutAreaStay)
{
  vtkLight* sun = this->scene.addSun({ -1.0, 0.3, -1.5 });
  sun->SetIntensity(0.3);
  this->light->SetIntensity(0.5); // no picture is then clipped
  this->expectMean(this->scene.render(), this->scene.pass);
  this->light->SwitchOff();
  this->counting->Count = 0;
  const vtkMTimeType time = this->scene.renderer->GetLights()->GetMTime();
  EXPECT_EQ(this->scene.render(), this->pictureOf(this->scene.pass));
  EXPECT_EQ(this->counting->Count, 1);
  EXPECT_EQ(this->scene.renderer->GetLights()->GetMTime(), time);
}

//------------------------------------------------------------------------------
/// Lights that cast no shadow are shaded from all of their points as well.
TEST_F(LightSampling, lightsWithoutShadowsAreSampled)
{
  this->light->SetShadowAttenuation(0.0f);
  this->expectMean(this->scene.render(), nullptr);
}

//------------------------------------------------------------------------------
// Windows and neighbours
//------------------------------------------------------------------------------

TEST_F(LightSampling, windowsWithSeveralSamplesPerPixelStaySmooth)
{
  this->scene.window->SetMultiSamples(4);
  const Picture seen = this->scene.render();
  this->expectMean(seen, this->scene.pass);
  this->scene.window->SetMultiSamples(0);
  EXPECT_GT(differingPixels(seen, this->scene.render(), 20), 50u);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, depthsAreThoseOfThePlainPicture)
{
  const auto depthsOf = [&](vtkRenderPass* pass)
  {
    this->pictureOf(pass);
    vtkNew<vtkFloatArray> depths;
    this->scene.window->GetZbufferData(0, 0, 139, 99, depths);
    return std::vector<float>(depths->GetPointer(0), depths->GetPointer(140 * 100));
  };
  const std::vector<float> plain = depthsOf(nullptr);
  EXPECT_LT(*std::min_element(plain.begin(), plain.end()), 0.9f);
  EXPECT_THAT(depthsOf(this->sampling), testing::Pointwise(testing::FloatNear(1e-6f), plain));
}

//------------------------------------------------------------------------------
/// The layers below are part of the pictures and may change in every frame, so every frame takes
/// all samples.
TEST_F(LightSampling, partsOfWindowsAndLayersAreShown)
{
  this->sampling->SetSamplesPerFrame(2);
  this->scene.window->SetNumberOfLayers(2);
  this->scene.renderer->SetLayer(1);
  this->scene.renderer->SetViewport(0.4, 0.2, 1.0, 0.9);
  vtkNew<vtkRenderer> below;
  this->scene.window->AddRenderer(below);
  for (const double green : { 0.2, 0.6, 0.4 })
  {
    below->SetBackground(0.2, green, 0.6);
    const Picture seen = this->scene.render();
    EXPECT_EQ(this->sampling->GetProgress(), 1.0);
    EXPECT_EQ(seen.at(2, 2), glm::ivec3(glm::round(255.0 * glm::dvec3(0.2, green, 0.6))));
    EXPECT_EQ(seen.at(138, 88), seen.at(2, 2)) << "through the layer";
  }
  const Picture seen = this->scene.render();
  EXPECT_GT(differingPixels(seen, this->pictureOf(this->scene.pass), 10), 50u);
  this->expectMean(seen, this->scene.pass);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, alphaIsThatOfThePlainPicture)
{
  this->scene.window->AlphaBitPlanesOn();
  this->sphere->GetProperty()->SetOpacity(0.5);
  this->scene.lookFrom({ 2.0, -12.0, 3.0 });
  vtkNew<vtkRenderStepsPass> steps; // as in every framebuffer of a pass
  this->scene.pass->SetDelegatePass(steps);
  const auto alphasOf = [&](vtkRenderPass* pass)
  {
    this->pictureOf(pass);
    vtkNew<vtkUnsignedCharArray> rgba;
    this->scene.window->GetRGBACharPixelData(0, 0, 139, 99, 0, rgba);
    std::vector<double> alphas;
    for (vtkIdType i = 0; i < rgba->GetNumberOfTuples(); ++i)
    {
      alphas.push_back(rgba->GetTypedComponent(i, 3));
    }
    return alphas;
  };
  const std::vector<double> plain = alphasOf(this->scene.pass);
  EXPECT_GT(std::count(plain.begin(), plain.end(), 0), 100);
  EXPECT_GT(std::count(plain.begin(), plain.end(), 255), 100);
  EXPECT_LE(largestDifference(alphasOf(this->sampling), plain), 1.0);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, translucentSurfacesAreShown)
{
  this->box->GetProperty()->SetOpacity(0.4);
  this->sphere->GetProperty()->SetOpacity(0.6);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkDepthPeelingPass> peeling;
  vtkNew<vtkTranslucentPass> translucent;
  peeling->SetTranslucentPass(translucent);
  steps->SetTranslucentPass(peeling);
  this->scene.pass->SetDelegatePass(steps);
  // The background is rounded to eight bits, too.
  this->expectMean(this->scene.render(), this->scene.pass, 2.0);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, stepsAsideForSelections)
{
  this->sampling->SetSamplesPerFrame(4);
  this->scene.render();
  this->scene.render();
  const double progress = this->sampling->GetProgress();
  const int pictures = this->counting->Count;
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->scene.renderer);
  selector->SetArea(0, 0, 139, 99);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 3u);
  EXPECT_EQ(this->sampling->GetProgress(), progress);
  EXPECT_GT(this->counting->Count, pictures);
  this->scene.render();
  EXPECT_GT(this->sampling->GetProgress(), progress);
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, severalViewsGetAllInEveryFrame)
{
  this->sampling->SetSamplesPerFrame(2);
  this->scene.window->StereoCapableWindowOn();
  this->scene.window->SetStereoTypeToAnaglyph();
  this->scene.window->StereoRenderOn();
  for (int frame = 0; frame < 2; ++frame)
  {
    this->counting->Count = 0;
    this->scene.render();
    EXPECT_EQ(this->sampling->GetProgress(), 1.0);
    EXPECT_EQ(this->counting->Count, 16);
  }
}

//------------------------------------------------------------------------------
/// Nine tiles, which the camera sees one by one.
TEST_F(LightSampling, tilesShowAllOfEachPart)
{
  this->sampling->SetSamplesPerFrame(2);
  this->scene.render();
  this->counting->Count = 0;
  vtkNew<vtkWindowToImageFilter> large;
  large->SetInput(this->scene.window);
  large->SetScale(3);
  large->Update();
  EXPECT_EQ(this->counting->Count % 8, 0);
  EXPECT_GE(this->counting->Count, 72);
  this->scene.window->SetSize(420, 300);
  this->sampling->SetSamplesPerFrame(0);
  const Picture seen = this->scene.render();
  const auto* tiled = static_cast<const unsigned char*>(large->GetOutput()->GetScalarPointer());
  Picture joined = seen;
  std::copy(tiled, tiled + joined.rgb.size(), joined.rgb.begin());
  EXPECT_LT(differingPixels(seen, joined, 20), 300u); // edges, since pixels are split differently
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, otherPassesStandAroundAndInside)
{
  const Picture seen = this->scene.render();
  const auto alike = [&](vtkRenderPass* pass)
  {
    // Except edges, which those passes smooth.
    const Picture through = this->pictureOf(pass);
    EXPECT_LT(differingPixels(seen, through, 40), 700u) << pass->GetClassName();
    EXPECT_NEAR(meanOf(channelsOf(through)), meanOf(channelsOf(seen)), 2.0) << pass->GetClassName();
    pass->ReleaseGraphicsResources(this->scene.window);
  };
  vtkNew<vtkSSAAPass> supersampling;
  supersampling->SetDelegatePass(this->sampling);
  alike(supersampling);
  vtkNew<vtkOpenGLFXAAPass> fxaa;
  fxaa->SetDelegatePass(this->sampling);
  alike(fxaa);
  vtkNew<vtkToneMappingPass> toneMapping;
  toneMapping->SetToneMappingType(vtkToneMappingPass::Clamp);
  toneMapping->SetDelegatePass(this->sampling);
  alike(toneMapping);
  vtkNew<vtkSSAOPass> occlusion;
  vtkNew<vtkRenderStepsPass> steps;
  occlusion->SetDelegatePass(steps);
  occlusion->SetRadius(0.1);
  this->scene.pass->SetDelegatePass(occlusion);
  this->expectMean(this->scene.render(), this->scene.pass);
}

//------------------------------------------------------------------------------
// Unsupported uses
//------------------------------------------------------------------------------

TEST_F(LightSampling, refusesWhatItCannotShow)
{
  // Ambient occlusion around the pass needs positions as well.
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetDelegatePass(this->sampling);
  occlusion->SetRadius(0.1);
  this->pictureOf(occlusion);
  occlusion->ReleaseGraphicsResources(this->scene.window);
  EXPECT_THAT(this->takeErrors(), HasSubstr("several images"));

  const Picture centre = this->pictureOf(this->scene.pass);
  this->scene.renderer->PreserveDepthBufferOn();
  this->counting->Count = 0;
  this->scene.render();
  EXPECT_THAT(this->takeErrors(), HasSubstr("PreserveDepthBuffer"));
  EXPECT_EQ(this->counting->Count, 1);
  EXPECT_EQ(this->sampling->GetProgress(), 1.0) << "there is nothing to wait for";
  this->scene.renderer->PreserveDepthBufferOff();

  vtkGnomonLightKeys::SetSetting(this->light, "light_sampling", "jittered");
  EXPECT_EQ(differingPixels(this->scene.render(), centre), 0u);
  EXPECT_THAT(this->takeErrors(),
    testing::AllOf(HasSubstr("light 0"), HasSubstr("opposite pairs"), HasSubstr("sobol")));
  vtkGnomonLightKeys::SetSetting(this->light, "light_sampling", "random");
  EXPECT_GT(differingPixels(this->scene.render(), centre, 10), 100u);
  EXPECT_EQ(this->takeErrors(), "");
}

//------------------------------------------------------------------------------
/// A viewer who looks up at a texture in the sky sees it unmirrored. A plate over one half of the
/// floor hides a part of it, which shows how it lies.
TEST_F(LightSampling, aTextureInTheSkyLiesAsItIsSeen)
{
  this->leaveFloorAlone();
  const double slope = 0.2;  // of the directions to the window's sides
  const double height = 5.0; // of the plate, so that its penumbra ends at 1 and -1
  auto* sky = vtkGnomonAreaLight::SafeDownCast(this->light);
  sky->PositionalOff();
  sky->SetPosition(0.0, 0.0, 1.0);
  sky->SetWidth(2.0 * glm::degrees(std::atan(slope)));
  sky->SetHeight(2.0 * glm::degrees(std::atan(slope)));
  this->sampling->SetSamples(256);
  this->scene.pass->SetTechnique("raytraced");
  this->scene.window->SetSize(60, 44);
  this->scene.lookDown(1.2);
  this->scene.renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 0.5 * height); // below the plate
  for (const int axis : { 0, 1 })
  {
    glm::dvec3 end(8.0, 8.0, height + 0.01);
    end[axis] = 0.0;
    vtkActor* const plate = this->scene.addBox({ -8.0, -8.0, height }, end);
    // Looking up with +y upwards, the texture's left is at +x and its top at +y. Those parts are
    // visible from where the plate's penumbra ends.
    sky->SetTexture(makeImage(axis == 0 ? 2 : 1, axis == 0 ? 1 : 2,
      [&](int x, int y)
      {
        const bool leftOrTop = axis == 0 ? x == 0 : y == 1;
        return leftOrTop ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
      }));
    const Picture seen = this->scene.render();
    for (int y = 0; y < seen.height; ++y)
    {
      for (int x = 0; x < seen.width; ++x)
      {
        const double place = this->scene.floorAt(x, y)[axis];
        const glm::dvec3 expected(
          0.5 * std::clamp(1.0 + place, 0.0, 1.0), 0.0, 0.5 * std::clamp(place, 0.0, 1.0));
        EXPECT_LT(glm::distance(glm::dvec3(seen.at(x, y)), 255.0 * expected), 8.0)
          << axis << ", " << place;
      }
    }
    this->scene.renderer->RemoveActor(plate);
  }
}

//------------------------------------------------------------------------------
/// If no point has light in a channel, there is nothing to scale.
TEST_F(LightSampling, channelsThatNoPointHasStayDark)
{
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(this->light);
  vtkNew<vtkLight> other;
  other->SetPosition(3.0, -4.0, 5.0);
  other->SetFocalPoint(0.0, 0.0, 0.0);
  other->SetIntensity(0.6);
  this->scene.renderer->AddLight(other);
  this->sampling->SetSamples(2);
  lamp->SwitchOff();
  const Picture without = this->scene.render();
  lamp->SwitchOn();
  for (const double red : { 0.0, 1.0 })
  {
    // Red at most, at a texel with neither of the two points.
    lamp->SetTexture(makeImage(
      16, 16, [&](int x, int y) { return glm::dvec3(x + y == 0 ? red : 0.0, 0.0, 0.0); }));
    const Picture with = this->scene.render();
    EXPECT_EQ(differingPixels(with, without, 1), 0u) << red;
    EXPECT_TRUE(this->scene.render() == with);
    EXPECT_EQ(this->scene.report().programCompiles, 0) << "a light that is black is still one";
  }
}

//------------------------------------------------------------------------------
/// Lights that cannot be sampled are reported, unless they light nothing.
TEST_F(LightSampling, saysWhichLightsAreNotSampled)
{
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(this->light);
  lamp->SetUp(2.0, 2.5, -4.0);
  const auto saysUp = HasSubstr("light 0: its area has its up direction along");
  this->scene.render();
  EXPECT_THAT(this->takeErrors(), saysUp);
  lamp->SwitchOff();
  this->scene.render();
  EXPECT_EQ(this->takeErrors(), "");
  lamp->SwitchOn();
  lamp->SetUp(0.0, 1.0, 0.0);
  vtkNew<vtkImageData> empty;
  lamp->SetTexture(empty);
  this->scene.render();
  EXPECT_THAT(this->takeErrors(), HasSubstr("light 0: its texture"));
  lamp->SetTexture(nullptr);
  // A light without an area cannot have a wrong one.
  vtkNew<vtkLight> nowhere;
  nowhere->SetPosition(0.0, 0.0, 0.0);
  nowhere->SetFocalPoint(0.0, 0.0, 0.0);
  nowhere->SetIntensity(0.1);
  this->scene.renderer->AddLight(nowhere);
  this->scene.pass->SetTechnique("nsm");
  this->scene.render();
  EXPECT_EQ(this->takeErrors(), "");
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, asksForRoomFirst)
{
  try
  {
    gnomon::requireRoomForPicture(1 << 20, 1 << 20, 8);
    ADD_FAILURE() << "176 TB";
  }
  catch (const gnomon::TextureMemoryError& error)
  {
    EXPECT_THAT(error.what(),
      testing::AllOf(HasSubstr("8 samples of a pixel of 1048576 x 1048576"), HasSubstr("MB")));
  }
}

//------------------------------------------------------------------------------
TEST_F(LightSampling, printsItself)
{
  std::ostringstream text;
  this->sampling->Print(text);
  for (const char* part :
    { "DelegatePass: CountingPass", "Samples: 8", "SamplesPerFrame: 0", "Gamma: 0", "Progress: 1" })
  {
    EXPECT_THAT(text.str(), HasSubstr(part));
  }
}

//------------------------------------------------------------------------------
/// A thousand and one pictures are added up in the memory of two.
TEST_F(LightSampling, takesAThousandPictures)
{
  this->scene.window->SetSize(24, 16);
  this->scene.pass->SetTechnique("raytraced");
  this->sampling->SetSamples(1025);
  this->scene.render();
  EXPECT_EQ(this->counting->Count, 1025);
  const Picture seen = this->scene.render();
  this->sampling->SetSamples(256);
  EXPECT_LT(largestDifference(channelsOf(seen), channelsOf(this->scene.render())), 6.0);
}

} // namespace
