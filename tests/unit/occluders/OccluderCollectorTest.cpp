#include "plugin/scene/OccluderCollector.h"

#include "plugin/scene/KeptInstances.h"

#include "TestData.h"

#include "plugin/vtkGnomonPropKeys.h"

#include "vtkAssembly.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkFollower.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPropAssembly.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// A renderer and the collector that follows it.
struct Scene
{
  vtkNew<vtkRenderer> renderer;
  OccluderCollector collector;

  OccluderCollector::Change collect() { return this->collector.collect(this->renderer); }
  const Occluders& occluders() const { return this->collector.occluders(); }
  const Surface& surface(std::size_t i) const { return this->occluders().surfaces.at(i); }
  std::size_t surfaceCount() const { return this->occluders().surfaces.size(); }

  /// Triangle of a surface, vertices counted from the surface's first.
  glm::uvec3 triangle(std::size_t surface, std::uint32_t number) const
  {
    const Surface& s = this->surface(surface);
    return this->occluders().triangles.at(s.firstTriangle + number) - s.firstVertex;
  }
  glm::dvec3 positionWorld(std::size_t surface, std::uint32_t vertex) const
  {
    const Surface& s = this->surface(surface);
    return glm::dvec3(this->occluders().positionsCentred.at(s.firstVertex + vertex)) +
      this->occluders().centreWorld;
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
  const OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 0);
  EXPECT_EQ(scene.occluders().topologyVersion, topology);
  EXPECT_EQ(scene.occluders().positionsVersion, positions);
}

vtkSmartPointer<vtkActor> makeCompositeActor(vtkMultiBlockDataSet* tree)
{
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(tree);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkCompositeDataDisplayAttributes* attributesOf(vtkActor* actor)
{
  return vtkCompositePolyDataMapper2::SafeDownCast(actor->GetMapper())
    ->GetCompositeDataDisplayAttributes();
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

// ---- triangles -------------------------------------------------------------

TEST(OccluderTriangles, PolygonsAreFannedFromTheirFirstVertex)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(makePolyData(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 }, { 1, 2, 0 }, { 0, 1, 0 } }, { { 2, 3, 4, 0, 1 } })));
  scene.collect();
  ASSERT_EQ(scene.surface(0).triangleCount, 3u);
  EXPECT_EQ(scene.triangle(0, 0), glm::uvec3(2, 3, 4));
  EXPECT_EQ(scene.triangle(0, 1), glm::uvec3(2, 4, 0));
  EXPECT_EQ(scene.triangle(0, 2), glm::uvec3(2, 0, 1));
  EXPECT_TRUE(scene.surface(0).triangleOfDrawn.empty());
}

TEST(OccluderTriangles, StripsTurnEveryOtherTriangle)
{
  Scene scene;
  const auto data =
    makePolyData({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0, 2, 0 } }, {});
  data->SetStrips(makeCells({ { 0, 1, 2, 3, 4 } }));
  scene.renderer->AddActor(makeActor(data));
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 1u);
  ASSERT_EQ(scene.surface(0).triangleCount, 3u);
  EXPECT_EQ(scene.triangle(0, 0), glm::uvec3(0, 1, 2));
  EXPECT_EQ(scene.triangle(0, 1), glm::uvec3(1, 3, 2));
  EXPECT_EQ(scene.triangle(0, 2), glm::uvec3(2, 3, 4));
}

TEST(OccluderTriangles, PolygonsAndStripsAreSurfacesOfTheirOwn)
{
  Scene scene;
  const auto data = makeSquare();
  data->SetStrips(makeCells({ { 0, 1, 3, 2 } }));
  scene.renderer->AddActor(makeActor(data));
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 2u);
  EXPECT_EQ(scene.surface(0).triangleCount, 2u);
  EXPECT_EQ(scene.surface(1).triangleCount, 2u);
  EXPECT_EQ(scene.surface(1).firstTriangle, 2u);
}

TEST(OccluderTriangles, EqualVerticesAreNeverDrawnAndTakeNoNumber)
{
  // The second point equals the third: VTK draws one triangle of the quad, which is no drop.
  Scene scene;
  scene.renderer->AddActor(makeActor(
    makePolyData({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } })));
  scene.collect();
  ASSERT_EQ(scene.surface(0).triangleCount, 1u);
  EXPECT_TRUE(scene.surface(0).triangleOfDrawn.empty());
  EXPECT_EQ(scene.occluders().droppedZeroArea, 0u);
  EXPECT_EQ(scene.occluders().droppedNonFinite, 0u);
}

TEST(OccluderTriangles, DropsWhatHasNoAreaOrIsNotFinite)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(
    makePolyData({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 }, { notANumber, 0, 0 } },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 }, { 1, 3, 2 } })));
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedZeroArea, 1u);
  EXPECT_EQ(scene.occluders().droppedNonFinite, 1u);
  const std::vector<std::uint32_t> table = { 0, Surface::noTriangle, Surface::noTriangle, 1 };
  EXPECT_EQ(scene.surface(0).triangleOfDrawn, table);
  ASSERT_EQ(scene.surface(0).triangleCount, 2u);
  expectNear(scene.positionWorld(0, scene.triangle(0, 1).y), { 2, 0, 0 });
  for (const glm::vec3& position : scene.occluders().positionsCentred)
  {
    EXPECT_TRUE(
      std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
  }
}

