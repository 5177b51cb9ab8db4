// Draw scenes with VTK, and check each pixel: drawnSurfaces() must lead to the snapshot's triangle
// that the pixel's ray hits.

#include "plugin/frame/ShaderManager.h"
#include "plugin/frame/TriangleNumbers.h"
#include "plugin/scene/OccluderCollector.h"

#include "TestData.h"
#include "truth/SyntheticScene.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtk_versions/SharedBlocksMapper.h"

#include "vtkAssembly.h"
#include "vtkBitArray.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCullerCollection.h"
#include "vtkDataSetMapper.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPropAssembly.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using namespace gnomon;
using namespace gnomon::test;

namespace
{

/// Draws the scene with numbers as colours: primitive numbers, or drawn surfaces and sides.
class NumberPass : public vtkOpenGLRenderPass
{
public:
  static NumberPass* New();
  vtkTypeMacro(NumberPass, vtkOpenGLRenderPass);

  OccluderCollector collector;
  bool drawPrimitives = false;

  void Render(const vtkRenderState* s) override
  {
    vtkRenderer* renderer = s->GetRenderer();
    this->collector.collect(renderer);
    this->PreRender(s);
    this->UpdateCamera(renderer);
    this->UpdateLightGeometry(renderer);
    this->UpdateLights(renderer);
    this->UpdateGeometry(renderer, s->GetFrameBuffer());
    this->PostRender(s);
  }

  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper*, vtkProp*) override
  {
    if (vertexShader.find("gnomonMain") != std::string::npos)
    {
      return true; // VTK lets an assembly share its keys with its parts, each of which has the pass
    }
    const std::string drawn = handOnDrawn(vertexShader, geometryShader);
    vtkShaderProgram::Substitute(fragmentShader, "//VTK::Color::Dec",
      drawn + "uniform int drawPrimitives;\n//VTK::Color::Dec");
    vtkShaderProgram::Substitute(fragmentShader, "//VTK::DepthPeeling::Impl",
      "int number = drawPrimitives != 0 ? gl_PrimitiveID + PrimitiveIDOffset +\n"
      "  gnomonDrawnVSOutput.y : gnomonDrawnVSOutput.x * 2 + (gl_FrontFacing ? 1 : 0);\n"
      "gl_FragData[0] = vec4(float(number & 255), float((number >> 8) & 255),\n"
      "  float((number >> 16) & 255), 255.0) / 255.0;\n"
      "//VTK::DepthPeeling::Impl");
    return true;
  }

  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject*) override
  {
    program->SetUniformi("drawPrimitives", this->drawPrimitives ? 1 : 0);
    const HookedSurface drawn = this->collector.drawn(mapper, prop);
    program->SetUniformi("gnomonDrawn", drawn.index + 2);
    program->SetUniformi(
      "gnomonPrimitivesPerInstance", static_cast<int>(drawn.primitivesPerInstance));
    return true;
  }
};
vtkStandardNewMacro(NumberPass);

class DrawnSurfaces : public testing::Test
{
protected:
  static constexpr int width = 200;
  static constexpr int height = 150;

  DrawnSurfaces()
  {
    this->window->SetSize(width, height);
    this->window->AddRenderer(this->renderer);
    this->renderer->SetPass(this->pass);
    this->renderer->SetBackground(0, 0, 0);
  }

  const OccluderCollector& collector() const { return this->pass->collector; }

  vtkActor* add(vtkPolyData* data)
  {
    const auto actor = makeActor(data);
    this->renderer->AddActor(actor);
    return actor;
  }

  /// Turn the camera to the whole snapshot, a little from the side.
  void lookAtScene()
  {
    this->pass->collector.collect(this->renderer);
    const Occluders& occluders = this->collector().occluders();
    const glm::dvec3 lower = occluders.allCentred.lower + occluders.frame.centre;
    const glm::dvec3 upper = occluders.allCentred.upper + occluders.frame.centre;
    double bounds[6] = { lower.x, upper.x, lower.y, upper.y, lower.z, upper.z };
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(0.2, 0.3, 1.0);
    camera->SetFocalPoint(0, 0, 0);
    this->renderer->ResetCamera(bounds);
    camera->Zoom(1.3);
    this->renderer->ResetCameraClippingRange(bounds);
  }

