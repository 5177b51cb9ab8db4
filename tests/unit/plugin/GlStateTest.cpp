// The pass's effect on OpenGL: it leaves the state like a plain VTK frame, returns every texture
// unit, and neither leaks nor loses objects.

#include "LiveObjects.h"
#include "PassScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonLightSamplingPass.h"
#include "shadowtech/base/Gl.h"

#include <vtkLightCollection.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#include <vtkRenderPass.h>
#include <vtkRenderState.h>
#include <vtkTextureUnitManager.h>

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <set>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

using State = std::map<std::string, std::vector<double>>;

/// All OpenGL state that a neighbouring pass could depend on.
State readState()
{
  State state;
  const auto add = [&](const std::string& name, GLenum query, std::size_t count)
  {
    std::vector<double> values(std::max<std::size_t>(count, 16));
    glGetDoublev(query, values.data());
    values.resize(count);
    state[name] = values;
  };
#define ADD(query, count) add(#query, query, count)
  ADD(GL_CURRENT_PROGRAM, 1);
  ADD(GL_VERTEX_ARRAY_BINDING, 1);
  ADD(GL_ARRAY_BUFFER_BINDING, 1);
  ADD(GL_ELEMENT_ARRAY_BUFFER_BINDING, 1);
  ADD(GL_PIXEL_PACK_BUFFER_BINDING, 1);
  ADD(GL_PIXEL_UNPACK_BUFFER_BINDING, 1);
  ADD(GL_UNIFORM_BUFFER_BINDING, 1);
  ADD(GL_SHADER_STORAGE_BUFFER_BINDING, 1);
  ADD(GL_DRAW_FRAMEBUFFER_BINDING, 1);
  ADD(GL_READ_FRAMEBUFFER_BINDING, 1);
  ADD(GL_RENDERBUFFER_BINDING, 1);
  ADD(GL_DRAW_BUFFER0, 1);
  ADD(GL_DRAW_BUFFER1, 1);
  ADD(GL_DRAW_BUFFER2, 1);
  ADD(GL_READ_BUFFER, 1);
  ADD(GL_VIEWPORT, 4);
  ADD(GL_SCISSOR_BOX, 4);
  ADD(GL_DEPTH_RANGE, 2);
  ADD(GL_DEPTH_FUNC, 1);
  ADD(GL_LOGIC_OP_MODE, 1);
  ADD(GL_DEPTH_WRITEMASK, 1);
  ADD(GL_DEPTH_CLEAR_VALUE, 1);
  ADD(GL_COLOR_WRITEMASK, 4);
  ADD(GL_COLOR_CLEAR_VALUE, 4);
  ADD(GL_STENCIL_WRITEMASK, 1);
  ADD(GL_BLEND_SRC_RGB, 1);
  ADD(GL_BLEND_DST_RGB, 1);
  ADD(GL_BLEND_SRC_ALPHA, 1);
  ADD(GL_BLEND_DST_ALPHA, 1);
  ADD(GL_BLEND_EQUATION_RGB, 1);
  ADD(GL_CULL_FACE_MODE, 1);
  ADD(GL_FRONT_FACE, 1);
  ADD(GL_POLYGON_MODE, 2);
  ADD(GL_POLYGON_OFFSET_FACTOR, 1);
  ADD(GL_POLYGON_OFFSET_UNITS, 1);
  ADD(GL_LINE_WIDTH, 1);
  ADD(GL_PACK_ALIGNMENT, 1);
  ADD(GL_PACK_ROW_LENGTH, 1);
  ADD(GL_PACK_SKIP_PIXELS, 1);
  ADD(GL_PACK_SKIP_ROWS, 1);
  ADD(GL_UNPACK_ALIGNMENT, 1);
  ADD(GL_UNPACK_ROW_LENGTH, 1);
  ADD(GL_UNPACK_SKIP_PIXELS, 1);
  ADD(GL_UNPACK_SKIP_ROWS, 1);
  ADD(GL_ACTIVE_TEXTURE, 1);
#undef ADD
#define ADD(name) state[#name] = { glIsEnabled(name) ? 1.0 : 0.0 }
  ADD(GL_DEPTH_TEST);
  ADD(GL_SCISSOR_TEST);
  ADD(GL_STENCIL_TEST);
  ADD(GL_CULL_FACE);
  ADD(GL_POLYGON_OFFSET_FILL);
  ADD(GL_DEPTH_CLAMP);
  ADD(GL_COLOR_LOGIC_OP);
  ADD(GL_CLIP_DISTANCE0);
  ADD(GL_CLIP_DISTANCE1);
  ADD(GL_MULTISAMPLE);
  ADD(GL_SAMPLE_ALPHA_TO_COVERAGE);
  ADD(GL_FRAMEBUFFER_SRGB);
  ADD(GL_RASTERIZER_DISCARD);
  ADD(GL_PROGRAM_POINT_SIZE);
  ADD(GL_PRIMITIVE_RESTART);
  ADD(GL_LINE_SMOOTH);
#undef ADD
  for (GLuint i = 0; i < 8; ++i)
  {
    state["GL_BLEND of draw buffer " + std::to_string(i)] = { glIsEnabledi(GL_BLEND, i) ? 1.0
                                                                                        : 0.0 };
  }
  GLint image = 0;
  glGetIntegeri_v(GL_IMAGE_BINDING_NAME, 0, &image);
  state["GL_IMAGE_BINDING_NAME of unit 0"] = { static_cast<double>(image) };
  for (GLuint binding = 0; binding < 8; ++binding)
  {
    GLint buffer = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &buffer);
    state["GL_SHADER_STORAGE_BUFFER_BINDING " + std::to_string(binding)] = { static_cast<double>(
      buffer) };
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  for (int unit = 0; unit < units; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    const std::string of = " of unit " + std::to_string(unit);
    add("GL_TEXTURE_BINDING_2D" + of, GL_TEXTURE_BINDING_2D, 1);
    add("GL_TEXTURE_BINDING_2D_ARRAY" + of, GL_TEXTURE_BINDING_2D_ARRAY, 1);
    add("GL_TEXTURE_BINDING_3D" + of, GL_TEXTURE_BINDING_3D, 1);
    add("GL_TEXTURE_BINDING_CUBE_MAP" + of, GL_TEXTURE_BINDING_CUBE_MAP, 1);
    add("GL_TEXTURE_BINDING_BUFFER" + of, GL_TEXTURE_BINDING_BUFFER, 1);
    add("GL_SAMPLER_BINDING" + of, GL_SAMPLER_BINDING, 1);
  }
  glActiveTexture(static_cast<GLenum>(active));
  return state;
}

