// Runs the program itself on broken inputs: each must end with exit code 2 and one line that names
// the file or option, and none may crash.

#include "../RunProgram.h"
#include "SampleFiles.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdint>
#include <map>
#include <set>

namespace gnomon::tool
{
namespace
{

/// Run the program, which succeeds.
Outcome runWell(const TestFolder& folder, const std::string& text)
{
  const Outcome outcome = run(folder, text);
  EXPECT_TRUE(outcome.exited && outcome.code == 0) << text << ": " << outcome.errors;
  return outcome;
}

/// One broken input.
struct BrokenInput
{
  std::string name;                         ///< of the test
  std::string names;                        ///< what the error must name: a file, a key
  std::string arguments;                    ///< of the program
  std::map<std::string, std::string> files; ///< by name
};

void PrintTo(const BrokenInput& input, std::ostream* stream)
{
  *stream << input.name;
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

std::string garbage(std::size_t bytes)
{
  std::string text;
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < bytes; ++i)
  {
    state = state * 1664525u + 1013904223u;
    text += static_cast<char>(state >> 24);
  }
  return text;
}

std::vector<BrokenInput> brokenInputs()
{
  using Json = nlohmann::json;
  std::vector<BrokenInput> inputs;
  const auto add = [&](const std::string& what, const std::string& names, const std::string& opened,
                     const std::map<std::string, std::string>& files)
  {
    const std::string name = what + "_" + std::to_string(inputs.size());
    inputs.push_back({ name, names, "render " + opened + " -o out.png", files });
    std::replace_if(
      inputs.back().name.begin(), inputs.back().name.end(),
      [](unsigned char c) { return !std::isalnum(c); }, '_');
  };
  const auto addFile = [&](const std::string& file, const std::string& bytes) {
    add(file, file, file, { { file, bytes } });
  };

  // Every type of model: cut off, empty, garbage. A shorter .obj file may be a whole one.
  for (const auto& [name, bytes] : sampleModels())
  {
    for (const std::size_t percent : { 10u, 30u, 50u, 70u, 90u, 98u })
    {
      addFile(name,
        name == "model.obj" ? "v 0 0 0\nf 1 2 3\n" : bytes.substr(0, bytes.size() * percent / 100));
    }
    addFile(name, "");
    addFile(name, garbage(3000));
  }

  // Samples with another text.
  const std::string blanks(9000, ' ');
  const std::array<const char*, 3> texts[] = {
    { "model.obj", "v 0 2 0", "v 0 nan 0" },
    { "model.obj", "v 0 2 0", "v 0 1e99 0" },
    { "model.obj", "v 0 2 0", "v 0 1e30 0" },
    { "model.obj", "v 0 2 0", "v 0 2" },
    { "model.obj", "f 1 2 3", "f 0 2 3" },
    { "model.obj", "f 1 2 3", "f 1 2 3000000000" },
    { "model.obj", "f 1 2 3", "f -9 2 3" },
    { "model.obj", "f 1 2 3", "f 1/9 2/9 3/9" },
    { "model.obj", "f 1 2 3", "f 1 2" },
    { "ascii.ply", "end_header\n", "" },
    { "ascii.ply", "vertex 5", "vertex 2000000000" },
    { "ascii.ply", "vertex 5", "vertex -5" },
    { "ascii.ply", "face 6", "face 0" },
    { "ascii.ply", "vertex_indices", "corners" },
    { "ascii.ply", "float x", "quaternion x" },
    { "ascii.ply", "3 0 1 2", "3 0 1 99" },
    { "ascii.ply", "3 0 1 2", blanks.c_str() },
    { "ascii.stl", "endsolid pyramid\n", "" },
    { "ascii.stl", "vertex -1", "vertex x" },
    { "model.vtp", "0 1 2", "0 1 200" },
    { "model.vtp", "0 1 2", "0 1 -2" },
    { "model.vtp", "3 6 9", "3 900 9" },
    { "model.vtp", "NumberOfPoints=\"5\"", "NumberOfPoints=\"999999999999\"" },
    { "model.vtp", "\"PolyData\"", "\"ImageData\"" },
  };
  for (const auto& [file, from, to] : texts)
  {
    addFile(file, replaced(sampleFile(file), from, to));
  }

  // Samples with all bits set of a number, 'from' bytes from the beginning or the end.
  std::map<std::string, std::string> models = sampleModels();
  for (const auto& [file, from] : std::multimap<std::string, int>{ { "little.ply", -4 },
         { "binary.stl", 80 }, { "model.3ds", 8 }, { "model.3ds", -4 }, { "model.glb", 4 },
         { "model.glb", 8 }, { "model.glb", 12 }, { "model.glb", -30 } })
  {
    std::string bytes = models[file];
    addFile(file, bytes.replace(from < 0 ? bytes.size() + from : from, 4, std::string(4, '\xff')));
  }

  // VTK's reader of JPEG images in memory crashes on this one.
  add("jpeg", "damaged.jpg", "m.obj",
    { { "m.obj", "mtllib m.mtl\nusemtl m\n" + sampleFile("textured.obj") },
      { "m.mtl", "newmtl m\nmap_Kd damaged.jpg\n" },
      { "damaged.jpg", sampleFile("damaged.jpg") } });

  // A glTF document with another value at a JSON pointer.
  struct Gltf
  {
    const char* pointer;
    Json value;
    const char* names = "m.gltf";
  };
  const char* const light = "KHR_lights_punctual";
  const Gltf documents[] = {
    { "/asset/version", "1.0" },
    { "/extensionsRequired", { "KHR_draco_mesh_compression" }, "extensionsRequired[0]" },
    { "/scene", 7, "scene: found 7" },
    { "/scenes", Json::array(), "scene" },
    { "/scenes/0/nodes/0", -1, "scenes[0].nodes[0]" },
    { "/nodes/1/children", { 9 }, "nodes[1].children[0]: found 9" },
    { "/nodes/3/children", { 3 } },
    { "/nodes/0/mesh", 4 },
    { "/nodes/1/scale", { 0, 0, 0 }, "camera" },
    { "/nodes/2/extensions", { { light, { { "light", 5 } } } }, "nodes[2].extensions.KHR_lights" },
    { "/extensions", { { light, { { "lights", { { { "type", "tube" } }, 1 } } } } } },
    { "/meshes/0/primitives/0/attributes/POSITION", 99 },
    { "/accessors/0/count", 2000000000 },
    { "/accessors/0/max", { 1, 2 } },
    { "/accessors/0/min/1", nullptr },
    { "/bufferViews/1/byteOffset", 61 },
    { "/buffers/0/uri", "gone.bin", "gone.bin" },
    { "/images/0/bufferView", 0 },
    { "/textures/0/source", 3 },
  };
  for (const auto& [pointer, value, names] : documents)
  {
    Json document = sampleGltfWithBuffer();
    document[Json::json_pointer(pointer)] = value;
    add("gltf", names, "m.gltf", { { "m.gltf", document.dump() } });
  }

  // Names in the error, and a scene file.
  const auto sceneWith = [](const char* pointer, const std::string& value)
  {
    Json document = sampleScene();
    document[Json::json_pointer(pointer)] = value;
    return document.dump();
  };
  const std::pair<const char*, std::string> scenes[] = {
    { "line 2, column 14", "{\n  \"models\": [,]\n}" },
    { "scene.json", "[]" },
    { "models", "{}" },
    { "scene.json", "12" },
    { "scene.json", sampleScene().dump().substr(0, 99) },
    { "scene.json", garbage(500) },
    { "scene.json", std::string(100, '\0') },
    { "scene.json", std::string(200000, '[') },
    { "scene.json", "{\"camera\": {\"fov\": 1e999}}" },
    { "\"models\" occurs twice", "{\"models\": 1, \"models\": 2}" },
    { "scene.json", std::string(17 * 1024 * 1024, ' ') },
    { "models[0].file", sceneWith("/models/0/file", "scene.json") },
    { "models[0].file", sceneWith("/models/0/file", ".") },
    { "models[0].file", sceneWith("/models/0/file", std::string("a\0b.obj", 7)) },
    { "lights[0].technique", sceneWith("/lights/0/technique", "nms") },
    { "light 0 with the technique tsm: the projection 'tsm'",
      R"({"models": [{"file": "model.obj"}],
          "lights": [{"type": "point", "position": [3, 4, 5], "technique": "tsm"}]})" },
  };
  for (const auto& [names, text] : scenes)
  {
    add("scene", names, "scene.json",
      { { "scene.json", text }, { "model.obj", sampleFile("model.obj") } });
  }

