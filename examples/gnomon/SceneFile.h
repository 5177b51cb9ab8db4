#pragma once

#include "JsonValue.h"
#include "Scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace gnomon::tool
{

/// Read a scene file and the models that it names (docs/guide/scene_files.md).
/// @param ground see loadScene()
/// @throws BadInput, with a message that names file, place, value found and value expected
Scene readSceneFile(const std::string& path, std::optional<bool> ground = std::nullopt);

/// Read camera, lights and background of a scene, where they are given.
/// @param folder base of relative file paths
/// @return the share of ambient light, if it is given
/// @throws BadInput
std::optional<double> readSurroundings(
  JsonMembers& members, const std::filesystem::path& folder, Scene& scene);

/// Write a scene as FOLDER/NAME.json, with its surfaces as NAME-NUMBER.vtp, for other programs.
/// Create the folder. Texture filtering, and materials except their colour, are left out.
/// @return the scene file's path
/// @throws BadInput if the folder cannot be written to
std::string exportScene(const Scene& scene, const std::string& folder);

/// Read or write a light of a scene file or of --light.
/// @param texture its texture's file, if it has one
/// @param folder base of relative file paths
/// @throws BadInput
void describe(JsonMembers& members, SceneLight& light, std::optional<std::string>& texture,
  const std::filesystem::path& folder);

/// Read or write a camera of a scene file or of --camera.
/// @param complete true: position and target are required
/// @throws BadInput
void describe(JsonMembers& members, SceneCamera& camera, bool complete);

} // namespace gnomon::tool