  std::vector<std::uint32_t> drawNumbers(bool primitives)
  {
    this->pass->drawPrimitives = primitives;
    this->window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels);
    std::vector<std::uint32_t> numbers(width * height);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const unsigned char* p = pixels->GetPointer(static_cast<vtkIdType>(4 * i));
      numbers[i] = static_cast<std::uint32_t>(p[0] | (p[1] << 8) | (p[2] << 16));
    }
    return numbers;
  }

  std::array<glm::dvec3, 3> cornersWorld(std::uint32_t triangle) const
  {
    const Occluders& occluders = this->collector().occluders();
    std::array<glm::dvec3, 3> corners;
    for (int i = 0; i < 3; ++i)
    {
      corners[static_cast<std::size_t>(i)] =
        glm::dvec3(occluders.positionsCentred.at(occluders.triangles.at(triangle)[i])) +
        occluders.frame.centre;
    }
    return corners;
  }

  struct Count
  {
    int covered = 0; ///< pixels that found a triangle
    int lost = 0;    ///< pixels of a surface in the snapshot, without a triangle
    int outside = 0; ///< pixels whose ray misses the triangle
    int wrong = 0;   ///< pixels whose triangle's plane is not the nearest surface along the ray
    int sides = 0;   ///< pixels that report the triangle's other side
    int missed = 0;  ///< background pixels where the snapshot has a triangle
    int notHeld = 0; ///< pixels of surfaces, lines and points outside the snapshot
    std::vector<int> pixelsOfSurface;
  };

  /// Draw twice and look up every pixel.
  ///
  /// @param tolerance how far outside its triangle a pixel may be, in barycentric units. VTK
  /// transforms in float, so a pixel at an edge may show the neighbour.
  Count check(double tolerance = 1e-3)
  {
    this->lookAtScene();
    const std::vector<std::uint32_t> drawn = this->drawNumbers(false);
    const std::vector<std::uint32_t> primitives = this->drawNumbers(true);
    const Occluders& occluders = this->collector().occluders();

    vtkNew<vtkMatrix4x4> worldFromNdc;
    worldFromNdc->DeepCopy(this->renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      this->renderer->GetTiledAspectRatio(), -1, 1));
    worldFromNdc->Invert();
    const auto unproject = [&worldFromNdc](double x, double y, double z)
    {
      const double ndc[4] = { x, y, z, 1.0 };
      double world[4];
      worldFromNdc->MultiplyPoint(ndc, world);
      return glm::dvec3(world[0], world[1], world[2]) / world[3];
    };

    Count count;
    count.pixelsOfSurface.resize(occluders.surfaces.size());
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        const std::size_t pixel = static_cast<std::size_t>(y * width + x);
        const double ndcX = 2.0 * (x + 0.5) / width - 1.0;
        const double ndcY = 2.0 * (y + 0.5) / height - 1.0;
        const glm::dvec3 origin = unproject(ndcX, ndcY, -1.0);
        const glm::dvec3 direction = unproject(ndcX, ndcY, 1.0) - origin;

        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
        {
          const auto hit = meet({ 0, i, this->cornersWorld(i) }, origin, direction);
          if (hit && hit->isInside() && hit->at > 0.0)
          {
            nearest = std::min(nearest, hit->at);
          }
        }

        const int surfaceDrawn = static_cast<int>(drawn[pixel] / 2) - 2;
        if (drawn[pixel] == 0)
        {
          count.missed += std::isfinite(nearest) ? 1 : 0;
          continue;
        }
        if (surfaceDrawn < 0)
        {
          ++count.notHeld;
          continue;
        }
        const std::uint32_t triangle =
          this->find(static_cast<std::size_t>(surfaceDrawn), primitives[pixel]);
        if (triangle == Surface::noTriangle)
        {
          ++count.lost;
          continue;
        }
        ++count.covered;
        ++count.pixelsOfSurface[this->surfaceOf(triangle)];
        const std::array<glm::dvec3, 3> corners = this->cornersWorld(triangle);
        const LineHit hit = meet({ 0, triangle, corners }, origin, direction)
                              .value_or(LineHit{ nearest, 0.0, glm::dvec3(-1.0) });
        count.outside += -hit.leastWeight() > tolerance ? 1 : 0;
        count.wrong += std::isfinite(nearest) && std::abs(hit.at - nearest) > tolerance ? 1 : 0;
        count.sides += (hit.cosine < 0.0) != ((drawn[pixel] & 1u) != 0) ? 1 : 0;
      }
    }
    return count;
  }

  /// Expect every pixel to be right, except a few on edges. VTK transforms in float and the
  /// rasteriser snaps vertices to 1/256 pixel, so an edge may be off by half of that. Silhouettes
  /// here are some 500 pixels long, and 500/512 of their pixels have a centre so near.
  void expectRight(const Count& count, int leastCovered = 2000)
  {
    EXPECT_GE(count.covered, leastCovered);
    EXPECT_EQ(count.lost, 0);
    EXPECT_LE(count.outside, 2);
    EXPECT_LE(count.wrong, 2);
    EXPECT_LE(count.sides, 2);
    EXPECT_LE(count.missed, 2);
    for (std::size_t i = 0; i < count.pixelsOfSurface.size(); ++i)
    {
      if (this->collector().occluders().surfaces[i].triangleCount > 0)
      {
        EXPECT_GT(count.pixelsOfSurface[i], 0) << "surface " << i << " was not seen";
      }
    }
  }

  vtkSmartPointer<vtkOpenGLRenderWindow> window = makeOffScreenWindow();
  vtkNew<vtkRenderer> renderer;
  vtkNew<NumberPass> pass;

