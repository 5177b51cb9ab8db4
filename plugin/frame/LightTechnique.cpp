#include "plugin/frame/LightTechnique.h"

#include "lights/KernelShape.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"

#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
LightTechnique::LightTechnique(const EstimatorEntry& estimator)
  : estimator_(&estimator)
  , technique_(estimator.create())
{
}

//------------------------------------------------------------------------------
void LightTechnique::chooseFit(
  ShadowLight& light, Route route, bool translucentReceivers, LightReport& report) const
{
  if (!this->info().bakesMap())
  {
    return;
  }
  const bool fitted = isFittedToCamera(this->technique().lightOfMap(light));
  report.fitReason = fitted ? this->reasonAgainstReceivers(light, route, translucentReceivers) : "";
  light.fittedToReceivers = fitted && report.fitReason.empty();
  report.fit = light.fittedToReceivers ? "receivers" : fitted ? "frustum" : "off";
}

//------------------------------------------------------------------------------
/// Return why a light's views cannot be fitted to the drawn receivers; empty if they can.
std::string LightTechnique::reasonAgainstReceivers(
  const ShadowLight& light, Route route, bool translucentReceivers) const
{
  if (route == Route::Inline)
  {
    return "the inline route does not draw the receivers first";
  }
  if (!this->info().isPointwise())
  {
    return "the technique works on the screen, so receivers are found after the maps";
  }
  if (light.fit == ViewFit::Off)
  {
    return "it needs the setting fit=frame";
  }
  if (light.projection == Projection::Splits && light.splitBlend > 0.0)
  {
    return "blended splits overlap, but each receiver counts for one split";
  }
  if (light.fit == ViewFit::Once)
  {
    return "a fit made once must also hold later views";
  }
  if (translucentReceivers)
  {
    return "translucent surfaces receive, but the receivers drawn first are opaque";
  }
  if (this->technique().mapReach(light).dependsOnViews())
  {
    return "the border of a kernel with a width in world units, or of penumbrae, depends on "
           "the fit";
  }
  return {};
}

//------------------------------------------------------------------------------
/// Return why an optional map is neither used nor baked later, as a clause; empty if it may be.
std::string LightTechnique::reasonAgainstMap(
  const ShadowLight& light, const MapStage& stage, bool isBaked) const
{
  if (stage.occluders.castsSolids())
  {
    return "it cannot hold casters that are spheres or cylinders";
  }
  if (isBaked || light.bake.time == BakeTime::Always)
  {
    return {};
  }
  return this->takesRays_ ? "" : "the light needs few shadow rays, or none, without a map";
}

//------------------------------------------------------------------------------
void LightTechnique::updateMaps(
  const ShadowLight& light, const MapStage& stage, LightReport& report)
{
  if (!this->info().bakesMap())
  {
    return;
  }
  Bake wanted = this->wantedIn(light, stage);
  const bool isBaked = this->baked_.changesTo(wanted).empty();
  const bool isOptional = this->info().mapIsOptional;
  std::string against = isOptional ? this->reasonAgainstMap(light, stage, isBaked) : "";
  if (isOptional && against.empty() && light.bake.time == BakeTime::Settled)
  {
    const bool rested = this->wanted_.changesTo(wanted).empty();
    this->usesMap_ = this->backoff_.usesMap(rested, isBaked, stage.bakesOptional);
    against = this->usesMap_ || stage.bakesOptional ? this->backoff_.reason()
                                                    : "a picture that moves waits for no map";
    this->wanted_ = wanted;
  }
  else
  {
    this->backoff_ = BakeBackoff();
    this->usesMap_ = against.empty();
  }
  if (isOptional)
  {
    report.mapReason = against;
  }
  if (!this->usesMap_)
  {
    this->baked_.key.reset();
    this->technique().dropMaps();
    return;
  }
  const std::string changes = this->baked_.changesTo(wanted);
  stage.report.values.push_back({ "maps of " + nameOf(light), changes.empty(), changes });
  if (!changes.empty())
  {
    this->bake(light, stage, std::move(wanted));
  }
  report.castersLeftOut = this->baked_.castersLeftOut;
}

