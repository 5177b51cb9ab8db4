#include "plugin/scene/OccluderCollector.h"

#include "plugin/scene/KeptInstances.h"

#include "TestData.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageSlice.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShaderProperty.h"
#include "vtkSphereSource.h"
#include "vtkTextActor3D.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// A renderer and its collector.
struct Scene
{
  vtkNew<vtkRenderer> renderer;
  OccluderCollector collector;

  vtkActor* add(vtkPolyData* data)
  {
    const auto actor = makeActor(data);
    this->renderer->AddActor(actor);
    return actor;
  }
  SnapshotChange collect() { return this->collector.collect(this->renderer); }
  std::size_t collectSurfaces()
  {
    this->collect();
    return this->surfaceCount();
  }
  const Occluders& occluders() const { return this->collector.occluders(); }
  const Surface& surface(std::size_t i) const { return this->occluders().surfaces.at(i); }
  std::size_t surfaceCount() const { return this->occluders().surfaces.size(); }

  /// Return a triangle of a surface, with vertices counted from the surface's first.
  glm::uvec3 triangle(std::size_t surface, std::uint32_t number) const
  {
    const Surface& s = this->surface(surface);
    return this->occluders().triangles.at(s.firstTriangle + number) - s.firstVertex;
  }
  glm::dvec3 positionWorld(std::size_t surface, std::uint32_t vertex) const
  {
    const Surface& s = this->surface(surface);
    return glm::dvec3(this->occluders().positionsCentred.at(s.firstVertex + vertex)) +
      this->occluders().frame.centre;
  }
};

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6)
{
  EXPECT_LE(glm::distance(a, b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") and ("
                                            << b.x << ", " << b.y << ", " << b.z << ")";
}

void expectNothingDone(Scene& scene)
{
  const std::uint64_t topology = scene.occluders().topologyVersion;
  const std::uint64_t positions = scene.occluders().positionsVersion;
  const SnapshotChange change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 0);
  EXPECT_EQ(scene.occluders().topologyVersion, topology);
  EXPECT_EQ(scene.occluders().positionsVersion, positions);
}

vtkSmartPointer<vtkActor> makeCompositeActor(vtkDataObject* tree)
{
  vtkNew<SharedBlocksMapper> mapper;
  mapper->SetInputDataObject(tree);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  return actorOf(mapper);
}

/// One source at every point of a polydata.
struct PlacedGlyphs
{
  PlacedGlyphs(vtkPolyData* points, vtkPolyData* source)
  {
    this->mapper->SetInputData(points);
    this->mapper->SetSourceData(source);
    this->actor->SetMapper(this->mapper);
  }

  vtkNew<vtkGlyph3DMapper> mapper;
  vtkNew<vtkActor> actor;
};

} // namespace

TEST(OccluderTriangles, EqualVerticesAreNeverDrawnAndTakeNoNumber)
{
  // The second point equals the third. VTK draws one triangle of the quad; the other does not count
  // as dropped.
  Scene scene;
  scene.add(meshOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }));
  scene.collect();
  ASSERT_EQ(scene.surface(0).triangleCount, 1u);
  EXPECT_TRUE(scene.surface(0).triangleOfDrawn.empty());
  EXPECT_EQ(scene.occluders().droppedZeroArea, 0u);
  EXPECT_EQ(scene.occluders().droppedNonFinite, 0u);
}

/// A triangle with a missing point is dropped, too.
TEST(OccluderTriangles, DropsWhatHasNoAreaOrIsNotFinite)
{
  Scene scene;
  scene.add(meshOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 }, { notANumber, 0, 0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 }, { 0, 1, 7 }, { 1, 3, 2 } }));
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedZeroArea, 1u);
  EXPECT_EQ(scene.occluders().droppedNonFinite, 2u);
  constexpr std::uint32_t none = Surface::noTriangle;
  EXPECT_EQ(
    scene.surface(0).triangleOfDrawn, (std::vector<std::uint32_t>{ 0, none, none, none, 1 }));
  ASSERT_EQ(scene.surface(0).triangleCount, 2u);
  expectNear(scene.positionWorld(0, scene.triangle(0, 1).y), { 2, 0, 0 });
  for (const glm::vec3& position : scene.occluders().positionsCentred)
  {
    EXPECT_TRUE(std::isfinite(glm::dot(position, position)));
  }
}

