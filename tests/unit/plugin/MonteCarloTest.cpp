// `montecarlo`: rays through layers of depth. SoftLightsTest compares it with rays under all
// lights; here are its layers, its bounds and its filter.

#include "AreaLights.h"

namespace gnomon::test
{
namespace
{

/// Expect each pixel's class to agree with its decision, and the classes' counts with the pixels.
void expectClassesOfPixels(
  const VisibilityImages& kept, const std::vector<ClassCount>& counted, vtkLight* light)
{
  enum Class : std::size_t
  {
    NoReceiver,
    TurnedAway,
    LitByBounds,
    InShadowByBounds
  };
  std::vector<std::int64_t> pixels(counted.size(), 0);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
  {
    const std::size_t pixelClass = kept.classes[0].ofPixels[i];
    ++pixels.at(pixelClass);
    const float v = kept.visibility[0][i];
    bool right = (kept.coverage[i] == 0.0f) == (pixelClass == NoReceiver);
    right = right && (pixelClass != LitByBounds || v == 1.0f);
    right = right && ((pixelClass != TurnedAway && pixelClass != InShadowByBounds) || v == 0.0f);
    const double cosine = cosineTowards(kept, i, light);
    const bool rounds = pixelClass == NoReceiver || std::abs(cosine) <= 1e-5;
    right = right && (rounds || (pixelClass == TurnedAway) == (cosine < 0.0));
    wrong += right ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(pixels[TurnedAway], 100);
  for (std::size_t i = 0; i < counted.size(); ++i)
  {
    EXPECT_EQ(pixels[i], counted[i].pixels) << counted[i].name;
    EXPECT_EQ(counted[i].name, kept.classes[0].classes.at(i).name);
  }
}

struct MonteCarlo : PassTest
{
  /// A box and a sphere over a floor, under a square lamp.
  void buildScene()
  {
    this->scene.addThings();
    this->addLamp({ -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 50.0, 1.0);
  }

  void addLamp(
    const glm::dvec3& place, const glm::dvec3& target, double coneAngleDegrees, double size)
  {
    this->lamp = addRectangle(this->scene, place, target, size, coneAngleDegrees);
    this->lamp->SetHeight(size);
  }

  void stopFloorFromCasting() { vtkGnomonPropKeys::SetCasts(this->scene.floor(), false); }

  /// A plate over a floor that casts nothing, seen from above. It ends at x = 0, and its shadow
  /// ends around x = 1.
  void buildHalfPlane()
  {
    vtkGnomonPropKeys::SetCasts(this->scene.addFloor(6.0), false);
    this->scene.addBox({ -8.0, -8.0, 2.0 }, { 0.0, 8.0, 2.001 });
    this->scene.lookDown(0.5, 1.0, 0.0);
    this->addLamp({ -4.0, 0.0, 10.0 }, { -4.0, 0.0, 0.0 }, 60.0, 2.0);
  }

  /// The truth by rays to many points.
  std::vector<float> fineTruth()
  {
    return this->scene.visibilityBy("raytraced light_sampling=sobol light_samples=1024");
  }

  PassScene scene{ 160, 120 };
  vtkGnomonAreaLight* lamp = nullptr;
};

} // namespace

/// The error is that of jittered rays for a line across the light, whose side is 2, at height 10.
TEST_F(MonteCarlo, hasThePenumbraOfAHalfPlane)
{
  this->buildHalfPlane();
  for (const int rays : { 1, 2, 3, 4, 8 })
  {
    this->scene.set("mc_rays", rays);
    const VisibilityImages& kept = drawKept(this->scene, "montecarlo mc_filter=0");
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, rays * rays);
    double squares = 0.0;
    const std::size_t count = countPixels(kept,
      [&](std::size_t i)
      {
        const double expected = 0.5 + 2.0 * (positionOf(kept, i).x - 1.0);
        const bool isPenumbra = expected > 0.0 && expected < 1.0;
        squares += isPenumbra ? std::pow(kept.visibility[0][i] - expected, 2.0) : 0.0;
        return isPenumbra;
      });
    EXPECT_GT(count, 2000u);
    const double expected = std::sqrt(1.0 / (6.0 * rays * rays * rays));
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), expected, 0.05 * expected) << rays;
  }
}

