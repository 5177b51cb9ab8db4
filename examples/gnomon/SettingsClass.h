#pragma once

#include <string>

namespace gnomon::tool
{

/// The header of vtkGnomonShadowSettings, lights/vtkGnomonShadowSettings.h: a setter and a getter of
/// each setting, with its documentation.
std::string settingsClass();

} // namespace gnomon::tool