/// Another matrix brings the dropped triangles back.
TEST(OccluderTriangles, DropsWhatAMatrixFlattensOrBlowsUp)
{
  Scene scene;
  vtkActor* const actor = scene.add(makeSquare());
  struct Case
  {
    glm::dvec3 scale;
    std::size_t zeroArea;
    std::size_t nonFinite;
  };
  for (const auto& [scale, zeroArea, nonFinite] :
    { Case{ { 1.0, 1e-80, 1.0 }, 2, 0 }, { { 1.0, 1e80, 1.0 }, 0, 2 }, // too large for float
      { { 1.0, 1.0, 1.0 }, 0, 0 }, { { 1e-80, 1.0, 1.0 }, 2, 0 } })
  {
    actor->SetScale(scale.x, scale.y, scale.z);
    scene.collect();
    EXPECT_EQ(scene.occluders().droppedZeroArea, zeroArea);
    EXPECT_EQ(scene.occluders().droppedNonFinite, nonFinite);
    EXPECT_EQ(scene.surface(0).triangleCount, 2 - zeroArea - nonFinite);
    EXPECT_EQ(scene.surface(0).triangleOfDrawn.empty(), zeroArea + nonFinite == 0);
    expectNothingDone(scene);
  }
}

/// Kinds of props with good points around the unit square and a last point of any value.
using MakeProp = std::function<vtkSmartPointer<vtkActor>(const glm::dvec3& last)>;
const std::vector<std::pair<std::string, MakeProp>>& propsWithLastPoint()
{
  const auto points = [](const glm::dvec3& last) {
    return std::vector<glm::dvec3>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, last };
  };
  const auto glyphs = [=](const glm::dvec3& last, int resolution, vtkIdType count)
  {
    const auto places = meshOf(points(last), {}, VTK_DOUBLE);
    while (places->GetNumberOfPoints() < count)
    {
      places->GetPoints()->InsertNextPoint(0.5, 0.5, 0.0);
    }
    vtkNew<vtkPlaneSource> source;
    source->SetResolution(resolution, resolution);
    source->Update();
    return vtkSmartPointer<vtkActor>(PlacedGlyphs(places, source->GetOutput()).actor.Get());
  };
  static const std::vector<std::pair<std::string, MakeProp>> props{
    { "polygons",
      [=](const glm::dvec3& last) {
        return makeActor(meshOf(points(last), { { 0, 1, 3, 2 }, { 0, 1, 4 } }, VTK_DOUBLE));
      } },
    { "strips",
      [=](const glm::dvec3& last)
      {
        const auto data = meshOf(points(last), {}, VTK_DOUBLE);
        data->SetStrips(makeCells({ { 0, 1, 2, 3, 4 } }));
        return makeActor(data);
      } },
    { "expanded glyphs", [=](const glm::dvec3& last) { return glyphs(last, 1, 5); } },
    { "kept glyphs", [=](const glm::dvec3& last) { return glyphs(last, 8, 2048); } },
    { "balls",
      [=](const glm::dvec3& last)
      {
        vtkNew<vtkOpenGLSphereMapper> mapper;
        const auto data = meshOf(points(last), {}, VTK_DOUBLE);
        data->SetVerts(makeCells({ { 0 }, { 1 }, { 2 }, { 3 }, { 4 } }));
        mapper->SetInputData(data);
        mapper->SetRadius(0.5);
        const auto actor = vtkSmartPointer<vtkActor>::New();
        actor->SetMapper(mapper);
        return actor;
      } },
  };
  return props;
}