//------------------------------------------------------------------------------
/// Lay out the light's views, and store the fitting.
LightViews LightTechnique::layOut(
  const ShadowLight& light, const MapStage& stage, const MapReach& reach)
{
  ViewFitting& fitting = this->fitting_ = ViewFitting();
  fitting.centreWorld = stage.occluders.frame.centre;
  fitting.castersCentred = stage.occluders.castersCentred;
  fitting.receiversCentred = stage.occluders.allCentred;
  fitting.texels = { light.mapSizeTexels, reach.borderTexels() };
  const ShadowLight seen = this->technique().lightOfMap(light);
  if (isFittedToCamera(seen))
  {
    const std::optional<CameraView>& first =
      this->baked_.camera ? this->baked_.camera : this->wanted_.camera;
    fitting.camera = seen.fit == ViewFit::Once && first ? first : stage.camera;
  }
  LightViews views = fitLightViews(seen, fitting);
  if (reach.dependsOnViews())
  {
    // Only a view determines this reach in texels. A wider border makes it smaller. The faces of a
    // cube hold all casters together, so none needs the reach of an area beside it.
    const double areaAcross = views.layout == ViewLayout::Cube
      ? 0.0
      : reachOfArea(reach.area, views, fitting.castersCentred, fitting.receiversCentred);
    fitting.texels.border =
      reach.borderTexels(mostTexelsAcross(views, light.mapSizeTexels), areaAcross);
    views = fitLightViews(seen, fitting);
  }
  return views;
}

//------------------------------------------------------------------------------
/// Return the inputs of the maps of this frame.
LightTechnique::Bake LightTechnique::wantedIn(const ShadowLight& light, const MapStage& stage)
{
  Bake wanted;
  const MapReach reach = this->technique().mapReach(light);
  wanted.views = this->layOut(light, stage, reach);
  wanted.camera = this->fitting_.camera;
  wanted.key.emplace();
  wanted.key->add("its views", wanted.views);
  wanted.key->add("their reach", reach);
  wanted.key->add("its settings", settingsOf(this->info(), SettingsOf::Map, light));
  wanted.key->add(
    "the casters", std::pair(stage.occluders.topologyVersion, stage.occluders.positionsVersion));
  if (light.fittedToReceivers)
  {
    wanted.key->add("the receivers", stage.receiversNumber);
    wanted.key->add("the settings of their fit", std::pair(light.snap, light.splitLambda));
  }
  return wanted;
}

//------------------------------------------------------------------------------
void LightTechnique::bake(const ShadowLight& light, const MapStage& stage, Bake wanted)
{
  this->baked_.key.reset(); // stays empty if memory runs out
  const bool onCpu = this->info().conservativeMap;
  if (!onCpu)
  {
    stage.buffers.update(stage.occluders);
  }
  if (light.fittedToReceivers)
  {
    this->receiverFit_.compute(light, wanted.views,
      { stage.receivers.fragments(), stage.receivers.points(), stage.receivers.width(),
        stage.receivers.height() },
      stage.centredFromView, stage.shaders);
  }
  const MapInput input{ light, wanted.views, stage.occluders, stage.buffers, stage.shaders,
    light.fittedToReceivers ? this->receiverFit_.fits() : TextureBinding() };
  namingLight(light, [&] { this->technique().bake(input); });
  wanted.castersLeftOut = onCpu ? 0 : stage.buffers.countUnseen(wanted.views.views);
  this->baked_ = std::move(wanted);
  ++stage.report.mapBakes;
}

//------------------------------------------------------------------------------
std::string LightTechnique::Bake::changesTo(const Bake& wanted) const
{
  return this->key ? wanted.key->changesFrom(*this->key) : "there were none";
}

} // namespace gnomon
