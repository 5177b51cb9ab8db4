// Other parts of a VTK application must not be affected by the pass: picking, translucent,
// volumetric and overlay props, and the renderer's own settings.

#include "PassScene.h"

#include "shadowtech/base/Kernel.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataObject.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>
#include <vtkWorldPointPicker.h>

#include <set>

using namespace gnomon::test;

namespace
{

class Neighbours : public PassTestOf<Way>
{
protected:
  Neighbours()
  {
    this->scene.choose(GetParam());
    this->scene.renderer->SetBackground(0.1, 0.2, 0.3);
    this->sphere = this->scene.addSphereOverFloor();
    this->sun = this->scene.addSun({ 1.0, 0.3, -1.5 });
  }

  /// Draw with casting and with idle light. Outside the shadows, which must exist, and inside
  /// `kept`, both pictures must be equal.
  template <typename IsKept>
  void expectKept(IsKept kept)
  {
    this->scene.useGnomon();
    const Picture shadowed = this->scene.render();
    EXPECT_NE(this->scene.report().route, "none");
    this->sun->SetShadowAttenuation(0.0f);
    const Picture idle = this->scene.render();
    EXPECT_EQ(this->scene.report().route, "none");
    this->sun->SetShadowAttenuation(1.0f);
    const auto changed = [&](int x, int y) { return shadowed.at(x, y) != idle.at(x, y); };
    const auto isKept = [&](int x, int y) { return kept(idle, x, y); };
    const std::size_t keptPixels = countPixels(idle, isKept);
    const std::size_t changedInside =
      countPixels(idle, [&](int x, int y) { return isKept(x, y) && changed(x, y); });
    const std::size_t changedOutside =
      countPixels(idle, [&](int x, int y) { return !isKept(x, y) && changed(x, y); });
    EXPECT_GT(keptPixels, 100u);
    EXPECT_EQ(changedInside, 0u);
    EXPECT_GT(changedOutside, 100u) << "no shadow";
  }

  /// Add an opaque blue volume in the shadows' way. It must look as it does without shadows. If no
  /// light casts, the whole picture must look as it does without the pass.
  void expectVolumeKept(vtkVolumeMapper* mapper)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(16, 16, 16);
    image->SetSpacing(0.1, 0.1, 0.1);
    image->SetOrigin(-3.0, -2.0, 0.5);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
    for (int i = 0; i < 16 * 16 * 16; ++i)
    {
      values[i] = static_cast<unsigned char>(120 + 5 * (i % 16)); // a gradient, for shading
    }
    mapper->SetInputDataObject(image);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0.0, 0.0);
    opacity->AddPoint(255.0, 1.0);
    vtkNew<vtkColorTransferFunction> colour;
    colour->AddRGBPoint(0.0, 0.0, 0.0, 1.0);
    colour->AddRGBPoint(255.0, 0.0, 0.0, 1.0);
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->GetProperty()->SetScalarOpacity(opacity);
    volume->GetProperty()->SetColor(colour);
    volume->GetProperty()->SetScalarOpacityUnitDistance(0.02); // opaque
    volume->GetProperty()->ShadeOn();
    volume->GetProperty()->SetAmbient(0.4);
    this->scene.renderer->AddViewProp(volume);
    this->expectKept([](const Picture& picture, int x, int y)
      { return picture.at(x, y).b > 60 && picture.at(x, y).g < 10; });
    this->scene.render();
    EXPECT_THAT(this->scene.report().notes,
      testing::AllOf(testing::Contains(testing::HasSubstr("SetVolumeCasters()")),
        testing::Each(testing::HasSubstr("olume"))));

    this->expectPlainWhereNothingCasts();
  }

  void expectPlainWhereNothingCasts()
  {
    this->sun->SetShadowAttenuation(0.0f);
    const Picture idle = this->scene.render();
    EXPECT_EQ(differingPixels(idle, this->scene.renderPlain()), 0u);
  }

  PassScene scene{ 200, 150 };
  vtkActor* sphere;
  vtkLight* sun;
};

INSTANTIATE_TEST_SUITE_P(Ways, Neighbours, allWays, nameOf);

/// Return the props and ids that a rectangle selects, a line for each prop.
std::set<std::string> selectedIds(
  vtkRenderer* renderer, int association, const std::array<unsigned, 4>& box)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(box[0], box[1], box[2], box[3]);
  selector->SetFieldAssociation(association);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  std::set<std::string> lines;
  for (unsigned int i = 0; selection && i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    std::string line =
      "prop " + std::to_string(node->GetProperties()->Get(vtkSelectionNode::PROP_ID()));
    auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    for (vtkIdType id = 0; ids && id < ids->GetNumberOfValues(); ++id)
    {
      line += " " + std::to_string(ids->GetValue(id));
    }
    lines.insert(line);
  }
  return lines;
}

} // namespace

