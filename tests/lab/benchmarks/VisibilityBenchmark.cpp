// Measure the cost of shadow as data: vtkGnomonVisibilityFilter against a bare Embree loop over the
// same cells and suns. Scene: hills of 100,352 triangles; the argument is the number of suns.

#include "SyntheticScene.h"
#include "Timing.h"

#include "tests/unit/plugin/Shapes.h"

#include "plugin/vtkGnomonVisibilityFilter.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/constants.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::test
{
namespace
{

const Mesh& hills()
{
  static const Mesh mesh = makeTerrain(1000.0, 224, 60.0);
  return mesh;
}

/// Return suns from dawn to dusk, on several days.
std::vector<glm::dvec3> suns(std::size_t count)
{
  std::vector<glm::dvec3> directions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double hour = glm::pi<double>() * (static_cast<double>(i % 40) + 0.5) / 40.0;
    const std::size_t day = i / 40;
    const double tilt = 0.3 + 0.9 * static_cast<double>(day) * 40.0 / static_cast<double>(count);
    directions.emplace_back(
      std::cos(hour), -std::sin(hour) * std::cos(tilt), std::sin(hour) * std::sin(tilt));
  }
  return directions;
}

/// @param begin of the work
void reportRays(benchmark::State& state, double rays, const Time& begin)
{
  state.counters["rays/cpu-s"] = 1e3 * rays / (now().processor - begin.processor);
  state.counters["rays"] = rays / static_cast<double>(state.iterations());
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
}

void filter(benchmark::State& state)
{
  std::vector<std::vector<vtkIdType>> cells;
  for (const glm::uvec3& triangle : hills().triangles)
  {
    cells.push_back({ triangle.x, triangle.y, triangle.z });
  }
  vtkNew<vtkGnomonVisibilityFilter> visibility;
  visibility->SetInputData(meshOf(hills().points, cells));
  visibility->SetComputeBits(state.range(1) != 0);
  visibility->AddDirection(0.0, 0.0, 1.0);
  visibility->Update(); // the acceleration structure
  double rays = 0.0;
  const Time begin = now();
  for (auto _ : state)
  {
    visibility->ClearLights();
    for (const glm::dvec3& sun : suns(static_cast<std::size_t>(state.range(0))))
    {
      visibility->AddDirection(&sun.x);
    }
    visibility->Update();
    rays += static_cast<double>(visibility->GetNumberOfRays());
  }
  reportRays(state, rays, begin);
}
BENCHMARK(filter)
  ->Args({ 8, 0 })
  ->Args({ 1000, 0 })
  ->Args({ 1000, 1 })
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

/// Traces with Embree alone: packets of sixteen neighbours in their order, a bit counted for each
/// ray.
class BareLoop
{
public:
  BareLoop()
    : device_(rtcNewDevice(nullptr))
    , scene_(rtcNewScene(this->device_.get()))
  {
    rtcSetSceneFlags(this->scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const EmbreeGeometry geometry(rtcNewGeometry(this->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry.get(),
      RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), hills().points.size()));
    std::copy(hills().points.begin(), hills().points.end(), positions);
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry.get(),
      RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), hills().triangles.size()));
    std::copy(hills().triangles.begin(), hills().triangles.end(), triangles);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(this->scene_.get(), geometry.get());
    rtcCommitScene(this->scene_.get());
    for (const glm::uvec3& triangle : hills().triangles)
    {
      const glm::dvec3& a = hills().points[triangle.x];
      const glm::dvec3& b = hills().points[triangle.y];
      const glm::dvec3& c = hills().points[triangle.z];
      const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
      this->normals_.emplace_back(normal);
      this->origins_.emplace_back((a + b + c) / 3.0 + 1e-4 * normal);
    }
  }

  /// @return rays traced
  std::size_t trace(const std::vector<glm::dvec3>& towards)
  {
    std::atomic<std::size_t> all{ 0 };
    const std::size_t packets = this->origins_.size() / lanes;
    this->lit_.assign(this->origins_.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets, 8),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        std::size_t rays = 0;
        for (std::size_t packet = range.begin(); packet != range.end(); ++packet)
        {
          for (const glm::dvec3& sun : towards)
          {
            rays += this->tracePacket(packet * lanes, glm::vec3(sun));
          }
        }
        all += rays;
      });
    return all;
  }

private:
  static constexpr std::size_t lanes = 16;

  std::size_t tracePacket(std::size_t first, const glm::vec3& sun)
  {
    EmbreeContext context;
    RTCRay16 rays{};
    alignas(64) std::array<int, lanes> valid;
    std::size_t count = 0;
    for (std::size_t i = 0; i < lanes; ++i)
    {
      const glm::vec3& origin = this->origins_[first + i];
      const bool faces = glm::dot(this->normals_[first + i], sun) > 0.0f;
      rays.org_x[i] = origin.x;
      rays.org_y[i] = origin.y;
      rays.org_z[i] = origin.z;
      rays.dir_x[i] = sun.x;
      rays.dir_y[i] = sun.y;
      rays.dir_z[i] = sun.z;
      rays.tfar[i] = std::numeric_limits<float>::infinity() * (faces ? 1.0f : -1.0f);
      rays.mask[i] = 0xffffffffu;
      valid[i] = faces ? -1 : 0;
      count += faces ? 1 : 0;
    }
    occlude(valid.data(), this->scene_.get(), context, rays);
    for (std::size_t i = 0; i < lanes; ++i)
    {
      this->lit_[first + i] += rays.tfar[i] > 0.0f ? 1 : 0;
    }
    return count;
  }

  EmbreeDevice device_;
  EmbreeScene scene_;
  std::vector<glm::vec3> origins_;
  std::vector<glm::vec3> normals_;
  std::vector<std::uint32_t> lit_;
};

void bareLoop(benchmark::State& state)
{
  BareLoop loop;
  const std::vector<glm::dvec3> towards = suns(static_cast<std::size_t>(state.range(0)));
  double rays = 0.0;
  const Time begin = now();
  for (auto _ : state)
  {
    rays += static_cast<double>(loop.trace(towards));
  }
  reportRays(state, rays, begin);
}
BENCHMARK(bareLoop)->Arg(8)->Arg(1000)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace gnomon::test

BENCHMARK_MAIN();
