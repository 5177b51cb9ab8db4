#include "SceneParts.h"
#include "Vec3.h"

#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkActor.h>
#include <vtkAnnotatedCubeActor.h>
#include <vtkAssembly.h>
#include <vtkAxesActor.h>
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
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
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

namespace gnomon::tool
{

namespace
{

template <typename T>
using Pointer = vtkSmartPointer<T>;
using Prop = Pointer<vtkProp3D>;

constexpr double ballRadius = 0.6;
constexpr double heightOfProps = 1.0;

Pointer<vtkPolyData> ball(double x = 0.0, double size = ballRadius)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, 0.0, 0.0);
  source->SetRadius(size);
  source->SetThetaResolution(32);
  source->SetPhiResolution(24);
  source->Update();
  return source->GetOutput();
}

/// Return points with vertices, and with radii for impostors.
Pointer<vtkPolyData> pointsWithRadii(const std::vector<std::pair<Vec3, float>>& balls)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  for (const auto& [place, radius] : balls)
  {
    const vtkIdType point = points->InsertNextPoint(place.data());
    vertices->InsertNextCell(1, &point);
    radii->InsertNextValue(radius);
  }
  auto data = Pointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->AddArray(radii);
  return data;
}

/// Return points around the middle.
Pointer<vtkPolyData> places()
{
  return pointsWithRadii({ { { -0.4, 1.5 * 0.4 - 0.3, 0.0 }, 0.25f }, { { 0.0, -0.3, 0.0 }, 0.25f },
    { { 0.4, 1.5 * 0.4 - 0.3, 0.0 }, 0.25f } });
}

Pointer<vtkPolyData> line()
{
  vtkNew<vtkLineSource> source;
  source->SetPoint1(-ballRadius, -0.3, 0.0);
  source->SetPoint2(ballRadius, 0.4, 0.0);
  source->Update();
  return source->GetOutput();
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

/// Return an actor that draws the data, by a mapper or an actor of another class.
template <typename Actor>
Pointer<Actor> plainActor()
{
  auto actor = Pointer<Actor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball());
  actor->SetMapper(mapper);
  return actor;
}

/// Return a kind of prop: an actor of this data that was changed.
std::function<Prop()> changed(Pointer<vtkPolyData> (*data)(), void (*change)(vtkActor* actor))
{
  return [=]
  {
    const Pointer<vtkActor> actor = actorOf(data());
    change(actor);
    return actor;
  };
}
std::function<Prop()> ballWith(void (*change)(vtkActor* actor))
{
  return changed([] { return ball(); }, change);
}

Pointer<vtkActor> sphereActor(vtkPolyData* points)
{
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetScaleArray("radius");
  return actorOf(mapper);
}

Prop moleculeProp()
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

Prop gaussianProp()
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

Prop elevationProp()
{
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputData(ball());
  elevation->SetLowPoint(0.0, -ballRadius, 0.0);
  elevation->SetHighPoint(0.0, ballRadius, 0.0);
  elevation->Update();
  Pointer<vtkActor> actor = actorOf(elevation->GetPolyDataOutput());
  actor->GetMapper()->ScalarVisibilityOn();
  return actor;
}

void displace(vtkActor* actor)
{
  actor->GetShaderProperty()->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
    "vec4 displaced = vertexMC * vec4(vec3(1.0 + 0.2 * sin(9.0 * vertexMC.y)), 1.0);\n"
    "#define vertexMC displaced\n"
    "//VTK::PositionVC::Impl\n"
    "#undef vertexMC\n",
    false);
}

void clip(vtkActor* actor)
{
  vtkNew<vtkPlane> plane; // in world coordinates, through the middle
  plane->SetNormal(0.0, -1.0, 0.0);
  plane->SetOrigin(0.0, heightOfProps, 0.0);
  actor->GetMapper()->AddClippingPlane(plane);
}

Prop imageProp()
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

/// Return a pane that colours the light it lets through, once translucent props are to cast.
Prop stainedPane()
{
  vtkNew<vtkPlaneSource> pane;
  pane->SetOrigin(-0.7, -0.6, 0.0);
  pane->SetPoint1(0.7, -0.6, 0.0);
  pane->SetPoint2(-0.7, 0.6, 0.0);
  pane->Update();
  const Pointer<vtkActor> actor = actorOf(pane->GetOutput());
  actor->GetProperty()->SetColor(0.9, 0.25, 0.1);
  actor->GetProperty()->SetOpacity(0.6);
  vtkGnomonPropKeys::SetTransmits(actor, vtkGnomonPropKeys::TRANSMITS_COLORED);
  return actor;
}