TEST(OccluderTriangles, DropsWhatAMatrixFlattensOrBlowsUp)
{
  Scene scene;
  const auto actor = makeActor(makeSquare());
  actor->SetScale(1.0, 1e-80, 1.0);
  scene.renderer->AddActor(actor);
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedZeroArea, 2u);
  EXPECT_EQ(scene.surface(0).triangleCount, 0u);

  actor->SetScale(1.0, 1e80, 1.0); // too large for a float
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedNonFinite, 2u);

  actor->SetScale(1.0, 1.0, 1.0); // and back: nothing stays dropped
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedZeroArea + scene.occluders().droppedNonFinite, 0u);
  EXPECT_EQ(scene.surface(0).triangleCount, 2u);
  EXPECT_TRUE(scene.surface(0).triangleOfDrawn.empty());

  actor->SetScale(1e-80, 1.0, 1.0); // a move may drop what was kept
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedZeroArea, 2u);
  EXPECT_EQ(scene.surface(0).triangleCount, 0u);
  expectNothingDone(scene);
}

TEST(OccluderTriangles, DropsTrianglesOfPointsThatAreNotThere)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(
    makePolyData({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 1, 7 } })));
  scene.collect();
  EXPECT_EQ(scene.surface(0).triangleCount, 1u);
  EXPECT_EQ(scene.occluders().droppedNonFinite, 1u);
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
    scene.renderer->AddActor(makeActor(data));
  }
  scene.renderer->AddActor(makeActor(makeSquare(VTK_DOUBLE)));
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    expectNear(scene.positionWorld(i, scene.triangle(i, 1).y), { 1, 1, 0 });
  }
}

TEST(OccluderTriangles, OnlyUsedPointsBecomeVertices)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(
    makePolyData({ { 1e9, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { notANumber, 0, 0 } },
      { { 1, 2, 3 } })));
  scene.collect();
  EXPECT_EQ(scene.surface(0).vertexCount, 3u);
  EXPECT_NEAR(scene.occluders().allCentred.radius(), std::sqrt(0.5), 1e-6);
}

TEST(OccluderTriangles, ThereIsRoomToReadTheLastPositionAs16Bytes)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(makeSquare()));
  scene.collect();
  EXPECT_GT(
    scene.occluders().positionsCentred.capacity(), scene.occluders().positionsCentred.size());
}

// ---- props -----------------------------------------------------------------

TEST(OccluderProps, WhatIsNotAnOpaqueSurfaceIsLeftOut)
{
  Scene scene;
  for (int i = 0; i < 5; ++i)
  {
    scene.renderer->AddActor(makeActor(makeSquare()));
  }
  vtkPropCollection* props = scene.renderer->GetViewProps();
  const auto actor = [props](int i) { return vtkActor::SafeDownCast(props->GetItemAsObject(i)); };
  actor(0)->SetVisibility(false);
  actor(1)->GetProperty()->SetRepresentationToWireframe();
  actor(2)->GetProperty()->SetRepresentationToPoints();
  actor(3)->GetProperty()->SetOpacity(0.5);
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 1u);

  actor(3)->ForceOpaqueOn();
  actor(4)->ForceTranslucentOn();
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 1u);
  actor(4)->ForceTranslucentOff();
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 2u);
}

TEST(OccluderProps, TranslucentColoursMakeAPropTranslucent)
{
  Scene scene;
  const auto square = makeSquare();
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (int i = 0; i < 4; ++i)
  {
    colours->InsertNextTuple4(255, 0, 0, 128);
  }
  square->GetPointData()->SetScalars(colours);
  scene.renderer->AddActor(makeActor(square));
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
}

TEST(OccluderProps, UnservedMappersAreNoted)
{
  Scene scene;
  const PlacedGlyphs glyphs(makeSquare(), makeSquare());
  glyphs.mapper->SetCullingAndLOD(true);
  scene.renderer->AddActor(glyphs.actor);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
  ASSERT_EQ(scene.collector.notes().size(), 1u);
  EXPECT_NE(scene.collector.notes()[0].find("Glyph3DMapper"), std::string::npos);
}

TEST(OccluderProps, ActorsWhoseMatrixIsNotKnownAreNoted)
{
  Scene scene;
  vtkNew<vtkAssembly> assembly;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkFollower> follower;
    follower->SetMapper(makeActor(makeSquare())->GetMapper());
    assembly->AddPart(follower);
  }
  scene.renderer->AddActor(assembly);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
  ASSERT_EQ(scene.collector.notes().size(), 1u);
  EXPECT_NE(scene.collector.notes()[0].find("Follower"), std::string::npos);
  EXPECT_NE(scene.collector.notes()[0].find("2 props"), std::string::npos);
}

TEST(OccluderProps, TranslucentOnesAreHeldIfAskedToCast)
{
  Scene scene;
  const auto pane = makeActor(makeSquare());
  pane->GetProperty()->SetOpacity(0.5);
  scene.renderer->AddActor(pane);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
  EXPECT_EQ(scene.collector.translucentReceivers(), 1u);
  vtkGnomonPropKeys::SetCasts(pane, true);
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 1u);
  EXPECT_TRUE(scene.occluders().surfaces[0].casts);
  vtkGnomonPropKeys::SetReceives(pane, false);
  scene.collect();
  EXPECT_EQ(scene.collector.translucentReceivers(), 0u);
  vtkGnomonPropKeys::SetCasts(pane, false);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
}

// ---- glyphs ------------------------------------------------------------------