private:
  /// Return the snapshot's triangle for a drawn primitive, found as `Receivers` does.
  std::uint32_t find(std::size_t drawnSurface, std::uint32_t primitive) const
  {
    for (const DrawnSurface::Block& block :
      this->collector().drawnSurfaces().at(drawnSurface).blocks)
    {
      if (primitive >= block.firstPrimitive &&
        primitive - block.firstPrimitive < block.primitiveCount)
      {
        const Surface& surface = this->collector().occluders().surfaces.at(block.surface);
        const std::uint32_t number = primitive - block.firstPrimitive;
        const std::uint32_t triangle =
          surface.triangleOfDrawn.empty() ? number : surface.triangleOfDrawn.at(number);
        return triangle == Surface::noTriangle ? triangle : surface.firstTriangle + triangle;
      }
    }
    return Surface::noTriangle;
  }

  std::size_t surfaceOf(std::uint32_t triangle) const
  {
    const std::vector<Surface>& surfaces = this->collector().occluders().surfaces;
    std::size_t i = 0;
    while (triangle >= surfaces[i].firstTriangle + surfaces[i].triangleCount)
    {
      ++i;
    }
    return i;
  }
};

/// Return a bumpy grid of n x n quads over the unit square.
vtkSmartPointer<vtkPolyData> makeBumps(int n, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> heightOf(0.0, 0.15);
  std::vector<glm::dvec3> points;
  Cells quads;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      points.emplace_back(double(i) / n, double(j) / n, heightOf(random));
      if (i < n && j < n)
      {
        const vtkIdType corner = j * (n + 1) + i;
        // The first corner varies, so the diagonals vary.
        const std::array<vtkIdType, 4> loop = { corner, corner + 1, corner + n + 2,
          corner + n + 1 };
        const std::size_t first = random() % 4;
        quads.push_back(
          { loop[first], loop[(first + 1) % 4], loop[(first + 2) % 4], loop[(first + 3) % 4] });
      }
    }
  }
  return meshOf(points, quads);
}

/// Return polygons, then strips, lines and vertices. VTK skips parts of many polygons because their
/// vertices coincide.
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
  data->SetStrips(makeCells({ { first, first + 1, first + 2, first + 3, first + 4 },
    { first + 4, first + 5, first + 6, first + 7 } }));
  data->SetLines(makeCells({ { 0, 8, 16, 24 }, { 3, 30 } }));
  data->SetVerts(makeCells({ { 1 }, { 2, 5, 9 } }));
  return data;
}

