#include "PassScene.h"

#include "plugin/plan/CostModel.h"
#include "shadowtech/base/Gl.h"

#include <vtkRenderPass.h>
#include <vtkTrivialProducer.h>

#include <sstream>

namespace gnomon::test
{
namespace
{

/// Decimal points are commas, and thousands are grouped by points.
struct Commas : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

} // namespace

std::string nameOf(const testing::TestParamInfo<Way>& way)
{
  return std::string(way.param.technique) +
    (way.param.route == vtkGnomonShadowPass::ROUTE_INLINE     ? "Inline"
        : way.param.route == vtkGnomonShadowPass::ROUTE_IMAGE ? "Image"
                                                              : "");
}

std::ostream& operator<<(std::ostream& stream, const Way& way)
{
  return stream << way.technique << ", route " << way.route;
}

void choose(vtkGnomonShadowPass* pass, const Way& way)
{
  choose(pass, way.technique);
  pass->SetRoute(way.route);
}

void choose(vtkGnomonShadowPass* pass, const char* text)
{
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
    {
      pass->SetTechnique(word.c_str());
      continue;
    }
    pass->SetSetting(word.substr(0, equals).c_str(), word.substr(equals + 1).c_str());
  }
}

PassScene::PassScene(int width, int height)
{
  this->window->SetSize(width, height);
  this->window->AddRenderer(this->renderer);
  this->renderer->AutomaticLightCreationOff();
  this->pass->SetSetting("bake", "always");    // a single frame then shows the maps' shadows
  this->pass->SetSetting("edge_samples", "1"); // and the visibility that is kept
  this->pass->SetTechnique("nsm");
  this->pass->SmoothTerminatorsOff(); // techniques are compared on the triangles
  this->useGnomon();
}

vtkActor* PassScene::add(vtkMapper* mapper)
{
  const vtkSmartPointer<vtkActor> actor = actorOf(mapper);
  this->renderer->AddActor(actor);
  return actor;
}

vtkActor* PassScene::add(vtkAlgorithm* source)
{
  return this->add(mapperOf(source));
}

vtkActor* PassScene::add(vtkPolyData* data)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(data);
  return this->add(producer);
}

vtkActor* PassScene::addBox(const glm::dvec3& lower, const glm::dvec3& upper)
{
  return this->add(boxOf(lower, upper));
}

vtkActor* PassScene::addFloor(double extent, double z)
{
  return this->add(squareOf(extent, z));
}

vtkActor* PassScene::addSphere(const glm::dvec3& centre, double radius)
{
  return this->add(ballOf(centre, radius, 48, 24));
}

vtkLight* PassScene::addSun(const glm::dvec3& direction)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  aim(light, -direction);
  this->renderer->AddLight(light);
  return light;
}

vtkLight* PassScene::addSpot(
  const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  aim(light, position, target);
  light->SetPositional(true);
  light->SetConeAngle(coneAngleDegrees);
  light->SetExponent(0.0); // no fall-off inside the cone
  this->renderer->AddLight(light);
  return light;
}

