// Which props cast and receive, and where their triangles are.

#include "ChangingProps.h"
#include "PassScene.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"
#include "shadowtech/base/Gl.h"

#include <vtkAssembly.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkFollower.h>
#include <vtkImageActor.h>
#include <vtkImageProperty.h>
#include <vtkLODActor.h>
#include <vtkLODProp3D.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPropAssembly.h>
#include <vtkQuadricLODActor.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkUnsignedCharArray.h>

namespace gnomon::test
{
namespace
{

/// A floor from straight above, under a sun at 45 degrees that travels along +x. A caster at height
/// z shades the floor z further along x.
struct Props : PassTestOf<Way>
{
  Props()
  {
    this->scene.addFloor(8.0);
    this->scene.addSun(slantingSun);
    this->scene.choose(GetParam());
    this->scene.lookDown(6.0);
  }

  /// A square of side 2 at height 2 over the origin; it shades (2, 0).
  vtkActor* addSquare() { return this->scene.addFloor(1.0, 2.0); }
  /// Draw the scene. Return true if a floor point is dark; it must be dark or lit.
  bool dark(double x, double y)
  {
    const int value = this->scene.redAt(this->scene.render(), x, y);
    EXPECT_TRUE(value == 0 || std::abs(value - 180) <= 1) << value;
    return value == 0;
  }