/// The box is that of the other points, and a matrix makes data missing and brings it back. Nothing
/// depends on the places before.
TEST(MissingData, IsLeftOutBeforeTheBoxIsMade)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double largestFloat = std::numeric_limits<float>::max();
  struct Case
  {
    double value;
    double scale;
    bool isMissing;
  };
  const auto boxOf = [](const Scene& scene)
  {
    const Bounds& box = scene.occluders().allCentred;
    return Bounds{ box.lower + scene.occluders().frame.centre,
      box.upper + scene.occluders().frame.centre };
  };
  for (const auto& [kind, make] : propsWithLastPoint())
  {
    for (const Case& given : { Case{ notANumber, 1.0, true }, { inf, 1.0, true },
           { -largestFloat, 1.0, true }, { 1.3e30, 1.0, true }, { 1e300, 1.0, true },
           { 1e20, 1e11, true }, { 1.2e30, 1.0, false }, { 1e35, 1e-35, false } })
    {
      SCOPED_TRACE(kind + ", " + std::to_string(given.value) + ", " + std::to_string(given.scale));
      Scene scene;
      const auto actor = make({ given.value, 0.5, 0.0 });
      actor->SetScale(given.scale);
      scene.renderer->AddActor(actor);
      scene.collect();
      EXPECT_EQ(scene.occluders().droppedNonFinite > 0, given.isMissing);
      if (given.isMissing)
      {
        EXPECT_LE(largestCoordinate(boxOf(scene)), 1.6 * given.scale);
        EXPECT_EQ(scene.occluders().frame.centre, glm::dvec3(0.0));
      }
      EXPECT_EQ(scene.collector.notes().empty(), !given.isMissing);

      for (const double scale : { 1e-10, 1e11, 1.0, given.scale })
      {
        actor->SetScale(scale);
        scene.collect();
        Scene fresh;
        const auto other = make({ given.value, 0.5, 0.0 });
        other->SetScale(scale);
        fresh.renderer->AddActor(other);
        fresh.collect();
        EXPECT_EQ(scene.occluders().frame.centre, fresh.occluders().frame.centre) << scale;
        EXPECT_EQ(scene.occluders().droppedNonFinite, fresh.occluders().droppedNonFinite) << scale;
      }
    }
  }
}

TEST(MissingData, ABoxFarLargerThanTheMedianPropsIsNoted)
{
  Scene scene;
  for (int i = 0; i < 3; ++i)
  {
    scene.add(makeSquare());
  }
  vtkActor* const large = scene.add(makeSquare());
  for (const double scale : { 1e6, 1.1e6, 1e20, 1.0 })
  {
    large->SetScale(scale);
    scene.collect();
    EXPECT_EQ(scene.collector.notes().size(), scale > 0x1p20 ? 1u : 0u) << scale;
    scene.collect(); // at rest
    EXPECT_EQ(scene.collector.notes().size(), scale > 0x1p20 ? 1u : 0u) << scale;
  }
}

TEST(OccluderTriangles, PointsInAnyArrayAreRead)
{
  Scene scene;
  const auto square = makeSquare();
  vtkNew<vtkSOADataArrayTemplate<double>> columns;
  columns->SetNumberOfComponents(3);
  columns->SetNumberOfTuples(4);
  vtkNew<vtkIntArray> integers;
  integers->SetNumberOfComponents(3);
  integers->SetNumberOfTuples(4);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    columns->SetTuple(i, square->GetPoint(i));
    integers->SetTuple(i, square->GetPoint(i));
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ columns, integers })
  {
    const auto data = makeSquare();
    data->GetPoints()->SetData(array);
    scene.add(data);
  }
  scene.add(makeSquare(VTK_DOUBLE));
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    expectNear(scene.positionWorld(i, scene.triangle(i, 1).y), { 1, 1, 0 });
  }
}

