// Compare the cost of fitting a sun's view to the receivers, on the GPU and on the CPU, and of a
// map of second depths, with that of baking a plain map. Scene: the bunny on a plane. The ways take
// turns frame by frame.
//
// gnomon_benchmark_fitting [SIDE [FRAMES]], the side of the receivers' image in pixels.

#include "FrameVariant.h"
#include "Scene.h"
#include "SyntheticScene.h"

#include "plugin/scene/OccluderCollector.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/Pcf.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cstdlib>
#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int mapSizeTexels = 1024;

void fill(GlTexture& texture, int side, const std::vector<glm::vec4>& texels)
{
  glBindTexture(GL_TEXTURE_2D, texture.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, side, side, 0, GL_RGBA, GL_FLOAT, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// Needs a current context.
void run(int side, int frames)
{
  OccluderCollector collector;
  collector.collect(tool::makeRenderer(tool::loadScene("bunny"), 1.0));
  const Occluders& occluders = collector.occluders();
  const Camera camera{ { 2.0, 2.0, 4.0 }, { 0.0, -0.2, 0.0 }, { 0.0, 1.0, 0.0 }, 40.0, 0.0, side,
    side };
  const glm::dvec3 centre = occluders.frame.centre;
  const CameraView view{ glm::lookAt(camera.position - centre, camera.target - centre, camera.up),
    glm::perspective(glm::radians(camera.fovDegrees), 1.0, 0.1, 100.0) };

  // The receivers' images as the receivers stage renders them.
  const ReceiverPixels receivers = makeReceivers(occluders, camera);
  std::vector<glm::vec4> fragments(receivers.size(), glm::vec4(0.0f)), points = fragments;
  std::vector<glm::vec3> pointsView; // of the pixels that show a receiver
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    if (receivers.surface[i] != ReceiverPixels::notCovered)
    {
      const glm::vec3 normal = glm::dmat3(view.viewFromCentred) * glm::dvec3(receivers.normal(i));
      pointsView.emplace_back(
        view.viewFromCentred * glm::dvec4(glm::dvec3(receivers.position(i)), 1.0));
      fragments[i] = glm::vec4(1.0f, 0.0f, normal.x, normal.y);
      points[i] = glm::vec4(pointsView.back(), normal.z);
    }
  }
  GlTexture fragmentImage, pointImage;
  fill(fragmentImage, side, fragments);
  fill(pointImage, side, points);

  OccluderBuffers buffers;
  buffers.update(occluders);
  ShaderLibrary shaders;
  const ShadowLight sun = withMap(directionalLight({ -1.0, -1.2, -0.5 }), mapSizeTexels);
  ShadowLight second = sun, fitted = sun;
  second.depthMap.surface = DepthSurface::Second;
  fitted.fit = ViewFit::Frame;
  fitted.fittedToReceivers = true;
  const ViewFitting fitting{ centre, occluders.allCentred, occluders.allCentred,
    { mapSizeTexels, 1 }, view };
  const LightViews views = fitLightViews(sun, fitting);
  const LightViews fittedViews = fitLightViews(fitted, fitting);
  Compare map, secondMap;
  ReceiverFit fit;
  const glm::mat4x3 across(glm::lookAt(glm::dvec3(0.0), sun.directionWorld, camera.up) *
    glm::inverse(view.viewFromCentred));
  glm::vec3 lower(0.0f), upper(0.0f);
  const std::pair<std::string, std::function<void()>> ways[] = {
    { "map of " + std::to_string(mapSizeTexels),
      [&] {
        map.bake({ sun, views, occluders, buffers, shaders });
      } },
    { "the same, second depths",
      [&] {
        secondMap.bake({ second, views, occluders, buffers, shaders });
      } },
    { "fit of a sun",
      [&]
      {
        fit.compute(fitted, fittedViews, { fragmentImage.name(), pointImage.name(), side, side },
          glm::inverse(view.viewFromCentred), shaders);
      } },
    { "its bounds on the CPU",
      [&]
      {
        lower = glm::vec3(std::numeric_limits<float>::max());
        upper = -lower;
        for (const glm::vec3& point : pointsView)
        {
          const glm::vec3 moved = across * glm::vec4(point, 1.0f);
          lower = glm::min(lower, moved);
          upper = glm::max(upper, moved);
        }
      } },
  };
  // CPU time of all threads tells more than wall time on a busy machine with software OpenGL.
  const std::vector<double> medians = tool::timeFrames(std::size(ways), frames,
    [&](std::size_t way, int)
    {
      const std::clock_t begin = std::clock();
      ways[way].second();
      glFinish();
      return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    });
  std::cout << glGetString(GL_RENDERER) << ", " << side << " x " << side << ", " << frames
            << " frames; a box " << glm::length(upper - lower) << " across; processor ms:\n";
  for (std::size_t way = 0; way < medians.size(); ++way)
  {
    std::cout << std::left << std::setw(28) << ways[way].first << std::fixed << std::setprecision(2)
              << medians[way] << "\n";
  }
}

} // namespace
} // namespace gnomon::test

int main(int argc, char** argv)
{
  const auto window = gnomon::makeOffScreenWindow();
  window->Initialize();
  window->MakeCurrent();
  gnomon::test::run(argc > 1 ? std::atoi(argv[1]) : 2048, argc > 2 ? std::atoi(argv[2]) : 21);
  return EXIT_SUCCESS;
}