std::set<std::string> changedNames(const State& before, const State& after)
{
  std::set<std::string> names;
  for (const auto& [name, values] : before)
  {
    if (after.at(name) != values)
    {
      names.insert(name);
    }
  }
  return names;
}

/// Draws by another pass, or like plain VTK without one, and records the state around it.
class ProbePass : public vtkRenderPass
{
public:
  static ProbePass* New();
  vtkTypeMacro(ProbePass, vtkRenderPass);
  void Render(const vtkRenderState* s) override
  {
    vtkRenderer* renderer = s->GetRenderer();
    this->Before = readState();
    if (this->Inner)
    {
      this->Inner->Render(s);
    }
    else
    {
      this->UpdateCamera(renderer);
      this->UpdateLightGeometry(renderer);
      this->UpdateLights(renderer);
      this->UpdateGeometry(renderer);
    }
    this->After = readState();
    this->Error = glGetError();
  }

  vtkSmartPointer<vtkRenderPass> Inner;
  State Before;
  State After;
  GLenum Error = GL_NO_ERROR;
};
vtkStandardNewMacro(ProbePass);

void fill(PassScene& scene)
{
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.addSun({ 1.0, 0.3, -1.5 });
  scene.addSpot({ -3.0, 0.0, 5.0 }, glm::dvec3(0.0), 30.0)->SetIntensity(0.5);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
}

