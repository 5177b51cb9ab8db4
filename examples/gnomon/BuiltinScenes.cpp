#include "BuiltinScenes.h"

#include "BuiltinSceneTable.h"
#include "SceneFile.h"
#include "SceneFraming.h"
#include "SceneParts.h"
#include "Vec3.h"
#include "lights/SettingsTable.h"

#include <vtkMath.h>

#include <cmath>
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

/// The numbers of a shape, whose points are moved.
struct Numbers : std::vector<double>
{
  Numbers(const nlohmann::json& shape, const Vec3& offset)
    : offset(offset)
  {
    for (std::size_t i = 1; i < shape.size() && shape[i].is_number(); ++i)
    {
      this->push_back(shape[i]);
    }
  }
  Vec3 vector(std::size_t i) const { return { (*this)[i], (*this)[i + 1], (*this)[i + 2] }; }
  Vec3 point(std::size_t i) const { return this->vector(i) + this->offset; }
  std::vector<Vec3> points() const
  {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < this->size(); i += 3)
    {
      all.push_back(this->point(i));
    }
    return all;
  }
  int integer(std::size_t i) const { return static_cast<int>((*this)[i]); }

  const Vec3 offset;
};
constexpr Vec3 unmoved{ -0.0, -0.0, -0.0 }; // added to -0.0, this keeps the sign

/// Add a bowl around an axis, open upwards. It is the part of a sphere below a fifth of the radius
/// above the sphere's centre. That centre lies one radius along the axis.
void addCup(MeshBuilder& mesh, const Vec3& foot, const Vec3& direction, double radius)
{
  const Vec3 right = normalized(cross(direction, { 0.0, 0.0, 1.0 }));
  const Vec3 back = cross(right, direction);
  mesh.addPatch(32, 12,
    [&](double u, double v)
    {
      // The pole is exactly one point.
      const double latitude = (1.0 - v) * -0.5 * vtkMath::Pi() + v * std::asin(0.2);
      const Vec3 turn = around(u);
      const Vec3 outward = turn[0] * right + turn[2] * back;
      const Vec3 normal = (v == 0.0 ? 0.0 : std::cos(latitude)) * outward +
        (v == 0.0 ? -1.0 : std::sin(latitude)) * direction;
      return SurfacePoint{ foot + radius * (direction + normal), normal };
    });
}

/// Add a torus around a vertical axis.
void addTorus(MeshBuilder& mesh, const Vec3& center, double ringRadius, double tubeRadius)
{
  mesh.addPatch(48, 32,
    [&](double u, double v)
    {
      const Vec3 outward = around(u);
      const Vec3 turn = around(v);
      const Vec3 normal = turn[0] * outward + Vec3{ 0.0, -turn[2], 0.0 };
      return SurfacePoint{ center + ringRadius * outward + tubeRadius * normal, normal };
    });
}

/// Add an upright letter C, open towards +x: three quarters of a ring with a square section around
/// the z axis.
void addLetter(MeshBuilder& mesh, const Vec3& center, double inner, double outer, double thickness)
{
  const double h = 0.5 * thickness;
  const auto direction = [](double share)
  {
    const double angle = (0.25 + 1.5 * share) * vtkMath::Pi();
    return Vec3{ std::cos(angle), std::sin(angle), 0.0 };
  };
  const auto place = [&](double share, double radius, double z) {
    return center + radius * direction(share) + Vec3{ 0.0, 0.0, z };
  };
  /// Add a side of the ring between two edges, each a radius and a z.
  const auto addSide = [&](const std::array<double, 2>& from, const std::array<double, 2>& to)
  {
    mesh.addPatch(48, 1,
      [&](double u, double v)
      {
        const Vec3 normal = from[0] == to[0] ? (to[1] > from[1] ? 1.0 : -1.0) * direction(u)
                                             : Vec3{ 0.0, 0.0, from[1] > 0.0 ? 1.0 : -1.0 };
        return SurfacePoint{
          place(u, from[0] + v * (to[0] - from[0]), from[1] + v * (to[1] - from[1])), normal
        };
      });
  };
  addSide({ outer, -h }, { outer, h });
  addSide({ inner, h }, { inner, -h });
  addSide({ outer, h }, { inner, h });
  addSide({ inner, -h }, { outer, -h });
  mesh.addPolygon(
    { place(0.0, inner, h), place(0.0, inner, -h), place(0.0, outer, -h), place(0.0, outer, h) });
  mesh.addPolygon(
    { place(1.0, inner, h), place(1.0, outer, h), place(1.0, outer, -h), place(1.0, inner, -h) });
}

