#include "BuiltinParts.h"
#include "BuiltinScenes.h"

#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkActor.h>
#include <vtkAnnotatedCubeActor.h>
#include <vtkAssembly.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSetMapper.h>
#include <vtkElevationFilter.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProperty.h>
#include <vtkLODActor.h>
#include <vtkLODProp3D.h>
#include <vtkLineSource.h>
#include <vtkMath.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkShaderProperty.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkSphereSource.h>
#include <vtkTextActor3D.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkTubeFilter.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>

// One prop of each kind that VTK draws in three dimensions, next to each other on a ground.

namespace gnomon::tool
{

namespace
{

template <typename T>
using Pointer = vtkSmartPointer<T>;

constexpr double radius = 0.6;
constexpr double heightOfProps = 1.0;

Pointer<vtkPolyData> ball(double x = 0.0, double size = radius)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, 0.0, 0.0);
  source->SetRadius(size);
  source->SetThetaResolution(32);
  source->SetPhiResolution(24);
  source->Update();
  return source->GetOutput();
}

/// Return points around the middle, with vertices, and with radii for impostors.
Pointer<vtkPolyData> places()
{
  auto data = Pointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  for (const double x : { -0.4, 0.0, 0.4 })
  {
    const vtkIdType point = points->InsertNextPoint(x, 1.5 * std::abs(x) - 0.3, 0.0);
    vertices->InsertNextCell(1, &point);
    radii->InsertNextValue(0.25f);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->AddArray(radii);
  return data;
}

Pointer<vtkPolyData> line()
{
  vtkNew<vtkLineSource> source;
  source->SetPoint1(-radius, -0.3, 0.0);
  source->SetPoint2(radius, 0.4, 0.0);
  source->Update();
  return source->GetOutput();
}

/// Return a cube of voxels, dense in the middle.
Pointer<vtkImageData> voxels()
{
  auto image = Pointer<vtkImageData>::New();
  constexpr int side = 16;
  image->SetDimensions(side, side, side);
  image->SetSpacing(2.0 * radius / side, 2.0 * radius / side, 2.0 * radius / side);
  image->SetOrigin(-radius, -radius, -radius);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int z = 0; z < side; ++z)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        const double across[3] = { x - 7.5, y - 7.5, z - 7.5 };
        const bool inside = vtkMath::Norm(across) < 7.0;
        *static_cast<unsigned char*>(image->GetScalarPointer(x, y, z)) = inside ? 255 : 0;
      }
    }
  }
  return image;
}

Pointer<vtkActor> actorOf(vtkMapper* mapper)
{
  auto actor = Pointer<vtkActor>::New();
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.8, 0.7, 0.55);
  return actor;
}

template <typename Mapper = vtkPolyDataMapper>
Pointer<vtkActor> actorOf(vtkPolyData* data)
{
  vtkNew<Mapper> mapper;
  mapper->SetInputData(data);
  return actorOf(mapper);
}

/// Return a ball whose actor was changed.
template <typename Change>
Pointer<vtkActor> ballWith(const Change& change)
{
  Pointer<vtkActor> actor = actorOf(ball());
  change(actor.Get());
  return actor;
}

//------------------------------------------------------------------------------
// By mapper

Pointer<vtkProp3D> compositeProp()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, ball(-0.3, 0.3));
  blocks->SetBlock(1, ball(0.3, 0.3));
  vtkNew<SharedBlocksMapper> mapper;
  mapper->SetInputDataObject(blocks);
  return actorOf(mapper);
}

Pointer<vtkProp3D> moleculeProp()
{
  vtkNew<vtkMolecule> water;
  const vtkAtom oxygen = water->AppendAtom(8, 0.0, 0.0, 0.0);
  for (const double x : { -0.6, 0.6 })
  {
    water->AppendBond(oxygen, water->AppendAtom(1, x, 0.5, 0.0), 1);
  }
  vtkNew<vtkMoleculeMapper> mapper;
  mapper->SetInputData(water);
  mapper->UseBallAndStickSettings();
  return actorOf(mapper);
}