class GlStateOfWay
  : public PassTest
  , public testing::WithParamInterface<Way>
{
protected:
  void choose(PassScene& scene) const { scene.choose(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Ways, GlStateOfWay, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, GlStateOfWay, testing::Values(planarWay), nameOf);
INSTANTIATE_TEST_SUITE_P(ThroughLayers, GlStateOfWay, testing::Values(layersWay), nameOf);
INSTANTIATE_TEST_SUITE_P(OnImage, GlStateOfWay, testing::Values(tracedWay), nameOf);

class GlState : public PassTest
{
};

/// Return the number of texture units that VTK's manager can still give.
int freeTextureUnits(vtkOpenGLRenderWindow* window)
{
  vtkTextureUnitManager* manager = window->GetState()->GetTextureUnitManager();
  std::vector<int> units;
  for (int unit = manager->Allocate(); unit >= 0; unit = manager->Allocate())
  {
    units.push_back(unit);
  }
  for (const int unit : units)
  {
    manager->Free(unit);
  }
  return static_cast<int>(units.size());
}

/// Expect a pass to change state only where plain VTK does, too.
/// @param choose sets up the scene's pass and returns the pass to draw with: that one, or one
/// around it
/// @param ofVtk state that VTK leaves after its last drawing, which may differ from the last
/// drawing of the frame before
void expectChangesOfPlainVtkOnly(
  const std::function<vtkRenderPass*(PassScene&)>& choose, const std::set<std::string>& ofVtk = {})
{
  PassScene plain(200, 150);
  fill(plain);
  vtkNew<ProbePass> plainProbe;
  plain.renderer->SetPass(plainProbe);

  PassScene scene(200, 150);
  fill(scene);
  vtkNew<ProbePass> probe;
  probe->Inner = choose(scene);
  scene.renderer->SetPass(probe);

  for (int frame = 1; frame < 5; ++frame)
  {
    if (frame == 4)
    {
      plain.window->SetSize(160, 170);
      scene.window->SetSize(160, 170);
    }
    plain.render();
    const std::set<std::string> allowed = changedNames(plainProbe->Before, plainProbe->After);
    scene.render();
    EXPECT_EQ(probe->Error, static_cast<GLenum>(GL_NO_ERROR)) << "frame " << frame;
    for (const std::string& name : changedNames(probe->Before, probe->After))
    {
      EXPECT_TRUE(allowed.count(name) || ofVtk.count(name)) << "frame " << frame << ": " << name;
    }
    for (const char* name : { "GL_VIEWPORT", "GL_SCISSOR_BOX", "GL_DEPTH_TEST", "GL_BLEND_SRC_RGB",
           "GL_DEPTH_FUNC", "GL_COLOR_WRITEMASK", "GL_DEPTH_WRITEMASK", "GL_ACTIVE_TEXTURE" })
    {
      EXPECT_EQ(probe->After[name], plainProbe->After[name]) << "frame " << frame << ": " << name;
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, isChangedOnlyWherePlainVtkChangesIt)
{
  expectChangesOfPlainVtkOnly(
    [this](PassScene& scene)
    {
      this->choose(scene);
      return scene.pass.Get();
    });
}

//------------------------------------------------------------------------------
TEST_F(GlState, isChangedByTheDeferredRouteOnlyWherePlainVtkChangesIt)
{
  for (const char* edgeSamples : { "1", "16" })
  {
    expectChangesOfPlainVtkOnly(
      [&](PassScene& scene)
      {
        vtkLight::SafeDownCast(scene.renderer->GetLights()->GetItemAsObject(1))->SwitchOff();
        scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_DEFERRED });
        scene.pass->SetSetting("edge_samples", edgeSamples);
        return scene.pass.Get();
      });
  }
}

//------------------------------------------------------------------------------
TEST_F(GlState, isChangedByMapsOfMomentsOnlyWherePlainVtkChangesIt)
{
  for (const auto& [name, value] : std::multimap<std::string, const char*>{
         { "blur", "box" }, { "blur", "sat" }, { "mip_maps", "on" } })
  {
    expectChangesOfPlainVtkOnly(
      [name = name, value = value](PassScene& scene)
      {
        scene.pass->SetTechnique("msm");
        scene.pass->SetSetting(name.c_str(), value);
        return scene.pass.Get();
      });
  }
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, isChangedByPicturesOfLightPointsOnlyWherePlainVtkChangesIt)
{
  for (const auto& [samplesPerFrame, multiSamples] : { std::pair(0, 0), { 2, 4 } })
  {
    vtkNew<vtkGnomonLightSamplingPass> sampling;
    sampling->SetSamples(3);
    sampling->SetSamplesPerFrame(samplesPerFrame);
    expectChangesOfPlainVtkOnly(
      [&](PassScene& scene)
      {
        this->choose(scene);
        scene.window->SetMultiSamples(multiSamples);
        vtkGnomonLightKeys::SetSetting(
          vtkLight::SafeDownCast(scene.renderer->GetLights()->GetItemAsObject(1)), "light_radius",
          "0.5");
        sampling->SetDelegatePass(scene.pass);
        return sampling.Get();
      },
      { "GL_CURRENT_PROGRAM", "GL_ARRAY_BUFFER_BINDING" });
  }
}

//------------------------------------------------------------------------------
TEST_F(GlState, isChangedByTexturesOfLightsOnlyWherePlainVtkChangesIt)
{
  for (const char* technique : { "raytraced", "montecarlo", "sampled", "pcf" })
  {
    expectChangesOfPlainVtkOnly(
      [technique](PassScene& scene)
      {
        vtkNew<vtkGnomonAreaLight> lamp;
        lamp->SetPosition(2.0, 1.0, 6.0);
        lamp->SetTexture(makeImage(3, 1, [](int, int) { return glm::dvec3(0.4); }));
        scene.renderer->AddLight(lamp);
        scene.pass->SetTechnique(technique);
        return scene.pass.Get();
      });
  }
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, isWhatVtkRemembers)
{
  PassScene scene(200, 150);
  fill(scene);
  this->choose(scene);
  scene.render();
  scene.render();
  vtkOpenGLState* state = scene.window->GetState();
  for (const GLenum name :
    { GL_DEPTH_TEST, GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE, GL_MULTISAMPLE, GL_STENCIL_TEST })
  {
    EXPECT_EQ(state->GetEnumState(name), glIsEnabled(name) == GL_TRUE) << std::hex << name;
  }
  for (const GLenum name : { GL_VIEWPORT, GL_SCISSOR_BOX })
  {
    std::array<int, 4> remembered;
    std::array<int, 4> actual;
    state->vtkglGetIntegerv(name, remembered.data());
    glGetIntegerv(name, actual.data());
    EXPECT_EQ(remembered, actual) << std::hex << name;
  }
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, allTextureUnitsAreGivenBack)
{
  PassScene plain(200, 150);
  fill(plain);
  plain.usePlain();
  plain.render();
  const int free = freeTextureUnits(plain.window);
  PassScene scene(200, 150);
  fill(scene);
  this->choose(scene);
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.render();
    EXPECT_EQ(freeTextureUnits(scene.window), free);
  }
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, objectsStayTheSameInNumber)
{
  PassScene scene(120, 90);
  fill(scene);
  this->choose(scene);
  scene.render();
  scene.render();
  const LiveObjects live = countLiveObjects(scene.window);
  EXPECT_GT(live.textures, 0);
  for (int frame = 0; frame < 50; ++frame)
  {
    scene.renderer->GetActiveCamera()->Azimuth(3.0);
    scene.render();
  }
  EXPECT_EQ(countLiveObjects(scene.window), live) << "after 50 frames";
  for (int size = 0; size < 20; ++size)
  {
    scene.window->SetSize(100 + 7 * size, 140 - 3 * size);
    scene.render();
  }
  EXPECT_EQ(countLiveObjects(scene.window), live) << "after 20 sizes";
  for (int time = 0; time < 20; ++time)
  {
    scene.usePlain();
    scene.render();
    scene.useGnomon();
    scene.render();
  }
  const LiveObjects toggled = countLiveObjects(scene.window);
  EXPECT_TRUE(toggled.sameButPrograms(live)) << toggled << " after the pass was off and on";
  // Plain VTK's own programs have been added to those with the hook; no more follow.
  scene.usePlain();
  scene.render();
  scene.useGnomon();
  scene.render();
  EXPECT_EQ(countLiveObjects(scene.window), toggled);
}

//------------------------------------------------------------------------------
TEST_F(GlState, techniquesBackAndForthKeepTheNumberOfObjects)
{
  PassScene scene(120, 90);
  fill(scene);
  const auto backAndForth = [&]
  {
    scene.pass->SetTechnique("raytraced");
    scene.render();
    scene.pass->SetTechnique("nsm");
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
    scene.render();
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
    scene.render();
  };
  backAndForth();
  const LiveObjects live = countLiveObjects(scene.window);
  for (int time = 0; time < 10; ++time)
  {
    backAndForth();
  }
  EXPECT_EQ(countLiveObjects(scene.window), live);
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, releaseGivesEverythingBack)
{
  PassScene scene(120, 90);
  fill(scene);
  scene.usePlain();
  scene.render();
  const LiveObjects plain = countLiveObjects(scene.window);
  scene.useGnomon();
  this->choose(scene);
  const Picture picture = scene.render();
  EXPECT_FALSE(countLiveObjects(scene.window).sameButPrograms(plain));
  scene.pass->ReleaseGraphicsResources(scene.window);
  const LiveObjects released = countLiveObjects(scene.window);
  EXPECT_TRUE(released.sameButPrograms(plain)) << released << "; plain: " << plain;
  EXPECT_EQ(differingPixels(picture, scene.render()), 0u) << "drawn again after the release";
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, passMayDieBeforeItsWindow)
{
  PassScene scene(120, 90);
  fill(scene);
  scene.usePlain();
  scene.render();
  const LiveObjects plain = countLiveObjects(scene.window);
  {
    vtkNew<vtkGnomonShadowPass> pass;
    gnomon::test::choose(pass, GetParam());
    scene.renderer->SetPass(pass);
    scene.render();
    scene.usePlain();
  }
  scene.render(); // until then, VTK's mappers hold the pass
  const LiveObjects after = countLiveObjects(scene.window);
  EXPECT_TRUE(after.sameButPrograms(plain)) << after << "; plain: " << plain;
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, passMayDieWhileAnotherWindowIsDrawn)
{
  PassScene a(120, 90);
  PassScene b(120, 90);
  fill(b);
  b.usePlain();
  const Picture plain = b.render();
  // Both windows draw the same actor; its mapper refers to the pass until drawn without it.
  vtkActor* shared = b.addSphere({ 1.5, -1.0, 1.0 }, 0.5);
  a.addFloor(4.0);
  a.renderer->AddActor(shared);
  a.addSun({ 1.0, 0.3, -1.5 });
  a.lookFrom({ 0.0, -9.0, 7.0 });
  {
    vtkNew<vtkGnomonShadowPass> pass;
    gnomon::test::choose(pass, GetParam());
    a.renderer->SetPass(pass);
    a.render();
    a.usePlain();
  }
  a.renderer->RemoveAllViewProps();
  const Picture first = b.render();
  EXPECT_GT(differingPixels(plain, first), 100u); // the sphere
  EXPECT_EQ(differingPixels(first, b.render()), 0u);
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, passMayOutliveItsWindow)
{
  vtkNew<vtkGnomonShadowPass> pass;
  gnomon::test::choose(pass, GetParam());
  Picture first;
  {
    PassScene scene(120, 90);
    fill(scene);
    scene.renderer->SetPass(pass);
    first = scene.render();
  }
  PassScene second(120, 90);
  fill(second);
  second.renderer->SetPass(pass);
  EXPECT_EQ(differingPixels(first, second.render()), 0u);
  EXPECT_EQ(pass->GetReport().surfacesExtracted, 2);
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, passMayServeTwoWindowsInTurn)
{
  PassScene a(120, 90);
  PassScene b(120, 90);
  fill(a);
  fill(b);
  a.usePlain();
  a.render();
  const LiveObjects plain = countLiveObjects(a.window);
  a.useGnomon();
  this->choose(a);
  b.renderer->SetPass(a.pass);
  const Picture picture = a.render();
  for (int time = 0; time < 3; ++time)
  {
    EXPECT_EQ(differingPixels(picture, b.render()), 0u);
    const LiveObjects left = countLiveObjects(a.window);
    EXPECT_TRUE(left.sameButPrograms(plain)) << left << "; plain: " << plain;
    EXPECT_EQ(differingPixels(picture, a.render()), 0u);
  }
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, windowMayBeFinalizedAndDrawnAgain)
{
  PassScene scene(120, 90);
  fill(scene);
  this->choose(scene);
  const Picture picture = scene.render();
  scene.window->Finalize();
  EXPECT_EQ(differingPixels(picture, scene.render()), 0u);
}

//------------------------------------------------------------------------------
TEST_P(GlStateOfWay, withoutFreeTextureUnitsTheSceneIsDrawnWithoutShadows)
{
  PassScene scene(120, 90);
  fill(scene);
  this->choose(scene);
  const bool fetches = GetParam().route != vtkGnomonShadowPass::ROUTE_INLINE;
  if (fetches)
  {
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE); // the deferred route needs no unit
  }
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();

  vtkTextureUnitManager* manager = scene.window->GetState()->GetTextureUnitManager();
  std::vector<int> taken;
  for (int unit = manager->Allocate(); unit >= 0; unit = manager->Allocate())
  {
    taken.push_back(unit);
  }
  manager->Free(taken.back()); // one unit is not enough for two maps
  taken.pop_back();
  if (fetches)
  {
    EXPECT_EQ(
      manager->Allocate(), static_cast<int>(taken.size())); // and one layer texture needs one
    taken.push_back(static_cast<int>(taken.size()));
  }
  EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
  EXPECT_THAT(this->takeErrors(), HasSubstr("no texture unit is left"));
  for (const int unit : taken)
  {
    manager->Free(unit);
  }
  EXPECT_EQ(freeTextureUnits(scene.window), static_cast<int>(taken.size()) + (fetches ? 0 : 1));
  EXPECT_GT(differingPixels(plain, scene.render()), 100u) << "no shadow in the next frame";
}
