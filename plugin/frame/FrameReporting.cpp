#include "plugin/frame/FrameReporting.h"

#include "lights/SettingsTable.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

namespace gnomon
{
namespace
{

/// Return the value of a setting as text; empty if an estimator does not have it.
std::string valueOf(const char* setting, const LightPlan& plan)
{
  return has(plan.info(), setting) ? findSetting(setting)->get(plan.light) : "";
}

const char* nameOf(FitTarget target)
{
  switch (target)
  {
    case FitTarget::None:
      return "";
    case FitTarget::Casters:
      return "off";
    case FitTarget::Frustum:
      return "frustum";
    case FitTarget::Receivers:
      return "receivers";
  }
  return "";
}

LightReport reportOfCasting(const CastingLight& casting)
{
  const LightPlan& plan = casting.plan;
  const TechniqueInfo& info = plan.info();
  LightReport report;
  static_cast<LightCounts&>(report) = casting.counts;
  report.sceneIndex = plan.light.sceneIndex;
  report.casts = true;
  report.technique = plan.light.technique;
  report.estimator = plan.light.estimator;
  report.projection = valueOf("projection", plan);
  report.mapSizeTexels = info.bakesMap() ? plan.light.mapSizeTexels : 0;
  report.budgetReason = plan.budgetReason;
  report.fit = nameOf(plan.fit);
  report.fitReason = plan.fitReason;
  report.kernel = info.kernel.empty() ? valueOf("kernel", plan) : info.kernel;
  report.kernelTexels = info.has(kernelSettings()) ? plan.light.kernel.sizeTexels : 0;
  report.mapSamples = info.has(momentMapSettings()) ? plan.light.momentMap.samples : 0;
  return report;
}

LightReport reportOfSkipped(const SkippedLight& skipped)
{
  LightReport report;
  report.sceneIndex = skipped.sceneIndex;
  report.reason = skipped.reason;
  return report;
}

void reportLights(FrameReport& report, const Frame& frame)
{
  std::transform(
    frame.lights.begin(), frame.lights.end(), std::back_inserter(report.lights), reportOfCasting);
  std::transform(frame.plan.skipped.begin(), frame.plan.skipped.end(),
    std::back_inserter(report.lights), reportOfSkipped);
  std::sort(report.lights.begin(), report.lights.end(),
    [](const LightReport& a, const LightReport& b) { return a.sceneIndex < b.sceneIndex; });
}

void reportSnapshot(FrameReport& report, const OccluderCollector& collector)
{
  const Occluders& occluders = collector.occluders();
  report.notes.insert(report.notes.end(), collector.notes().begin(), collector.notes().end());
  report.leftOut = collector.leftOut();
  for (const Surface& surface : occluders.surfaces)
  {
    report.instances += surface.centredFromSource.size();
  }
  report.droppedNonFinite = occluders.droppedNonFinite;
  report.droppedZeroArea = occluders.droppedZeroArea;
}

void reportProcesses(FrameReport& report, const Ranks& ranks, const SharedReceivers& shared)
{
  report.processes = ranks.count();
  report.bytesShared = static_cast<std::int64_t>(ranks.bytesShared());
  if (shared.areShared())
  {
    report.ownReceivers = static_cast<std::int64_t>(shared.ownCount());
    report.depthTies = static_cast<std::int64_t>(shared.ties());
  }
}

} // namespace

FrameReport reportOf(
  const Frame& frame, const OccluderCollector& collector, const FrameTotals& totals)
{
  const FramePlan& plan = frame.plan;
  FrameReport report;
  static_cast<FrameCounts&>(report) = frame.counts;
  report.notes = plan.notes;
  report.misfits = plan.misfits;
  report.headlightIsAlone = plan.headlightIsAlone;
  report.choice = plan.choice;
  reportLights(report, frame);
  report.route = plan.hasShadows ? nameOf(plan.picture.route.route) : "none";
  report.routeReason = plan.hasShadows ? plan.picture.route.reason : "no light casts a shadow";
  if (plan.hasShadows)
  {
    reportSnapshot(report, collector);
    report.triangles = frame.scene.props.triangles;
  }
  report.notes.insert(report.notes.end(), frame.counts.notes.begin(), frame.counts.notes.end());
  reportProcesses(report, *frame.ranks, frame.view->receivers.shared);
  report.numbersByGeometryShaders = totals.numbersByGeometryShaders;
  report.bytesOccluders = totals.bytesOccluders;
  report.bytesBvh = totals.bytesBvh;
  report.bytesMaps = totals.bytesMaps;
  report.bytesImages = totals.bytesImages;
  report.wallMilliseconds = totals.wallMilliseconds;
  return report;
}

} // namespace gnomon
