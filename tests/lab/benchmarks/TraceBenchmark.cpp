// Measure the cost of the truth. Compare the trace stage with a bare Embree loop over the same
// rays. Also time the receivers' projection and the acceleration structures. Scene:
// bunny on a plane, directional light, 1024 x 1024.

#include "ObjFile.h"
#include "Timing.h"

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/exact/ConservativeMaps.h"
#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>

namespace gnomon::test
{
namespace
{

struct Subject
{
  Subject()
    : occluders(makeOccluders(
        { { readObj("/usr/share/glmark2/models/bunny.obj"),
            glm::rotate(at({ 0.0, 0.0, 0.99 }), 0.5 * glm::pi<double>(), { 1.0, 0.0, 0.0 }) },
          { makePlane(10.0) } }))
    , light(directionalLight({ -1.0, 0.5, -1.2 }))
  {
    Camera camera;
    camera.position = { 2.0, -4.0, 3.0 };
    camera.target = { 0.0, 0.0, 0.8 };
    camera.width = camera.height = 1024;
    this->view = makeView(this->occluders, camera);
    Receivers(this->view.images, this->view.drawnSurfaces, this->occluders, this->receivers).all();
  }

  Occluders occluders;
  ShadowLight light;
  View view;
  ReceiverPixels receivers;
};

const Subject& subject()
{
  static const Subject instance;
  return instance;
}

/// Embree alone: the stage's rays, already in packets of 4 x 4 pixels without gaps, against one
/// static scene.
template <typename Packet>
class BareLoop
{
public:
  explicit BareLoop(const Subject& subject)
    : device_(rtcNewDevice(nullptr), rtcReleaseDevice)
    , scene_(rtcNewScene(this->device_.get()), rtcReleaseScene)
  {
    rtcSetSceneFlags(this->scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const Occluders& occluders = subject.occluders;
    RTCGeometry geometry = rtcNewGeometry(this->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      occluders.triangles.data(), 0, sizeof(glm::uvec3), occluders.triangles.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
      occluders.positionsCentred.data(), 0, sizeof(glm::vec3), occluders.positionsCentred.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(this->scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(this->scene_.get());

    const ReceiverPixels& receivers = subject.receivers;
    const ShadowRayLight light(subject.light, occluders.frame.centre);
    std::size_t count = 0;
    for (std::size_t k = 0; k < receivers.size(); ++k)
    {
      const auto width = static_cast<std::size_t>(receivers.width);
      const std::size_t square = k / 16;
      const std::size_t x = square % (width / 4) * 4 + k % 4;
      const std::size_t y = square / (width / 4) * 4 + k / 4 % 4;
      const std::size_t i = y * width + x;
      const ShadowRay ray = shadowRayDirectional(light,
        { receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i] },
        { receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i] }, receivers.offset[i]);
      if (receivers.surface[i] == ReceiverPixels::notCovered || !ray.traced)
      {
        continue;
      }
      const std::size_t lane = count++ % lanes;
      if (lane == 0)
      {
        this->packets_.push_back({});
        std::fill_n(this->packets_.back().tfar, lanes, -std::numeric_limits<float>::infinity());
      }
      Packet& packet = this->packets_.back();
      packet.org_x[lane] = ray.origin.x;
      packet.org_y[lane] = ray.origin.y;
      packet.org_z[lane] = ray.origin.z;
      packet.dir_x[lane] = ray.direction.x;
      packet.dir_y[lane] = ray.direction.y;
      packet.dir_z[lane] = ray.direction.z;
      packet.tnear[lane] = shadowRayNear;
      packet.tfar[lane] = shadowRayFarDirectional;
      packet.mask[lane] = 0xffffffffu;
    }
  }

  /// Restore the rays that run() changed.
  void reset() { this->running_ = this->packets_; }
  void run()
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, this->running_.size(), 64),
      [this](const tbb::blocked_range<std::size_t>& range)
      {
        EmbreeContext context(EmbreeRays::Coherent);
        alignas(64) std::array<int, lanes> valid;
        valid.fill(-1);
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          occlude(valid.data(), this->scene_.get(), context, this->running_[i]);
        }
      });
  }

private:
  static constexpr std::size_t lanes = std::extent_v<decltype(Packet::tfar)>;

  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
  std::vector<Packet> packets_;
  std::vector<Packet> running_;
};

