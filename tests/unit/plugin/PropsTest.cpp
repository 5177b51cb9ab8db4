// Which props cast and receive, and where their triangles are.

#include "PassScene.h"

#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtk_versions/SharedBlocksMapper.h"
#include "shadowtech/base/Gl.h"

#include <vtkAssembly.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositePolyDataMapper.h>
#include <vtkCubeSource.h>
#include <vtkDataSetMapper.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkLODActor.h>
#include <vtkLODProp3D.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProp3DFollower.h>
#include <vtkPropAssembly.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkQuadricLODActor.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// A floor from straight above, under a sun at 45 degrees that travels along +x. A caster at height
/// z shades the floor z further along x.
class Props
  : public PassTest
  , public testing::WithParamInterface<Way>
{
protected:
  Props()
  {
    this->floor = this->scene.addFloor(8.0);
    this->sun = this->scene.addSun({ 1.0, 0.0, -1.0 });
    this->scene.choose(GetParam());
    this->scene.lookDown(6.0);
  }

  /// A square of side 2 at height 2 over (x, y), its front up or down; it shades (x + 2, y).
  vtkActor* addSquare(bool frontUp, double x = 0.0, double y = 0.0)
  {
    vtkNew<vtkPlaneSource> square;
    const double side = frontUp ? 1.0 : -1.0;
    square->SetOrigin(-side, -1.0, 2.0);
    square->SetPoint1(side, -1.0, 2.0);
    square->SetPoint2(-side, 1.0, 2.0);
    vtkActor* actor = this->scene.add(square);
    actor->SetPosition(x, y, 0.0);
    return actor;
  }
  /// Draw the scene. Return true if a floor point is dark; it must be dark or lit.
  bool dark(double x, double y)
  {
    const int value = this->scene.redAt(this->scene.render(), x, y);
    EXPECT_TRUE(value == 0 || std::abs(value - 180) <= 1) << value;
    return value == 0;
  }

  PassScene scene{ 120, 120 };
  vtkActor* floor;
  vtkLight* sun;
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
    gnomon::GlTexture texture;
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

} // namespace

