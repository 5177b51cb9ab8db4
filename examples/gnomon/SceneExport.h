#pragma once

#include "Scene.h"

namespace gnomon::tool
{

/// Write a scene as FOLDER/NAME.json, with its surfaces as NAME-NUMBER.vtp, for other programs.
/// Create the folder. Texture filtering, and materials except their colour, are left out.
/// @return the scene file's path
/// @throws BadInput if the folder cannot be written to
std::string exportScene(const Scene& scene, const std::string& folder);

} // namespace gnomon::tool