Prop volumeProp()
{
  constexpr int side = 16;
  constexpr double spacing = 2.0 * ballRadius / side;
  vtkNew<vtkImageData> voxels;
  voxels->SetDimensions(side, side, side);
  voxels->SetSpacing(spacing, spacing, spacing);
  voxels->SetOrigin(-ballRadius, -ballRadius, -ballRadius);
  voxels->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int i = 0; i < side * side * side; ++i)
  {
    const Vec3 across{ i % side - 7.5, i / side % side - 7.5, i / (side * side) - 7.5 };
    static_cast<unsigned char*>(voxels->GetScalarPointer())[i] = length(across) < 7.0 ? 255 : 0;
  }
  vtkNew<vtkSmartVolumeMapper> mapper;
  mapper->SetInputData(voxels);
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

Prop textProp()
{
  auto text = Pointer<vtkTextActor3D>::New();
  text->SetInput("text");
  text->GetTextProperty()->SetFontSize(40);
  text->GetTextProperty()->SetJustificationToCentered();
  text->SetScale(0.015);
  return text;
}

/// All kinds of props, around the origin: by mapper, by look, by prop.
const std::vector<SceneProp>& kindsOfProps()
{
  using Actor = vtkActor;
  static const std::vector<SceneProp> kinds = {
    { "polydata mapper", [] { return actorOf(ball()); } },
    { "data set mapper", [] { return actorOf<vtkDataSetMapper>(ball()); } },
    { "composite mapper",
      []
      {
        vtkNew<vtkMultiBlockDataSet> blocks;
        blocks->SetBlock(0, ball(-0.3, 0.3));
        blocks->SetBlock(1, ball(0.3, 0.3));
        vtkNew<SharedBlocksMapper> mapper;
        mapper->SetInputDataObject(blocks);
        return actorOf(mapper);
      } },
    { "molecule mapper", moleculeProp },
    { "Gaussian points", gaussianProp },
    { "sphere mapper", [] { return sphereActor(places()); } },
    { "glyph mapper",
      []
      {
        vtkNew<vtkGlyph3DMapper> mapper;
        mapper->SetInputData(places());
        mapper->SetSourceData(ball(0.0, 0.25));
        mapper->ScalingOff();
        return actorOf(mapper);
      } },
    { "points as spheres",
      changed(places,
        [](Actor* actor)
        {
          actor->GetProperty()->SetPointSize(12.0f);
          actor->GetProperty()->RenderPointsAsSpheresOn();
        }) },
    { "lines as tubes",
      changed(line,
        [](Actor* actor)
        {
          actor->GetProperty()->SetLineWidth(8.0f);
          actor->GetProperty()->RenderLinesAsTubesOn();
        }) },
    { "tube filter",
      []
      {
        vtkNew<vtkTubeFilter> tube;
        tube->SetInputData(line());
        tube->SetRadius(0.15);
        tube->SetNumberOfSides(16);
        tube->CappingOn();
        tube->Update();
        return actorOf(tube->GetOutput());
      } },
    { "wireframe",
      ballWith([](Actor* actor) { actor->GetProperty()->SetRepresentationToWireframe(); }) },
    { "points", ballWith([](Actor* actor) { actor->GetProperty()->SetRepresentationToPoints(); }) },
    { "edges", ballWith([](Actor* actor) { actor->GetProperty()->EdgeVisibilityOn(); }) },
    { "half opaque",
      ballWith(
        [](Actor* actor)
        {
          actor->GetProperty()->SetOpacity(0.5);
          vtkGnomonPropKeys::SetCasts(actor, true);
          vtkGnomonPropKeys::SetTransmits(actor, vtkGnomonPropKeys::TRANSMITS_NOTHING);
        }) },
    { "glass ball", ballWith([](Actor* actor) { actor->GetProperty()->SetOpacity(0.3); }) },
    { "stained pane", stainedPane },
    { "clipped", ballWith(clip) },
    { "elevation colours", elevationProp },
    { "unlit", ballWith([](Actor* actor) { actor->GetProperty()->LightingOff(); }) },
    { "user transform",
      ballWith(
        [](Actor* actor)
        {
          vtkNew<vtkTransform> flat;
          flat->Scale(1.0, 0.5, 1.0);
          actor->SetUserTransform(flat);
        }) },
    { "displaced vertices", ballWith(displace) },
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
    { "LOD actor", [] { return plainActor<vtkLODActor>(); } },
    { "LOD prop",
      []
      {
        auto levels = Pointer<vtkLODProp3D>::New();
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(ball());
        levels->AddLOD(mapper, 0.0);
        return levels;
      } },
    { "assembly",
      []
      {
        auto assembly = Pointer<vtkAssembly>::New();
        assembly->AddPart(actorOf(ball(-0.3, 0.3)));
        assembly->AddPart(actorOf(ball(0.3, 0.3)));
        return assembly;
      } },
    { "follower",
      []
      {
        auto follower = plainActor<vtkFollower>();
        follower->SetScale(1.0, 0.6, 1.0);
        return follower;
      } },
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

// A double helix wound around a ring, as balls and sticks.

constexpr double windingRadius = 50.0;

Prop helixProp()
{
  constexpr int pairs = 25000; // of four atoms each
  constexpr double pairsPerTurn = 10.5;
  constexpr std::array<unsigned short, 4> elements = { 15, 7, 6, 15 }; // along a pair
  constexpr std::array<double, 4> places = { -1.0, -0.33, 0.33, 1.0 };
  vtkNew<vtkMolecule> molecule;
  std::array<vtkIdType, 4> before{};
  for (int pair = 0; pair < pairs; ++pair)
  {
    const double turn = 2.0 * vtkMath::Pi() * (static_cast<double>(pair) / pairs);
    const double winding = 80.0 * turn; // windings
    const Vec3 ring{ std::cos(turn), 0.0, std::sin(turn) };
    const double distance = 120.0 + windingRadius * std::cos(winding);
    const Vec3 axis = distance * ring + (windingRadius * std::sin(winding)) * up;
    const Vec3 outwards = std::cos(winding) * ring + std::sin(winding) * up;
    // The axis makes 80 turns on its way around the ring, so this lies across it within a degree.
    const Vec3 along{ -ring[2], 0.0, ring[0] };
    const double angle = 2.0 * vtkMath::Pi() * pair / pairsPerTurn;
    const Vec3 across = std::cos(angle) * outwards + std::sin(angle) * along;
    std::array<vtkIdType, 4> atoms{};
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Vec3 at = axis + (places[i] * 1.6) * across;
      atoms[i] = molecule->AppendAtom(elements[i], at[0], at[1], at[2]).GetId();
    }
    for (std::size_t i = 0; i + 1 < 4; ++i)
    {
      molecule->AppendBond(atoms[i], atoms[i + 1], 1);
    }
    for (const std::size_t strand : { 0u, 3u })
    {
      if (pair > 0)
      {
        molecule->AppendBond(before[strand], atoms[strand], 1);
      }
    }
    before = atoms;
  }
  vtkNew<vtkMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->UseBallAndStickSettings();
  mapper->SetBondRadius(0.12f);
  auto actor = Pointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetPosition(0.0, windingRadius + 4.0, 0.0);
  return actor;
}

} // namespace