void PassScene::lookDown(double halfHeight, double x, double y, double fromHeight)
{
  vtkCamera* camera = this->renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(halfHeight);
  camera->SetPosition(x, y, fromHeight);
  camera->SetFocalPoint(x, y, 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetClippingRange(0.05 * fromHeight, 1.5 * fromHeight);
  this->down_ = { x, y, halfHeight };
}

glm::dvec2 PassScene::floorAt(int x, int y) const
{
  const int* size = const_cast<vtkOpenGLRenderWindow*>(this->window.Get())->GetSize();
  const double pixel = 2.0 * this->down_.z / size[1];
  return { this->down_.x + (x + 0.5 - 0.5 * size[0]) * pixel,
    this->down_.y + (y + 0.5 - 0.5 * size[1]) * pixel };
}

int PassScene::redAt(const Picture& picture, double x, double y) const
{
  const double pixel = 2.0 * this->down_.z / picture.height;
  return picture.red(static_cast<int>((x - this->down_.x) / pixel + 0.5 * picture.width),
    static_cast<int>((y - this->down_.y) / pixel + 0.5 * picture.height));
}

void PassScene::lookFrom(const glm::dvec3& position, const glm::dvec3& target)
{
  vtkCamera* camera = this->renderer->GetActiveCamera();
  camera->ParallelProjectionOff();
  camera->SetPosition(position.x, position.y, position.z);
  camera->SetFocalPoint(target.x, target.y, target.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  this->renderer->ResetCameraClippingRange();
}

void PassScene::addThings()
{
  this->addFloor(4.0);
  this->addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
  this->addSphere({ 1.3, 0.8, 1.4 }, 0.5);
  this->lookFrom({ 2.0, -8.0, 7.0 });
}

vtkActor* PassScene::addSphereOverFloor()
{
  this->addFloor(4.0);
  vtkActor* const sphere = this->addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  this->lookFrom({ 0.0, -9.0, 7.0 });
  return sphere;
}

vtkActor* PassScene::floor() const
{
  return vtkActor::SafeDownCast(this->renderer->GetActors()->GetItemAsObject(0));
}

std::vector<float> PassScene::visibilityBy(const char* text)
{
  return drawKept(*this, text).visibility.at(0);
}

VisibilityImages PassScene::drawAnew()
{
  vtkNew<vtkGnomonShadowPass> fresh;
  fresh->SetSettings(this->pass->GetSettings());
  fresh->SetRoute(this->pass->GetRoute());
  fresh->SetSmoothTerminators(this->pass->GetSmoothTerminators());
  fresh->KeepVisibilityOn();
  this->renderer->SetPass(fresh);
  this->window->Render();
  this->useGnomon();
  return fresh->GetVisibility();
}

Picture PassScene::render()
{
  this->window->Render();
  this->window->MakeCurrent();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(this->report().numbersWrong > 0, this->numbersAreWrong);
  return readPicture(this->window);
}

Picture PassScene::render(const char* text)
{
  this->choose(text);
  return this->render();
}

Picture PassScene::render(const Way& way)
{
  this->choose(way);
  return this->render();
}

Picture PassScene::renderBy(vtkRenderPass* by)
{
  const vtkSmartPointer<vtkRenderPass> before = this->renderer->GetPass();
  this->renderer->SetPass(by);
  Picture picture = this->render();
  this->renderer->SetPass(before);
  return picture;
}

const double slantingSunValue = 255.0 * std::sqrt(0.5);

bool isUnder(const glm::dvec2& floor, const Box& box)
{
  return floor.x >= box.lower.x && floor.x <= box.upper.x && floor.y >= box.lower.y &&
    floor.y <= box.upper.y;
}

ExactFloor floorUnderSun(const Box& box, double extent)
{
  return [=](const glm::dvec2& floor)
  {
    if (isUnder(floor, box) || std::abs(floor.x) > extent || std::abs(floor.y) > extent)
    {
      return -1.0;
    }
    return hitsBox(floor, -slantingSun, box) ? 0.0 : slantingSunValue;
  };
}

BoxScene::BoxScene(int width, int height, const Box& of, double halfSide)
  : PassScene(width, height)
  , box(of)
  , extent(halfSide)
{
  this->addFloor(halfSide);
  this->addBox(of.lower, of.upper);
  this->sun = this->addSun(slantingSun);
  this->lookFrom({ 4.0, -9.0, 7.0 });
}

FloorCheck BoxScene::check(const Picture& picture, double band) const
{
  return checkFloor(*this, picture, floorUnderSun(this->box, this->extent), band);
}

SunAndSpotScene::SunAndSpotScene(int width, int height)
  : SphereUnderSun(width, height)
{
  this->addSpot({ -3.0, 0.0, 5.0 }, glm::dvec3(0.0), 30.0)->SetIntensity(0.5);
}

FloorCheck checkFloor(
  const PassScene& scene, const Picture& picture, const ExactFloor& exact, double band)
{
  FloorCheck check;
  constexpr double tolerance = 64.0;
  check.counted = countPixels(picture,
    [&](int x, int y)
    {
      const glm::dvec2 floor = scene.floorAt(x, y);
      const double value = exact(floor);
      bool nearEdge = value < 0.0;
      for (int i = 0; i < 81 && !nearEdge; ++i)
      {
        nearEdge = exact(floor + 0.25 * band * glm::dvec2(i % 9 - 4, i / 9 - 4)) != value;
      }
      check.falseLight += !nearEdge && picture.red(x, y) > value + tolerance ? 1 : 0;
      check.falseShadow += !nearEdge && picture.red(x, y) < value - tolerance ? 1 : 0;
      return !nearEdge;
    });
  return check;
}

void expectRight(const FloorCheck& check, std::size_t leastCounted)
{
  EXPECT_GE(check.counted, leastCounted);
  EXPECT_EQ(check.falseLight, 0u);
  EXPECT_EQ(check.falseShadow, 0u);
}

std::pair<double, double> spanIn(
  const Box& box, const glm::dvec3& start, const glm::dvec3& ray, double end)
{
  // Along a face, quotients are infinite, of unlike signs between both faces.
  const glm::dvec3 a = (box.lower - start) / ray;
  const glm::dvec3 b = (box.upper - start) / ray;
  const glm::dvec3 enter = glm::min(a, b);
  const glm::dvec3 leave = glm::max(a, b);
  return { std::max({ 0.0, enter.x, enter.y, enter.z }),
    std::min({ end, leave.x, leave.y, leave.z }) };
}

bool hitsBox(const glm::dvec2& floor, const glm::dvec3& toLight, const Box& box, double end)
{
  const auto [first, last] = spanIn(box, glm::dvec3(floor, 0.0), toLight, end);
  return first <= last;
}

bool isOnGpu()
{
  return !isSoftwareRenderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
}

const VisibilityImages& drawKept(PassScene& scene, const char* text)
{
  scene.choose(text);
  scene.pass->KeepVisibilityOn();
  scene.render();
  const VisibilityImages& kept = scene.pass->GetVisibility();
  std::ptrdiff_t broken = 0;
  for (const std::vector<float>& light : kept.visibility)
  {
    broken += std::count_if(
      light.begin(), light.end(), [](float value) { return !(value >= 0.0f && value <= 1.0f); });
  }
  for (const std::vector<float>* plane : { &kept.positionX, &kept.positionY, &kept.positionZ,
         &kept.normalX, &kept.normalY, &kept.normalZ })
  {
    broken += std::count_if(
      plane->begin(), plane->end(), [](float value) { return !std::isfinite(value); });
  }
  EXPECT_EQ(broken, 0);
  return kept;
}

std::vector<double> columnMeans(const VisibilityImages& kept)
{
  std::vector<double> means(static_cast<std::size_t>(kept.width), 0.0);
  for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
  {
    means[i % means.size()] += kept.visibility[0][i] / kept.height;
  }
  return means;
}

glm::dvec3 positionOf(const VisibilityImages& kept, std::size_t pixel)
{
  if (kept.coverage[pixel] == 0.0f)
  {
    return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  }
  return { kept.origin[0] + kept.positionX[pixel], kept.origin[1] + kept.positionY[pixel],
    kept.origin[2] + kept.positionZ[pixel] };
}

glm::dvec3 normalOf(const VisibilityImages& kept, std::size_t pixel)
{
  return { kept.normalX[pixel], kept.normalY[pixel], kept.normalZ[pixel] };
}

double cosineTowards(const VisibilityImages& kept, std::size_t pixel, vtkLight* light)
{
  const auto vector = [](const double* v) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dvec3 position = vector(light->GetTransformedPosition());
  const glm::dvec3 toLight = light->GetPositional()
    ? position - positionOf(kept, pixel)
    : position - vector(light->GetTransformedFocalPoint());
  const double distance = glm::length(toLight);
  return distance > 0.0 ? glm::dot(normalOf(kept, pixel), toLight) / distance : 0.0;
}

Acne countAcne(const VisibilityImages& kept,
  const std::function<glm::dvec3(const glm::dvec3&)>& toLight, double leastCosine)
{
  Acne acne;
  for (std::size_t i = 0; i < kept.coverage.size(); ++i)
  {
    const glm::dvec3 way = toLight(positionOf(kept, i));
    if (kept.coverage[i] > 0.0f &&
      glm::dot(normalOf(kept, i), way) > leastCosine * glm::length(way))
    {
      ++acne.facing;
      acne.dark += kept.visibility[0][i] < 1.0f ? 1 : 0;
      acne.mean += kept.visibility[0][i];
      acne.least = std::min(acne.least, kept.visibility[0][i]);
    }
  }
  acne.mean /= std::max<double>(static_cast<double>(acne.facing), 1.0);
  return acne;
}

Agreement compareVisibility(const VisibilityImages& a, const VisibilityImages& b, std::size_t light)
{
  Agreement result;
  if (light >= a.visibility.size() || light >= b.visibility.size() || a.width != b.width ||
    a.height != b.height)
  {
    ADD_FAILURE() << "frames without a common light or size";
    return result;
  }
  for (std::size_t i = 0; i < a.coverage.size(); ++i)
  {
    const bool covered = a.coverage[i] > 0.0f && b.coverage[i] > 0.0f;
    result.covered += covered ? 1 : 0;
    result.coverage += a.coverage[i] != b.coverage[i] ? 1 : 0;
    result.wrong +=
      covered && std::abs(a.visibility[light][i] - b.visibility[light][i]) > 0.5f ? 1 : 0;
  }
  return result;
}

double meanDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(a[i] - b.at(i));
  }
  return sum / static_cast<double>(a.size());
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max<double>(largest, std::abs(a[i] - b.at(i)));
  }
  return largest;
}

