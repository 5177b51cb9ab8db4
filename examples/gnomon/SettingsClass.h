#pragma once

#include <string>

namespace gnomon::tool
{

/// Return the header of vtkGnomonShadowSettings, lights/vtkGnomonShadowSettings.h: a documented
/// setter and getter for each setting.
std::string settingsClass();

} // namespace gnomon::tool
