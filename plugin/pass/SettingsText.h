#pragma once

#include <string>

namespace gnomon
{

/// Return all settings of lights' shadows as JSON (vtkGnomonShadowPass::GetSettingsText()).
std::string textOfSettings();

} // namespace gnomon