Pointer<vtkProp3D> gaussianProp()
{
  vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputData(places());
  mapper->SetScaleFactor(0.25);
  mapper->EmissiveOff();
  mapper->SetSplatShaderCode("//VTK::Color::Impl\n"
                             "float square = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                             "if (square > 1.0) { discard; }\n");
  return actorOf(mapper);
}

Pointer<vtkProp3D> sphereProp()
{
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(places());
  mapper->SetScaleArray("radius");
  return actorOf(mapper);
}

Pointer<vtkProp3D> glyphProp()
{
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(places());
  mapper->SetSourceData(ball(0.0, 0.25));
  mapper->ScalingOff();
  return actorOf(mapper);
}

Pointer<vtkProp3D> tubeProp()
{
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(line());
  tube->SetRadius(0.15);
  tube->SetNumberOfSides(16);
  tube->CappingOn();
  tube->Update();
  return actorOf(tube->GetOutput());
}

//------------------------------------------------------------------------------
// By look

Pointer<vtkProp3D> clippedProp()
{
  return ballWith(
    [](vtkActor* actor)
    {
      vtkNew<vtkPlane> plane; // in world coordinates, through the middle
      plane->SetNormal(0.0, -1.0, 0.0);
      plane->SetOrigin(0.0, heightOfProps, 0.0);
      actor->GetMapper()->AddClippingPlane(plane);
    });
}

Pointer<vtkProp3D> elevationProp()
{
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputData(ball());
  elevation->SetLowPoint(0.0, -radius, 0.0);
  elevation->SetHighPoint(0.0, radius, 0.0);
  elevation->Update();
  Pointer<vtkActor> actor = actorOf(elevation->GetPolyDataOutput());
  actor->GetMapper()->ScalarVisibilityOn();
  return actor;
}

Pointer<vtkProp3D> displacedProp()
{
  return ballWith(
    [](vtkActor* actor)
    {
      actor->GetShaderProperty()->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
        "vec4 displaced = vertexMC * vec4(vec3(1.0 + 0.2 * sin(9.0 * vertexMC.y)), 1.0);\n"
        "#define vertexMC displaced\n"
        "//VTK::PositionVC::Impl\n"
        "#undef vertexMC\n",
        false);
    });
}

//------------------------------------------------------------------------------
// By prop

Pointer<vtkProp3D> imageProp()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 8, 1);
  image->SetSpacing(0.15, 0.15, 1.0);
  image->SetOrigin(-0.525, -0.525, 0.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int i = 0; i < 64; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] = (i + i / 8) % 2 ? 220 : 120;
  }
  auto actor = Pointer<vtkImageActor>::New();
  actor->SetInputData(image);
  actor->GetProperty()->SetAmbient(0.0); // images are unlit by default
  actor->GetProperty()->SetDiffuse(1.0);
  vtkGnomonPropKeys::SetCasts(actor, true);
  return actor;
}

Pointer<vtkProp3D> volumeProp()
{
  vtkNew<vtkSmartVolumeMapper> mapper;
  mapper->SetInputData(voxels());
  mapper->SetRequestedRenderModeToGPU();
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, 0.0);
  opacity->AddPoint(255.0, 1.0);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  auto volume = Pointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->GetProperty()->SetScalarOpacity(opacity);
  volume->GetProperty()->SetColor(color);
  volume->GetProperty()->ShadeOn();
  return volume;
}

Pointer<vtkProp3D> levelsProp()
{
  auto levels = Pointer<vtkLODProp3D>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball());
  levels->AddLOD(mapper, 0.0);
  return levels;
}

Pointer<vtkProp3D> assemblyProp()
{
  auto assembly = Pointer<vtkAssembly>::New();
  assembly->AddPart(actorOf(ball(-0.3, 0.3)));
  assembly->AddPart(actorOf(ball(0.3, 0.3)));
  return assembly;
}

Pointer<vtkProp3D> followerProp()
{
  auto follower = Pointer<vtkFollower>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball());
  follower->SetMapper(mapper);
  follower->SetScale(1.0, 0.6, 1.0);
  return follower;
}

Pointer<vtkProp3D> textProp()
{
  auto text = Pointer<vtkTextActor3D>::New();
  text->SetInput("text");
  text->GetTextProperty()->SetFontSize(40);
  text->GetTextProperty()->SetJustificationToCentered();
  text->SetScale(0.015);
  return text;
}

