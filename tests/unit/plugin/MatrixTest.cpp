// Mapper x look x light x way x window: the picture shows the visibility that is kept.
//
// Every mapper meets every look, with two lights and three ways in the whole window, and in every
// other window. In the windows, lights and ways take turns, so each pair of the five dimensions
// meets in every pair of values.

#include "MatrixScene.h"
#include "MatrixWindows.h"

#include <functional>
#include <numeric>

using namespace gnomon::test;

namespace
{

const std::vector<Way> ways = { { "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
  { "nsm", vtkGnomonShadowPass::ROUTE_IMAGE }, { "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE },
  { "pcf", vtkGnomonShadowPass::ROUTE_INLINE }, { "pcf", vtkGnomonShadowPass::ROUTE_IMAGE },
  { "raytraced", vtkGnomonShadowPass::ROUTE_AUTO } };

/// Return the places of the light and the way whose turn it is, for a mapper, a look and a window.
std::pair<std::size_t, std::size_t> turnOf(std::size_t kind, std::size_t look, std::size_t window)
{
  return { (kind + look + window) % matrixLights().size(),
    (kind + 2 * look + 3 * window) % ways.size() };
}

/// Return the range of values of a pixel at this visibility, in a channel that the light brightens
/// from `unlit` to `lit`. It is a range because a value that VTK clamps to 255 has no upper bound.
std::pair<double, double> expectedChannel(int unlit, int lit, double visibility, bool gamma)
{
  const auto linear = [&](int value) { return gamma ? std::pow(value, 2.2) : value; };
  const double mixed = linear(unlit) + visibility * (linear(lit) - linear(unlit));
  const double shown = gamma ? std::pow(mixed, 1.0 / 2.2) : mixed;
  // Rounding to 8 bits before mixing costs half a value, and one value after it.
  const double tolerance = visibility == 0.0 || visibility == 1.0 ? 1.0 : 2.0;
  const bool clamped = visibility > 0.0 && lit == 255;
  return { shown - tolerance, clamped ? 255.0 : shown + tolerance };
}

struct Matrix : PassTestOf<std::tuple<std::size_t, std::size_t>>
{
  /// Four pictures of one view: as VTK draws it, without the light, the technique's visibility of
  /// the light from the bottom row up, and the picture under test.
  struct View
  {
    Picture lit;
    Picture unlit;
    std::vector<float> visibility;
    Picture shadowed;
  };

  View draw(MatrixWindow& window, int view, vtkLight* light, const Way& way)
  {
    View result;
    this->scene.usePlain();
    result.lit = window.draw(view);
    const double intensity = light->GetIntensity();
    light->SetIntensity(0.0);
    result.unlit = window.draw(view);
    light->SetIntensity(intensity);
    this->scene.useGnomon();

    this->scene.set("edge_samples", "16"); // as the picture has by default
    this->scene.choose({ way.technique, vtkGnomonShadowPass::ROUTE_IMAGE });
    this->scene.pass->KeepVisibilityOn();
    window.draw(view);
    const gnomon::VisibilityImages& kept = this->scene.pass->GetVisibility();
    for (int y = kept.height - 1; y >= 0; --y)
    {
      const auto row = kept.visibility.at(0).begin() + static_cast<std::ptrdiff_t>(y) * kept.width;
      result.visibility.insert(result.visibility.end(), row, row + kept.width);
    }
    this->scene.pass->KeepVisibilityOff();

    this->scene.set("edge_samples", "auto");
    this->scene.choose(way);
    result.shadowed = window.draw(view);
    const bool several =
      window.hasSeveralSamples() && way.route != vtkGnomonShadowPass::ROUTE_INLINE;
    EXPECT_EQ(
      this->scene.report().notes.size(), (this->kind.served ? 0u : 1u) + (several ? 1u : 0u));
    return result;
  }

  /// True if all samples of a pixel have its visibility.
  static bool isUniform(const View& view, int x, int y)
  {
    const glm::ivec2 size(view.lit.width, view.lit.height);
    const auto at = [&](int column, int row)
    { return view.visibility.at(static_cast<std::size_t>(row * size.x + column)); };
    return x > 0 && y > 0 && x + 1 < size.x && y + 1 < size.y &&
      holdsAround(size, x, y, 1, [&](int column, int row) { return at(column, row) == at(x, y); });
  }

  /// True if a pixel of the picture shows this visibility.
  bool shows(double visibility, const View& view, int x, int y) const
  {
    const glm::ivec3 unlit = view.unlit.at(x, y);
    const glm::ivec3 lit = view.lit.at(x, y);
    const bool gamma = this->look.gamma && lit.r > 0; // only the balls have the look
    for (int channel = 0; channel < 3; ++channel)
    {
      const auto [least, most] = expectedChannel(unlit[channel], lit[channel], visibility, gamma);
      const int shown = view.shadowed.at(x, y)[channel];
      if (shown < least || shown > most)
      {
        return false;
      }
    }
    return true;
  }

  /// Compare the picture with the visibility, pixel by pixel, in all of a window's views.
  /// @return the visibility, one view after the other
  std::vector<float> check(MatrixWindow& window, vtkLight* light, const Way& way)
  {
    std::vector<float> visibility;
    std::size_t compared = 0;
    std::size_t wrong = 0;
    std::size_t onBallLit = 0;
    std::size_t onBallDark = 0;
    for (int i = 0; i < window.views(); ++i)
    {
      const View view = this->draw(window, i, light, way);
      visibility.insert(visibility.end(), view.visibility.begin(), view.visibility.end());
      EXPECT_EQ(view.visibility.size(), view.shadowed.pixels());
      compared += countPixels(view.shadowed,
        [&](int x, int y)
        {
          if (window.hasSeveralSamples() && !isUniform(view, x, y))
          {
            return false;
          }
          const double v = view.visibility.at(static_cast<std::size_t>(y * view.lit.width + x));
          wrong += this->shows(v, view, x, y) ? 0 : 1;
          // The floor is green and the beam is blue.
          if (view.lit.at(x, y).r - view.unlit.at(x, y).r > 2)
          {
            onBallLit += v == 1.0 ? 1 : 0;
            onBallDark += v == 0.0 ? 1 : 0;
          }
          return true;
        });
    }
    // The routes may differ by rounding. A pixel may also have a sample of a surface that no
    // pixel's centre shows.
    EXPECT_LE(wrong, window.hasSeveralSamples() ? compared / 1000 : 1);
    EXPECT_GT(compared, visibility.size() / 2);
    const std::size_t some = window.hasSeveralSamples() ? 5 : 15;
    EXPECT_GT(onBallLit, some);
    if (this->kind.served)
    {
      EXPECT_GT(onBallDark, some);
    }
    else
    {
      EXPECT_LE(onBallDark, window.hasSeveralSamples() ? some : 0);
    }
    return visibility;
  }

  const MatrixKind& kind = matrixKinds().at(std::get<0>(GetParam()));
  const MatrixLook& look = matrixLooks().at(std::get<1>(GetParam()));
  MatrixScene scene{ kind, look };
};

std::string nameOfKindAndLook(
  const testing::TestParamInfo<std::tuple<std::size_t, std::size_t>>& info)
{
  return std::string(matrixKinds().at(std::get<0>(info.param)).name) +
    matrixLooks().at(std::get<1>(info.param)).name;
}

INSTANTIATE_TEST_SUITE_P(All, Matrix,
  testing::Combine(testing::Range<std::size_t>(0, matrixKinds().size()),
    testing::Range<std::size_t>(0, imageBasedLook())),
  nameOfKindAndLook);
INSTANTIATE_TEST_SUITE_P(Some, Matrix,
  testing::Combine(testing::Values<std::size_t>(0, 3), testing::Values(imageBasedLook())),
  nameOfKindAndLook);

} // namespace

TEST_P(Matrix, pictureShowsTheVisibilityThatIsKept)
{
  MatrixWindow window(this->scene);
  for (const std::size_t i : { 0u, 1u })
  {
    this->scene.renderer->RemoveAllLights();
    const MatrixLight& light = matrixLights().at(i);
    vtkLight* added = light.add(this->scene);
    SCOPED_TRACE(light.name);
    std::vector<std::vector<float>> visibilities;
    for (const std::size_t way : { 0u, 1u, 2u, 5u })
    {
      SCOPED_TRACE(testing::Message() << ways.at(way));
      visibilities.push_back(this->check(window, added, ways.at(way)));
    }
    // The map's visibility equals the ray-traced one, except at shadows' edges.
    const std::size_t others = std::transform_reduce(visibilities[0].begin(), visibilities[0].end(),
      visibilities[2].begin(), std::size_t(0), std::plus<>(),
      [](float a, float b) { return (a > 0.5f) != (b > 0.5f) ? 1u : 0u; });
    EXPECT_LE(others, visibilities[0].size() / 50);
  }
}

TEST_P(Matrix, windowsShowTheVisibilityThatIsKept)
{
  const auto [kind, look] = GetParam();
  for (std::size_t i = (kind + look) % 2; i < matrixWindows().size(); i += 2)
  {
    const auto [light, way] = turnOf(kind, look, i);
    this->scene.renderer->RemoveAllLights();
    vtkLight* added = matrixLights().at(light).add(this->scene);
    SCOPED_TRACE(testing::Message()
      << matrixWindows()[i].name << ", " << matrixLights()[light].name << ", " << ways.at(way));
    this->check(*matrixWindows()[i].make(this->scene), added, ways.at(way));
  }
}
