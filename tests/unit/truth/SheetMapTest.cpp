// The map of sheets that shaders read at points, against rays through the same sheets.

#include "EstimatorGlsl.h"
#include "RandomScenes.h"

#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Sheet.h"
#include "shadowtech/transmittance/SheetMap.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Sheets of one opacity, that a light may lie among.
Occluders makeStained(const std::vector<Prop>& props, double opacity, bool isColoured)
{
  Occluders occluders = makeOccluders(props);
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    Sheet sheet;
    sheet.colour = glm::vec4(0.25f, 0.5f, 1.0f, static_cast<float>(opacity));
    sheet.prop = static_cast<std::uint32_t>(i);
    sheet.isColoured = isColoured;
    occluders.surfaces[i].casts = false;
    occluders.surfaces[i].sheet = std::make_shared<const Sheet>(sheet);
  }
  return occluders;
}

Bounds boxOf(const Occluders& occluders)
{
  Bounds bounds;
  for (const Surface& surface : occluders.surfaces)
  {
    bounds.add(surface.boundsCentred);
  }
  return bounds;
}

/// A point on a sheet, with its normal on the light's side.
struct SheetPoint
{
  glm::vec4 position, normal;
};

/// Shares that shaders read at points.
std::vector<glm::vec4> sheetSharesAt(const SheetMap& map, const std::vector<SheetPoint>& points)
{
  ShaderLibrary library;
  return runCompute<glm::vec4>(library,
    computeGlsl(map.glsl(), "mat2x4", "vec4",
      "result[i] = vec4(vec3(gnomonSheets_LIGHT(given[i][0].xyz, given[i][1].xyz)), 1.0);\n"),
    points, map.uniforms({}));
}

/// Differences between shaders and rays, weighted by the points' cosines to the light.
struct SheetErrors
{
  double mean = 0.0;  ///< of absolute values
  double wrong = 0.0; ///< share of those above 0.02
  double truth = 0.0; ///< mean share of rays
};

/// Compare the shares at random points of all sheets.
SheetErrors compareAtPoints(const Occluders& occluders, const ShadowLight& light, int texels)
{
  Sheets sheets;
  sheets.update(occluders);
  const ShadowRayLight rays(light, occluders.frame.centre);
  const SheetMap map(sheets, boxOf(occluders), rays, texels);
  Random random(1);
  std::vector<SheetPoint> points;
  std::vector<glm::dvec3> truths;
  std::vector<double> cosines;
  const auto wayFrom = [&](const glm::dvec3& point)
  {
    const glm::dvec3 along(rays.toLight);
    const glm::dvec3 way = glm::dvec3(rays.position) - point;
    return rays.kind != LightKind::Directional ? way
      : rays.hasBox                            ? glm::dot(way, along) * along
                                               : 20.0 * along;
  };
  while (points.size() < 8000)
  {
    const glm::uvec3 triangle = occluders.triangles[random() % occluders.triangles.size()];
    const auto corner = [&](int i) { return glm::dvec3(occluders.positionsCentred[triangle[i]]); };
    const double u = std::sqrt(uniform(random, 0.0, 1.0));
    const double v = uniform(random, 0.0, 1.0);
    const glm::dvec3 point = (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
    glm::dvec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const glm::dvec3 toLight = wayFrom(point);
    if (rays.hasBox && glm::dot(toLight, glm::dvec3(rays.toLight)) < 0.01)
    {
      continue; // before its near face
    }
    normal = glm::dot(normal, toLight) < 0.0 ? -normal : normal;
    points.push_back({ glm::vec4(point, 1.0f), glm::vec4(normal, 0.0f) });
    cosines.push_back(glm::dot(normal, glm::normalize(toLight)));
    truths.push_back(
      sheets.transmittanceOf(glm::vec3(point + 1e-4 * normal), glm::vec3(toLight), 1.0f));
  }
  const std::vector<glm::vec4> found = sheetSharesAt(map, points);
  SheetErrors errors;
  double weights = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 off = glm::abs(glm::dvec3(found[i]) - truths[i]);
    const double most = std::max({ off.x, off.y, off.z });
    errors.mean += cosines[i] * most;
    errors.wrong += most > 0.02 ? cosines[i] : 0.0;
    errors.truth += cosines[i] * truths[i].x;
    weights += cosines[i];
  }
  return { errors.mean / weights, errors.wrong / weights, errors.truth / weights };
}