TEST(OccluderTriangles, PolygonsAndStripsKeepTheirFronts)
{
  Scene scene;
  const auto data =
    meshOf({ { 0, 0, 0 }, { 1, 0, 0 }, { -0.1, 1, 0 }, { 1.1, 1, 0 }, { 0, 2, 0 }, { 1, 2, 0 } },
      { { 0, 1, 3, 5, 4, 2 } });
  data->SetStrips(makeCells({ { 0, 1, 2, 3, 4, 5 } }));
  scene.add(data);
  scene.collect();
  EXPECT_EQ(scene.occluders().triangles.size(), 8u);
  for (const glm::uvec3& corners : scene.occluders().triangles)
  {
    const std::vector<glm::vec3>& at = scene.occluders().positionsCentred;
    EXPECT_GT(glm::cross(at[corners.y] - at[corners.x], at[corners.z] - at[corners.x]).z, 0.0f);
  }
}

TEST(OccluderTriangles, OnlyUsedPointsBecomeVertices)
{
  Scene scene;
  scene.add(meshOf({ { 1e9, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { notANumber, 0, 0 } },
    { { 1, 2, 3 } }));
  scene.collect();
  EXPECT_EQ(scene.surface(0).vertexCount, 3u);
  EXPECT_NEAR(scene.occluders().allCentred.radius(), std::sqrt(0.5), 1e-6);
  EXPECT_GT(scene.occluders().positionsCentred.capacity(), 3u) << "the last is read as 16 bytes";
}

TEST(OccluderProps, OnlyOpaqueSurfacesAreCollected)
{
  const auto translucent = makeSquare();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  colours->SetNumberOfTuples(4);
  colours->Fill(128);
  translucent->GetPointData()->SetScalars(colours);
  const auto nothing = [](vtkActor*) {};
  const auto fade = [](vtkActor* actor) { actor->GetProperty()->SetOpacity(0.5); };
  struct Case
  {
    vtkSmartPointer<vtkPolyData> data;
    std::function<void(vtkActor*)> change;
    std::size_t surfaces;
  };
  const Case cases[] = { { makeSquare(), nothing, 1 }, { translucent, nothing, 0 },
    { makeSquare(), fade, 0 }, { vtkSmartPointer<vtkPolyData>::New(), nothing, 0 },
    { makeSquare(), [](vtkActor* actor) { actor->SetVisibility(false); }, 0 },
    { makeSquare(), [](vtkActor* actor) { actor->ForceTranslucentOn(); }, 0 },
    { makeSquare(),
      [&](vtkActor* actor)
      {
        fade(actor);
        actor->ForceOpaqueOn();
      },
      1 },
    { makeSquare(), [](vtkActor* actor) { actor->SetMapper(nullptr); }, 0 },
    { makeSquare(), [](vtkActor* actor) { actor->SetMapper(vtkNew<vtkPolyDataMapper>()); }, 0 } };
  int number = 0;
  for (const auto& [data, change, surfaces] : cases)
  {
    Scene scene;
    change(scene.add(data));
    EXPECT_EQ(scene.collectSurfaces(), surfaces) << "case " << number++;
    EXPECT_EQ(scene.occluders().allCentred.empty(), surfaces == 0);
    EXPECT_THAT(scene.collector.notes(), testing::Each(HasSubstr("prop is translucent")));
  }
}

/// Left-out props are named by class, if they are lit.
TEST(OccluderProps, LinesPointsAndVolumesAreListed)
{
  Scene scene;
  vtkProperty* const wires = scene.add(makeSquare())->GetProperty();
  vtkProperty* const points = scene.add(makeSquare())->GetProperty();
  const auto lines = makeSquare();
  lines->SetLines(lines->GetPolys());
  lines->SetPolys(nullptr);
  vtkProperty* const outline = scene.add(lines)->GetProperty();
  wires->SetRepresentationToWireframe();
  points->SetRepresentationToPoints();
  vtkNew<vtkVolume> volume;
  vtkNew<vtkImageSlice> image;
  scene.renderer->AddViewProp(volume);
  scene.renderer->AddViewProp(image);
  scene.renderer->AddViewProp(vtkNew<vtkTextActor3D>());
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_EQ(scene.collectSurfaces(), 0u);
    EXPECT_TRUE(scene.occluders().allCentred.empty());
    EXPECT_THAT(scene.collector.leftOut(),
      UnorderedElementsAre("vtkOpenGLActor (as a wireframe)", "vtkOpenGLActor (as points)",
        "vtkOpenGLPolyDataMapper (lines or points)", "vtkVolume (mapper not served)",
        "vtkVolume (casts nothing)"));
  }
  for (vtkProperty* property : { wires, points, outline })
  {
    property->LightingOff();
  }
  volume->VisibilityOff();
  scene.collect();
  EXPECT_THAT(scene.collector.leftOut(), testing::IsEmpty());
}

