#pragma once

#include <map>
#include <string>

namespace gnomon
{

/// Return the project's .glsl files as of its build, by path from the project's root, e.g.
/// "shadowtech/base/shadow_ray.glsl". cmake/GnomonEmbedGlsl.cmake generates the definition.
const std::map<std::string, std::string>& embeddedShaders();

} // namespace gnomon
