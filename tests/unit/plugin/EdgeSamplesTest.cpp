// Smooth edges of hard shadows (the setting `edge_samples`), against 256 samples of every pixel.

#include "AreaLights.h"
#include "BuiltinPass.h"

#include "plugin/vtkGnomonLightSamplingPass.h"

#include <vtkOpenGLSphereMapper.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// A built-in scene, drawn at any size.
class SampledScene
{
public:
  explicit SampledScene(const char* name)
    : scene_(name, side)
  {
    this->scene_.pass->SetTechnique("raytraced");
  }

  static constexpr int side = 256;   // pixels
  static constexpr int perSide = 16; // samples of the truth

  /// Have each second prop but the ground let light through.
  void makeGlass()
  {
    vtkActorCollection* const actors = this->scene_.renderer->GetActors();
    for (int i = 1; i < actors->GetNumberOfItems(); i += 2)
    {
      vtkProp* const actor = vtkProp::SafeDownCast(actors->GetItemAsObject(i));
      vtkActor::SafeDownCast(actor)->GetProperty()->SetOpacity(0.3 + 0.1 * (i % 5));
      vtkGnomonPropKeys::SetTransmits(actor,
        i % 4 == 1 ? vtkGnomonPropKeys::TRANSMITS_GREY : vtkGnomonPropKeys::TRANSMITS_COLORED);
    }
    this->scene_.pass->TranslucentCastersOn();
  }

  VisibilityImages draw(const char* samples, int sizePixels = side)
  {
    this->scene_.window->SetSize(sizePixels, sizePixels);
    return this->scene_.draw((std::string("edge_samples=") + samples).c_str());
  }

  /// Return each pixel's mean visibility. Of its 256 samples, those count that lie on the plane and
  /// side of its centre's surface. Negative if that surface is turned away from the light.
  std::vector<double> truth(const VisibilityImages& centres)
  {
    const VisibilityImages fine = this->draw("1", perSide * side);
    vtkLight* const light = lightOf(this->scene_.renderer, centres.sceneIndices[0]);
    vtkCamera* camera = this->scene_.renderer->GetActiveCamera();
    std::vector<double> means;
    for (std::size_t i = 0; i < centres.coverage.size(); ++i)
    {
      const glm::dvec3 normal = normalOf(centres, i);
      const glm::dvec3 position = positionOf(centres, i);
      if (centres.coverage[i] == 0.0f || cosineTowards(centres, i, light) <= 1e-6)
      {
        means.push_back(-1.0);
        continue;
      }
      const double depth = glm::dot(position - glm::make_vec3(camera->GetPosition()),
        glm::make_vec3(camera->GetDirectionOfProjection()));
      const double pixelSide =
        2.0 * depth * std::tan(glm::radians(0.5 * camera->GetViewAngle())) / side;
      double sum = 0.0;
      int count = 0;
      for (std::size_t of = 0; of < perSide * perSide; ++of)
      {
        const std::size_t sample =
          (i / side * perSide + of / perSide) * side * perSide + i % side * perSide + of % perSide;
        const bool isSame = fine.coverage[sample] == 1.0f &&
          glm::dot(normalOf(fine, sample), normal) > 0.7071 &&
          std::abs(glm::dot(positionOf(fine, sample) - position, normal)) <= pixelSide &&
          cosineTowards(fine, sample, light) > 0.0;
        sum += isSame ? static_cast<double>(fine.visibility[0][sample]) : 0.0;
        count += isSame ? 1 : 0;
      }
      means.push_back(count > 0 ? sum / count : -1.0);
    }
    return means;
  }

private:
  BuiltinPass scene_;
};

struct Error
{
  double rms = 0.0;
  int missed = 0; ///< partly lit pixels reported as fully lit or dark
};
Error errorOf(const VisibilityImages& images, const std::vector<double>& truth)
{
  Error error;
  double count = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (truth[i] >= 0.0)
    {
      const double visibility = static_cast<double>(images.visibility[0][i]);
      error.rms += std::pow(visibility - truth[i], 2.0);
      error.missed += std::abs(truth[i] - 0.5) < 0.25 && std::abs(visibility - 0.5) == 0.5 ? 1 : 0;
      count += 1.0;
    }
  }
  error.rms = std::sqrt(error.rms / count);
  return error;
}

