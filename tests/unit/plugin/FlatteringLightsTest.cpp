// Key and fill lights that are placed by a look at the scene. Shares are counted
// once more on the pixels of a traced picture.

#include "PassScene.h"

#include "plugin/vtkGnomonFlatteringLights.h"

#include <vtkConeSource.h>
#include <vtkContourFilter.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>
#include <vtkRTAnalyticSource.h>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

using Subject = vtkSmartPointer<vtkActor>;

Subject cone()
{
  vtkNew<vtkConeSource> source;
  source->SetResolution(40);
  source->SetDirection(0.0, 0.0, 1.0);
  return actorOf(mapperOf(source));
}

Subject sphere()
{
  return actorOf(mapperOf(ballOf(glm::dvec3(0.0), 0.5, 48, 48)));
}

/// Balls in a helix, which a molecule mapper shows as impostors.
Subject molecule()
{
  vtkNew<vtkMolecule> molecule;
  for (int i = 0; i < 16; ++i)
  {
    molecule->AppendAtom(
      i % 3 == 0 ? 8 : 6, 3.0 * std::cos(0.6 * i), 3.0 * std::sin(0.6 * i), 0.5 * i);
  }
  vtkNew<vtkMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->UseVDWSpheresSettings();
  return actorOf(mapper);
}

Subject terrain()
{
  const auto surface = copyOf(squareOf(0.5, 0.0, 120));
  movePoints(surface,
    [](const glm::dvec3& at)
    {
      return glm::dvec3(at.x, at.y,
        0.07 * std::sin(9.0 * at.x + 1.0) * std::cos(7.0 * at.y) +
          0.03 * std::sin(23.0 * at.x) * std::sin(19.0 * at.y + 2.0));
    });
  return actorOf(mapperOf(surface));
}

/// The surface of a value of VTK's test image, with pits and detached parts as of a scan.
Subject scan()
{
  vtkNew<vtkRTAnalyticSource> image;
  image->SetWholeExtent(-16, 16, -16, 16, -16, 16);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(image->GetOutputPort());
  contour->SetValue(0, 150.0);
  return actorOf(mapperOf(contour));
}

struct Case
{
  const char* name;
  std::function<Subject()> make;
  glm::dvec3 from; ///< the camera's direction, +z up
  bool hasGround;
};

/// A case in a renderer without a window.
struct LitScene
{
  explicit LitScene(const Case& of)
    : subject(of.make())
  {
    this->renderer->AddActor(this->subject);
    this->look(of.from);
    if (of.hasGround)
    {
      this->addGround();
    }
  }

  void look(const glm::dvec3& from) const
  {
    vtkCamera* const camera = this->renderer->GetActiveCamera();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(from.x, from.y, from.z);
    camera->SetViewUp(
      0.0, std::abs(from.z) > 0.99 ? 1.0 : 0.0, std::abs(from.z) > 0.99 ? 0.0 : 1.0);
    this->renderer->ResetCamera();
    camera->Zoom(0.8);
  }

  void addGround()
  {
    const double* const box = this->subject->GetBounds();
    const double side = 1.5 * std::max(box[1] - box[0], box[3] - box[2]);
    const double z = box[4] - 1e-3 * side;
    this->ground = actorOf(mapperOf(planeOf({ box[0] - side, box[2] - side, z },
      { box[1] + side, box[2] - side, z }, { box[0] - side, box[3] + side, z })));
    this->renderer->AddActor(this->ground);
    this->renderer->ResetCameraClippingRange();
  }

  bool make() { return this->lights->Make(this->renderer, this->key, this->fill); }
  /// Return the unit vector towards a light.
  static glm::dvec3 towards(vtkLight* light)
  {
    return glm::normalize(
      glm::make_vec3(light->GetPosition()) - glm::make_vec3(light->GetFocalPoint()));
  }
  /// Return the same for the key light in the camera's view space.
  glm::dvec3 towardsKeyView() const
  {
    const glm::dvec3 world = towards(this->key);
    double view[4] = { world.x, world.y, world.z, 0.0 };
    this->renderer->GetActiveCamera()->GetViewTransformMatrix()->MultiplyPoint(view, view);
    return glm::make_vec3(view);
  }