  PassScene scene{ 120, 120 };
};

INSTANTIATE_TEST_SUITE_P(Ways, Props, allWays, nameOf);

/// A mapper that always reports the same time.
class TimedMapper : public vtkOpenGLPolyDataMapper
{
public:
  static TimedMapper* New();
  vtkTypeMacro(TimedMapper, vtkOpenGLPolyDataMapper);
  double GetTimeToDraw() override { return this->Seconds; }
  double Seconds = 1.0;
};
vtkStandardNewMacro(TimedMapper);

/// A mapper that draws into a framebuffer of its own, switches blending and makes a texture.
class ElsewhereMapper : public vtkOpenGLPolyDataMapper
{
public:
  static ElsewhereMapper* New();
  vtkTypeMacro(ElsewhereMapper, vtkOpenGLPolyDataMapper);
  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override
  {
    auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
    vtkOpenGLState* state = window->GetState();
    GlTexture texture;
    glBindTexture(GL_TEXTURE_2D, texture.create()); // to the active unit
    vtkNew<vtkOpenGLFramebufferObject> framebuffer;
    framebuffer->SetContext(window);
    state->PushFramebufferBindings();
    const int* const size = window->GetSize();
    framebuffer->PopulateFramebuffer(size[0], size[1], true, 1, VTK_UNSIGNED_CHAR, true, 24, 0);
    state->vtkglDisable(GL_BLEND);
    this->Superclass::RenderPiece(renderer, actor);
    state->vtkglEnable(GL_BLEND);
    state->PopFramebufferBindings();
    framebuffer->ReleaseGraphicsResources(window);
  }
};
vtkStandardNewMacro(ElsewhereMapper);

/// An interactor that never calls a window system.
class QuietInteractor : public vtkRenderWindowInteractor
{
public:
  static QuietInteractor* New();
  vtkTypeMacro(QuietInteractor, vtkRenderWindowInteractor);
  void Initialize() override { this->Initialized = 1; }
};
vtkStandardNewMacro(QuietInteractor);

vtkSmartPointer<vtkAssembly> held(vtkProp3D* part)
{
  const auto assembly = vtkSmartPointer<vtkAssembly>::New();
  assembly->AddPart(part);
  return assembly;
}

ChangingProp raised(vtkSmartPointer<vtkProp3D> leaf, vtkSmartPointer<vtkProp> prop)
{
  leaf->SetPosition(0.0, 0.0, 1.0);
  ChangingProp changing;
  changing.leaf = leaf;
  changing.prop = prop;
  return changing;
}

/// The square that most kinds of changing props show.
const Box shownSquare{ { -2.0, -2.0, 1.0 }, { 1.5, 2.0, 1.0 } };

ChangingProp makeCastingImage(vtkRenderer*)
{
  const auto image = makeImage(8, 9, [](int, int) { return glm::dvec3(1.0); });
  image->SetOrigin(-2.0, -2.0, 0.0);
  image->SetSpacing(0.5, 0.5, 1.0);
  vtkNew<vtkImageActor> slice;
  slice->SetInputData(image);
  slice->GetProperty()->SetAmbient(0.0);
  slice->GetProperty()->SetDiffuse(1.0);
  vtkGnomonPropKeys::SetCasts(slice, true);
  return raised(slice.Get(), slice.Get());
}
template <bool isHeld>
ChangingProp makeFollowerWithoutACamera(vtkRenderer*)
{
  const auto follower = actorOf<vtkFollower>(
    mapperOf(planeOf({ -2.0, -2.0, 0.0 }, { 1.5, -2.0, 0.0 }, { -2.0, 2.0, 0.0 })));
  return raised(follower, isHeld ? vtkSmartPointer<vtkProp>(held(held(follower))) : follower.Get());
}

/// The kinds of props whose surfaces cast.
std::vector<PropKind> castingKinds()
{
  std::vector<PropKind> kinds{ { "image", makeCastingImage },
    { "follower without a camera", makeFollowerWithoutACamera<false> },
    { "follower without a camera in assemblies", makeFollowerWithoutACamera<true> } };
  std::copy_if(changingProps().begin(), changingProps().end(), std::back_inserter(kinds),
    [](const PropKind& kind) { return kind.isSurface; });
  return kinds;
}

} // namespace

/// Each kind of prop casts the shadow of its square, shows it where it moves to, and receives.
TEST_P(Props, ofAllKindsCastAndReceive)
{
  const double band = 0.15; // pixels are 0.1 wide, texels less
  for (const PropKind& kind : castingKinds())
  {
    SCOPED_TRACE(kind.name);
    const ChangingProp prop = kind.make(this->scene.renderer);
    if (prop.actor)
    {
      prop.actor->GetProperty()->SetRepresentationToSurface();
      prop.actor->GetMapper()->ScalarVisibilityOff();
    }
    this->scene.renderer->AddViewProp(prop.prop);
    for (const double y : { 0.0, 2.0 })
    {
      prop.leaf->AddPosition(0.0, y, 0.0);
      Box box = shownSquare;
      box.lower.y += y;
      box.upper.y += y;
      const int lit = this->scene.redAt(this->scene.renderPlain(), 0.5, y);
      this->scene.render(); // VTK makes inner mappers in the first frames
      this->scene.render();
      const Picture picture = this->scene.render();
      EXPECT_EQ(this->scene.report().surfacesExtracted, 0) << "a frame like the last one";
      EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());
      expectRight(checkFloor(this->scene, picture, floorUnderSun(box, 8.0), band), 7200);
      EXPECT_EQ(this->scene.redAt(picture, 0.5, y), lit) << "its lit top";
      const vtkSmartPointer<vtkActor> above =
        this->scene.addBox({ -4.0, y - 0.8, 5.0 }, { -2.4, y + 0.8, 5.1 });
      const Picture shaded = this->scene.render();
      EXPECT_EQ(this->scene.redAt(shaded, 0.5, y), 0) << "its shaded top";
      EXPECT_EQ(this->scene.redAt(shaded, -1.0, y), lit) << "its lit top";
      this->scene.renderer->RemoveActor(above);
    }
    this->scene.renderer->RemoveViewProp(prop.prop);
  }
}