TEST(OccluderGlyphs, AreReadAgainOnlyWhenTheyChange)
{
  Scene scene;
  const auto points = makeSquare();
  const auto source = makeSquare();
  const PlacedGlyphs glyphs(points, source);
  scene.renderer->AddActor(glyphs.actor);
  scene.collect();
  EXPECT_EQ(scene.occluders().triangles.size(), 4u * 2u);
  EXPECT_EQ(scene.collect().extracted, 0);

  glyphs.actor->SetPosition(1, 2, 3);
  OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 1);
  expectNear(scene.positionWorld(0, 5), glm::dvec3(3, 2, 3)); // the second glyph's second corner

  points->GetPoints()->SetPoint(1, 5, 0, 0);
  points->GetPoints()->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  expectNear(scene.positionWorld(0, 5), glm::dvec3(7, 2, 3));

  glyphs.mapper->SetScaleFactor(2.0);
  EXPECT_EQ(scene.collect().extracted, 1);
  expectNear(scene.positionWorld(0, 5), glm::dvec3(8, 2, 3));

  source->GetPoints()->SetPoint(1, 3, 0, 0);
  source->GetPoints()->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  expectNear(scene.positionWorld(0, 5), glm::dvec3(12, 2, 3));
  EXPECT_EQ(scene.collect().extracted, 0);
}

TEST(OccluderGlyphs, WhatVtkDoesNotDrawIsLeftOut)
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
  glyphs.mapper->SetOrientationArray("pairs"); // not three components
  scene.collect();
  EXPECT_EQ(scene.occluders().triangles.size(), 0u);
  glyphs.mapper->OrientOff();
  scene.collect();
  EXPECT_EQ(scene.occluders().triangles.size(), 8u);
  glyphs.mapper->UseSourceTableTreeOn(); // without a tree
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
  glyphs.mapper->UseSourceTableTreeOff();
  glyphs.mapper->RemoveAllInputConnections(1);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
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
  const PlacedGlyphs glyphs(points, makePolyData(corners, triangles));
  scene.renderer->AddActor(glyphs.actor);
  scene.renderer->AddActor(makeActor(makeSquare()));
  for (int frame = 0; frame < 2; ++frame)
  {
    scene.collect();
    EXPECT_EQ(scene.occluders().triangles.size(), 2u);
    ASSERT_EQ(scene.collector.notes().size(), 1u);
    EXPECT_NE(scene.collector.notes()[0].find("32769 glyphs"), std::string::npos);
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

/// Sixty-four squares in a row, one of them without area, at 4,096 points on a line.
struct RowGlyphs
{
  static vtkSmartPointer<vtkPolyData> makePoints()
  {
    const auto points = vtkSmartPointer<vtkPolyData>::New();
    points->SetPoints(vtkNew<vtkPoints>());
    for (int i = 0; i < 4096; ++i)
    {
      points->GetPoints()->InsertNextPoint(0.0, 2.0 * i, 0.0);
    }
    return points;
  }
  static vtkSmartPointer<vtkPolyData> makeRow()
  {
    std::vector<glm::dvec3> corners;
    Cells triangles;
    for (vtkIdType i = 0; i < 64; ++i)
    {
      const auto x = static_cast<double>(i);
      corners.insert(
        corners.end(), { { x, 0, 0 }, { x + 1, 0, 0 }, { x, i == 9 ? 0.0 : 1.0, 1e-9 } });
      triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
    }
    corners[3 * 9 + 2] = { 11.0, 0, 0 };
    return makePolyData(corners, triangles);
  }

  vtkSmartPointer<vtkPolyData> points = makePoints();
  PlacedGlyphs glyphs{ this->points, makeRow() };
};

TEST(OccluderGlyphs, KeptAsInstancesAreThereOnce)
{
  Scene scene;
  const RowGlyphs row;
  row.glyphs.actor->SetPosition(1e6, 0, 5);
  scene.renderer->AddActor(row.glyphs.actor);
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 1u);
  const Surface& surface = scene.surface(0);
  EXPECT_EQ(surface.triangleCount, 63u);
  EXPECT_EQ(surface.drawnCount(), 64u);
  ASSERT_EQ(surface.centredFromSource.size(), 4096u);
  EXPECT_FALSE(surface.mirrored);
  EXPECT_EQ(scene.occluders().droppedZeroArea, 4096u);
  const auto cornerWorld = [&](std::size_t instance, std::uint32_t vertex)
  {
    return glm::dvec3(glm::dmat4x3(surface.centredFromSource[instance]) *
             glm::dvec4(glm::dvec3(scene.occluders().positionsCentred[vertex]), 1.0)) +
      scene.occluders().centreWorld;
  };
  expectNear(cornerWorld(0, 1), { 1e6 + 1, 0, 5 }, 1e-3);
  expectNear(cornerWorld(4095, 191), { 1e6 + 63, 8191, 5 }, 1e-3);
  const Bounds& bounds = scene.occluders().castersCentred;
  expectNear(bounds.lower + scene.occluders().centreWorld, { 1e6, 0, 5 }, 1e-3);
  expectNear(bounds.upper + scene.occluders().centreWorld, { 1e6 + 64, 8191, 5 }, 1e-3);
  expectNothingDone(scene);

  row.glyphs.actor->SetPosition(1e6, 3, 5);
  const OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 1);
  expectNear(cornerWorld(4095, 191), { 1e6 + 63, 8194, 5 }, 1e-3);
  expectNothingDone(scene);
}