/// A ground that casts is in the map along its own rays. Bounds still decide most of it, under
/// lights of all kinds and sizes, with and without a texture, to the map's border.
TEST_F(MonteCarlo, decidesGroundsThatCast)
{
  this->scene.addThings();
  this->scene.addBox({ 1.5, -2.5, 0.0 }, { 2.0, -2.0, 0.02 }); // rises by a texel
  this->scene.choose("mc_filter=0 map_size=512");
  /// @param share the least number of pixels that bounds light, over that of pixels left to rays
  const auto expectDecided = [&](const std::string& what, double share)
  {
    const VisibilityImages searched = drawKept(this->scene, "montecarlo mc_classify=off");
    const VisibilityImages& kept = drawKept(this->scene, "montecarlo mc_classify=rays");
    EXPECT_EQ(kept.visibility.size(), searched.visibility.size());
    for (std::size_t channel = 0; channel < kept.visibility.size(); ++channel)
    {
      EXPECT_LE(countDifferences(kept.visibility[channel], searched.visibility[channel], 1e-6),
        kept.visibility[0].size() / 10000)
        << what << channel;
    }
    const auto& classes = this->scene.report().lights[0].classes;
    const auto undecided = static_cast<double>(classes[4].pixels + classes[5].pixels);
    EXPECT_GE(static_cast<double>(classes[2].pixels), share * undecided) << what;
    return classes[2].pixels;
  };
  for (const AreaLight& area : areaLights())
  {
    if (area.followsCamera)
    {
      continue;
    }
    vtkLight* light = area.add(this->scene);
    const bool isWide = light->GetPositional() && light->GetConeAngle() > 60.0;
    const bool isHuge =
      area.name == std::string("fading") || area.name == std::string("windowOfTheSky");
    for (const double size : { 1.0, 0.3 })
    {
      scaleArea(light, size);
      expectDecided(area.name, isWide || (isHuge && size == 1.0) ? 0.0 : 2.0);
    }
    this->scene.renderer->RemoveLight(light);
  }
  // Low: partly below the walls' and floor's horizon.
  vtkLight* low = addDisk(this->scene, { -6.0, -2.5, 0.6 }, glm::dvec3(0.0), 0.3, 50.0);
  EXPECT_GT(expectDecided("a low disk", 0.0), 0);
  this->scene.renderer->RemoveLight(low);
  this->addLamp({ -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 50.0, 1.0);
  for (const char* layers : { "mc_layers=near", "mc_layers=near_far", "mc_layers=peeled" })
  {
    this->scene.choose(layers);
    expectDecided(layers, 2.0);
  }
  expectClassesOfPixels(
    this->scene.pass->GetVisibility(), this->scene.report().lights[0].classes, this->lamp);
  this->scene.lookDown(0.1, 2.0, -2.25);
  EXPECT_GT(expectDecided("a low step", 0.0), 0);
}

/// Steps of equal length hit nothing that is not there, and step over few of many small boxes.
TEST_F(MonteCarlo, linearSearchMissesLittle)
{
  this->scene.addFloor(4.0);
  this->stopFloorFromCasting();
  this->scene.addBox({ -3.0, -3.0, 0.0 }, { -2.8, -2.8, 5.0 }); // rays are searched from 0 to 5
  for (int i = 0; i < 49; ++i)
  {
    const glm::dvec3 lower(0.5 * (i % 7) - 1.7, 0.5 * (i / 7) - 1.7, 0.4 + 0.08 * i);
    this->scene.addBox(lower, lower + 0.2);
  }
  this->addLamp({ 0.0, 0.0, 6.0 }, glm::dvec3(0.0), 50.0, 1.0);
  this->scene.lookDown(3.0, 0.0, 0.0, 0.3); // from below the boxes
  this->scene.choose("mc_filter=0 mc_layers=near_far");
  const std::vector<float> found = this->scene.visibilityBy("montecarlo");
  const std::vector<float> stepped = this->scene.visibilityBy("mc_search=linear");
  double hidden = 0.0;
  double missed = 0.0;
  std::size_t darker = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    hidden += 1.0 - found[i];
    missed += stepped[i] - found[i];
    darker += stepped[i] < found[i] ? 1 : 0;
  }
  EXPECT_LE(darker, 2u) << "rounding";
  EXPECT_GT(hidden, 1000.0);
  EXPECT_GT(missed, 0.0);
  EXPECT_LT(missed, 0.005 * hidden);
}