struct SheetLight
{
  const char* name;
  ShadowLight light;
};
const SheetLight sheetLights[] = { { "sun", directionalLight({ 0.3, -0.2, -1.0 }) },
  { "lamp", pointLight({ -1.0, 0.5, 6.0 }) }, { "within", pointLight({ 0.1, 0.05, 0.15 }) },
  { "box", boxLight({ 0.3, -0.2, -1.0 }, { 0.0, 0.0, 0.2 }, glm::dvec3(6.0)) } };

/// Sheets one behind the other: panes, or closed shells.
std::vector<Prop> makeNestedSheets(bool areShells, int sheets)
{
  std::vector<Prop> props;
  for (int i = 0; i < sheets; ++i)
  {
    if (areShells)
    {
      props.push_back({ makeSphere(48, 96), at(glm::dvec3(0.0), 1.0 - 0.13 * i) });
    }
    else
    {
      const glm::dmat4 turn =
        glm::rotate(at({ 0.1 * i, 0.0, 0.35 * i - 0.7 }), 0.1 * i - 0.2, { 1, 0.5, 0 });
      props.push_back({ makePlane(3.0, 6), turn });
    }
  }
  return props;
}

using SheetMapCase = std::tuple<int, double, int, bool>;
struct SheetMaps : GlslTestOf<SheetMapCase>
{
};

TEST_P(SheetMaps, HoldWhatRaysFindBeforeEachSheet)
{
  const auto [sheets, opacity, lightNumber, areShells] = GetParam();
  const ShadowLight& light = sheetLights[lightNumber].light;
  const Occluders occluders =
    makeStained(makeNestedSheets(areShells, sheets), opacity, sheets == 2);
  const SheetErrors errors = compareAtPoints(occluders, light, 512);
  // A texel's last crossing stands for more of five shells' ten.
  const bool merges = areShells && sheets == 5;
  // The light begins at a texel's accuracy where its box cuts a shell.
  const bool isCut = light.box.has_value();
  EXPECT_LT(errors.mean, merges ? 0.008 : isCut ? 0.004 : 0.002);
  EXPECT_LT(errors.wrong, merges ? 0.12 : isCut ? 0.02 : 0.01);
  EXPECT_LT(errors.truth, sheets > 1 ? 1.0 - 0.15 * opacity : 1.0001);
}

TEST_F(GlslTest, SheetMapsOfMoreTexelsAreCloserToRays)
{
  const Occluders occluders = makeStained(makeNestedSheets(true, 2), 0.5, false);
  for (const SheetLight& of : { sheetLights[0], sheetLights[1] })
  {
    double last = 1.0;
    for (const int texels : { 32, 128, 512 })
    {
      const double mean = compareAtPoints(occluders, of.light, texels).mean;
      EXPECT_LT(mean, 0.5 * last) << of.name << ", " << texels;
      last = mean;
    }
  }
}

std::string nameOfSheets(const testing::TestParamInfo<SheetMapCase>& of)
{
  const auto [sheets, opacity, light, areShells] = of.param;
  return std::to_string(sheets) + (areShells ? "Shells" : "Panes") +
    std::to_string(static_cast<int>(10.0 * opacity)) + "By_" + sheetLights[light].name;
}

INSTANTIATE_TEST_SUITE_P(, SheetMaps,
  testing::Combine(testing::Values(1, 2, 5), testing::Values(0.1, 0.5, 0.9), testing::Range(0, 4),
    testing::Bool()),
  nameOfSheets);

} // namespace
} // namespace gnomon::test