/// A scene, which may be of glass: then edges have the mean of their samples' products.
struct Case
{
  const char* name;
  const char* scene;
  bool isGlass = false;
  double factor = 3.0; ///< ratio of the errors of one sample and of 16
};
using EdgeSampleErrors = PassTestOf<Case>;
// The bunny's triangles are smaller than pixels here, so few samples lie on a pixel's own triangle.
INSTANTIATE_TEST_SUITE_P(Scenes, EdgeSampleErrors,
  testing::Values(Case{ "bunny", "bunny", false, 2.4 }, Case{ "posts", "posts" },
    Case{ "cups", "cups" }, Case{ "plates", "plates" }, Case{ "stack", "stack" },
    Case{ "glassPosts", "posts", true }, Case{ "glassCups", "cups", true },
    Case{ "glassStack", "stack", true }),
  byName);

using EdgeSamplesOf = PassTestOf<const char*>;
INSTANTIATE_TEST_SUITE_P(
  Scenes, EdgeSamplesOf, testing::Values("bunny", "posts", "cups", "plates", "stack"), byText);

struct EdgeSamples : PassTest
{
  EdgeSamples() { this->scene.choose("silhouette edge_samples=16"); }
  SphereUnderSun scene{ 203, 157 };
};

} // namespace

TEST_P(EdgeSampleErrors, fallWithTheNumberOfSamples)
{
  SampledScene scene(GetParam().scene);
  GetParam().isGlass ? scene.makeGlass() : void();
  const VisibilityImages one = scene.draw("1");
  EXPECT_EQ(countBetween(one.visibility[0]) > 500, GetParam().isGlass);
  const std::vector<double> truth = scene.truth(one);
  const auto error = [&](const char* samples) { return errorOf(scene.draw(samples), truth); };
  const Error ofOne = errorOf(one, truth);
  const Error ofSixteen = error("16");
  EXPECT_GT(ofOne.missed, GetParam().isGlass ? 40 : 100) << "no edge";
  EXPECT_LT(ofSixteen.missed, ofOne.missed / 10);
  EXPECT_LT(error("4").rms, ofOne.rms);
  EXPECT_LT(ofSixteen.rms, ofOne.rms / GetParam().factor);
  EXPECT_LT(error("64").rms, ofSixteen.rms);
}

/// If all nine pixels around show one surface in one light, nothing changes.
TEST_P(EdgeSamplesOf, changeNothingAwayFromEdges)
{
  SampledScene scene(GetParam());
  const VisibilityImages one = scene.draw("1");
  const VisibilityImages sixteen = scene.draw("16");
  const auto isAway = [&](std::size_t i)
  {
    const auto isLikeHere = [&](int column, int row)
    {
      const auto other = static_cast<std::size_t>(row * one.width + column);
      return one.visibility[0][other] == one.visibility[0][i] &&
        one.coverage[other] == one.coverage[i] &&
        glm::dot(normalOf(one, other), normalOf(one, i)) >= 0.99;
    };
    const int x = static_cast<int>(i) % one.width;
    const int y = static_cast<int>(i) / one.width;
    return x > 0 && y > 0 && x + 1 < one.width && y + 1 < one.height &&
      holdsAround({ one.width, one.height }, x, y, 1, isLikeHere);
  };
  const auto isChanged = [&](std::size_t i)
  { return isAway(i) && one.visibility[0][i] != sixteen.visibility[0][i]; };
  EXPECT_GT(countPixels(one, isAway), 20000u);
  EXPECT_EQ(countPixels(one, isChanged), 0u);
}

