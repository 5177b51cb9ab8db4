#pragma once

#include "Scene.h"

#include <optional>
#include <string>

namespace gnomon::tool
{

/// Reads a scene file (docs/guide/scene_files.md).
/// @param ground whether models stand on a ground; without it the file decides
/// @throws BadInput
Scene readSceneFile(const std::string& path, std::optional<bool> ground = std::nullopt);

} // namespace gnomon::tool
