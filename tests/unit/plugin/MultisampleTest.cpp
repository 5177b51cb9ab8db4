// Windows with several samples per pixel, the default of VTK's own windows.

#include "BuiltinPass.h"
#include "PassScene.h"

#include "Scene.h"

#include "shadowtech/base/Gl.h"

#include <vtkCollectionRange.h>
#include <vtkConeSource.h>
#include <vtkGlyph3D.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

constexpr int samples = 8; ///< llvmpipe gives 4

/// Pixels whose surroundings are all lit or all in shadow, in a frame of the same size or a finer
/// one.
class Surroundings
{
public:
  /// @param truth one-sample visibility of the first light, `finer` times as wide and high as the
  /// pictures
  Surroundings(const VisibilityImages& truth, int finer)
    : truth_(truth)
    , finer_(finer)
  {
  }
  /// True if the pixel and half a pixel or more on all sides show this visibility.
  bool are(float visibility, int x, int y) const
  {
    const int margin = (this->finer_ + 1) / 2;
    const int first = -margin;
    const int end = this->finer_ + margin;
    for (int i = 0; i < (end - first) * (end - first); ++i)
    {
      if (!this->shows(visibility, x * this->finer_ + first + i % (end - first),
            y * this->finer_ + first + i / (end - first)))
      {
        return false;
      }
    }
    return true;
  }

private:
  bool shows(float visibility, int column, int row) const
  {
    if (row < 0 || row >= this->truth_.height || column < 0 || column >= this->truth_.width)
    {
      return false;
    }
    const auto fromTop = static_cast<std::size_t>(this->truth_.height - 1 - row);
    const std::size_t i =
      fromTop * static_cast<std::size_t>(this->truth_.width) + static_cast<std::size_t>(column);
    return this->truth_.coverage[i] > 0.0f && this->truth_.visibility[0][i] == visibility;
  }

  const VisibilityImages& truth_;
  int finer_;
};

/// Counts of a picture's pixels where the truth is certain.
struct Specks
{
  std::size_t lit = 0;   ///< pixels within light
  std::size_t dark = 0;  ///< of these, those not as bright as without shadows
  std::size_t shade = 0; ///< pixels within shadow
  std::size_t leaks = 0; ///< of these, those not black
};

Specks countSpecks(const Picture& shadowed, const Picture& plain, const VisibilityImages& truth)
{
  const Surroundings surroundings(truth, truth.width / plain.width);
  Specks specks;
  for (int y = 0; y < plain.height; ++y)
  {
    for (int x = 0; x < plain.width; ++x)
    {
      if (surroundings.are(1.0f, x, y))
      {
        ++specks.lit;
        specks.dark += std::abs(shadowed.red(x, y) - plain.red(x, y)) > 1 ? 1 : 0;
      }
      else if (surroundings.are(0.0f, x, y))
      {
        ++specks.shade;
        specks.leaks += shadowed.red(x, y) > 1 ? 1 : 0;
      }
    }
  }
  return specks;
}

/// Return a scene's visibility by rays, one sample per pixel.
template <typename MakeScene>
VisibilityImages traced(const MakeScene& makeScene)
{
  const auto scene = makeScene();
  scene->pass->SetTechnique("raytraced");
  scene->pass->KeepVisibilityOn();
  scene->render();
  return scene->pass->GetVisibility();
}

/// Return four flaps around a hollow, each ending where the next begins.
vtkSmartPointer<vtkPolyData> makeHollow()
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 5; ++i)
  {
    points.emplace_back(0.4 * i - 0.8, -0.9, 0.3 * std::abs(i - 2));
    points.emplace_back(0.4 * i - 0.8, 0.9, 0.3 * std::abs(i - 2) + 0.1);
  }
  return meshOf(points, { { 0, 2, 3, 1 }, { 2, 4, 5, 3 }, { 4, 6, 7, 5 }, { 6, 8, 9, 7 } });
}

/// A ball and a hollow above a floor. No box stands on the floor: a pixel's only fragment of the
/// floor may have its centre inside the box.
std::unique_ptr<PassScene> makeSurfaces(bool parallel)
{
  auto scene = std::make_unique<PassScene>(400, 300);
  scene->addFloor(4.0);
  scene->add(ballOf({ 0.0, 0.0, 1.2 }, 1.0, 120, 60));
  vtkActor* hollow = scene->add(makeHollow().Get());
  hollow->RotateZ(25.0);
  hollow->SetPosition(-2.2, 0.0, 0.5);
  scene->addSun({ 1.0, 0.3, -1.5 });
  scene->lookFrom({ 0.3, -7.0, 4.0 }, { -0.7, 0.0, 0.8 });
  vtkCamera* camera = scene->renderer->GetActiveCamera();
  camera->SetParallelScale(2.2);
  camera->SetParallelProjection(parallel);
  scene->renderer->ResetCameraClippingRange();
  scene->pass->SetTechnique("nsm");
  return scene;
}