TEST_P(Neighbours, hardwareSelectionGivesTheSameAnswers)
{
  const std::array<std::array<unsigned, 4>, 4> boxes = { { { { 100, 100, 100, 100 } },
    { { 0, 0, 199, 149 } }, { { 90, 90, 120, 110 } }, { { 2, 147, 3, 148 } } } };
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
  {
    for (const std::array<unsigned, 4>& box : boxes)
    {
      this->scene.usePlain();
      this->scene.render();
      const std::set<std::string> plain = selectedIds(this->scene.renderer, association, box);
      this->scene.useGnomon();
      const Picture before = this->scene.render();
      EXPECT_EQ(selectedIds(this->scene.renderer, association, box), plain);
      EXPECT_EQ(this->scene.report().lights.size(), 1u) << "of the picture before";
      EXPECT_EQ(differingPixels(before, this->scene.render()), 0u) << "the frame after";
      EXPECT_EQ(plain.empty(), &box == &boxes[3]);
    }
  }
}

TEST_P(Neighbours, worldPointPickerGivesTheSamePoints)
{
  vtkNew<vtkWorldPointPicker> picker;
  const auto pick = [&](double x, double y)
  {
    this->scene.render();
    picker->Pick(x, y, 0.0, this->scene.renderer);
    const double* point = picker->GetPickPosition();
    return glm::dvec3(point[0], point[1], point[2]);
  };
  for (const glm::ivec2& pixel :
    { glm::ivec2(100, 105), { 100, 40 }, { 30, 60 }, { 150, 80 }, { 125, 75 }, { 1, 148 } })
  {
    this->scene.usePlain();
    const glm::dvec3 plain = pick(pixel.x, pixel.y);
    this->scene.useGnomon();
    const glm::dvec3 gnomon = pick(pixel.x, pixel.y);
    EXPECT_EQ(plain, gnomon) << pixel.x << ", " << pixel.y;
  }
  EXPECT_NEAR(pick(100, 40).z, 0.0, 0.05) << "the floor";
}

TEST_P(Neighbours, translucentPropsKeepTheirColoursAndShowShadows)
{
  // A pane in front of a shadow, and half in the sphere's shadow itself.
  vtkActor* actor =
    this->scene.add(planeOf({ 0.6, -1.0, 0.6 }, { 1.6, -1.0, 0.6 }, { 0.6, 1.0, 0.6 }));
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  actor->GetProperty()->SetOpacity(0.5);
  for (const bool peeling : { false, true })
  {
    this->scene.renderer->SetUseDepthPeeling(peeling);
    // The picture behind the pane, and the picture with it.
    const auto draw = [&](float attenuation)
    {
      this->sun->SetShadowAttenuation(attenuation);
      actor->VisibilityOff();
      const Picture behind = this->scene.render();
      actor->VisibilityOn();
      return std::make_pair(behind, this->scene.render());
    };
    const auto [behind, both] = draw(1.0f);
    const auto [behindIdle, bothIdle] = draw(0.0f);
    // The reference is the shader's result at the pane. Every way of a pointwise technique must
    // show the same. Others use a map of their own there, which is filtered.
    const gnomon::TechniqueInfo& info =
      gnomon::findTechnique(GetParam().technique)->estimator->info;
    this->scene.choose(
      { info.isPointwise() ? GetParam().technique : "pcf", vtkGnomonShadowPass::ROUTE_INLINE });
    const auto [behindInline, bothInline] = draw(1.0f);
    this->scene.choose(GetParam());
    std::size_t panePixels = 0;
    std::size_t overShadow = 0;
    std::size_t dark = 0;
    std::size_t different = 0;
    for (int y = 0; y < both.height; ++y)
    {
      for (int x = 0; x < both.width; ++x)
      {
        // The red pane hides half of the green behind it.
        if (bothIdle.at(x, y).g < 0.6 * behindIdle.at(x, y).g)
        {
          const double own = both.red(x, y) - 0.5 * behind.red(x, y);
          const double ownIdle = bothIdle.red(x, y) - 0.5 * behindIdle.red(x, y);
          const double ownInline = bothInline.red(x, y) - 0.5 * behindInline.red(x, y);
          ++panePixels;
          different += info.isPointwise() && std::abs(own - ownInline) > 2.0 ? 1 : 0;
          overShadow += behind.red(x, y) != behindIdle.red(x, y) ? 1 : 0;
          dark += std::abs(own) <= 2.0 ? 1 : 0;
          const bool filters = !info.isPointwise() || info.has(gnomon::kernelSettings());
          const bool between = filters && own > -2.0 && own < ownIdle + 2.0;
          different += std::abs(own) > 2.0 && std::abs(own - ownIdle) > 2.0 && !between ? 1 : 0;
        }
      }
    }
    EXPECT_GT(panePixels, 500u);
    EXPECT_GT(overShadow, 50u);
    EXPECT_EQ(different, 0u) << "depth peeling: " << peeling;
    EXPECT_GT(dark, 100u) << "depth peeling: " << peeling;
    EXPECT_LT(dark, panePixels - 100u) << "depth peeling: " << peeling;
  }
  this->sun->SetShadowAttenuation(1.0f);
  this->scene.renderer->UseDepthPeelingOff(); // with it, VTK builds shaders in every frame
  this->scene.render();
  this->scene.render();
  const bool isPlain = std::string(GetParam().technique) == "raytraced";
  EXPECT_EQ(this->scene.report().notes.size(), isPlain ? 2u : 1u) << "one of what casts nothing";
  EXPECT_EQ(this->scene.report().programCompiles, 0);
  EXPECT_EQ(this->scene.report().mapBakes, 0);
}

