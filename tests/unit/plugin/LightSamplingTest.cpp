// vtkGnomonLightSamplingPass: shading from each of many points of the light.

#include "AreaLights.h"

#include "lights/LightManager.h"
#include "lights/LightSamples.h"
#include "plugin/vtkGnomonLightSamplingPass.h"
#include "shadowtech/base/TextureMemory.h"
#include "vtkGnomonShadowSettings.h"

#include <vtkCommand.h>
#include <vtkDepthPeelingPass.h>
#include <vtkInformation.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkRenderState.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkSSAOPass.h>
#include <vtkToneMappingPass.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <numeric>

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
using Channels = std::vector<float>;

double meanOf(const Channels& channels)
{
  return std::accumulate(channels.begin(), channels.end(), 0.0) /
    static_cast<double>(channels.size());
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
struct LightSamplingScene : PassTest
{
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

  /// Expect the delegate's picture from the centre, bit for bit; where the light has a texture,
  /// the delegate may have rounded its mean elsewhere.
  void expectHard(const Picture& picture, const Picture& hard)
  {
    auto* area = vtkGnomonAreaLight::SafeDownCast(this->light);
    EXPECT_EQ(differingPixels(picture, hard, area && area->GetTexture() ? 1 : 0), 0u);
  }

  Picture pictureOf(vtkRenderPass* pass) { return this->scene.renderBy(pass); }

  /// Return the mean of a pass's pictures for each point of the light, by a VTK light placed there
  /// by hand.
  /// @param gamma the pictures' values to this power are linear light
  Channels meanByHand(vtkRenderPass* pass, double gamma = 1.0)
  {
    this->scene.render(); // head lights follow the camera
    gnomon::ShadowLight area =
      gnomon::LightManager().collectAreas(this->scene.renderer, {}).lights.at(0);
    area.lightSamples = this->sampling->GetSamples();
    vtkNew<vtkLight> point;
    point->DeepCopy(this->light);
    point->SetTransformMatrix(nullptr);
    point->SetLightTypeToSceneLight();
    set(point, "light_radius", "0");
    this->scene.renderer->RemoveLight(this->light);
    this->scene.renderer->AddLight(point);
    const std::vector<glm::dvec3> offsets = gnomon::pairedLightSamples(area);
    const std::vector<glm::dvec3> shine = shineByHand(area, offsets);
    Channels mean;
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      const glm::dvec3 diffuse = glm::make_vec3(this->light->GetDiffuseColor()) * shine[i];
      const glm::dvec3 specular = glm::make_vec3(this->light->GetSpecularColor()) * shine[i];
      point->SetDiffuseColor(diffuse.x, diffuse.y, diffuse.z);
      point->SetSpecularColor(specular.x, specular.y, specular.z);
      const bool sun = area.kind == gnomon::LightKind::Directional;
      const glm::dvec3 place = area.positionWorld + (sun ? glm::dvec3(0.0) : offsets[i]);
      aim(point, place, place + 3.0 * (area.directionWorld - (sun ? offsets[i] : glm::dvec3(0.0))));
      const Picture picture = this->pictureOf(pass);
      mean.resize(picture.rgb.size(), 0.0f);
      for (std::size_t channel = 0; channel < mean.size(); ++channel)
      {
        mean[channel] += static_cast<float>(
          std::pow(picture.rgb[channel] / 255.0, gamma) / static_cast<double>(offsets.size()));
      }
    }
    for (float& value : mean)
    {
      value = static_cast<float>(255.0 * std::pow(value, 1.0 / gamma));
    }
    this->scene.renderer->RemoveLight(point);
    this->scene.renderer->AddLight(this->light);
    return mean;
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

struct LightSamplingOf : PassTestOf<AreaLight, LightSamplingScene>
{
  LightSamplingOf() { this->light = GetParam().add(this->scene); }
};

INSTANTIATE_TEST_SUITE_P(Lights, LightSamplingOf, testing::ValuesIn(areaLights()), byName);

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

/// The picture equals the mean of pictures with VTK's own lights at the points.
TEST_P(LightSamplingOf, meanIsThatOfPicturesByHand)
{
  for (const int samples : { 6, 7 })
  {
    this->sampling->SetSamples(samples);
    const Picture seen = this->scene.render();
    EXPECT_GT(differingPixels(seen, this->pictureOf(this->scene.pass), 10), 50u) << "soft";
    this->expectMean(seen, this->scene.pass);
  }
  // Also without a delegate, that is without shadows.
  this->sampling->SetDelegatePass(nullptr);
  this->expectMean(this->scene.render(), nullptr);
}

TEST_P(LightSamplingOf, lightsAreAsTheyWere)
{
  const Picture plain = this->pictureOf(nullptr);
  this->scene.render();
  vtkLightCollection* lights = this->scene.renderer->GetLights();
  vtkMatrix4x4* matrix = this->light->GetTransformMatrix();
  const glm::dvec3 position = glm::make_vec3(this->light->GetPosition());
  const vtkMTimeType keysTime = this->light->GetInformation()->GetMTime();
  int modified = 0;
  onEvent(this->light, vtkCommand::ModifiedEvent, [&](void*) { ++modified; });
  onEvent(this->scene.renderer, vtkCommand::ModifiedEvent, [&](void*) { ++modified; });
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

struct LightSampling : LightSamplingScene
{
  LightSampling()
  {
    this->light = addRectangle(this->scene, { -2.0, -2.5, 4.0 }, glm::dvec3(0.0), 2.0, 50.0);
  }
};

/// The centre's picture comes first, then each point's, once.
TEST_F(LightSampling, drawsEachPointOnce)
{
  for (const int samples : { 16, 17 })
  {
    this->sampling->SetSamples(samples);
    this->sampling->SetSamplesPerFrame(5);
    this->counting->Count = 0;
    this->scene.render();
    EXPECT_EQ(this->counting->Count, 1);
    for (int frame = 1; this->sampling->GetProgress() < 1.0; ++frame)
    {
      ASSERT_LT(frame, 10);
      this->scene.render();
      const int pictures = std::min(samples, 6 * frame - samples % 2);
      EXPECT_EQ(this->sampling->GetProgress(), static_cast<double>(pictures) / samples);
      EXPECT_EQ(this->counting->Count, pictures + 1);
    }
    this->scene.render();
    EXPECT_EQ(this->counting->Count, samples + 1) << "nothing is drawn again";
  }
}

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

// Windows and neighbours

TEST_F(LightSampling, windowsWithSeveralSamplesPerPixelStaySmooth)
{
  this->scene.window->SetMultiSamples(4);
  const Picture seen = this->scene.render();
  this->expectMean(seen, this->scene.pass);
  this->scene.window->SetMultiSamples(0);
  EXPECT_GT(differingPixels(seen, this->scene.render(), 20), 50u);
}

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
    Channels alphas;
    for (vtkIdType i = 0; i < rgba->GetNumberOfTuples(); ++i)
    {
      alphas.push_back(rgba->GetTypedComponent(i, 3));
    }
    return alphas;
  };
  const Channels plain = alphasOf(this->scene.pass);
  EXPECT_GT(std::count(plain.begin(), plain.end(), 0), 100);
  EXPECT_GT(std::count(plain.begin(), plain.end(), 255), 100);
  EXPECT_LE(largestDifference(alphasOf(this->sampling), plain), 1.0);
}

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

// Unsupported uses

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

  set(this->light, "light_sampling", "jittered");
  EXPECT_EQ(differingPixels(this->scene.render(), centre), 0u);
  EXPECT_THAT(this->takeErrors(),
    testing::AllOf(HasSubstr("light 0"), HasSubstr("opposite pairs"), HasSubstr("sobol")));
  set(this->light, "light_sampling", "random");
  EXPECT_GT(differingPixels(this->scene.render(), centre, 10), 100u);
  EXPECT_EQ(this->takeErrors(), "");
}

/// If no point has light in a channel, there is nothing to scale.
TEST_F(LightSampling, channelsThatNoPointHasStayDark)
{
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(this->light);
  vtkNew<vtkLight> other;
  aim(other, { 3.0, -4.0, 5.0 });
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

TEST_F(LightSampling, asksForRoomFirst)
{
  EXPECT_THAT([] { gnomon::requireRoomForPicture(1 << 20, 1 << 20, 8); }, // 176 TB
    testing::ThrowsMessage<gnomon::TextureMemoryError>(
      testing::AllOf(HasSubstr("8 samples of a pixel of 1048576 x 1048576"), HasSubstr("MB"))));
}

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
