#include "plugin/plan/PicturePlan.h"

#include <algorithm>

namespace gnomon
{
namespace
{

/// Return the reason against the deferred route that the props give, as a clause; empty if none.
/// @param mixes true if pixels at edges are between light and shadow
std::string whyPropsNotDeferred(const DeferredFacts& facts, bool mixes)
{
  if (facts.physicallyBased && mixes)
  {
    return "physically based materials have a gamma, before which light and shadow mix at edges";
  }
  if (facts.ownShaders)
  {
    return "a prop may have shaders of its own, which need not light twice";
  }
  if (facts.partsOfBothKinds)
  {
    return "an assembly has parts that passes cannot reach";
  }
  return facts.whyUnsupported;
}

/// Return the kinds of points that receive and are in no layer; empty if there are none.
std::string pointsOf(const SceneProps& props)
{
  return std::string(props.translucent ? "translucent surfaces" : "") +
    (props.translucent && props.volumes ? " and " : "") + (props.volumes ? "volumes" : "");
}

/// Return why points in no layer show no shadows, as the end of a clause; empty if they do.
std::string whyNoPoints(
  std::size_t lights, Route route, const FrameWishes& wishes, const ScenePicture& picture)
{
  if (wishes.isShared)
  {
    return " show no shadows: their maps have the casters of one process";
  }
  if (route != Route::Inline && lights > mostInlineLights)
  {
    return " show no shadows of " + std::to_string(lights) + " lights; " +
      std::to_string(mostInlineLights) + " are the most";
  }
  return picture.drawsMaps ? "" : " show no shadows: their maps take OpenGL 4.3";
}

} // namespace

std::string whyNotDeferred(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene)
{
  if (wishes.isShared)
  {
    return "several processes draw the picture";
  }
  if (wishes.showsSky())
  {
    return "shading reads the view of the sky";
  }
  if (scene.props.transmits)
  {
    return "translucent casters let a part of the light through";
  }
  if (scene.props.catcher)
  {
    return "a shadow catcher is seen through";
  }
  if (lights.size() != 1)
  {
    return "the picture is drawn without one light's shadows, and " +
      std::to_string(lights.size()) + " lights cast";
  }
  const LightPlan& only = lights.front();
  if (!isHard(only.info(), only.light))
  {
    return "'" + only.light.technique + "' may leave pixels between light and shadow";
  }
  if (scene.picture.samples > 1)
  {
    return "pixels have several samples";
  }
  if (!scene.picture.drawnPlainly)
  {
    return "a render pass draws the props in its own way";
  }
  return scene.props.seenThrough
    ? "the receivers lack a prop that is seen through or has a framebuffer of its own"
    : "";
}

std::string whyNoInlineMaps(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene)
{
  if (wishes.route == RouteWish::Image || wishes.route == RouteWish::Deferred)
  {
    return "the route is asked for";
  }
  if (wishes.keepVisibility)
  {
    return "the visibility is kept";
  }
  if (wishes.showsSky())
  {
    return "rays find the view of the sky";
  }
  if (scene.props.sheets)
  {
    return "rays find how much light translucent casters let through";
  }
  if (scene.picture.severalViews)
  {
    return "several views are drawn and must look alike";
  }
  if (lights.size() > mostInlineLights)
  {
    return "shaders can read the maps of at most " + std::to_string(mostInlineLights) +
      " lights, not " + std::to_string(lights.size());
  }
  return std::any_of(lights.begin(), lights.end(),
           [](const LightPlan& light) { return !light.asked && !light.info().isPointwise(); })
    ? "another light's technique works on the whole screen"
    : "";
}

PicturePlan planPicture(
  const std::vector<LightPlan>& lights, const FrameWishes& wishes, const Scene& scene)
{
  const ScenePicture& picture = scene.picture;
  RouteNeeds needs;
  needs.keepVisibility = wishes.keepVisibility;
  needs.seesSky = wishes.showsSky();
  needs.lights = lights.size();
  for (const LightPlan& of : lights)
  {
    if (!of.info().isPointwise())
    {
      needs.screenTechnique = of.light.technique;
    }
    needs.headlightOnSamples |= of.light.isHeadlight && picture.samples > 1;
    if (of.info().isSlow && picture.samples <= 1)
    {
      needs.slowTechnique = of.light.technique;
    }
  }
  needs.whyNotDeferred = whyNotDeferred(lights, wishes, scene);
  if (needs.whyNotDeferred.empty())
  {
    const LightPlan& only = lights.front();
    const bool mixes = edgeSamplesOf(only.info(), only.light) > 1 ||
      (smoothsPictures(only.info(), only.light) && !picture.moves);
    needs.whyNotDeferred = whyPropsNotDeferred(*scene.deferred, mixes);
  }

  PicturePlan plan;
  plan.route = chooseRoute(wishes.route, needs);
  plan.isAsTold =
    (wishes.route != RouteWish::Inline || (needs.screenTechnique.empty() && !needs.seesSky)) &&
    (wishes.route != RouteWish::Deferred || needs.whyNotDeferred.empty());
  if (const std::string points = pointsOf(scene.props); !points.empty())
  {
    const std::string whyNot = whyNoPoints(lights.size(), plan.route.route, wishes, picture);
    const std::string map =
      points + " show a filtered shadow map ('" + std::string(pointTechnique) + "') of ";
    plan.shadesTranslucent = whyNot.empty() && scene.props.translucent;
    plan.shadesVolumes = whyNot.empty() && scene.props.volumes;
    if (!whyNot.empty())
    {
      plan.notes.push_back(points + whyNot);
    }
    else if (scene.props.sheets)
    {
      plan.notes.push_back(map + "opaque casters, and one of the crossings of translucent ones");
    }
    else if (!needs.screenTechnique.empty())
    {
      plan.notes.push_back(map + "lights with '" + needs.screenTechnique + "'");
    }
  }
  if (plan.route.route == Route::Image && picture.samples > 1)
  {
    plan.notes.push_back("The window has " + std::to_string(picture.samples) +
      " samples per pixel, and the image route one visibility, that of the surface at the pixel's "
      "centre: what covers other samples has that of the nearest surface at a centre around. The "
      "setting edge_samples smooths edges of shadows.");
  }
  return plan;
}

} // namespace gnomon