/// VTK makes 1e-10 of a scale of 0; as triangles such glyphs have no area.
TEST(OccluderGlyphs, InstancesThatCannotBeSeenAreLeftOut)
{
  Scene scene;
  const RowGlyphs row;
  vtkNew<vtkFloatArray> sizes;
  sizes->SetName("sizes");
  sizes->SetNumberOfTuples(4096);
  sizes->Fill(1.0);
  sizes->SetTuple1(17, 0.0);
  row.points->GetPointData()->AddArray(sizes);
  row.glyphs.mapper->SetScaleArray("sizes");
  row.glyphs.mapper->SetScaleModeToScaleByMagnitude();
  row.points->GetPoints()->SetPoint(5, 0.0, notANumber, 0.0);
  scene.renderer->AddActor(row.glyphs.actor);
  scene.collect();
  const std::vector<glm::mat4x3>& instances = scene.surface(0).centredFromSource;
  ASSERT_EQ(instances.size(), 4096u);
  for (std::size_t i = 0; i < 4096; ++i)
  {
    EXPECT_EQ(Surface::isLeftOut(instances[i]), i == 5 || i == 17) << i;
  }
  EXPECT_EQ(scene.occluders().droppedNonFinite, 64u);
  EXPECT_EQ(scene.occluders().droppedZeroArea, 64u + 4094u);

  row.glyphs.actor->SetScale(0.0, 0.0, 0.0);
  scene.collect();
  EXPECT_EQ(scene.occluders().droppedNonFinite + scene.occluders().droppedZeroArea, 64u * 4096u);
  EXPECT_TRUE(scene.occluders().castersCentred.empty());
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

TEST(OccluderProps, AMapperWithoutInputIsNoSurface)
{
  Scene scene;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  scene.renderer->AddActor(vtkSmartPointer<vtkActor>::New());
  scene.renderer->AddActor(makeActor(vtkSmartPointer<vtkPolyData>::New()));
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
  EXPECT_TRUE(scene.occluders().allCentred.empty());
}

TEST(OccluderProps, AssembliesMultiplyTheMatricesOfAllTheirLevels)
{
  Scene scene;
  const auto leaf = makeActor(makeSquare());
  leaf->SetPosition(1, 0, 0);
  leaf->RotateZ(30);
  vtkNew<vtkMatrix4x4> user;
  user->SetElement(0, 0, 2.0);
  user->SetElement(1, 2, 0.5);
  leaf->SetUserMatrix(user);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(leaf);
  inner->RotateX(50);
  inner->SetScale(2, 3, 4);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->SetPosition(0, 5, 0);
  vtkNew<vtkTransform> turn;
  turn->RotateY(70);
  outer->SetUserTransform(turn);
  scene.renderer->AddViewProp(outer);
  scene.collect();

  vtkNew<vtkTransform> expected;
  expected->Concatenate(outer->GetMatrix());
  expected->Concatenate(inner->GetMatrix());
  expected->Concatenate(leaf->GetMatrix());
  ASSERT_EQ(scene.surfaceCount(), 1u);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    const double* p = expected->TransformDoublePoint(makeSquare()->GetPoint(i));
    expectNear(scene.positionWorld(0, static_cast<std::uint32_t>(i)), { p[0], p[1], p[2] }, 1e-5);
  }

  inner->RotateX(10); // a part that turns inside is noticed
  EXPECT_EQ(scene.collect().retransformed, 1);
  expected->Identity();
  expected->Concatenate(outer->GetMatrix());
  expected->Concatenate(inner->GetMatrix());
  expected->Concatenate(leaf->GetMatrix());
  const double* p = expected->TransformDoublePoint(1, 1, 0);
  expectNear(scene.positionWorld(0, 2), { p[0], p[1], p[2] }, 1e-5);
}

TEST(OccluderProps, OnePartMayHangInSeveralPlaces)
{
  Scene scene;
  const auto leaf = makeActor(makeSquare());
  vtkNew<vtkAssembly> left;
  left->AddPart(leaf);
  left->SetPosition(-10, 0, 0);
  vtkNew<vtkAssembly> right;
  right->AddPart(leaf);
  right->SetPosition(10, 0, 0);
  vtkNew<vtkPropAssembly> both;
  both->AddPart(left);
  both->AddPart(right);
  scene.renderer->AddViewProp(both);
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 2u);
  expectNear(scene.positionWorld(0, 2), { -9, 1, 0 });
  expectNear(scene.positionWorld(1, 2), { 11, 1, 0 });
}

TEST(OccluderProps, TheViewPropsKeysCountForItsParts)
{
  Scene scene;
  const auto plain = makeActor(makeSquare());
  vtkGnomonPropKeys::SetOneSided(plain, true);
  const auto part = makeActor(makeSquare());
  vtkGnomonPropKeys::SetCasts(part, false); // overwritten by the assembly's when drawn
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(part);
  assembly->SetPosition(5, 0, 0);
  vtkGnomonPropKeys::SetReceives(assembly, false);
  scene.renderer->AddActor(plain);
  scene.renderer->AddViewProp(assembly);
  scene.collect();
  ASSERT_EQ(scene.surfaceCount(), 2u);
  EXPECT_TRUE(scene.surface(0).oneSided);
  EXPECT_TRUE(scene.surface(0).casts && scene.surface(0).receives);
  EXPECT_TRUE(scene.surface(1).casts);
  EXPECT_FALSE(scene.surface(1).receives);
}

