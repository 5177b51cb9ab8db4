#include "SceneFile.h"
#include "../TestFiles.h"
#include "Errors.h"
#include "SampleFiles.h"
#include "Text.h"
#include "Vec3.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/Registry.h"

#include <array>
#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkPointData.h>

#include <algorithm>
#include <map>

namespace gnomon::tool
{
namespace
{

using Settings = std::map<std::string, std::string>;

class SceneFile : public ::testing::Test
{
protected:
  SceneFile()
  {
    writeBytes(this->folder / "model.obj", sampleFile("model.obj"));
    writeBytes(this->folder / "textured.obj", sampleFile("textured.obj"));
    writeBytes(this->folder / "t.png", sampleFile("picture.png"));
  }

  Scene load(const nlohmann::json& document)
  {
    writeBytes(this->folder / "scene.json", document.dump());
    return loadScene(this->folder / "scene.json");
  }

  TestFolder folder;
};

/// A scene file with every key.
nlohmann::json fullScene()
{
  return nlohmann::json::parse(R"({
    "camera": {"position": [3, 4, 5], "target": [0, 1, 0], "up": [0, 1, 0.5], "fov": 45},
    "models": [{"file": "model.obj", "matrix": [2,0,0,10, 0,2,0,20, 0,0,2,30, 0,0,0,1],
                "color": [1, 0.5, 0.25], "casts": false, "receives": false, "one_sided": true},
               {"file": "textured.obj", "matrix": [1,0,0,0.3, 0,1,0,0, 0,0,1,0, 0,0,0,1],
                "color": [1, 1, 1], "casts": true, "receives": true, "one_sided": false,
                "texture": "t.png"}],
    "lights": [{"type": "directional", "direction": [0, -1, 0], "color": [1, 0.5, 0],
                "intensity": 2, "technique": "raytraced", "map_size": 512},
               {"type": "spot", "position": [1, 2, 3], "target": [0, 0, 0], "cone_angle": 25,
                "color": [1, 1, 1], "intensity": 1, "technique": "pcf", "kernel": "box",
                "kernel_size": 5},
               {"type": "point", "position": [1, 2, 3], "color": [1, 1, 1], "intensity": 3},
               {"type": "directional", "direction": [0, -1, 0], "color": [1, 1, 1], "intensity": 1,
                "box": {"position": [1, 2, 3], "up": [1, 0, 0], "width": 4, "height": 5,
                        "depth": 6}},
               {"type": "area", "position": [1, 2, 3], "target": [0, 0, 0], "shape": "rectangle",
                "width": 1, "height": 2, "up": [0, 0, 1], "texture": "t.png", "color": [1, 1, 1],
                "intensity": 1, "light_samples": 16},
               {"type": "area", "position": [1, 2, 3], "target": [0, 0, 0], "shape": "disk",
                "radius": 0.5, "cone_angle": 40, "color": [1, 1, 1], "intensity": 1},
               {"type": "area", "position": [1, 2, 3], "target": [0, 0, 0], "shape": "disk",
                "radius": 0.5, "up": [0, 0, 1], "texture": "t.png", "color": [1, 1, 1],
                "intensity": 1}],
    "background": [0.25, 0.5, 0.75], "sky": 0.5, "glass": true})");
}

TEST_F(SceneFile, PlacesAModelAfterTheMatricesOfItsFile)
{
  writeBytes(this->folder / "m.gltf", sampleGltfWithBuffer().dump()); // moved by (0, 0, 1)
  nlohmann::json document = fullScene();
  document["models"][0]["file"] = "m.gltf";
  const std::array<double, 16> placed{ 2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 32, 0, 0, 0, 1 };
  EXPECT_EQ(this->load(document).models[0].matrix, placed);
}

TEST_F(SceneFile, IsExportedAsItWasRead)
{
  for (const char* camera : { "fov", "parallel_scale" })
  {
    nlohmann::json document = fullScene();
    document["camera"].erase("fov");
    document["camera"][camera] = 1.5;
    const Scene scene = this->load(document);
    EXPECT_EQ(scene.name, "scene");
    nlohmann::json exported =
      nlohmann::json::parse(readBytes(exportScene(scene, this->folder / "made")));
    for (const char* list : { "models", "lights" })
    {
      ASSERT_EQ(exported[list].size(), document[list].size());
      for (std::size_t i = 0; i < exported[list].size(); ++i)
      {
        for (const char* file : { "file", "texture" })
        {
          if (exported[list][i].contains(file))
          {
            EXPECT_TRUE(std::filesystem::exists(
              this->folder / ("made/" + exported[list][i][file].get<std::string>())));
            exported[list][i][file] = document[list][i][file];
          }
        }
        EXPECT_EQ(exported[list][i], document[list][i]);
      }
    }
    EXPECT_EQ(exported, document);
  }
}

TEST(SceneExport, KeepsTheHolesOfTextures)
{
  const TestFolder folder;
  const Scene scene = loadScene("screens");
  const Scene read = loadScene(exportScene(scene, folder.path()));
  const auto bytesOf = [](vtkDataArray* array)
  {
    return std::string(static_cast<const char*>(array->GetVoidPointer(0)),
      static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize()));
  };
  ASSERT_EQ(read.models.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    ASSERT_TRUE(scene.models[i].texture && read.models[i].texture);
    EXPECT_EQ(bytesOf(read.models[i].texture->GetInput()->GetPointData()->GetScalars()),
      bytesOf(scene.models[i].texture->GetInput()->GetPointData()->GetScalars()));
    EXPECT_EQ(bytesOf(read.models[i].surface->GetPointData()->GetTCoords()),
      bytesOf(scene.models[i].surface->GetPointData()->GetTCoords()));
  }
  EXPECT_FALSE(read.models[2].texture);
}

