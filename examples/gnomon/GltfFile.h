#pragma once

#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// What a glTF file holds besides surfaces.
struct GltfView
{
  /// Of KHR_lights_punctual, in the order of the nodes; the intensity of those that have a position
  /// is in candela.
  std::vector<SceneLight> lights;
  std::optional<SceneCamera> camera; ///< the first camera of the default scene
  std::vector<std::string> notes;    ///< see Scene::notes
};

/// Checks a .glb or .gltf file as far as vtkGLTFImporter trusts it (every index, every range of
/// bytes, images included), and reads lights and camera. VTK 9.1 imports both, but puts spot lights
/// a unit away from their nodes.
/// @throws BadInput
GltfView readGltfView(const std::string& path);

} // namespace gnomon::tool
