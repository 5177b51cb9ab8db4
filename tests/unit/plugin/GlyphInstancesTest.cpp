// Glyphs stored as instances in the snapshot show the same as their triangles.

#include "PassScene.h"

#include "shadowtech/Registry.h"

#include <vtkBitArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkMatrix4x4.h>

using namespace gnomon::test;

namespace
{

constexpr int glyphCount = 3400;

/// Glyphs in a slab over a floor, with an array for every setting of the mapper, under a sun.
struct GlyphInstances : PassTestOf<Way>
{
  GlyphInstances()
  {
    this->scene.addFloor(8.0);
    this->scene.addSun({ 1.0, 0.4, -1.2 });
    this->scene.choose(GetParam());
    this->scene.lookFrom({ 9.0, -13.0, 14.0 });

    this->points->SetPoints(vtkNew<vtkPoints>());
    vtkDataArray* sizes = this->addArray(vtkNew<vtkFloatArray>(), "sizes", 3);
    vtkDataArray* turns = this->addArray(vtkNew<vtkFloatArray>(), "turns", 4);
    vtkDataArray* mask = this->addArray(vtkNew<vtkBitArray>(), "mask", 1);
    vtkDataArray* sources = this->addArray(vtkNew<vtkFloatArray>(), "sources", 1);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < glyphCount; ++i)
    {
      const double x = 6.0 * uniform(random);
      const double y = 6.0 * uniform(random);
      this->points->GetPoints()->InsertNextPoint(x, y, 1.5 + uniform(random));
      sizes->SetTuple3(i, 0.3 + 0.2 * uniform(random), 0.2 + 0.1 * uniform(random), 0.15);
      turns->SetTuple4(i, 0.8, uniform(random), uniform(random), uniform(random));
      mask->SetTuple1(i, i % 9 == 4 ? 0 : 1);
      sources->SetTuple1(i, i % 2);
    }
    // An open source, whose sides differ.
    this->cup->SetThetaResolution(13);
    this->cup->SetPhiResolution(5);
    this->cup->SetEndPhi(110.0);
    this->cup->Update();
    this->mapper->SetInputData(this->points);
    this->mapper->SetSourceConnection(this->cup->GetOutputPort());
    this->mapper->SetScaleArray("sizes");
    this->mapper->SetScaleModeToScaleByVectorComponents();
    this->mapper->SetOrientationArray("turns");
    this->mapper->SetOrientationModeToQuaternion();
    this->actor->SetMapper(this->mapper);
    this->scene.renderer->AddActor(this->actor);
  }

  vtkDataArray* addArray(vtkDataArray* array, const char* name, int components)
  {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(glyphCount);
    this->points->GetPointData()->AddArray(array);
    return array;
  }

  /// Expect the same picture as from expanded glyphs. A clipping plane that cuts nothing expands
  /// them.
  void expectSameAsExpanded(std::size_t instances)
  {
    const Picture kept = this->scene.render();
    EXPECT_EQ(this->scene.report().instances, instances);
    EXPECT_THAT(this->scene.report().notes, testing::Each(testing::HasSubstr("planar shadows")));
    clip(this->mapper, { 0.0, 0.0, -1000.0 }, { 0.0, 0.0, 1.0 });
    const Picture expanded = this->scene.render();
    EXPECT_EQ(this->scene.report().instances, 0u);
    this->mapper->RemoveAllClippingPlanes();
    // Tolerance: rays that meet an edge to within rounding, and texels that an edge crosses so
    // closely. With holes there are several times as many edges.
    EXPECT_LE(differingPixels(kept, expanded, 2),
      kept.pixels() / (this->actor->GetTexture() ? 10000 : 20000));
    this->expectShadows(kept);
  }
  /// Expect some of the picture to be dark, but not all.
  void expectShadows(const Picture& picture)
  {
    const std::size_t dark =
      countPixels(picture, [&](int x, int y) { return picture.red(x, y) == 0; });
    EXPECT_GT(dark, picture.pixels() / 10);
    EXPECT_LT(dark, 9 * picture.pixels() / 10);
  }