/// Return six points around the unit circle, with an array for every setting of a glyph mapper.
vtkSmartPointer<vtkPolyData> makeGlyphPoints()
{
  const auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(vtkNew<vtkPoints>());
  const auto addArray = [&](vtkDataArray* array, const char* name, int components)
  {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(6);
    points->GetPointData()->AddArray(array);
    return array;
  };
  vtkDataArray* sizes = addArray(vtkNew<vtkFloatArray>(), "sizes", 1);
  vtkDataArray* sizes3 = addArray(vtkNew<vtkFloatArray>(), "sizes3", 3);
  vtkDataArray* directions = addArray(vtkNew<vtkFloatArray>(), "directions", 3);
  vtkDataArray* angles = addArray(vtkNew<vtkFloatArray>(), "angles", 3);
  vtkDataArray* turns = addArray(vtkNew<vtkFloatArray>(), "turns", 4);
  vtkDataArray* sources = addArray(vtkNew<vtkFloatArray>(), "sources", 1);
  vtkDataArray* mask = addArray(vtkNew<vtkBitArray>(), "mask", 1);
  for (int i = 0; i < 6; ++i)
  {
    const double angle = i * 1.0472;
    points->GetPoints()->InsertNextPoint(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.1 * i);
    sizes->SetTuple1(i, 0.5 + 0.15 * i);
    sizes3->SetTuple3(i, 0.6 + 0.1 * i, 1.2 - 0.1 * i, 1.0 + 0.2 * (i % 2));
    // The first two are special cases: along -x, and no direction.
    directions->SetTuple3(
      i, i == 0 ? -2.0 : 0.3 * i - 0.3, i < 2 ? 0.0 : 1.0 - 0.3 * i, i < 2 ? 0.0 : 0.4);
    angles->SetTuple3(i, 20.0 * i, -15.0 * i, 35.0 * i);
    turns->SetTuple4(i, 0.8, 0.1 * i, -0.2, 0.15 * i);
    sources->SetTuple1(i, i - 1.0); // -1 counts as 1, 4 is beyond the last
    mask->SetTuple1(i, i == 2 ? 0 : 1);
  }
  return points;
}

/// A glyph mapper with two sources, bumps and mixed cells, under an actor with a transform.
struct Glyphs
{
  Glyphs()
  {
    this->mapper->SetInputData(this->points);
    this->mapper->SetSourceData(0, makeBumps(3, 5));
    this->mapper->SetSourceData(1, makeMixed());
    this->actor->SetMapper(this->mapper);
    this->actor->SetPosition(3, -2, 1);
    this->actor->RotateZ(10);
    this->actor->SetScale(1.0, 1.3, 0.8);
  }

  vtkSmartPointer<vtkPolyData> points = makeGlyphPoints();
  vtkNew<vtkGlyph3DMapper> mapper;
  vtkNew<vtkActor> actor;
};

void addScalars(vtkDataSetAttributes* attributes, vtkIdType count)
{
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfTuples(count);
  scalars->Fill(0.5);
  attributes->SetScalars(scalars);
}

void addCellScalars(vtkPolyData* data)
{
  addScalars(data->GetCellData(), data->GetNumberOfCells());
}

void addNormals(vtkDataSetAttributes* attributes, vtkIdType count)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    normals->SetTuple3(i, 0, 0, 1);
  }
  attributes->SetNormals(normals);
}

vtkSmartPointer<vtkPolyData> moved(vtkPolyData* data, double x, double y)
{
  movePoints(data, [=](const glm::dvec3& at) { return at + glm::dvec3(x, y, 0.0); });
  return data;
}

} // namespace

TEST_F(DrawnSurfaces, ConcavePolygons)
{
  this->add(
    meshOf({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 0.4, 0 }, { 0, 2, 0 }, { -1, 1, 0 } },
      { { 1, 2, 3, 4, 5, 0 } }));
  this->expectRight(this->check());
}

