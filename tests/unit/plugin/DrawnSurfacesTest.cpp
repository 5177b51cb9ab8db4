// The snapshot's triangles of drawn primitives, in all numberings of VTK's mappers: each pixel's
// receiver lies where VTK's depths say.

#include "PassScene.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include <vtkAssembly.h>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositePolyDataMapper.h>
#include <vtkCullerCollection.h>
#include <vtkDataSetMapper.h>
#include <vtkGlyph3DMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPropAssembly.h>
#include <vtkUnsignedCharArray.h>

namespace gnomon::test
{
namespace
{

/// Return a bumpy grid of n x n quads over the unit square, whose diagonals vary.
vtkSmartPointer<vtkPolyData> makeBumps(int n, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> heightOf(0.0, 0.15);
  std::vector<glm::dvec3> points;
  Cells quads;
  for (int i = 0; i < (n + 1) * (n + 1); ++i)
  {
    const int column = i % (n + 1);
    const int row = i / (n + 1);
    points.emplace_back(double(column) / n, double(row) / n, heightOf(random));
    if (column < n && row < n)
    {
      std::vector<vtkIdType>& quad = quads.emplace_back();
      quad = { i, i + 1, i + n + 2, i + n + 1 };
      std::rotate(quad.begin(), quad.begin() + random() % 4, quad.end());
    }
  }
  return meshOf(points, quads);
}

/// Return polygons and strips, and lines and vertices of a pixel's size. VTK skips parts of many
/// polygons because their vertices coincide, and no part of strips.
vtkSmartPointer<vtkPolyData> makeMixed()
{
  const auto data = makeBumps(6, 7);
  vtkPoints* points = data->GetPoints();
  for (vtkIdType i = 3; i + 1 < points->GetNumberOfPoints(); i += 5)
  {
    points->SetPoint(i, points->GetPoint(i + 1));
  }
  const vtkIdType first = points->GetNumberOfPoints();
  for (int i = 0; i < 8; ++i)
  {
    points->InsertNextPoint(1.1 + 0.05 * (i % 2) + 0.1 * (i / 4), 0.15 * i, 0.02 * (i % 3));
  }
  data->SetStrips(cellsOf({ { first, first + 1, first + 2, first + 2, first + 3, first + 4 },
    { first + 4, first + 5, first + 6, first + 7 } }));
  const vtkIdType dot = points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1e-4, 0.0, 0.0);
  data->SetLines(cellsOf({ { dot, dot + 1, dot, dot + 1 }, { dot, dot + 1 } }));
  data->SetVerts(cellsOf({ { dot }, { dot, dot + 1, dot } }));
  return data;
}

vtkSmartPointer<vtkPolyData> moved(vtkPolyData* data, double x, double y)
{
  movePoints(data, [=](const glm::dvec3& at) { return at + glm::dvec3(x, y, 0.0); });
  return data;
}

vtkSmartPointer<vtkFloatArray> filled(vtkIdType count, int components = 1)
{
  const auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  array->Fill(0.5);
  return array;
}

void addCellScalars(vtkPolyData* data)
{
  data->GetCellData()->SetScalars(filled(data->GetNumberOfCells()));
}

/// Return six points around the unit circle, with an array for every setting of a glyph mapper.
vtkSmartPointer<vtkPolyData> makeGlyphPoints()
{
  std::vector<glm::dvec3> places;
  for (int i = 0; i < 6; ++i)
  {
    places.emplace_back(2.0 * std::cos(1.0472 * i), 2.0 * std::sin(1.0472 * i), 0.1 * i);
  }
  const auto points = meshOf(places, {});
  const auto addArray = [&](vtkDataArray* array, const char* name,
                          const std::function<std::vector<double>(int)>& valueOf)
  {
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(valueOf(0).size()));
    array->SetNumberOfTuples(6);
    for (int i = 0; i < 6; ++i)
    {
      array->SetTuple(i, valueOf(i).data());
    }
    points->GetPointData()->AddArray(array);
  };
  using Values = std::vector<double>;
  addArray(vtkNew<vtkFloatArray>(), "sizes", [](int i) { return Values{ 0.5 + 0.15 * i }; });
  addArray(vtkNew<vtkFloatArray>(), "sizes3",
    [](int i) {
      return Values{ 0.6 + 0.1 * i, 1.2 - 0.1 * i, 1.0 + 0.2 * (i % 2) };
    });
  // The first two are special cases: along -x, and no direction.
  addArray(vtkNew<vtkFloatArray>(), "directions",
    [](int i)
    {
      return i == 0 ? Values{ -2.0, 0.0, 0.0 }
                    : Values{ 0.3 * i - 0.3, i < 2 ? 0.0 : 1.0 - 0.3 * i, i < 2 ? 0.0 : 0.4 };
    });
  addArray(vtkNew<vtkFloatArray>(), "angles",
    [](int i) {
      return Values{ 20.0 * i, -15.0 * i, 35.0 * i };
    });
  addArray(vtkNew<vtkFloatArray>(), "turns",
    [](int i) {
      return Values{ 0.8, 0.1 * i, -0.2, 0.15 * i };
    });
  // -1 counts as 1, 4 is beyond the last
  addArray(vtkNew<vtkFloatArray>(), "sources", [](int i) { return Values{ i - 1.0 }; });
  addArray(vtkNew<vtkBitArray>(), "mask", [](int i) { return Values{ i == 2 ? 0.0 : 1.0 }; });
  return points;
}

