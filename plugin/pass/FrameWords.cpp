#include "plugin/pass/FrameWords.h"

#include "lights/SettingsTable.h"
#include "plugin/pass/Complaints.h"
#include "plugin/plan/FramePlan.h"

#include <vtkCommand.h>

namespace gnomon
{

void tellOfPlan(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const FramePlan& plan, RouteWish wished)
{
  for (const std::string& misfit : complaints.news(renderer, Topic::Lights, plan.misfits))
  {
    tell(pass, vtkCommand::ErrorEvent, misfit + ".");
  }
  const std::string warning = complaints.news(renderer, Topic::Headlight,
    plan.headlightIsAlone
      ? "The only light is a headlight, which casts no shadow that could be seen. Add a "
        "light, as vtkGnomonLightPlacement::MakeKeyLight() makes it, or have the "
        "headlight cast by vtkGnomonLightKeys::SetCasts()."
      : "");
  tell(pass, vtkCommand::WarningEvent, warning);
  complaints.tellError(pass, renderer, Topic::Route,
    plan.picture.isAsTold ? ""
                          : std::string("The ") +
        (wished == RouteWish::Inline ? "inline" : "deferred") + " route was asked for, but " +
        plan.picture.route.reason + "; this frame takes the image route.");
}

void tellWhatIsLeftOut(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::vector<std::string>& leftOut)
{
  const std::string kinds = listOf(complaints.news(renderer, Topic::LeftOut, leftOut));
  if (!kinds.empty())
  {
    tell(pass, vtkCommand::WarningEvent,
      "Visible and lit, but without shadows: " + kinds +
        ". See docs/guide/what_casts.md for what casts and receives.");
  }
}

void tellOfMisfit(vtkObject* pass, vtkRenderer* renderer, Complaints& complaints,
  const std::string& shader, const std::string& how)
{
  complaints.tellError(pass, renderer, Topic::Misfit,
    how.empty() ? ""
                : "Props were drawn without shadows: " + shader + " shades " + how +
        ". Let such a pass have this one as its delegate instead.");
}

} // namespace gnomon