//------------------------------------------------------------------------------
TEST_P(Props, castUnlessToldOtherwise)
{
  vtkActor* square = this->addSquare(true);
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

//------------------------------------------------------------------------------
/// A prop before the others leaves the receivers' state changed behind it.
TEST_P(Props, oneThatBindsItsOwnFramebufferLeavesOthersRight)
{
  this->addSquare(true);
  const Picture without = this->scene.render();
  vtkNew<vtkPlaneSource> plane;
  vtkNew<ElsewhereMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> elsewhere;
  elsewhere->SetMapper(mapper);
  vtkGnomonPropKeys::SetCasts(elsewhere, false);
  vtkCollectionSimpleIterator iterator;
  std::vector<vtkSmartPointer<vtkProp>> props;
  vtkPropCollection* all = this->scene.renderer->GetViewProps();
  all->InitTraversal(iterator);
  while (vtkProp* prop = all->GetNextProp(iterator))
  {
    props.emplace_back(prop);
  }
  this->scene.renderer->RemoveAllViewProps();
  this->scene.renderer->AddViewProp(elsewhere);
  for (vtkProp* prop : props)
  {
    this->scene.renderer->AddViewProp(prop);
  }
  EXPECT_EQ(differingPixels(without, this->scene.render()), 0u);
}

//------------------------------------------------------------------------------
TEST_P(Props, oneThatDoesNotReceiveStillCastsOnOthers)
{
  vtkActor* square = this->addSquare(true);
  this->scene.addBox({ -1.5, -0.2, 3.0 }, { -0.5, 0.2, 3.2 }); // shades the square at x = 0
  EXPECT_TRUE(this->dark(0.0, 0.0));
  vtkGnomonPropKeys::SetReceives(square, false);
  EXPECT_FALSE(this->dark(0.0, 0.0));
  EXPECT_TRUE(this->dark(2.5, 0.8));
}

//------------------------------------------------------------------------------
TEST_P(Props, oneSidedOnesCastFromTheirFront)
{
  vtkActor* up = this->addSquare(true, 0.0, 2.0);
  vtkActor* down = this->addSquare(false, 0.0, -2.0);
  EXPECT_TRUE(this->dark(2.5, 2.0));
  EXPECT_TRUE(this->dark(2.5, -2.0)) << "both sides cast";
  vtkGnomonPropKeys::SetOneSided(up, true);
  vtkGnomonPropKeys::SetOneSided(down, true);
  EXPECT_TRUE(this->dark(2.5, 2.0));
  EXPECT_FALSE(this->dark(2.5, -2.0)) << "its back is towards the light";
}

//------------------------------------------------------------------------------
TEST_P(Props, mirroredSolidsCastAndReceiveAsOthersDo)
{
  vtkActor* box = this->scene.addBox({ 1.0, -1.0, 1.0 }, { 2.0, 1.0, 2.0 });
  box->SetScale(-1.0, 1.0, 1.0);     // x in [-2, -1]
  EXPECT_TRUE(this->dark(0.5, 0.0)); // -2 + 1 .. -1 + 2
  EXPECT_FALSE(this->dark(1.5, 0.0));
  const int top = this->scene.redAt(this->scene.render(), -1.5, 0.0);
  this->scene.usePlain();
  EXPECT_EQ(top, this->scene.redAt(this->scene.render(), -1.5, 0.0));
}

//------------------------------------------------------------------------------
TEST_P(Props, partsOfAssembliesCastWhereTheyStandAndAsTheAssemblySays)
{
  vtkActor* part = this->addSquare(true);
  this->scene.renderer->RemoveActor(part); // the window drops it; the assembly refers to it
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-0.5, -0.5, 0.0);
  source->SetPoint1(0.5, -0.5, 0.0);
  source->SetPoint2(-0.5, 0.5, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> square;
  square->SetMapper(mapper);
  square->SetPosition(0.0, 2.0, 2.0);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(square);
  inner->RotateZ(90.0); // the square at (-2, 0)
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->SetPosition(0.0, 3.0, 0.0); // at (-2, 3), and its shadow at (0, 3)
  this->scene.renderer->AddActor(outer);
  EXPECT_TRUE(this->dark(0.3, 3.0));
  EXPECT_FALSE(this->dark(2.0, 2.0));
  vtkGnomonPropKeys::SetCasts(outer, false);
  EXPECT_FALSE(this->dark(0.3, 3.0));
  vtkGnomonPropKeys::SetCasts(outer, true);
  outer->SetPosition(0.0, -3.0, 0.0);
  EXPECT_TRUE(this->dark(0.3, -3.0));
  EXPECT_EQ(this->scene.report().surfacesRetransformed, 1);
}

//------------------------------------------------------------------------------
TEST_P(Props, assembliesRestUntilSomethingChanges)
{
  const vtkSmartPointer<vtkActor> square = this->addSquare(true);
  this->scene.renderer->RemoveActor(square);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(square);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(inner);
  this->scene.renderer->AddActor(assembly);
  const auto drawnAgain = [&]
  {
    this->scene.render();
    return this->scene.report().receiversDrawn;
  };
  const bool draws = drawnAgain() > 0; // not inline
  drawnAgain();                        // VTK's mappers settle
  EXPECT_EQ(drawnAgain(), 0);
  const auto expectDrawn = [&](const char* change)
  {
    EXPECT_EQ(drawnAgain(), draws ? 1 : 0) << change;
    EXPECT_EQ(drawnAgain(), 0) << change;
  };
  square->AddPosition(0.0, 0.5, 0.0);
  expectDrawn("a part moves");
  inner->AddPosition(0.0, 0.5, 0.0);
  expectDrawn("an assembly in it moves");
  assembly->AddPosition(0.0, 0.5, 0.0);
  expectDrawn("it moves");
  square->GetProperty()->SetInterpolationToFlat();
  expectDrawn("a part's property");
  vtkPolyData* const data = vtkPolyDataMapper::SafeDownCast(square->GetMapper())->GetInput();
  data->GetPoints()->SetPoint(0, 0.1, 0.1, 0.0);
  data->GetPoints()->Modified();
  data->Modified();
  expectDrawn("a part's points");
  vtkGnomonPropKeys::SetReceives(assembly, false);
  expectDrawn("it receives no more");
  assembly->VisibilityOff();
  expectDrawn("it is hidden");
}

//------------------------------------------------------------------------------
/// An assembly copies its property keys to its parts, so two props of the renderer share them.
TEST_P(Props, partsOfAssembliesMayBeInTheRendererToo)
{
  vtkActor* square = this->addSquare(true);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(square);
  assembly->SetPosition(0.0, 3.0, 0.0);
  this->scene.renderer->AddActor(assembly);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_TRUE(this->dark(2.5, 0.0));
    EXPECT_TRUE(this->dark(2.5, 3.0));
    EXPECT_FALSE(this->dark(3.5, 3.0));
  }
}