  PassScene scene{ 300, 300 };
  vtkNew<vtkPolyData> points;
  vtkNew<vtkSphereSource> cup;
  vtkNew<vtkGlyph3DMapper> mapper;
  vtkNew<vtkActor> actor;
};

INSTANTIATE_TEST_SUITE_P(Ways, GlyphInstances,
  testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
    Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE }, Way{ "pcf", vtkGnomonShadowPass::ROUTE_INLINE },
    Way{ "pcf", vtkGnomonShadowPass::ROUTE_IMAGE }, Way{ "vsm", vtkGnomonShadowPass::ROUTE_INLINE },
    Way{ "planar", vtkGnomonShadowPass::ROUTE_IMAGE },
    Way{ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE }),
  nameOf);

} // namespace

TEST_P(GlyphInstances, showTheSameAsTheirTriangles)
{
  this->expectSameAsExpanded(glyphCount);
  this->mapper->MaskingOn();
  this->mapper->SetMaskArray("mask");
  this->expectSameAsExpanded(glyphCount - (glyphCount + 4) / 9);
}

TEST_P(GlyphInstances, ofSeveralSourcesAreSurfacesOfTheirOwn)
{
  this->cup->SetThetaResolution(24);
  const auto ball = ballOf({ 0.3, 0.0, 100.0 }, 0.5, 16, 8); // far from its origin, in its units
  this->mapper->SetSourceConnection(1, ball->GetOutputPort());
  this->mapper->SourceIndexingOn();
  this->mapper->SetSourceIndexArray("sources");
  vtkNew<vtkMatrix4x4> back; // most of the way
  back->SetElement(2, 3, -10.0);
  this->actor->SetUserMatrix(back);
  this->expectSameAsExpanded(glyphCount);
}

TEST_P(GlyphInstances, mirroredAndOneSided)
{
  vtkGnomonPropKeys::SetOneSided(this->actor, true);
  this->expectSameAsExpanded(glyphCount);
  this->actor->SetScale(1.0, -1.0, 1.0);
  this->expectSameAsExpanded(glyphCount);
  const Picture oneSided = this->scene.render();
  vtkGnomonPropKeys::SetOneSided(this->actor, false);
  EXPECT_GT(differingPixels(oneSided, this->scene.render()), 1000u) << "the sides matter here";
}

TEST_P(GlyphInstances, withHolesAreSeenThrough)
{
  // A third of each row is opaque, shifted in every row, so any shift is noticed.
  const auto texture =
    textureOf(makeVeil(9, 5, [](int x, int y) { return (x + 2 * y) % 3 == 0 ? 255 : 0; }));
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  vtkPolyData* source = this->cup->GetOutput();
  for (vtkIdType i = 0; i < source->GetNumberOfPoints(); ++i)
  {
    const double* point = source->GetPoint(i);
    coordinates->InsertNextTuple2(point[0] + 0.5, point[1] + 0.3 * point[2]);
  }
  const Picture whole = this->scene.render();
  source->GetPointData()->SetTCoords(coordinates);
  source->Modified();
  this->actor->SetTexture(texture);
  this->expectSameAsExpanded(glyphCount);
  const Picture withHoles = this->scene.render();
  EXPECT_GT(differingPixels(whole, withHoles), 5000u) << "light falls through";
  vtkGnomonPropKeys::SetOneSided(this->actor, true);
  this->expectSameAsExpanded(glyphCount);

  // Only the texture's mask or the placement changes.
  vtkGnomonPropKeys::SetOneSided(this->actor, false);
  this->scene.render();
  this->actor->SetPosition(0.5, 0.0, 0.2);
  this->scene.render();
  EXPECT_EQ(this->scene.report().surfacesRetransformed, 1);
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0);
  this->expectSameAsExpanded(glyphCount);
  this->scene.render();
  texture->RepeatOff();
  this->scene.render();
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0);
  this->expectSameAsExpanded(glyphCount);
}

TEST_P(GlyphInstances, areOnMapsOfOtherSurfaces)
{
  if (!gnomon::has(gnomon::findTechnique(GetParam().technique)->estimator->info, "depth"))
  {
    return;
  }
  for (const char* depth : { "second", "midpoint" })
  {
    this->scene.pass->SetSetting("depth", depth);
    this->expectSameAsExpanded(glyphCount);
  }
}