TEST_P(Props, castUnlessToldOtherwise)
{
  vtkActor* square = this->addSquare();
  EXPECT_TRUE(this->dark(2.5, 0.0));
  EXPECT_FALSE(this->dark(3.5, 0.0));
  vtkGnomonPropKeys::SetCasts(square, false);
  EXPECT_FALSE(this->dark(2.5, 0.0));
  vtkGnomonPropKeys::SetCasts(square, true);
  EXPECT_TRUE(this->dark(2.5, 0.0));
  square->SetScale(1.0, 1e-80, 1.0);
  EXPECT_FALSE(this->dark(2.5, 0.0));
  EXPECT_EQ(this->scene.report().droppedZeroArea, 2u);
}

/// A prop before the others leaves the receivers' state changed behind it.
TEST_P(Props, oneThatBindsItsOwnFramebufferLeavesOthersRight)
{
  vtkActor* const square = this->addSquare();
  const Picture without = this->scene.render();
  vtkNew<ElsewhereMapper> mapper;
  mapper->SetInputConnection(squareOf(0.5)->GetOutputPort());
  const auto elsewhere = actorOf(mapper);
  vtkGnomonPropKeys::SetCasts(elsewhere, false);
  for (const vtkSmartPointer<vtkActor> later : { this->scene.floor(), square })
  {
    this->scene.renderer->RemoveActor(later);
    this->scene.renderer->AddActor(elsewhere); // again: it stays the first
    this->scene.renderer->AddActor(later);
  }
  EXPECT_EQ(differingPixels(without, this->scene.render()), 0u);
}

TEST_P(Props, oneThatDoesNotReceiveStillCastsOnOthers)
{
  vtkActor* square = this->addSquare();
  this->scene.addBox({ -1.5, -0.2, 3.0 }, { -0.5, 0.2, 3.2 }); // shades the square at x = 0
  EXPECT_TRUE(this->dark(0.0, 0.0));
  vtkGnomonPropKeys::SetReceives(square, false);
  EXPECT_FALSE(this->dark(0.0, 0.0));
  EXPECT_TRUE(this->dark(2.5, 0.8));
}

/// An assembly copies its property keys to its parts, so two props of the renderer share them.
TEST_P(Props, partsOfAssembliesMayBeInTheRendererToo)
{
  vtkActor* square = this->addSquare();
  const auto assembly = held(square);
  assembly->SetPosition(0.0, 3.0, 0.0);
  this->scene.renderer->AddActor(assembly);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_TRUE(this->dark(2.5, 0.0));
    EXPECT_TRUE(this->dark(2.5, 3.0));
    EXPECT_FALSE(this->dark(3.5, 3.0));
  }
}

/// As for the parts of VTK's old widgets, which are ordinary actors.
TEST_P(Props, nothingIsSaidOfThoseThatAreToDoNeither)
{
  vtkActor* const outline = this->scene.addBox({ -1.0, 2.0, 1.0 }, { 0.0, 3.0, 2.0 });
  outline->GetProperty()->SetRepresentationToWireframe();
  this->scene.render();
  EXPECT_EQ(this->scene.report().leftOut.size(), 1u);
  EXPECT_THAT(this->messages_.warnings(), testing::SizeIs(1));
  vtkGnomonPropKeys::SetCasts(outline, false);
  this->scene.render();
  EXPECT_EQ(this->scene.report().leftOut.size(), 1u);
  vtkGnomonPropKeys::SetReceives(outline, false);
  this->scene.render();
  EXPECT_THAT(this->scene.report().leftOut, testing::IsEmpty());
  EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());
}