/// The filter takes off noise, widens no penumbra, mixes no surfaces and leaves alone what bounds
/// decide far from any ray.
TEST_F(MonteCarlo, filterIsNearerToTheTruth)
{
  this->buildScene();
  this->scene.addBox({ -3.5, 0.0, 1.0 }, { -1.5, 3.0, 2.0 });
  const std::vector<float> truth = this->fineTruth();
  const VisibilityImages noisy = drawKept(this->scene, "montecarlo mc_filter=0");
  const VisibilityImages& kept = drawKept(this->scene, "mc_filter=5");
  const glm::ivec2 size(160, 120);
  double square = 0.0;
  double squareOfNoise = 0.0;
  std::size_t worse = 0;
  std::size_t decided = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const double off = std::abs(kept.visibility[0][i] - truth[i]);
    const double noise = std::abs(noisy.visibility[0][i] - truth[i]);
    square += off * off;
    squareOfNoise += noise * noise;
    worse += off > noise + 0.05 ? 1 : 0;
    const bool noRays = holdsAround(size, i % 160, i / 160, 5,
      [&](int x, int y)
      { return noisy.classes[0].ofPixels[static_cast<std::size_t>(y * 160 + x)] < 4; });
    decided += noRays ? 1 : 0;
    EXPECT_TRUE(!noRays || kept.visibility[0][i] == noisy.visibility[0][i]) << i;
  }
  EXPECT_GT(decided, 1000u);
  EXPECT_LT(square, 0.5 * squareOfNoise);
  EXPECT_LE(worse, 10u);
  EXPECT_EQ(this->scene.drawAnew().visibility[0], kept.visibility[0]);
}

TEST_F(MonteCarlo, findsTheSameByBothNamesOfThePyramid)
{
  this->scene.window->SetSize(120, 90);
  this->buildScene();
  EXPECT_EQ(this->scene.visibilityBy("montecarlo mc_pyramid=mips"),
    this->scene.visibilityBy("montecarlo mc_pyramid=nbuffer"));
}

TEST_F(MonteCarlo, bodiesAreSolidAlongTheLight)
{
  // Rays enter a tower by one side and leave it by another. A sun from straight above sees neither
  // side.
  this->scene.addFloor(2.0);
  this->scene.addBox({ -0.1, -0.1, 0.0 }, { 0.1, 0.1, 4.0 });
  this->scene.lookFrom({ 0.0, -4.0, 3.0 });
  this->scene.addSun({ 0.0, 0.0, -1.0 });
  this->scene.choose("montecarlo light_radius=12 mc_filter=0");
  const std::vector<float> truth =
    this->scene.visibilityBy("raytraced light_sampling=jittered light_samples=9");
  const VisibilityImages& kept = drawKept(this->scene, "montecarlo");
  // Count the floor alone: rounding decides whether sides parallel to the light face it.
  const double onFloor = meanDifferenceWhere(kept.visibility[0], truth, 300,
    [&](std::size_t i) { return truth[i] < 1.0f && std::abs(positionOf(kept, i).z) < 1e-3; });
  EXPECT_LT(onFloor, 0.01);
}

/// On meshes with triangles of a texel's size, the middle of a receiver's texel may lie in a
/// triangle that rises from the receiver's own.
TEST_F(MonteCarlo, smoothMeshesHaveNoDarkSpecks)
{
  const auto hills = copyOf(squareOf(2.0, 0.0, 120));
  movePoints(hills,
    [](const glm::dvec3& at)
    { return at + glm::dvec3(0.0, 0.0, 0.03 * std::sin(7.0 * at.x) * std::sin(5.0 * at.y)); });
  this->scene.add(hills.Get());
  this->scene.lookDown(2.0, 0.0, 0.0);
  for (const double turn : { 0.0, 0.3 }) // of the mesh's rows to the map's
  {
    this->scene.renderer->RemoveAllLights();
    this->scene.addSun(glm::dvec3(turn, 0.1, -2.0));
    this->scene.choose("montecarlo mc_filter=0 light_radius=1");
    for (const char* size : { "map_size=64", "map_size=128", "map_size=256" })
    {
      const std::vector<float> seen = this->scene.visibilityBy(size);
      // Without the correction 8 to 107 dark pixels; with it one pixel in two of the pictures.
      EXPECT_LE(std::count_if(seen.begin(), seen.end(), [](float v) { return v < 1.0f; }), 2)
        << size << ", " << turn;
      EXPECT_EQ(this->scene.report().lights[0].classes.at(1).pixels, 0); // none is turned away
    }
  }
}