/// By default pictures at rest have smooth edges. Visibility stays that of the pixels' centres. The
/// deferred route mixes the bytes of light and shadow; the image route rounds once.
TEST_P(EdgeSamplesOf, areOfPicturesAtRestAlone)
{
  const BuiltinPass scene(GetParam(), 301, 203);
  scene.pass->SmoothTerminatorsOn();
  std::vector<Picture> pictures;
  for (const int route : { vtkGnomonShadowPass::ROUTE_IMAGE, vtkGnomonShadowPass::ROUTE_DEFERRED })
  {
    scene.pass->SetKeepVisibility(route == vtkGnomonShadowPass::ROUTE_IMAGE);
    scene.pass->SetRoute(route);
    const Picture hard = scene.render("silhouette edge_samples=1");
    const VisibilityImages centres = scene.pass->GetVisibility();
    const Picture smooth = scene.render("edge_samples=16");
    const Picture byDefault = scene.render("edge_samples=auto");
    pictures.push_back(smooth);
    EXPECT_GT(differingPixels(hard, byDefault, 8), 100u);
    EXPECT_EQ(differingPixels(smooth, byDefault, 1), 0u);
    EXPECT_EQ(scene.pass->GetVisibility().visibility, centres.visibility);
    EXPECT_TRUE(scene.render() == byDefault) << "once more";
    scene.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    scene.renderer->GetActiveCamera()->Azimuth(1e-9);
    EXPECT_TRUE(scene.render() == hard) << "in motion";
    scene.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_AUTO);
    EXPECT_TRUE(scene.render() == byDefault) << "at rest again";
  }
  EXPECT_EQ(scene.report().route, "deferred");
  EXPECT_EQ(differingPixels(pictures[0], pictures[1], 1), 0u);
}

/// The edges of a pixel under seven suns take four texels, more than the narrow picture's columns.
TEST(EdgesUnderSevenSuns, areAsThoseUnderOne)
{
  for (const int width : { 3, 64 })
  {
    const BuiltinPass scene("posts", width, 512);
    scene.pass->KeepVisibilityOff();
    const Picture hard = scene.render("silhouette edge_samples=1");
    const Picture smooth = scene.render("edge_samples=auto");
    EXPECT_GT(differingPixels(hard, smooth, 8), 10u);
    ASSERT_EQ(scene.renderer->GetLights()->GetNumberOfItems(), 1);
    vtkLight* const sun = lightOf(scene.renderer, 0);
    sun->SetIntensity(sun->GetIntensity() / 7.0);
    for (int i = 1; i < 7; ++i)
    {
      vtkNew<vtkLight> other;
      other->DeepCopy(sun);
      scene.renderer->AddLight(other);
    }
    EXPECT_EQ(differingPixels(scene.render("edge_samples=auto"), smooth, 1), 0u) << width;
  }
}

/// A lit plate over ground wholly in its shadow, and lit ground before a dark wall.
TEST_F(EdgeSamples, haveNoFringesAtOutlines)
{
  this->scene.renderer->RemoveActor(this->scene.sphere);
  this->scene.addFloor(1.0, 1.0);
  this->scene.floor()->SetScale(0.2); // within the plate's shadow of an upright sun
  aim(this->scene.sun, { 0.0, 0.0, 5.0 });
  for (const glm::dvec3& from : { glm::dvec3(0.0, -9.0, 7.0), { 3.0, -9.0, -1.0 } })
  {
    this->scene.lookFrom(from);
    const VisibilityImages& kept = drawKept(this->scene);
    const auto isPlate = [&](std::size_t i) { return positionOf(kept, i).z > 0.5; };
    const auto faces = [&](std::size_t i)
    { return kept.coverage[i] == 1.0f && cosineTowards(kept, i, this->scene.sun) > 0.0; };
    const std::size_t plate =
      countPixels(kept, [&](std::size_t i) { return faces(i) && isPlate(i); });
    const std::size_t wrong = countPixels(kept,
      [&](std::size_t i)
      { return faces(i) && kept.visibility[0][i] != (isPlate(i) ? 1.0f : 0.0f); });
    EXPECT_EQ(plate > 1000, from.z > 0.0);
    EXPECT_EQ(wrong, 0u);
  }
}

