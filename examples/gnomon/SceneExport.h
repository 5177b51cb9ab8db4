#pragma once

#include "Scene.h"

namespace gnomon::tool
{

/// Writes a scene as FOLDER/NAME.json with its surfaces beside it as NAME-NUMBER.vtp, so that other
/// programs can read it. Makes the folder. Filtering of textures, and materials beyond their
/// colour, are left out.
/// @return the scene file's path
/// @throws BadInput when the folder cannot be written to
std::string exportScene(const Scene& scene, const std::string& folder);

} // namespace gnomon::tool
