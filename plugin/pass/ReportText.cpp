#include "plugin/pass/ReportText.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

namespace gnomon
{
namespace
{

using Json = nlohmann::ordered_json;

Json jsonOf(const std::vector<ClassCount>& classes)
{
  Json json = Json::object();
  for (const ClassCount& of : classes)
  {
    json[of.name] = of.pixels;
  }
  return json;
}

Json jsonOf(const LightReport& light)
{
  return { { "scene_index", light.sceneIndex }, { "casts", light.casts },
    { "reason", light.reason }, { "technique", light.technique }, { "estimator", light.estimator },
    { "projection", light.projection }, { "map_size_texels", light.mapSizeTexels },
    { "budget_reason", light.budgetReason }, { "fit", light.fit },
    { "fit_reason", light.fitReason }, { "map_reason", light.mapReason },
    { "casters_left_out", light.castersLeftOut }, { "kernel", light.kernel },
    { "kernel_size_texels", light.kernelTexels }, { "map_samples", light.mapSamples },
    { "traced_pixels", light.tracedPixels }, { "rays", light.rays },
    { "light_samples", light.lightSamples }, { "progress", light.progress },
    { "tiles_lit", light.tilesLit }, { "tiles_dark", light.tilesDark },
    { "tiles_traced", light.tilesTraced }, { "skip_reason", light.skipReason },
    { "planes", light.planes }, { "pixels_off_planes", light.pixelsOffPlanes },
    { "classes", jsonOf(light.classes) } };
}

Json jsonOf(const FrameReport& report)
{
  Json json;
  json["route"] = report.route;
  json["route_reason"] = report.routeReason;
  json["choice"] = report.choice;
  json["probes"] = report.probes;
  json["numbers_checked"] = report.numbersChecked;
  json["numbers_wrong"] = report.numbersWrong;
  json["numbers_by_geometry_shaders"] = report.numbersByGeometryShaders;
  json["processes"] = report.processes;
  json["own_receivers"] = report.ownReceivers;
  json["depth_ties"] = report.depthTies;
  json["bytes_shared"] = report.bytesShared;
  json["other_surfaces"] = report.otherSurfaces;
  json["lights"] = Json::array();
  for (const LightReport& light : report.lights)
  {
    json["lights"].push_back(jsonOf(light));
  }
  json["sky_progress"] = report.skyProgress;
  json["notes"] = report.notes;
  json["misfits"] = report.misfits;
  json["left_out"] = report.leftOut;
  json["stages"] = Json::array();
  for (const StageTime& stage : report.stages)
  {
    json["stages"].push_back({ { "name", stage.name }, { "milliseconds", stage.milliseconds } });
  }
  json["wall_milliseconds"] = report.wallMilliseconds;
  json["values"] = Json::array();
  for (const ValueReport& value : report.values)
  {
    json["values"].push_back(
      { { "name", value.name }, { "reused", value.reused }, { "changes", value.changes } });
  }
  json["map_bakes"] = report.mapBakes;
  json["program_compiles"] = report.programCompiles;
  json["new_programs"] = report.newPrograms;
  json["bvh_builds"] = report.bvhBuilds;
  json["bvh_refits"] = report.bvhRefits;
  json["surfaces_extracted"] = report.surfacesExtracted;
  json["surfaces_retransformed"] = report.surfacesRetransformed;
  json["triangles"] = report.triangles;
  json["instances"] = report.instances;
  json["dropped_non_finite"] = report.droppedNonFinite;
  json["dropped_zero_area"] = report.droppedZeroArea;
  json["bytes_occluders"] = report.bytesOccluders;
  json["bytes_bvh"] = report.bytesBvh;
  json["bytes_maps"] = report.bytesMaps;
  json["bytes_images"] = report.bytesImages;
  return json;
}

double numberOf(const Json& value)
{
  return value.is_boolean() ? static_cast<double>(value.get<bool>()) : value.get<double>();
}

} // namespace

std::string textOf(const FrameReport& report)
{
  // Names of props may contain any bytes.
  return jsonOf(report).dump(2, ' ', false, Json::error_handler_t::replace);
}

void fillTable(const FrameReport& report, vtkTable* lights)
{
  lights->Initialize();
  std::vector<Json> rows;
  std::transform(report.lights.begin(), report.lights.end(), std::back_inserter(rows),
    [](const LightReport& light) { return jsonOf(light); });
  const Json columns = jsonOf(LightReport());
  for (const auto& column : columns.items())
  {
    const bool isNumber = column.value().is_number() || column.value().is_boolean();
    vtkNew<vtkDoubleArray> numbers;
    vtkNew<vtkStringArray> texts;
    for (const Json& row : rows)
    {
      const Json& value = row[column.key()];
      isNumber
        ? numbers->InsertNextValue(numberOf(value))
        : texts->InsertNextValue(value.is_string() ? value.get<std::string>() : value.dump());
    }
    vtkAbstractArray* const array = isNumber ? static_cast<vtkAbstractArray*>(numbers) : texts;
    array->SetName(column.key().c_str());
    lights->AddColumn(array);
  }
}

} // namespace gnomon