/// Polygons, strips, lines and points, in all numberings of VTK's mappers.
TEST_F(DrawnSurfaces, MixedCells)
{
  const auto asTheyAre = [](vtkActor* actor, vtkPolyData*)
  { actor->GetProperty()->SetLineWidth(3); };
  // With cell colours VTK does not count skipped triangles, which shifts the strips' numbers.
  const auto countedExactly = [](vtkActor*, vtkPolyData* data) { addCellScalars(data); };
  const auto withEdges = [](vtkActor* actor, vtkPolyData*)
  {
    actor->GetProperty()->EdgeVisibilityOn();
    actor->GetProperty()->VertexVisibilityOn();
  };
  const auto flat = [](vtkActor* actor, vtkPolyData* data)
  {
    addNormals(data->GetCellData(), data->GetNumberOfCells());
    actor->GetProperty()->SetInterpolationToFlat();
  };
  // VTK multiplies the actor's matrix with the camera's in double. There the distance cancels
  // before rounding to float, so precision does not suffer far away.
  const auto farAway = [](vtkActor* actor, vtkPolyData*) { actor->SetPosition(4e6, 4e6, -4e6); };
  struct Case
  {
    const char* name;
    void (*change)(vtkActor*, vtkPolyData*);
    double tolerance = 1e-3;
  };
  for (const auto& [name, change, tolerance] :
    { Case{ "as they are", asTheyAre }, { "counted exactly", countedExactly },
      // To draw edges, VTK grows every triangle by half a line's width on the screen.
      { "with edges and vertices", withEdges, 0.3 }, { "flat", flat }, { "far", farAway } })
  {
    SCOPED_TRACE(name);
    const auto data = makeMixed();
    vtkActor* const actor = this->add(data);
    actor->GetProperty()->SetPointSize(4);
    change(actor, data);
    const Count count = this->check(tolerance);
    EXPECT_EQ(this->collector().occluders().surfaces.size(), 2u);
    this->expectRight(count);
    EXPECT_GT(count.notHeld, 0); // lines and points
    this->renderer->RemoveActor(actor);
  }
}

TEST_F(DrawnSurfaces, StripsBehindPolygonsThatAreAllSkipped)
{
  const auto data =
    meshOf({ { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0.2 }, { 0, 2, 0 } },
      { { 0, 1, 0, 1, 0 } });
  data->SetStrips(makeCells({ { 0, 2, 3, 4, 5 } }));
  this->add(data);
  const Count count = this->check();
  EXPECT_EQ(count.lost + count.outside + count.wrong, 0);
  EXPECT_GT(count.covered, 2000);
}

TEST_F(DrawnSurfaces, DroppedTriangles)
{
  const auto data = makeBumps(6, 3);
  vtkPoints* points = data->GetPoints();
  points->SetPoint(10, std::nan(""), 0, 0);
  for (vtkIdType i = 21; i < 35; ++i)
  {
    points->SetPoint(i, (i % 7) / 6.0 + i / 1000.0, 0.5, 0.0); // a row of cells becomes a line
  }
  this->add(data);
  this->renderer->GetCullers()->RemoveAllItems(); // they cull NaN bounds
  const Count count = this->check();
  EXPECT_GT(this->collector().occluders().droppedZeroArea, 0u);
  EXPECT_GT(this->collector().occluders().droppedNonFinite, 0u);
  EXPECT_FALSE(this->collector().occluders().surfaces[0].triangleOfDrawn.empty());
  // Dropped triangles are drawn nowhere, and the numbers after them are right.
  this->expectRight(count);
}

TEST_F(DrawnSurfaces, ClippingPlanes)
{
  vtkActor* const actor = this->add(makeMixed());
  actor->SetPosition(3, -2, 1);
  actor->RotateZ(10);
  for (const glm::dvec3& normal : { glm::dvec3(1, 0.3, 0.1), glm::dvec3(-0.2, -1, 0) })
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(3.5, -1.5, 1);
    plane->SetNormal(normal.x, normal.y, normal.z);
    actor->GetMapper()->AddClippingPlane(plane);
  }
  const Count count = this->check();
  EXPECT_GT(count.covered, 2000);
  // A cut triangle leads to its first piece: the ray meets the right plane, but maybe another
  // piece.
  EXPECT_LE(count.lost + count.wrong + count.sides, 2);
  EXPECT_LE(count.missed, 2);
}