TEST_P(Props, levelsOfDetailCastAsDrawn)
{
  const auto levelAt = [](double x, double seconds)
  {
    const auto mapper = vtkSmartPointer<TimedMapper>::New();
    mapper->Seconds = seconds;
    mapper->SetInputConnection(
      boxOf({ x - 0.5, -0.5, 1.5 }, { x + 0.5, 0.5, 2.5 })->GetOutputPort());
    return mapper;
  };
  vtkNew<vtkLODProp3D> prop;
  prop->AutomaticLODSelectionOff();
  const int fine = prop->AddLOD(levelAt(-2.0, 1.0), 0.0);
  const int coarse = prop->AddLOD(levelAt(0.0, 0.001), 0.0);
  prop->SetPosition(0.0, 3.0, 0.0);
  this->scene.renderer->AddViewProp(prop);

  vtkNew<vtkLODActor> actor;
  actor->SetMapper(levelAt(-2.0, 1.0));
  actor->AddLODMapper(levelAt(0.0, 0.001));
  actor->SetPosition(0.0, -3.0, 0.0);
  this->scene.renderer->AddActor(actor);

  prop->SetSelectedLODID(fine);
  this->scene.window->SetDesiredUpdateRate(1e-6); // unlimited time
  EXPECT_TRUE(this->dark(0.0, 3.0));
  EXPECT_TRUE(this->dark(0.0, -3.0));
  EXPECT_FALSE(this->dark(2.0, 3.0));
  EXPECT_FALSE(this->dark(2.0, -3.0));
  EXPECT_FALSE(this->dark(-2.0, 3.0)) << "its top is lit";

  prop->SetSelectedLODID(coarse);
  this->scene.window->SetDesiredUpdateRate(1e9); // no time
  EXPECT_FALSE(this->dark(-0.8, 3.0));
  EXPECT_FALSE(this->dark(-0.8, -3.0));
  EXPECT_TRUE(this->dark(2.0, 3.0));
  EXPECT_TRUE(this->dark(2.0, -3.0));
  EXPECT_FALSE(this->dark(0.0, -3.0)) << "its top is lit";
  EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());
}

TEST_P(Props, quadricLevelsOfDetailCastAsDrawn)
{
  vtkNew<QuietInteractor> interactor;
  interactor->SetRenderWindow(this->scene.window);
  const auto actor = actorOf<vtkQuadricLODActor>(mapperOf(ballOf(glm::dvec3(0.0), 1.0, 120, 60)));
  actor->SetPosition(0.0, 0.0, 2.0);
  this->scene.renderer->AddActor(actor);
  this->scene.window->SetDesiredUpdateRate(1e-6);
  EXPECT_TRUE(this->dark(2.0, 0.0));
  const std::size_t full = this->scene.report().triangles;
  this->scene.window->SetDesiredUpdateRate(1e9);
  this->scene.render(); // VTK makes the coarse level here
  EXPECT_TRUE(this->dark(2.0, 0.0));
  EXPECT_LT(this->scene.report().triangles, full - 1000u);
  EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());
}