TEST(OccluderProps, CastersBoxLeavesOutWhatOnlyReceives)
{
  Scene scene;
  const auto caster = makeActor(makeSquare());
  const auto receiver = makeActor(makeSquare());
  receiver->SetPosition(3, 0, 0);
  vtkGnomonPropKeys::SetCasts(receiver, false);
  scene.renderer->AddActor(caster);
  scene.renderer->AddActor(receiver);
  scene.collect();
  const glm::dvec3 centre = scene.occluders().centreWorld;
  expectNear(scene.occluders().castersCentred.upper + centre, { 1, 1, 0 });
  expectNear(scene.occluders().allCentred.upper + centre, { 4, 1, 0 });
}

TEST(OccluderProps, ClippingPlanesCutTheirSurfaces)
{
  Scene scene;
  const auto actor = makeActor(makeSquare());
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0, 0);
  plane->SetNormal(1, 0, 0);
  actor->GetMapper()->AddClippingPlane(plane);
  scene.renderer->AddActor(actor);
  scene.collect();
  const auto area = [&scene]
  {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < scene.surface(0).triangleCount; ++i)
    {
      const glm::uvec3 triangle = scene.triangle(0, i);
      const glm::dvec3 a = scene.positionWorld(0, triangle.x);
      const glm::dvec3 cross =
        glm::cross(scene.positionWorld(0, triangle.y) - a, scene.positionWorld(0, triangle.z) - a);
      sum += 0.5 * cross.z; // signed: the pieces keep their orientation
    }
    return sum;
  };
  EXPECT_NEAR(area(), 0.5, 1e-6);
  ASSERT_EQ(scene.surface(0).triangleOfDrawn.size(), 2u);
  expectNear(scene.occluders().allCentred.lower + scene.occluders().centreWorld, { 0.5, 0, 0 });
  expectNothingDone(scene);

  actor->SetPosition(0.25, 0, 0); // the plane stays where it is in the world
  scene.collect();
  EXPECT_NEAR(area(), 0.75, 1e-6);
  plane->SetOrigin(1, 0, 0);
  scene.collect();
  EXPECT_NEAR(area(), 0.25, 1e-6);
  plane->SetOrigin(2, 0, 0);
  scene.collect();
  EXPECT_EQ(scene.surface(0).triangleCount, 0u);
  EXPECT_EQ(scene.occluders().droppedZeroArea + scene.occluders().droppedNonFinite, 0u);
  actor->GetMapper()->RemoveAllClippingPlanes();
  scene.collect();
  EXPECT_NEAR(area(), 1.0, 1e-6);
}

// ---- composite data --------------------------------------------------------

TEST(OccluderBlocks, FollowVisibilityAndOpacityAsDrawn)
{
  // root { a, none, branch { b, c }, a again }
  Scene scene;
  const auto a = makeSquare();
  const auto b = makeSquare();
  const auto c = makeSquare();
  vtkNew<vtkMultiBlockDataSet> branch;
  branch->SetBlock(0, b);
  branch->SetBlock(1, c);
  vtkNew<vtkMultiBlockDataSet> root;
  root->SetBlock(0, a);
  root->SetBlock(1, nullptr);
  root->SetBlock(2, branch);
  root->SetBlock(3, a);
  const auto actor = makeCompositeActor(root);
  scene.renderer->AddActor(actor);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 3u); // a is drawn once

  // A visible block below a hidden one is drawn.
  attributesOf(actor)->SetBlockVisibility(branch, false);
  attributesOf(actor)->SetBlockVisibility(c, true);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 2u);

  attributesOf(actor)->SetBlockOpacity(c, 0.5);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 1u);

  attributesOf(actor)->RemoveBlockVisibilities();
  attributesOf(actor)->RemoveBlockOpacities();
  actor->GetProperty()->SetOpacity(0.5); // not drawn in the opaque pass, whatever its blocks say
  attributesOf(actor)->SetBlockOpacity(a, 1.0);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 0u);
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
  EXPECT_EQ(scene.surfaceCount(), 3u);
}

TEST(OccluderBlocks, PlainPolyDataMayFeedACompositeMapper)
{
  Scene scene;
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(makeSquare());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  scene.collect();
  EXPECT_EQ(scene.surfaceCount(), 1u);
}

// ---- what changes, and what it costs -----------------------------------------

TEST(OccluderChanges, NothingChangedNothingDone)
{
  Scene scene;
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(makeActor(makeSquare()));
  scene.renderer->AddViewProp(assembly);
  EXPECT_EQ(scene.collect().extracted, 2);
  expectNothingDone(scene);
  expectNothingDone(scene);
}

TEST(OccluderChanges, AMovedPropOnlyMovesItsVertices)
{
  Scene scene;
  scene.renderer->AddActor(makeActor(makeSquare()));
  const auto mover = makeActor(makeSquare());
  scene.renderer->AddActor(mover);
  scene.collect();
  const Occluders before = scene.occluders();
  mover->SetPosition(0, 0, 2);
  const OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 1);
  EXPECT_EQ(scene.occluders().topologyVersion, before.topologyVersion);
  EXPECT_NE(scene.occluders().positionsVersion, before.positionsVersion);
  EXPECT_EQ(scene.surface(0).positionsVersion, before.surfaces[0].positionsVersion);
  EXPECT_NE(scene.surface(1).positionsVersion, before.surfaces[1].positionsVersion);
  EXPECT_EQ(scene.surface(1).topologyVersion, before.surfaces[1].topologyVersion);
  expectNear(scene.positionWorld(1, 2), { 1, 1, 2 });
  expectNear(scene.occluders().allCentred.upper + scene.occluders().centreWorld, { 1, 1, 2 });
  expectNothingDone(scene);
}

