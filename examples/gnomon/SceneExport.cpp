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
  const bool isSpot = light.type == SceneLight::Type::Spot;
  if (light.type == SceneLight::Type::Directional)
  {
    json = { { "type", "directional" }, { "direction", light.target - light.position } };
  }
  else
  {
    json = { { "type",
               light.area ? "area"
                 : isSpot ? "spot"
                          : "point" },
      { "position", light.position } };
    if (isSpot || light.area)
    {
      json["target"] = light.target;
    }
    if (isSpot)
    {
      json["cone_angle"] = light.coneAngleDegrees;
    }
  }
  if (light.area)
  {
    const bool rectangle = light.area->rectangle;
    json.update(rectangle ? Json{ { "shape", "rectangle" }, { "width", light.area->width },
                              { "height", light.area->height } }
                          : Json{ { "shape", "disk" }, { "radius", light.area->radius } });
    if (rectangle || !texture.empty())
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

/// Write an image, if there is one, beside other files.
/// @return its name; empty without one
std::string writeImage(
  vtkImageData* image, const std::filesystem::path& folder, const std::string& name)
{
  if (!image)
  {
    return "";
  }
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  writeWholeFile((folder / (name + ".png")).string(),
    std::string(bytes->GetPointer(0), bytes->GetPointer(bytes->GetNumberOfValues())));
  return name + ".png";
}

/// Write a surface beside other files.
/// @return it as JSON
Json writeModel(
  const SceneModel& model, const std::filesystem::path& folder, const std::string& name)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(model.surface);
  writer->Write();
  writeWholeFile((folder / (name + ".vtp")).string(), writer->GetOutputString());
  Vec3 color;
  model.property->GetColor(color.data());
  Json json = { { "file", name + ".vtp" }, { "matrix", model.matrix }, { "color", color },
    { "casts", model.casts }, { "receives", model.receives }, { "one_sided", model.oneSided } };
  const std::string texture =
    writeImage(model.texture ? model.texture->GetInput() : nullptr, folder, name);
  if (!texture.empty())
  {
    json["texture"] = texture;
  }
  return json;
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
  Json json = { { "camera", toJson(scene.camera) }, { "models", Json::array() },
    { "lights", Json::array() } };
  for (const SceneModel& model : scene.models)
  {
    json["models"].push_back(
      writeModel(model, folder, scene.name + "-" + std::to_string(json["models"].size())));
  }
  for (const SceneLight& light : scene.lights)
  {
    json["lights"].push_back(toJson(light,
      writeImage(light.area ? light.area->texture : nullptr, folder,
        scene.name + "-light-" + std::to_string(json["lights"].size()))));
  }
  json["background"] = scene.background;
  json["sky"] = scene.sky;
  json["glass"] = scene.isGlass;

  writeWholeFile(path, json.dump(2) + "\n");
  return path;
}

} // namespace gnomon::tool