struct DrawnSurfaces : PassTest
{
  DrawnSurfaces()
  {
    this->scene.addSun({ -0.2, -0.3, -1.0 });
    this->scene.choose(tracedWay);
  }

  void lookAtScene()
  {
    vtkCamera* const camera = this->scene.renderer->GetActiveCamera();
    camera->SetPosition(0.2, 0.3, 1.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    this->scene.renderer->ResetCamera();
    camera->Zoom(1.3);
    this->scene.renderer->ResetCameraClippingRange();
  }

  /// Draw the scene, and compare each pixel's receiver with what VTK draws.
  /// @param surfaces the snapshot's new ones; negative: any number
  /// @param isGrown true if receivers may lie elsewhere on the same plane: on a triangle that VTK
  /// grows to draw its edges
  void expectRight(int surfaces, bool isGrown = false, std::size_t leastCovered = 900)
  {
    const VisibilityImages kept = drawKept(this->scene);
    EXPECT_TRUE(surfaces < 0 || this->scene.report().surfacesExtracted == surfaces)
      << this->scene.report().surfacesExtracted;
    this->scene.renderPlain();
    vtkNew<vtkFloatArray> depths;
    this->scene.window->GetZbufferData(0, 0, kept.width - 1, kept.height - 1, depths);
    vtkCamera* const camera = this->scene.renderer->GetActiveCamera();
    vtkNew<vtkMatrix4x4> worldFromNdc;
    worldFromNdc->DeepCopy(camera->GetCompositeProjectionTransformMatrix(
      this->scene.renderer->GetTiledAspectRatio(), -1.0, 1.0));
    worldFromNdc->Invert();
    std::size_t lost = 0;
    std::size_t wrong = 0;
    const std::size_t covered = countPixels(kept,
      [&](std::size_t i)
      {
        const int x = static_cast<int>(i) % kept.width;
        const int y = kept.height - 1 - static_cast<int>(i) / kept.width;
        const double depth = depths->GetValue(y * kept.width + x);
        if ((depth < 1.0) != (kept.coverage[i] > 0.0f) || depth == 1.0)
        {
          lost += depth < 1.0 || kept.coverage[i] > 0.0f ? 1 : 0;
          return false;
        }
        const double ndc[4] = { (2.0 * x + 1.0) / kept.width - 1.0,
          (2.0 * y + 1.0) / kept.height - 1.0, 2.0 * depth - 1.0, 1.0 };
        double world[4];
        worldFromNdc->MultiplyPoint(ndc, world);
        const glm::dvec3 place = glm::make_vec3(world) / world[3];
        const glm::dvec3 off = place - positionOf(kept, i);
        const double distance =
          isGrown ? std::abs(glm::dot(off, normalOf(kept, i))) : glm::length(off);
        wrong += distance > 1e-3 * camera->GetDistance() ? 1 : 0;
        return true;
      });
    EXPECT_GE(covered, leastCovered);
    EXPECT_LE(lost, covered / 200 + 10) << "dots of lines and points, and rounding at outlines";
    EXPECT_LE(wrong, 4u) << "at edges";
  }

  PassScene scene{ 200, 150 };
};

/// A prop, and its surfaces in the snapshot.
struct DrawnCase
{
  const char* name;
  int surfaces;
  void (*build)(PassScene& scene);
  bool isGrown = false;
};

void addClippingPlane(vtkActor* actor, const glm::dvec3& normal)
{
  clip(actor->GetMapper(), glm::make_vec3(actor->GetCenter()), normal);
}

vtkSmartPointer<vtkMapper> dataSetMapperOf(vtkDataSet* data)
{
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputData(data);
  return vtkSmartPointer<vtkMapper>(mapper);
}

vtkSmartPointer<vtkMapper> partsMapperOf(vtkDataObject* data)
{
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(data);
  return vtkSmartPointer<vtkMapper>(mapper);
}

/// Blocks with mixed cells, one that is drawn twice, and one of glass.
vtkSmartPointer<vtkMultiBlockDataSet> makeParts()
{
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < 3; ++i)
  {
    blocks->SetBlock(2 * i, moved(i == 0 ? makeMixed() : makeBumps(3, i), 1.4 * i, 0.0));
  }
  blocks->SetBlock(5, blocks->GetBlock(4));
  const auto glass = moved(makeBumps(4, 5), 0.0, 1.2);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  colours->SetNumberOfTuples(glass->GetNumberOfPoints());
  colours->Fill(0); // not seen
  glass->GetPointData()->SetScalars(colours);
  blocks->SetBlock(7, glass);
  return blocks;
}