const std::map<std::string, void (*)(MeshBuilder& mesh, const Numbers& n)> shapeKinds = {
  { "box",
    [](MeshBuilder& mesh, const Numbers& n)
    {
      for (std::size_t i = 0; i < n.size(); i += 6)
      {
        mesh.addBox(n.point(i), n.point(i + 3));
      }
    } },
  { "polygon", [](MeshBuilder& mesh, const Numbers& n) { mesh.addPolygon(n.points()); } },
  { "plane", [](MeshBuilder& mesh, const Numbers& n) { mesh.addPlane(n.point(0), n[3]); } },
  { "cone",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addCone(n.point(0), n[3], n[4], n[5], n.integer(6)); } },
  { "sphere",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addSphere(n.point(0), n[3], n.integer(4), n.integer(5)); } },
  { "lathe",
    [](MeshBuilder& mesh, const Numbers& n)
    {
      std::vector<ProfilePoint> profile;
      for (std::size_t i = 7; i < n.size(); i += 2)
      {
        profile.push_back({ n[i], n[i + 1] });
      }
      mesh.addLathe({ n.point(0), normalized(n.vector(3)) }, profile, n.integer(6));
    } },
  { "limb",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addLimb(n.point(0), n.point(3), n[6], n[7], n.integer(8)); } },
  { "cup",
    [](MeshBuilder& mesh, const Numbers& n) { addCup(mesh, n.point(0), n.vector(3), n[6]); } },
  { "torus", [](MeshBuilder& mesh, const Numbers& n) { addTorus(mesh, n.point(0), n[3], n[4]); } },
  { "letter",
    [](MeshBuilder& mesh, const Numbers& n) { addLetter(mesh, n.point(0), n[3], n[4], n[5]); } },
};

void addShapes(
  MeshBuilder& mesh, const nlohmann::json& shapes, std::size_t from, const Vec3& offset)
{
  for (std::size_t i = from; i < shapes.size(); ++i)
  {
    const Numbers n(shapes[i], offset);
    if (shapes[i][0] != "repeat")
    {
      shapeKinds.at(shapes[i][0])(mesh, n);
      continue;
    }
    for (double k = 0.0; k < n[0]; ++k)
    {
      addShapes(mesh, shapes[i], 5, k * n.vector(1) + offset);
    }
  }
}

/// Return a model made of shapes, each an array of its kind and numbers. Boxes and so on are as in
/// MeshBuilder, with points as three numbers:
///     ["box", low, high, more boxes...]  ["polygon", corners...]  ["plane", centre, side]
///     ["cone", base, height, bottom radius, top radius, segments]
///     ["sphere", centre, radius, slices, stacks]
///     ["lathe", origin, direction, segments, radius, height, more of the profile...]
///     ["limb", from, to, radius, taper, segments]
///     ["cup", foot, direction, radius]  ["torus", centre, radius of the ring, of the tube]
///     ["letter", centre, inner radius, outer radius, thickness]
///     ["repeat", count, step, shapes...]
/// or of a single shape of double coordinates and without normals:
///     ["triangles", corners...]  ["sheet", corner, right, forward]
/// Its name is the first shape's kind, its colour that of planes or casters.
/// @param shapes from BuiltinScenes.json, which is trusted
SceneModel makeShapes(const nlohmann::json& shapes)
{
  const std::string kind = shapes[0][0];
  const Numbers n(shapes[0], unmoved);
  if (kind == "triangles")
  {
    return makeTriangles(kind, n.points());
  }
  if (kind == "sheet")
  {
    const Vec3 a = n.point(0), b = a + n.vector(3), c = b + n.vector(6), d = a + n.vector(6);
    return makeTriangles(kind, { a, b, c, a, c, d });
  }
  MeshBuilder mesh;
  addShapes(mesh, shapes, 0, unmoved);
  return makeModel(kind, mesh.build(), kind == "plane" ? planeColor : casterColor);
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
  JsonMembers members(JsonValue(this->name, entry));
  if (const auto ambient = readSurroundings(members, {}, scene))
  {
    setAmbient(scene, *ambient);
  }
  if (entry.contains("panes"))
  {
    scene.lights.front().area->texture = makePanes();
  }
  return scene;
}

const std::vector<BuiltinScene>& builtinScenes()
{
  static const std::vector<BuiltinScene> scenes = listed("scenes");
  return scenes;
}

const std::vector<BuiltinScene>& hardScenes()
{
  static const std::vector<BuiltinScene> scenes = listed("hard");
  return scenes;
}

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
