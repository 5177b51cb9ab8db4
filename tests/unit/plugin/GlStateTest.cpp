// The pass's effect on OpenGL: it leaves the state like a plain VTK frame, returns every texture
// unit, and neither leaks nor loses objects.

#include "LiveObjects.h"
#include "PassScene.h"
#include "Variant.h"

#include "plugin/vtkGnomonLightSamplingPass.h"
#include "shadowtech/base/Gl.h"

#include <vtkOpenGLState.h>
#include <vtkRenderPass.h>
#include <vtkRenderState.h>

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
  const auto add = [&](const std::string& name, GLenum query)
  {
    state[name].resize(16); // more than any of these has
    glGetDoublev(query, state[name].data());
  };
#define NAMED(query) std::pair<const char*, GLenum>(#query, query)
  for (const auto& [name, query] :
    { NAMED(GL_CURRENT_PROGRAM), NAMED(GL_VERTEX_ARRAY_BINDING), NAMED(GL_ARRAY_BUFFER_BINDING),
      NAMED(GL_ELEMENT_ARRAY_BUFFER_BINDING), NAMED(GL_PIXEL_PACK_BUFFER_BINDING),
      NAMED(GL_PIXEL_UNPACK_BUFFER_BINDING), NAMED(GL_UNIFORM_BUFFER_BINDING),
      NAMED(GL_SHADER_STORAGE_BUFFER_BINDING), NAMED(GL_DRAW_FRAMEBUFFER_BINDING),
      NAMED(GL_READ_FRAMEBUFFER_BINDING), NAMED(GL_RENDERBUFFER_BINDING), NAMED(GL_DRAW_BUFFER0),
      NAMED(GL_DRAW_BUFFER1), NAMED(GL_DRAW_BUFFER2), NAMED(GL_READ_BUFFER), NAMED(GL_DEPTH_FUNC),
      NAMED(GL_LOGIC_OP_MODE), NAMED(GL_DEPTH_WRITEMASK), NAMED(GL_DEPTH_CLEAR_VALUE),
      NAMED(GL_STENCIL_WRITEMASK), NAMED(GL_BLEND_SRC_RGB), NAMED(GL_BLEND_DST_RGB),
      NAMED(GL_BLEND_SRC_ALPHA), NAMED(GL_BLEND_DST_ALPHA), NAMED(GL_BLEND_EQUATION_RGB),
      NAMED(GL_CULL_FACE_MODE), NAMED(GL_FRONT_FACE), NAMED(GL_POLYGON_OFFSET_FACTOR),
      NAMED(GL_POLYGON_OFFSET_UNITS), NAMED(GL_LINE_WIDTH), NAMED(GL_PACK_ALIGNMENT),
      NAMED(GL_PACK_ROW_LENGTH), NAMED(GL_PACK_SKIP_PIXELS), NAMED(GL_PACK_SKIP_ROWS),
      NAMED(GL_UNPACK_ALIGNMENT), NAMED(GL_UNPACK_ROW_LENGTH), NAMED(GL_UNPACK_SKIP_PIXELS),
      NAMED(GL_UNPACK_SKIP_ROWS), NAMED(GL_ACTIVE_TEXTURE), NAMED(GL_DEPTH_RANGE),
      NAMED(GL_POLYGON_MODE), NAMED(GL_VIEWPORT), NAMED(GL_SCISSOR_BOX), NAMED(GL_COLOR_WRITEMASK),
      NAMED(GL_COLOR_CLEAR_VALUE), NAMED(GL_DEPTH_TEST), NAMED(GL_SCISSOR_TEST),
      NAMED(GL_STENCIL_TEST), NAMED(GL_CULL_FACE), NAMED(GL_POLYGON_OFFSET_FILL),
      NAMED(GL_DEPTH_CLAMP), NAMED(GL_COLOR_LOGIC_OP), NAMED(GL_CLIP_DISTANCE0),
      NAMED(GL_CLIP_DISTANCE1), NAMED(GL_MULTISAMPLE), NAMED(GL_SAMPLE_ALPHA_TO_COVERAGE),
      NAMED(GL_FRAMEBUFFER_SRGB), NAMED(GL_RASTERIZER_DISCARD), NAMED(GL_PROGRAM_POINT_SIZE),
      NAMED(GL_PRIMITIVE_RESTART), NAMED(GL_LINE_SMOOTH) })
  {
    add(name, query);
  }
