#ifndef gnomon_examples_gnomon_SceneJson_h
#define gnomon_examples_gnomon_SceneJson_h

#include "JsonValue.h"
#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// A light of a scene file or of --light, checked in full. Empty for the kind that comes with a
/// later version (area) when `fileLights` is Ignore.
/// @throws BadInput
std::optional<SceneLight> readLight(const JsonValue& value, FileLights fileLights);

/// A camera of a scene file or of --camera. Without `defaults`, position and target must be there.
/// @throws BadInput
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults);

} // namespace gnomon::tool

#endif
