#include "FittedViews.h"

namespace gnomon::test
{
namespace
{

TEST(MapFit, IsThePublishedScaleAndOffsetClampedToWhatIsToBeCovered)
{
  const auto first = fitTo(Rectangle{ { -0.25, -1.0 }, { 0.5, 1.0 } }, { 1024, 0 });
  const auto clamped = fitTo(Rectangle{ { -5.0, 0.5 }, { 5.0, 7.0 } }, { 64, 0 });
  ASSERT_TRUE(first && clamped);
  EXPECT_LT(glm::distance(first->scale, { 8.0 / 3.0, 1.0 }), 1e-15);
  EXPECT_LT(glm::distance(first->offset, { -1.0 / 3.0, 0.0 }), 1e-15);
  EXPECT_EQ(clamped->scale, glm::dvec2(1.0, 4.0));
  EXPECT_EQ(clamped->offset, glm::dvec2(0.0, -3.0));
}

TEST(MapFit, IsNothingWhereNothingIsVisible)
{
  EXPECT_FALSE(fitTo(Rectangle(), { 64, 0 }));
  EXPECT_FALSE(fitTo(Rectangle{ { 1.5, 0.0 }, { 2.0, 1.0 } }, { 64, 0 }));
  EXPECT_FALSE(fitTo(Rectangle{ { 0.0, -3.0 }, { 1.0, -1.5 } }, { 64, 0 }));
  EXPECT_FALSE(fitSnappedTo(Rectangle(), { 64, 0 }));
  EXPECT_FALSE(fitTo(Rectangle{ { std::nan(""), 0.0 }, { 1.0, 1.0 } }, { 64, 0 }));
}

TEST(MapFit, WidensWhatHasNoExtent)
{
  for (const double at : { -1.0, 0.3, 1.0 })
  {
    const Rectangle point = { glm::dvec2(at), glm::dvec2(at) };
    for (const auto& fit : { fitTo(point, { 64, 1 }), fitSnappedTo(point, { 64, 1 }) })
    {
      ASSERT_TRUE(fit);
      EXPECT_LE(fit->scale.x, 1.0 / leastVisibleShare);
      EXPECT_LE(std::abs(mapped(fit->matrix(), point.lower).x), 1.0 - 2.0 / 64 + 1e-9);
    }
  }
}

TEST(MapFit, UniformTakesPointsToTheWholeMap)
{
  const glm::dmat3 uniform = uniformFromAcross({ { 1.0, 5.0 }, { 3.0, 2.0 }, { 2.0, 8.0 } });
  EXPECT_LT(glm::length(mapped(uniform, { 1.0, 2.0 }) + 1.0), 1e-12);
  EXPECT_LT(glm::length(mapped(uniform, { 3.0, 8.0 }) - 1.0), 1e-12);
  EXPECT_EQ(uniformFromAcross({}), glm::dmat3(1.0));
  for (const glm::dvec2& point : { glm::dvec2(0.0), glm::dvec2(7.0, 0.0), glm::dvec2(-1e9, 3.0) })
  {
    EXPECT_LT(glm::length(mapped(uniformFromAcross({ point }), point)), 1e-6);
  }
}

TEST(MapFit, SnappedCoversWhatIsVisibleAtAStepOfTheSeries)
{
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    Rectangle visible;
    visible.add(glm::dvec2(inCube(random)));
    visible.add(glm::dvec2(inCube(random)));
    const MapTexels texels{ i % 2 == 0 ? 64 : 1024, i % 4 };
    const auto snapped = fitSnappedTo(visible, texels);
    const auto tight = fitTo(visible, texels);
    ASSERT_TRUE(snapped && tight);
    for (const glm::dvec2& corner : { visible.lower, visible.upper })
    {
      ASSERT_LE(std::abs(mapped(snapped->matrix(), corner).x), texels.inside() + 1e-9);
      ASSERT_LE(std::abs(mapped(snapped->matrix(), corner).y), texels.inside() + 1e-9);
    }
    const double whole = texels.inside() - 1.0 / texels.side;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double step = 4.0 * std::log2(snapped->scale[axis] / whole);
      ASSERT_NEAR(step, std::round(step), 1e-9);
      ASSERT_GE(step, -1e-9);
      const double offset = snapped->offset[axis] * texels.side / 2.0;
      ASSERT_NEAR(offset, std::round(offset), 1e-6);
      // The fit is not much coarser than without snapping.
      ASSERT_GE(
        snapped->scale[axis], tight->scale[axis] * std::exp2(-0.25) * (1.0 - 4.0 / texels.side));
    }
  }
}

} // namespace
} // namespace gnomon::test