TEST_P(GlyphInstances, takeTheMemoryOfOneAndTheirMatrices)
{
  this->scene.render();
  const gnomon::FrameReport& report = this->scene.report();
  const auto ofSource = static_cast<std::size_t>(this->cup->GetOutput()->GetNumberOfPolys());
  ASSERT_EQ(report.triangles, ofSource * glyphCount + 2);
  EXPECT_LT(report.bytesOccluders, 120u * ofSource + 200u * glyphCount + 1500u * 2u);
  EXPECT_GT(report.bytesOccluders, 112u * glyphCount) << "the matrices alone take that";
  if (std::string(GetParam().technique) == "raytraced")
  {
    EXPECT_LT(report.bytesBvh, 600u * glyphCount);
  }
}

TEST_P(GlyphInstances, thatWouldLosePrecisionAreExpanded)
{
  vtkNew<vtkMatrix4x4> matrix;
  this->actor->SetUserMatrix(matrix);
  matrix->SetElement(0, 2, 0.3); // slightly sheared
  this->expectSameAsExpanded(glyphCount);
  matrix->SetElement(0, 2, 8.0);
  matrix->Modified();
  this->scene.render();
  EXPECT_EQ(this->scene.report().instances, 0u);
  matrix->SetElement(0, 2, 0.0);
  matrix->Modified();
  this->points->GetPointData()->GetArray("sizes")->SetComponent(7, 1, -0.2); // one is mirrored
  this->points->GetPointData()->GetArray("sizes")->Modified();
  this->points->Modified();
  this->scene.render();
  EXPECT_EQ(this->scene.report().instances, 0u);
}

TEST_P(GlyphInstances, changesCostWhatChanged)
{
  const bool traced = std::string(GetParam().technique) == "raytraced";
  const bool drawsMaps = gnomon::findTechnique(GetParam().technique)->estimator->info.bakesMap();
  std::vector<vtkActor*> boxes;
  for (int i = 0; i < 10; ++i)
  {
    boxes.push_back(this->scene.addBox({ i - 5.0, -7.5, 0.0 }, { i - 4.5, -7.0, 3.0 }));
  }
  const auto expectUpdate = [&](int extracted, int retransformed, int builds, int refits)
  {
    this->scene.render();
    const gnomon::FrameReport report = this->scene.report();
    EXPECT_EQ(report.surfacesExtracted, extracted);
    EXPECT_EQ(report.surfacesRetransformed, retransformed);
    EXPECT_EQ(report.bvhBuilds, traced ? builds : 0);
    EXPECT_EQ(report.bvhRefits, traced ? refits : 0);
    EXPECT_EQ(report.mapBakes, drawsMaps && extracted + retransformed > 0 ? 1 : 0);
    EXPECT_EQ(report.instances, glyphCount);
  };
  this->scene.render(); // in which VTK touches the mapper
  const Picture before = this->scene.render();
  expectUpdate(0, 0, 0, 0);
  this->actor->SetPosition(0.5, 0.0, 0.2);
  expectUpdate(0, 1, 0, 1);
  EXPECT_GT(differingPixels(before, this->scene.render()), 1000u);
  boxes[3]->SetPosition(0.1, 0.2, 0.0);
  expectUpdate(0, 1, 0, 1);

  // A point moves: the instances are extracted again.
  this->points->GetPoints()->SetPoint(5, 0.0, 0.0, 6.0);
  this->points->GetPoints()->Modified();
  this->points->Modified();
  expectUpdate(1, 0, 0, 1);
  this->expectSameAsExpanded(glyphCount);
  this->scene.render();
  expectUpdate(0, 0, 0, 0);
  // Other instances than before are drawn.
  this->points->GetPoints()->SetPoint(5, std::nan(""), 0.0, 6.0);
  this->points->GetPoints()->Modified();
  this->points->Modified();
  expectUpdate(1, 0, 1, 0);
  EXPECT_EQ(this->scene.report().droppedNonFinite,
    static_cast<std::size_t>(this->cup->GetOutput()->GetNumberOfPolys()));
  // Another source.
  this->cup->SetRadius(0.6);
  expectUpdate(1, 0, 1, 0);
}