/// The snapshot holds only the triangles of glyphs, and the picture shows spheres.
TEST(OccluderProps, PointsAsSpheresOfGlyphsAreNoted)
{
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(makeSquare());
  glyphs->SetSourceData(makeSquare());
  Scene scene;
  vtkActor* const actor = scene.add(makeSquare());
  actor->SetMapper(glyphs);
  EXPECT_EQ(scene.collectSurfaces(), 1u);
  actor->GetProperty()->SetRepresentationToPoints();
  actor->GetProperty()->RenderPointsAsSpheresOn();
  EXPECT_EQ(scene.collectSurfaces(), 0u);
  EXPECT_THAT(scene.collector.leftOut(), testing::ElementsAre("vtkOpenGLActor (as points)"));
  actor->GetProperty()->LightingOff();
  EXPECT_EQ(scene.collectSurfaces(), 0u);
  EXPECT_THAT(scene.collector.leftOut(), testing::IsEmpty());
  actor->GetProperty()->LightingOn();
  actor->GetProperty()->SetDiffuse(0.0); // as the outlines of picked props are
  EXPECT_EQ(scene.collectSurfaces(), 0u);
  EXPECT_THAT(scene.collector.leftOut(), testing::IsEmpty());
}

TEST(OccluderProps, VerticesThatShaderCodeMayMoveAreNoted)
{
  Scene scene;
  vtkShaderProperty* const code = scene.add(makeSquare())->GetShaderProperty();
  const auto isNoted = [&]
  {
    scene.collect();
    return !scene.collector.notes().empty();
  };
  EXPECT_FALSE(isNoted());
  code->AddFragmentShaderReplacement("//VTK::Light::Impl", true, "// lit", false);
  EXPECT_FALSE(isNoted());
  code->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, "// moved", false);
  EXPECT_TRUE(isNoted());
  EXPECT_TRUE(isNoted());
  code->ClearAllShaderReplacements();
  EXPECT_FALSE(isNoted());
}

TEST(OccluderGlyphs, GlyphsThatVtkDoesNotDrawAreLeftOut)
{
  Scene scene;
  const PlacedGlyphs glyphs(makeSquare(), makeSquare());
  scene.renderer->AddActor(glyphs.actor);
  vtkNew<vtkFloatArray> pairs;
  pairs->SetName("pairs");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(4);
  pairs->Fill(1.0);
  vtkPolyData::SafeDownCast(glyphs.mapper->GetInput())->GetPointData()->AddArray(pairs);
  const auto triangles = [&scene]
  {
    scene.collect();
    return scene.occluders().triangles.size();
  };
  glyphs.mapper->SetOrientationArray("pairs"); // not of three components
  EXPECT_EQ(triangles(), 0u);
  glyphs.mapper->OrientOff();
  EXPECT_EQ(triangles(), 8u);
  glyphs.mapper->UseSourceTableTreeOn(); // without a tree
  EXPECT_EQ(triangles(), 0u);
  glyphs.mapper->UseSourceTableTreeOff();
  glyphs.mapper->RemoveAllInputConnections(1);
  EXPECT_EQ(triangles(), 0u);
}

