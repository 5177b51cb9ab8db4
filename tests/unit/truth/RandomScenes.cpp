#include "RandomScenes.h"

#include "lights/LightSpace.h"
#include "lights/SettingsTable.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

namespace gnomon::test
{

Mesh makeCup(int rings, int segments)
{
  Mesh mesh = makeSphere(rings, segments);
  std::vector<glm::uvec3> kept;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    if (mesh.points[triangle.x].z < 0.3 && mesh.points[triangle.y].z < 0.3 &&
      mesh.points[triangle.z].z < 0.3)
    {
      kept.push_back(triangle);
    }
  }
  mesh.triangles = kept;
  return mesh;
}

namespace
{

glm::dmat4 placed(Random& random, double spread, double scale)
{
  const glm::dvec3 position(
    uniform(random, -spread, spread), uniform(random, -spread, spread), uniform(random, 0.2, 1.6));
  return glm::rotate(at(position, scale), uniform(random, 0.0, 6.28), unitVector(random));
}

/// A fan of triangles around one corner, some of them nearly without area.
Mesh makeNeedles(Random& random, int count)
{
  Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 from(
      uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -0.5, 0.5));
    const glm::dvec3 along = unitVector(random);
    const double width = std::pow(10.0, uniform(random, -7.0, -1.0));
    addTriangle(mesh, from, from + along, from + 0.5 * along + width * unitVector(random));
  }
  return mesh;
}

/// A sheet folded to and fro, with every fold nearly closed.
Mesh makeFolds(int folds)
{
  Mesh mesh;
  for (int i = 0; i <= folds; ++i)
  {
    const double x = 0.05 * i;
    const double z = (i % 2) ? 0.8 : 0.0;
    mesh.points.emplace_back(x, -0.7, z);
    mesh.points.emplace_back(x, 0.7, z);
    if (i > 0)
    {
      const auto last = static_cast<unsigned int>(2 * i);
      mesh.triangles.emplace_back(last - 2, last, last + 1);
      mesh.triangles.emplace_back(last - 2, last + 1, last - 1);
    }
  }
  return mesh;
}

/// A square whose halves are cut differently, so vertices lie on edges.
Mesh makeTJunctions()
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 0.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 }, { -1.0, 1.0, 0.0 },
    { 0.0, 0.25, 0.0 }, { 1.0, -1.0, 0.0 }, { 1.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 5, 4 }, { 4, 5, 6 }, { 4, 6, 2 } };
  return mesh;
}

/// Triangles that exist twice, once turned over.
Mesh makeDuplicates(Random& random, int count)
{
  Mesh mesh = makeTriangleSoup(count, random());
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += 2)
  {
    const glm::uvec3 triangle = mesh.triangles[i];
    mesh.triangles.push_back((i % 4) ? triangle : glm::uvec3(triangle.y, triangle.x, triangle.z));
  }
  return mesh;
}

/// Distribute the triangles of a mesh over several meshes; every other mesh is turned over.
std::vector<Mesh> dealtOut(const Mesh& mesh, std::size_t count, Random& random)
{
  std::vector<Mesh> dealt(count);
  for (Mesh& some : dealt)
  {
    some.points = mesh.points;
  }
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    const std::size_t to = random() % count;
    dealt[to].triangles.push_back(
      to % 2 ? glm::uvec3(triangle.y, triangle.x, triangle.z) : triangle);
  }
  return dealt;
}

} // namespace

const std::vector<const char*>& randomSceneNames()
{
  static const std::vector<const char*> names = { "one triangle", "spheres", "soup", "needles",
    "cups", "folds", "junctions", "duplicates", "touching boxes", "crossing boxes", "terrain",
    "perforated", "one-sided", "sheets", "lamp", "patchwork" };
  return names;
}

std::string lettersOf(std::string name)
{
  const auto isSeparator = [](unsigned char letter) { return !std::isalpha(letter); };
  name.erase(std::remove_if(name.begin(), name.end(), isSeparator), name.end());
  return name;
}

