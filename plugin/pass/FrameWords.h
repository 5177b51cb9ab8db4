#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkObject;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

class Complaints;
enum class RouteWish;
struct FramePlan;

/// Let a pass say what is news in a frame's plan: lights whose settings do not fit, a lone
/// headlight, a route that was wished for and cannot be taken.
void tellOfPlan(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const FramePlan& plan, RouteWish wished);

/// Let a pass say which kinds of visible props are left out of the snapshot.
void tellWhatIsLeftOut(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::vector<std::string>& leftOut);

/// Let a pass say that another pass shades in a way that its shaders do not fit.
/// @param shader the class that shades
/// @param how at another resolution or the like; empty if all is well
void tellOfMisfit(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::string& shader, const std::string& how);

} // namespace gnomon
