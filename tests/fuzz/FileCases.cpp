#include "Cases.h"
#include "FrameCheck.h"
#include "SampleFiles.h"
#include "TestFiles.h"

#include "Errors.h"
#include "FrameVariant.h"
#include "Scene.h"

#include <map>

namespace gnomon::fuzz
{
namespace
{

/// Return valid files by name, one of every type that the program reads.
std::map<std::string, std::string> goodFiles()
{
  std::map<std::string, std::string> files = tool::sampleModels();
  files["scene.json"] = tool::sampleScene().dump(1);
  files["texture.png"] = tool::samplePng();
  files["paint.mtl"] = "newmtl red\nKd 0.8 0.1 0.2\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\n"
                       "newmtl picture\nKd 1 1 1\nmap_Kd texture.png\n";
  files["painted.obj"] = "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\n"
                         "vt 0 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nusemtl picture\n"
                         "f 1/1 4/2 3/3\n";
  files["lights.json"] = nlohmann::json::parse(R"({
    "camera": {"position": [3, 4, 5], "target": [0, 0, 0], "parallel_scale": 2},
    "models": [{"file": "painted.obj", "texture": "texture.png"}, {"file": "ascii.ply"}],
    "lights": [{"type": "area", "shape": "disk", "position": [1, 5, 1], "target": [0, 0, 0],
                "radius": 0.5, "texture": "texture.png", "up": [1, 0, 0]},
               {"type": "area", "shape": "rectangle", "position": [1, 5, 1], "target": [0, 0, 0],
                "width": 1, "height": 2, "up": [0, 0, 1], "light_samples": 4},
               {"type": "directional", "direction": [0, -1, 0], "light_radius": 0.5,
                "box": {"position": [0, 3, 0], "up": [1, 0, 0], "width": 2, "height": 2,
                        "depth": 5}},
               {"type": "point", "position": [0, 3, 0], "technique": "pcf", "kernel": "box"}],
    "ground": true, "ambient": 0.2})")
                           .dump(1);
  return files;
}

/// Return the start and length of a random word in a text.
std::pair<std::size_t, std::size_t> drawWord(const std::string& bytes, Random& random)
{
  const char* const ends = " \t\r\n,:[]{}\"/<>=";
  const std::size_t first = bytes.find_first_not_of(ends, random() % bytes.size());
  if (first == std::string::npos)
  {
    return { 0, 0 };
  }
  const std::size_t end = bytes.find_first_of(ends, first);
  return { first, (end == std::string::npos ? bytes.size() : end) - first };
}

/// Replace one value of a JSON document by a random one, or remove it.
nlohmann::json withOtherValue(const nlohmann::json& document, Random& random)
{
  static const std::vector<const char*> values = { "-1", "0", "1", "3", "1e308", "-1e308", "0.5",
    "4294967295", "null", "true", "[]", "{}", "\"\"", "\"off\"", "[0, 0, 0]" };
  const nlohmann::json places = document.flatten();
  std::vector<std::string> names;
  for (const auto& place : places.items())
  {
    names.push_back(place.key());
  }
  nlohmann::json change{ { "op", "replace" }, { "path", pick(names, random) } };
  switch (random() % 3)
  {
    case 0:
      change["value"] = places[pick(names, random)];
      break;
    case 1:
      change["value"] = nlohmann::json::parse(pick(values, random));
      break;
    default:
      change["op"] = "remove";
  }
  return document.patch(nlohmann::json::array({ change }));
}

/// Change some bytes or one word at random.
void mutate(std::string& bytes, Random& random)
{
  static const std::vector<std::string> extremes = { "-1", "0", "1e308", "-1e308", "nan", "inf",
    "4294967295", "2147483648", "99999999999999999999", "1e-308", "0.5", "" };
  if (bytes.empty())
  {
    return;
  }
  const std::size_t place = random() % bytes.size();
  const std::size_t length = 1 + random() % std::min<std::size_t>(64, bytes.size());
  switch (random() % 12)
  {
    case 0:
      bytes[place] = static_cast<char>(random());
      break;
    case 1:
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
      break;
    case 2:
      bytes.resize(place);
      break;
    case 3:
      bytes.erase(place, length);
      break;
    case 4:
      bytes.insert(random() % bytes.size(), bytes.substr(place, length));
      break;
    case 5: // sets all bits of a number in a binary file
      bytes.replace(place, 4, std::string(4, chance(random, 0.5) ? '\xff' : '\x7f'));
      break;
    case 6:
    case 7:
    case 8:
    {
      const auto [first, count] = drawWord(bytes, random);
      bytes.replace(first, count, pick(extremes, random));
      break;
    }
    default:
    {
      const auto [first, count] = drawWord(bytes, random);
      const auto [from, countFrom] = drawWord(bytes, random);
      bytes.replace(first, count, bytes.substr(from, countFrom));
    }
  }
}

/// Change a file in up to three places, or in none.
std::string broken(const std::string& name, std::string bytes, Random& random)
{
  unsigned places = chance(random, 0.1) ? 0 : 1 + random() % 3;
  const bool isJson = bytes.front() == '{';
  if (places > 0 && (isJson || name == "model.glb") && chance(random, 0.7))
  {
    --places;
    bytes = isJson
      ? withOtherValue(nlohmann::json::parse(bytes), random).dump(1)
      : tool::makeGlb(withOtherValue(tool::sampleGltf(), random), tool::sampleGltfBuffer());
  }
  for (; places > 0; --places)
  {
    mutate(bytes, random);
  }
  return bytes;
}

/// Return the file to open so that the given file is read.
std::string entryOf(const std::string& name, Random& random)
{
  if (name == "paint.mtl")
  {
    return "painted.obj";
  }
  const bool isOfScene = name == "texture.png" || name == "ascii.ply" || name == "painted.obj";
  return isOfScene && (name == "texture.png" || chance(random, 0.5)) ? "lights.json" : name;
}

/// @throws Find if it cannot be drawn
void draw(const tool::Scene& scene)
{
  const tool::VtkMessages messages;
  tool::VariantSpec spec;
  spec.technique = "nsm";
  spec.mapSizeTexels = 32;
  tool::FrameVariant variant(spec, scene, 24, 16);
  variant.pass()->KeepVisibilityOn();
  variant.drawFrame(tool::Motion::Static, 0);
  checkFrame(variant.pass(), messages);
}

} // namespace

//------------------------------------------------------------------------------
void runFile(Random random, std::string& description)
{
  const tool::TestFolder folder;
  const std::map<std::string, std::string> files = goodFiles();
  const auto& [name, good] = *std::next(files.begin(), random() % files.size());
  const std::string bytes = broken(name, good, random);
  for (const auto& [fileName, ofFile] : files)
  {
    tool::writeBytes(folder / fileName, fileName == name ? bytes : ofFile);
  }
  const std::string entry = entryOf(name, random);
  description = entry + " is read, with this " + name + ":\n" + bytes;
  tool::Scene scene;
  try
  {
    scene = tool::loadScene(folder / entry);
  }
  catch (const tool::BadInput& error)
  {
    const std::string text = error.what();
    if (bytes == good || text.find(name) == std::string::npos)
    {
      throw Find("the error is for a good file, or does not name it: " + text);
    }
    return;
  }
  draw(scene);
}

} // namespace gnomon::fuzz