TEST(OccluderChanges, EditedPointsAreNoticedHoweverTheyAreReported)
{
  Scene scene;
  const auto square = makeSquare();
  scene.renderer->AddActor(makeActor(square));
  scene.collect();
  const auto edit = [&](double x) { square->GetPoints()->GetData()->SetComponent(2, 0, x); };
  const std::uint64_t topology = scene.occluders().topologyVersion;

  edit(2);
  square->GetPoints()->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  expectNear(scene.positionWorld(0, 2), { 2, 1, 0 });
  edit(3);
  square->Modified();
  scene.collect();
  expectNear(scene.positionWorld(0, 2), { 3, 1, 0 });
  edit(4);
  square->GetPoints()->GetData()->Modified();
  scene.collect();
  expectNear(scene.positionWorld(0, 2), { 4, 1, 0 });

  // The same triangles throughout: structures built on them need a refit only.
  EXPECT_EQ(scene.occluders().topologyVersion, topology);
  square->SetPolys(makeCells({ { 0, 1, 2 } }));
  scene.collect();
  EXPECT_NE(scene.occluders().topologyVersion, topology);
  EXPECT_EQ(scene.surface(0).triangleCount, 1u);
}

TEST(OccluderChanges, ModifiedWithoutAChangeChangesNoVersion)
{
  Scene scene;
  const auto square = makeSquare();
  scene.renderer->AddActor(makeActor(square));
  scene.collect();
  const std::uint64_t positions = scene.occluders().positionsVersion;
  square->Modified();
  EXPECT_EQ(scene.collect().extracted, 1);
  EXPECT_EQ(scene.occluders().positionsVersion, positions);
}

TEST(OccluderChanges, NewColoursAreNoNewShape)
{
  Scene scene;
  const auto square = makeSquare();
  scene.renderer->AddActor(makeActor(square));
  scene.collect();
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfTuples(4);
  scalars->Fill(1.0);
  square->GetPointData()->SetScalars(scalars);
  expectNothingDone(scene);
}

TEST(OccluderChanges, UpstreamFiltersAndSwappedInputsAreNoticed)
{
  Scene scene;
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  scene.collect();
  EXPECT_EQ(scene.surface(0).triangleCount, 2u);
  plane->SetResolution(4, 4);
  EXPECT_EQ(scene.collect().extracted, 1);
  EXPECT_EQ(scene.surface(0).triangleCount, 32u);
  mapper->SetInputData(makeSquare());
  EXPECT_EQ(scene.collect().extracted, 1);
  EXPECT_EQ(scene.surface(0).triangleCount, 2u);
}

TEST(OccluderChanges, FlagsOnlyChangeFlags)
{
  Scene scene;
  const auto actor = makeActor(makeSquare());
  scene.renderer->AddActor(actor);
  scene.collect();
  const Occluders before = scene.occluders();
  vtkGnomonPropKeys::SetCasts(actor, false);
  const OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted + change.retransformed, 0);
  EXPECT_FALSE(scene.surface(0).casts);
  EXPECT_NE(scene.occluders().topologyVersion, before.topologyVersion);
  EXPECT_EQ(scene.surface(0).topologyVersion, before.surfaces[0].topologyVersion);
  EXPECT_EQ(scene.surface(0).positionsVersion, before.surfaces[0].positionsVersion);
  EXPECT_TRUE(scene.occluders().castersCentred.empty());
  EXPECT_FALSE(scene.occluders().allCentred.empty());
}

TEST(OccluderChanges, TheOthersStayWhenSurfacesComeAndGo)
{
  Scene scene;
  const auto first = makeActor(makeSquare());
  const auto second = makeActor(makeSquare());
  second->SetPosition(0.3, 0, 0); // near enough for the centre to stay
  scene.renderer->AddActor(first);
  scene.renderer->AddActor(second);
  scene.collect();
  const Surface before = scene.surface(1);

  scene.renderer->RemoveActor(first);
  EXPECT_EQ(scene.collect().extracted, 0);
  ASSERT_EQ(scene.surfaceCount(), 1u);
  EXPECT_EQ(scene.surface(0).topologyVersion, before.topologyVersion);
  EXPECT_EQ(scene.surface(0).positionsVersion, before.positionsVersion);
  EXPECT_EQ(scene.surface(0).firstVertex, 0u);
  EXPECT_EQ(scene.triangle(0, 1), glm::uvec3(0, 2, 3));
  expectNear(scene.positionWorld(0, 2), { 1.3, 1, 0 });
  expectNothingDone(scene);

  scene.renderer->AddActor(first); // now behind the other one
  EXPECT_EQ(scene.collect().extracted, 1);
  expectNear(scene.positionWorld(0, 2), { 1.3, 1, 0 });
  expectNear(scene.positionWorld(1, 2), { 1, 1, 0 });
  expectNothingDone(scene);
}

