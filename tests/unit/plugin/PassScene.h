#pragma once

#include "Picture.h"

#include "VtkMessages.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace gnomon::test
{

/// The techniques and the routes to the shader that they can take.
struct Way
{
  const char* technique;
  int route;
  int tracer = vtkGnomonShadowPass::TRACER_AUTO;
};
std::string nameOf(const testing::TestParamInfo<Way>& way);
inline const auto allWays = testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE }, Way{ "pcf", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "pcf", vtkGnomonShadowPass::ROUTE_IMAGE },
  Way{ "raytraced", vtkGnomonShadowPass::ROUTE_AUTO });
/// A map by both routes, and rays: for what does not depend on how a map is read.
inline const auto fewWays = testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
  Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
  Way{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
/// Of scenes whose receivers are planes.
inline const Way planarWay{ "planar", vtkGnomonShadowPass::ROUTE_IMAGE };
/// With a map and on the screen.
inline const Way layersWay{ "montecarlo", vtkGnomonShadowPass::ROUTE_IMAGE };
/// Which is not what AUTO takes where OpenGL draws by software.
inline const Way gpuTracedWay{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE,
  vtkGnomonShadowPass::TRACER_GPU };
std::ostream& operator<<(std::ostream& stream, const Way& way);
void choose(vtkGnomonShadowPass* pass, const Way& way);

/// A renderer in a window of its own, with the pass in place. Surfaces are white and matt, without
/// ambient light, so that a pixel's value is the light's cosine times its visibility.
class PassScene
{
public:
  PassScene(int width, int height);

  vtkActor* add(vtkAlgorithm* source);
  vtkActor* add(vtkPolyData* data);
  vtkActor* addBox(const glm::dvec3& lower, const glm::dvec3& upper);
  /// The square of half side `extent` around the origin, at height z.
  vtkActor* addFloor(double extent, double z = 0.0);
  vtkActor* addSphere(const glm::dvec3& centre, double radius);
  vtkLight* addSun(const glm::dvec3& direction);
  vtkLight* addSpot(const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees);

  /// A parallel camera that looks straight down with +y up and sees `halfHeight` of the floor above
  /// and below its middle (x, y).
  void lookDown(double halfHeight, double x = 0.0, double y = 0.0);
  /// The floor point that lookDown shows at the middle of a pixel.
  glm::dvec2 floorAt(int x, int y) const;
  /// The red value of the pixel that lookDown shows a floor point at.
  int redAt(const Picture& picture, double x, double y) const;
  void lookFrom(const glm::dvec3& position, const glm::dvec3& target = glm::dvec3(0.0));

  /// Draws a frame, which must raise no OpenGL error.
  Picture render();

  ///@{
  /// Who draws the scene: Gnomon's pass, VTK's own shadow pass, or no pass at all.
  void useGnomon() { this->renderer->SetPass(this->pass); }
  void useVtkShadows(int mapSize = 1024);
  void usePlain() { this->renderer->SetPass(nullptr); }
  ///@}

  void choose(const Way& way) { test::choose(this->pass, way); }

  const FrameReport& report() const { return this->pass->GetReport(); }

  vtkNew<vtkGnomonEGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGnomonShadowPass> pass;
  bool numbersAreWrong = false; ///< whether render() expects that (FrameReport::numbersWrong)
  vtkSmartPointer<vtkObject> vtkShadows; ///< the vtkShadowMapPass of useVtkShadows()

private:
  glm::dvec3 down_{ 0.0 }; ///< the middle and the half height of lookDown()
};

/// What a picture of a floor from straight above shows, against shadows known exactly.
struct FloorCheck
{
  std::size_t counted = 0;     ///< floor pixels away from the shadows' edges
  std::size_t falseLight = 0;  ///< brighter than they must be
  std::size_t falseShadow = 0; ///< darker than they must be
  std::size_t wrong() const { return this->falseLight + this->falseShadow; }
};

/// The exact answer at a floor point: the value that the pixel must have (0 to 255), or a negative
/// one where the floor is not seen.
using ExactFloor = std::function<double(const glm::dvec2&)>;

/// The scene that most exact answers are known for: a box over a floor, under one sun at 45
/// degrees.
struct Box
{
  glm::dvec3 lower;
  glm::dvec3 upper;
};
/// Hangs over the floor, so that its shadow from the sun is x in [0, 4], of which it hides [0, 1].
inline const Box hangingBox{ { -1.0, -1.0, 1.0 }, { 1.0, 1.0, 3.0 } };
inline const glm::dvec3 slantingSun(1.0, 0.0, -1.0);
extern const double slantingSunValue; ///< a lit floor pixel's

/// Whether a box hides a floor point from straight above.
bool isUnder(const glm::dvec2& floor, const Box& box);

/// The floor of half side `extent` under one sun; nothing is asked of the box itself, nor beyond
/// the floor.
ExactFloor floorUnderSun(const Box& box, double extent, const glm::dvec3& direction = slantingSun,
  double value = slantingSunValue);

/// Compares each pixel with the exact answer, with a tolerance of a quarter of white. Pixels with
/// an edge of the exact answer nearer than `band` (floor units) are left out.
FloorCheck checkFloor(
  const PassScene& scene, const Picture& picture, const ExactFloor& exact, double band);

/// Whether the ray from a floor point towards the light, p + t * toLight for t > 0, meets the box.
bool hitsBox(const glm::dvec2& floor, const glm::dvec3& toLight, const glm::dvec3& lower,
  const glm::dvec3& upper);

/// A picture of three channels, by texel.
vtkSmartPointer<vtkImageData> makeImage(
  int width, int height, const std::function<glm::dvec3(int, int)>& colourOf);

/// Appends the progress that a pass tells of to `told`, and 2 at its end.
void listenToProgress(vtkObject* teller, std::vector<double>& told);

/// The cone angle of a light that shines everywhere.
inline constexpr double allDirections = 180.0;

/// Draws a frame, keeps its visibility, and checks that its numbers are visibilities, and finite.
const VisibilityImages& drawKept(PassScene& scene);

/// The mean visibility of each column of a picture, of the first light.
std::vector<double> columnMeans(const VisibilityImages& kept);

/// Where a pixel's receiver is in the world; not a number where nothing is seen.
glm::dvec3 positionOf(const VisibilityImages& kept, std::size_t pixel);

/// The cosine between a pixel's normal and the way from there to a light; 0 where it is in the
/// light.
double cosineTowards(const VisibilityImages& kept, std::size_t pixel, vtkLight* light);

/// Of the pixels that face the first light by more than a cosine, those that are not fully lit.
struct Acne
{
  std::size_t facing = 0;
  std::size_t dark = 0;
  double mean = 0.0; ///< visibility
  float least = 1.0f;
};
/// @param toLight from a receiver's position towards the light, of any length
Acne countAcne(const VisibilityImages& kept,
  const std::function<glm::dvec3(const glm::dvec3&)>& toLight, double leastCosine = 0.0);
Acne countAcneOfSun(
  const VisibilityImages& kept, const glm::dvec3& toLight, double leastCosine = 0.0);
Acne countAcneOfLamp(
  const VisibilityImages& kept, const glm::dvec3& lightWorld, double leastCosine = 0.0);

/// How two frames' visibility of one light compare.
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

/// How far apart the visibilities of pixels are on average.
double meanVisibilityDifference(const std::vector<float>& a, const std::vector<float>& b);

/// Every test must leave VTK with nothing to complain about, but for the errors that it takes.
class PassTest : public testing::Test
{
protected:
  void TearDown() override;
  /// The errors since the last call, as one text; they no longer count.
  std::string takeErrors();

  tool::VtkMessages messages_;
  std::size_t errorsTaken_ = 0;
};

} // namespace gnomon::test