void addProps(Scene& scene)
{
  constexpr std::size_t columns = 6;
  for (std::size_t i = 0; i < kindsOfProps().size(); ++i)
  {
    const SceneProp& kind = kindsOfProps()[i];
    const Vec3 at{ 2.0 * (static_cast<double>(i % columns) - 2.5), heightOfProps,
      2.0 * (static_cast<double>(i / columns) - 2.0) };
    scene.props.push_back({ kind.name,
      [&kind, at]
      {
        Prop prop = kind.make();
        place(prop, at);
        return prop;
      } });
  }
}

void addMolecule(Scene& scene)
{
  scene.props.push_back({ "molecule", helixProp });
}

void addImpostors(Scene& scene)
{
  scene.props.push_back({ "balls",
    []() -> Prop
    {
      std::vector<std::pair<Vec3, float>> balls;
      for (int i = 0; i < 6; ++i)
      {
        const float radius = 0.3f + 0.1f * static_cast<float>(i);
        balls.push_back({ { -2.5 + 0.9 * i, i % 2 == 0 ? radius : 1.6, 0.3 * (i % 3) }, radius });
      }
      const Pointer<vtkActor> actor = sphereActor(pointsWithRadii(balls));
      actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
      return actor;
    } });
}

} // namespace gnomon::tool