/// Return all kinds of props, around the origin, with their names.
const std::vector<SceneProp>& kindsOfProps()
{
  using Actor = vtkActor;
  static const std::vector<SceneProp> kinds = {
    { "polydata mapper", [] { return actorOf(ball()); } },
    { "data set mapper", [] { return actorOf<vtkDataSetMapper>(ball()); } },
    { "composite mapper", compositeProp },
    { "molecule mapper", moleculeProp },
    { "Gaussian points", gaussianProp },
    { "sphere mapper", sphereProp },
    { "glyph mapper", glyphProp },
    { "points as spheres",
      []
      {
        Pointer<Actor> actor = actorOf(places());
        actor->GetProperty()->SetPointSize(12.0f);
        actor->GetProperty()->RenderPointsAsSpheresOn();
        return actor;
      } },
    { "lines as tubes",
      []
      {
        Pointer<Actor> actor = actorOf(line());
        actor->GetProperty()->SetLineWidth(8.0f);
        actor->GetProperty()->RenderLinesAsTubesOn();
        return actor;
      } },
    { "tube filter", tubeProp },
    { "wireframe",
      [] {
        return ballWith([](Actor* actor) { actor->GetProperty()->SetRepresentationToWireframe(); });
      } },
    { "points",
      [] {
        return ballWith([](Actor* actor) { actor->GetProperty()->SetRepresentationToPoints(); });
      } },
    { "edges",
      [] { return ballWith([](Actor* actor) { actor->GetProperty()->EdgeVisibilityOn(); }); } },
    { "half opaque",
      []
      {
        return ballWith(
          [](Actor* actor)
          {
            actor->GetProperty()->SetOpacity(0.5);
            vtkGnomonPropKeys::SetCasts(actor, true);
          });
      } },
    { "clipped", clippedProp },
    { "elevation colours", elevationProp },
    { "unlit", [] { return ballWith([](Actor* actor) { actor->GetProperty()->LightingOff(); }); } },
    { "user transform",
      []
      {
        return ballWith(
          [](Actor* actor)
          {
            vtkNew<vtkTransform> flat;
            flat->Scale(1.0, 0.5, 1.0);
            actor->SetUserTransform(flat);
          });
      } },
    { "displaced vertices", displacedProp },
    { "image actor", imageProp },
    { "volume", volumeProp },
    { "axes",
      []
      {
        auto axes = Pointer<vtkAxesActor>::New();
        axes->AxisLabelsOff();
        return axes;
      } },
    { "annotated cube", [] { return Pointer<vtkAnnotatedCubeActor>::New(); } },
    { "LOD actor",
      []
      {
        auto actor = Pointer<vtkLODActor>::New();
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(ball());
        actor->SetMapper(mapper);
        return actor;
      } },
    { "LOD prop", levelsProp },
    { "assembly", assemblyProp },
    { "follower", followerProp },
    { "text", textProp },
  };
  return kinds;
}

/// Place a prop. Axes and annotated cubes ignore their position, as they draw through props of
/// their own.
void place(vtkProp3D* prop, const Vec3& at)
{
  if (auto* axes = vtkAxesActor::SafeDownCast(prop))
  {
    vtkNew<vtkTransform> translation;
    translation->Translate(at.data());
    axes->SetUserTransform(translation);
  }
  else if (auto* cube = vtkAnnotatedCubeActor::SafeDownCast(prop))
  {
    cube->GetAssembly()->SetPosition(at[0], at[1], at[2]);
  }
  else
  {
    prop->SetPosition(at[0], at[1], at[2]);
  }
}

} // namespace

//------------------------------------------------------------------------------
Scene makePropsScene()
{
  constexpr std::size_t columns = 7;
  constexpr double step = 2.0;
  Scene scene;
  scene.models = { makePlane(origin, 20.0) };
  for (std::size_t i = 0; i < kindsOfProps().size(); ++i)
  {
    const double column = static_cast<double>(i % columns) - 3.0;
    const double row = static_cast<double>(i / columns) - 1.5;
    const Vec3 at{ { step * column, heightOfProps, step * row } };
    const SceneProp& kind = kindsOfProps()[i];
    scene.props.push_back({ kind.name,
      [&kind, at]
      {
        vtkSmartPointer<vtkProp3D> prop = kind.make();
        place(prop, at);
        return prop;
      } });
  }
  scene.lights = { makeSun({ { 0.3, -1.0, -0.2 } }) };
  scene.camera = makeCamera({ { 0.0, 15.0, 12.0 } }, { { 0.0, 0.5, 0.3 } }, 40.0);
  return scene;
}

} // namespace gnomon::tool