#undef NAMED
  for (GLuint i = 0; i < 8; ++i)
  {
    const auto addIndexed = [&](const std::string& name, GLenum query)
    {
      GLint value = 0;
      glGetIntegeri_v(query, i, &value);
      state[name + " " + std::to_string(i)] = { static_cast<double>(value) };
    };
    addIndexed("GL_BLEND of draw buffer", GL_BLEND);
    addIndexed("GL_IMAGE_BINDING_NAME of unit", GL_IMAGE_BINDING_NAME);
    addIndexed("GL_SHADER_STORAGE_BUFFER_BINDING", GL_SHADER_STORAGE_BUFFER_BINDING);
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  for (int unit = 0; unit < units; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    const std::string of = " of unit " + std::to_string(unit);
    add("GL_TEXTURE_BINDING_2D" + of, GL_TEXTURE_BINDING_2D);
    add("GL_TEXTURE_BINDING_2D_ARRAY" + of, GL_TEXTURE_BINDING_2D_ARRAY);
    add("GL_TEXTURE_BINDING_3D" + of, GL_TEXTURE_BINDING_3D);
    add("GL_TEXTURE_BINDING_CUBE_MAP" + of, GL_TEXTURE_BINDING_CUBE_MAP);
    add("GL_TEXTURE_BINDING_BUFFER" + of, GL_TEXTURE_BINDING_BUFFER);
    add("GL_SAMPLER_BINDING" + of, GL_SAMPLER_BINDING);
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

using GlStateOfWay = PassTestOf<Way>;

INSTANTIATE_TEST_SUITE_P(Ways, GlStateOfWay, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, GlStateOfWay, testing::Values(planarWay), nameOf);
INSTANTIATE_TEST_SUITE_P(ThroughLayers, GlStateOfWay, testing::Values(layersWay), nameOf);
INSTANTIATE_TEST_SUITE_P(OnImage, GlStateOfWay, testing::Values(tracedWay), nameOf);

std::size_t freeTextureUnits(vtkOpenGLRenderWindow* window)
{
  return TakenUnits(window).units.size();
}

/// A pass that draws a scene in its way.
struct Drawing
{
  std::string name;
  /// Sets up the scene's pass and returns the pass to draw with: that one, or one around it.
  std::function<vtkSmartPointer<vtkRenderPass>(PassScene& scene)> choose;
  /// State that VTK leaves after its last drawing, which may differ from the last drawing of the
  /// frame before.
  std::set<std::string> ofVtk = {};
};

constexpr const char* routeNames[] = { "Auto", "Inline", "Image", "Deferred" };

Drawing byTechnique(
  const char* technique, int route, const char* setting = "", bool textured = false)
{
  return {
    Variant{ technique + std::string(routeNames[route]) + (*setting ? " " : "") + setting }.name() +
      (textured ? "Textured" : ""),
    [=](PassScene& scene) -> vtkSmartPointer<vtkRenderPass>
    {
      scene.choose({ technique, route });
      scene.choose(setting);
      if (textured)
      {
        vtkNew<vtkGnomonAreaLight> lamp;
        lamp->SetPosition(2.0, 1.0, 6.0);
        lamp->SetTexture(makeImage(3, 1, [](int, int) { return glm::dvec3(0.4); }));
        scene.renderer->AddLight(lamp);
      }
      if (route == vtkGnomonShadowPass::ROUTE_DEFERRED) // which shows one light
      {
        lightOf(scene.renderer, 1)->SwitchOff();
      }
      return scene.pass.Get();
    }
  };
}

/// A picture from each point of a light.
Drawing fromPoints(const Way& way, int samplesPerFrame, int multiSamples)
{
  return { std::string("points_") + way.technique + routeNames[way.route] +
      (multiSamples > 0 ? "Multisampled" : ""),
    [=](PassScene& scene) -> vtkSmartPointer<vtkRenderPass>
    {
      vtkNew<vtkGnomonLightSamplingPass> sampling;
      sampling->SetSamples(3);
      sampling->SetSamplesPerFrame(samplesPerFrame);
      scene.choose(way);
      scene.window->SetMultiSamples(multiSamples);
      set(lightOf(scene.renderer, 1), "light_radius", "0.5");
      sampling->SetDelegatePass(scene.pass);
      return sampling.Get();
    },
    { "GL_CURRENT_PROGRAM", "GL_ARRAY_BUFFER_BINDING" } };
}

std::vector<Drawing> drawings()
{
  constexpr int within = vtkGnomonShadowPass::ROUTE_INLINE;
  constexpr int image = vtkGnomonShadowPass::ROUTE_IMAGE;
  constexpr int deferred = vtkGnomonShadowPass::ROUTE_DEFERRED;
  std::vector<Drawing> all = { byTechnique("raytraced", deferred, "edge_samples=1"),
    byTechnique("raytraced", deferred, "edge_samples=16"),
    byTechnique("raytraced", deferred, "edge_samples=auto"),
    byTechnique("raytraced", image, "edge_samples=auto"), byTechnique("msm", within, "blur=box"),
    byTechnique("msm", within, "blur=sat"), byTechnique("msm", within, "mip_maps=on") };
  for (const char* technique : { "nsm", "pcf", "raytraced", "planar", "montecarlo" })
  {
    const Way way{ technique, image };
    all.insert(all.end(),
      { byTechnique(technique, image), fromPoints(way, 0, 0), fromPoints(way, 2, 4),
        byTechnique(technique, image, "", true) });
  }
  for (const char* technique : { "nsm", "pcf" })
  {
    const Way way{ technique, within };
    all.insert(
      all.end(), { byTechnique(technique, within), fromPoints(way, 0, 0), fromPoints(way, 2, 4) });
  }
  all.push_back(byTechnique("sampled", image, "", true));
  return all;
}
using GlStateOfDrawing = PassTestOf<Drawing>;
INSTANTIATE_TEST_SUITE_P(All, GlStateOfDrawing, testing::ValuesIn(drawings()), byName);
} // namespace

TEST_P(GlStateOfDrawing, isChangedOnlyWherePlainVtkChangesIt)
{
  SunAndSpotScene plain(200, 150);
  vtkNew<ProbePass> plainProbe;
  plain.renderer->SetPass(plainProbe);
  SunAndSpotScene scene(200, 150);
  vtkNew<ProbePass> probe;
  probe->Inner = GetParam().choose(scene);
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
      EXPECT_TRUE(allowed.count(name) || GetParam().ofVtk.count(name))
        << "frame " << frame << ": " << name;
    }
    for (const char* name : { "GL_VIEWPORT", "GL_SCISSOR_BOX", "GL_DEPTH_TEST", "GL_BLEND_SRC_RGB",
           "GL_DEPTH_FUNC", "GL_COLOR_WRITEMASK", "GL_DEPTH_WRITEMASK", "GL_ACTIVE_TEXTURE" })
    {
      EXPECT_EQ(probe->After[name], plainProbe->After[name]) << "frame " << frame << ": " << name;
    }
  }
}