vtkSmartPointer<vtkImageData> makeGrid()
{
  const auto grid = vtkSmartPointer<vtkImageData>::New();
  grid->SetDimensions(4, 3, 5);
  grid->SetSpacing(0.3, 0.4, 0.2);
  return grid;
}

constexpr bool isGrown = true;
const DrawnCase drawnCases[] = {
  { "concave", 1,
    [](PassScene& scene)
    {
      scene.add(meshOf({ { 0.0, 0.0, 0.0 }, { 2.0, 0.0, 0.1 }, { 2.0, 2.0, 0.0 }, { 1.0, 0.4, 0.2 },
                         { 0.0, 2.0, 0.0 }, { -1.0, 1.0, 0.3 } },
        { { 1, 2, 3, 4, 5, 0 } }));
    } },
  { "mixed cells", 2, [](PassScene& scene) { scene.add(makeMixed()); } },
  // With cell colours VTK does not count skipped triangles, which shifts the strips' numbers.
  { "counted exactly", 2,
    [](PassScene& scene)
    {
      const auto data = makeMixed();
      addCellScalars(data);
      scene.add(data);
    } },
  { "with edges and vertices", 2,
    [](PassScene& scene)
    {
      vtkProperty* const look = scene.add(makeMixed())->GetProperty();
      look->EdgeVisibilityOn();
      look->VertexVisibilityOn();
      look->SetPointSize(1.0);
    },
    isGrown },
  { "flat", 2,
    [](PassScene& scene)
    {
      const auto data = makeMixed();
      data->GetCellData()->SetNormals(filled(data->GetNumberOfCells(), 3));
      scene.add(data)->GetProperty()->SetInterpolationToFlat();
    } },
  { "far away", 2, [](PassScene& scene) { scene.add(makeMixed())->SetPosition(4e6, 4e6, -4e6); } },
  { "polygons that are all skipped", 2,
    [](PassScene& scene)
    {
      const auto data = meshOf({ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 },
                                 { 0.0, 1.0, 0.0 }, { 1.0, 1.0, 0.2 }, { 0.0, 2.0, 0.0 } },
        { { 0, 1, 0, 1, 0 } });
      data->SetStrips(cellsOf({ { 0, 2, 3, 4, 5 } }));
      scene.add(data);
    } },
  { "dropped triangles", 1,
    [](PassScene& scene)
    {
      const auto data = makeBumps(6, 3);
      data->GetPoints()->SetPoint(10, std::nan(""), 0.0, 0.0);
      for (vtkIdType i = 21; i < 35; ++i) // a row of cells becomes a line
      {
        data->GetPoints()->SetPoint(i, (i % 7) / 6.0 + i / 1000.0, 0.5, 0.0);
      }
      scene.add(data);
      scene.renderer->GetCullers()->RemoveAllItems(); // they cull NaN bounds
    } },
  { "clipped", 2,
    [](PassScene& scene)
    {
      vtkActor* const actor = scene.add(makeMixed());
      actor->SetPosition(3.0, -2.0, 1.0);
      actor->RotateZ(10.0);
      addClippingPlane(actor, { 1.0, 0.3, 0.1 });
      addClippingPlane(actor, { -0.2, -1.0, 0.0 });
    } },
  { "of a grid", 1, [](PassScene& scene) { scene.add(dataSetMapperOf(makeGrid())); } },
  { "of mixed data", 2, [](PassScene& scene) { scene.add(dataSetMapperOf(makeMixed())); } },
  { "of parts", 4, [](PassScene& scene) { scene.add(partsMapperOf(makeParts())); } },
  { "of parts, clipped", 4,
    [](PassScene& scene) {
      addClippingPlane(scene.add(partsMapperOf(makeParts())), { 1.0, 0.3, 0.1 });
    } },
  { "of a whole", 1, [](PassScene& scene) { scene.add(partsMapperOf(makeBumps(4, 8))); } },
  // Mirrored matrices swap the sides.
  { "of a mapper that actors share", 6,
    [](PassScene& scene)
    {
      vtkActor* const first = scene.add(makeMixed());
      for (const double side : { 1.0, -1.0 })
      {
        vtkActor* const other = scene.add(first->GetMapper());
        other->SetPosition(1.5 * side, 0.2, 0.0);
        other->SetScale(side, 1.0, 1.0);
        other->RotateZ(40.0);
      }
    } },
};

} // namespace