  // Names in the error, and the arguments; with '+', after `render cube -o out.png`.
  const std::pair<const char*, const char*> options[] = {
    { "subcommand", "" },
    { "rendre", "rendre cube" },
    { "scene", "render -o out.png" },
    { "--output", "render cube" },
    { "--shiny", "+--shiny" },
    { "kube", "render kube -o out.png" },
    { ".", "render . -o out.png" },
    { "zero.obj", "render zero.obj -o out.png" },
    { "out.gif", "render cube -o out.gif" },
    { "gone/out.png", "render cube -o gone/out.png" },
    { "folder.png", "render cube -o folder.png" },
    { "/proc/out.png", "render cube -o /proc/out.png" },
    { "--visibility", "+--visibility gone/v.exr" },
    { "--visibility", "+--visibility v.png" },
    { "--visibility", "render cube -o out.exr --visibility ./out.exr" },
    { "--stats", "+--stats /proc/s.json" },
    { "--classes", "+--classes /proc/c.png" },
    { "--classes", "+--classes ./out.png" },
    { "--classes", "+--size 8x8 --technique nsm --classes c.png" },
    { "--visibility", "+--shade-samples --visibility v.exr" },
    { "--stats", "+--shade-samples --stats s.json" },
    { "--classes", "+--shade-samples --technique silhouette --classes c.png" },
    { "--size", "+--size 0x100" },
    { "--size", "+--size 100x-1" },
    { "--size", "+--size 99999x99999" },
    { "--size", "+--size 99999999999999999999x1" },
    { "--size", "+--size big" },
    { "--kernel", "+--kernel magic" },
    { "--kernel-size", "+--kernel-size 33" },
    { "--kernel", "compare cube -o out --kernel magic" },
    { "--map-size", "+--map-size 0" },
    { "--map-size", "+--map-size 1000000" },
    { "--technique", "+--technique magic" },
    { "--route", "+--route sideways" },
    { "--route", "+--technique raytraced --route inline" },
    { "--light", "+--light laser:a=1" },
    { "--light", "+--light a=1" },
    { "light 0 with the technique pssm: the projection 'pssm' divides or warps a single view, and "
      "a point light",
      "+--technique pssm --light point:position=3,4,5" },
    { "light 1 with the technique lispsm",
      "+--light point:position=3,4,5 --light point:position=3,4,5;technique=lispsm" },
    { "light 0 has the technique 'silhouette', and the setting 'map_samples'",
      "+--technique silhouette --map-samples 4" },
    { "--no-ground: found cube", "+--no-ground" },
    { "--ambient: found \"1.5\", expected a number in [0, 1]", "+--ambient 1.5" },
    { "--ambient: found \"nan\", expected a number in [0, 1]", "+--ambient nan" },
    { "--sky: found \"-1\", expected a number of at least 0", "+--sky -1" },
    { "--sky: found \"nan\", expected a number of at least 0", "+--sky nan" },
    { "--sky-model: cloudy not in {uniform,dome,overcast}", "+--sky-model cloudy" },
    { "height", "+--light area:position=1,2,3;target=0,0,0;width=1;height=-1" },
    { "direction", "+--light directional:direction=0,0,0" },
    { "direction", "+--light directional:direction=1,nan,inf" },
    { "cone_angle", "+--light spot:position=1,2,3;target=0,0,0;cone_angle=3;cone_angle=4" },
    { "zoom", "+--camera zoom=2" },
    { "up", "+--camera position=0,5,0;target=0,0,0" },
    { "--camera", "+--camera =" },
    { "fov: means nothing for a parallel camera, which \"parallel_scale\"",
      "+--camera fov=30;parallel_scale=2" },
    { "--camera parallel_scale=-1: parallel_scale: found -1", "+--camera parallel_scale=-1" },
    { "zero.obj", "compare cube -o zero.obj" },
    { "no-such-scene", "compare no-such-scene -o out" },
    { "--size", "compare cube --size 0x10 -o out" },
    { "\"magic\"", "compare cube --techniques nsm,magic -o out" },
    { "--map-sizes", "compare cube --map-sizes 7 -o out" },
    { "--frames", "compare cube --frames -1 -o out" },
    { "--route", "compare cube --route scenic -o out" },
    { "--techniques excludes --all", "compare cube --all --techniques nsm -o out" },
    { "--output", "compare cube" },
    { "--export: zero.obj", "scenes --export cube zero.obj" },
    { "--export: props has props that no scene file describes", "scenes --export props ." },
  };
  for (const auto& [names, arguments] : options)
  {
    const bool rendersCube = *arguments == '+';
    inputs.push_back({ "option_" + std::to_string(inputs.size()), names,
      rendersCube ? std::string("render cube -o out.png ") + (arguments + 1) : arguments, {} });
  }
  return inputs;
}

class BrokenInputs : public ::testing::TestWithParam<BrokenInput>
{
};

TEST_P(BrokenInputs, AreRefusedWithOneClearLineAndLeaveAnOlderPicture)
{
  const BrokenInput& input = GetParam();
  TestFolder folder;
  mkdir((folder / "folder.png").c_str(), 0700);
  (void)!symlink("/dev/zero", (folder / "zero.obj").c_str());
  writeBytes(folder / "out.png", "older");
  for (const auto& [file, bytes] : input.files)
  {
    writeBytes(folder / file, bytes);
  }

  SCOPED_TRACE(input.arguments);
  const Outcome outcome = run(folder, input.arguments);
  ASSERT_TRUE(outcome.exited) << "signal " << outcome.code << "\n" << outcome.errors;
  EXPECT_EQ(outcome.code, 2) << outcome.errors;
  const std::string prefix = "gnomon: error: ";
  EXPECT_EQ(outcome.errors.compare(0, prefix.size(), prefix), 0) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find(input.names), std::string::npos) << outcome.errors;
  EXPECT_LT(outcome.errors.size(), 700u) << outcome.errors;
  EXPECT_EQ(readBytes(folder / "out.png"), "older");
}

