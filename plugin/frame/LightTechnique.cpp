#include "plugin/frame/LightTechnique.h"

#include "lights/KernelShape.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"

#include <utility>

namespace gnomon
{

LightTechnique::LightTechnique(const EstimatorEntry& estimator)
  : estimator_(&estimator)
  , technique_(estimator.create())
{
}

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

void LightTechnique::updateMaps(
  const ShadowLight& light, const MapStage& stage, LightCounts& counts)
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
    counts.mapReason = against;
  }
  if (!this->usesMap_)
  {
    this->baked_.key.reset();
    this->technique().dropMaps();
    return;
  }
  const std::string changes = this->baked_.changesTo(wanted);
  stage.counts.values.push_back({ "maps of " + nameOf(light), changes.empty(), changes });
  if (!changes.empty())
  {
    this->bake(light, stage, std::move(wanted));
  }
  counts.castersLeftOut = this->baked_.castersLeftOut;
}

/// Lay out the light's views, and store the fitting.
LightViews LightTechnique::layOut(
  const ShadowLight& light, const MapStage& stage, const MapReach& reach)
{
  ViewFitting& fitting = this->fitting_ = ViewFitting();
  fitting.centreWorld = stage.occluders.frame.centre;
  fitting.castersCentred = stage.occluders.castersCentred;
  fitting.receiversCentred = stage.servesPointsAlone ? Bounds() : stage.occluders.allCentred;
  fitting.receiversCentred.add(stage.pointsCentred);
  fitting.holdsReceiversAlone = stage.servesPointsAlone;
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
  wanted.key->add("the casters", stage.occluders.versions());
  if (light.fittedToReceivers)
  {
    wanted.key->add("the receivers", stage.receiversNumber);
    wanted.key->add("the settings of their fit", std::pair(light.snap, light.splitLambda));
  }
  return wanted;
}

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
  ++stage.counts.mapBakes;
}

std::string LightTechnique::Bake::changesTo(const Bake& wanted) const
{
  return this->key ? wanted.key->changesFrom(*this->key) : "there were none";
}

} // namespace gnomon