TEST_F(SceneFile, BecomesARenderer)
{
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(this->load(fullScene()), 1.0);
  EXPECT_FALSE(renderer->GetAutomaticLightCreation());
  EXPECT_DOUBLE_EQ(renderer->GetActiveCamera()->GetViewAngle(), 45.0);
  ASSERT_EQ(renderer->GetActors()->GetNumberOfItems(), 2);
  auto* actor = vtkActor::SafeDownCast(renderer->GetActors()->GetItemAsObject(0));
  EXPECT_FALSE(vtkGnomonPropKeys::GetCasts(actor));
  EXPECT_FALSE(vtkGnomonPropKeys::GetReceives(actor));
  EXPECT_TRUE(vtkGnomonPropKeys::GetOneSided(actor));
  EXPECT_DOUBLE_EQ(actor->GetBounds()[0], 8.0);
  EXPECT_DOUBLE_EQ(actor->GetBounds()[3], 24.0);
  vtkTexture* const texture = renderer->GetActors()->GetLastActor()->GetTexture();
  EXPECT_FALSE(texture->GetInterpolate());
  EXPECT_TRUE(texture->GetRepeat());

  std::vector<vtkLight*> lights;
  for (int i = 0; i < renderer->GetLights()->GetNumberOfItems(); ++i)
  {
    lights.push_back(vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(i)));
    EXPECT_TRUE(lights.back()->LightTypeIsSceneLight());
    EXPECT_EQ(lights.back()->GetPositional(), i == 0 || i == 3 ? 0 : 1) << i;
  }
  ASSERT_EQ(lights.size(), 7u);
  EXPECT_DOUBLE_EQ(lights[0]->GetIntensity(), 2.0);
  EXPECT_STREQ(vtkGnomonLightKeys::GetSetting(lights[0], "technique"), "raytraced");
  EXPECT_STREQ(vtkGnomonLightKeys::GetSetting(lights[0], "map_size"), "512");
  EXPECT_DOUBLE_EQ(lights[1]->GetConeAngle(), 25.0);
  EXPECT_EQ(vtkGnomonLightKeys::GetSetting(lights[2], "technique"), nullptr);
  EXPECT_GE(lights[2]->GetConeAngle(), 90.0);
  const double* box = lights[3]->GetInformation()->Get(vtkGnomonLightKeys::BOX());
  EXPECT_EQ(std::vector<double>(box, box + 6), std::vector<double>({ 4, 5, 6, 1, 0, 0 }));
  EXPECT_DOUBLE_EQ(lights[3]->GetPosition()[1], 2.0);
  auto* disk = vtkGnomonAreaLight::SafeDownCast(lights[5]);
  EXPECT_EQ(disk->GetShape(), vtkGnomonAreaLight::DISK);
  EXPECT_EQ(disk->GetRadius(), 0.5);
  EXPECT_EQ(disk->GetConeAngle(), 40.0);
  disk = vtkGnomonAreaLight::SafeDownCast(lights[6]);
  EXPECT_EQ(disk->GetUp()[2], 1.0);
  EXPECT_EQ(disk->GetTexture()->GetDimensions()[0], 8);
}

