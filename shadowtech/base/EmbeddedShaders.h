#pragma once

#include <map>
#include <string>

namespace gnomon
{

/// The project's .glsl files as they were when it was built, by path from the project's root, e.g.
/// "shadowtech/nsm/nsm_estimator.glsl". The definition is generated (cmake/GnomonEmbedGlsl.cmake).
const std::map<std::string, std::string>& embeddedShaders();

} // namespace gnomon
