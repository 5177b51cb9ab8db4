#pragma once

#include "JsonValue.h"
#include "Scene.h"

#include <filesystem>
#include <optional>

namespace gnomon::tool
{

/// Read a light of a scene file or of --light.
/// @param folder base of relative file paths
/// @throws BadInput
SceneLight readLight(const JsonValue& value, const std::filesystem::path& folder);

/// Read a camera of a scene file or of --camera. Without `defaults`, position and target are
/// required.
/// @throws BadInput
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults);
/// The same camera, for scene files.
nlohmann::ordered_json toJson(const SceneCamera& camera);

} // namespace gnomon::tool