template <typename Function>
double milliseconds(const Function& function)
{
  const auto begin = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

/// The stage and the bare loops take turns, so other load on the machine affects all alike.
void traceStageAgainstBareLoop(benchmark::State& state)
{
  const Subject& scene = subject();
  EmbreeTracer tracer;
  tracer.update(scene.occluders);
  BareLoop<RTCRay16> bare16(scene);
  BareLoop<RTCRay8> bare8(scene);
  std::vector<float> visibility;
  std::vector<double> stage;
  std::vector<double> loop16;
  std::vector<double> loop8;
  for (auto _ : state)
  {
    bare16.reset();
    bare8.reset();
    loop16.push_back(milliseconds([&] { bare16.run(); }));
    stage.push_back(milliseconds(
      [&] { tracer.trace(scene.light, scene.occluders, scene.receivers, visibility); }));
    loop8.push_back(milliseconds([&] { bare8.run(); }));
    state.SetIterationTime(stage.back() * 1e-3);
  }
  state.counters["stage_ms"] = median(stage);
  state.counters["bare16_ms"] = median(loop16);
  state.counters["bare8_ms"] = median(loop8);
  state.counters["stage/bare16"] = median(stage) / median(loop16);
}
BENCHMARK(traceStageAgainstBareLoop)
  ->UseManualTime()
  ->Unit(benchmark::kMillisecond)
  ->Iterations(101);

void projectReceiversOfAFrame(benchmark::State& state)
{
  const Subject& scene = subject();
  ReceiverPixels receivers;
  for (auto _ : state)
  {
    Receivers(scene.view.images, scene.view.drawnSurfaces, scene.occluders, receivers).all();
  }
}
BENCHMARK(projectReceiversOfAFrame)->UseRealTime()->Unit(benchmark::kMillisecond);

void visitTilesOfAFrame(benchmark::State& state)
{
  const Subject& scene = subject();
  ReceiverPixels stored;
  for (auto _ : state)
  {
    const Receivers receivers(scene.view.images, scene.view.drawnSurfaces, scene.occluders, stored);
    receivers.visitTiles(
      [](const ReceiverTile& tile) { benchmark::DoNotOptimize(tile.receivers.positionX.data()); });
  }
}
BENCHMARK(visitTilesOfAFrame)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Time the way from the receivers' readback to visibility, by rays alone and with a map that
/// decides what it can. Both take turns.
void hybridAgainstTracing(benchmark::State& state)
{
  const Subject& scene = subject();
  EmbreeTracer tracer;
  tracer.update(scene.occluders);
  ConservativeMaps maps;
  ShadowLight light = scene.light;
  ViewFitting fitting;
  fitting.castersCentred = scene.occluders.castersCentred;
  fitting.receiversCentred = scene.occluders.allCentred;
  fitting.texels.side = light.mapSizeTexels;
  maps.bake(
    light, fitLightViews(light, fitting), scene.occluders, certainRule(Covering::Silhouette));
  ReceiverPixels stored;
  Receivers receivers(scene.view.images, scene.view.drawnSurfaces, scene.occluders, stored);
  std::vector<float> visibility;
  std::vector<double> traced;
  std::vector<double> hybrid;
  for (auto _ : state)
  {
    traced.push_back(
      milliseconds([&] { tracer.trace(light, scene.occluders, receivers, visibility); }));
    hybrid.push_back(
      milliseconds([&] { tracer.trace(light, scene.occluders, receivers, visibility, &maps); }));
    state.SetIterationTime(hybrid.back() * 1e-3);
  }
  state.counters["traced_ms"] = median(traced);
  state.counters["hybrid_ms"] = median(hybrid);
  state.counters["hybrid/traced"] = median(hybrid) / median(traced);
}
BENCHMARK(hybridAgainstTracing)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(101);

void buildStructure(benchmark::State& state)
{
  for (auto _ : state)
  {
    EmbreeTracer tracer;
    tracer.update(subject().occluders);
  }
}
BENCHMARK(buildStructure)->UseRealTime()->Unit(benchmark::kMillisecond);

void refitMovedSurface(benchmark::State& state)
{
  Occluders occluders = subject().occluders;
  EmbreeTracer tracer;
  tracer.update(occluders);
  for (auto _ : state)
  {
    state.PauseTiming();
    moveSurface(occluders, static_cast<std::size_t>(state.range(0)), { 1e-4, 0.0, 0.0 });
    state.ResumeTiming();
    tracer.update(occluders);
  }
}
// The bunny (0), the plane (1).
BENCHMARK(refitMovedSurface)->Arg(0)->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace gnomon::test

BENCHMARK_MAIN();