INSTANTIATE_TEST_SUITE_P(Tool, BrokenInputs, ::testing::ValuesIn(brokenInputs()),
  [](const ::testing::TestParamInfo<BrokenInput>& input) { return input.param.name; });

TEST(Program, RendersEveryTypeOfModel)
{
  TestFolder folder;
  for (const auto& [name, bytes] : sampleModels())
  {
    writeBytes(folder / name, bytes);
    EXPECT_EQ(runWell(folder, "render " + name + " -o out.png --size 64x48").errors, "");
    EXPECT_EQ(readBytes(folder / "out.png").compare(1, 3, "PNG"), 0) << name;
  }
}

TEST(Program, StatisticsAreOfAllFramesOfAPicture)
{
  TestFolder folder;
  const auto statsBy = [&](const std::string& progressive)
  {
    runWell(folder,
      "render cube --size 64x48 --technique sampled --light-radius 5 --light-samples 32 "
      "--map-size 64 -o out.png --stats stats.json --progressive " +
        progressive);
    return nlohmann::json::parse(readBytes(folder / "stats.json"));
  };
  const nlohmann::json single = statsBy("0");
  EXPECT_EQ(single.at("frames"), 1);
  EXPECT_EQ(single.at("map_bakes"), 33);
  const nlohmann::json several = statsBy("8");
  EXPECT_EQ(several.at("frames"), 5);
  EXPECT_EQ(several.at("map_bakes"), 33);
  EXPECT_EQ(several.at("lights").at(0).at("progress"), 1.0);
  EXPECT_EQ(several.at("lights").at(0).at("light_samples"), 32);
  EXPECT_EQ(several.at("stages").size(), single.at("stages").size());
  double stages = 0.0;
  for (const auto& stage : several.at("stages"))
  {
    stages += stage.at("milliseconds").get<double>();
  }
  EXPECT_LE(stages, several.at("wall_milliseconds").get<double>());
}