  Subject subject;
  Subject ground;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLight> key;
  vtkNew<vtkLight> fill;
  vtkNew<vtkGnomonFlatteringLights> lights;
};

struct Shares
{
  double lit;
  double inShadow;
};

/// Count both shares on the pixels of a traced picture.
Shares count(const LitScene& scene)
{
  const auto window = makeOffScreenWindow();
  window->SetSize(71, 71);
  window->AddRenderer(scene.renderer);
  vtkNew<vtkGnomonShadowPass> pass;
  pass->SetTechnique("raytraced");
  pass->KeepVisibilityOn();
  pass->SmoothTerminatorsOff();
  scene.renderer->SetPass(pass);
  scene.renderer->AddLight(scene.key);
  window->Render();
  const VisibilityImages& kept = pass->GetVisibility();
  const auto isOf = [&](std::size_t i, int prop) { return kept.prop[i] == prop; };
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper(-lower);
  const auto all = static_cast<double>(countPixels(kept,
    [&](std::size_t i)
    {
      lower = isOf(i, 0) ? glm::min(lower, positionOf(kept, i)) : lower;
      upper = isOf(i, 0) ? glm::max(upper, positionOf(kept, i)) : upper;
      return isOf(i, 0);
    }));
  const auto isLit = [&](std::size_t i) { return isOf(i, 0) && kept.visibility[0][i] == 1.0f; };
  const auto isNear = [&](std::size_t i)
  {
    return isOf(i, 1) &&
      glm::distance(positionOf(kept, i), 0.5 * (lower + upper)) <
      0.75 * glm::distance(lower, upper);
  };
  const auto isDark = [&](std::size_t i)
  { return isNear(i) && kept.visibility[0][i] == 0.0f && cosineTowards(kept, i, scene.key) > 0.0; };
  const double lit = static_cast<double>(countPixels(kept, isLit)) / all;
  const auto near = static_cast<double>(countPixels(kept, isNear));
  return { lit, near > 0.0 ? static_cast<double>(countPixels(kept, isDark)) / near : 1.0 - lit };
}

using FlatteringLightsOf = testing::TestWithParam<Case>;

TEST_P(FlatteringLightsOf, sceneShowItAndItsShadow)
{
  LitScene scene(GetParam());
  ASSERT_TRUE(scene.make());
  const Shares shares = count(scene);
  EXPECT_GE(shares.lit, 0.5) << scene.lights->GetNote();
  EXPECT_GE(shares.inShadow, 0.05) << scene.lights->GetNote();
  EXPECT_NEAR(scene.lights->GetLitShare(), shares.lit, 0.04);
  // How much ground counts follows from the outermost rays that meet the subject.
  EXPECT_NEAR(scene.lights->GetShadowShare(), shares.inShadow, 0.07);
  EXPECT_THAT(scene.lights->GetNote(), testing::Not(HasSubstr("No direction")));
  EXPECT_EQ(
    scene.lights->GetNote().find("nothing lies below") == std::string::npos, GetParam().hasGround);

  const glm::dvec3 key = scene.towardsKeyView();
  const double above = glm::degrees(std::asin(key.y));
  const double aside = glm::degrees(std::atan2(std::abs(key.x), key.z));
  EXPECT_THAT(above, testing::AllOf(testing::Ge(24.99), testing::Le(65.01)));
  EXPECT_THAT(aside, testing::AllOf(testing::Ge(19.99), testing::Le(70.01)));
}

