// Point lights and wide spot lights, whose maps have a layer for each face of a cube.

#include "BuiltinPass.h"
#include "PassScene.h"

#include "SyntheticScene.h"

#include "lights/LightSpace.h"
#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/tracing/EmbreeTracer.h"

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

class PositionalLights : public PassTest
{
protected:
  static const VisibilityImages& draw(PassScene& scene, const char* technique = "nsm")
  {
    const VisibilityImages& kept = drawKept(scene, technique);
    for (const std::vector<float>& light : kept.visibility)
    {
      EXPECT_TRUE(std::all_of(
        light.begin(), light.end(), [](float value) { return value == 0.0f || value == 1.0f; }));
    }
    return kept;
  }
};

/// Finds by its own rays whether a shadow's edge is near a point. It is if the light's view of the
/// point's plane, within so many texels, is neither all lit nor all dark. The edge may be
/// invisible: behind a surface, or thinner than a pixel.
class EdgeFinder
{
public:
  EdgeFinder(vtkRenderer* renderer, const glm::dvec3& lightWorld)
  {
    this->collector_.collect(renderer);
    this->tracer_.update(this->collector_.occluders());
    this->light_.kind = gnomon::LightKind::Point;
    this->light_.positionWorld = lightWorld;
  }

  bool isNear(const glm::dvec3& point, const glm::dvec3& normal, double texels, double mapSize)
  {
    constexpr int steps = 8;
    const double reach = texels * 2.0 / mapSize; // a face's slopes go from -1 to 1
    const glm::dvec3& light = this->light_.positionWorld;
    const glm::dmat3 faceFromLight = gnomon::cubeFaceFromLight(gnomon::cubeFaceOf(point - light));
    const glm::dvec3 inFace = faceFromLight * (point - light);
    std::vector<PlacedReceiver> row;
    for (int y = -steps; y <= steps; ++y)
    {
      for (int x = -steps; x <= steps; ++x)
      {
        const glm::dvec3 slopes(
          inFace.x / inFace.z + reach * x / steps, inFace.y / inFace.z + reach * y / steps, 1.0);
        const glm::dvec3 way = glm::transpose(faceFromLight) * slopes;
        const double along = glm::dot(normal, point - light) / glm::dot(normal, way);
        row.push_back(
          { light + along * way - this->collector_.occluders().frame.centre, normal, 1e-5f });
      }
    }
    std::vector<float> visibility;
    this->tracer_.trace(this->light_, this->collector_.occluders(), rowOf(row), visibility);
    return *std::min_element(visibility.begin(), visibility.end()) <
      *std::max_element(visibility.begin(), visibility.end());
  }

private:
  gnomon::OccluderCollector collector_;
  gnomon::EmbreeTracer tracer_;
  gnomon::ShadowLight light_;
};

} // namespace

/// The room with a lamp: where a map differs from rays, a shadow's edge is near.
TEST_F(PositionalLights, theRoomHasNoSeams)
{
  const gnomon::tool::Scene room = gnomon::tool::loadScene("room");
  const BuiltinPass scene(room, 320);
  const VisibilityImages traced = scene.draw("raytraced");
  const auto& at = room.lights[0].position;
  EdgeFinder edges(scene.renderer, { at[0], at[1], at[2] });
  /// Return the number of different pixels.
  const auto expectEdges =
    [&](const VisibilityImages& mapped, double tolerance, double texels, double mapSize)
  {
    std::size_t different = 0;
    for (std::size_t i = 0; i < traced.coverage.size(); ++i)
    {
      if (std::abs(mapped.visibility[0][i] - traced.visibility[0][i]) > tolerance)
      {
        ++different;
        EXPECT_TRUE(edges.isNear(positionOf(traced, i), normalOf(traced, i), texels, mapSize))
          << "pixel " << i % 320 << ", " << i / 320;
      }
    }
    return different;
  };
  for (const int mapSize : { 128, 320 })
  {
    SCOPED_TRACE(mapSize);
    scene.pass->SetMapSize(mapSize);
    const std::size_t wrong = expectEdges(scene.draw("nsm"), 0.0, 2.0, mapSize);
    EXPECT_EQ(scene.report().bytesMaps, 6u * 4u * static_cast<unsigned>(mapSize * mapSize));
    EXPECT_GT(wrong, 0u) << "a map has its texels";
    EXPECT_LE(wrong, (mapSize == 128 ? 0.01 : 0.005) * 320.0 * 320.0);
  }
  // Far from edges the whole kernel is lit or dark, except for a texel of a face that the light
  // only grazes, which is pushed far back. The bilinear kernel reaches 4 texels along the axes.
  // The edge may be a texel away from its place in the map.
  for (const char* kernel : { "bilinear", "box", "poisson", "castano" })
  {
    SCOPED_TRACE(kernel);
    set(lightOf(scene.renderer), "kernel", kernel);
    set(lightOf(scene.renderer), "kernel_size", "7");
    EXPECT_GT(expectEdges(scene.draw("pcf"), 0.05, 5.5, 320.0 - 8.0), 1000u);
  }
}