/// VTK shades coarse spheres by their corners' normals. Facets that are turned away from the light
/// may then be bright. If the sphere casts nothing, nothing hides the light.
TEST_P(Neighbours, translucentFacetsAreDarkOnlyWhereTheLightIsHidden)
{
  this->scene.floor()->VisibilityOff();
  this->sphere->VisibilityOff();
  vtkActor* const actor = this->scene.add(ballOf({ 0.0, 0.0, 1.5 }, 1.5)); // of 8 by 8 facets
  actor->GetProperty()->SetOpacity(0.5);
  vtkLight* const spot = this->scene.addSpot({ -4.0, -1.2, 7.5 }, { 0.0, 0.0, 1.5 }, 60.0);
  for (const bool isSun : { false, true })
  {
    this->sun->SetSwitch(isSun);
    spot->SetSwitch(!isSun);
    const Picture plain = this->scene.renderPlain();
    EXPECT_EQ(differingPixels(this->scene.render(), plain, 2), 0u) << "sun: " << isSun;
    EXPECT_NE(this->scene.report().route, "none");

    vtkGnomonPropKeys::SetCasts(actor, true); // its facets hide their own light
    vtkGnomonPropKeys::SetTransmits(actor, vtkGnomonPropKeys::TRANSMITS_NOTHING);
    EXPECT_GT(differingPixels(this->scene.render(), plain, 2), 20u) << "sun: " << isSun;
    vtkGnomonPropKeys::SetCasts(actor, false);
    EXPECT_EQ(differingPixels(this->scene.render(), plain, 2), 0u) << "sun: " << isSun;
  }

  this->scene.addBox({ -12.0, -6.4, 13.4 }, { -4.0, 1.6, 13.6 }); // out of view
  const Picture hidden = this->scene.render();
  this->sun->SetIntensity(0.0);
  EXPECT_EQ(differingPixels(this->scene.render(), hidden, 2), 0u);
}

TEST_P(Neighbours, volumesAreDrawnAsVtkDrawsThem)
{
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  mapper->AutoAdjustSampleDistancesOff(); // a busy machine then draws the same picture
  this->expectVolumeKept(mapper);
}

TEST_P(Neighbours, volumesOnTheGpuAreDrawnAsVtkDrawsThem)
{
  vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
  mapper->AutoAdjustSampleDistancesOff();
  this->scene.pass->VolumesReceiveOff();
  this->expectVolumeKept(mapper);
}

TEST_P(Neighbours, fxaaIsHonoured)
{
  const Picture without = this->scene.render();
  this->scene.renderer->UseFXAAOn();
  const Picture with = this->scene.render();
  EXPECT_GT(differingPixels(without, with), 50u);
  // Inside a shadow the colour stays black.
  EXPECT_EQ(with.red(100, 3), without.red(100, 3));
  this->expectPlainWhereNothingCasts();
}

TEST_P(Neighbours, depthPeelingIsHonoured)
{
  // Two panes that pierce each other: only peeling sorts them.
  for (const double slope : { 1.0, -1.0 })
  {
    vtkActor* actor = this->scene.add(
      planeOf({ -1.5, -1.5, 1.0 - slope }, { 1.5, -1.5, 1.0 + slope }, { -1.5, 1.5, 1.0 - slope }));
    actor->GetProperty()->SetOpacity(0.6);
    actor->GetProperty()->SetColor(slope > 0.0 ? 1.0 : 0.0, 0.0, slope > 0.0 ? 0.0 : 1.0);
  }
  const Picture unsorted = this->scene.render();
  this->scene.renderer->UseDepthPeelingOn();
  const Picture peeled = this->scene.render();
  EXPECT_GT(differingPixels(unsorted, peeled, 20), 500u);
  EXPECT_TRUE(this->scene.renderer->GetLastRenderingUsedDepthPeeling());
  this->expectPlainWhereNothingCasts();
}

TEST_P(Neighbours, renderedPropsAreCounted)
{
  this->scene.renderPlain();
  const int plain = this->scene.renderer->GetNumberOfPropsRendered();
  this->scene.render();
  EXPECT_EQ(this->scene.renderer->GetNumberOfPropsRendered(), plain);
  EXPECT_EQ(this->scene.pass->GetNumberOfRenderedProps(), plain);
}