//------------------------------------------------------------------------------
TEST_P(Props, blocksOfACompositeCastAndReceiveUnlessHidden)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto setBlock = [&](unsigned int number, double y)
  {
    vtkNew<vtkCubeSource> box;
    box->SetBounds(-0.5, 0.5, y - 0.5, y + 0.5, 1.5, 2.5);
    box->Update();
    blocks->SetBlock(number, box->GetOutput());
  };
  setBlock(0, -3.0);
  setBlock(1, 0.0);
  setBlock(2, 3.0);
  vtkNew<gnomon::SharedBlocksMapper> mapper;
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->scene.renderer->AddActor(actor);
  for (const double y : { -3.0, 0.0, 3.0 })
  {
    EXPECT_TRUE(this->dark(2.0, y)) << y;
  }
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0); // counts the last of the three frames
  mapper->SetBlockVisibility(2, false); // by flat index: the tree is 0, its children 1, 2, 3
  EXPECT_TRUE(this->dark(2.0, -3.0));
  EXPECT_FALSE(this->dark(2.0, 0.0));
  EXPECT_TRUE(this->dark(2.0, 3.0));

  // A block that another caster shades.
  this->scene.addBox(
    { -1.8, -3.3, 3.4 }, { -1.2, -2.7, 3.6 }); // shades z = 2.5 at x = -0.9 .. -0.1
  const Picture picture = this->scene.render();
  EXPECT_EQ(this->scene.redAt(picture, -0.3, -3.0), 0);
  EXPECT_NEAR(this->scene.redAt(picture, 0.3, -3.0), 180, 1);
  EXPECT_NEAR(this->scene.redAt(picture, -0.3, 3.0), 180, 1);
}

