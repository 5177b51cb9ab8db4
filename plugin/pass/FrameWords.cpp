#include "plugin/pass/FrameWords.h"

#include "lights/SettingsTable.h"
#include "plugin/pass/Complaints.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkCommand.h>

namespace gnomon
{

//------------------------------------------------------------------------------
void tellOfLights(
  vtkObject* pass, vtkRenderer* renderer, Complaints& complaints, const FrameReport& report)
{
  for (const std::string& misfit : complaints.news(renderer, Topic::Lights, report.misfits))
  {
    tell(pass, vtkCommand::ErrorEvent, misfit + ".");
  }
  const std::string warning = complaints.news(renderer, Topic::Headlight,
    report.headlightIsAlone
      ? "The only light is a headlight, which casts no shadow that could be seen. Add a "
        "light, as vtkGnomonLightPlacement::MakeKeyLight() makes it, or have the "
        "headlight cast by vtkGnomonLightKeys::SetCasts()."
      : "");
  tell(pass, vtkCommand::WarningEvent, warning);
}

//------------------------------------------------------------------------------
void tellWhatIsLeftOut(
  vtkObject* pass, vtkRenderer* renderer, Complaints& complaints, const FrameReport& report)
{
  const std::string kinds = listOf(complaints.news(renderer, Topic::LeftOut, report.leftOut));
  if (!kinds.empty())
  {
    tell(pass, vtkCommand::WarningEvent,
      "Visible and lit, but without shadows: " + kinds +
        ". See docs/guide/what_casts.md for what casts and receives.");
  }
}

//------------------------------------------------------------------------------
void tellOfRoute(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const FrameReport& report, const std::string& route)
{
  complaints.tellError(pass, renderer, Topic::Route,
    route.empty() ? ""
                  : "The " + route + " route was asked for, but " + report.routeReason +
        "; this frame takes the image route.");
}

//------------------------------------------------------------------------------
void tellOfMisfit(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::string& shader, const std::string& how)
{
  complaints.tellError(pass, renderer, Topic::Misfit,
    how.empty() ? ""
                : "Props were drawn without shadows: " + shader + " shades " + how +
        ". Let such a pass have this one as its delegate instead.");
}

} // namespace gnomon