/// Of three plates, the second is beside a perspective camera's picture, and in a parallel one's.
/// The third lies behind the camera.
TEST_F(SceneFile, ClippingPlanesEncloseWhatIsInThePicture)
{
  writeBytes(this->folder / "model.obj",
    "v -1 -1 -7\nv 1 -1 -7\nv 0 1 -7\nf 1 2 3\nv 3 -1 -2\nv 4 -1 -2\nv 3 1 -2\nf 4 5 6\n"
    "v -1 -1 5\nv 1 -1 5\nv 0 1 5\nf 7 8 9\n");
  const auto rangeOf = [&](const nlohmann::json& target, const char* key, double value)
  {
    nlohmann::json document = sampleScene();
    document["models"][0].erase("matrix");
    document["camera"] = { { "position", { 0, 0, 0 } }, { "target", target }, { key, value } };
    const auto renderer = makeRenderer(this->load(document), 1.0);
    const double* range = renderer->GetActiveCamera()->GetClippingRange();
    return std::pair(range[0], range[1]);
  };
  const auto perspective = rangeOf({ 0, 0, -1 }, "fov", 60);
  EXPECT_NEAR(perspective.first, 7.0, 0.1);
  EXPECT_NEAR(perspective.second, 7.0, 0.1);
  const auto parallel = rangeOf({ 0, 0, -1 }, "parallel_scale", 5);
  EXPECT_NEAR(parallel.first, 2.0, 0.1);
  EXPECT_NEAR(parallel.second, 7.0, 0.1);
  const auto nothing = rangeOf({ 1, 0, 0 }, "fov", 10);
  EXPECT_GT(nothing.first, 1e-3);
  EXPECT_GT(nothing.second, 10.0 * nothing.first);
}

