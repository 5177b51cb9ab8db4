#include "Report.h"

#include "CsvRow.h"

#include <nlohmann/json.hpp>

#include <string>

namespace gnomon::tool
{
namespace
{

const MotionTiming& timing(const VariantResult& variant, Motion motion)
{
  return variant.timings[static_cast<std::size_t>(motion)];
}

CsvRow csvHeading(const ComparisonResults& results)
{
  CsvRow row;
  for (const char* name : { "variant", "technique", "route", "map_size", "facing_pixels",
         "wrong_pixels", "wrong_share", "false_light_pixels", "false_shadow_pixels",
         "mean_absolute_error", "rms_error", "between_pixels", "between_share", "traced_pixels" })
  {
    row << std::string(name);
  }
  for (Motion motion : timedMotions(results))
  {
    const std::string key = motionKey(motion);
    row << key + "_ms";
    for (const std::string& stage : stageNames(results, { motion }))
    {
      row << key + "_" + stage + "_ms";
    }
    row << key + "_stage_share";
  }
  for (const char* name :
    { "occluder_bytes", "bvh_bytes", "map_bytes", "image_bytes", "resident_growth_bytes" })
  {
    row << std::string(name);
  }
  for (const std::string& name : classNames(results))
  {
    row << "class " + name + "_pixels";
  }
  return row;
}

CsvRow csvRow(const ComparisonResults& results, const VariantResult& variant)
{
  const VisibilityError& error = variant.error;
  CsvRow row;
  row << variant.name << variant.technique << variant.route;
  variant.mapSizeTexels > 0 ? row << std::int64_t(variant.mapSizeTexels) : row.empty();
  row << error.facingPixels << error.wrongPixels() << error.share(error.wrongPixels())
      << error.falseLight << error.falseShadow << error.meanAbsolute << error.rootMeanSquare
      << error.betweenPixels << error.share(error.betweenPixels) << variant.tracedPixels;
  for (Motion motion : timedMotions(results))
  {
    const MotionTiming& times = timing(variant, motion);
    row << times.milliseconds;
    for (const std::string& name : stageNames(results, { motion }))
    {
      const double* const milliseconds = findNamed(times.stages, name);
      milliseconds ? row << *milliseconds : row.empty();
    }
    times.stages.empty() ? row.empty() : row << times.stageShare;
  }
  row << variant.memory.occluders << variant.memory.bvh << variant.memory.maps
      << variant.memory.images << variant.memory.residentGrowth;
  for (const std::string& name : classNames(results))
  {
    const std::int64_t* const pixels = findNamed(variant.classes, name);
    pixels ? row << *pixels : row.empty();
  }
  return row;
}

nlohmann::ordered_json jsonOf(const ComparisonResults& results, const VariantResult& variant)
{
  const VisibilityError& error = variant.error;
  nlohmann::ordered_json json = {
    { "name", variant.name },
    { "technique", variant.technique },
    { "route", variant.route },
    { "map_size", variant.mapSizeTexels },
    { "error",
      {
        { "source", variant.errorSource },
        { "facing_pixels", error.facingPixels },
        { "wrong_pixels", error.wrongPixels() },
        { "wrong_share", error.share(error.wrongPixels()) },
        { "false_light_pixels", error.falseLight },
        { "false_shadow_pixels", error.falseShadow },
        { "mean_absolute_error", error.meanAbsolute },
        { "rms_error", error.rootMeanSquare },
        { "between_pixels", error.betweenPixels },
        { "between_share", error.share(error.betweenPixels) },
      } },
    { "traced_pixels", variant.tracedPixels },
  };
  for (Motion motion : timedMotions(results))
  {
    const MotionTiming& times = timing(variant, motion);
    nlohmann::ordered_json& target = json["times"][motionKey(motion)];
    target["frame_ms"] = times.milliseconds;
    if (!times.stages.empty())
    {
      for (const auto& [name, milliseconds] : times.stages)
      {
        target["stages_ms"][name] = milliseconds;
      }
      target["stage_share"] = times.stageShare;
    }
  }
  json["memory_bytes"] = {
    { "occluders", variant.memory.occluders },
    { "bvh", variant.memory.bvh },
    { "maps", variant.memory.maps },
    { "images", variant.memory.images },
    { "resident_growth", variant.memory.residentGrowth },
  };
  json["class_pixels"] = nlohmann::ordered_json::object();
  for (const auto& [name, pixels] : variant.classes)
  {
    json["class_pixels"][name] = pixels;
  }
  json["notes"] = variant.notes;
  json["picture"] = fileStem(variant.name) + ".png";
  json["error_picture"] = fileStem(variant.name) + "-errors.png";
  if (variant.classPicture.pixelCount() > 0)
  {
    json["class_picture"] = fileStem(variant.name) + "-classes.png";
  }
  return json;
}

} // namespace

//------------------------------------------------------------------------------
std::string toCsv(const ComparisonResults& results)
{
  std::string text = csvHeading(results).line();
  for (const VariantResult& variant : results.variants)
  {
    text += csvRow(results, variant).line();
  }
  return text;
}

//------------------------------------------------------------------------------
std::string toJson(const ComparisonResults& results)
{
  nlohmann::ordered_json json = {
    { "scene", results.scene },
    { "width", results.width },
    { "height", results.height },
    { "frames", results.frames },
    { "triangles", results.triangles },
    { "casting_lights", results.lights },
    { "truth", results.truth },
  };
  json["settings"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : results.settings)
  {
    json["settings"][name] = value;
  }
  json["notes"] = results.notes;
  json["variants"] = nlohmann::ordered_json::array();
  for (const VariantResult& variant : results.variants)
  {
    json["variants"].push_back(jsonOf(results, variant));
  }
  // File names given by users may contain invalid UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::tool