/// Shade each surface in its own colour times the light that arrives.
void makeMatt(vtkRenderer* renderer)
{
  renderer->SetBackground(0.0, 0.0, 0.0);
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    actor->GetProperty()->SetAmbient(0.0);
    actor->GetProperty()->SetSpecular(0.0);
  }
}

/// Return a window's sample positions in a pixel, in pixels from its centre.
std::vector<glm::dvec2> samplesOf(vtkOpenGLRenderWindow* window)
{
  window->GetState()->PushFramebufferBindings();
  window->GetRenderFramebuffer()->Bind();
  GLint count = 0;
  glGetIntegerv(GL_SAMPLES, &count);
  std::vector<glm::dvec2> found;
  for (GLint i = 0; i < count; ++i)
  {
    glm::vec2 position;
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), &position.x);
    found.push_back(glm::dvec2(position) - 0.5);
  }
  window->GetState()->PopFramebufferBindings();
  return found;
}

/// A frame of one sample per pixel.
struct Sample
{
  Picture plain; ///< without shadows
  VisibilityImages kept;

  /// Return the index in `kept`, whose first row is the top one, of a pixel of `plain`.
  std::size_t indexOf(int x, int y) const
  {
    return static_cast<std::size_t>(this->kept.height - 1 - y) *
      static_cast<std::size_t>(this->kept.width) +
      static_cast<std::size_t>(x);
  }
  /// Uncovered pixels read as lit.
  double visibility(std::size_t i) const
  {
    return this->kept.coverage[i] > 0.0f ? this->kept.visibility[0][i] : 1.0;
  }
  /// True if another sample of a pixel shows another plane.
  bool differs(const Sample& other, std::size_t i) const
  {
    if (this->kept.coverage[i] == 0.0f || other.kept.coverage[i] == 0.0f)
    {
      return this->kept.coverage[i] != other.kept.coverage[i];
    }
    const glm::dvec3 between = positionOf(other.kept, i) - positionOf(this->kept, i);
    const glm::dvec3 normal = normalOf(this->kept, i);
    return glm::dot(normal, normalOf(other.kept, i)) < 0.9999 ||
      std::abs(glm::dot(normal, between)) > 1e-3;
  }
};

/// Return the mean of a pixel's samples as VTK averages them: linear light, with a gamma of 2.2.
template <typename ShownBy>
double resolve(const std::vector<Sample>& samplesOfPixel, const ShownBy& shownBy)
{
  double light = 0.0;
  for (const Sample& sample : samplesOfPixel)
  {
    light += std::pow(shownBy(sample), 2.2);
  }
  return std::pow(light / static_cast<double>(samplesOfPixel.size()), 1.0 / 2.2);
}

/// Draw the picture at an offset from each pixel's centre.
/// @param place in pixels from its centre
Sample drawSample(BuiltinPass& scene, const glm::dvec2& place)
{
  scene.window->SetMultiSamples(0);
  const int* size = scene.window->GetSize();
  scene.renderer->GetActiveCamera()->SetWindowCenter(
    2.0 * place.x / size[0], 2.0 * place.y / size[1]);
  const VisibilityImages kept = scene.draw();
  return { scene.renderPlain(), kept };
}

using Multisample = PassTestOf<bool>;

INSTANTIATE_TEST_SUITE_P(Projections, Multisample, testing::Bool(),
  [](const testing::TestParamInfo<bool>& parallel)
  { return parallel.param ? "parallel" : "perspective"; });

/// Add a sphere with a spike at each of its points; surfaces intersect.
void addMace(PassScene& scene)
{
  vtkNew<vtkSphereSource> sphere;
  scene.add(sphere);
  vtkNew<vtkConeSource> cone;
  vtkNew<vtkGlyph3D> spikes;
  spikes->SetInputConnection(sphere->GetOutputPort());
  spikes->SetSourceConnection(cone->GetOutputPort());
  spikes->SetVectorModeToUseNormal();
  spikes->SetScaleModeToScaleByVector();
  spikes->SetScaleFactor(0.25);
  scene.add(spikes);
  scene.renderer->ResetCamera();
}

} // namespace

TEST_P(Multisample, surfacesHaveNoSpecks)
{
  const VisibilityImages truth = traced([] { return makeSurfaces(GetParam()); });
  const auto scene = makeSurfaces(GetParam());
  scene->window->SetMultiSamples(samples);
  const Picture shadowed = scene->render();
  EXPECT_EQ(scene->report().route, "inline");
  EXPECT_GT(scene->window->GetMultiSamples(), 1);
  EXPECT_THAT(scene->report().notes, testing::IsEmpty());
  const Specks specks = countSpecks(shadowed, scene->renderPlain(), truth);
  EXPECT_GT(specks.lit, 50000u);
  EXPECT_EQ(specks.dark, 0u);
  EXPECT_GT(specks.shade, 5000u);
  EXPECT_EQ(specks.leaks, 0u);
}

