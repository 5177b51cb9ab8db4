#include "../TestFiles.h"
#include "Errors.h"
#include "SampleFiles.h"
#include "Scene.h"
#include "Text.h"
#include "Vec3.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/Registry.h"

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
  SceneFile() { writeBytes(this->folder / "model.obj", sampleObj()); }

  Scene load(const nlohmann::json& document)
  {
    writeBytes(this->folder / "scene.json", document.dump());
    return loadScene(this->folder / "scene.json");
  }

  TestFolder folder;
};

//------------------------------------------------------------------------------
TEST_F(SceneFile, IsReadInFull)
{
  const Scene scene = this->load(sampleScene());
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.camera.position, (Vec3{ { 3, 4, 5 } }));
  EXPECT_EQ(scene.camera.target, (Vec3{ { 0, 1, 0 } }));
  EXPECT_DOUBLE_EQ(scene.camera.fovDegrees, 45.0);
  EXPECT_EQ(scene.background, (Vec3{ { 0.25, 0.5, 0.75 } }));

  ASSERT_EQ(scene.models.size(), 1u);
  const SceneModel& model = scene.models[0];
  EXPECT_DOUBLE_EQ(model.matrix[0], 2.0);
  EXPECT_DOUBLE_EQ(model.matrix[7], 20.0);
  EXPECT_DOUBLE_EQ(model.property->GetDiffuseColor()[1], 0.5);
  EXPECT_FALSE(model.casts);
  EXPECT_FALSE(model.receives);
  EXPECT_TRUE(model.oneSided);

  ASSERT_EQ(scene.lights.size(), 2u);
  const SceneLight& sun = scene.lights[0];
  EXPECT_EQ(sun.type, SceneLight::Type::Directional);
  EXPECT_LT(length(sun.target - sun.position - (1.0 / 3.0) * Vec3{ { 1, -2, 2 } }), 1e-12);
  EXPECT_EQ(sun.color, (Vec3{ { 1, 0.5, 0 } }));
  EXPECT_DOUBLE_EQ(sun.intensity, 2.0);
  EXPECT_EQ(sun.settings, (Settings{ { "map_size", "512" }, { "technique", "raytraced" } }));
  const SceneLight& spot = scene.lights[1];
  EXPECT_EQ(spot.type, SceneLight::Type::Spot);
  EXPECT_EQ(spot.position, (Vec3{ { 1, 2, 3 } }));
  EXPECT_DOUBLE_EQ(spot.coneAngleDegrees, 25.0);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, GivesModelsATexture)
{
  writeBytes(this->folder / "texture.png", samplePng());
  nlohmann::json document = sampleScene();
  document["models"][0]["texture"] = "texture.png";
  const std::string message = messageOf<BadInput>([&] { this->load(document); });
  EXPECT_NE(message.find("models[0].texture"), std::string::npos) << message;
  EXPECT_NE(message.find("model.obj: has no texture coordinates"), std::string::npos) << message;

  writeBytes(this->folder / "model.obj",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const Scene scene = this->load(document);
  ASSERT_EQ(scene.models.size(), 1u);
  ASSERT_TRUE(scene.models[0].texture);
  EXPECT_FALSE(scene.models[0].texture->GetInterpolate());
  EXPECT_TRUE(scene.models[0].texture->GetRepeat());
  EXPECT_EQ(scene.models[0].texture->GetInput()->GetDimensions()[0], 8);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, BecomesARenderer)
{
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(this->load(sampleScene()), 1.0);
  EXPECT_FALSE(renderer->GetAutomaticLightCreation());
  ASSERT_EQ(renderer->GetActors()->GetNumberOfItems(), 1);
  vtkActor* actor = renderer->GetActors()->GetLastActor();
  EXPECT_FALSE(vtkGnomonPropKeys::GetCasts(actor));
  EXPECT_FALSE(vtkGnomonPropKeys::GetReceives(actor));
  EXPECT_TRUE(vtkGnomonPropKeys::GetOneSided(actor));
  EXPECT_DOUBLE_EQ(actor->GetBounds()[0], 8.0);
  EXPECT_DOUBLE_EQ(actor->GetBounds()[3], 24.0);

  vtkLightCollection* lights = renderer->GetLights();
  ASSERT_EQ(lights->GetNumberOfItems(), 2);
  auto* sun = vtkLight::SafeDownCast(lights->GetItemAsObject(0));
  EXPECT_TRUE(sun->LightTypeIsSceneLight());
  EXPECT_FALSE(sun->GetPositional());
  EXPECT_DOUBLE_EQ(sun->GetIntensity(), 2.0);
  EXPECT_STREQ(vtkGnomonLightKeys::GetSetting(sun, "technique"), "raytraced");
  EXPECT_STREQ(vtkGnomonLightKeys::GetSetting(sun, "map_size"), "512");
  auto* spot = vtkLight::SafeDownCast(lights->GetItemAsObject(1));
  EXPECT_TRUE(spot->GetPositional());
  EXPECT_DOUBLE_EQ(spot->GetConeAngle(), 25.0);
  EXPECT_EQ(vtkGnomonLightKeys::GetSetting(spot, "technique"), nullptr);

  EXPECT_DOUBLE_EQ(renderer->GetActiveCamera()->GetViewAngle(), 45.0);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, ClippingPlanesEncloseWhatIsInFrontOfTheCamera)
{
  nlohmann::json document = sampleScene();
  document["models"][0].erase("matrix");
  const Scene scene = this->load(document);
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, 1.0);
  const double* range = renderer->GetActiveCamera()->GetClippingRange();
  const Vec3 forward = normalized(scene.camera.target - scene.camera.position);
  double nearest = 1e9;
  double farthest = 0.0;
  for (vtkIdType i = 0; i < scene.models[0].surface->GetNumberOfPoints(); ++i)
  {
    Vec3 point;
    scene.models[0].surface->GetPoint(i, point.data());
    const double depth = dot(point - scene.camera.position, forward);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  EXPECT_LT(range[0], nearest);
  EXPECT_GT(range[0], 0.9 * nearest);
  EXPECT_GT(range[1], farthest);
  EXPECT_LT(range[1], 1.1 * farthest);
}

//------------------------------------------------------------------------------
/// The second plate is beside a perspective camera's picture, and in a parallel one's. What lies
/// behind the camera is not in the picture.
TEST_F(SceneFile, ClippingPlanesOfAParallelCameraEncloseWhatIsInItsPicture)
{
  writeBytes(this->folder / "model.obj",
    "v -1 -1 -7\nv 1 -1 -7\nv 0 1 -7\nf 1 2 3\nv 3 -1 -2\nv 4 -1 -2\nv 3 1 -2\nf 4 5 6\n"
    "v -1 -1 5\nv 1 -1 5\nv 0 1 5\nf 7 8 9\n");
  nlohmann::json document = sampleScene();
  document["models"][0].erase("matrix");
  document["camera"] = { { "position", { 0, 0, 0 } }, { "target", { 0, 0, -1 } },
    { "parallel_scale", 5 } };
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(this->load(document), 1.0);
  vtkCamera* camera = renderer->GetActiveCamera();
  EXPECT_TRUE(camera->GetParallelProjection());
  EXPECT_DOUBLE_EQ(camera->GetParallelScale(), 5.0);
  EXPECT_NEAR(camera->GetClippingRange()[0], 2.0, 0.1);
  EXPECT_NEAR(camera->GetClippingRange()[1], 7.0, 0.1);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, ClippingPlanesAreSoundWhenAllIsBehindTheCamera)
{
  nlohmann::json document = sampleScene();
  document["camera"]["target"] = { 6, 8, 10 };
  document["models"][0].erase("matrix");
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(this->load(document), 1.0);
  const double* range = renderer->GetActiveCamera()->GetClippingRange();
  EXPECT_GT(range[0], 1e-3);
  EXPECT_GT(range[1], 10.0 * range[0]);
}

//------------------------------------------------------------------------------
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
    { "/ground", "yes", "ground", "true or false" },
    { "/models", nlohmann::json::array(), "models", "at least one model" },
    { "/models", null, "models", "missing, expected an array" },
    { "/models/0", 7, "models[0]", "expected an object" },
    { "/models/0/file", "gone.obj", "models[0].file", "no such file" },
    { "/models/0/file", "model.xyz", "models[0].file", "expected one of: .obj" },
    { "/models/0/matrix/0", 0, "models[0].matrix", "can be inverted" },
    { "/models/0/matrix/15", 2, "models[0].matrix", "last row" },
    { "/models/0/matrix", { 1, 2, 3 }, "models[0].matrix", "array of 16 numbers" },
    { "/models/0/color", { 1, 2, 1 }, "models[0].color", "between 0 and 1" },
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

//------------------------------------------------------------------------------
TEST_F(SceneFile, PointLightsAreRead)
{
  nlohmann::json document = sampleScene();
  document["lights"][0] = { { "type", "point" }, { "position", { 1, 2, 3 } }, { "intensity", 3 } };
  const Scene scene = this->load(document);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].type, SceneLight::Type::Point);
  EXPECT_EQ(scene.lights[0].position, (Vec3{ { 1, 2, 3 } }));
  EXPECT_DOUBLE_EQ(scene.lights[0].intensity, 3.0);
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, 1.0);
  auto* lamp = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  EXPECT_TRUE(lamp->GetPositional());
  EXPECT_GE(lamp->GetConeAngle(), 90.0);

  document["lights"][0]["target"] = { 0, 0, 0 };
  EXPECT_NE(messageOf<BadInput>([&] { this->load(document); }).find("unknown key \"target\""),
    std::string::npos);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, BoxesOfDirectionalLightsAreRead)
{
  nlohmann::json document = sampleScene();
  document["lights"][0] = { { "type", "directional" }, { "direction", { 0, -2, 1 } },
    { "box",
      { { "position", { 1, 2, 3 } }, { "up", { 1, 0, 0 } }, { "width", 4 }, { "height", 5 },
        { "depth", 6 } } } };
  const Scene scene = this->load(document);
  const SceneLight& sun = scene.lights[0];
  EXPECT_EQ(sun.position, (Vec3{ { 1, 2, 3 } }));
  EXPECT_LT(
    length(normalized(sun.target - sun.position) - normalized(Vec3{ { 0, -2, 1 } })), 1e-12);
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, 1.0);
  auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  EXPECT_EQ(light->GetInformation()->Length(vtkGnomonLightKeys::BOX()), 6);
  const double* numbers = light->GetInformation()->Get(vtkGnomonLightKeys::BOX());
  EXPECT_EQ(std::vector<double>(numbers, numbers + 6), std::vector<double>({ 4, 5, 6, 1, 0, 0 }));
  EXPECT_DOUBLE_EQ(light->GetPosition()[1], 2.0);

  const auto messageWithout = [&](const char* key)
  {
    nlohmann::json broken = document;
    broken["lights"][0]["box"].erase(key);
    return messageOf<BadInput>([&] { this->load(broken); });
  };
  for (const char* key : { "position", "width", "height", "depth" })
  {
    EXPECT_NE(messageWithout(key).find(std::string("lights[0].box.") + key + ": missing"),
      std::string::npos)
      << messageWithout(key);
  }
  document["lights"][0]["box"]["up"] = { 0, 4, -2 };
  EXPECT_NE(messageOf<BadInput>([&] { this->load(document); }).find("lights[0].box.up: "),
    std::string::npos);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, AreaLightsAreRectanglesOrDisks)
{
  nlohmann::json document = sampleScene();
  document["lights"][0] = { { "type", "area" }, { "position", { 1, 2, 3 } },
    { "target", { 0, 0, 0 } }, { "width", 1 }, { "height", 2 }, { "light_samples", 16 } };
  const SceneLight rectangle = this->load(document).lights[0];
  EXPECT_EQ(rectangle.type, SceneLight::Type::Point);
  ASSERT_TRUE(rectangle.area.has_value());
  EXPECT_TRUE(rectangle.area->rectangle);
  EXPECT_EQ(rectangle.area->height, 2.0);
  EXPECT_EQ(rectangle.settings, (Settings{ { "light_samples", "16" } }));

  const auto refused = [&](const char* key, const nlohmann::json& value, const char* message)
  {
    nlohmann::json broken = document;
    broken["lights"][0][key] = value;
    EXPECT_NE(messageOf<BadInput>([&] { this->load(broken); }).find(message), std::string::npos)
      << message;
  };
  refused("width", 0, "lights[0].width: found 0");
  refused("up", { 1, 2, 3 }, "lights[0].up: ");
  refused("shape", "star", "lights[0].shape: ");
  refused("radius", 1, "lights[0].radius: means nothing for a rectangle");
  refused("cone_angle", 90, "lights[0].cone_angle: ");
  refused("target", { 1, 2, 3 }, "lights[0].target: ");

  document["lights"][0] = { { "type", "area" }, { "position", { 1, 2, 3 } },
    { "target", { 0, 0, 0 } }, { "shape", "disk" }, { "radius", 0.5 }, { "cone_angle", 40 } };
  const Scene scene = this->load(document);
  EXPECT_EQ(scene.lights[0].type, SceneLight::Type::Spot);
  const auto renderer = makeRenderer(scene, 1.0);
  auto* light = vtkGnomonAreaLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(light->GetShape(), vtkGnomonAreaLight::DISK);
  EXPECT_EQ(light->GetRadius(), 0.5);
  EXPECT_EQ(light->GetConeAngle(), 40.0);
  refused("height", 1, "lights[0].height: means nothing for a disk");
  refused("radius", "wide", "lights[0].radius: ");
  refused("up", { 0, 1, 0 }, "lights[0].up: means nothing for a disk without texture");
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, AreaLightsMayHaveATexture)
{
  writeBytes(this->folder / "panes.png", samplePng());
  nlohmann::json document = sampleScene();
  document["lights"][0] = { { "type", "area" }, { "position", { 1, 2, 3 } },
    { "target", { 0, 0, 0 } }, { "width", 1 }, { "height", 2 }, { "texture", "panes.png" } };
  const SceneLight rectangle = this->load(document).lights[0];
  ASSERT_TRUE(rectangle.area->texture);
  EXPECT_EQ(rectangle.area->texture->GetDimensions()[0], 8);

  const auto refused = [&](const nlohmann::json& value, const char* message)
  {
    nlohmann::json broken = document;
    broken["lights"][0]["texture"] = value;
    const std::string found = messageOf<BadInput>([&] { this->load(broken); });
    EXPECT_NE(found.find("lights[0].texture: "), std::string::npos) << found;
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  refused(3, "expected a text");
  refused("gone.png", "gone.png: no such file");
  refused("scene.json", "scene.json: not a PNG or JPEG image");
  nlohmann::json point = document;
  point["lights"][0] = { { "type", "point" }, { "position", { 1, 2, 3 } },
    { "texture", "panes.png" } };
  const std::string message = messageOf<BadInput>([&] { this->load(point); });
  EXPECT_NE(message.find("unknown key \"texture\""), std::string::npos) << message;

  document["lights"][0] = { { "type", "area" }, { "position", { 1, 2, 3 } },
    { "target", { 0, 0, 0 } }, { "shape", "disk" }, { "radius", 0.5 }, { "up", { 0, 0, 1 } },
    { "texture", "panes.png" } };
  const auto renderer = makeRenderer(this->load(document), 1.0);
  auto* light = vtkGnomonAreaLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(light->GetUp()[2], 1.0);
  ASSERT_NE(light->GetTexture(), nullptr);
  EXPECT_EQ(light->GetTexture()->GetDimensions()[0], 8);
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, SyntaxErrorsNameTheLine)
{
  writeBytes(this->folder / "scene.json", "{\n  \"models\": [,]\n}");
  const std::string message = messageOf<BadInput>([&] { loadScene(this->folder / "scene.json"); });
  EXPECT_NE(message.find("line 2, column 14"), std::string::npos) << message;
}

//------------------------------------------------------------------------------
TEST_F(SceneFile, WithoutCameraAndLightsIsFramedAndLit)
{
  nlohmann::json document = sampleScene();
  document.erase("camera");
  document.erase("lights");
  const Scene scene = this->load(document);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_LT(length(scene.camera.target - Vec3{ { 10, 22, 30 } }), 1e-6);
  document["lights"] = nlohmann::json::array();
  EXPECT_TRUE(this->load(document).lights.empty());
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
/// The page's examples are one scene, and two more lights.
TEST_F(SceneFile, PageOfTheFormatShowsWhatIsRead)
{
  const std::string page = tool::readBytes(GNOMON_SOURCE_DIR "/docs/guide/scene_files.md");
  std::vector<std::string> examples = split(page, '`');
  examples.erase(std::remove_if(examples.begin(), examples.end(),
                   [](const std::string& text) { return text.rfind("json\n", 0) != 0; }),
    examples.end());
  ASSERT_EQ(examples.size(), 2u);
  nlohmann::json document = nlohmann::json::parse(examples[0].substr(5));
  for (const nlohmann::json& light : nlohmann::json::parse(examples[1].substr(5)))
  {
    document["lights"].push_back(light);
  }
  writeBytes(this->folder / "bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  writeBytes(this->folder / "screen.obj",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  writeBytes(this->folder / "lattice.png", samplePng());
  writeBytes(this->folder / "panes.png", samplePng());
  const Scene scene = this->load(document);
  EXPECT_EQ(scene.models.size(), 3u); // with the ground
  EXPECT_EQ(scene.lights.size(), document["lights"].size());
}

} // namespace
} // namespace gnomon::tool
