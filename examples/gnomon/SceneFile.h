#pragma once

#include "SceneJson.h"

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
  const JsonValue& root, const std::filesystem::path& folder, Scene& scene);

} // namespace gnomon::tool