/// Outlines are pixels whose centres show another surface, or none.
TEST_F(PassTest, outlinesAreLitAsTheirSurfaces)
{
  const auto scene = makeSurfaces(true);
  for (double x = -2.0; x < 2.0; x += 0.11)
  {
    scene->addBox({ x, -1.6, 0.1 }, { x + 0.01, -1.59, 1.0 });
  }
  const double* const along = scene->renderer->GetActiveCamera()->GetDirectionOfProjection();
  scene->renderer->RemoveAllLights();
  scene->addSun({ along[0], along[1], along[2] }); // lights all visible surfaces
  scene->pass->SetTechnique("raytraced");
  scene->window->SetMultiSamples(samples);
  const Picture lit = scene->render();
  EXPECT_EQ(scene->report().route, "image");
  EXPECT_EQ(differingPixels(lit, scene->renderPlain(), 1), 0u);

  scene->addBox({ -20.0, -9.1, -20.0 }, { 20.0, -9.0, 20.0 }); // behind the camera
  const Picture shaded = scene->render();
  EXPECT_EQ(std::count_if(shaded.rgb.begin(), shaded.rgb.end(), [](int v) { return v > 1; }), 0);
}

/// In pixels that show several surfaces, compare with the mean of separately shaded samples. Also
/// compare with the same mean with the centre's visibility for all samples.
TEST_F(PassTest, outlinesHaveTheVisibilityOfTheirSurfaces)
{
  BuiltinPass scene("posts", 256);
  makeMatt(scene.renderer);
  for (vtkActor* actor : vtk::Range(scene.renderer->GetActors()))
  {
    actor->GetProperty()->SetInterpolationToFlat(); // a fragment's samples then look alike
  }
  scene.pass->SetTechnique("raytraced");
  scene.window->SetMultiSamples(samples);
  const Picture drawn = scene.render();
  const std::vector<glm::dvec2> places = samplesOf(scene.window);
  const Sample centre = drawSample(scene, glm::dvec2(0.0));
  std::vector<Sample> all;
  for (const glm::dvec2& place : places)
  {
    all.push_back(drawSample(scene, place));
  }

  double squared = 0.0;
  double squaredOfCentre = 0.0;
  int pixels = 0;
  for (int y = 0; y < drawn.height; ++y)
  {
    for (int x = 0; x < drawn.width; ++x)
    {
      const std::size_t i = centre.indexOf(x, y);
      if (std::none_of(all.begin(), all.end(),
            [&](const Sample& sample) { return sample.differs(all.front(), i); }))
      {
        continue;
      }
      const double truth = resolve(
        all, [&](const Sample& sample) { return sample.plain.red(x, y) * sample.visibility(i); });
      const double ofCentre = resolve(
        all, [&](const Sample& sample) { return sample.plain.red(x, y) * centre.visibility(i); });
      squared += std::pow(drawn.red(x, y) - truth, 2.0);
      squaredOfCentre += std::pow(ofCentre - truth, 2.0);
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 2000);
  EXPECT_LE(std::sqrt(squared), 0.5 * std::sqrt(squaredOfCentre));
}

/// Where two surfaces intersect, each covers pixels whose centres the other one hides.
TEST_F(PassTest, headlightsLeaveLitWhatIsSeenInSeveralSamples)
{
  PassScene scene(300, 300);
  addMace(scene);
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  vtkGnomonLightKeys::SetCasts(headlight, true);
  scene.renderer->AddLight(headlight);
  const auto changedByShadows = [&](const char* technique)
  { return differingPixels(scene.render(technique), scene.renderPlain()); };
  EXPECT_LT(changedByShadows("nsm"), 5u);
  EXPECT_EQ(scene.report().route, "inline");
  scene.window->SetMultiSamples(8);
  for (const char* technique : { "nsm", "crsm" })
  {
    EXPECT_LT(changedByShadows(technique), 5u) << technique;
    EXPECT_EQ(scene.report().route, "image");
  }
  EXPECT_GT(scene.window->GetMultiSamples(), 1);
}

TEST_F(PassTest, theNumberOfSamplesMayChange)
{
  const auto scene = makeSurfaces(false);
  const Picture single = scene->render();
  scene->window->SetMultiSamples(samples);
  const Picture multiple = scene->render();
  const auto fresh = makeSurfaces(false);
  fresh->window->SetMultiSamples(samples);
  EXPECT_EQ(differingPixels(multiple, fresh->render()), 0u);
  scene->window->SetMultiSamples(0);
  EXPECT_EQ(differingPixels(scene->render(), single), 0u);
  scene->render();
  EXPECT_EQ(scene->report().programCompiles, 0);
}
