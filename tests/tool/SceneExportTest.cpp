#include "SceneExport.h"
#include "MeshBuilder.h"
#include "Errors.h"
#include "SceneFraming.h"
#include "TestFiles.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
TEST(SceneExport, IsReadBackAsTheSameScene)
{
  Scene scene;
  scene.name = "exported";
  scene.models = { makePlane({ { 0.1, 0.2, 0.3 } }, 4.0), makePlane({ { 0.0, 1.0, 0.0 } }, 1.0) };
  scene.models[1].matrix[3] = 1.0 / 3.0;
  scene.models[1].casts = false;
  scene.models[1].receives = false;
  scene.models[1].oneSided = true;
  scene.camera = makeCamera({ { 1.0, 2.0, 0.1 } }, { { 0.0, 0.5, 0.0 } }, 35.5);
  scene.camera.up = { { 0.1, 1.0, 0.0 } };
  scene.lights = { makeSun({ { 0.0, -1.0, 0.0 } }), SceneLight(), parseLight("point:position=1,2,0.1"),
    makeSun({ { 0.0, -1.0, 0.0 } }) };
  scene.lights[0].settings = { { "technique", "raytraced" }, { "map_size", "512" } };
  scene.lights[1].settings = { { "technique", "pcf" }, { "kernel", "box" },
    { "kernel_size", "5" } };
  scene.lights[1].type = SceneLight::Type::Spot;
  scene.lights[1].position = { { 0.3, 4.0, 0.0 } };
  scene.lights[1].color = { { 1.0, 0.5, 0.25 } };
  scene.lights[1].intensity = 0.7;
  scene.lights[1].coneAngleDegrees = 12.5;
  scene.lights[3].position = { { 0.5, 3.0, 0.5 } };
  scene.lights[3].target = { { 0.5, 2.0, 0.5 } };
  scene.lights[3].box = SceneLight::Box{ 1.5, 2.5, 3.5, { { 1.0, 0.1, 0.0 } } };
  scene.background = { { 0.1, 0.2, 0.3 } };

  const TestFolder folder;
  const Scene read = loadScene(exportScene(scene, folder / "made"));
  EXPECT_EQ(read.name, scene.name);
  EXPECT_EQ(read.background, scene.background);
  EXPECT_EQ(read.camera.position, scene.camera.position);
  EXPECT_EQ(read.camera.target, scene.camera.target);
  EXPECT_EQ(read.camera.up, scene.camera.up);
  EXPECT_EQ(read.camera.fovDegrees, scene.camera.fovDegrees);
  EXPECT_EQ(boundsWorld(read), boundsWorld(scene));
  ASSERT_EQ(read.models.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(read.models[i].matrix, scene.models[i].matrix);
    EXPECT_EQ(read.models[i].casts, scene.models[i].casts);
    EXPECT_EQ(read.models[i].receives, scene.models[i].receives);
    EXPECT_EQ(read.models[i].oneSided, scene.models[i].oneSided);
  }
  ASSERT_EQ(read.lights.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(read.lights[i].type, scene.lights[i].type);
    EXPECT_EQ(read.lights[i].position, scene.lights[i].position);
    EXPECT_EQ(read.lights[i].target, scene.lights[i].target);
    EXPECT_EQ(read.lights[i].color, scene.lights[i].color);
    EXPECT_EQ(read.lights[i].intensity, scene.lights[i].intensity);
    EXPECT_EQ(read.lights[i].settings, scene.lights[i].settings);
  }
  EXPECT_EQ(read.lights[1].coneAngleDegrees, scene.lights[1].coneAngleDegrees);
  EXPECT_FALSE(read.lights[0].box);
  ASSERT_TRUE(read.lights[3].box);
  EXPECT_EQ(read.lights[3].box->width, 1.5);
  EXPECT_EQ(read.lights[3].box->height, 2.5);
  EXPECT_EQ(read.lights[3].box->depth, 3.5);
  EXPECT_EQ(read.lights[3].box->up, scene.lights[3].box->up);
}

//------------------------------------------------------------------------------
TEST(SceneExport, KeepsTheHolesOfTextures)
{
  const TestFolder folder;
  const Scene scene = loadScene("screens");
  const Scene read = loadScene(exportScene(scene, folder.path()));
  ASSERT_EQ(read.models.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    ASSERT_TRUE(scene.models[i].texture && read.models[i].texture);
    vtkImageData* image = scene.models[i].texture->GetInput();
    vtkImageData* other = read.models[i].texture->GetInput();
    const int side = image->GetDimensions()[0];
    ASSERT_EQ(other->GetDimensions()[0], side);
    int holes = 0;
    for (int texel = 0; texel < side * side; ++texel)
    {
      const double alpha = image->GetScalarComponentAsDouble(texel % side, texel / side, 0, 3);
      EXPECT_EQ(other->GetScalarComponentAsDouble(texel % side, texel / side, 0, 3), alpha);
      holes += alpha == 0.0 ? 1 : 0;
    }
    EXPECT_GT(holes, side * side / 4);
    vtkDataArray* coordinates = read.models[i].surface->GetPointData()->GetTCoords();
    ASSERT_TRUE(coordinates);
    EXPECT_EQ(coordinates->GetRange(0)[1],
      scene.models[i].surface->GetPointData()->GetTCoords()->GetRange(0)[1]);
  }
  EXPECT_FALSE(read.models[2].texture);
}

//------------------------------------------------------------------------------
TEST(SceneExport, KeepsAParallelCamera)
{
  Scene scene;
  scene.name = "exported";
  scene.models = { makePlane({ { 0.0, 0.0, 0.0 } }, 1.0) };
  scene.camera = parseCamera("position=0,1,2;target=0,0,0;parallel_scale=1.5", {});
  const TestFolder folder;
  const auto renderer = makeRenderer(loadScene(exportScene(scene, folder.path())), 1.0);
  EXPECT_EQ(renderer->GetActiveCamera()->GetParallelScale(), 1.5);
}

//------------------------------------------------------------------------------
TEST(SceneExport, RefusesAFolderThatCannotBeMade)
{
  Scene scene;
  scene.name = "exported";
  scene.models = { makePlane({ { 0.0, 0.0, 0.0 } }, 1.0) };
  const TestFolder folder;
  writeBytes(folder / "file", "x");
  EXPECT_NE(messageOf<BadInput>([&] { exportScene(scene, folder / "file"); }).find("--export"),
    std::string::npos);
}

} // namespace gnomon::tool