std::vector<Prop> makeRandomScene(const std::string& name, Random& random)
{
  // Each scene has four such bodies, of this scale.
  using Make = Mesh (*)(Random & random, int number);
  static const std::map<std::string, std::pair<Make, double>> scattered = {
    { "spheres",
      { [](Random&, int i) { return makeSphere(6 + 5 * i, 12 + 10 * i, 0.2 * i); }, 0.3 } },
    { "soup", { [](Random& of, int) { return makeTriangleSoup(60, of()); }, 1.0 } },
    { "needles", { [](Random& of, int) { return makeNeedles(of, 40); }, 0.8 } },
    { "cups", { [](Random&, int) { return makeCup(12, 16); }, 0.4 } },
    { "folds", { [](Random&, int i) { return makeFolds(8 + i); }, 0.9 } },
    { "junctions", { [](Random&, int) { return makeTJunctions(); }, 0.6 } },
    { "duplicates", { [](Random& of, int) { return makeDuplicates(of, 30); }, 1.0 } },
    { "one-sided", { [](Random&, int) { return makeSphere(8, 12); }, 0.4 } },
  };
  std::vector<Prop> props{ { makePlane(6.0, 1 + static_cast<int>(random() % 4)) } };
  if (name == "one triangle")
  {
    props.clear();
    Mesh mesh;
    mesh.points = { unitVector(random), unitVector(random), unitVector(random) };
    mesh.triangles = { { 0, 1, 2 } };
    props.push_back({ mesh });
  }
  for (int i = 0; i < 4; ++i)
  {
    if (const auto bodies = scattered.find(name); bodies != scattered.end())
    {
      const auto& [make, scale] = bodies->second;
      Mesh mesh = make(random, i);
      props.push_back({ std::move(mesh), placed(random, 1.2, scale) });
      props.back().oneSided = name == "one-sided";
    }
    else if (name == "perforated")
    {
      props.push_back(makePerforatedPlane(1.2, 1 + i, placed(random, 0.8, 1.0)));
    }
    else if (name == "sheets")
    {
      // Close to each other; the last one coincides with the one before.
      const double height = i == 3 ? 0.52 : 0.5 + 0.01 * i;
      props.push_back({ makePlane(1.5, 1 + i), at({ 0.1 * i, 0.0, height }) });
    }
  }
  if (name == "one-sided")
  {
    // The plane is seen from its back, where it casts nothing.
    props.front().worldFromMesh =
      glm::rotate(glm::dmat4(1.0), 3.141592653589793, { 1.0, 0.0, 0.0 });
    props.front().oneSided = true;
  }
  else if (name == "touching boxes")
  {
    props.push_back({ makeBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 }) });
    props.push_back({ makeBox({ 0.5, -0.2, 0.0 }, { 1.0, 0.7, 0.6 }) });
    props.push_back({ makeBox({ -0.2, -0.2, 1.0 }, { 0.3, 0.3, 1.2 }) });
  }
  else if (name == "crossing boxes")
  {
    for (int i = 0; i < 4; ++i)
    {
      props.push_back({ makeBox(glm::dvec3(-0.4), glm::dvec3(0.4)), placed(random, 0.4, 1.0) });
    }
  }
  else if (name == "lamp")
  {
    // The shade around a light is small against the scene, and rounding is proportional to the
    // scene.
    props.push_back(
      { makeCup(8, 24), glm::rotate(at({ 0.1, -0.2, 1.0 }, 0.15), 3.0, { 1.0, 0.2, 0.0 }) });
    props.push_back({ makeBox(glm::dvec3(20.0), glm::dvec3(25.0)) });
  }
  else if (name == "patchwork")
  {
    // Surfaces that continue others: smooth ones, sharp ones, and some that meet only in corners.
    props.clear();
    const Mesh wholes[] = { makeTerrain(6.0, 12, 0.5), makeSphere(8, 16),
      makeBox(glm::dvec3(-0.5), glm::dvec3(0.5)), makeFolds(6) };
    for (const Mesh& whole : wholes)
    {
      const glm::dmat4 place = props.empty() ? glm::dmat4(1.0) : placed(random, 1.2, 0.5);
      for (const Mesh& patch : dealtOut(whole, 2 + random() % 2, random))
      {
        props.push_back({ patch, place });
      }
    }
  }
  else if (name == "terrain")
  {
    props.front() = { makeTerrain(6.0, 24, 0.5) };
    props.push_back({ makeBox({ -0.2, -0.2, 0.0 }, { 0.2, 0.2, 1.5 }) });
  }
  return props;
}

ShadowLight makeRandomLight(Random& random)
{
  const glm::dvec3 direction = unitVector(random) * glm::dvec3(1.0, 1.0, -1.0);
  const glm::dvec3 downwards(direction.x, direction.y, -std::abs(direction.z) - 0.05);
  switch (random() % 6)
  {
    case 0:
      return directionalLight({ 0.0, 0.0, -1.0 });
    case 1:
      return pointLight(
        { uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.3, 4.0) });
    case 2:
      return spotLight(
        -4.0 * glm::normalize(downwards), glm::dvec3(0.0, 0.0, 0.3), uniform(random, 5.0, 80.0));
    case 3:
      return boxLight(downwards, -1.2 * glm::normalize(downwards),
        { uniform(random, 1.0, 4.0), uniform(random, 1.0, 4.0), uniform(random, 1.0, 4.0) });
    default:
      return directionalLight(downwards);
  }
}