//------------------------------------------------------------------------------
TEST_P(Props, dataSetsAndPartsCastAndReceive)
{
  vtkNew<vtkImageData> grid; // the cube [-1, 1] at height 2
  grid->SetDimensions(2, 2, 2);
  grid->SetSpacing(2.0, 2.0, 2.0);
  grid->SetOrigin(-1.0, -1.0, 2.0);
  vtkNew<vtkDataSetMapper> ofGrid;
  ofGrid->SetInputData(grid);
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(-1.0, 1.0, -1.0, 1.0, 2.0, 4.0);
  vtkNew<vtkCompositePolyDataMapper> ofParts;
  ofParts->SetInputConnection(cube->GetOutputPort());
  for (vtkMapper* mapper : { static_cast<vtkMapper*>(ofGrid), static_cast<vtkMapper*>(ofParts) })
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->scene.renderer->AddActor(actor);
    for (int frame = 0; frame < 2; ++frame) // VTK makes the inner mappers in the first
    {
      const Picture picture = this->scene.render();
      EXPECT_EQ(this->scene.redAt(picture, 3.0, 0.0), 0) << "shaded floor";
      EXPECT_GT(this->scene.redAt(picture, -3.0, 0.0), 150) << "lit floor";
      EXPECT_GT(this->scene.redAt(picture, 0.0, 0.0), 150) << "lit top";
    }
    vtkActor* const above = this->addSquare(true);
    above->SetPosition(-2.0, 0.0, 4.0);
    EXPECT_LT(this->scene.redAt(this->scene.render(), -0.5, 0.0), 120) << "shaded top";
    this->scene.renderer->RemoveActor(above);
    this->scene.renderer->RemoveActor(actor);
  }
  EXPECT_TRUE(this->messages_.warnings().empty());
}

//------------------------------------------------------------------------------
TEST_P(Props, imagesCastAndReceiveIfAsked)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 1);
  image->SetSpacing(0.5, 0.5, 1.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  image->GetPointData()->GetScalars()->Fill(255.0);
  vtkNew<vtkImageActor> slice; // the square [-1.25, 1.25] at height 2
  slice->SetInputData(image);
  slice->SetPosition(-1.0, -1.0, 2.0);
  slice->GetProperty()->SetAmbient(0.0);
  slice->GetProperty()->SetDiffuse(1.0);
  this->scene.renderer->AddViewProp(slice);
  EXPECT_GT(this->scene.redAt(this->scene.render(), 2.5, 0.0), 150) << "not asked yet";
  EXPECT_EQ(this->messages_.warnings().size(), 1u);
  vtkGnomonPropKeys::SetCasts(slice, true);
  const Picture picture = this->scene.render();
  EXPECT_EQ(this->scene.redAt(picture, 2.5, 0.0), 0) << "shaded floor";
  EXPECT_GT(this->scene.redAt(picture, 3.4, 0.0), 150) << "lit floor beyond";
  EXPECT_GT(this->scene.redAt(picture, 0.5, 0.0), 150) << "lit image";
  EXPECT_EQ(differingPixels(picture, this->scene.render()), 0u);
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0) << "a frame like the last one";
  this->addSquare(true)->SetPosition(-4.0, 0.0, 4.0);
  const Picture shaded = this->scene.render();
  EXPECT_EQ(this->scene.redAt(shaded, 0.5, 0.0), 0) << "shaded image";
  EXPECT_GT(this->scene.redAt(shaded, -1.1, 1.1), 150) << "lit image";
  slice->SetPosition(-1.0, 2.0, 2.0);
  EXPECT_EQ(this->scene.redAt(this->scene.render(), 2.5, 3.0), 0) << "moved";
}

//------------------------------------------------------------------------------
TEST_P(Props, litPropsLeftOutAreWarnedOfOnce)
{
  this->addSquare(true)->GetProperty()->SetRepresentationToWireframe();
  this->addSquare(true, 2.0)->GetProperty()->SetRepresentationToWireframe();
  vtkActor* const points = this->addSquare(true);
  this->scene.render();
  points->GetProperty()->SetRepresentationToPoints();
  this->scene.render();
  this->scene.render();
  ASSERT_EQ(this->messages_.warnings().size(), 2u);
  EXPECT_THAT(
    this->messages_.warnings()[0], testing::HasSubstr(": vtkOpenGLActor (as a wireframe). See"));
  EXPECT_THAT(this->messages_.warnings()[1], testing::HasSubstr(": vtkOpenGLActor (as points)."));
}

