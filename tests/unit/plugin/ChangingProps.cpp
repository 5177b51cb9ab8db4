#include "ChangingProps.h"
#include "Shapes.h"

#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkAssembly.h>
#include <vtkAxesActor.h>
#include <vtkCellArray.h>
#include <vtkCompositePolyDataMapper.h>
#include <vtkDataSetMapper.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageProperty.h>
#include <vtkImageResliceMapper.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkImageStack.h>
#include <vtkLODActor.h>
#include <vtkLODProp3D.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLActor.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProp3DFollower.h>
#include <vtkPropAssembly.h>
#include <vtkProperty.h>
#include <vtkQuadricLODActor.h>
#include <vtkRenderWindow.h>
#include <vtkTextActor3D.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

#include <algorithm>

namespace gnomon::test
{
namespace
{

constexpr double half = 2.0; ///< of a grid's side

/// A grid whose points have a number each.
vtkSmartPointer<vtkPolyData> grid(double halfSide = half, int cells = 12)
{
  const vtkSmartPointer<vtkPolyData> data = outputOf(squareOf(halfSide, 0.0, cells));
  vtkNew<vtkFloatArray> numbers;
  numbers->SetName("numbers");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    numbers->InsertNextValue(static_cast<float>(i) / data->GetNumberOfPoints());
  }
  data->GetPointData()->SetScalars(numbers);
  return data;
}

vtkSmartPointer<vtkImageData> picture()
{
  constexpr int side = 8;
  const auto image = makeVeil(side, side, [](int, int) { return 255; });
  image->SetOrigin(-half, -half, 0.0);
  image->SetSpacing(2.0 * half / (side - 1), 2.0 * half / (side - 1), 1.0);
  return image;
}

/// Finish a prop above the ground: it is drawn from lines, and a plane cuts off a part.
ChangingProp finished(ChangingProp prop)
{
  prop.leaf->SetPosition(0.0, 0.0, 1.0);
  vtkNew<vtkMatrix4x4> matrix;
  prop.leaf->SetUserMatrix(matrix);
  if (prop.actor)
  {
    prop.actor->GetProperty()->SetRepresentationToWireframe();
    prop.actor->GetProperty()->SetLineWidth(3.0);
    prop.actor->GetProperty()->SetPointSize(5.0);
  }
  if (prop.mapper)
  {
    clip(prop.mapper, { 1.5, 0.0, 0.0 }, { -1.0, 0.0, 0.0 });
  }
  if (!prop.prop)
  {
    prop.prop = prop.leaf;
  }
  return prop;
}

ChangingProp propOf(vtkSmartPointer<vtkActor> actor, vtkMapper* mapper)
{
  ChangingProp prop;
  prop.leaf = prop.actor = std::move(actor);
  prop.mapper = mapper;
  prop.actor->SetMapper(mapper);
  return finished(std::move(prop));
}

/// @tparam Mapper of a polydata
template <typename Mapper>
ChangingProp ofData(vtkSmartPointer<vtkActor> actor = vtkSmartPointer<vtkActor>::New())
{
  vtkNew<Mapper> mapper;
  const vtkSmartPointer<vtkPolyData> data = grid();
  mapper->SetInputData(data);
  ChangingProp prop = propOf(std::move(actor), mapper);
  prop.data = data;
  return prop;
}

template <int representation>
ChangingProp makeShown(vtkRenderer*)
{
  ChangingProp prop = ofData<vtkPolyDataMapper>();
  prop.actor->GetProperty()->SetRepresentation(representation);
  return prop;
}

ChangingProp makePipeline(vtkRenderer*)
{
  const auto source = squareOf(half, 0.0, 12);
  ChangingProp prop = propOf(vtkSmartPointer<vtkActor>::New(), mapperOf(source));
  prop.source = source;
  return prop;
}

ChangingProp makeLines(vtkRenderer* renderer)
{
  ChangingProp prop = makeShown<VTK_SURFACE>(renderer);
  prop.data->SetLines(prop.data->GetPolys());
  prop.data->SetPolys(nullptr);
  return prop;
}

ChangingProp makeDataSet(vtkRenderer*)
{
  return ofData<vtkDataSetMapper>();
}

template <typename Mapper>
ChangingProp makeBlocks(vtkRenderer*)
{
  const vtkSmartPointer<vtkPolyData> data = grid();
  const auto blocks = blocksOf({ data });
  vtkNew<Mapper> mapper;
  mapper->SetInputDataObject(blocks);
  ChangingProp prop = propOf(vtkSmartPointer<vtkActor>::New(), mapper);
  prop.data = data;
  prop.changePart = [blocks] { blocks->SetBlock(0, grid(0.5 * half)); };
  return prop;
}

ChangingProp makeGlyphs(vtkRenderer*)
{
  const auto source = squareOf(half / 3.0, 0.0, 3);
  const vtkSmartPointer<vtkPolyData> data = grid(2.0 / 3.0 * half, 2);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(source->GetOutputPort());
  mapper->ScalingOff();
  ChangingProp prop = propOf(vtkSmartPointer<vtkActor>::New(), mapper);
  prop.data = data;
  prop.source = source;
  prop.changePart = [mapper = mapper.Get()] { mapper->SetSourceData(grid(0.1 * half, 1)); };
  return prop;
}

ChangingProp makeCulledGlyphs(vtkRenderer* renderer)
{
  ChangingProp prop = makeGlyphs(renderer);
  prop.actor->GetProperty()->SetRepresentationToSurface();
  vtkGlyph3DMapper::SafeDownCast(prop.mapper)->SetCullingAndLOD(true);
  return prop;
}

ChangingProp makeSplats(vtkRenderer*)
{
  ChangingProp prop = ofData<vtkPointGaussianMapper>();
  auto* const mapper = vtkPointGaussianMapper::SafeDownCast(prop.mapper);
  mapper->SetScaleFactor(0.05);
  prop.changePart = [mapper] { mapper->SetScaleFactor(0.2); };
  return prop;
}

ChangingProp makeFence(vtkRenderer* renderer)
{
  ChangingProp prop = makeShown<VTK_SURFACE>(renderer);
  prop.data->GetPointData()->SetScalars(nullptr);
  prop.image = picture();
  prop.actor->SetTexture(textureOf(prop.image));
  prop.actor->ForceOpaqueOn();
  return prop;
}

/// @tparam Mapper of an image
template <typename Mapper>
ChangingProp makeSlice(vtkRenderer*)
{
  ChangingProp prop;
  prop.image = picture();
  vtkNew<Mapper> mapper;
  mapper->SetInputData(prop.image);
  if (auto* const reslicing = vtkImageResliceMapper::SafeDownCast(mapper))
  {
    vtkNew<vtkPlane> heightOfProps;
    heightOfProps->SetOrigin(0.0, 0.0, 1.0);
    reslicing->SetSlicePlane(heightOfProps);
  }
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  prop.leaf = slice;
  prop.mapper = mapper;
  prop.changePart = [slice = slice.Get()] { slice->GetProperty()->SetOpacity(0.5); };
  return finished(std::move(prop));
}

ChangingProp makeStack(vtkRenderer* renderer)
{
  ChangingProp prop = makeSlice<vtkImageSliceMapper>(renderer);
  vtkNew<vtkImageStack> stack;
  stack->AddImage(vtkImageSlice::SafeDownCast(prop.leaf));
  prop.prop = stack;
  return prop;
}

ChangingProp makeFollower(vtkRenderer* renderer)
{
  vtkNew<vtkFollower> follower;
  follower->SetCamera(renderer->GetActiveCamera());
  return ofData<vtkPolyDataMapper>(vtkSmartPointer<vtkActor>(follower));
}

ChangingProp makePropFollower(vtkRenderer* renderer)
{
  ChangingProp prop = makeShown<VTK_WIREFRAME>(renderer);
  vtkNew<vtkProp3DFollower> follower;
  follower->SetProp3D(prop.leaf);
  follower->SetCamera(renderer->GetActiveCamera());
  prop.prop = follower;
  prop.changePart = [follower = follower.Get(), renderer]
  { follower->SetProp3D(makePipeline(renderer).leaf); };
  return prop;
}

ChangingProp makeLevels(vtkRenderer*)
{
  ChangingProp prop;
  prop.data = grid();
  const auto fine = mapperOf(prop.data);
  vtkNew<vtkProperty> look;
  look->SetRepresentationToWireframe();
  look->SetLineWidth(3.0);
  vtkNew<vtkLODProp3D> levels;
  levels->AutomaticLODSelectionOff();
  const int other = levels->AddLOD(mapperOf(grid(half, 3)), look, 0.0);
  levels->SetSelectedLODID(levels->AddLOD(fine, look, 0.0));
  prop.leaf = levels;
  prop.mapper = fine;
  prop.changePart = [levels = levels.Get(), other, look = vtkSmartPointer<vtkProperty>(look)]
  {
    look->SetLineWidth(1.0);
    levels->SetSelectedLODID(other);
  };
  return finished(std::move(prop));
}

ChangingProp makeQuadricActor(vtkRenderer* renderer)
{
  vtkNew<vtkGenericRenderWindowInteractor> interactor; // without one, VTK does not draw it
  renderer->GetRenderWindow()->SetInteractor(interactor);
  return ofData<vtkPolyDataMapper>(vtkSmartPointer<vtkQuadricLODActor>::New());
}

ChangingProp makeAssembly(vtkRenderer* renderer)
{
  ChangingProp prop = makeShown<VTK_WIREFRAME>(renderer);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(prop.leaf);
  prop.prop = assembly;
  prop.changePart = [assembly = assembly.Get(), leaf = prop.leaf.Get()]
  {
    assembly->SetPosition(0.5, 0.0, 0.0);
    assembly->RemovePart(leaf);
  };
  return prop;
}

ChangingProp makeNest(vtkRenderer* renderer)
{
  ChangingProp prop = makeAssembly(renderer);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(vtkAssembly::SafeDownCast(prop.prop));
  prop.changePart = [inner = vtkAssembly::SafeDownCast(prop.prop)]
  { inner->SetPosition(0.5, 0.0, 0.0); };
  prop.prop = outer;
  return prop;
}

ChangingProp inAssembly(ChangingProp prop)
{
  vtkNew<vtkPropAssembly> assembly;
  assembly->AddPart(prop.prop);
  prop.prop = assembly;
  return prop;
}

ChangingProp makePropAssembly(vtkRenderer* renderer)
{
  ChangingProp prop = inAssembly(makeShown<VTK_WIREFRAME>(renderer));
  prop.changePart = [assembly = vtkPropAssembly::SafeDownCast(prop.prop), renderer]
  { assembly->AddPart(makeSlice<vtkImageSliceMapper>(renderer).leaf); };
  return prop;
}

ChangingProp makeFollowerAssembly(vtkRenderer* renderer)
{
  return inAssembly(makePropFollower(renderer));
}

ChangingProp makeSliceAssembly(vtkRenderer* renderer)
{
  return inAssembly(makeSlice<vtkImageSliceMapper>(renderer));
}

ChangingProp makeText(vtkRenderer*)
{
  ChangingProp prop;
  vtkNew<vtkTextActor3D> text;
  text->SetInput("text");
  text->GetTextProperty()->SetFontSize(1);
  prop.leaf = text;
  prop.changePart = [text = text.Get()] { text->GetTextProperty()->SetFontSize(2); };
  return finished(std::move(prop));
}

ChangingProp makeAxes(vtkRenderer*)
{
  ChangingProp prop;
  vtkNew<vtkAxesActor> axes;
  axes->AxisLabelsOff();
  prop.leaf = axes;
  prop.changePart = [axes = axes.Get()] { axes->SetTotalLength(2.0, 1.0, 0.5); };
  return finished(std::move(prop));
}

/// A prop of a user's class, whose time changes whenever it is drawn.
class RestlessActor : public vtkOpenGLActor
{
public:
  static RestlessActor* New();
  vtkTypeMacro(RestlessActor, vtkOpenGLActor);
  void Render(vtkRenderer* renderer, vtkMapper* mapper) override
  {
    this->Superclass::Render(renderer, mapper);
    this->Modified();
  }
};
vtkStandardNewMacro(RestlessActor);

/// @tparam Actor of a polydata
template <typename Actor>
ChangingProp makeActor(vtkRenderer*)
{
  return ofData<vtkPolyDataMapper>(vtkSmartPointer<Actor>::New());
}

vtkLookupTable* tableOf(const ChangingProp& prop)
{
  auto* const mapper = vtkMapper::SafeDownCast(prop.mapper);
  return mapper ? vtkLookupTable::SafeDownCast(mapper->GetLookupTable()) : nullptr;
}

} // namespace

