#pragma once

#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// What a model file holds.
struct Model
{
  std::vector<SceneModel> surfaces;  ///< at least one, with at least one triangle
  std::vector<SceneLight> lights;    ///< glTF only
  std::optional<SceneCamera> camera; ///< glTF only: its first camera
  std::vector<std::string> notes;    ///< see Scene::notes
};

/// Reads a model with VTK's reader for its file type: .obj .ply .stl .vtp .3ds .glb .gltf. Surfaces
/// without normals get smooth ones, with sharp edges where the surface bends by more than 60
/// degrees.
/// @throws BadInput
Model readModelFile(const std::string& path);

/// Whether the path ends like a model file, in any case.
bool isModelFile(const std::string& path);

/// ".obj, .ply, ...": for messages.
std::string modelFileTypes();

} // namespace gnomon::tool
