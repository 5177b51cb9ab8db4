#include "SceneExport.h"

#include "Errors.h"
#include "Files.h"
#include "SceneJson.h"
#include "Vec3.h"
#include "lights/SettingsTable.h"

#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <variant>

namespace gnomon::tool
{

namespace
{

using Json = nlohmann::ordered_json;

/// Return a light as JSON.
/// @param texture file of its texture; empty without one
Json toJson(const SceneLight& light, const std::string& texture)
{
  Json json;
  if (light.type == SceneLight::Type::Spot)
  {
    json = { { "type", "spot" }, { "position", light.position }, { "target", light.target },
      { "cone_angle", light.coneAngleDegrees } };
  }
  else if (light.type == SceneLight::Type::Point)
  {
    json = { { "type", "point" }, { "position", light.position } };
  }
  else
  {
    json = { { "type", "directional" }, { "direction", light.target - light.position } };
  }
  if (light.area)
  {
    json["type"] = "area";
    json["target"] = light.target;
    json["shape"] = light.area->rectangle ? "rectangle" : "disk";
    if (light.area->rectangle)
    {
      json["width"] = light.area->width;
      json["height"] = light.area->height;
    }
    else
    {
      json["radius"] = light.area->radius;
    }
    if (light.area->rectangle || !texture.empty())
    {
      json["up"] = light.area->up;
    }
    if (!texture.empty())
    {
      json["texture"] = texture;
    }
  }
  if (light.box)
  {
    json["box"] = { { "position", light.position }, { "up", light.box->up },
      { "width", light.box->width }, { "height", light.box->height },
      { "depth", light.box->depth } };
  }
  json["color"] = light.color;
  json["intensity"] = light.intensity;
  for (const auto& [name, value] : light.settings)
  {
    const auto& values = findSetting(name)->values;
    const bool number =
      std::holds_alternative<IntegerSetting>(values) || std::holds_alternative<RealSetting>(values);
    json[name] = number ? Json::parse(value) : Json(value);
  }
  return json;
}

/// Return a surface as JSON.
/// @param texture file of its texture; empty without one
Json toJson(const SceneModel& model, const std::string& file, const std::string& texture)
{
  Vec3 color;
  model.property->GetColor(color.data());
  Json json = { { "file", file }, { "matrix", model.matrix }, { "color", color },
    { "casts", model.casts }, { "receives", model.receives }, { "one_sided", model.oneSided } };
  if (!texture.empty())
  {
    json["texture"] = texture;
  }
  return json;
}

void writeImage(vtkImageData* image, const std::string& path)
{
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  writeWholeFile(
    path, std::string(bytes->GetPointer(0), bytes->GetPointer(bytes->GetNumberOfValues())));
}

void writeSurface(vtkPolyData* surface, const std::string& path)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(surface);
  writer->Write();
  writeWholeFile(path, writer->GetOutputString());
}

} // namespace

//------------------------------------------------------------------------------
std::string exportScene(const Scene& scene, const std::string& folder)
{
  if (!scene.props.empty())
  {
    throw BadInput("--export: " + scene.name + " has props that no scene file describes, as \"" +
      scene.props.front().name + "\"");
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw BadInput("--export: " + folder + ": cannot be created: " + error.message());
  }
  const std::string path = (std::filesystem::path(folder) / (scene.name + ".json")).string();
  requireWritableFile(path, "--export", { ".json" });
  Json json;
  json["camera"] = toJson(scene.camera);
  json["models"] = Json::array();
  for (const SceneModel& model : scene.models)
  {
    const std::string name = scene.name + "-" + std::to_string(json["models"].size());
    const std::string file = name + ".vtp";
    writeSurface(model.surface, (std::filesystem::path(folder) / file).string());
    const std::string texture = model.texture ? name + ".png" : "";
    if (model.texture)
    {
      writeImage(model.texture->GetInput(), (std::filesystem::path(folder) / texture).string());
    }
    json["models"].push_back(toJson(model, file, texture));
  }
  json["lights"] = Json::array();
  for (const SceneLight& light : scene.lights)
  {
    const bool textured = light.area && light.area->texture;
    const std::string texture =
      textured ? scene.name + "-light-" + std::to_string(json["lights"].size()) + ".png" : "";
    if (textured)
    {
      writeImage(light.area->texture, (std::filesystem::path(folder) / texture).string());
    }
    json["lights"].push_back(toJson(light, texture));
  }
  json["background"] = scene.background;

  writeWholeFile(path, json.dump(2) + "\n");
  return path;
}

} // namespace gnomon::tool
