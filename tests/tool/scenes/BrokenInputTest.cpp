// Runs the program itself on broken inputs: each must end with exit code 2 and one line that names
// the file or option, and none may crash.

#include "../RunProgram.h"
#include "SampleFiles.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <functional>
#include <set>

namespace gnomon::tool
{
namespace
{

/// Return the report of a good run of `gnomon render`, which writes out.png and stats.json.
nlohmann::json statsOf(const TestFolder& folder, std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "render");
  arguments.insert(arguments.end(), { "-o", "out.png", "--stats", "stats.json" });
  const Outcome outcome = run(folder, arguments);
  EXPECT_TRUE(outcome.exited && outcome.code == 0) << outcome.errors;
  return nlohmann::json::parse(readBytes(folder / "stats.json"));
}

/// One broken input.
struct BrokenInput
{
  std::string name;                   ///< of the test
  std::string names;                  ///< what the error must name: a file, a key, an option
  std::vector<std::string> arguments; ///< of the program
  std::function<void(const TestFolder&)> prepare; ///< writes its files
};

void PrintTo(const BrokenInput& input, std::ostream* stream)
{
  *stream << input.name;
}

/// `gnomon render FILE -o out.png`, with that file written first.
BrokenInput file(const std::string& name, const std::string& fileName, const std::string& bytes)
{
  return { name, fileName, { "render", fileName, "-o", "out.png" },
    [=](const TestFolder& folder) { writeBytes(folder / fileName, bytes); } };
}

/// `gnomon render scene.json -o out.png`, with model.obj next to it.
BrokenInput scene(const std::string& name, const std::string& path, const std::string& text)
{
  return { name, path, { "render", "scene.json", "-o", "out.png" },
    [=](const TestFolder& folder)
    {
      writeBytes(folder / "scene.json", text);
      writeBytes(folder / "model.obj", sampleObj());
    } };
}

/// A good scene with another value at that JSON pointer.
BrokenInput sceneWith(const std::string& name, const std::string& path, const std::string& pointer,
  const nlohmann::json& value)
{
  nlohmann::json document = sampleScene();
  document[nlohmann::json::json_pointer(pointer)] = value;
  return scene(name, path, document.dump());
}

/// A good glTF document with another value at that JSON pointer.
BrokenInput gltfWith(const std::string& name, const std::string& pointer,
  const nlohmann::json& value, const std::string& names = "m.gltf")
{
  nlohmann::json document = sampleGltfWithBuffer();
  document[nlohmann::json::json_pointer(pointer)] = value;
  BrokenInput input = file(name, "m.gltf", document.dump());
  input.names = names;
  return input;
}

/// The program with these arguments after `render cube`, or without a scene of its own.
BrokenInput option(
  const std::string& name, const std::string& names, const std::vector<std::string>& arguments)
{
  return { name, names, arguments, [](const TestFolder&) {} };
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

std::string withBytes(std::string bytes, std::size_t position, const std::string& value)
{
  return bytes.replace(position, value.size(), value);
}

std::string half(const std::string& bytes)
{
  return bytes.substr(0, bytes.size() / 2);
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

/// sampleVtp() with compressed points. The header holds the number of blocks, the size of a block,
/// of the last one, and of each compressed one.
std::string compressedVtp(const std::string& compressor, const std::vector<std::uint32_t>& header)
{
  const std::string words(
    reinterpret_cast<const char*>(header.data()), header.size() * sizeof(header[0]));
  const std::string format = "NumberOfComponents=\"3\" format=\"";
  std::string text = replaced(
    sampleVtp(), "byte_order", "compressor=\"vtk" + compressor + "DataCompressor\" byte_order");
  text = replaced(text, format + "ascii\">", format + "binary\">");
  const std::size_t begin = text.find('>', text.find(format)) + 1;
  return text.replace(
    begin, text.find('<', begin) - begin, base64(words) + base64(std::string(64, '\0')));
}

/// A binary STL file whose vertices are all not a number.
std::string allNanStl()
{
  std::string bytes = sampleBinaryStl();
  const float nan = std::nanf("");
  for (std::size_t triangle = 84; triangle + 50 <= bytes.size(); triangle += 50)
  {
    for (std::size_t i = 12; i < 48; i += sizeof(nan))
    {
      std::memcpy(bytes.data() + triangle + i, &nan, sizeof(nan));
    }
  }
  return bytes;
}

std::vector<BrokenInput> brokenInputs()
{
  const std::string glb = makeGlb(sampleGltf(), sampleGltfBuffer());
  const std::string maximum = "\xff\xff\xff\xff";
  std::vector<BrokenInput> inputs;

  // Every type of model: cut in half, empty, garbage.
  for (const auto& [name, bytes] : sampleModels())
  {
    const std::string test = replaced(name, ".", "_");
    const bool lines = name == "model.obj";
    inputs.push_back(file("truncated_" + test, name, lines ? "v 0 0 0\nf 1 2 3\n" : half(bytes)));
    inputs.push_back(file("empty_" + test, name, ""));
    inputs.push_back(file("garbage_" + test, name, garbage(3000)));
  }

  // The headers of compressed arrays.
  constexpr std::uint32_t most = 0xffffffff;
  const std::vector<std::uint32_t> headers[] = { { 0, 60, 60 }, { 1, 0, 60, 64 }, { 1, 60, 0, 64 },
    { 1, 60, most, 64 }, { most, 60, 60, 64 }, { 1, 60, 60, most } };
  for (const std::string compressor : { "ZLib", "LZ4", "LZMA" })
  {
    for (std::size_t i = 0; i < std::size(headers); ++i)
    {
      inputs.push_back(file("vtp_" + compressor + "_header_" + std::to_string(i), "m.vtp",
        compressedVtp(compressor, headers[i])));
    }
  }

  // VTK's reader of JPEG images in memory crashes on this one.
  BrokenInput jpeg = file("obj_damaged_jpeg", "m.obj",
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
  jpeg.names = "damaged.jpg";
  jpeg.prepare = [writeModel = jpeg.prepare](const TestFolder& folder)
  {
    writeModel(folder);
    writeBytes(folder / "m.mtl", "newmtl m\nmap_Kd damaged.jpg\n");
    std::filesystem::copy_file(
      GNOMON_SOURCE_DIR "/tests/tool/scenes/damaged.jpg", folder / "damaged.jpg");
  };
  inputs.push_back(jpeg);

  const std::vector<BrokenInput> others = {
    // Models
    file("obj_nan", "m.obj", replaced(sampleObj(), "v 0 2 0", "v 0 nan 0")),
    file("obj_huge_number", "m.obj", replaced(sampleObj(), "v 0 2 0", "v 0 1e99 0")),
    file("obj_far_away", "m.obj", replaced(sampleObj(), "v 0 2 0", "v 0 1e30 0")),
    file("obj_short_vertex", "m.obj", replaced(sampleObj(), "v 0 2 0", "v 0 2")),
    file("obj_index_zero", "m.obj", replaced(sampleObj(), "f 1 2 3", "f 0 2 3")),
    file("obj_index_too_large", "m.obj", replaced(sampleObj(), "f 1 2 3", "f 1 2 3000000000")),
    file("obj_index_before_the_first", "m.obj", replaced(sampleObj(), "f 1 2 3", "f -9 2 3")),
    file("obj_missing_texture_index", "m.obj", replaced(sampleObj(), "f 1 2 3", "f 1/9 2/9 3/9")),
    file("obj_two_corners", "m.obj", replaced(sampleObj(), "f 1 2 3", "f 1 2")),
    file("obj_without_faces", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
    file("ply_no_end_of_header", "m.ply", replaced(sampleAsciiPly(), "end_header\n", "")),
    file("ply_huge_count", "m.ply", replaced(sampleAsciiPly(), "vertex 5", "vertex 2000000000")),
    file("ply_negative_count", "m.ply", replaced(sampleAsciiPly(), "vertex 5", "vertex -5")),
    file("ply_no_faces", "m.ply", replaced(sampleAsciiPly(), "face 6", "face 0")),
    file("ply_no_corner_list", "m.ply", replaced(sampleAsciiPly(), "vertex_indices", "corners")),
    file("ply_unknown_type", "m.ply", replaced(sampleAsciiPly(), "float x", "quaternion x")),
    file("ply_index_too_large", "m.ply", replaced(sampleAsciiPly(), "3 0 1 2", "3 0 1 99")),
    file("ply_long_line", "m.ply", replaced(sampleAsciiPly(), "3 0 1 2", std::string(9000, ' '))),
    file("ply_binary_index", "m.ply",
      withBytes(sampleBinaryPly(false), sampleBinaryPly(false).size() - 4, maximum)),
    file("stl_wrong_count", "m.stl", withBytes(sampleBinaryStl(), 80, maximum)),
    file("stl_all_nan", "m.stl", allNanStl()),
    file("stl_text_without_end", "m.stl", replaced(sampleAsciiStl(), "endsolid pyramid\n", "")),
    file("stl_text_bad_vertex", "m.stl", replaced(sampleAsciiStl(), "vertex -1", "vertex x")),
    file("vtp_index_too_large", "m.vtp", replaced(sampleVtp(), "0 1 2", "0 1 200")),
    file("vtp_negative_index", "m.vtp", replaced(sampleVtp(), "0 1 2", "0 1 -2")),
    file("vtp_bad_offsets", "m.vtp", replaced(sampleVtp(), "3 6 9", "3 900 9")),
    file("vtp_too_many_points", "m.vtp",
      replaced(sampleVtp(), "NumberOfPoints=\"5\"", "NumberOfPoints=\"999999999999\"")),
    file("vtp_of_another_kind", "m.vtp", replaced(sampleVtp(), "\"PolyData\"", "\"ImageData\"")),
    file("3ds_chunk_too_long", "m.3ds", withBytes(sample3ds(), 8, maximum)),
    file("3ds_chunk_of_no_length", "m.3ds", withBytes(sample3ds(), 8, std::string(4, '\0'))),
    file("3ds_index_too_large", "m.3ds", withBytes(sample3ds(), sample3ds().size() - 4, maximum)),
    file("glb_length", "m.glb", withBytes(glb, 8, maximum)),
    file("glb_version", "m.glb", withBytes(glb, 4, "\1")),
    file("glb_chunk_length", "m.glb", withBytes(glb, 12, maximum)),
    file("glb_damaged_image", "m.glb",
      makeGlb(sampleGltf(), withBytes(sampleGltfBuffer(), sampleGltfBuffer().size() - 30, "XXXX"))),
    file("gltf_syntax", "m.gltf", "{\"asset\": "),
    gltfWith("gltf_version", "/asset/version", "1.0"),
    gltfWith("gltf_required_extension", "/extensionsRequired", { "KHR_draco_mesh_compression" },
      "extensionsRequired[0]"),
    gltfWith("gltf_scene", "/scene", 7, "scene"),
    gltfWith("gltf_no_scenes", "/scenes", nlohmann::json::array(), "scenes"),
    gltfWith("gltf_node_cycle", "/nodes/3/children", { 3 }, "nodes[3].children[0]"),
    gltfWith("gltf_node", "/scenes/0/nodes/0", -1, "scenes[0].nodes[0]"),
    gltfWith("gltf_mesh", "/nodes/0/mesh", 4),
    gltfWith("gltf_accessor", "/meshes/0/primitives/0/attributes/POSITION", 99),
    gltfWith("gltf_accessor_count", "/accessors/0/count", 2000000000),
    gltfWith("gltf_accessor_bounds", "/accessors/0/max", { 1, 2 }),
    gltfWith("gltf_accessor_bound", "/accessors/0/min/1", nullptr),
    gltfWith("gltf_index_value", "/bufferViews/1/byteOffset", 61),
    gltfWith("gltf_missing_buffer", "/buffers/0/uri", "gone.bin", "gone.bin"),
    gltfWith("gltf_image", "/images/0/bufferView", 0),
    gltfWith("gltf_texture", "/textures/0/source", 3),
    gltfWith("gltf_light", "/nodes/2/extensions/KHR_lights_punctual/light", 5,
      "nodes[2].extensions.KHR_lights_punctual.light"),
    gltfWith(
      "gltf_light_type", "/extensions/KHR_lights_punctual/lights/0/type", "tube", "lights[0].type"),
    gltfWith("gltf_singular_camera", "/nodes/1/scale", { 0, 0, 0 }, "cameras[0]"),

    // Scene files
    scene("scene_syntax", "line 1", "{,}"),
    scene("scene_empty_array", "scene.json", "[]"),
    scene("scene_empty_object", "models", "{}"),
    scene("scene_number", "scene.json", "12"),
    scene("scene_cut_off", "scene.json", half(sampleScene().dump())),
    scene("scene_garbage", "scene.json", garbage(500)),
    scene("scene_zero_bytes", "scene.json", std::string(100, '\0')),
    scene("scene_deep_nesting", "scene.json", std::string(200000, '[')),
    scene("scene_huge_number", "scene.json", "{\"camera\": {\"fov\": 1e999}}"),
    scene("scene_duplicate_key", "\"models\" occurs twice", "{\"models\": 1, \"models\": 2}"),
    scene("scene_too_large", "scene.json", std::string(17 * 1024 * 1024, ' ')),
    sceneWith("scene_model_is_itself", "models[0].file", "/models/0/file", "scene.json"),
    sceneWith("scene_model_is_a_folder", "models[0].file", "/models/0/file", "."),
    sceneWith(
      "scene_model_with_zero_byte", "models[0].file", "/models/0/file", std::string("a\0b.obj", 7)),
    sceneWith("scene_technique", "lights[0].technique", "/lights/0/technique", "nms"),

    // Options
    option("no_command", "subcommand", {}),
    option("unknown_command", "rendre", { "rendre", "cube" }),
    option("no_scene", "scene", { "render", "-o", "out.png" }),
    option("no_output", "--output", { "render", "cube" }),
    option("unknown_option", "--shiny", { "render", "cube", "-o", "out.png", "--shiny" }),
    option("unknown_scene", "kube", { "render", "kube", "-o", "out.png" }),
    option("scene_is_a_folder", ".", { "render", ".", "-o", "out.png" }),
    option("scene_is_a_device", "zero.obj", { "render", "zero.obj", "-o", "out.png" }),
    option("output_type", "out.gif", { "render", "cube", "-o", "out.gif" }),
    option("output_folder_missing", "gone/out.png", { "render", "cube", "-o", "gone/out.png" }),
    option("output_is_a_folder", "folder.png", { "render", "cube", "-o", "folder.png" }),
    option("output_unwritable", "/proc/out.png", { "render", "cube", "-o", "/proc/out.png" }),
    option("visibility_unwritable", "--visibility",
      { "render", "cube", "-o", "out.png", "--visibility", "gone/v.exr" }),
    option("visibility_type", "--visibility",
      { "render", "cube", "-o", "out.png", "--visibility", "v.png" }),
    option("visibility_is_the_picture", "--visibility",
      { "render", "cube", "-o", "out.exr", "--visibility", "./out.exr" }),
    option("stats_unwritable", "--stats",
      { "render", "cube", "-o", "out.png", "--stats", "/proc/s.json" }),
    option("classes_unwritable", "--classes",
      { "render", "cube", "-o", "out.png", "--classes", "/proc/c.png" }),
    option("classes_are_the_picture", "--classes",
      { "render", "cube", "-o", "out.png", "--classes", "./out.png" }),
    option("classes_of_a_technique_without", "--classes",
      { "render", "cube", "-o", "out.png", "--size", "8x8", "--technique", "nsm", "--classes",
        "c.png" }),
    option("shaded_samples_have_no_visibility", "--visibility",
      { "render", "cube", "-o", "out.png", "--shade-samples", "--visibility", "v.exr" }),
    option("shaded_samples_have_no_stats", "--stats",
      { "render", "cube", "-o", "out.png", "--shade-samples", "--stats", "s.json" }),
    option("shaded_samples_have_no_classes", "--classes",
      { "render", "cube", "-o", "out.png", "--shade-samples", "--technique", "silhouette",
        "--classes", "c.png" }),
    option("size_zero", "--size", { "render", "cube", "-o", "out.png", "--size", "0x100" }),
    option("size_negative", "--size", { "render", "cube", "-o", "out.png", "--size", "100x-1" }),
    option("size_huge", "--size", { "render", "cube", "-o", "out.png", "--size", "99999x99999" }),
    option("size_overflow", "--size",
      { "render", "cube", "-o", "out.png", "--size", "99999999999999999999x1" }),
    option("size_text", "--size", { "render", "cube", "-o", "out.png", "--size", "big" }),
    option("kernel", "--kernel", { "render", "cube", "-o", "out.png", "--kernel", "magic" }),
    option(
      "kernel_size", "--kernel-size", { "render", "cube", "-o", "out.png", "--kernel-size", "33" }),
    option("compared_kernel", "--kernel", { "compare", "cube", "-o", "out", "--kernel", "magic" }),
    option("map_size_zero", "--map-size", { "render", "cube", "-o", "out.png", "--map-size", "0" }),
    option("map_size_huge", "--map-size",
      { "render", "cube", "-o", "out.png", "--map-size", "1000000" }),
    option(
      "technique", "--technique", { "render", "cube", "-o", "out.png", "--technique", "magic" }),
    option("route", "--route", { "render", "cube", "-o", "out.png", "--route", "sideways" }),
    option("route_of_the_technique", "--route",
      { "render", "cube", "-o", "out.png", "--technique", "raytraced", "--route", "inline" }),
    option("light_type", "--light", { "render", "cube", "-o", "out.png", "--light", "laser:a=1" }),
    option(
      "light_without_type", "--light", { "render", "cube", "-o", "out.png", "--light", "a=1" }),
    option("light_of_the_technique", "light 0 with the technique pssm",
      { "render", "cube", "-o", "out.png", "--technique", "pssm", "--light",
        "point:position=3,4,5" }),
    option("light_area", "height",
      { "render", "cube", "-o", "out.png", "--light",
        "area:position=1,2,3;target=0,0,0;width=1;height=-1" }),
    option("light_direction", "direction",
      { "render", "cube", "-o", "out.png", "--light", "directional:direction=0,0,0" }),
    option("light_numbers", "direction",
      { "render", "cube", "-o", "out.png", "--light", "directional:direction=1,nan,inf" }),
    option("light_key_twice", "cone_angle",
      { "render", "cube", "-o", "out.png", "--light",
        "spot:position=1,2,3;target=0,0,0;cone_angle=3;cone_angle=4" }),
    option("camera_key", "zoom", { "render", "cube", "-o", "out.png", "--camera", "zoom=2" }),
    option("camera_up", "up",
      { "render", "cube", "-o", "out.png", "--camera", "position=0,5,0;target=0,0,0" }),
    option("camera_empty", "--camera", { "render", "cube", "-o", "out.png", "--camera", "=" }),
  };
  inputs.insert(inputs.end(), others.begin(), others.end());
  return inputs;
}

class BrokenInputs : public ::testing::TestWithParam<BrokenInput>
{
};

//------------------------------------------------------------------------------
TEST_P(BrokenInputs, AreRefusedWithOneClearLine)
{
  const BrokenInput& input = GetParam();
  TestFolder folder;
  mkdir((folder / "folder.png").c_str(), 0700);
  (void)!symlink("/dev/zero", (folder / "zero.obj").c_str());
  input.prepare(folder);

  const Outcome outcome = run(folder, input.arguments);
  ASSERT_TRUE(outcome.exited) << "signal " << outcome.code << "\n" << outcome.errors;
  EXPECT_EQ(outcome.code, 2) << outcome.errors;
  const std::string prefix = "gnomon: error: ";
  EXPECT_EQ(outcome.errors.compare(0, prefix.size(), prefix), 0) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find(input.names), std::string::npos) << outcome.errors;
  EXPECT_LT(outcome.errors.size(), 700u) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

INSTANTIATE_TEST_SUITE_P(Tool, BrokenInputs, ::testing::ValuesIn(brokenInputs()),
  [](const ::testing::TestParamInfo<BrokenInput>& input) { return input.param.name; });

//------------------------------------------------------------------------------
TEST(Program, RendersEveryTypeOfModel)
{
  TestFolder folder;
  for (const auto& [name, bytes] : sampleModels())
  {
    SCOPED_TRACE(name);
    writeBytes(folder / name, bytes);
    const std::string picture = name + ".png";
    const Outcome outcome = run(folder, { "render", name, "-o", picture, "--size", "64x48" });
    EXPECT_TRUE(outcome.exited && outcome.code == 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_EQ(readBytes(folder / picture).compare(1, 3, "PNG"), 0);
  }
}

//------------------------------------------------------------------------------
TEST(Program, RendersASceneFileAndWritesStatistics)
{
  TestFolder folder;
  writeBytes(folder / "scene.json", sampleScene().dump());
  writeBytes(folder / "model.obj", sampleObj());
  const nlohmann::json stats = statsOf(folder,
    { "scene.json", "--size", "64x64", "--light", "directional:direction=-1,-2,-1", "--technique",
      "nsm", "--map-size", "64" });
  EXPECT_TRUE(stats.contains("stages"));
  EXPECT_TRUE(stats.contains("lights"));
}

//------------------------------------------------------------------------------
TEST(Program, StatisticsAreOfAllFramesOfAPicture)
{
  TestFolder folder;
  const auto statsBy = [&](const std::string& progressive)
  {
    return statsOf(folder,
      { "cube", "--size", "64x48", "--technique", "sampled", "--light-radius", "5",
        "--light-samples", "32", "--map-size", "64", "--progressive", progressive });
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

//------------------------------------------------------------------------------
/// A text attribute of an OpenEXR file's header: name and type end in zeros, the length takes four
/// bytes.
std::string textAttribute(const std::string& file, const std::string& name)
{
  const std::string begin = name + std::string("\0string\0", 8);
  const std::size_t found = file.find(begin);
  if (found == std::string::npos)
  {
    return "none";
  }
  const std::size_t length = found + begin.size();
  return file.substr(length + 4, static_cast<unsigned char>(file[length]));
}

TEST(Program, TellsHowPixelsWereDecided)
{
  TestFolder folder;
  const nlohmann::json stats = statsOf(folder,
    { "cube", "--size", "64x48", "--technique", "silhouette", "--classes", "classes.png",
      "--visibility", "visibility.exr" });
  EXPECT_EQ(readBytes(folder / "classes.png").compare(1, 3, "PNG"), 0);
  int pixels = 0;
  for (const auto& count : stats.at("lights").at(0).at("classes"))
  {
    pixels += count.get<int>();
  }
  EXPECT_EQ(pixels, 64 * 48);
  EXPECT_GT(stats.at("lights").at(0).at("classes").at("lit for certain").get<int>(), 500);

  // The file of the visibility says the same in its header.
  const std::string file = readBytes(folder / "visibility.exr");
  const nlohmann::json& light = stats.at("lights").at(0);
  EXPECT_EQ(textAttribute(file, "light.0.rays"), light.at("rays").dump());
  EXPECT_EQ(textAttribute(file, "light.0.traced_pixels"), light.at("traced_pixels").dump());
  for (const auto& [name, count] : light.at("classes").items())
  {
    EXPECT_EQ(textAttribute(file, "light.0.pixels." + name), count.dump()) << name;
  }
}

//------------------------------------------------------------------------------
TEST(Program, ShadesFromAllPointsOfALight)
{
  TestFolder folder;
  const auto pictureOf = [&](const std::vector<std::string>& options)
  {
    std::vector<std::string> arguments = { "render", "soft-stack", "-o", "out.png", "--size",
      "64x48", "--technique", "nsm" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_TRUE(outcome.exited && outcome.code == 0) << outcome.errors;
    return readBytes(folder / "out.png");
  };
  const std::string shaded = pictureOf({ "--shade-samples", "--light-samples", "8" });
  EXPECT_NE(shaded, pictureOf({}));
  EXPECT_EQ(shaded, pictureOf({ "--shade-samples", "--light-samples", "8", "--progressive", "4" }));
  EXPECT_NE(shaded, pictureOf({ "--shade-samples", "--light-samples", "4" }));
  // Lights may say it themselves.
  const std::string lamp = "area:position=1,-1,6;target=0,0,0;shape=disk;radius=1";
  EXPECT_EQ(pictureOf({ "--shade-samples", "--light", lamp + ";light_samples=4" }),
    pictureOf({ "--shade-samples", "--light", lamp, "--light-samples", "4" }));
  EXPECT_NE(pictureOf({ "--shade-samples", "--light", lamp + ";light_samples=4" }),
    pictureOf({ "--shade-samples", "--light", lamp }));
}

//------------------------------------------------------------------------------
TEST(Program, RefusesWithoutTouchingAnOlderPicture)
{
  TestFolder folder;
  writeBytes(folder / "out.png", "older");
  EXPECT_EQ(run(folder, { "render", "kube", "-o", "out.png" }).code, 2);
  EXPECT_EQ(readBytes(folder / "out.png"), "older");
}

//------------------------------------------------------------------------------
TEST(Program, FailsWithCodeOneWhenTheDiskIsFull)
{
  TestFolder folder;
  (void)!symlink("/dev/full", (folder / "stats.json").c_str());
  const Outcome outcome =
    run(folder, { "render", "cube", "-o", "out.png", "--size", "8x8", "--stats", "stats.json" });
  EXPECT_TRUE(outcome.exited);
  EXPECT_EQ(outcome.code, 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find("stats.json"), std::string::npos) << outcome.errors;
}

//------------------------------------------------------------------------------
/// The program's files may have a limited size, which is what a full disk does to them.
TEST(Program, LeavesNoPartOfAFileOnAFullDisk)
{
  const std::vector<std::string> render = { "render", "cube", "--size", "64x48" };
  struct Case
  {
    std::string file; ///< that becomes too large
    std::vector<std::string> options;
  };
  const std::vector<Case> cases = {
    { "a.png", { "-o", "a.png" } },
    { "a.exr", { "-o", "a.exr" } },
    { "v.exr", { "-o", "null.png", "--visibility", "v.exr" } },
    { "s.json", { "-o", "null.png", "--stats", "s.json" } },
    { "c.png", { "-o", "null.png", "--technique", "silhouette", "--classes", "c.png" } },
    { "cube-0.vtp", { "scenes", "--export", "cube", "." } },
  };
  signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  for (const Case& full : cases)
  {
    for (const bool isThere : { false, true })
    {
      SCOPED_TRACE(full.file + (isThere ? " exists" : ""));
      TestFolder folder;
      std::vector<std::string> arguments = full.options;
      if (arguments[0] != "scenes")
      {
        arguments.insert(arguments.begin(), render.begin(), render.end());
        (void)!symlink("/dev/null", (folder / "null.png").c_str());
      }
      if (isThere)
      {
        writeBytes(folder / full.file, "older");
      }
      const rlimit small{ 200, before.rlim_max };
      setrlimit(RLIMIT_FSIZE, &small);
      const Outcome outcome = run(folder, arguments);
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_TRUE(outcome.exited);
      EXPECT_EQ(outcome.code, 1) << outcome.errors;
      EXPECT_NE(outcome.errors.find(full.file), std::string::npos) << outcome.errors;
      std::set<std::string> names;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      {
        names.insert(entry.path().filename().string());
      }
      for (const char* other : { "stdout.txt", "stderr.txt", "null.png" })
      {
        names.erase(other);
      }
      EXPECT_EQ(names, isThere ? std::set{ full.file } : std::set<std::string>{});
      EXPECT_EQ(readBytes(folder / full.file), isThere ? "older" : "");
    }
  }
}

//------------------------------------------------------------------------------
TEST(Program, ReplacesFilesThroughLinksAndKeepsTheirPermissions)
{
  TestFolder folder;
  writeBytes(folder / "file.png", "older");
  chmod((folder / "file.png").c_str(), 0640);
  (void)!symlink("file.png", (folder / "link.png").c_str());
  EXPECT_EQ(run(folder, { "render", "cube", "--size", "8x8", "-o", "link.png" }).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
  EXPECT_EQ(readBytes(folder / "file.png").compare(1, 3, "PNG"), 0);
  struct stat state;
  ASSERT_EQ(stat((folder / "file.png").c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777, 0640u);
}

//------------------------------------------------------------------------------
TEST(Program, FailsWithCodeOneWhenItsOutputCannotBeWritten)
{
  TestFolder folder;
  ASSERT_EQ(run(folder, { "render", "cube", "--size", "8x8", "-o", "a.png" }).code, 0);
  const std::vector<std::vector<std::string>> commands = { { "techniques" }, { "scenes" },
    { "scenes", "--hard" }, { "scenes", "--export", "cube", "." }, { "settings" },
    { "settings", "--markdown" }, { "view", "--keys" }, { "diff", "a.png", "a.png" }, { "--help" },
    { "--version" }, { "render", "--help" } };
  for (const std::vector<std::string>& arguments : commands)
  {
    const Outcome outcome = run(folder, arguments, "/dev/full");
    EXPECT_TRUE(outcome.exited);
    EXPECT_EQ(outcome.code, 1) << arguments[0];
    EXPECT_NE(outcome.errors.find("gnomon: error: standard output: "), std::string::npos)
      << arguments[0] << ": " << outcome.errors;
  }
}

//------------------------------------------------------------------------------
TEST(Program, RefusesTruncatedModels)
{
  TestFolder folder;
  for (const auto& [name, bytes] : sampleModels())
  {
    for (const double share : { 0.1, 0.3, 0.7, 0.9, 0.98 })
    {
      SCOPED_TRACE(name + " " + std::to_string(share));
      writeBytes(folder / name,
        bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
      const Outcome outcome = run(folder, { "render", name, "-o", "out.png", "--size", "8x8" });
      EXPECT_TRUE(outcome.exited);
      // A shorter .obj file may be a whole one with fewer faces.
      EXPECT_TRUE(outcome.code == 2 || (outcome.code == 0 && name == "model.obj"))
        << outcome.code << outcome.errors;
    }
  }
}

//------------------------------------------------------------------------------
TEST(Program, HelpsAndLists)
{
  TestFolder folder;
  for (const std::vector<std::string>& arguments : { std::vector<std::string>{ "--help" },
         { "render", "--help" }, { "scenes" }, { "techniques" } })
  {
    const Outcome outcome = run(folder, arguments);
    EXPECT_TRUE(outcome.exited && outcome.code == 0) << arguments[0];
    EXPECT_EQ(outcome.errors, "");
  }
  const std::string version = run(folder, { "--version" }).output;
  EXPECT_EQ(version.rfind("gnomon " GNOMON_VERSION ", VTK 9.", 0), 0u) << version;
}

} // namespace
} // namespace gnomon::tool