TEST(Program, ShadesFromAllPointsOfALight)
{
  TestFolder folder;
  const auto pictureOf = [&](const std::string& options)
  {
    runWell(folder, "render soft-stack -o out.png --size 64x48 --technique nsm " + options);
    return readBytes(folder / "out.png");
  };
  const std::string shaded = pictureOf("--shade-samples --light-samples 8");
  EXPECT_NE(shaded, pictureOf(""));
  EXPECT_EQ(shaded, pictureOf("--shade-samples --light-samples 8 --progressive 4"));
  EXPECT_NE(shaded, pictureOf("--shade-samples --light-samples 4"));
  // Lights may say it themselves.
  const std::string lamp =
    "--shade-samples --light area:position=1,-1,6;target=0,0,0;shape=disk;radius=1";
  EXPECT_EQ(pictureOf(lamp + ";light_samples=4"), pictureOf(lamp + " --light-samples 4"));
  EXPECT_NE(pictureOf(lamp + ";light_samples=4"), pictureOf(lamp));
}

/// The program's files may have a limited size, which is what a full disk does to them.
TEST(Program, LeavesNoPartOfAFileOnAFullDisk)
{
  const std::string render = "render cube --size 64x48 -o ";
  const std::map<std::string, std::string> cases = { // by the file that becomes too large
    { "a.png", render + "a.png" }, { "a.exr", render + "a.exr" },
    { "v.exr", render + "null.png --visibility v.exr" },
    { "s.json", render + "null.png --stats s.json" },
    { "c.png", render + "null.png --technique silhouette --classes c.png" },
    { "cube-0.vtp", "scenes --export cube ." }
  };
  signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  for (const auto& [file, arguments] : cases)
  {
    for (const bool isThere : { false, true })
    {
      SCOPED_TRACE(file + (isThere ? " exists" : ""));
      TestFolder folder;
      (void)!symlink("/dev/null", (folder / "null.png").c_str());
      if (isThere)
      {
        writeBytes(folder / file, "older");
      }
      const rlimit small{ 200, before.rlim_max };
      setrlimit(RLIMIT_FSIZE, &small);
      const Outcome outcome = run(folder, arguments);
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_TRUE(outcome.exited);
      EXPECT_EQ(outcome.code, 1) << outcome.errors;
      EXPECT_NE(outcome.errors.find(file), std::string::npos) << outcome.errors;
      std::set<std::string> names;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      {
        names.insert(entry.path().filename().string());
      }
      for (const char* other : { "stdout.txt", "stderr.txt", "null.png" })
      {
        names.erase(other);
      }
      EXPECT_EQ(names, isThere ? std::set{ file } : std::set<std::string>{});
      EXPECT_EQ(readBytes(folder / file), isThere ? "older" : "");
    }
  }
}

