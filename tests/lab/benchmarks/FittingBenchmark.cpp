// Compare the cost of fitting a light's views to the receivers, and of a map of other surfaces,
// with that of baking a plain map. Scene: the bunny on a plane. The ways take turns frame by frame.
//
// gnomon_benchmark_fitting [SIDE [FRAMES]], the side of the receivers' image in pixels.

#include "Scene.h"
#include "SyntheticScene.h"
#include "Timing.h"

#include "lights/SettingsTable.h"

#include "plugin/scene/OccluderCollector.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/Pcf.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vtkNew.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
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

/// The receivers' images as the receivers stage renders them.
struct Images
{
  Images(const Occluders& occluders, const Camera& camera, const glm::dmat4& viewFromCentred)
  {
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    std::vector<glm::vec4> fragmentTexels(receivers.size(), glm::vec4(0.0f));
    std::vector<glm::vec4> pointTexels(receivers.size(), glm::vec4(0.0f));
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      if (receivers.surface[i] == ReceiverPixels::notCovered)
      {
        continue;
      }
      const glm::dvec4 position(
        receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i], 1.0);
      const glm::dvec3 normal(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);
      const glm::vec3 normalView = glm::dmat3(viewFromCentred) * normal;
      fragmentTexels[i] = glm::vec4(1.0f, 0.0f, normalView.x, normalView.y);
      const glm::vec3 pointView(viewFromCentred * position);
      pointTexels[i] = glm::vec4(pointView, normalView.z);
      this->pointsView.push_back(pointView);
    }
    fill(this->fragments, camera.width, fragmentTexels);
    fill(this->points, camera.width, pointTexels);
  }

  GlTexture fragments;
  GlTexture points;
  std::vector<glm::vec3> pointsView; ///< of the pixels that show a receiver
};

/// Compute the corners of the box around the points, on one thread of the CPU.
std::array<glm::vec3, 2> boundsOnCpu(const std::vector<glm::vec3>& points, const glm::mat4x3& to)
{
  std::array<glm::vec3, 2> corners{ glm::vec3(std::numeric_limits<float>::max()),
    glm::vec3(std::numeric_limits<float>::lowest()) };
  for (const glm::vec3& point : points)
  {
    const glm::vec3 moved = to * glm::vec4(point, 1.0f);
    corners = { glm::min(corners[0], moved), glm::max(corners[1], moved) };
  }
  return corners;
}

/// Needs a current context.
void run(int side, int frames)
{
  OccluderCollector collector;
  collector.collect(tool::makeRenderer(tool::loadScene("bunny"), 1.0));
  const Occluders& occluders = collector.occluders();
  Camera camera;
  camera.position = { 2.0, 2.0, 4.0 };
  camera.target = { 0.0, -0.2, 0.0 };
  camera.up = { 0.0, 1.0, 0.0 };
  camera.width = camera.height = side;
  CameraView view;
  view.viewFromCentred = glm::lookAt(
    camera.position - occluders.frame.centre, camera.target - occluders.frame.centre, camera.up);
  view.clipFromView = glm::perspective(glm::radians(camera.fovDegrees), 1.0, 0.1, 100.0);
  const Images images(occluders, camera, view.viewFromCentred);

  OccluderBuffers buffers;
  buffers.update(occluders);
  ShaderLibrary shaders;
  Compare technique;
  ViewFitting fitting;
  fitting.centreWorld = occluders.frame.centre;
  fitting.castersCentred = fitting.receiversCentred = occluders.allCentred;
  fitting.texels = { mapSizeTexels, 1 };
  ShadowLight plain = directionalLight({ -1.0, -1.2, -0.5 });
  plain.mapSizeTexels = mapSizeTexels;
  const LightViews plainViews = fitLightViews(plain, fitting);
  fitting.camera = view;

  std::vector<Way> ways;
  const auto add = [&](const std::string& name, const std::function<void()>& work)
  {
    ways.push_back({ name,
      [work]
      {
        work();
        glFinish();
      } });
  };
  add("map of " + std::to_string(mapSizeTexels),
    [&] {
      technique.bake({ plain, plainViews, occluders, buffers, shaders });
    });
  ShadowLight second = plain;
  second.depthMap.surface = DepthSurface::Second;
  ShadowLight midpoint = plain;
  midpoint.depthMap.surface = DepthSurface::Midpoint;
  Compare secondMap;
  Compare midpointMap;
  add("the same, second depths",
    [&] {
      secondMap.bake({ second, plainViews, occluders, buffers, shaders });
    });
  add("the same, midpoints",
    [&] {
      midpointMap.bake({ midpoint, plainViews, occluders, buffers, shaders });
    });
  const auto addFit = [&](const std::string& name, ShadowLight light, const char* projection)
  {
    findSetting("projection")->set(light, projection);
    light.fit = ViewFit::Frame;
    light.fittedToReceivers = true;
    light.mapSizeTexels = mapSizeTexels;
    const LightViews views = fitLightViews(light, fitting);
    auto fit = std::make_shared<ReceiverFit>();
    add(name,
      [&, light, views, fit]
      {
        fit->compute(light, views, { images.fragments.name(), images.points.name(), side, side },
          glm::inverse(view.viewFromCentred), shaders);
      });
  };
  addFit("fit of a sun", plain, "uniform");
  const glm::mat4x3 across(glm::lookAt(glm::dvec3(0.0), plain.directionWorld, camera.up) *
    glm::inverse(view.viewFromCentred));
  std::array<glm::vec3, 2> corners{};
  add("its bounds on the CPU", [&] { corners = boundsOnCpu(images.pointsView, across); });
  addFit("fit of a sun, lispsm", plain, "lispsm");
  addFit("fit of a sun, pssm", plain, "pssm");
  addFit("fit of a spot", spotLight({ 4.0, 4.0, 2.0 }, glm::dvec3(0.0), 40.0), "uniform");
  addFit("fit of a point light", pointLight({ 1.5, 2.0, 1.0 }), "uniform");

  takeTurns(ways, frames);
  std::cout << glGetString(GL_RENDERER) << ", " << side << " x " << side << ", " << frames
            << " frames\n";
  printTimes(ways, "map");
  std::cout << "the box is " << glm::length(corners[1] - corners[0]) << " across\n";
}

} // namespace
} // namespace gnomon::test

//------------------------------------------------------------------------------
int main(int argc, char** argv)
{
  const auto window = gnomon::makeOffScreenWindow();
  window->Initialize();
  window->MakeCurrent();
  gnomon::test::run(argc > 1 ? std::atoi(argv[1]) : 2048, argc > 2 ? std::atoi(argv[2]) : 21);
  return EXIT_SUCCESS;
}
