// Programs may set a C++ locale whose decimal point is a comma; shaders must not follow it.

#include "Variant.h"

#include <locale>

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

struct UnderALocaleWithCommas : PassTestOf<Variant>
{
  UnderALocaleWithCommas()
    : before_(std::locale::global(std::locale(std::locale::classic(), new Commas)))
  {
  }
  ~UnderALocaleWithCommas() override { std::locale::global(this->before_); }

private:
  std::locale before_;
};

TEST_P(UnderALocaleWithCommas, shadersCompile)
{
  BoxScene scene(32, 24);
  scene.addSpot({ 3.0, 2.0, 9.0 }, { 0.0, 0.0, 0.0 }, 30.0);
  if (GetParam().takesCubes())
  {
    scene.addSpot({ -3.0, 2.0, 9.0 }, { 0.0, 0.0, 0.0 }, allDirections);
  }
  GetParam().choose(scene);
  scene.render();
  EXPECT_NE(scene.report().route, "none") << scene.report().routeReason;
}

INSTANTIATE_TEST_SUITE_P(All, UnderALocaleWithCommas, testing::ValuesIn(variants()), nameOfVariant);

} // namespace
} // namespace gnomon::test
