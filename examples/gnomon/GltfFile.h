#pragma once

#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// The contents of a glTF file besides surfaces.
struct GltfView
{
  /// The lights of KHR_lights_punctual, in the order of the nodes. Positional lights' intensities
  /// are in candela.
  std::vector<SceneLight> lights;
  std::optional<SceneCamera> camera; ///< the first camera of the default scene
  std::vector<std::string> notes;    ///< see Scene::notes
  std::size_t neighbourBytes = 0;    ///< size of the files that hold its buffers and images
};

/// Read lights and camera of a .glb or .gltf file. VTK 9.1 imports both, too, but puts spot lights
/// a unit away from their nodes.
/// @throws BadInput
GltfView readGltfView(const std::string& path);

} // namespace gnomon::tool