INSTANTIATE_TEST_SUITE_P(Table, FlatteringLightsOf,
  testing::Values(Case{ "Cone", cone, { 0.3, -1.0, 0.4 }, false },
    Case{ "ConeOnGround", cone, { 0.3, -1.0, 0.4 }, true },
    Case{ "ConeFromAbove", cone, { 0.0, 0.0, 1.0 }, true },
    Case{ "Sphere", sphere, { 0.0, -1.0, 0.0 }, false },
    Case{ "SphereOnGround", sphere, { 0.0, -1.0, 0.5 }, true },
    Case{ "SphereFromAbove", sphere, { 0.0, 0.0, 1.0 }, true },
    Case{ "Molecule", molecule, { 0.5, -1.0, 0.3 }, false },
    Case{ "MoleculeOnGround", molecule, { 0.5, -1.0, 0.5 }, true },
    Case{ "Terrain", terrain, { 0.3, -1.0, 0.9 }, false },
    Case{ "TerrainFromAbove", terrain, { 0.0, 0.0, 1.0 }, false },
    Case{ "Scan", scan, { 1.0, -1.0, 0.8 }, false },
    Case{ "ScanOnGround", scan, { 0.5, -1.0, 0.6 }, true }),
  byName);

Case ballOnGround()
{
  return { "", sphere, { 0.0, -1.0, 0.5 }, true };
}

TEST(FlatteringLights, areTwoSceneLightsOfWhichTheKeyCasts)
{
  LitScene scene(ballOnGround());
  vtkNew<vtkTransform> moved;
  scene.key->SetTransformMatrix(moved->GetMatrix());
  scene.key->PositionalOn();
  scene.key->SetLightTypeToHeadlight();
  scene.key->SetDiffuseColor(1.0, 0.9, 0.8);
  ASSERT_TRUE(scene.make());
  for (vtkLight* const light : { scene.key.Get(), scene.fill.Get() })
  {
    EXPECT_TRUE(light->LightTypeIsSceneLight());
    EXPECT_FALSE(light->GetPositional());
    EXPECT_EQ(light->GetTransformMatrix(), nullptr);
    EXPECT_THAT(std::vector(light->GetDiffuseColor(), light->GetDiffuseColor() + 3),
      testing::ElementsAre(1.0, 0.9, 0.8));
  }
  EXPECT_TRUE(vtkGnomonLightKeys::GetCasts(scene.key));
  EXPECT_FALSE(vtkGnomonLightKeys::GetCasts(scene.fill));
  EXPECT_LT(scene.fill->GetIntensity(), 0.6 * scene.key->GetIntensity());
  EXPECT_LT(scene.towardsKeyView().x, 0.0) << "left, if both sides are alike";
  EXPECT_GT(LitScene::towards(scene.fill).x, 0.0);
}

TEST(FlatteringLights, areTheSameForTheSameRendererAndForMovedScenes)
{
  LitScene scene(ballOnGround());
  ASSERT_TRUE(scene.make());
  const glm::dvec3 first = LitScene::towards(scene.key);
  ASSERT_TRUE(scene.make());
  EXPECT_EQ(LitScene::towards(scene.key), first);
  for (const double scale : { 1e-6, 1e6 })
  {
    LitScene other(ballOnGround());
    for (vtkActor* const actor : { other.subject.Get(), other.ground.Get() })
    {
      actor->SetScale(scale);
      actor->SetPosition(5.0 * scale, -7.0 * scale, 3.0 * scale);
    }
    other.look({ 0.0, -1.0, 0.5 });
    LitScene same(ballOnGround());
    same.look({ 0.0, -1.0, 0.5 });
    ASSERT_TRUE(other.make() && same.make());
    EXPECT_LT(glm::distance(LitScene::towards(other.key), LitScene::towards(same.key)), 1e-9);
  }
}