//------------------------------------------------------------------------------
TEST_P(Props, glyphsCastAndReceive)
{
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(-1.0, -3.0, 1.0);
  places->InsertNextPoint(-1.0, 3.0, 2.0);
  vtkNew<vtkPolyData> points;
  points->SetPoints(places);
  vtkNew<vtkCubeSource> box; // 1 x 1 x 1 around each point
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetSourceConnection(box->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->scene.renderer->AddActor(actor);
  EXPECT_TRUE(this->dark(0.6, -3.0)); // x from -1.5 + 0.5 to -0.5 + 1.5
  EXPECT_FALSE(this->dark(1.2, -3.0));
  EXPECT_TRUE(this->dark(1.8, 3.0)); // x from -1.5 + 1.5 to -0.5 + 2.5
  EXPECT_FALSE(this->dark(2.2, 3.0));
  for (const double y : { -3.0, 3.0 })
  {
    EXPECT_FALSE(this->dark(-0.8, y)) << "the glyph's own top, at " << y;
  }
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0); // counts the last of the frames
  EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());

  this->scene.addBox({ -1.8, 2.7, 3.0 }, { -1.5, 3.3, 3.3 }); // shades z = 2.5 at x = -1.3 .. -0.7
  EXPECT_TRUE(this->dark(-1.0, 3.0));
  EXPECT_FALSE(this->dark(-1.0, -3.0));
  places->SetPoint(0, -1.0, -1.0, 1.0);
  places->Modified();
  EXPECT_FALSE(this->dark(0.6, -3.0));
  EXPECT_TRUE(this->dark(0.6, -1.0));
}

//------------------------------------------------------------------------------
TEST_P(Props, followersCastAsTheyFaceTheCamera)
{
  // A sign that faces the camera, and so lies flat under a camera that looks straight down.
  const auto sign = vtkSmartPointer<vtkPlaneSource>::New();
  sign->SetOrigin(-0.5, -0.5, 0.0);
  sign->SetPoint1(0.5, -0.5, 0.0);
  sign->SetPoint2(-0.5, 0.5, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sign->GetOutputPort());
  vtkCamera* camera = this->scene.renderer->GetActiveCamera();

  vtkNew<vtkFollower> follower;
  follower->SetMapper(mapper);
  follower->SetPosition(0.0, 3.0, 2.0);
  follower->SetCamera(camera);
  this->scene.renderer->AddActor(follower);

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkProp3DFollower> propFollower;
  propFollower->SetProp3D(actor);
  propFollower->SetPosition(0.0, -3.0, 2.0);
  propFollower->SetCamera(camera);
  this->scene.renderer->AddViewProp(propFollower);

  for (const double y : { -3.0, 3.0 })
  {
    EXPECT_TRUE(this->dark(2.3, y + 0.3)) << y;
    EXPECT_FALSE(this->dark(2.7, y + 0.3)) << y;
  }
  this->scene.addBox({ -1.2, -3.2, 3.0 }, { -0.8, -2.8, 3.2 }); // shades z = 2 at x = 0.2
  this->scene.addBox({ -1.2, 2.8, 3.0 }, { -0.8, 3.2, 3.2 });
  for (const double y : { -3.0, 3.0 })
  {
    EXPECT_TRUE(this->dark(0.1, y)) << y;
    EXPECT_FALSE(this->dark(-0.3, y)) << y;
  }
  EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());

  camera->Roll(45.0); // turns the signs, too: their corners lie on the axes
  const Picture rolled = this->scene.render();
  camera->Roll(-45.0);
  const Picture straight = this->scene.render();
  EXPECT_GT(differingPixels(rolled, straight, 100), 50u);
  EXPECT_TRUE(this->dark(2.3, 3.3));
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
TEST_P(Props, followersWithoutACameraAreActors)
{
  const auto alone = [](vtkProp3D* part) { return vtkSmartPointer<vtkProp>(part); };
  const auto inAssembly = [](vtkProp3D* part)
  {
    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(part);
    assembly->SetPosition(0.5, 0.0, 0.0);
    return vtkSmartPointer<vtkProp>(assembly);
  };
  const auto inAssemblyOfAssembly = [&](vtkProp3D* part)
  { return inAssembly(vtkProp3D::SafeDownCast(inAssembly(part))); };
  const auto inPropAssembly = [](vtkProp3D* part)
  {
    vtkNew<vtkPropAssembly> assembly;
    assembly->AddPart(part);
    return vtkSmartPointer<vtkProp>(assembly);
  };
  const auto followed = [&](vtkProp3D* part)
  {
    vtkNew<vtkProp3DFollower> follower;
    follower->SetProp3D(part);
    follower->SetCamera(this->scene.renderer->GetActiveCamera());
    return vtkSmartPointer<vtkProp>(follower);
  };
  using Hold = std::function<vtkSmartPointer<vtkProp>(vtkProp3D*)>;
  for (const Hold& hold : { Hold(alone), Hold(inAssembly), Hold(inAssemblyOfAssembly),
         Hold(inPropAssembly), Hold(followed) })
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(0.0, 3.0, 2.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(ball->GetOutputPort());
    const auto draw = [&](vtkActor* actor)
    {
      actor->SetMapper(mapper);
      const vtkSmartPointer<vtkProp> prop = hold(actor);
      this->scene.renderer->AddViewProp(prop);
      const VisibilityImages kept = drawKept(this->scene);
      EXPECT_THAT(this->scene.report().notes, testing::IsEmpty());
      this->scene.renderer->RemoveViewProp(prop);
      return kept;
    };
    const VisibilityImages ofActor = draw(vtkNew<vtkActor>());
    const VisibilityImages ofFollower = draw(vtkNew<vtkFollower>());
    EXPECT_EQ(ofFollower.visibility, ofActor.visibility);
    EXPECT_EQ(ofFollower.cell, ofActor.cell);
    EXPECT_EQ(ofFollower.prop, ofActor.prop);
    EXPECT_GT(
      std::count(ofActor.visibility.front().begin(), ofActor.visibility.front().end(), 0.0f), 10);
  }
}