TEST_F(DrawnSurfaces, BlocksOfSeveralHelpers)
{
  // Twelve blocks with and without colours, normals and strips, some hidden or translucent.
  vtkNew<vtkMultiBlockDataSet> root;
  vtkNew<vtkMultiBlockDataSet> hidden;
  std::vector<vtkSmartPointer<vtkPolyData>> blocks;
  for (unsigned int i = 0; i < 12; ++i)
  {
    const auto block =
      moved(i % 3 == 0 ? makeMixed() : makeBumps(3 + int(i % 2), i), 1.4 * (i % 4), 1.2 * (i / 4));
    if (i % 2 == 0)
    {
      addScalars(block->GetPointData(), block->GetNumberOfPoints());
    }
    if (i % 4 >= 2)
    {
      addNormals(block->GetPointData(), block->GetNumberOfPoints());
    }
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
  attributes->SetBlockOpacity(blocks[7], 0.5);
  this->renderer->AddActor(actorOf(mapper));

  const Count count = this->check();
  EXPECT_EQ(this->collector().occluders().surfaces.size(), 14u); // four with strips
  this->expectRight(count);
  EXPECT_GE(this->collector().drawnSurfaces().size(), 6u); // four helpers, two of them with strips

  // The tree changes under the mapper. With cell colours VTK does not count skipped triangles.
  root->SetBlock(2, nullptr);
  blocks[3]->SetPolys(makeCells({ { 0, 1, 8, 7 } }));
  for (const auto& block : blocks)
  {
    addCellScalars(block);
    block->GetPointData()->SetScalars(nullptr);
  }
  attributes->SetBlockVisibility(blocks[5], true);
  this->expectRight(this->check());
}

/// VTK names a mapper inside the actor's, which may not exist before it draws.
TEST_F(DrawnSurfaces, OfMappersInsideOthers)
{
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(4, 3, 5);
  grid->SetSpacing(0.3, 0.4, 0.2);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 3; ++i)
  {
    blocks->SetBlock(2 * i, moved(i == 0 ? makeMixed() : makeBumps(3, i), 1.4 * i, 0.0));
  }
  blocks->SetBlock(5, blocks->GetBlock(4)); // drawn twice
  const auto glass = moved(makeBumps(4, 5), 0.0, 1.2);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  colours->SetNumberOfTuples(glass->GetNumberOfPoints());
  colours->Fill(100);
  glass->GetPointData()->SetScalars(colours);
  blocks->SetBlock(7, glass);
  const auto ofDataSet = [](vtkDataSet* data)
  {
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputData(data);
    return vtkSmartPointer<vtkMapper>(mapper);
  };
  vtkNew<vtkCompositePolyDataMapper> parts;
  parts->SetInputDataObject(blocks);
  vtkNew<vtkCompositePolyDataMapper> whole;
  whole->SetInputDataObject(makeBumps(4, 8));

  struct Case
  {
    vtkSmartPointer<vtkMapper> mapper;
    std::size_t surfaces;
  };
  const Case cases[] = { { ofDataSet(grid), 1 }, { ofDataSet(makeMixed()), 2 }, { parts.Get(), 4 },
    { whole.Get(), 1 } };
  for (const auto& [mapper, surfaces] : cases)
  {
    SCOPED_TRACE(mapper->GetInputDataObject(0, 0)->GetClassName());
    const auto actor = actorOf(mapper);
    actor->SetPosition(3, -2, 1);
    actor->RotateZ(10);
    this->renderer->AddActor(actor);
    this->expectRight(this->check());
    EXPECT_EQ(this->collector().occluders().surfaces.size(), surfaces);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(actor->GetCenter());
    plane->SetNormal(1, 0.3, 0.1);
    mapper->AddClippingPlane(plane);
    const Count clipped = this->check();
    EXPECT_LE(clipped.lost + clipped.wrong + clipped.missed, 4);
    this->renderer->RemoveActor(actor);
  }
}