TEST_P(GlStateOfWay, isWhatVtkRemembers)
{
  SunAndSpotScene scene(200, 150);
  scene.choose(GetParam());
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

TEST_P(GlStateOfWay, passMayDieBeforeItsWindow)
{
  SunAndSpotScene scene(120, 90);
  scene.usePlain();
  scene.render();
  const LiveObjects plain = withoutPrograms(countLiveObjects(scene.window));
  {
    vtkNew<vtkGnomonShadowPass> pass;
    gnomon::test::choose(pass, GetParam());
    scene.renderer->SetPass(pass);
    scene.render();
    scene.usePlain();
  }
  scene.render(); // until then, VTK's mappers hold the pass
  EXPECT_EQ(withoutPrograms(countLiveObjects(scene.window)), plain);
}

TEST_P(GlStateOfWay, passMayDieWhileAnotherWindowIsDrawn)
{
  PassScene a(120, 90);
  SunAndSpotScene b(120, 90);
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

TEST_P(GlStateOfWay, passMayOutliveItsWindow)
{
  vtkNew<vtkGnomonShadowPass> pass;
  gnomon::test::choose(pass, GetParam());
  Picture first;
  {
    SunAndSpotScene scene(120, 90);
    scene.renderer->SetPass(pass);
    first = scene.render();
  }
  SunAndSpotScene second(120, 90);
  second.renderer->SetPass(pass);
  EXPECT_EQ(differingPixels(first, second.render()), 0u);
  EXPECT_EQ(pass->GetReport().surfacesExtracted, 2);
}

TEST_P(GlStateOfWay, withoutFreeTextureUnitsTheSceneIsDrawnWithoutShadows)
{
  SunAndSpotScene scene(120, 90);
  scene.choose(GetParam());
  const bool fetches = GetParam().route != vtkGnomonShadowPass::ROUTE_INLINE;
  if (fetches)
  {
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE); // the deferred route needs no unit
  }
  const Picture plain = scene.renderPlain();

  const std::size_t free = freeTextureUnits(scene.window);
  {
    TakenUnits taken(scene.window);
    taken.giveBack(fetches ? 0 : 1); // not enough for two maps; a layer texture needs one
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    EXPECT_THAT(this->takeErrors(), HasSubstr("no texture unit is left"));
  }
  EXPECT_EQ(freeTextureUnits(scene.window), free);
  scene.choose(GetParam());
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_GT(differingPixels(plain, scene.render()), 100u) << "no shadow in the next frame";
    EXPECT_EQ(freeTextureUnits(scene.window), free) << "all are given back";
  }
}