const std::vector<PropKind>& changingProps()
{
  constexpr bool isSurface = true;
  constexpr bool isRepeatable = true;
  static const std::vector<PropKind> kinds = { { "wireframe", makeShown<VTK_WIREFRAME>, isSurface },
    { "culled glyphs", makeCulledGlyphs, !isSurface, !isRepeatable },
    { "prop assembly", makePropAssembly, isSurface }, { "slice", makeSlice<vtkImageSliceMapper> },
    { "levels", makeLevels }, { "prop follower", makePropFollower, isSurface },
    { "blocks", makeBlocks<SharedBlocksMapper>, isSurface },
    { "pipeline", makePipeline, isSurface }, { "fence", makeFence, isSurface },
    { "nested assembly", makeNest, isSurface }, { "axes", makeAxes },
    { "restless", makeActor<RestlessActor> }, { "lines", makeLines },
    { "points", makeShown<VTK_POINTS>, isSurface }, { "data set", makeDataSet, isSurface },
    { "parts", makeBlocks<vtkCompositePolyDataMapper>, isSurface },
    { "glyphs", makeGlyphs, isSurface }, { "splats", makeSplats },
    { "surface", makeShown<VTK_SURFACE>, isSurface },
    { "resliced", makeSlice<vtkImageResliceMapper>, !isSurface, !isRepeatable },
    { "stack", makeStack }, { "follower", makeFollower, isSurface },
    { "level actor", makeActor<vtkLODActor>, isSurface, !isRepeatable },
    { "quadric actor", makeQuadricActor, isSurface, !isRepeatable },
    { "assembly", makeAssembly, isSurface }, { "slice assembly", makeSliceAssembly },
    { "follower assembly", makeFollowerAssembly, !isSurface, !isRepeatable },
    { "text", makeText } };
  return kinds;
}