TEST(OccluderChanges, ManyPropsAndBlocksStayFollowed)
{
  // Guards against work that grows with the square: 10,000 props would take minutes.
  Scene scene;
  const auto square = makeSquare();
  for (int i = 0; i < 10000; ++i)
  {
    const auto actor = makeActor(square);
    actor->SetPosition(i % 100, i / 100, 0);
    scene.renderer->GetViewProps()->AddItem(actor); // AddActor searches the list each time
  }
  vtkNew<vtkMultiBlockDataSet> root;
  for (unsigned int i = 0; i < 1000; ++i)
  {
    root->SetBlock(i, makeSquare());
  }
  scene.renderer->AddActor(makeCompositeActor(root));
  EXPECT_EQ(scene.collect().extracted, 11000);
  expectNothingDone(scene);
  scene.renderer->GetViewProps()->RemoveItem(0);
  EXPECT_EQ(scene.collect().extracted, 0);
  EXPECT_EQ(scene.surfaceCount(), 10999u);
}

// ---- the centre --------------------------------------------------------------

TEST(OccluderCentre, FarScenesKeepTheirPrecision)
{
  Scene scene;
  const glm::dvec3 far(4e6, -4e6, 4e6);
  const auto byMatrix = makeActor(makeSquare());
  byMatrix->SetPosition(far.x, far.y, far.z);
  scene.renderer->AddActor(byMatrix);
  scene.renderer->AddActor(makeActor(makePolyData(
    { far + glm::dvec3(1.001, 0, 0), far + glm::dvec3(2, 0, 0), far + glm::dvec3(1, 1, 0) },
    { { 0, 1, 2 } }, VTK_DOUBLE)));
  scene.collect();
  expectNear(scene.positionWorld(0, 2), far + glm::dvec3(1, 1, 0), 1e-6);
  expectNear(scene.positionWorld(1, 0), far + glm::dvec3(1.001, 0, 0), 1e-6);
}

TEST(OccluderCentre, LiesOnAGridAsCoarseAsTheScene)
{
  const auto around = [](const glm::dvec3& middle, double half) {
    return Bounds{ middle - half, middle + half };
  };
  for (const double half : { 1e-9, 0.3, 1.0, 1.7, 4e5, 1e20 })
  {
    const glm::dvec3 touching(half, -half, 0.9 * half);
    EXPECT_EQ(snapshotCentre(around(touching, half)), glm::dvec3(0.0)) << "holds the origin";
    for (const double away : { 3.0, 1e3, 1.234567e9 })
    {
      const Bounds box = around(away * touching, half);
      const glm::dvec3 centre = snapshotCentre(box);
      for (const glm::dvec3& corner : box.corners())
      {
        const glm::dvec3 largest = glm::abs(corner - centre);
        EXPECT_LE(std::max({ largest.x, largest.y, largest.z }), 3.0 * box.radius());
      }
      // Some other box around the centre.
      EXPECT_EQ(snapshotCentre(around(centre + 0.5 * half, half)), centre);
    }
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(snapshotCentre(Bounds()), glm::dvec3(0.0));
  EXPECT_EQ(snapshotCentre(around(glm::dvec3(0.0), infinity)), glm::dvec3(0.0));
  EXPECT_EQ(snapshotCentre(around(glm::dvec3(1.0), 1e200)), glm::dvec3(0.0));
  EXPECT_EQ(snapshotCentre(around(glm::dvec3(notANumber), 1.0)), glm::dvec3(0.0));
  expectNear(snapshotCentre(around(glm::dvec3(7.0), 0.0)), glm::dvec3(8.0)); // a point
}

TEST(OccluderCentre, StaysWhileTheSceneChangesLittle)
{
  Scene scene;
  const auto actor = makeActor(makeSquare());
  actor->SetPosition(100, 0, 0);
  scene.renderer->AddActor(actor);
  scene.collect();
  const glm::dvec3 centre = scene.occluders().centreWorld;
  actor->SetPosition(100.2, 0.1, 0);
  EXPECT_EQ(scene.collect().retransformed, 1);
  EXPECT_EQ(scene.occluders().centreWorld, centre);
  actor->SetPosition(112, 0, 0);
  scene.collect();
  EXPECT_NE(scene.occluders().centreWorld, centre);
  expectNear(scene.positionWorld(0, 2), { 113, 1, 0 });
}

TEST(OccluderCentre, MovesEverySurfaceWithIt)
{
  Scene scene;
  const auto near = makeActor(makeSquare());
  const auto far = makeActor(makeSquare());
  far->SetPosition(1000, 0, 0);
  scene.renderer->AddActor(near);
  scene.renderer->AddActor(far);
  scene.collect();
  near->SetVisibility(false);
  const OccluderCollector::Change change = scene.collect();
  EXPECT_EQ(change.extracted, 0);
  EXPECT_EQ(change.retransformed, 1);
  expectNear(scene.occluders().centreWorld, { 1000, 0, 0 });
  expectNear(scene.positionWorld(0, 2), { 1001, 1, 0 });
}

TEST(OccluderCentre, DoesNotRememberWhatIsGone)
{
  Scene scene;
  const auto actor = makeActor(makeSquare());
  actor->SetPosition(40.1, 3.3, 7.7);
  const auto far = makeActor(makeSquare());
  far->SetPosition(-1e5, 3e4, 0);
  far->SetVisibility(false);
  scene.renderer->AddActor(actor);
  scene.renderer->AddActor(far);
  scene.collect();
  const Occluders before = scene.occluders();
  far->SetVisibility(true);
  scene.collect();
  EXPECT_NE(scene.occluders().centreWorld, before.centreWorld);
  far->SetVisibility(false);
  scene.collect();
  EXPECT_EQ(scene.occluders().centreWorld, before.centreWorld);
  EXPECT_EQ(scene.occluders().positionsCentred, before.positionsCentred);
  EXPECT_EQ(scene.occluders().allCentred.lower, before.allCentred.lower);
  EXPECT_EQ(scene.occluders().allCentred.upper, before.allCentred.upper);
}

// ---- holes of textures -------------------------------------------------------

namespace
{

/// A texture of these alphas, side by side.
vtkSmartPointer<vtkTexture> makeTexture(const std::vector<int>& alphas)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(alphas.size()), 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i)
  {
    image->SetScalarComponentFromDouble(static_cast<int>(i), 0, 0, 3, alphas[i]);
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

/// The unit square, its texture coordinates those of its points.
vtkSmartPointer<vtkPolyData> makeTexturedSquare()
{
  auto square = makeSquare();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < square->GetNumberOfPoints(); ++i)
  {
    coordinates->InsertNextTuple2(square->GetPoint(i)[0], square->GetPoint(i)[1]);
  }
  square->GetPointData()->SetTCoords(coordinates);
  return square;
}

} // namespace