TEST_F(DrawnSurfaces, areWhereVtkDrawsThem)
{
  for (const DrawnCase& of : drawnCases)
  {
    SCOPED_TRACE(of.name);
    this->scene.renderer->RemoveAllViewProps();
    of.build(this->scene);
    this->lookAtScene();
    this->expectRight(of.surfaces, of.isGrown);
  }
}

TEST_F(DrawnSurfaces, ofBlocksOfSeveralHelpersFollowTheTree)
{
  // Twelve blocks with and without colours, normals and strips, some hidden or translucent.
  vtkNew<vtkMultiBlockDataSet> root;
  vtkNew<vtkMultiBlockDataSet> hidden;
  std::vector<vtkSmartPointer<vtkPolyData>> blocks;
  for (unsigned int i = 0; i < 12; ++i)
  {
    const auto block =
      moved(i % 3 == 0 ? makeMixed() : makeBumps(3 + int(i % 2), i), 1.4 * (i % 4), 1.2 * (i / 4));
    block->GetPointData()->SetScalars(i % 2 == 0 ? filled(block->GetNumberOfPoints()) : nullptr);
    block->GetPointData()->SetNormals(i % 4 >= 2 ? filled(block->GetNumberOfPoints(), 3) : nullptr);
    blocks.push_back(block);
    (i == 5 || i == 6 ? hidden : root)->SetBlock(2 * i, block); // every second block is null
  }
  root->SetBlock(10, hidden);
  root->SetBlock(24, blocks[8]); // which VTK draws once
  vtkNew<SharedBlocksMapper> mapper;
  mapper->SetInputDataObject(root);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  attributes->SetBlockVisibility(hidden, false);
  attributes->SetBlockVisibility(blocks[6], true);
  attributes->SetBlockOpacity(blocks[7], 0.0);
  this->scene.add(mapper);
  this->lookAtScene();
  this->expectRight(14); // four with strips

  // The tree changes under the mapper. With cell colours VTK does not count skipped triangles.
  root->SetBlock(2, nullptr);
  blocks[3]->SetPolys(cellsOf({ { 0, 1, 8, 7 } }));
  for (const auto& block : blocks)
  {
    addCellScalars(block);
    block->GetPointData()->SetScalars(nullptr);
  }
  attributes->SetBlockVisibility(blocks[5], true);
  this->expectRight(-1);
}

/// An actor alone, in two assemblies, and in assemblies of these.
TEST_F(DrawnSurfaces, ofAssembliesTellTheirCopiesApart)
{
  vtkActor* const leaf = this->scene.add(makeBumps(4, 5));
  leaf->RotateZ(20.0);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(leaf);
  inner->AddPart(actorOf(mapperOf(moved(makeBumps(3, 9), 0.0, 1.3))));
  inner->SetPosition(-1.2, 0.0, 0.1);
  inner->RotateX(15.0);
  vtkNew<vtkAssembly> copy;
  copy->AddPart(leaf);
  copy->SetPosition(1.5, 0.3, 0.2);
  copy->SetScale(0.7, 1.2, 2.0);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPart(copy);
  outer->RotateY(10.0);
  vtkNew<vtkPropAssembly> whole;
  whole->AddPart(outer);
  this->scene.renderer->AddViewProp(whole);
  this->lookAtScene();
  this->expectRight(4);
  inner->RotateX(20.0); // turning a part inside is noticed
  this->expectRight(0);
}

