// Soft shadows where casters stand on their receiver: with techniques of maps, they begin at the
// contact.

#include "PassScene.h"

#include "lights/vtkGnomonLightKeys.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// By technique, with default settings, including montecarlo's filter.
class SoftContacts
  : public PassTest
  , public testing::WithParamInterface<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Techniques, SoftContacts, testing::Values("pcss", "sampled", "montecarlo"),
  [](const testing::TestParamInfo<const char*>& technique)
  { return std::string(technique.param); });

/// A box and a wall thinner than a texel, oblique to the map's rows. The light is large. Behind
/// them the floor sees nothing of it, as far as 0.22.
TEST_P(SoftContacts, areDarkBeyondTwoTexels)
{
  const double turnDegrees = 20.0;
  const glm::dvec2 behind(std::cos(glm::radians(turnDegrees)), std::sin(glm::radians(turnDegrees)));
  double most = 0.0; // texels
  for (const bool sun : { false, true })
  {
    for (const double thick : { 1.0, 0.01 })
    {
      PassScene scene(200, 150);
      scene.addFloor(4.0);
      scene.addBox({ -thick, -2.0, 0.0 }, { 0.0, 2.0, 0.4 })->RotateZ(turnDegrees);
      scene.lookDown(0.3, 0.16, 0.0);
      vtkLight* light = sun ? scene.addSun({ 3.0, 0.0, -4.0 })
                            : scene.addSpot({ -6.0, 0.0, 8.0 }, glm::dvec3(0.0), 30.0);
      vtkGnomonLightKeys::SetSetting(light, "light_radius", sun ? "12" : "1");
      scene.pass->SetTechnique(GetParam());
      for (const int mapSize : { 256, 512 })
      {
        scene.pass->SetMapSize(mapSize);
        const VisibilityImages& kept = drawKept(scene);
        // Texels across the light; on the oblique floor a texel is longer.
        const double side = sun ? 8.0 * std::sqrt(2.0) : 2.0 * 12.0 * std::tan(glm::radians(30.0));
        const double texel = side / mapSize;
        std::size_t looked = 0;
        double farthest = 0.0;
        for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
        {
          const glm::dvec3 at = positionOf(kept, i);
          const double distance = glm::dot(behind, glm::dvec2(at));
          if (std::abs(at.z) < 1e-3 && distance > 0.0 && distance < 0.2)
          {
            ++looked;
            const bool lit = kept.visibility[0][i] > 0.5f / 255.0f; // visible in the picture
            farthest = std::max(farthest, lit ? distance : 0.0);
          }
        }
        EXPECT_GT(looked, 5000u);
        EXPECT_LE(farthest, 2.0 * texel)
          << "sun " << sun << ", thick " << thick << ", map " << mapSize;
        most = std::max(most, farthest / texel);
      }
    }
  }
  RecordProperty("texels", std::to_string(most));
}

} // namespace
