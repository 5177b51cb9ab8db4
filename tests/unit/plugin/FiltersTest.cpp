// Filtered maps against closed forms: what kernels count of edges, and what moments let through.

#include "AreaLights.h"
#include "HalfPlane.h"

namespace gnomon::test
{

/// Of two planes the moments tell the hidden share. Their kernels are squares around the point, as
/// that of `pcf`, and the plate is on no texel's border.
TEST_F(PassTest, momentsOfTwoPlanesShowWhatPcfCounts)
{
  PassScene scene(80, 80);
  scene.addFloor(4.0);
  scene.add(squareOf(1.1, 2.0))->RotateZ(17.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  scene.lookDown(1.0, 1.0, 0.7, 1.5); // from below the plate
  scene.choose("map_size=256 bleeding=0");
  for (const int texels : { 1, 2, 9, 32 })
  {
    scene.set("kernel_size", texels);
    const std::vector<float> counted = scene.visibilityBy("pcf");
    EXPECT_GT(countBetween(counted), 100u);
    for (const char* blur : { "esm", "evsm", "vsm", "msm", "vsm blur=sat", "msm blur=sat" })
    {
      EXPECT_LT(largestDifference(scene.visibilityBy(blur), counted), 3e-3) << blur << texels;
      scene.choose("blur=box");
    }
  }
}

/// The floor below an edge over a plate is most lit where the edge hides k / (1 + 2 k) of the
/// kernel. k is the plate's height over the edge's height above the plate.
TEST_F(PassTest, momentsBleedAsChebyshevSays)
{
  for (const double k : { 0.2, 0.5, 2.0 })
  {
    PassScene scene(200, 20);
    scene.addFloor(4.0);
    scene.addFloor(4.0, 3.0 * k / (1.0 + k));
    scene.add(planeOf({ -4.0, -4.0, 3.0 }, { 0.0, -4.0, 3.0 }, { -4.0, 4.0, 3.0 }));
    scene.addSun({ 0.0, 0.0, -1.0 });
    scene.lookDown(0.05, 0.0, 0.0, 0.3);
    scene.choose("map_size=512 kernel_size=31");
    const auto brightest = [&](const char* text)
    {
      const std::vector<float> seen = scene.visibilityBy(text);
      return *std::max_element(seen.begin(), seen.end());
    };
    const double bound = std::pow(1.0 + 2.0 * k, -2.0);
    for (const char* technique : { "vsm blur=sat bleeding=", "vsm blur=box bleeding=" })
    {
      for (const double cut : { 0.0, 0.2 })
      {
        EXPECT_NEAR(brightest((technique + std::to_string(cut)).c_str()),
          std::max(bound - cut, 0.0) / (1.0 - cut), 0.004)
          << technique << cut;
      }
    }
    EXPECT_LT(brightest("esm bleeding=0"), 0.9 * bound);
    EXPECT_LT(brightest("evsm"), 0.9 * bound);
    EXPECT_LE(brightest("msm"), 0.01f) << "two depths and the receiver's";
  }
}

/// A straight edge's share of `adaptive`'s discs: exact in the mean over different discs. Survey,
/// 2.7: 0.0215 off for 8 x 8 points.
TEST_F(PassTest, jitteredDiscsBlurEdgesAsADisc)
{
  HalfPlaneScene scene(40, 80, 0.3);
  scene.addSun({ 0.0, 0.0, -1.0 });
  scene.choose("map_size=2048 kernel_size=32 kernel_width=0.4");
  std::vector<float> whole;
  for (const char* earlyOut : { "none", "ring", "exact" })
  {
    scene.set("early_out", earlyOut);
    const VisibilityImages& kept = drawKept(scene, "adaptive");
    double squares = 0.0;
    double squaresOfMeans = 0.0;
    const std::vector<double> means = columnMeans(kept);
    for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
    {
      const double share = diskShare(positionOf(kept, i).x / 0.2);
      squares += std::pow(kept.visibility[0][i] - share, 2) / (40 * 80);
      squaresOfMeans += std::pow(means[i % 40] - share, 2) / (40 * 80);
    }
    EXPECT_LE(std::sqrt(squares), 0.027) << earlyOut;
    EXPECT_LE(std::sqrt(squaresOfMeans), 0.006) << earlyOut << ": all pixels have the same disc";
    whole = whole.empty() ? kept.visibility[0] : whole;
    EXPECT_TRUE(earlyOut == std::string("ring") || kept.visibility[0] == whole) << earlyOut;
  }
  scene.set("disc_sets", 1);
  const VisibilityImages& kept = drawKept(scene, "adaptive");
  const std::vector<double> means = columnMeans(kept);
  EXPECT_LE(
    countPixels(
      kept, [&](std::size_t i) { return std::abs(kept.visibility[0][i] - means[i % 40]) > 0.01; }),
    32u)
    << "all rows are alike, but for rounding";
}

/// The ring of `adaptive`'s disc does not see a small cube within it. Bounds over the map do.
TEST_F(PassTest, earlyOutsByBoundsSeeAllOfTheKernel)
{
  PassScene scene(120, 90);
  scene.addFloor(4.0);
  scene.addBox({ -0.6, -0.1, 1.0 }, { -0.4, 0.1, 1.2 });
  scene.addSphere({ -0.7, 0.8, 1.6 }, 0.5);
  scene.addSun(slantingSun);
  scene.lookDown(1.0, 0.8);
  scene.choose("map_size=256 kernel_size=16 early_out=none");
  const std::vector<float> whole = scene.visibilityBy("adaptive");
  EXPECT_GT(countBetween(whole), 300u);
  EXPECT_EQ(scene.visibilityBy("early_out=exact"), whole);
  const std::vector<float> byRings = scene.visibilityBy("early_out=ring");
  EXPECT_GT(countDifferences(byRings, whole, 0.05), 20u);
  EXPECT_LT(meanDifference(byRings, whole), 0.01);
}

} // namespace gnomon::test