TEST(Program, ReplacesFilesThroughLinksAndKeepsTheirPermissions)
{
  TestFolder folder;
  writeBytes(folder / "file.png", "older");
  chmod((folder / "file.png").c_str(), 0640);
  (void)!symlink("file.png", (folder / "link.png").c_str());
  runWell(folder, "render cube --size 8x8 -o link.png");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
  EXPECT_EQ(readBytes(folder / "file.png").compare(1, 3, "PNG"), 0);
  struct stat state;
  ASSERT_EQ(stat((folder / "file.png").c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777, 0640u);
}

TEST(Program, FailsWithCodeOneWhenItsOutputCannotBeWritten)
{
  TestFolder folder;
  runWell(folder, "render cube --size 8x8 -o a.png");
  for (const char* arguments : { "techniques", "scenes", "scenes --hard", "scenes --export cube .",
         "settings", "settings --markdown", "view --keys", "diff a.png a.png", "--help",
         "--version", "render --help" })
  {
    const Outcome good = runWell(folder, arguments);
    EXPECT_NE(good.output, "") << arguments;
    const Outcome outcome = run(folder, arguments, "/dev/full");
    EXPECT_TRUE(outcome.exited);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_NE(outcome.errors.find("gnomon: error: standard output: "), std::string::npos)
      << arguments << ": " << outcome.errors;
  }
  const std::string version = runWell(folder, "--version").output;
  EXPECT_EQ(version.rfind("gnomon " GNOMON_VERSION ", VTK 9.", 0), 0u) << version;
}

} // namespace
} // namespace gnomon::tool