std::size_t countDifferences(
  const std::vector<float>& a, const std::vector<float>& b, double tolerance)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::abs(a[i] - b.at(i)) > tolerance ? 1 : 0;
  }
  return count;
}

std::size_t countBetween(const std::vector<float>& visibility)
{
  return static_cast<std::size_t>(std::count_if(
    visibility.begin(), visibility.end(), [](float v) { return v > 0.0f && v < 1.0f; }));
}

void aim(vtkLight* light, const glm::dvec3& position, const glm::dvec3& target)
{
  light->SetPosition(position.x, position.y, position.z);
  light->SetFocalPoint(target.x, target.y, target.z);
}

vtkLight* lightOf(vtkRenderer* renderer, int index)
{
  return vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(index));
}

PassTest::PassTest()
  : localeBefore_(std::locale::global(std::locale(std::locale::classic(), new Commas)))
{
}

void PassTest::TearDown()
{
  EXPECT_EQ(this->takeErrors(), "");
}

std::string PassTest::takeErrors()
{
  std::string text;
  const std::vector<std::string>& errors = this->messages_.errors();
  for (; this->errorsTaken_ < errors.size(); ++this->errorsTaken_)
  {
    text += errors[this->errorsTaken_] + "\n";
  }
  return text;
}

} // namespace gnomon::test
