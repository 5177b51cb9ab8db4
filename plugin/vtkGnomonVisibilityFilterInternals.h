// Shared by the sources of vtkGnomonVisibilityFilter.
#pragma once

#include "vtkGnomonVisibilityFilter.h"

#include "plugin/data/AddedLights.h"
#include "plugin/data/DataScene.h"
#include "plugin/data/ReceiverStarts.h"
#include "plugin/data/SkyRun.h"
#include "plugin/data/VisibilityRun.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon
{

/// The inputs that determine the results. Objects count by their times of change, settings by their
/// values, since an abort also changes the filter's own time.
struct ExecutionKey
{
  std::vector<std::pair<const void*, vtkMTimeType>> objects;
  std::vector<double> settings;

  bool operator==(const ExecutionKey& other) const
  {
    return this->objects == other.objects && this->settings == other.settings;
  }
};

/// The arrays of an execution.
struct ExecutionArrays
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  VisibilityArrays pointers{};

  /// Add an array of one tuple for each element, all equal at first.
  /// @return its numbers
  template <typename Array>
  auto* add(const char* name, vtkIdType count, int components, double value)
  {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    array->Fill(value);
    this->arrays.push_back(array);
    return array->GetPointer(0);
  }
};

} // namespace gnomon

/// Each member refers to those above it.
struct vtkGnomonVisibilityFilter::Internals
{
  std::vector<gnomon::AddedLight> lights;
  gnomon::SkyModel skyModel = gnomon::SkyModel::Uniform;
  int skyDirections = 0; ///< 0: there is no sky
  vtkTimeStamp lightsTime;
  bool unfinished = false;
  vtkTimeStamp unfinishedTime;

  gnomon::ExecutionKey sceneKey;
  std::optional<gnomon::DataScene> scene;
  std::optional<gnomon::EmbreeTracer> tracer;

  gnomon::ExecutionKey runKey;
  gnomon::ExecutionArrays results;
  std::optional<gnomon::ReceiverStarts> starts;
  std::optional<gnomon::VisibilityRun> run; ///< of the lights, if there are any
  std::optional<gnomon::SkyRun> skyRun;     ///< of the sky, if there is one
  bool finished = false;
  std::uint64_t rays = 0;

  void dropRun()
  {
    this->run.reset();
    this->skyRun.reset();
    this->starts.reset();
  }
  /// Continue until all is done or goOn() returns false.
  /// @param goOn called with the completed share
  /// @return true if all is done
  bool go(const std::function<bool(double)>& goOn)
  {
    const double ofLights =
      static_cast<double>(this->lights.size()) * static_cast<double>(this->starts->samples());
    const double all = ofLights + this->skyDirections;
    const bool isDone =
      (!this->run || this->run->go([&](double share) { return goOn(share * ofLights / all); })) &&
      (!this->skyRun ||
        this->skyRun->go(
          [&](double share) { return goOn((ofLights + share * this->skyDirections) / all); }));
    this->rays = (this->run ? this->run->rays() : 0) + (this->skyRun ? this->skyRun->rays() : 0);
    return isDone;
  }
  void dropScene()
  {
    this->dropRun();
    this->results = {};
    this->finished = false;
    this->runKey = {};
    this->tracer.reset();
    this->scene.reset();
    this->sceneKey = {};
  }
};