TEST_F(PositionalLights, wideConesAgreeWithTheTruth)
{
  for (const double cone : { 55.0, 61.0, 75.0, 89.0, 89.9 })
  {
    for (const bool oneSided : { false, true })
    {
      PassScene scene(200, 200);
      vtkGnomonPropKeys::SetOneSided(scene.addFloor(4.0), oneSided);
      vtkGnomonPropKeys::SetOneSided(scene.addSphere({ 1.5, 0.5, 0.9 }, 0.6), oneSided);
      vtkGnomonPropKeys::SetOneSided(
        scene.addBox({ -2.0, -1.5, 0.0 }, { -1.0, 0.5, 1.2 }), oneSided);
      scene.addSpot({ 0.1, 0.2, 1.6 }, { 0.4, 0.1, 0.0 }, cone);
      scene.pass->SetMapSize(512);
      scene.lookFrom({ 1.0, -7.0, 6.0 });
      const VisibilityImages mapped = draw(scene);
      const VisibilityImages traced = draw(scene, "raytraced");
      const Agreement agreement = compareVisibility(mapped, traced);
      EXPECT_GT(agreement.covered, 20000u);
      EXPECT_LE(agreement.wrong, 0.005 * agreement.covered) << cone << ", " << oneSided;
      const auto lit = std::count(traced.visibility[0].begin(), traced.visibility[0].end(), 1.0f);
      EXPECT_GT(lit, 3000);
    }
  }
}

TEST_F(PositionalLights, aPointLightIsAConeThatIsNotThere)
{
  // VTK applies no cone from 90 degrees on.
  PassScene scene(200, 200);
  scene.addFloor(4.0);
  scene.addSphere({ 1.5, 0.5, 0.9 }, 0.6);
  vtkLight* light = scene.addSpot({ 0.1, 0.2, 1.6 }, { 0.1, 0.2, 0.0 }, 90.0);
  scene.lookFrom({ 1.0, -7.0, 6.0 });
  for (const char* technique : { "nsm", "raytraced" })
  {
    light->SetConeAngle(90.0);
    light->SetFocalPoint(0.1, 0.2, 5.0); // up: a cone would leave the floor dark
    const VisibilityImages point = draw(scene, technique);
    EXPECT_GT(countAcneOfLamp(point, { 0.1, 0.2, 1.6 }).facing, 10000u);
    EXPECT_LT(countAcneOfLamp(point, { 0.1, 0.2, 1.6 }).dark, 6000u);
    light->SetFocalPoint(light->GetPosition()); // a direction is not needed
    light->SetConeAngle(180.0);
    const VisibilityImages same = draw(scene, technique);
    ASSERT_EQ(same.visibility.size(), 1u);
    EXPECT_EQ(same.visibility[0], point.visibility[0]);
  }
}

TEST_F(PositionalLights, aChangedConeIsSeenAlthoughTheCastersStayTheSame)
{
  PassScene scene(200, 200);
  scene.addFloor(1.0);
  vtkLight* spot = scene.addSpot({ 0.0, 0.0, 1.0 }, glm::dvec3(0.0), 80.0);
  vtkGnomonPropKeys::SetCasts(scene.addFloor(6.0, -0.5), false);
  scene.lookFrom({ 0.0, -9.0, 9.0 });
  const VisibilityImages wide = draw(scene);
  spot->SetConeAngle(65.0);
  const VisibilityImages narrow = draw(scene);
  const VisibilityImages truth = draw(scene, "raytraced");
  EXPECT_GT(compareVisibility(wide, narrow).wrong, 500u);
  EXPECT_LE(compareVisibility(truth, narrow).wrong, 5u);
}

TEST_F(PositionalLights, mapsHaveLayersOnlyForFacesWithCasters)
{
  PassScene scene(100, 100);
  scene.addFloor(1.0);
  vtkLight* lamp = scene.addSpot({ 0.0, 0.0, 3.0 }, glm::dvec3(0.0), allDirections);
  scene.pass->SetMapSize(64);
  scene.lookFrom({ 0.0, -3.0, 3.0 });
  draw(scene);
  EXPECT_EQ(scene.report().bytesMaps, 64u * 64u * 4u);
  lamp->SetPosition(0.0, 0.0, 0.5); // below, and to the four sides
  draw(scene);
  EXPECT_EQ(scene.report().bytesMaps, 5u * 64u * 64u * 4u);
}

TEST_F(PositionalLights, lightsOfAllKindsShareAShader)
{
  PassScene scene(240, 180);
  scene.addFloor(4.0);
  scene.addSphere({ 0.7, 0.3, 1.5 }, 0.7);
  scene.addBox({ -2.0, -1.0, 0.0 }, { -1.0, 0.0, 1.5 });
  scene.lookFrom({ 1.0, -9.0, 7.0 });
  const double up[3] = { 0.0, 1.0, 0.0 };
  scene.addSpot({ 0.0, 2.0, 3.0 }, glm::dvec3(0.0), allDirections)->SetIntensity(0.25);
  scene.addSun({ 1.0, 0.4, -1.5 })->SetIntensity(0.2);
  scene.addSpot({ -3.0, -1.0, 4.0 }, glm::dvec3(0.0), 30.0)->SetIntensity(0.2);
  vtkLight* beam = scene.addSun({ -1.0, 0.4, -1.5 });
  beam->SetPosition(2.0, -0.8, 3.0);
  beam->SetIntensity(0.2);
  vtkGnomonLightKeys::SetBox(beam, 3.0, 4.0, 6.0, up);
  scene.addSpot({ -1.0, -3.0, 2.0 }, glm::dvec3(0.0), 70.0)->SetIntensity(0.2);
  const Picture direct = scene.render();
  EXPECT_EQ(scene.report().route, "inline");
  scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
  EXPECT_EQ(differingPixels(direct, scene.render(), 1), 0u);
  EXPECT_LE(differingPixels(direct, scene.render("raytraced"), 8), 800u);
  EXPECT_GT(differingPixels(direct, scene.renderPlain(), 8), 10000u);
}