TEST_F(DrawnSurfaces, AssembliesTellTheirCopiesApart)
{
  const auto leaf = makeActor(makeBumps(4, 5));
  leaf->RotateZ(20);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(leaf);
  inner->AddPart(makeActor(moved(makeBumps(3, 9), 0, 1.3)));
  inner->RotateX(15);
  vtkNew<vtkAssembly> copy;
  copy->AddPart(leaf);
  copy->SetPosition(1.5, 0.3, 0.2);
  copy->SetScale(0.7, 1.2, 2.0);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPart(copy);
  outer->RotateY(10);
  vtkNew<vtkPropAssembly> whole;
  whole->AddPart(outer);
  this->renderer->AddViewProp(whole);
  for (int frame = 0; frame < 2; ++frame)
  {
    const Count count = this->check();
    ASSERT_EQ(this->collector().occluders().surfaces.size(), 3u);
    EXPECT_EQ(this->collector().drawnSurfaces().size(), 3u);
    this->expectRight(count);
    inner->RotateX(20); // turning a part inside is noticed
  }
}

/// The collector remembers how the actor was drawn alone. The assembly draws it elsewhere.
TEST_F(DrawnSurfaces, APlainActorMayHangInAnAssemblyToo)
{
  vtkActor* const plain = this->add(makeBumps(4, 5));
  vtkNew<vtkAssembly> copy;
  copy->AddPart(plain);
  copy->SetPosition(1.5, 0.3, 0.2);
  this->renderer->AddViewProp(copy);
  for (int frame = 0; frame < 2; ++frame)
  {
    const Count count = this->check();
    EXPECT_EQ(this->collector().drawnSurfaces().size(), 2u);
    this->expectRight(count);
  }
}

/// The snapshot stays the same, but the plain props have other numbers.
TEST_F(DrawnSurfaces, AHiddenPropMayComeAndGoBeforePlainOnes)
{
  const auto hidden = makeActor(makeMixed());
  hidden->VisibilityOff();
  this->renderer->AddActor(hidden);
  this->add(makeBumps(4, 5));
  this->add(makeBumps(5, 4))->SetPosition(1.5, 0.3, 0.2);
  this->expectRight(this->check());
  this->renderer->RemoveActor(hidden);
  const Count count = this->check();
  EXPECT_EQ(this->collector().drawnSurfaces().size(), 2u);
  this->expectRight(count);
}

/// Mirrored matrices swap the sides, as in OpenGL.
TEST_F(DrawnSurfaces, ASharedMapperServesActorsWithMatricesOfTheirOwn)
{
  vtkActor* const first = this->add(makeMixed());
  for (const double side : { 1.0, -1.0 })
  {
    const auto other = actorOf(first->GetMapper());
    other->SetPosition(1.5 * side, 0.2, 0);
    other->SetScale(side, 1, 1);
    other->RotateZ(40);
    this->renderer->AddActor(other);
  }
  this->expectRight(this->check());
}

TEST_F(DrawnSurfaces, GlyphsScaledAndTurned)
{
  const Glyphs glyphs;
  this->renderer->AddActor(glyphs.actor);
  this->expectRight(this->check());
  EXPECT_EQ(this->collector().occluders().triangles.size(), 6u * 18u);
  constexpr int byMagnitude = vtkGlyph3DMapper::SCALE_BY_MAGNITUDE;
  constexpr int byComponents = vtkGlyph3DMapper::SCALE_BY_COMPONENTS;
  constexpr int towards = vtkGlyph3DMapper::DIRECTION;
  constexpr int byAngles = vtkGlyph3DMapper::ROTATION;
  constexpr int byQuaternion = vtkGlyph3DMapper::QUATERNION;
  struct Setting
  {
    const char* scales;
    int scaleMode;
    const char* orientations;
    int orientationMode;
    bool clamped = false;
    bool scaled = true;
  };
  glyphs.mapper->SetScaleFactor(0.9);
  glyphs.mapper->SetRange(0.3, 1.1);
  for (const Setting& setting : { Setting{ "sizes", byMagnitude, "directions", towards },
         { "sizes3", byComponents, "angles", byAngles },
         { "sizes3", byMagnitude, "turns", byQuaternion },
         { "sizes", byMagnitude, "directions", towards, true },
         { "sizes", byMagnitude, "turns", byQuaternion, false, false } })
  {
    SCOPED_TRACE(std::string(setting.scales) + " " + setting.orientations);
    glyphs.mapper->SetClamping(setting.clamped);
    glyphs.mapper->SetScaling(setting.scaled);
    glyphs.mapper->SetScaleArray(setting.scales);
    glyphs.mapper->SetScaleMode(setting.scaleMode);
    glyphs.mapper->SetOrientationArray(setting.orientations);
    glyphs.mapper->SetOrientationMode(setting.orientationMode);
    this->expectRight(this->check(), 1000);
  }
}