/// The snapshot stays the same, but the plain props have other numbers.
TEST_F(DrawnSurfaces, areFoundAfterAHiddenPropBeforeThemHasGone)
{
  vtkActor* const hidden = this->scene.add(makeMixed());
  hidden->VisibilityOff();
  this->scene.add(makeBumps(4, 5));
  this->scene.add(makeBumps(5, 4))->SetPosition(1.5, 0.3, 0.2);
  this->lookAtScene();
  this->expectRight(2);
  this->scene.renderer->RemoveActor(hidden);
  this->expectRight(0);
}

TEST_F(DrawnSurfaces, ofGlyphsAreScaledTurnedMaskedAndClipped)
{
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(makeGlyphPoints());
  mapper->SetSourceData(0, makeBumps(3, 5));
  mapper->SetSourceData(1, makeMixed());
  vtkActor* const actor = this->scene.add(mapper);
  actor->SetPosition(3.0, -2.0, 1.0);
  actor->RotateZ(10.0);
  actor->SetScale(1.0, 1.3, 0.8);
  const auto expectRightBy =
    [&](const char* what, const std::function<void()>& change, bool isGrownByChange = false)
  {
    SCOPED_TRACE(what);
    change();
    this->lookAtScene();
    this->expectRight(-1, isGrownByChange, 400);
  };
  expectRightBy("plain", [] {});
  constexpr int byMagnitude = vtkGlyph3DMapper::SCALE_BY_MAGNITUDE;
  constexpr int byComponents = vtkGlyph3DMapper::SCALE_BY_COMPONENTS;
  const auto placed = [&](const char* scales, int scaleMode, const char* turns, int turnMode)
  {
    return [=, mapper = mapper.Get()]
    {
      mapper->SetScaleArray(scales);
      mapper->SetScaleMode(scaleMode);
      mapper->SetOrientationArray(turns);
      mapper->SetOrientationMode(turnMode);
    };
  };
  mapper->SetScaleFactor(0.9);
  mapper->SetRange(0.3, 1.1);
  expectRightBy("angles", placed("sizes3", byComponents, "angles", vtkGlyph3DMapper::ROTATION));
  expectRightBy(
    "quaternions", placed("sizes3", byMagnitude, "turns", vtkGlyph3DMapper::QUATERNION));
  expectRightBy(
    "directions", placed("sizes", byMagnitude, "directions", vtkGlyph3DMapper::DIRECTION));
  expectRightBy("clamped", [&] { mapper->ClampingOn(); });
  expectRightBy("unscaled", [&] { mapper->ScalingOff(); });
  expectRightBy(
    "with edges", [&] { actor->GetProperty()->EdgeVisibilityOn(); }, isGrown);
  expectRightBy("several sources",
    [&]
    {
      actor->GetProperty()->EdgeVisibilityOff();
      mapper->SourceIndexingOn();
      mapper->SetSourceIndexArray("sources");
    });
  expectRightBy("masked",
    [&]
    {
      mapper->MaskingOn();
      mapper->SetMaskArray("mask");
    });
  expectRightBy("clipped", [&] { addClippingPlane(actor, { 1.0, 0.3, 0.1 }); });
  mapper->RemoveAllClippingPlanes();
  expectRightBy("on blocks",
    [&]
    {
      std::vector<vtkSmartPointer<vtkPolyData>> points;
      for (unsigned int i = 0; i < 3; ++i)
      {
        points.push_back(moved(makeGlyphPoints(), 0.0, 6.0 * i));
      }
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      attributes->SetBlockVisibility(points[1], false);
      mapper->SetBlockAttributes(attributes);
      mapper->SetInputDataObject(blocksOf({ points[0], points[1], points[2] }));
    });
  expectRightBy("a tree of sources",
    [&]
    {
      const auto leaves = blocksOf({ makeBumps(2, 3), moved(makeBumps(2, 4), 0.0, 1.1) });
      mapper->UseSourceTableTreeOn();
      mapper->SetSourceTableTree(blocksOf({ makeBumps(3, 5), leaves }));
    });
}

} // namespace gnomon::test
