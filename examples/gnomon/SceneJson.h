#pragma once

#include "JsonValue.h"
#include "Scene.h"

#include <filesystem>
#include <optional>

namespace gnomon::tool
{

/// A light of a scene file or of --light.
/// @param folder that paths of files are relative to
/// @throws BadInput
SceneLight readLight(const JsonValue& value, const std::filesystem::path& folder);

/// A camera of a scene file or of --camera. Without `defaults`, position and target must be there.
/// @throws BadInput
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults);
/// The same camera, for scene files.
nlohmann::ordered_json toJson(const SceneCamera& camera);

} // namespace gnomon::tool