RandomPicture makeRandomPicture(const std::string& name, unsigned int seed, const glm::dmat4& world)
{
  // The seed includes the name. Otherwise kinds that draw as many numbers for their scenes would
  // share cameras and lights.
  std::vector<unsigned int> parts(name.begin(), name.end());
  parts.push_back(seed);
  std::seed_seq sequence(parts.begin(), parts.end());
  Random random(sequence);
  std::vector<Prop> props = makeRandomScene(name, random);
  const double scale = glm::length(glm::dvec3(world[0]));
  for (Prop& prop : props)
  {
    prop.worldFromMesh = world * prop.worldFromMesh;
  }
  RandomPicture picture;
  picture.occluders = makeOccluders(props);
  const auto toWorld = [&](const glm::dvec3& point)
  { return glm::dvec3(world * glm::dvec4(point, 1.0)); };

  Camera camera;
  camera.width = camera.height = 96;
  camera.position =
    toWorld(3.5 * unitVector(random) * glm::dvec3(1.0, 1.0, 0.5) + glm::dvec3(0.0, 0.0, 2.0));
  camera.target = toWorld({ 0.0, 0.0, uniform(random, 0.0, 0.8) });
  camera.fovDegrees = uniform(random, 10.0, 60.0);
  picture.view = makeView(picture.occluders, camera);

  ShadowLight light = makeRandomLight(random);
  if (name == "lamp")
  {
    const glm::dvec3 bulb(0.12, -0.21, 1.0);
    light = random() % 2 ? pointLight(bulb) : spotLight(bulb, { 0.0, 0.0, 0.0 }, 80.0);
  }
  light.positionWorld = toWorld(light.positionWorld);
  if (light.box)
  {
    light.box->width *= scale;
    light.box->height *= scale;
    light.box->depth *= scale;
  }
  const char* const projections[] = { "uniform", "uniform", "lispsm", "tsm", "pssm" };
  findSetting("projection")->set(light, projections[random() % 5]);
  if (!refusedProjection(light).empty())
  {
    findSetting("projection")->set(light, light.kind == LightKind::Point ? "cube" : "uniform");
  }
  light.fit = random() % 2 ? ViewFit::Frame : ViewFit::Off;
  const int sizes[] = { 16, 64, 129, 512 };
  light.mapSizeTexels = sizes[random() % 4];

  const glm::dvec3 centre = picture.occluders.frame.centre;
  ViewFitting fitting{ centre, picture.occluders.castersCentred, picture.occluders.allCentred,
    { light.mapSizeTexels, 1 }, {} };
  if (isFittedToCamera(light))
  {
    const glm::dmat4 viewFromCentred =
      glm::lookAt(camera.position - centre, camera.target - centre, camera.up);
    fitting.camera = CameraView{ viewFromCentred,
      glm::perspective(glm::radians(camera.fovDegrees), 1.0, 0.05 * scale, 20.0 * scale) };
  }
  picture.views = fitLightViews(light, fitting);
  picture.light = light;
  picture.description = name + ", seed " + std::to_string(seed) + ": light " +
    std::to_string(static_cast<int>(light.kind)) + (light.box ? " with a box, " : ", ") +
    findSetting("projection")->get(light) + ", map " + std::to_string(light.mapSizeTexels);
  return picture;
}

LightViews viewsOf(const ShadowLight& light, const Occluders& occluders)
{
  return fitLightViews(light,
    { occluders.frame.centre, occluders.castersCentred, {}, { light.mapSizeTexels, 1 }, {} });
}

LightRay rayAt(const LightView& view, int sizeTexels, const glm::dvec2& texels)
{
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dvec2 across = mapped(glm::inverse(texelFromAcross(view, sizeTexels)), texels);
  const glm::dvec4 from(view.rays.positional ? glm::dvec2(0.0) : across, 0.0, 1.0);
  const glm::dvec4 along(view.rays.positional ? across : glm::dvec2(0.0), 1.0, 0.0);
  return { glm::dvec3(centredFromView * from), glm::dvec3(centredFromView * along) };
}

unsigned int exactRuns(unsigned int few)
{
  const char* const asked = std::getenv("GNOMON_EXACT_RUNS");
  return asked ? static_cast<unsigned int>(std::max(1, std::atoi(asked))) : few;
}

} // namespace gnomon::test
