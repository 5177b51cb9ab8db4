#ifndef gnomon_examples_gnomon_SceneJson_h
#define gnomon_examples_gnomon_SceneJson_h

#include "JsonValue.h"
#include "Scene.h"

#include <optional>

namespace gnomon::tool
{

/// A light of a scene file or of --light.
/// @throws BadInput
SceneLight readLight(const JsonValue& value);

/// A camera of a scene file or of --camera. Without `defaults`, position and target must be there.
/// @throws BadInput
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults);

} // namespace gnomon::tool

#endif
