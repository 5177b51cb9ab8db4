// Shadow terminators of coarse smooth-shaded meshes: no steps between facets, and no light where
// another surface blocks it.

#include "PassScene.h"

#include <vtkPolyDataNormals.h>

using namespace gnomon::test;

namespace
{

glm::dvec3 randomDirection(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// VTK's default sphere, alone in front of a black background.
class SphereScene : public PassScene
{
public:
  SphereScene()
    : PassScene(256, 256)
  {
    this->renderer->SetBackground(0.0, 0.0, 0.0);
    this->sphere = this->add(vtkNew<vtkSphereSource>());
    this->pass->SetTechnique("raytraced");
    this->pass->SmoothTerminatorsOn();
    this->lookFrom({ 1.0, 1.4, 2.4 });
    this->sun = this->addSun({ 0.0, 0.0, -1.0 });
  }

  Picture underSun(const glm::dvec3& towards)
  {
    this->sun->SetPosition(100.0 * towards.x, 100.0 * towards.y, 100.0 * towards.z);
    return this->render();
  }

  /// Return which pixels show the sphere.
  std::vector<bool> covered()
  {
    this->sphere->GetProperty()->SetAmbient(1.0);
    const Picture picture = this->render();
    this->sphere->GetProperty()->SetAmbient(0.0);
    std::vector<bool> shows;
    for (std::size_t i = 0; i < picture.pixels(); ++i)
    {
      shows.push_back(picture.rgb[3 * i] > 0);
    }
    return shows;
  }

  vtkActor* sphere = nullptr;
  vtkLight* sun = nullptr;
};

/// Return the largest step between covered neighbours, of 255, beyond the step of the picture
/// without shadows.
int largestStep(const Picture& picture, const Picture& plain, const std::vector<bool>& covered)
{
  int largest = 0;
  const auto compare = [&](int x, int y, int otherX, int otherY)
  {
    const auto at = [&](int column, int row)
    { return covered[static_cast<std::size_t>(row * picture.width + column)]; };
    const auto step = [&](const Picture& of)
    { return std::abs(of.red(x, y) - of.red(otherX, otherY)); };
    if (at(x, y) && at(otherX, otherY))
    {
      largest = std::max(largest, step(picture) - step(plain));
    }
  };
  for (int y = 0; y + 1 < picture.height; ++y)
  {
    for (int x = 0; x + 1 < picture.width; ++x)
    {
      compare(x, y, x + 1, y);
      compare(x, y, x, y + 1);
    }
  }
  return largest;
}

std::size_t litPixels(const Picture& picture)
{
  return countPixels(picture, [&](int x, int y) { return picture.red(x, y) > 0; });
}

/// Return the mean over directions of the largest step.
double meanStep(SphereScene& scene, int directions)
{
  const std::vector<bool> covered = scene.covered();
  std::mt19937 random(24);
  double sum = 0.0;
  for (int i = 0; i < directions; ++i)
  {
    const Picture picture = scene.underSun(randomDirection(random));
    const Picture plain = scene.renderPlain();
    sum += largestStep(picture, plain, covered);
  }
  return sum / directions;
}

/// The mean steps without and with smooth terminators.
struct Steps
{
  double flat, smooth;
};
Steps meanSteps(SphereScene& scene, int directions)
{
  scene.pass->SmoothTerminatorsOff();
  const double flat = meanStep(scene, directions);
  scene.pass->SmoothTerminatorsOn();
  return { flat, meanStep(scene, directions) };
}

/// Add an open sheet of coarse hills, which has one layer from above.
void addHills(PassScene& scene, double height)
{
  const auto plane = squareOf(4.0, -0.8);
  plane->SetResolution(9, 7);
  const auto hills = copyOf(plane);
  movePoints(hills,
    [&](const glm::dvec3& at)
    { return at + glm::dvec3(0.0, 0.0, height * std::sin(2.0 * at.x) * std::cos(1.7 * at.y)); });
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(hills);
  normals->SplittingOff();
  scene.add(normals);
}

using SmoothTerminatorsTest = PassTest;

} // namespace

TEST_F(SmoothTerminatorsTest, vtksSphereHasNoSteps)
{
  SphereScene scene;
  const Steps steps = meanSteps(scene, 100);
  EXPECT_GT(steps.flat, 30.0);
  EXPECT_EQ(steps.smooth, 0.0) << steps.flat;
}

// Nothing blocks a ball's light, from any direction, and its cone is VTK's.
TEST_F(SmoothTerminatorsTest, leaveABallAloneAsVtkShadesIt)
{
  SphereScene scene;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> distance(0.7, 3.0);
  scene.sun->SwitchOff();
  vtkLight* spot = scene.addSpot({ 0.0, 0.0, 1.0 }, glm::dvec3(0.0), 30.0);
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 position = distance(random) * randomDirection(random);
    spot->SetPosition(position.x, position.y, position.z);
    spot->SetConeAngle(i % 2 == 0 ? 90.0 : 20.0);
    const Picture picture = scene.render();
    EXPECT_EQ(differingPixels(picture, scene.renderPlain(), 1), 0u) << i;
  }
}

// Normals turn with the prop, and are not scaled with it.
TEST_F(SmoothTerminatorsTest, followAPropThatIsTurnedAndScaled)
{
  SphereScene scene;
  scene.sphere->SetScale(1.0, 0.5, 1.3);
  scene.sphere->SetOrientation(20.0, 50.0, 70.0);
  const Steps steps = meanSteps(scene, 10);
  EXPECT_GT(steps.flat, 30.0);
  EXPECT_LE(steps.smooth, steps.flat / 3.0) << steps.flat;
}