/// The foot of a sheet lies in texels whose centres may see the ground in front of it. The leak is
/// at most a texel wide, and half of that on average.
TEST_F(MonteCarlo, sheetsThatStandOnTheGroundLeakATexelAtMost)
{
  this->scene.addFloor(4.0);
  // Over the line x = y / 3, which crosses the map's rows anywhere.
  this->scene.add(planeOf({ -0.5, -1.5, 0.0 }, { 0.5, 1.5, 0.0 }, { -0.5, -1.5, 1.0 }));
  this->scene.lookDown(0.2, 0.1, 0.0);
  for (const double slope : { 0.5, 1.0, 2.0 })
  {
    this->scene.renderer->RemoveAllLights();
    this->scene.addSun(glm::dvec3(1.0, 0.0, -slope));
    for (const int mapSize : { 256, 512, 1024 })
    {
      this->scene.pass->SetMapSize(mapSize);
      const VisibilityImages& kept =
        drawKept(this->scene, "montecarlo mc_filter=0 light_radius=0.1");
      const double texel = 8.0 / mapSize; // along the sun, as long as a row on the floor, or longer
      double lit = 0.0;
      double farthest = 0.0;
      const std::size_t looked = countPixels(kept,
        [&](std::size_t i)
        {
          const glm::dvec3 at = positionOf(kept, i);
          const double behind = at.x - at.y / 3.0;
          const bool looks = std::abs(at.z) < 1e-6 && behind > 0.0 && behind < 0.9 / slope;
          lit += looks ? kept.visibility[0][i] : 0.0f;
          farthest = std::max(farthest, looks && kept.visibility[0][i] > 0.0f ? behind : 0.0);
          return looks;
        });
      const double mean = lit / 120.0 * (0.4 / 120.0); // scaled by the picture's rows
      EXPECT_GT(looked, 1000u);
      EXPECT_GT(farthest, 0.0) << "light that no longer leaks: say so in montecarlo.md";
      EXPECT_LT(farthest, texel) << slope << ", map " << mapSize;
      EXPECT_LT(mean, 0.6 * texel) << slope << ", map " << mapSize;
    }
  }
}

TEST_F(MonteCarlo, oneLayerHasOuterPenumbraeOnly)
{
  this->buildHalfPlane();
  // Every point behind the first surface is in its shadow, wherever its rays go. For the eye behind
  // the light, 0.816 above it, that is x < 0.907. The lamp lights x > 0.75 of it.
  const VisibilityImages& kept = drawKept(this->scene, "montecarlo mc_layers=near mc_filter=0");
  std::size_t outer = 0;
  const std::size_t inside = countPixels(kept,
    [&](std::size_t i)
    {
      const double x = positionOf(kept, i).x;
      const float v = kept.visibility[0][i];
      outer += x > 1.0 && x < 1.2 && v > 0.0f && v < 1.0f ? 1 : 0;
      const bool isInside = std::abs(positionOf(kept, i).z) < 1e-3 && x > 0.77 && x < 0.89;
      EXPECT_TRUE(!isInside || v == 0.0f) << x;
      return isInside;
    });
  EXPECT_GT(inside, 300u);
  EXPECT_GT(outer, 500u);
}

TEST_F(MonteCarlo, eyeLayerEmptiesWhatTheCameraSeesToBeEmpty)
{
  // Two plates and a wall that joins them: a C that opens towards the camera and the lamp. Two
  // layers treat it as a solid body.
  this->scene.addFloor(4.0);
  this->stopFloorFromCasting();
  this->scene.addBox({ -1.2, -1.0, 0.1 }, { 1.2, 1.0, 0.3 });
  this->scene.addBox({ -1.2, 0.8, 0.3 }, { 1.2, 1.0, 2.0 });
  this->scene.addBox({ -1.2, -1.0, 2.0 }, { 1.2, 1.0, 2.2 });
  this->scene.lookFrom({ 0.7, -8.0, 3.2 }, { 0.0, 0.0, 0.8 });
  this->addLamp({ 0.0, -5.5, 6.0 }, glm::dvec3(0.0), 35.0, 2.0);
  const std::vector<float> truth = this->fineTruth();
  const auto errorWithin = [&](const char* layers)
  {
    const VisibilityImages& kept = drawKept(this->scene, layers);
    /// True if a pixel shows the C's inside, into which the lamp shines.
    const auto isWithin = [&](std::size_t i)
    {
      const glm::dvec3 at = positionOf(kept, i);
      return std::abs(at.x) < 1.19 && at.y > -0.99 && at.y < 0.81 && at.z > 0.29 && at.z < 2.01;
    };
    EXPECT_GT(
      countPixels(kept, [&](std::size_t i) { return isWithin(i) && truth[i] > 0.5f; }), 500u);
    return meanDifferenceWhere(kept.visibility[0], truth, 2000, isWithin);
  };
  this->scene.choose("montecarlo mc_search=linear mc_filter=0");
  const double two = errorWithin("mc_layers=near_far");
  EXPECT_LT(errorWithin("mc_layers=eye"), 0.5 * two);
}

} // namespace gnomon::test
