// Measure the refit of acceleration structures after a surface of the bunny's scene has moved.

#include "Scene.h"
#include "SyntheticScene.h"

#include "plugin/scene/OccluderCollector.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <benchmark/benchmark.h>

namespace gnomon::test
{
namespace
{

void refitMovedSurface(benchmark::State& state)
{
  OccluderCollector collector;
  collector.collect(tool::makeRenderer(tool::loadScene("bunny"), 1.0));
  Occluders occluders = collector.occluders();
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