/// A square of side 2 at height 2, of which half the light passes, in the opaque pass. The floor is
/// seen through it; both are lit but where boxes shade one of them.
TEST_P(Props, seenThroughOnesHideNoReceiver)
{
  const auto square = outputOf(squareOf(1.0, 2.0));
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  colours->SetNumberOfTuples(4);
  colours->Fill(255.0);
  colours->FillComponent(3, 128.0);
  const auto coloured = copyOf(squareOf(1.0, 2.0));
  coloured->GetPointData()->SetScalars(colours);
  const auto blocks = blocksOf({ square });
  enum
  {
    ByProperty,
    ByScalars,
    ByBlocks,
    Unlit
  };
  this->scene.addBox({ -1.5, 0.2, 3.0 }, { -0.5, 0.6, 3.2 });   // shades the square
  this->scene.addBox({ -3.3, -0.6, 3.0 }, { -2.9, -0.2, 3.2 }); // shades the floor under it
  for (const int opacity : { ByProperty, ByScalars, ByBlocks, Unlit })
  {
    vtkSmartPointer<vtkMapper> mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
    if (opacity == ByBlocks)
    {
      auto shared = vtkSmartPointer<SharedBlocksMapper>::New();
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      shared->SetCompositeDataDisplayAttributes(attributes);
      attributes->SetBlockOpacity(square, 0.5);
      mapper = shared;
      mapper->SetInputDataObject(blocks);
    }
    else
    {
      mapper->SetInputDataObject(opacity == ByScalars ? coloured : square);
    }
    const auto veil = actorOf(mapper);
    veil->ForceOpaqueOn();
    veil->GetProperty()->SetOpacity(opacity == ByProperty || opacity == Unlit ? 0.5 : 1.0);
    veil->GetProperty()->SetLighting(opacity != Unlit);
    const auto assembly = held(veil);
    vtkNew<vtkPropAssembly> parts;
    parts->AddPart(veil);
    const auto follower = actorOf<vtkFollower>(mapper);
    follower->SetCamera(this->scene.renderer->GetActiveCamera());
    follower->SetProperty(veil->GetProperty());
    follower->ForceOpaqueOn();
    for (vtkProp* prop :
      std::initializer_list<vtkProp*>{ veil.Get(), assembly.Get(), parts.Get(), follower.Get() })
    {
      if (prop == follower && opacity == ByBlocks)
      {
        continue; // VTK does not draw it
      }
      SCOPED_TRACE(std::to_string(opacity) + " " + prop->GetClassName());
      this->scene.renderer->AddViewProp(prop);
      const Picture picture = this->scene.render();
      this->scene.renderer->RemoveViewProp(prop);
      const int lit = opacity == Unlit ? 255 : 180;
      const int shaded = opacity == Unlit ? 255 : 0;
      EXPECT_NEAR(this->scene.redAt(picture, 0.0, 0.4), (shaded + 180) / 2, 2);
      EXPECT_NEAR(this->scene.redAt(picture, 0.0, -0.4), (lit + 0) / 2, 2);
      EXPECT_NEAR(this->scene.redAt(picture, 0.0, 0.8), (lit + 180) / 2, 2);
    }
  }
}

TEST_P(Props, levelsOfDetailMayShareAMapper)
{
  const auto mapper = mapperOf(boxOf({ -2.5, -0.5, 1.5 }, { -1.5, 0.5, 2.5 }));
  vtkNew<vtkLODProp3D> prop;
  prop->AutomaticLODSelectionOff();
  vtkNew<vtkProperty> white;
  vtkNew<vtkProperty> whiteToo;
  const int one = prop->AddLOD(mapper, white, 0.0);
  const int other = prop->AddLOD(mapper, whiteToo, 0.0);
  this->scene.renderer->AddViewProp(prop);
  this->scene.addBox({ -3.3, -0.2, 3.4 }, { -2.9, 0.2, 3.6 }); // shades the top at x = -2.4 .. -1.8
  for (const int level : { one, other, one })
  {
    prop->SetSelectedLODID(level);
    EXPECT_TRUE(this->dark(-2.1, 0.0)) << level;
    EXPECT_FALSE(this->dark(-1.6, 0.0)) << level;
  }
}

TEST_P(Props, castersOutsideTheViewCast)
{
  this->addSquare();
  this->scene.lookDown(0.4, 2.45);
  EXPECT_TRUE(this->dark(2.5, 0.0));
  this->scene.renderer->GetActiveCamera()->SetClippingRange(19.0, 21.0); // behind the near plane
  EXPECT_TRUE(this->dark(2.5, 0.0));
}

TEST_P(Props, followersTurnWithTheCamera)
{
  const auto sign = actorOf<vtkFollower>(mapperOf(squareOf(1.0)));
  sign->SetPosition(0.0, 0.0, 2.0);
  sign->SetCamera(this->scene.renderer->GetActiveCamera());
  this->scene.renderer->AddActor(sign);
  this->scene.renderer->GetActiveCamera()->Roll(45.0); // the sign's corners lie on the axes
  const Picture rolled = this->scene.render();
  this->scene.renderer->GetActiveCamera()->Roll(-45.0);
  EXPECT_GT(differingPixels(rolled, this->scene.render(), 100), 50u);
  EXPECT_TRUE(this->dark(2.9, 0.9));
}

} // namespace gnomon::test
