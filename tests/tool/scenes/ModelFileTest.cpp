#include "ModelFile.h"

#include "../TestFiles.h"
#include "Errors.h"
#include "ReadGuarded.h"
#include "SampleFiles.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <thread>

namespace gnomon::tool
{
namespace
{

vtkIdType countTriangles(const Model& model)
{
  vtkIdType count = 0;
  for (const SceneModel& surface : model.surfaces)
  {
    count += surface.surface->GetNumberOfPolys();
  }
  return count;
}

Scene sceneOf(const Model& model)
{
  Scene scene;
  scene.models = model.surfaces;
  return scene;
}

class ModelFile : public testing::Test
{
protected:
  Model read(const std::string& name, const std::string& bytes)
  {
    writeBytes(this->folder / name, bytes);
    return readModelFile(this->folder / name);
  }

  TestFolder folder;
};

TEST_F(ModelFile, ReadsTheSamePyramidFromEveryType)
{
  std::map<std::string, std::string> models = sampleModels();
  models["CAPITALS.OBJ"] = sampleFile("model.obj");
  for (const auto& [name, bytes] : models)
  {
    SCOPED_TRACE(name);
    const Model model = this->read(name, bytes);
    EXPECT_EQ(countTriangles(model), 6);
    // The glTF document moves its mesh by a unit.
    const double shift = name.find("model.gl") == 0 ? 1.0 : 0.0;
    const std::array<double, 6> bounds = boundsWorld(sceneOf(model));
    const std::array<double, 6> expected{ { -1.0, 1.0, 0.0, 2.0, -1.0 + shift, 1.0 + shift } };
    for (std::size_t i = 0; i < 6; ++i)
    {
      EXPECT_FLOAT_EQ(static_cast<float>(bounds[i]), static_cast<float>(expected[i]));
    }
    for (const SceneModel& surface : model.surfaces)
    {
      EXPECT_TRUE(surface.surface->GetPointData()->GetNormals());
      EXPECT_TRUE(surface.property);
    }
  }
}

TEST_F(ModelFile, ObjMaterialsBecomeSurfacesWithColourAndTexture)
{
  writeBytes(this->folder / "t.png", sampleFile("picture.png"));
  writeBytes(this->folder / "m.mtl",
    "newmtl red\nKd 1 0.25 0\nmap_Kd t.png\n\nnewmtl glass\nKd 0 0 1\nKs 0.5 0.5 0.5\nNs 20\nd "
    "0.5");
  const Model model = this->read("m.obj",
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "usemtl red\nf 1/1 2/2 3/3\nusemtl glass\nf -4/-3 -2/-2 -1/-1\nf 1/1 2/2 4/3\n");
  ASSERT_EQ(model.surfaces.size(), 2u);
  const SceneModel& red = model.surfaces[0];
  const SceneModel& glass = model.surfaces[1];
  EXPECT_EQ(red.name, "m:red");
  EXPECT_EQ(red.surface->GetNumberOfPolys(), 1);
  EXPECT_DOUBLE_EQ(red.property->GetDiffuseColor()[1], 0.25);
  ASSERT_TRUE(red.texture);
  EXPECT_EQ(red.texture->GetInput()->GetDimensions()[0], 8);
  ASSERT_TRUE(red.surface->GetPointData()->GetTCoords());
  EXPECT_EQ(glass.surface->GetNumberOfPolys(), 2);
  EXPECT_DOUBLE_EQ(glass.property->GetOpacity(), 0.5);
  EXPECT_DOUBLE_EQ(glass.property->GetSpecularPower(), 20.0);
  EXPECT_FALSE(glass.texture);
  EXPECT_TRUE(model.notes.empty());
}

TEST_F(ModelFile, GltfMaterialAndTextureAreKept)
{
  const Model model = this->read("m.glb", makeGlb(sampleGltf(), sampleFile("buffer.bin")));
  ASSERT_EQ(model.surfaces.size(), 1u);
  vtkProperty* property = model.surfaces[0].property;
  EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
  EXPECT_DOUBLE_EQ(property->GetMetallic(), 0.125);
  EXPECT_DOUBLE_EQ(property->GetRoughness(), 0.75);
  EXPECT_DOUBLE_EQ(property->GetDiffuseColor()[2], 0.25);
  EXPECT_TRUE(property->GetTexture("albedoTex"));
  // Vertex 2 lies at (1, 0, 1) with texture row 0.5 from the top.
  EXPECT_FLOAT_EQ(
    static_cast<float>(model.surfaces[0].surface->GetPointData()->GetTCoords()->GetTuple2(2)[1]),
    0.5f);
  // Vertex 0 lies at the first row from the top, which is VTK's last.
  EXPECT_FLOAT_EQ(
    static_cast<float>(model.surfaces[0].surface->GetPointData()->GetTCoords()->GetTuple2(0)[1]),
    1.0f);
}

TEST_F(ModelFile, GltfCameraAndLightsStandWhereTheirNodesAre)
{
  const Model model = this->read("m.gltf", sampleGltfWithBuffer().dump());
  ASSERT_TRUE(model.camera);
  EXPECT_LT(length(model.camera->position - Vec3{ 0, 1, 9 }), 1e-9);
  // The target lies as far away as the middle of the pyramid, (0, 1, 1).
  EXPECT_LT(length(model.camera->target - Vec3{ 0, 1, 1 }), 1e-9);
  EXPECT_NEAR(model.camera->fovDegrees, 40.107, 1e-3);

  ASSERT_EQ(model.lights.size(), 2u);
  const SceneLight& spot = model.lights[0];
  EXPECT_EQ(spot.type, SceneLight::Type::Spot);
  EXPECT_LT(length(spot.position - Vec3{ 0, 7, 1 }), 1e-9);
  EXPECT_LT(length(spot.target - Vec3{ 0, 6, 1 }), 1e-6); // straight down
  EXPECT_NEAR(spot.coneAngleDegrees, 28.648, 1e-3);
  EXPECT_NEAR(spot.intensity, 72.0 / 36.0, 1e-9); // 6 units above the middle
  const SceneLight& sun = model.lights[1];
  EXPECT_EQ(sun.type, SceneLight::Type::Directional);
  EXPECT_LT(length(sun.target - sun.position - Vec3{ 0, -1, 0 }), 1e-6);
  EXPECT_EQ(sun.color, (Vec3{ 1, 0.5, 0.25 }));
  EXPECT_DOUBLE_EQ(sun.intensity, 2.0);
}

TEST_F(ModelFile, ABareModelGetsAGroundACameraAndALight)
{
  writeBytes(this->folder / "m.obj", sampleFile("model.obj"));
  const Scene scene = loadScene(this->folder / "m.obj");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, SceneLight::Type::Directional);
  const Vec3 travel = scene.lights[0].target - scene.lights[0].position;
  EXPECT_GT(travel[0], 0.0); // from the left,
  EXPECT_LT(travel[1], 0.0); // from above,
  EXPECT_LT(travel[2], 0.0); // from the front
  EXPECT_LT(length(scene.camera.target - Vec3{ 0, 1, 0 }), 1e-6);
  ASSERT_EQ(scene.models.size(), 2u);
  const double* ground = scene.models[1].surface->GetBounds();
  const double* model = scene.models[0].surface->GetBounds();
  EXPECT_DOUBLE_EQ(ground[0], 4.0 * model[0]);
  EXPECT_DOUBLE_EQ(ground[5], 4.0 * model[5]);
  EXPECT_LT(ground[3], model[2]); // a floor of the model's own hides it
  EXPECT_NEAR(ground[3], model[2], 0.001);
}

/// VTK's importers give materials without ambient light, and files with lights of their own are lit
/// by those.
TEST_F(ModelFile, ABareModelGetsAmbientLightWithItsLight)
{
  nlohmann::json document = sampleGltfWithBuffer();
  for (const double expected : { 0.0, 0.2 })
  {
    writeBytes(this->folder / "m.gltf", document.dump());
    EXPECT_EQ(loadScene(this->folder / "m.gltf").models[0].property->GetAmbient(), expected);
    document["scenes"][0]["nodes"] = { 0, 1 }; // the others are the lights
  }
}

TEST_F(ModelFile, GltfMayHaveOtherCamerasAndLights)
{
  nlohmann::json document = sampleGltfWithBuffer();
  document["cameras"][0] = { { "type", "orthographic" },
    { "orthographic", { { "xmag", 3 }, { "ymag", 2 }, { "znear", 0.1 }, { "zfar", 50 } } } };
  document["nodes"][1] = { { "scale", { 2, 2, 2 } }, { "translation", { 10, 0, 0 } },
    { "children", { 4 } } };
  document["nodes"].push_back({ { "camera", 0 }, { "translation", { 1, 2, 3 } } });
  document["extensions"]["KHR_lights_punctual"]["lights"][0] = { { "type", "point" },
    { "intensity", 72 }, { "color", { 1, 0.5, 0.25 } } };
  const Model model = this->read("m.gltf", document.dump());
  ASSERT_TRUE(model.camera);
  EXPECT_EQ(model.camera->parallelScale, 2.0);
  EXPECT_LT(length(model.camera->position - Vec3{ 12, 4, 6 }), 1e-9);
  ASSERT_EQ(model.lights.size(), 2u);
  const SceneLight& lamp = model.lights[0];
  EXPECT_EQ(lamp.type, SceneLight::Type::Point);
  EXPECT_LT(length(lamp.position - Vec3{ 0, 7, 1 }), 1e-9);
  EXPECT_NEAR(lamp.intensity, 72.0 / 36.0, 1e-9); // 6 units above the middle
  EXPECT_EQ(lamp.color, (Vec3{ 1, 0.5, 0.25 }));
}

TEST_F(ModelFile, NotesLeftOutParts)
{
  const auto withNan = [](std::string bytes, std::size_t place)
  {
    const float nan = std::nanf("");
    std::memcpy(bytes.data() + place, &nan, sizeof(nan));
    return bytes;
  };
  const std::string ply = sampleFile("little.ply");
  // The last vertex's last coordinate, in front of 6 faces of 13 bytes.
  const Model model = this->read("m.ply", withNan(ply, ply.size() - 6 * 13 - 4));
  EXPECT_DOUBLE_EQ(boundsWorld(sceneOf(model))[3], 0.0); // the tip, at height 2, does not count
  const std::pair<Model, const char*> cases[] = {
    { model, "1 vertices are not finite" },
    { this->read("m.stl", withNan(sampleFile("binary.stl"), 84 + 12)), "1 vertices" },
    { this->read("m.obj", sampleFile("model.obj") + "l 1 2 3\np 1\n"), "points and lines" },
    { this->read("n.obj", "mtllib gone.mtl\nusemtl red\n" + sampleFile("model.obj")), "gone.mtl" },
  };
  for (const auto& [read, note] : cases)
  {
    EXPECT_EQ(countTriangles(read), 6);
    EXPECT_EQ(read.surfaces[0].surface->GetNumberOfLines(), 0);
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_NE(read.notes[0].find(note), std::string::npos) << read.notes[0];
  }
}

volatile int zero = 0;

int recurse(int depth)
{
  volatile char page[4096];
  page[depth % 4096] = static_cast<char>(depth);
  return depth < 0 ? 0 : recurse(depth + 1) + page[(depth + 1) % 4096];
}

void inThread(const std::function<void()>& work)
{
  std::thread(work).join();
}

struct Ending
{
  const char* name;
  std::function<void()> read;
};

void PrintTo(const Ending& ending, std::ostream* stream)
{
  *stream << ending.name;
}

class ReadersEnd : public ::testing::TestWithParam<Ending>
{
};

TEST_P(ReadersEnd, AsOneLineAndExitCodeTwo)
{
  const auto read = []
  { readGuarded("outer.obj", 100, [] { readGuarded("damaged.vtp", 100, GetParam().read); }); };
  // All that it writes is that line.
  EXPECT_EXIT(read(), ::testing::ExitedWithCode(badInputCode),
    "^gnomon: error: damaged.vtp: the file is damaged[^\n]*\n$");
}

INSTANTIATE_TEST_SUITE_P(Tool, ReadersEnd,
  ::testing::Values(Ending{ "segmentation", [] { raise(SIGSEGV); } },
    Ending{ "division", [] { zero = 7 / zero; } }, //
    Ending{ "bus", [] { raise(SIGBUS); } },        //
    Ending{ "abort", [] { std::abort(); } },
    Ending{ "freedTwice",
      []
      {
        void* volatile memory = std::malloc(2000);
        std::free(memory);
        std::free(memory);
      } },
    Ending{ "recursion", [] { recurse(0); } }, //
    Ending{ "endlessLoop",
      []
      {
        for (;;)
        {
          zero = 0;
        }
      } },
    Ending{ "crashOfAThread", [] { inThread([] { raise(SIGSEGV); }); } },
    Ending{ "exceptionOfAThread", [] { inThread([] { throw std::bad_alloc(); }); } },
    Ending{ "chatter",
      []
      {
        for (;;)
        {
          std::fprintf(stderr, "unexpected end of file\n");
        }
      } }),
  [](const ::testing::TestParamInfo<Ending>& ending) { return ending.param.name; });

TEST(ReadGuarded, RefusesWhatAReaderThrowsAndPrints)
{
  const auto messageFor = [](const std::function<void()>& read)
  { return messageOf<BadInput>([&] { readGuarded("m.ply", 100, read); }); };
  EXPECT_EQ(messageFor([] { throw BadInput("no"); }), "m.ply: no");
  EXPECT_EQ(messageFor([] { throw BadInput("m.ply: line 3"); }), "m.ply: line 3");
  EXPECT_EQ(messageFor([] { vtkGenericWarningMacro("ignored"); }), "(nothing was thrown)");
  EXPECT_EQ(messageFor([] { std::fprintf(stderr, "Warning: odd\n"); }), "(nothing was thrown)");
  EXPECT_EQ(messageFor([] { std::fprintf(stderr, "Warning: odd\nlost\n"); }), "m.ply: lost");
  // Counts that the file cannot hold.
  const std::string damaged = "m.ply: the file is damaged";
  EXPECT_EQ(messageFor([] { vtkNew<vtkFloatArray>()->SetNumberOfTuples(vtkIdType(1) << 34); })
              .rfind(damaged, 0),
    0u);
}

TEST(ReadGuarded, LeavesTheProcessAsItWas)
{
  rlimit before;
  getrlimit(RLIMIT_DATA, &before);
  readGuarded("m.ply", 100, [] {});
  rlimit after;
  getrlimit(RLIMIT_DATA, &after);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
  EXPECT_EXIT(raise(SIGFPE), ::testing::KilledBySignal(SIGFPE), "");
  EXPECT_EXIT(std::abort(), ::testing::KilledBySignal(SIGABRT), "");
  testing::internal::CaptureStderr();
  std::fprintf(stderr, "heard");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "heard");
}

} // namespace
} // namespace gnomon::tool
