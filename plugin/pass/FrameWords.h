#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkObject;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

class Complaints;
struct FrameReport;

///@{
/// Let a pass say what is news in a frame's report: lights whose settings do not fit, a lone
/// headlight, props that are left out, a route that was asked for and cannot be taken.
void tellOfLights(
  vtkObject* pass, vtkRenderer* renderer, Complaints& complaints, const FrameReport& report);
void tellWhatIsLeftOut(
  vtkObject* pass, vtkRenderer* renderer, Complaints& complaints, const FrameReport& report);
/// @param route that was asked for; empty if it is taken
void tellOfRoute(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const FrameReport& report, const std::string& route);
///@}

/// Let a pass say that another pass shades in a way that its shaders do not fit.
/// @param shader the class that shades
/// @param how at another resolution or the like; empty if all is well
void tellOfMisfit(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::string& shader, const std::string& how);

} // namespace gnomon
