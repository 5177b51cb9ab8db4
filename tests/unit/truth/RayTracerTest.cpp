#include "SyntheticScene.h"

#include "shadowtech/base/RayTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gnomon::test
{
namespace
{

std::vector<float> trace(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  RayTracer tracer;
  tracer.update(occluders);
  std::vector<float> visibility;
  tracer.trace(light, occluders, receivers, visibility);
  return visibility;
}

glm::dmat4 at(const glm::dvec3& position, double scale = 1.0)
{
  return glm::scale(glm::translate(glm::dmat4(1.0), position), glm::dvec3(scale));
}

struct TestScene
{
  std::string name;
  std::vector<Prop> props;
  Camera camera;
};

std::vector<TestScene> testScenes()
{
  Camera camera;
  camera.position = { 3.0, -5.0, 4.0 };
  camera.target = { 0.0, 0.0, 0.4 };
  const Prop plane{ makePlane(6.0) };
  return {
    { "cube", { plane, { makeBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 }) } }, camera },
    { "sphere", { plane, { makeSphere(12, 24), at({ 0.0, 0.0, 1.0 }) } }, camera },
    { "soup", { plane, { makeTriangleSoup(400, 7), at({ 0.0, 0.0, 1.5 }) } }, camera },
  };
}

TEST(RayTracer, AgreesWithBruteForce)
{
  std::size_t rays = 0;
  std::size_t different = 0;
  for (const TestScene& scene : testScenes())
  {
    const Occluders occluders = makeOccluders(scene.props);
    const ReceiverPixels receivers = makeReceivers(occluders, scene.camera);
    for (const ShadowLight& light :
      { directionalLight({ -1.0, 0.5, -1.5 }), directionalLight({ 0.0, 0.0, -1.0 }),
        spotLight({ 2.0, 1.0, 5.0 }, { 0.0, 0.0, 0.0 }, 25.0) })
    {
      const std::vector<float> visibility = trace(light, occluders, receivers);
      const std::vector<float> expected = traceBruteForce(light, occluders, receivers);
      rays += receivers.size();
      for (std::size_t i = 0; i < receivers.size(); ++i)
      {
        if (visibility[i] != expected[i])
        {
          ++different;
          EXPECT_LT(edgeDistance(light, occluders, receivers, i), 1e-6)
            << scene.name << " pixel " << i;
        }
      }
      const auto lit = std::count(expected.begin(), expected.end(), 1.0f);
      EXPECT_GT(lit, 100) << scene.name;
      EXPECT_LT(lit, static_cast<std::ptrdiff_t>(receivers.size()) - 100) << scene.name;
    }
  }
  EXPECT_LE(different, 1 + rays / 1000000) << "of " << rays;
}

} // namespace
} // namespace gnomon::test