const std::vector<PropChange>& propChanges()
{
  const auto any = [](const ChangingProp&) { return true; };
  static const std::vector<PropChange> changes = {
    { "plane in place", &ChangingProp::mapper,
      [](const ChangingProp& prop)
      { prop.mapper->GetClippingPlanes()->GetItem(0)->SetOrigin(0.2, 0.0, 0.0); } },
    { "points in place", &ChangingProp::data,
      [](const ChangingProp& prop) {
        movePoints(prop.data, [](const glm::dvec3& at) { return at * glm::dvec3(1.0, 0.7, 1.0); });
      } },
    { "source", &ChangingProp::source,
      [](const ChangingProp& prop)
      { prop.source->SetPoint2(prop.source->GetPoint2()[0], 0.0, 0.0); } },
    { "pixels in place", &ChangingProp::image,
      [](const ChangingProp& prop)
      {
        auto* const bytes = static_cast<unsigned char*>(prop.image->GetScalarPointer());
        std::fill_n(bytes, 4 * prop.image->GetNumberOfPoints() / 2, std::uint8_t(0));
        prop.image->GetPointData()->GetScalars()->Modified();
      } },
    { "place", any, [](const ChangingProp& prop) { prop.leaf->AddPosition(0.3, 0.2, 0.0); } },
    { "matrix in place", any,
      [](const ChangingProp& prop) { prop.leaf->GetUserMatrix()->SetElement(1, 3, 0.4); } },
    { "scale", any, [](const ChangingProp& prop) { prop.leaf->SetScale(0.8, 1.1, 1.0); } },
    { "thickness", &ChangingProp::actor,
      [](const ChangingProp& prop)
      {
        prop.actor->GetProperty()->SetLineWidth(1.0);
        prop.actor->GetProperty()->SetPointSize(2.0);
      } },
    { "second plane", &ChangingProp::mapper,
      [](const ChangingProp& prop) {
        clip(prop.mapper, { 0.0, 0.5, 0.0 }, { 0.0, -1.0, 0.0 });
      } },
    { "table", tableOf,
      [](const ChangingProp& prop)
      {
        tableOf(prop)->SetHueRange(0.3, 0.5);
        tableOf(prop)->Build();
      } },
    { "representation",
      [](const ChangingProp& prop)
      { return prop.actor && prop.actor->GetProperty()->GetRepresentation() != VTK_POINTS; },
      [](const ChangingProp& prop) { prop.actor->GetProperty()->SetRepresentationToPoints(); } },
    { "receiving", any,
      [](const ChangingProp& prop) { vtkGnomonPropKeys::SetReceives(prop.prop, false); } },
    { "invisible leaf", any, [](const ChangingProp& prop) { prop.leaf->VisibilityOff(); } },
    { "visible leaf", any, [](const ChangingProp& prop) { prop.leaf->VisibilityOn(); } },
    { "own part", [](const ChangingProp& prop) { return prop.changePart != nullptr; },
      [](const ChangingProp& prop) { prop.changePart(); } },
    { "invisible", any, [](const ChangingProp& prop) { prop.prop->VisibilityOff(); } },
  };
  return changes;
}

} // namespace gnomon::test
