#pragma once

#include "Picture.h"
#include "Shapes.h"

#include "VtkMessages.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <locale>
#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

/// @file
/// The scene, the oracles and the lists that most tests of the pass share. It includes the headers
/// of their types.

namespace gnomon::test
{

/// A technique and a route to the shader that it can take.
struct Way
{
  const char* technique; ///< with settings or without
  int route;
};
std::string nameOf(const testing::TestParamInfo<Way>& way);

/// Return the name of a test's value of any type with a member `name`.
inline constexpr auto byName = [](const auto& info) { return std::string(info.param.name); };
/// Return the name of a test's value that is a text.
inline constexpr auto byText = [](const auto& info) { return std::string(info.param); };
inline const auto allWays = testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE }, Way{ "pcf", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "pcf", vtkGnomonShadowPass::ROUTE_IMAGE },
  Way{ "raytraced", vtkGnomonShadowPass::ROUTE_AUTO });
/// A map by both routes, and rays: for tests that do not depend on the estimator.
inline const auto fewWays = testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
  Way{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
/// For scenes whose receivers are planes.
inline const Way planarWay{ "planar", vtkGnomonShadowPass::ROUTE_IMAGE };
/// A technique with a map that works on the screen.
inline const Way layersWay{ "montecarlo", vtkGnomonShadowPass::ROUTE_IMAGE };
/// Rays by the image route, where AUTO may take another one.
inline const Way tracedWay{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE };
std::ostream& operator<<(std::ostream& stream, const Way& way);
void choose(vtkGnomonShadowPass* pass, const Way& way);
/// Choose a technique, settings or both, word by word, like "vsm blur=sat kernel_size=16".
void choose(vtkGnomonShadowPass* pass, const char* text);

/// A renderer in its own window, under the pass. Surfaces are white and matt, without ambient
/// light, so a pixel's value is the light's cosine times its visibility.
class PassScene
{
public:
  PassScene(int width, int height);

  vtkActor* add(vtkAlgorithm* source);
  vtkActor* add(vtkPolyData* data);
  vtkActor* add(vtkMapper* mapper);
  vtkActor* addBox(const glm::dvec3& lower, const glm::dvec3& upper);
  /// Add the square of half side `extent` around the origin, at height z.
  vtkActor* addFloor(double extent, double z = 0.0);
  vtkActor* addSphere(const glm::dvec3& centre, double radius);
  vtkLight* addSun(const glm::dvec3& direction);
  vtkLight* addSpot(const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees);

  /// Set a parallel camera that looks straight down with +y up and sees `halfHeight` of the floor
  /// above and below its middle (x, y).
  /// @param fromHeight of the camera, which sees nothing above itself
  void lookDown(double halfHeight, double x = 0.0, double y = 0.0, double fromHeight = 20.0);
  /// Return the floor point that lookDown shows at the middle of a pixel.
  glm::dvec2 floorAt(int x, int y) const;
  /// Return the red value of the pixel at which lookDown shows a floor point.
  int redAt(const Picture& picture, double x, double y) const;
  void lookFrom(const glm::dvec3& position, const glm::dvec3& target = glm::dvec3(0.0));
  /// Add a floor with a box on it and a sphere above it, and look at them.
  void addThings();
  /// Add a sphere over a floor, and look at them. Return the sphere.
  vtkActor* addSphereOverFloor();
  /// Return the actor that was added first.
  vtkActor* floor() const;

  ///@{
  /// Draw a frame, which must raise no OpenGL error.
  Picture render();
  Picture render(const char* text);
  Picture render(const Way& way);
  ///@}
  ///@{
  /// Draw a frame by another pass, or without one. The renderer then gets its pass back.
  Picture renderBy(vtkRenderPass* pass);
  Picture renderPlain() { return this->renderBy(nullptr); }
  ///@}

  ///@{
  /// Draw by Gnomon's pass or without a pass.
  void useGnomon() { this->renderer->SetPass(this->pass); }
  void usePlain() { this->renderer->SetPass(nullptr); }
  ///@}

  ///@{
  /// Choose a way, or a technique and settings of the pass.
  void choose(const Way& way) { test::choose(this->pass, way); }
  void choose(const char* text) { test::choose(this->pass, text); }
  ///@}
  ///@{
  /// Set a setting of the pass.
  void set(const char* name, const char* value) { this->pass->SetSetting(name, value); }
  void set(const char* name, int value) { this->set(name, std::to_string(value).c_str()); }
  ///@}
  /// Return the first light's visibility by a technique and settings, which stay chosen.
  std::vector<float> visibilityBy(const char* text);
  /// Return the visibility of a new pass with the same settings, which has no earlier frames.
  VisibilityImages drawAnew();

  const FrameReport& report() const { return this->pass->GetReport(); }

  vtkSmartPointer<vtkOpenGLRenderWindow> window = makeOffScreenWindow();
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGnomonShadowPass> pass;
  bool numbersAreWrong = false; ///< render() expects FrameReport::numbersWrong

private:
  glm::dvec3 down_{ 0.0 }; ///< the middle and the half height of lookDown()
};

/// Counts of a floor's pixels seen from straight above, against exactly known shadows.
struct FloorCheck
{
  std::size_t counted = 0;     ///< floor pixels away from the shadows' edges
  std::size_t falseLight = 0;  ///< brighter than they must be
  std::size_t falseShadow = 0; ///< darker than they must be
  std::size_t wrong() const { return this->falseLight + this->falseShadow; }
};
/// Expect at least so many pixels to be compared, and none to be wrong.
void expectRight(const FloorCheck& check, std::size_t leastCounted);

/// The exact answer at a floor point: the pixel's value (0 to 255), or a negative one if the floor
/// is not visible.
using ExactFloor = std::function<double(const glm::dvec2&)>;

/// The scene of most exact answers: a box over a floor, under one sun at 45 degrees.
struct Box
{
  glm::dvec3 lower;
  glm::dvec3 upper;
};
/// Hangs over the floor. Its shadow from the sun is x in [0, 4]; the box hides [0, 1] of it.
inline const Box hangingBox{ { -1.0, -1.0, 1.0 }, { 1.0, 1.0, 3.0 } };
inline const glm::dvec3 slantingSun(1.0, 0.0, -1.0);
extern const double slantingSunValue; ///< a lit floor pixel's

/// True if a box hides a floor point from straight above.
bool isUnder(const glm::dvec2& floor, const Box& box);

/// Return the exact answer for the floor of half side `extent` under the slanting sun; negative on
/// the box itself and beyond the floor.
ExactFloor floorUnderSun(const Box& box, double extent);

/// A box over a floor of half side `extent`, under the slanting sun.
struct BoxScene : PassScene
{
  BoxScene(int width, int height, const Box& box = hangingBox, double extent = 20.0);
  /// Compare a picture of the floor with the exact answer.
  FloorCheck check(const Picture& picture, double band) const;

  Box box;
  double extent;
  vtkLight* sun;
};

/// A sphere over a floor, under a sun.
struct SphereUnderSun : PassScene
{
  using PassScene::PassScene;

  vtkActor* sphere = this->addSphereOverFloor();
  vtkLight* sun = this->addSun({ 1.0, 0.3, -1.5 });
};

/// The same with a spot light.
struct SunAndSpotScene : SphereUnderSun
{
  SunAndSpotScene(int width, int height);
};

/// Compare each pixel with the exact answer, with a tolerance of a quarter of white. Pixels with
/// an edge of the exact answer in the square of half side `band` (floor units) are left out.
FloorCheck checkFloor(
  const PassScene& scene, const Picture& picture, const ExactFloor& exact, double band);

/// Return the first and last t from 0 to `end` at which start + t * ray is in the box; the last is
/// the smaller one if there is none.
std::pair<double, double> spanIn(
  const Box& box, const glm::dvec3& start, const glm::dvec3& ray, double end = 1e300);
/// True if the ray from a floor point towards the light, p + t * toLight for t from 0 to `end`,
/// meets the box.
bool hitsBox(
  const glm::dvec2& floor, const glm::dvec3& toLight, const Box& box, double end = 1e300);

/// True if OpenGL draws on a GPU, whose memory may have room for huge maps.
bool isOnGpu();

/// The cone angle of a light that shines in all directions, in degrees.
inline constexpr double allDirections = 180.0;

/// Draw a frame and keep its visibility. Check that its values are finite and in [0, 1].
/// @param text technique and settings to choose first
const VisibilityImages& drawKept(PassScene& scene, const char* text = "");

/// Return the first light's mean visibility of each column of a picture.
std::vector<double> columnMeans(const VisibilityImages& kept);

/// Return the world position of a pixel's receiver; NaN if the pixel shows no surface.
glm::dvec3 positionOf(const VisibilityImages& kept, std::size_t pixel);
glm::dvec3 normalOf(const VisibilityImages& kept, std::size_t pixel);

/// Return the cosine between a pixel's normal and the direction to a light; 0 if the pixel is at
/// the light.
double cosineTowards(const VisibilityImages& kept, std::size_t pixel, vtkLight* light);

/// The pixels that face the first light by more than a cosine, and those of them that are not fully
/// lit.
struct Acne
{
  std::size_t facing = 0;
  std::size_t dark = 0;
  double mean = 0.0; ///< visibility
  float least = 1.0f;
};
/// @param toLight maps a receiver's position to a vector towards the light, of any length
Acne countAcne(const VisibilityImages& kept,
  const std::function<glm::dvec3(const glm::dvec3&)>& toLight, double leastCosine = 0.0);

/// Comparison of two frames' visibility of one light.
struct Agreement
{
  std::size_t covered = 0;  ///< pixels that both frames cover
  std::size_t coverage = 0; ///< pixels that only one of them covers
  std::size_t wrong = 0;    ///< covered ones with visibilities more than 0.5 apart
  double agreeing() const
  {
    return this->covered ? 1.0 - static_cast<double>(this->wrong + this->coverage) / this->covered
                         : 0.0;
  }
};
Agreement compareVisibility(
  const VisibilityImages& a, const VisibilityImages& b, std::size_t light = 0);

///@{
/// Differences of the pixels' visibilities: their mean and largest absolute value, and how many are
/// larger than a tolerance.
double meanDifference(const std::vector<float>& a, const std::vector<float>& b);
double largestDifference(const std::vector<float>& a, const std::vector<float>& b);
std::size_t countDifferences(
  const std::vector<float>& a, const std::vector<float>& b, double tolerance = 0.0);
///@}
/// Return the mean absolute difference over the pixels for whose number holds() is true, more than
/// so many.
template <typename Holds>
double meanDifferenceWhere(const std::vector<float>& a, const std::vector<float>& b,
  std::size_t moreThan, const Holds& holds)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const bool counts = holds(i);
    sum += counts ? std::abs(a[i] - b.at(i)) : 0.0;
    count += counts ? 1 : 0;
  }
  EXPECT_GT(count, moreThan);
  return sum / static_cast<double>(count);
}
/// Count the pixels for whose number holds() is true.
template <typename Holds>
std::size_t countPixels(const VisibilityImages& kept, const Holds& holds)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept.coverage.size(); ++i)
  {
    count += holds(i) ? 1 : 0;
  }
  return count;
}
/// Count the pixels (x, y) of a picture for which holds() is true.
template <typename Holds>
std::size_t countPixels(const Picture& picture, const Holds& holds)
{
  std::size_t count = 0;
  for (int i = 0; i < picture.width * picture.height; ++i)
  {
    count += holds(i % picture.width, i / picture.width) ? 1 : 0;
  }
  return count;
}
/// True if holds(column, row) is true of all pixels of a picture at most `reach` away from a pixel
/// along either side.
template <typename Holds>
bool holdsAround(const glm::ivec2& size, int x, int y, int reach, const Holds& holds)
{
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, size.y - 1); ++row)
  {
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, size.x - 1); ++column)
    {
      if (!holds(column, row))
      {
        return false;
      }
    }
  }
  return true;
}
/// Count the pixels between light and shadow.
std::size_t countBetween(const std::vector<float>& visibility);

/// Set a light's setting.
inline void set(vtkLight* light, const char* name, const char* value)
{
  vtkGnomonLightKeys::SetSetting(light, name, value);
}
/// Put a light at a position, looking at a target.
void aim(vtkLight* light, const glm::dvec3& position, const glm::dvec3& target = glm::dvec3(0.0));
/// Return the light with this place among the renderer's.
vtkLight* lightOf(vtkRenderer* renderer, int index = 0);

/// After each test, VTK must have reported no error except those that the test takes. Tests run
/// under a C++ locale of commas, as programs may set one: shaders and reports must not follow it.
class PassTest : public testing::Test
{
protected:
  PassTest();
  ~PassTest() override { std::locale::global(this->localeBefore_); }
  void TearDown() override;
  /// Return the errors since the last call as one text; the test then ignores them.
  std::string takeErrors();

  std::locale localeBefore_;
  tool::VtkMessages messages_;
  std::size_t errorsTaken_ = 0;
};
template <typename Parameter, typename Fixture = PassTest>
class PassTestOf
  : public Fixture
  , public testing::WithParamInterface<Parameter>
{
};

} // namespace gnomon::test