TEST_F(SceneFile, SaysWhatIsWrongAndWhere)
{
  struct Case
  {
    const char* place;       // a JSON pointer
    nlohmann::json value;    // what stands there instead; null takes it away
    const char* path;        // what the message must name
    const char* expectation; // and what it must say
  };
  const nlohmann::json null;
  const auto with = [](nlohmann::json object, const nlohmann::json& changes)
  {
    object.update(changes);
    return object;
  };
  const auto box = [&](const nlohmann::json& changes)
  {
    return with({ { "position", { 1, 2, 3 } }, { "up", { 0, 1, 0 } }, { "width", 4 },
                  { "height", 5 }, { "depth", 6 } },
      changes);
  };
  const auto point = [&](const nlohmann::json& changes) {
    return with({ { "type", "point" }, { "position", { 1, 2, 3 } } }, changes);
  };
  const auto area = [&](const nlohmann::json& changes)
  {
    return with({ { "type", "area" }, { "position", { 1, 2, 3 } }, { "target", { 0, 0, 0 } },
                  { "width", 1 }, { "height", 2 } },
      changes);
  };
  const auto disk = [&](const nlohmann::json& changes)
  {
    return with({ { "type", "area" }, { "position", { 1, 2, 3 } }, { "target", { 0, 0, 0 } },
                  { "shape", "disk" }, { "radius", 2 } },
      changes);
  };
  const std::string techniques = "one of: " + gnomon::techniqueNames();
  const std::vector<Case> cases = {
    { "/camra", 1, "", "unknown key \"camra\"" },
    { "/camera/fov", 180, "camera.fov", "found 180, expected a number between" },
    { "/camera/fov", "45", "camera.fov", "found \"45\", expected a number" },
    { "/camera/up", { 0, 0, 0 }, "camera.up", "not zero" },
    { "/camera/up", { -3, -3, -5 }, "camera.up", "not parallel" },
    { "/camera/target", { 3, 4, 5 }, "camera.target", "not the position" },
    { "/camera/target", null, "camera.target", "missing, expected an array of 3 numbers" },
    { "/camera/position", { 1, 2 }, "camera.position", "expected an array of 3 numbers" },
    { "/camera/position", { 1, 2, 1e31 }, "camera.position", "between -1e+30 and 1e+30" },
    { "/camera/parallel_scale", 2, "camera.fov", "means nothing" },
    { "/ambient", 1.5, "ambient", "found 1.5, expected a number between 0 and 1" },
    { "/sky", -0.5, "sky", "found -0.5, expected a number between 0 and" },
    { "/glass", 1, "glass", "true or false" },
    { "/ground", "yes", "ground", "true or false" },
    { "/models", nlohmann::json::array(), "models", "at least one model" },
    { "/models", null, "models", "missing, expected an array" },
    { "/models/0", 7, "models[0]", "expected an object" },
    { "/models/0/file", "gone.obj", "models[0].file", "no such file" },
    { "/models/0/file", "model.xyz", "models[0].file", "expected one of: .3ds" },
    { "/models/0/matrix/0", 0, "models[0].matrix", "can be inverted" },
    { "/models/0/matrix/15", 2, "models[0].matrix", "last row" },
    { "/models/0/matrix", { 1, 2, 3 }, "models[0].matrix", "array of 16 numbers" },
    { "/models/0/color", { 1, 2, 1 }, "models[0].color", "between 0 and 1" },
    { "/models/0/texture", "t.png", "models[0].texture", "obj: has no texture coordinates" },
    { "/models/0/texture", 3, "models[0].texture", "expected a text" },
    { "/models/0/texture", "gone.png", "models[0].texture", "no such file" },
    { "/models/0/texture", "model.obj", "models[0].texture", "not a PNG or JPEG image" },
    { "/models/0/casts", "yes", "models[0].casts", "true or false" },
    { "/lights", 3, "lights", "expected an array" },
    { "/lights/0/type", "laser", "lights[0].type", "one of: directional, spot" },
    { "/lights/0/type", null, "lights[0].type", "missing" },
    { "/lights/0/direction", { 0, 0, 0 }, "lights[0].direction", "not zero" },
    { "/lights/0/technique", "magic", "lights[0].technique", techniques.c_str() },
    { "/lights/0/map_size", 8, "lights[0].map_size", "whole number between 16 and 16384" },
    { "/lights/0/map_size", 512.5, "lights[0].map_size", "whole number" },
    { "/lights/0/kernel", "magic", "lights[0].kernel", "one of: bilinear, box, poisson, castano" },
    { "/lights/0/kernel_size", 0, "lights[0].kernel_size", "whole number between 1 and 32" },
    { "/lights/0/intensity", -1, "lights[0].intensity", "between 0" },
    { "/lights/0/box", 7, "lights[0].box", "expected an object" },
    { "/lights/0/box", box({ { "depth", 0 } }), "lights[0].box.depth", "found 0, expected" },
    { "/lights/0/box", box({ { "width", -1 } }), "lights[0].box.width", "found -1, expected" },
    { "/lights/0/box", box({ { "height", "NaN" } }), "lights[0].box.height", "found \"NaN\"" },
    { "/lights/0/box", box({ { "depth", 1e300 } }), "lights[0].box.depth", "expected a number" },
    { "/lights/0/box", box({ { "up", { 0, 0, 0 } } }), "lights[0].box.up", "not zero" },
    { "/lights/0/box", box({ { "position", { 1, 2 } } }), "lights[0].box.position", "3 numbers" },
    { "/lights/0/box", { { "width", 4 } }, "lights[0].box.position", "missing" },
    { "/lights/0/box", box({ { "up", { -2, 4, -4 } } }), "lights[0].box.up", "not parallel" },
    { "/lights/0/box", box({ { "length", 3 } }), "lights[0].box", "unknown key \"length\"" },
    { "/lights/0", point({ { "position", nullptr } }), "lights[0].position", "3 numbers" },
    { "/lights/0", point({ { "position", { 1, "inf", 3 } } }), "lights[0].position", "\"inf\"" },
    { "/lights/0", point({ { "position", { 0, 0, -1e300 } } }), "lights[0].position", "between" },
    { "/lights/0", point({ { "box", box(nlohmann::json::object()) } }), "lights[0]",
      "unknown key \"box\"" },
    { "/lights/0", point({ { "cone_angle", 30 } }), "lights[0]", "unknown key \"cone_angle\"" },
    { "/lights/0", point({ { "intensity", -1 } }), "lights[0].intensity", "between 0" },
    { "/lights/0", point({ { "color", { 0, 0, 2 } } }), "lights[0].color", "between 0 and 1" },
    { "/lights/1/box", box(nlohmann::json::object()), "lights[1]", "unknown key \"box\"" },
    { "/lights/1/cone_angle", 95, "lights[1].cone_angle", "found 95, expected a number" },
    { "/lights/1/direction", { 0, 0, 1 }, "lights[1]", "unknown key \"direction\"" },
    { "/background", { 0.5 }, "background", "array of 3 numbers" },
    { "/lights/0", point({ { "target", { 0, 0, 0 } } }), "lights[0]", "unknown key \"target\"" },
    { "/lights/0", point({ { "texture", "t.png" } }), "lights[0]", "unknown key \"texture\"" },
    { "/lights/0", area({ { "width", 0 } }), "lights[0].width", "found 0" },
    { "/lights/0", area({ { "up", { 1, 2, 3 } } }), "lights[0].up", "not parallel" },
    { "/lights/0", area({ { "shape", "star" } }), "lights[0].shape", "one of: rectangle, disk" },
    { "/lights/0", area({ { "radius", 1 } }), "lights[0]", "unknown key \"radius\"" },
    { "/lights/0", area({ { "cone_angle", 90 } }), "lights[0].cone_angle", "found 90" },
    { "/lights/0", area({ { "target", { 1, 2, 3 } } }), "lights[0].target", "not the position" },
    { "/lights/0", area({ { "texture", 3 } }), "lights[0].texture", "expected a text" },
    { "/lights/0", area({ { "texture", "gone.png" } }), "lights[0].texture", "no such file" },
    { "/lights/0", area({ { "texture", "scene.json" } }), "lights[0].texture", "not a PNG or" },
    { "/lights/0", disk({ { "height", 1 } }), "lights[0]", "unknown key \"height\"" },
    { "/lights/0", disk({ { "radius", "wide" } }), "lights[0].radius", "found \"wide\"" },
    { "/lights/0", disk({ { "up", { 0, 1, 0 } } }), "lights[0]", "unknown key \"up\"" },
  };
  for (const Case& wrong : cases)
  {
    nlohmann::json document = sampleScene();
    const nlohmann::json::json_pointer place(wrong.place);
    if (wrong.value.is_null())
    {
      document.at(place.parent_pointer()).erase(place.back());
    }
    else
    {
      document[place] = wrong.value;
    }
    const std::string message = messageOf<BadInput>([&] { this->load(document); });
    const std::string path = *wrong.path ? std::string(wrong.path) + ": " : "";
    EXPECT_NE(message.find("scene.json: " + path), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.expectation), std::string::npos) << message;
  }
}

