#include "BuiltinScenes.h"

#include "BuiltinSceneTable.h"
#include "SceneFile.h"
#include "SceneFraming.h"
#include "SceneParts.h"
#include "SceneShapes.h"
#include "lights/SettingsTable.h"

#include <map>
#include <stdexcept>

namespace gnomon::tool
{

namespace
{

using Node = nlohmann::json;

const std::map<std::string, void (*)(Scene& scene)> parts = {
  { "arcades", addArcades },
  { "books", addBooks },
  { "building lamps", addBuildingLamps },
  { "city", addCity },
  { "cloth", addCloth },
  { "desk things", addDeskThings },
  { "flowers", addFlowers },
  { "grass", addGrass },
  { "impostors", addImpostors },
  { "molecule", addMolecule },
  { "plants", addPlants },
  { "props", addProps },
  { "rooms", addRooms },
  { "screens", addScreens },
  { "slivers", addSlivers },
  { "terrain", addTerrain },
  { "thin posts", addThinPosts },
  { "trees", addTrees },
};

/// Return the document. Its scenes have a scene file's keys, and for short "sun", a direction;
/// "view", a camera's position, target and field of view; "lamp", see lampOf(); "like", a scene
/// whose keys they share; "file" and "color", see addModelOnPlane(). It also has "models" that
/// several scenes share by name.
const Node& document()
{
  static const Node parsed = Node::parse(BuiltinSceneTable);
  return parsed;
}

/// Return a scene's entry, with what it takes from the scene that it is "like".
Node entryOf(const std::string& name)
{
  for (const char* list : { "scenes", "hard", "bases" })
  {
    for (const Node& entry : document()[list])
    {
      if (entry["name"] == name)
      {
        const std::string base =
          entry.value("like", list == std::string("hard") ? "over-floor" : "");
        Node whole = base.empty() ? Node::object() : entryOf(base);
        if (entry.contains("lights"))
        {
          whole.erase("sun");
        }
        whole.update(entry);
        return whole;
      }
    }
  }
  throw std::out_of_range(name);
}

/// Place a model by [size, x, y, z].
void scale(SceneModel& model, const std::array<double, 4>& by)
{
  model.matrix = { by[0], 0, 0, by[1], 0, by[0], 0, by[2], 0, 0, by[0], by[3], 0, 0, 0, 1 };
}

/// Return a model: a shape, [name, colour or null, shapes...], or {"model", with more}.
SceneModel makeModel(const Node& model)
{
  if (model.is_object())
  {
    SceneModel made = makeModel(model["model"]);
    made.oneSided = model.value("one_sided", false);
    made.matrix = model.value("matrix", made.matrix);
    if (model.contains("scale"))
    {
      scale(made, model["scale"]);
    }
    return made;
  }
  if (model[1].is_number())
  {
    return makeShapes(Node::array({ model }));
  }
  SceneModel made = makeShapes(Node(model.begin() + 2, model.end()));
  made.name = model[0];
  if (!model[1].is_null())
  {
    made.property->SetColor(Vec3(model[1]).data());
  }
  return made;
}

/// Add a model, or one that several scenes share, or parts, by name.
void addModel(Scene& scene, const Node& model)
{
  if (!model.is_string())
  {
    scene.models.push_back(makeModel(model));
  }
  else if (const auto part = parts.find(model.get<std::string>()); part != parts.end())
  {
    part->second(scene);
  }
  else
  {
    addModel(scene, document()["models"].at(model.get<std::string>()));
  }
}

/// Return a square lamp of [distance, side, intensity] in the sun's direction, at that distance
/// from the camera's target. Its side is a tenth of that distance. It lights the camera's view.
SceneLight lampOf(const Node& entry, const Vec3& target)
{
  const std::vector<double> lamp = entry["lamp"];
  SceneLight light;
  light.type = SceneLight::Type::Spot;
  light.coneAngleDegrees = 55.0;
  light.target = target;
  light.position = target - lamp[0] * normalized(-makeSun(entry["sun"]).position);
  light.area = SceneLight::Area{};
  light.area->rectangle = true;
  light.area->width = light.area->height = lamp.size() > 1 ? lamp[1] : 0.1 * lamp[0];
  light.area->up = { 0.0, 0.0, -1.0 };
  light.intensity = lamp.size() > 2 ? lamp[2] : 1.0;
  return light;
}

std::vector<BuiltinScene> listed(const char* list)
{
  std::vector<BuiltinScene> scenes;
  for (const Node& entry : document()[list])
  {
    scenes.push_back(
      { entry["name"], entry["summary"], entry.value("cases", std::vector<std::string>()) });
  }
  return scenes;
}

} // namespace

//------------------------------------------------------------------------------
Scene BuiltinScene::make() const
{
  const Node entry = entryOf(this->name);
  Scene scene;
  scene.name = this->name;
  if (entry.contains("file"))
  {
    addModelOnPlane(scene, entry["file"], entry["color"]);
  }
  for (const Node& model : entry.value("models", Node::array()))
  {
    addModel(scene, model);
  }
  if (entry.contains("scale"))
  {
    for (SceneModel& model : scene.models)
    {
      scale(model, entry["scale"]);
    }
  }
  if (entry.contains("view"))
  {
    const std::array<double, 7> view = entry["view"];
    scene.camera =
      makeCamera({ view[0], view[1], view[2] }, { view[3], view[4], view[5] }, view[6]);
  }
  if (entry.contains("sun"))
  {
    scene.lights = { makeSun(entry["sun"]) };
  }
  if (entry.contains("lamp"))
  {
    scene.lights = { lampOf(entry, scene.camera.target) };
  }
  if (const auto ambient = readSurroundings(JsonValue(this->name, entry), {}, scene))
  {
    setAmbient(scene, *ambient);
  }
  if (entry.contains("panes"))
  {
    scene.lights.front().area->texture = makePanes();
  }
  return scene;
}

//------------------------------------------------------------------------------
const std::vector<BuiltinScene>& builtinScenes()
{
  static const std::vector<BuiltinScene> scenes = listed("scenes");
  return scenes;
}

//------------------------------------------------------------------------------
const std::vector<BuiltinScene>& hardScenes()
{
  static const std::vector<BuiltinScene> scenes = listed("hard");
  return scenes;
}

//------------------------------------------------------------------------------
const BuiltinScene* findBuiltinScene(const std::string& name)
{
  for (const auto* scenes : { &hardScenes(), &builtinScenes() })
  {
    for (const BuiltinScene& scene : *scenes)
    {
      if (scene.name == name)
      {
        return &scene;
      }
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
std::string builtinSceneNames()
{
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtinScenes())
  {
    names.push_back(scene.name);
  }
  return listOf(names);
}

} // namespace gnomon::tool