TEST_F(DrawnSurfaces, GlyphsOfSeveralSourcesAndMasked)
{
  const Glyphs glyphs;
  glyphs.mapper->SourceIndexingOn();
  glyphs.mapper->SetSourceIndexArray("sources");
  glyphs.mapper->MaskingOn();
  glyphs.mapper->SetMaskArray("mask");
  this->renderer->AddActor(glyphs.actor);
  this->expectRight(this->check());
  ASSERT_EQ(this->collector().occluders().surfaces.size(), 3u); // bumps; polygons and strips
  EXPECT_EQ(this->collector().occluders().surfaces[0].triangleCount, 1u * 18u);
  EXPECT_EQ(this->collector().drawnSurfaces().size(), 3u);
}

TEST_F(DrawnSurfaces, GlyphsOfATreeOfSources)
{
  const Glyphs glyphs;
  vtkNew<vtkMultiBlockDataSet> leaves;
  leaves->SetBlock(0, makeBumps(2, 3));
  leaves->SetBlock(1, moved(makeBumps(2, 4), 0.0, 1.1));
  vtkNew<vtkMultiBlockDataSet> table;
  table->SetBlock(0, makeBumps(3, 5));
  table->SetBlock(1, leaves);
  glyphs.mapper->UseSourceTableTreeOn();
  glyphs.mapper->SetSourceTableTree(table);
  glyphs.mapper->SourceIndexingOn();
  glyphs.mapper->SetSourceIndexArray("sources");
  this->renderer->AddActor(glyphs.actor);
  this->expectRight(this->check());
  EXPECT_EQ(this->collector().drawnSurfaces().size(), 3u);
}

TEST_F(DrawnSurfaces, GlyphsOnTheBlocksOfATree)
{
  const Glyphs glyphs;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 3; ++i)
  {
    blocks->SetBlock(i, moved(makeGlyphPoints(), 0.0, 6.0 * i));
  }
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  attributes->SetBlockVisibility(blocks->GetBlock(1), false);
  glyphs.mapper->SetBlockAttributes(attributes);
  glyphs.mapper->SetInputDataObject(blocks);
  this->renderer->AddActor(glyphs.actor);
  this->expectRight(this->check(), 500);
  EXPECT_EQ(this->collector().occluders().surfaces.size(), 2u * 3u);
}

TEST_F(DrawnSurfaces, GlyphsAsWireframeAreNotHeldEvenOverTheirSurface)
{
  const Glyphs glyphs;
  this->renderer->AddActor(glyphs.actor);
  vtkNew<vtkActor> wireframe;
  wireframe->ShallowCopy(glyphs.actor);
  vtkNew<vtkProperty> lines;
  lines->SetRepresentationToWireframe();
  lines->SetLineWidth(3);
  wireframe->SetProperty(lines);
  this->renderer->AddActor(wireframe);
  const Count count = this->check();
  EXPECT_GT(count.covered, 500);
  EXPECT_EQ(count.lost, 0);
  EXPECT_GT(count.notHeld, 500);
}

TEST_F(DrawnSurfaces, GlyphsClippedAndWithEdges)
{
  const Glyphs glyphs;
  glyphs.actor->GetProperty()->EdgeVisibilityOn();
  this->renderer->AddActor(glyphs.actor);
  this->expectRight(this->check(0.5)); // grown triangles, as in EdgesAndVerticesDrawnToo

  vtkNew<vtkPlane> plane;
  plane->SetOrigin(3.5, -1.5, 1);
  plane->SetNormal(1, 0.3, 0.1);
  glyphs.mapper->AddClippingPlane(plane);
  glyphs.actor->GetProperty()->EdgeVisibilityOff();
  const Count count = this->check();
  EXPECT_GT(count.covered, 1000);
  EXPECT_LE(count.lost + count.wrong + count.sides, 2);
  EXPECT_LE(count.missed, 2);
}