TEST_F(SceneFile, WithoutCameraAndLightsIsFramedAndLit)
{
  nlohmann::json document = sampleScene();
  document.erase("camera");
  document.erase("lights");
  const Scene scene = this->load(document);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_LT(length(scene.camera.target - Vec3{ 10, 22, 30 }), 1e-6);
  document["lights"] = nlohmann::json::array();
  EXPECT_TRUE(this->load(document).lights.empty());
}

TEST(SceneSpecs, LightsHaveASceneFilesKeys)
{
  const SceneLight sun =
    parseLight("directional:direction=0,-2,0;color=1,0.5,0;intensity=3;technique=nsm;map_size=64");
  EXPECT_EQ(sun.type, SceneLight::Type::Directional);
  EXPECT_EQ(sun.target - sun.position, (Vec3{ { 0, -1, 0 } }));
  EXPECT_DOUBLE_EQ(sun.intensity, 3.0);
  EXPECT_EQ(sun.settings, (Settings{ { "map_size", "64" }, { "technique", "nsm" } }));
  const SceneLight spot = parseLight(
    "spot:position=1,2,3;target=0,0,0;cone_angle=12.5;technique=pcf;kernel=box;kernel_size=5");
  EXPECT_EQ(spot.settings,
    (Settings{ { "kernel", "box" }, { "kernel_size", "5" }, { "technique", "pcf" } }));
  EXPECT_EQ(spot.type, SceneLight::Type::Spot);
  EXPECT_DOUBLE_EQ(spot.coneAngleDegrees, 12.5);
  const SceneLight lamp = parseLight("point:position=1,2,3;color=1,0.5,0");
  EXPECT_EQ(lamp.type, SceneLight::Type::Point);
  EXPECT_EQ(lamp.position, (Vec3{ { 1, 2, 3 } }));
}