TEST(OccluderCutouts, AreHeldForTexturesWithHolesOnly)
{
  Scene scene;
  const auto actor = makeActor(makeTexturedSquare());
  scene.renderer->AddActor(actor);
  scene.renderer->AddActor(makeActor(makeSquare())); // without texture coordinates
  scene.collect();
  actor->SetTexture(makeTexture({ 255, 255, 255 }));
  expectNothingDone(scene);
  EXPECT_FALSE(scene.surface(0).cutout);
  EXPECT_TRUE(scene.surface(0).textureCoordinates.empty());

  actor->SetTexture(makeTexture({ 0, 255, 0 }));
  EXPECT_EQ(scene.collect().extracted, 1);
  ASSERT_TRUE(scene.surface(0).cutout);
  EXPECT_EQ(scene.surface(0).cutout->texels, (std::vector<std::uint8_t>{ 0, 255, 0 }));
  EXPECT_EQ(scene.surface(0).textureCoordinates,
    (std::vector<glm::vec2>{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }));
  EXPECT_FALSE(scene.surface(1).cutout);
  expectNothingDone(scene);

  // Another mask is no other surface.
  const std::uint64_t topology = scene.occluders().topologyVersion;
  const std::uint64_t surface = scene.surface(0).topologyVersion;
  actor->SetTexture(makeTexture({ 255, 0, 0 }));
  EXPECT_EQ(scene.collect().extracted, 0);
  EXPECT_GT(scene.occluders().topologyVersion, topology);
  EXPECT_EQ(scene.surface(0).topologyVersion, surface);
  EXPECT_EQ(scene.surface(0).cutout->texels, (std::vector<std::uint8_t>{ 255, 0, 0 }));

  // Nor is a surface that moves.
  actor->SetPosition(1.0, 0.0, 0.0);
  EXPECT_EQ(scene.collect().retransformed, 1);
  EXPECT_EQ(scene.surface(0).textureCoordinates.size(), 4u);
  actor->SetTexture(nullptr);
  scene.collect();
  EXPECT_FALSE(scene.surface(0).cutout);
  EXPECT_TRUE(scene.surface(0).textureCoordinates.empty());
}

TEST(OccluderCutouts, ShareTheMaskOfATexture)
{
  Scene scene;
  const auto texture = makeTexture({ 0, 255 });
  for (int i = 0; i < 2; ++i)
  {
    const auto actor = makeActor(makeTexturedSquare());
    actor->SetTexture(texture);
    scene.renderer->AddActor(actor);
  }
  scene.collect();
  ASSERT_TRUE(scene.surface(0).cutout);
  EXPECT_EQ(scene.surface(0).cutout, scene.surface(1).cutout);
}

TEST(OccluderCutouts, HaveCoordinatesAtTheCornersThatClippingMakes)
{
  Scene scene;
  const auto actor = makeActor(makeTexturedSquare());
  actor->SetTexture(makeTexture({ 0, 255 }));
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.25, 0.0, 0.0);
  plane->SetNormal(1.0, 0.5, 0.0);
  actor->GetMapper()->AddClippingPlane(plane);
  scene.renderer->AddActor(actor);
  scene.collect();
  const Surface& surface = scene.surface(0);
  ASSERT_GT(surface.vertexCount, 4u);
  ASSERT_EQ(surface.textureCoordinates.size(), surface.vertexCount);
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    expectNear(
      glm::dvec3(surface.textureCoordinates[i], 0.0), scene.positionWorld(0, i)); // as everywhere
  }
}

TEST(OccluderCutouts, CoordinatesThatAreNotFiniteOrNotThereAreZero)
{
  Scene scene;
  const auto square = makeTexturedSquare();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->InsertNextTuple2(notANumber, 0.5);
  coordinates->InsertNextTuple2(0.5, std::numeric_limits<double>::infinity());
  coordinates->InsertNextTuple2(0.25, 0.5);
  square->GetPointData()->SetTCoords(coordinates);
  const auto actor = makeActor(square);
  actor->SetTexture(makeTexture({ 0, 255 }));
  scene.renderer->AddActor(actor);
  scene.collect();
  EXPECT_EQ(scene.surface(0).textureCoordinates,
    (std::vector<glm::vec2>{ { 0, 0 }, { 0, 0 }, { 0.25, 0.5 }, { 0, 0 } }));
}