TEST(OccluderGlyphs, MoreTrianglesThanTheBoundAreLeftOutAndNoted)
{
  Scene scene;
  const auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(vtkNew<vtkPoints>());
  const auto most = static_cast<vtkIdType>(mostGlyphTriangles / 512);
  points->GetPoints()->SetNumberOfPoints(most + 1);
  points->GetPoints()->GetData()->Fill(0.0);
  std::vector<glm::dvec3> corners;
  Cells triangles;
  for (vtkIdType i = 0; i < 512; ++i)
  {
    corners.insert(corners.end(), { { 0, 0, i }, { 1, 0, i }, { 0, 1, i } });
    triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  const PlacedGlyphs glyphs(points, meshOf(corners, triangles));
  scene.renderer->AddActor(glyphs.actor);
  scene.add(makeSquare());
  for (int frame = 0; frame < 2; ++frame)
  {
    scene.collect();
    EXPECT_EQ(scene.occluders().triangles.size(), 2u);
    EXPECT_THAT(scene.collector.notes(), testing::ElementsAre(HasSubstr("32769 glyphs")));
  }
}

TEST(OccluderGlyphs, AreKeptAsInstancesWhereThatIsCheaper)
{
  EXPECT_FALSE(areInstancesCheaper(63, 10000));
  EXPECT_TRUE(areInstancesCheaper(64, 4096));
  EXPECT_FALSE(areInstancesCheaper(64, 4095));
  EXPECT_FALSE(areInstancesCheaper(12, 1000000));
  EXPECT_FALSE(areInstancesCheaper(1000, 0));
  EXPECT_FALSE(areInstancesCheaper(0, 1000000));
}

TEST(OccluderProps, AMappersPieceIsAskedFor)
{
  Scene scene;
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->SetNumberOfPieces(2);
  mapper->SetPiece(1);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  scene.collect();
  const std::uint32_t half = scene.surface(0).triangleCount;
  EXPECT_GT(half, 0u);
  mapper->SetPiece(0);
  mapper->SetNumberOfPieces(1);
  scene.collect();
  EXPECT_EQ(scene.surface(0).triangleCount, 2 * half);
}

TEST(OccluderBlocks, AnEditedBlockIsReadAlone)
{
  Scene scene;
  vtkNew<vtkMultiBlockDataSet> root;
  const auto a = makeSquare();
  root->SetBlock(0, a);
  root->SetBlock(1, makeSquare());
  scene.renderer->AddActor(makeCompositeActor(root));
  EXPECT_EQ(scene.collect().extracted, 2);
  a->GetPoints()->SetPoint(2, 5, 5, 0);
  a->GetPoints()->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  root->SetBlock(2, makeSquare());
  EXPECT_EQ(scene.collect().extracted, 1);
  scene.renderer->AddActor(makeCompositeActor(makeSquare())); // without a tree
  EXPECT_EQ(scene.collectSurfaces(), 4u);
}

TEST(OccluderChanges, ModifiedDataOfTheSameShapeKeepsVersions)
{
  Scene scene;
  const auto square = makeSquare();
  scene.add(square);
  scene.collect();
  const std::uint64_t positions = scene.occluders().positionsVersion;
  square->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  EXPECT_EQ(scene.occluders().positionsVersion, positions);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfTuples(4);
  scalars->Fill(1.0);
  square->GetPointData()->SetScalars(scalars);
  expectNothingDone(scene);
}

TEST(OccluderCentre, LiesOnAGridAsCoarseAsTheScene)
{
  const auto around = [](const glm::dvec3& middle, double half) {
    return Bounds{ middle - half, middle + half };
  };
  const auto centreOf = [](const Bounds& box) { return sceneFrameOf(box).toWorld({}); };
  for (const double half : { 1e-9, 0.3, 1.0, 1.7, 4e5, 1e20 })
  {
    const glm::dvec3 touching(half, -half, 0.9 * half);
    EXPECT_EQ(centreOf(around(touching, half)), glm::dvec3(0.0)) << "holds the origin";
    for (const double away : { 3.0, 1e3, 1.234567e9 })
    {
      const Bounds box = around(away * touching, half);
      const glm::dvec3 centre = centreOf(box);
      for (const glm::dvec3& corner : box.corners())
      {
        const glm::dvec3 largest = glm::abs(corner - centre);
        EXPECT_LE(std::max({ largest.x, largest.y, largest.z }), 3.0 * box.radius());
      }
      // The bounds are another box around the centre.
      EXPECT_EQ(centreOf(around(centre + 0.5 * half, half)), centre);
    }
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(centreOf(Bounds()), glm::dvec3(0.0));
  EXPECT_EQ(centreOf(around(glm::dvec3(0.0), infinity)), glm::dvec3(0.0));
  EXPECT_EQ(centreOf(around(glm::dvec3(1.0), 1e200)), glm::dvec3(0.0));
  EXPECT_EQ(centreOf(around(glm::dvec3(notANumber), 1.0)), glm::dvec3(0.0));
  expectNear(centreOf(around(glm::dvec3(7.0), 0.0)), glm::dvec3(8.0)); // a point
}

TEST(SceneFrame, hasOneUnitForOrdinaryScenesAndAnotherForOthers)
{
  int before = -1000;
  for (int k = -500; k <= 500; ++k)
  {
    const double half = std::ldexp(0.7, k);
    const Bounds box{ glm::dvec3(-half), glm::dvec3(half) };
    const SceneFrame frame = sceneFrameOf(box);
    const double radius = box.radius() * frame.unitsPerWorld();
    EXPECT_GE(radius, std::ldexp(1.0, -10));
    EXPECT_LT(radius, std::ldexp(1.0, 20));
    EXPECT_EQ(frame.exponent % 30, 0);
    EXPECT_GE(frame.exponent, before);
    before = frame.exponent;
    if (k >= -9 && k <= 18)
    {
      EXPECT_EQ(frame.exponent, 0) << k;
    }
    const glm::dvec3 place = half * glm::dvec3(0.1, -0.7, 0.3);
    EXPECT_EQ(frame.toWorld(frame.fromWorld(place)), place);
  }
}

TEST(OccluderCentre, StaysWhileTheSceneChangesLittle)
{
  Scene scene;
  vtkActor* const actor = scene.add(makeSquare());
  actor->SetPosition(100, 0, 0);
  scene.collect();
  const glm::dvec3 centre = scene.occluders().frame.centre;
  actor->SetPosition(100.2, 0.1, 0);
  EXPECT_EQ(scene.collect().retransformed, 1);
  EXPECT_EQ(scene.occluders().frame.centre, centre);
  actor->SetPosition(112, 0, 0);
  scene.collect();
  EXPECT_NE(scene.occluders().frame.centre, centre);
  expectNear(scene.positionWorld(0, 2), { 113, 1, 0 });
}

TEST(OccluderCentre, DoesNotDependOnRemovedProps)
{
  Scene scene;
  scene.add(makeSquare())->SetPosition(40.1, 3.3, 7.7);
  vtkActor* const far = scene.add(makeSquare());
  far->SetPosition(-1e5, 3e4, 0);
  far->SetVisibility(false);
  scene.collect();
  const Occluders before = scene.occluders();
  far->SetVisibility(true);
  scene.collect();
  EXPECT_NE(scene.occluders().frame.centre, before.frame.centre);
  far->SetVisibility(false);
  scene.collect();
  EXPECT_EQ(scene.occluders().frame.centre, before.frame.centre);
  EXPECT_EQ(scene.occluders().positionsCentred, before.positionsCentred);
  EXPECT_EQ(scene.occluders().allCentred.lower, before.allCentred.lower);
  EXPECT_EQ(scene.occluders().allCentred.upper, before.allCentred.upper);
}

TEST(OccluderCutouts, CoordinatesThatAreNotFiniteOrNotThereAreZero)
{
  Scene scene;
  const auto square = makeSquare();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->InsertNextTuple2(notANumber, 0.5);
  coordinates->InsertNextTuple2(0.5, std::numeric_limits<double>::infinity());
  coordinates->InsertNextTuple2(0.25, 0.5);
  square->GetPointData()->SetTCoords(coordinates);
  vtkActor* const actor = scene.add(square);
  actor->SetTexture(textureOf(makeVeil(2, 1, [](int x, int) { return 255 * x; })));
  scene.collect();
  EXPECT_EQ(scene.surface(0).textureCoordinates,
    (std::vector<glm::vec2>{ { 0, 0 }, { 0, 0 }, { 0.25, 0.5 }, { 0, 0 } }));
}
