#pragma once

#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// The contents of a model file.
struct Model
{
  std::vector<SceneModel> surfaces;  ///< at least one, with at least one triangle
  std::vector<SceneLight> lights;    ///< glTF only
  std::optional<SceneCamera> camera; ///< glTF only: its first camera
  std::vector<std::string> notes;    ///< see Scene::notes
};

inline constexpr std::size_t largestModelBytes = std::size_t{ 4 } << 30;

/// Read a model with VTK's reader for its file type: .obj .ply .stl .vtp .3ds .glb .gltf. Surfaces
/// without normals get smooth ones, with sharp edges where the surface bends by more than 60
/// degrees.
/// @throws BadInput
Model readModelFile(const std::string& path);

/// True if the path has a model file's extension, in upper or lower case.
bool isModelFile(const std::string& path);

/// Return the extensions for messages: ".obj, .ply, ...".
std::string modelFileTypes();

} // namespace gnomon::tool
