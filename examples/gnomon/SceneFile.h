#pragma once

#include "Scene.h"

#include <optional>
#include <string>

namespace gnomon::tool
{

/// Read a scene file (docs/guide/scene_files.md).
/// @param ground true: models stand on a ground; none: the file decides
/// @throws BadInput
Scene readSceneFile(const std::string& path, std::optional<bool> ground = std::nullopt);

} // namespace gnomon::tool