//------------------------------------------------------------------------------
TEST_P(Props, levelsOfDetailCastAsDrawn)
{
  const auto levelAt = [](double x, double seconds)
  {
    const auto box = vtkSmartPointer<vtkCubeSource>::New();
    box->SetBounds(x - 0.5, x + 0.5, -0.5, 0.5, 1.5, 2.5);
    const auto mapper = vtkSmartPointer<TimedMapper>::New();
    mapper->Seconds = seconds;
    mapper->SetInputConnection(box->GetOutputPort());
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

//------------------------------------------------------------------------------
/// VTK culls the prop, so the selected level was never chosen by drawing.
TEST_P(Props, selectedLevelsOfDetailCastThoughTheyWereNeverInView)
{
  vtkNew<vtkLODProp3D> prop;
  prop->AutomaticLODSelectionOff();
  const auto addLevelAt = [&](double height)
  {
    vtkNew<vtkCubeSource> box;
    box->SetBounds(-0.5, 0.5, -0.5, 0.5, height - 0.5, height + 0.5);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(box->GetOutputPort());
    return prop->AddLOD(mapper, 0.0);
  };
  addLevelAt(6.0);
  prop->SetSelectedLODID(addLevelAt(10.0));
  prop->SetPosition(-10.0, 0.0, 0.0);
  this->scene.renderer->AddViewProp(prop);
  EXPECT_TRUE(this->dark(0.0, 0.0));
  EXPECT_FALSE(this->dark(-4.0, 0.0));
}

//------------------------------------------------------------------------------
TEST_P(Props, quadricLevelsOfDetailCastAsDrawn)
{
  vtkNew<QuietInteractor> interactor;
  interactor->SetRenderWindow(this->scene.window);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(120);
  sphere->SetPhiResolution(60);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkQuadricLODActor> actor;
  actor->SetMapper(mapper);
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

//------------------------------------------------------------------------------
TEST_P(Props, translucentOnesCastIfAsked)
{
  vtkActor* square = this->addSquare(true);
  square->GetProperty()->SetOpacity(0.5);
  EXPECT_FALSE(this->dark(2.5, 0.0));
  vtkGnomonPropKeys::SetCasts(square, true);
  EXPECT_TRUE(this->dark(2.5, 0.0));
  EXPECT_FALSE(this->dark(3.5, 0.0));
  vtkGnomonPropKeys::SetCasts(square, false);
  EXPECT_FALSE(this->dark(2.5, 0.0));

  // Once opaque, it receives like all opaque surfaces.
  vtkGnomonPropKeys::SetCasts(square, true);
  this->scene.addBox({ -1.5, -0.2, 3.0 }, { -0.5, 0.2, 3.2 }); // shades the square at x = 0
  EXPECT_TRUE(this->dark(2.5, 0.5));
  square->GetProperty()->SetOpacity(1.0);
  EXPECT_TRUE(this->dark(0.0, 0.0));
  EXPECT_FALSE(this->dark(0.0, 0.5));
}

//------------------------------------------------------------------------------
/// A square of side 2 at height 2, of which half the light passes, in the opaque pass. The floor is
/// seen through it; both are lit but where boxes shade one of them.
TEST_P(Props, seenThroughOnesHideNoReceiver)
{
  vtkNew<vtkPlaneSource> square;
  square->SetOrigin(-1.0, -1.0, 2.0);
  square->SetPoint1(1.0, -1.0, 2.0);
  square->SetPoint2(-1.0, 1.0, 2.0);
  square->Update();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (int i = 0; i < 4; ++i)
  {
    colours->InsertNextTuple4(255, 255, 255, 128);
  }
  vtkNew<vtkPolyData> coloured;
  coloured->ShallowCopy(square->GetOutput());
  coloured->GetPointData()->SetScalars(colours);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square->GetOutput());
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
      auto shared = vtkSmartPointer<gnomon::SharedBlocksMapper>::New();
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      shared->SetCompositeDataDisplayAttributes(attributes);
      attributes->SetBlockOpacity(square->GetOutput(), 0.5);
      mapper = shared;
      mapper->SetInputDataObject(blocks);
    }
    else
    {
      mapper->SetInputDataObject(opacity == ByScalars ? coloured.Get() : square->GetOutput());
    }
    vtkNew<vtkActor> veil;
    veil->SetMapper(mapper);
    veil->ForceOpaqueOn();
    veil->GetProperty()->SetOpacity(opacity == ByProperty || opacity == Unlit ? 0.5 : 1.0);
    veil->GetProperty()->SetLighting(opacity != Unlit);
    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(veil);
    vtkNew<vtkPropAssembly> parts;
    parts->AddPart(veil);
    vtkNew<vtkFollower> follower;
    follower->SetCamera(this->scene.renderer->GetActiveCamera());
    follower->SetMapper(mapper);
    follower->SetProperty(veil->GetProperty());
    follower->ForceOpaqueOn();
    for (vtkProp* prop : std::initializer_list<vtkProp*>{ veil, assembly, parts, follower })
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

//------------------------------------------------------------------------------
TEST_P(Props, levelsOfDetailMayShareAMapper)
{
  vtkNew<vtkCubeSource> box;
  box->SetBounds(-2.5, -1.5, -0.5, 0.5, 1.5, 2.5);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(box->GetOutputPort());
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

//------------------------------------------------------------------------------
TEST_P(Props, castersOutsideTheViewCast)
{
  this->addSquare(true);
  this->scene.lookDown(0.4, 2.45);
  EXPECT_TRUE(this->dark(2.5, 0.0));
  this->scene.renderer->GetActiveCamera()->SetClippingRange(19.0, 21.0); // behind the near plane
  EXPECT_TRUE(this->dark(2.5, 0.0));
}
