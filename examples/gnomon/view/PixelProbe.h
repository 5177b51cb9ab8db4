#pragma once

#include "Scene.h"
#include "view/LightSights.h"

#include "lights/LightManager.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Explains a pixel: its visibility for each light, and the reason, found by a ray to the light's
/// middle.
class PixelProbe
{
public:
  /// @param images of the frame
  /// @param sights of the same frame
  /// @param nameOf returns the name of a prop of the renderer
  /// @param pixel row 0 at the bottom
  /// @return a line for the pixel, and one for each light that casts
  std::vector<std::string> ask(const VisibilityImages& images, const LightSights& sights,
    const std::function<std::string(const vtkProp*)>& nameOf, const std::array<int, 2>& pixel)
  {
    const int row = images.height - 1 - pixel[1];
    std::vector<std::string> lines = { "pixel " + std::to_string(pixel[0]) + ", " +
      std::to_string(pixel[1]) };
    if (pixel[0] < 0 || pixel[0] >= images.width || row < 0 || row >= images.height)
    {
      lines.front() += ": outside of the picture";
      return lines;
    }
    const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(images.width) +
      static_cast<std::size_t>(pixel[0]);
    if (images.coverage[i] != 1.0f)
    {
      lines.front() += ": no surface";
      return lines;
    }
    const glm::dvec3 world = glm::dvec3(images.origin[0], images.origin[1], images.origin[2]) +
      glm::dvec3(images.positionX[i], images.positionY[i], images.positionZ[i]);
    lines.front() +=
      ": at " + fourDigits(world.x) + ", " + fourDigits(world.y) + ", " + fourDigits(world.z);
    this->tracer_.update(sights.snapshot().occluders());
    const glm::vec3 position(sights.snapshot().occluders().frame.fromWorld(world));
    const glm::vec3 normal(images.normalX[i], images.normalY[i], images.normalZ[i]);
    for (std::size_t k = 0; k < images.visibility.size(); ++k)
    {
      const LightSight* const sight = sights.find(images.sceneIndices[k]);
      const LightChannel channel = images.channels[k];
      if (!sight || channel == LightChannel::Green || channel == LightChannel::Blue)
      {
        continue;
      }
      std::string line = gnomon::nameOf(sight->light) + ": " + fourDigits(images.visibility[k][i]);
      if (!images.classes[k].classes.empty())
      {
        line += " (" + images.classes[k].classes[images.classes[k].ofPixels[i]].name + ")";
      }
      const std::string why = whyDark(*sight, sights, this->tracer_, nameOf, position, normal);
      lines.push_back(line + (why.empty() ? ", nothing before its middle" : ", " + why));
    }
    return lines;
  }

private:
  using NameOf = std::function<std::string(const vtkProp*)>;

  static std::string fourDigits(double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }

  /// Return why a light's middle does not reach a point; empty if it does.
  static std::string whyDark(const LightSight& sight, const LightSights& sights,
    const EmbreeTracer& tracer, const NameOf& nameOf, const glm::vec3& position,
    const glm::vec3& normal)
  {
    const Occluders& occluders = sights.snapshot().occluders();
    const ShadowRayLight light(sight.light, occluders.frame.centre);
    // The pixel's own triangle, which is unknown here, would allow a nearer start of the ray.
    const float offset = 1e-5f * static_cast<float>(occluders.allCentred.radius());
    return visitShadowRays(light,
      [&](const auto& make, float rayFar) -> std::string
      {
        const ShadowRay ray = make(position, normal, offset);
        if (!ray.traced)
        {
          const glm::vec3 toLight =
            light.kind == LightKind::Directional ? light.toLight : light.position - position;
          return !facesLight(normal, toLight) ? "turned away from the light"
            : light.hasBox                    ? "outside of the light's box"
                                              : "outside of the light's cone";
        }
        const auto hit = tracer.nearest(ray.origin, ray.direction, shadowRayNear, rayFar);
        if (!hit)
        {
          return "";
        }
        const Surface& surface = occluders.surfaces[hit->surface];
        const std::string triangle = hit->solid
          ? ""
          : "triangle " + std::to_string(hit->triangle - surface.firstTriangle) + ", ";
        return "behind " + nameOf(sights.snapshot().propOf(hit->surface)) + ", " + triangle +
          fourDigits(hit->at * glm::length(ray.direction) * occluders.frame.unitWorld()) + " away";
      });
  }

  EmbreeTracer tracer_;
};

} // namespace gnomon::tool