// Surfaces wholly in another prop's shadow stay dark. That holds where the prop touches or nearly
// touches them, and where the curved surface reaches through it.
TEST_F(SmoothTerminatorsTest, addNoLightInShadow)
{
  std::mt19937 random(3);
  for (const double height : { 0.5, 0.495, 0.45, 3.0 })
  {
    SphereScene scene;
    scene.addFloor(200.0, height)->GetProperty()->SetLighting(false);
    scene.renderer->GetActors()->GetLastActor()->GetProperty()->SetColor(0.0, 0.0, 0.0);
    scene.lookFrom({ 0.9, 1.0, 0.35 }, { 0.0, 0.0, 0.4 }); // below the floor, at the contact
    for (int i = 0; i < 25; ++i)
    {
      glm::dvec3 towards = randomDirection(random);
      towards.z = std::abs(towards.z) + 0.1;
      EXPECT_EQ(litPixels(scene.underSun(towards)), 0u) << height << ", " << i;
    }
  }
}

TEST_F(SmoothTerminatorsTest, leaveFlatShadingAsItIs)
{
  SphereScene scene;
  scene.addBox({ -2.0, -2.0, -1.0 }, { 2.0, 2.0, -0.6 });
  scene.sphere->GetProperty()->SetInterpolationToFlat();
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1.0, 0.4, 0.3));
  scene.pass->SmoothTerminatorsOff();
  const Picture off = scene.underSun(towards);
  scene.pass->SmoothTerminatorsOn();
  EXPECT_TRUE(scene.underSun(towards) == off);
  scene.sphere->GetProperty()->SetInterpolationToGouraud();
  EXPECT_FALSE(scene.underSun(towards) == off);
}

TEST_F(SmoothTerminatorsTest, followNormalsThatChangeAlone)
{
  SphereScene scene;
  const auto data = copyOf(vtkNew<vtkSphereSource>());
  scene.sphere->SetMapper(mapperOf(data.Get()));
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1.0, 0.4, 0.3));
  scene.pass->KeepVisibilityOn();
  scene.underSun(towards);
  const std::vector<float> before = scene.pass->GetVisibility().visibility[0];
  vtkDataArray* normals = data->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    normals->SetComponent(i, 2, normals->GetComponent(i, 2) + 0.3);
  }
  normals->Modified();
  data->Modified();
  scene.render();
  EXPECT_NE(scene.pass->GetVisibility().visibility[0], before);
}

// All exact techniques trace from the same points. Visibility is not kept here: it would compute
// all receivers before maps are looked up for their triangles.
TEST_F(SmoothTerminatorsTest, exactTechniquesAgree)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  int differing = 0;
  for (int i = 0; i < 12; ++i)
  {
    PassScene scene(200, 160);
    addHills(scene, 0.2 + 0.1 * i);
    scene.addFloor(0.5, 1.2); // only one layer lies above its shadow
    for (int ball = 0; ball < 6; ++ball)
    {
      const glm::dvec3 centre(coordinate(random), coordinate(random), coordinate(random) - 0.2);
      scene.add(ballOf(centre, 0.35, 3 + 3 * ball, 4 + 2 * ball));
    }
    scene.lookFrom({ 2.0 * coordinate(random), -3.0, 1.5 });
    i % 3 == 0 ? scene.addSun({ coordinate(random), coordinate(random), -0.6 })
               : scene.addSpot({ coordinate(random), coordinate(random), 2.5 }, { 0.0, 0.0, -0.3 },
                   i % 3 == 1 ? 60.0 : 40.0);
    const bool isArea = i % 2 == 1;
    scene.pass->SetSetting("light_radius", isArea ? "0.2" : "0");
    const Picture flat = scene.render("raytraced");
    scene.pass->SmoothTerminatorsOn();
    const Picture truth = scene.render();
    differing += differingPixels(flat, truth) > 0 ? 1 : 0;
    const std::vector<const char*> others = isArea
      ? std::vector<const char*>{ "penumbra" }
      : std::vector<const char*>{ "crsm", "crsma", "silhouette" };
    for (const char* technique : others)
    {
      EXPECT_EQ(differingPixels(scene.render(technique), truth), 0u) << i << ", " << technique;
    }
  }
  EXPECT_GE(differing, 10);
}

// VTK's shader looks maps up above the facets that are turned away.
TEST_F(SmoothTerminatorsTest, mapsInShadersCutOffATenthAsMuch)
{
  for (const char* technique : { "nsm", "pcf", "vsm", "lispsm" })
  {
    SphereScene scene;
    scene.pass->SetTechnique(technique);
    const auto cutOff = [&]()
    {
      std::mt19937 random(24);
      std::size_t pixels = 0;
      for (int i = 0; i < 20; ++i)
      {
        const Picture picture = scene.underSun(randomDirection(random));
        EXPECT_EQ(scene.report().route, "inline");
        pixels += differingPixels(picture, scene.renderPlain(), 8);
      }
      return pixels;
    };
    const std::size_t smooth = cutOff();
    scene.pass->SmoothTerminatorsOff();
    const std::size_t flat = cutOff();
    EXPECT_GT(flat, 2000u) << technique;
    EXPECT_LE(smooth, flat / 10) << technique << ", " << flat;
  }
}
