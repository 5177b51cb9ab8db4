#include "plugin/frame/KeptVisibility.h"

#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace gnomon
{
namespace
{

template <typename Value>
std::vector<Value> topRowFirst(const std::vector<Value>& image, int width, int height)
{
  std::vector<Value> flipped(image.size());
  for (int y = 0; y < height; ++y)
  {
    const auto row = image.begin() + static_cast<std::ptrdiff_t>(y) * width;
    std::copy(
      row, row + width, flipped.begin() + static_cast<std::ptrdiff_t>(height - 1 - y) * width);
  }
  return flipped;
}

/// Return images of the receivers, without visibility.
VisibilityImages imagesOf(const ReceiverPixels& receivers, const SceneFrame& frame)
{
  VisibilityImages images;
  images.width = receivers.width;
  images.height = receivers.height;
  const glm::dvec3 origin = frame.toWorld(glm::dvec3(0.0));
  images.origin = { { origin.x, origin.y, origin.z } };
  const auto flip = [&](const std::vector<float>& plane)
  { return topRowFirst(plane, images.width, images.height); };
  const auto inWorld = [&](const std::vector<float>& plane)
  {
    std::vector<float> image = flip(plane);
    const auto unit = static_cast<float>(frame.unitWorld());
    std::transform(image.begin(), image.end(), image.begin(), [=](float at) { return at * unit; });
    return image;
  };
  images.positionX = inWorld(receivers.positionX);
  images.positionY = inWorld(receivers.positionY);
  images.positionZ = inWorld(receivers.positionZ);
  images.normalX = flip(receivers.normalX);
  images.normalY = flip(receivers.normalY);
  images.normalZ = flip(receivers.normalZ);
  std::vector<float> coverage(receivers.size());
  std::transform(receivers.surface.begin(), receivers.surface.end(), coverage.begin(),
    [](std::uint32_t surface) { return surface == ReceiverPixels::notCovered ? 0.0f : 1.0f; });
  images.coverage = flip(coverage);
  return images;
}

/// Adds whose surfaces the pixels show.
void addNames(VisibilityImages& images, const ReceiversValue& value,
  const ReceiverPixels& receivers, const Occluders& occluders,
  const std::vector<SurfaceName>& names)
{
  std::vector<int> props(receivers.size(), -1);
  std::vector<std::int64_t> cells(receivers.size(), -1);
  std::unordered_map<std::uint32_t, std::vector<vtkIdType>> cellsOfSurfaces;
  for (std::size_t pixel = 0; pixel < receivers.size(); ++pixel)
  {
    const std::uint32_t surface = receivers.surface[pixel];
    if (surface >= names.size())
    {
      continue; // nothing is covered
    }
    const SurfaceName& name = names[surface];
    props[pixel] = name.prop;
    if (name.data)
    {
      const auto [found, isNew] = cellsOfSurfaces.try_emplace(surface);
      if (isNew)
      {
        found->second = cellsOfPrimitives(name);
      }
      const glm::vec2 fragment = value.images.fragments[pixel];
      const std::uint32_t primitive =
        findTriangle(fragment.x, fragment.y, value.drawnSurfaces, occluders).primitive;
      cells[pixel] = primitive < found->second.size() ? found->second[primitive] : -1;
    }
  }
  images.prop = topRowFirst(props, images.width, images.height);
  images.cell = topRowFirst(cells, images.width, images.height);
}

/// Adds a light's visibility: one image, or three of a light with a texture, whether or not its
/// technique sees it.
/// @param edges whose visibility in the layers is the picture's
void addLight(VisibilityImages& images, const CastingLight& casting, const ClassImage& classes,
  const VisibilityLayers& layers, const std::vector<EdgePixel>& edges)
{
  const auto add = [&](const std::vector<float>& visibility, LightChannel channel)
  {
    images.visibility.push_back(topRowFirst(visibility, images.width, images.height));
    images.sceneIndices.push_back(casting.light().sceneIndex);
    images.channels.push_back(channel);
    images.classes.push_back(classes);
  };
  std::vector<float> visibility;
  const auto read = [&](int channel)
  {
    if (casting.plan.bit != noBit)
    {
      layers.readBit(casting.plan.bit, visibility);
      return;
    }
    layers.read(casting.plan.layer + channel, visibility);
    for (const EdgePixel& edge : edges)
    {
      visibility[edge.pixel] = edge.ofCentre[channel];
    }
  };
  if (casting.plan.channels == 1 && !casting.light().texture)
  {
    read(0);
    add(visibility, LightChannel::All);
    return;
  }
  constexpr std::array<LightChannel, 3> channels = { LightChannel::Red, LightChannel::Green,
    LightChannel::Blue };
  for (int channel = 0; channel < 3; ++channel)
  {
    const bool seen = casting.plan.channels == 3;
    read(seen ? channel : 0);
    const float lit = seen ? 1.0f : casting.light().texture->mean[channel];
    std::transform(
      visibility.begin(), visibility.end(), visibility.begin(), [&](float v) { return lit * v; });
    add(visibility, channels[static_cast<std::size_t>(channel)]);
  }
}

} // namespace

VisibilityImages keepVisibility(const CastingLights& lights, const ViewValues& view,
  const ReceiverPixels& receivers, const Occluders& occluders,
  const std::vector<SurfaceName>& names)
{
  VisibilityImages images = imagesOf(receivers, occluders.frame);
  addNames(images, view.receivers, receivers, occluders, names);
  auto value = view.visibility.begin();
  for (const CastingLight& casting : lights)
  {
    ClassImage classImage{ casting.info().classes, {} };
    if (!classImage.classes.empty())
    {
      classImage.ofPixels = topRowFirst(value->classes, images.width, images.height);
    }
    addLight(images, casting, classImage, view.layers, value->edges);
    ++value;
  }
  return images;
}

} // namespace gnomon