TEST(SceneSpecs, CamerasTakeTheRestFromTheScene)
{
  SceneCamera defaults;
  defaults.position = { { 0, 0, 9 } };
  defaults.fovDegrees = 50.0;
  const SceneCamera camera = parseCamera("target=1,0,0;up=1,0,0", defaults);
  EXPECT_EQ(camera.position, defaults.position);
  EXPECT_EQ(camera.target, (Vec3{ { 1, 0, 0 } }));
  EXPECT_EQ(camera.up, (Vec3{ { 1, 0, 0 } }));
  EXPECT_DOUBLE_EQ(camera.fovDegrees, 50.0);
}

/// The page's examples are one scene, and two more lights.
TEST_F(SceneFile, PageOfTheFormatShowsWhatIsRead)
{
  const std::string page = tool::readBytes(GNOMON_SOURCE_DIR "/docs/guide/scene_files.md");
  std::vector<std::string> examples = split(page, '`');
  examples.erase(std::remove_if(examples.begin(), examples.end(),
                   [](const std::string& text) { return text.rfind("json\n", 0) != 0; }),
    examples.end());
  ASSERT_EQ(examples.size(), 1u);
  const nlohmann::json document = nlohmann::json::parse(examples[0].substr(5));
  writeBytes(this->folder / "bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  writeBytes(this->folder / "screen.obj", sampleFile("textured.obj"));
  writeBytes(this->folder / "lattice.png", sampleFile("picture.png"));
  const Scene scene = this->load(document);
  EXPECT_EQ(scene.models.size(), 3u); // with the ground
  EXPECT_EQ(scene.lights.size(), document["lights"].size());
}

} // namespace
} // namespace gnomon::tool