TEST(FlatteringLights, seeGroundThatDoesNotCastAndParallelCameras)
{
  LitScene scene(ballOnGround());
  vtkGnomonPropKeys::SetCasts(scene.ground, false);
  scene.renderer->GetActiveCamera()->ParallelProjectionOn();
  ASSERT_TRUE(scene.make());
  EXPECT_THAT(scene.lights->GetNote(), HasSubstr("below or behind them is in shadow"));
  EXPECT_GE(scene.lights->GetShadowShare(), 0.05);
}

TEST(FlatteringLights, seeWallsAsGround)
{
  LitScene scene(ballOnGround());
  for (const double x : { 0.0, -2.05 }) // a wall behind, and a narrow one beside
  {
    const auto wall =
      boxOf({ x - 2.0, x < 0.0 ? -2.0 : 2.0, -0.5 }, { x < 0.0 ? x : 2.0, 2.1, 3.0 });
    scene.renderer->AddActor(actorOf(mapperOf(wall)));
  }
  scene.look({ 0.2, -1.0, 0.4 });
  scene.renderer->GetActiveCamera()->Zoom(1.6);
  ASSERT_TRUE(scene.make());
  EXPECT_THAT(scene.lights->GetNote(), HasSubstr("below or behind them is in shadow"));
  EXPECT_GE(scene.lights->GetLitShare(), 0.7) << "with a wall as subject, few directions do both";
  EXPECT_GE(scene.lights->GetShadowShare(), 0.05);
}

TEST(FlatteringLights, sayWhereNoDirectionDoesBoth)
{
  LitScene scene(ballOnGround());
  scene.renderer->AddActor(actorOf(mapperOf(boxOf(glm::dvec3(-50.0), glm::dvec3(50.0)))));
  ASSERT_TRUE(scene.make());
  EXPECT_THAT(scene.lights->GetNote(), HasSubstr("No direction"));
  EXPECT_EQ(scene.lights->GetLitShare(), 0.0);
  EXPECT_NEAR(glm::length(scene.towardsKeyView()), 1.0, 1e-9);
}

TEST(FlatteringLights, forNoSurfaceInViewAreTheKeyLight)
{
  LitScene away(ballOnGround());
  away.renderer->GetActiveCamera()->SetFocalPoint(0.0, -100.0, 100.0);
  LitScene lines(ballOnGround());
  lines.ground->VisibilityOff();
  lines.subject->GetProperty()->SetRepresentationToWireframe();
  for (LitScene* const scene : { &away, &lines })
  {
    ASSERT_TRUE(scene->make());
    EXPECT_THAT(scene->lights->GetNote(), HasSubstr("sees no opaque surface"));
    EXPECT_NEAR(glm::degrees(std::asin(scene->towardsKeyView().y)), 40.0, 1e-6);
  }
}

TEST(FlatteringLights, ofPlanesAloneArePlaced)
{
  LitScene scene(ballOnGround());
  scene.subject->VisibilityOff();
  ASSERT_TRUE(scene.make());
  EXPECT_NEAR(scene.lights->GetLitShare(), 1.0, 1e-9);
  EXPECT_THAT(scene.lights->GetNote(), HasSubstr("No direction"));
}

TEST(FlatteringLights, stayWhereTheyAreOnErrors)
{
  LitScene nothing(ballOnGround());
  nothing.renderer->RemoveAllViewProps();
  LitScene nowhere(ballOnGround());
  nowhere.renderer->GetActiveCamera()->SetPosition(
    std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  for (LitScene* const scene : { &nothing, &nowhere })
  {
    const tool::VtkMessages messages;
    scene->key->SetPosition(1.0, 2.0, 3.0);
    EXPECT_FALSE(scene->make());
    EXPECT_EQ(messages.errors().size(), 1u);
    EXPECT_EQ(glm::make_vec3(scene->key->GetPosition()), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(scene->lights->GetNote(), "");
    EXPECT_TRUE(vtkGnomonLightKeys::GetCasts(scene->fill));
  }
}

} // namespace
} // namespace gnomon::test