/// Maps decide samples with the same result as rays.
TEST_F(EdgeSamples, areThereForAllTechniquesLightsAndCameras)
{
  const auto expectMixed = [this](const char* what)
  {
    SCOPED_TRACE(what);
    const std::vector<float> truth = this->scene.visibilityBy("raytraced");
    EXPECT_GT(countBetween(truth), 60u);
    for (const char* technique : { "silhouette", "silhouette", "crsm", "crsma" }) // also at rest
    {
      EXPECT_EQ(this->scene.visibilityBy(technique), truth) << technique;
    }
  };
  expectMixed("sun");
  this->scene.renderer->GetActiveCamera()->ParallelProjectionOn();
  this->scene.renderer->GetActiveCamera()->SetParallelScale(3.0);
  expectMixed("parallel");
  this->scene.renderer->GetActiveCamera()->ParallelProjectionOff();
  this->scene.sun->SwitchOff();
  vtkLight* spot = this->scene.addSpot({ -3.0, 0.0, 5.0 }, { 0.0, 0.0, 1.0 }, 40.0);
  expectMixed("spot");
  spot->SetConeAngle(allDirections);
  expectMixed("point");
}

/// Tiles that a moved prop leaves keep their visibility; edges anywhere are smooth.
TEST_F(EdgeSamples, smoothPicturesWhosePropsMove)
{
  this->scene.addSphere({ 1.4, 0.9, 0.4 }, 0.3);
  this->scene.choose("edge_samples=auto");
  this->scene.render();
  for (int step = 0; step < 3; ++step)
  {
    this->scene.sphere->AddPosition(0.07, 0.05, 0.01);
    const Picture moved = this->scene.render();
    vtkNew<vtkGnomonShadowPass> fresh;
    fresh->SetSettings(this->scene.pass->GetSettings());
    EXPECT_EQ(differingPixels(moved, this->scene.renderBy(fresh)), 0u) << "without earlier frames";
  }
}

/// The mean of pictures from a light's points is smooth by itself.
TEST_F(EdgeSamples, areNotOfPointsOfAreaLights)
{
  this->scene.renderer->RemoveAllLights();
  addDisk(this->scene, { -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 0.5, 50.0);
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetSamples(4);
  sampling->SetSamplesPerFrame(0);
  sampling->SetDelegatePass(this->scene.pass);
  this->scene.renderer->SetPass(sampling);
  const Picture smooth = this->scene.render();
  const Picture byDefault = this->scene.render("edge_samples=auto");
  EXPECT_GT(differingPixels(smooth, byDefault, 8), 60u) << "named samples are taken";
  EXPECT_TRUE(this->scene.render("edge_samples=1") == byDefault);
}

TEST_F(EdgeSamples, areNotOfAreaLights)
{
  set(this->scene.sun, "light_radius", "3");
  const std::vector<float> sixteen = this->scene.visibilityBy("raytraced");
  EXPECT_EQ(this->scene.visibilityBy("edge_samples=1"), sixteen);
}

TEST_F(EdgeSamples, lieOnSolids)
{
  this->scene.renderer->RemoveActor(this->scene.sphere);
  const auto centres = meshOf({ { 0.0, 0.0, 1.2 }, { -0.8, -0.3, 2.4 } }, {});
  centres->SetVerts(cellsOf({ { 0 }, { 1 } }));
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(centres);
  mapper->SetRadius(0.7);
  this->scene.add(mapper);
  const VisibilityImages& kept = drawKept(this->scene);
  const auto isMixedAbove = [&](std::size_t i)
  {
    const float of = kept.visibility[0][i];
    return positionOf(kept, i).z > 0.1 && of > 0.0f && of < 1.0f;
  };
  EXPECT_GT(countPixels(kept, isMixedAbove), 5u) << "the upper sphere's shadow on the lower one";
}
