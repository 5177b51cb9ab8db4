#include "ChangedScene.h"

#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkPlaneCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtk_glew.h>

#include <utility>

namespace gnomon::test
{
namespace
{

constexpr int texels = 4; ///< along either side of the fence's texture

/// The settings that change, each with values that go with every technique.
const std::vector<std::pair<std::string, std::vector<std::string>>> settingChoices = {
  { "map_size", { "32", "64", "96" } },
  { "kernel_size", { "1", "3", "5" } },
  { "fit", { "off", "frame" } }, // `once` depends on the frame in which it is set
  { "snap", { "off", "on" } },
  { "bake", { "settled", "always" } },
  { "splits", { "1", "3" } },
  { "split_lambda", { "0", "0.5", "1" } },
  { "split_blend", { "0", "0.2" } },
  { "light_radius", { "0", "0.5", "2" } },
  { "light_samples", { "4", "9" } },
  { "light_seed", { "0", "1", "7" } },
  { "light_sampling", { "sobol", "jittered", "random" } },
  { "batch", { "2", "8" } },
  { "progressive", { "0", "2" } },
  { "planes", { "1", "8" } },
  { "contour", { "2", "4", "image" } },
  { "coherence", { "4", "9" } }, // the technique `coherence` refuses `off`
  { "neighbours", { "off", "1", "9" } },
  { "adjacency", { "off", "edges", "vertices" } },
  { "adjacency_ring", { "edges", "vertices" } },
  { "mc_rays", { "1", "2" } },
  { "mc_layers", { "peeled", "near_far", "near", "eye" } },
  { "mc_pyramid", { "mips", "nbuffer" } },
  { "mc_filter", { "0", "2" } },
  { "bleeding", { "0", "0.2" } },
  { "disc_grid", { "2", "4" } },
  { "pcss_samples", { "low", "medium" } },
  { "depth", { "first", "second", "midpoint" } },
  { "metric", { "linear", "euclidean" } },
  { "bias_slope", { "0", "1" } },
};

vtkSmartPointer<vtkActor> actorOf(vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkActor> square(double side, const glm::dvec3& middle, int resolution = 1)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(middle.x - side, middle.y - side, middle.z);
  plane->SetPoint1(middle.x + side, middle.y - side, middle.z);
  plane->SetPoint2(middle.x - side, middle.y + side, middle.z);
  plane->SetResolution(resolution, resolution);
  return actorOf(plane);
}

vtkSmartPointer<vtkActor> box(const glm::dvec3& middle, double side)
{
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(middle.x, middle.y, middle.z);
  cube->SetXLength(side);
  cube->SetYLength(side);
  cube->SetZLength(side);
  return actorOf(cube);
}

vtkSmartPointer<vtkMapper> sphereMapper(double radius, int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(sphere->GetOutputPort());
  return mapper;
}

} // namespace

//------------------------------------------------------------------------------
Change drawChange(std::mt19937& random)
{
  const auto kind = static_cast<ChangeKind>(random() % changeKinds);
  return { kind,
    { static_cast<unsigned>(random()), static_cast<unsigned>(random()),
      static_cast<unsigned>(random()) } };
}

//------------------------------------------------------------------------------
std::ostream& operator<<(std::ostream& stream, const Change& change)
{
  static const std::array<const char*, changeKinds> names = { "camera", "light", "matrix", "points",
    "clipping plane", "texture", "visibility", "level of detail", "window size", "stereo eye",
    "renderer", "technique", "setting", "prop key", "translucency", "far caster" };
  return stream << names.at(static_cast<std::size_t>(change.kind)) << " (" << change.numbers[0]
                << ", " << change.numbers[1] << ", " << change.numbers[2] << ")";
}

//------------------------------------------------------------------------------
ChangedScene::ChangedScene()
  : settings_(
      { { "technique", "nsm" }, { "map_size", "64" }, { "light_samples", "4" }, { "mc_rays", "2" },
        { "light_radius", "0.5" }, { "disc_grid", "2" }, { "pcss_samples", "low" } })
{
  this->window_->SetSize(64, 48);
  this->window_->StereoCapableWindowOn();
  this->window_->SetMultiSamples(0);
  for (int i = 0; i < 2; ++i)
  {
    vtkRenderer* renderer = this->renderers_[static_cast<std::size_t>(i)];
    renderer->SetViewport(0.5 * i, 0.0, 0.5 * (i + 1), 1.0);
    renderer->AutomaticLightCreationOff();
    this->window_->AddRenderer(renderer);
  }
  this->addProps();
  this->addLights();
  for (int i = 0; i < 2; ++i)
  {
    vtkCamera* camera = this->renderers_[static_cast<std::size_t>(i)]->GetActiveCamera();
    camera->SetPosition(3.0 - 5.0 * i, -8.0, 6.0);
    camera->SetFocalPoint(0.0, 0.0, 0.5);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetClippingRange(1.0, 40.0);
  }
  this->setPass();
}

//------------------------------------------------------------------------------
void ChangedScene::addProps()
{
  this->actors_.push_back(square(4.0, { 0.0, 0.0, 0.0 }, 3));

  vtkNew<vtkSphereSource> source;
  source->SetCenter(-1.5, 0.5, 1.5);
  source->SetThetaResolution(12);
  source->SetPhiResolution(8);
  source->Update();
  this->ballData_->DeepCopy(source->GetOutput());
  vtkNew<vtkPolyDataMapper> ballMapper;
  ballMapper->SetInputData(this->ballData_);
  this->actors_.push_back(vtkSmartPointer<vtkActor>::New());
  this->actors_.back()->SetMapper(ballMapper);

  this->actors_.push_back(box({ 0.0, 0.0, 0.0 }, 1.0));
  this->actors_.back()->SetPosition(1.5, 0.0, 1.0);

  this->clippedMapper_ = vtkPolyDataMapper::SafeDownCast(sphereMapper(0.8, 10));
  this->actors_.push_back(vtkSmartPointer<vtkActor>::New());
  this->actors_.back()->SetMapper(this->clippedMapper_);
  this->actors_.back()->SetPosition(0.0, 2.0, 1.2);

  vtkNew<vtkPoints> places;
  for (int i = 0; i < 3; ++i)
  {
    places->InsertNextPoint(-2.0 + 2.0 * i, -2.0, 0.8);
  }
  vtkNew<vtkPolyData> placesData;
  placesData->SetPoints(places);
  vtkNew<vtkConeSource> cone;
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(placesData);
  glyphs->SetSourceConnection(cone->GetOutputPort());
  this->actors_.push_back(vtkSmartPointer<vtkActor>::New());
  this->actors_.back()->SetMapper(glyphs);

  vtkNew<vtkImageData> image;
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int i = 0; i < texels * texels; ++i)
  {
    for (int channel = 0; channel < 4; ++channel)
    {
      image->SetScalarComponentFromDouble(
        i % texels, i / texels, 0, channel, channel < 3 || i % 3 ? 255.0 : 0.0);
    }
  }
  this->texture_->SetInputData(image);
  this->texture_->InterpolateOff();
  this->fence_ = square(1.0, { 0.0, 0.0, 0.0 });
  this->fence_->SetTexture(this->texture_);
  this->fence_->SetPosition(2.0, 2.0, 1.5);
  this->fence_->RotateY(40.0);
  this->fence_->ForceOpaqueOn();
  this->actors_.push_back(this->fence_);

  this->pane_ = square(1.0, { -2.0, 2.0, 2.0 });
  this->pane_->GetProperty()->SetOpacity(0.5);
  this->pane_->VisibilityOff();

  this->far_ = box({ 0.0, 0.0, 0.0 }, 2.0);
  this->far_->VisibilityOff();

  this->levels_->AutomaticLODSelectionOff();
  this->levelIds_ = { { this->levels_->AddLOD(sphereMapper(0.5, 12), 0.0),
    this->levels_->AddLOD(sphereMapper(0.5, 4), 0.0) } };
  this->levels_->SetSelectedLODID(this->levelIds_[0]);
  this->levels_->SetPosition(0.0, 0.0, 2.5);

  for (vtkRenderer* renderer : this->renderers_)
  {
    for (vtkActor* actor : this->actors_)
    {
      renderer->AddActor(actor);
    }
    renderer->AddActor(this->pane_);
    renderer->AddActor(this->far_);
    renderer->AddViewProp(this->levels_);
  }
  // What only one renderer shows.
  this->renderers_[1]->AddActor(box({ -1.0, -1.0, 0.5 }, 0.6));
}

//------------------------------------------------------------------------------
void ChangedScene::addLights()
{
  const std::array<glm::dvec3, 3> positions = { { { -2, -1, 4 }, { 3, -3, 5 }, { 0, 0, 6 } } };
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToSceneLight();
    light->SetPosition(positions[i].x, positions[i].y, positions[i].z);
    light->SetFocalPoint(0.0, 0.0, 0.5);
    light->SetPositional(i > 0);
    light->SetConeAngle(i == 1 ? 40.0 : 180.0);
    light->SetIntensity(0.5);
    light->SetSwitch(i < 2);
    if (i == 2)
    {
      vtkGnomonLightKeys::SetTechnique(light, "nsm"); // projections refuse lights on all sides
    }
    this->lights_.push_back(light);
    for (vtkRenderer* renderer : this->renderers_)
    {
      renderer->AddLight(light);
    }
  }
}

//------------------------------------------------------------------------------
void ChangedScene::setPass()
{
  this->pass_ = vtkSmartPointer<vtkGnomonShadowPass>::New();
  for (const auto& [name, value] : this->settings_)
  {
    this->pass_->SetSetting(name.c_str(), value.c_str());
  }
  this->pass_->SetKeepVisibility(this->keepsVisibility_);
  for (unsigned i = 0; i < 2; ++i)
  {
    this->renderers_[i]->SetPass(
      this->shadowed_ == i || this->shadowed_ == 2 ? this->pass_.Get() : nullptr);
  }
}

//------------------------------------------------------------------------------
void ChangedScene::renewPass()
{
  this->pass_->ReleaseGraphicsResources(this->window_);
  this->setPass();
}

//------------------------------------------------------------------------------
void ChangedScene::keepVisibility(bool keep)
{
  this->keepsVisibility_ = keep;
  this->pass_->SetKeepVisibility(keep);
}

//------------------------------------------------------------------------------
Picture ChangedScene::renderAll()
{
  constexpr int mostFrames = 100;
  for (int frame = 0; frame < mostFrames; ++frame)
  {
    this->window_->Render();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    if (this->pass_->GetProgress() >= 1.0)
    {
      return readPicture(this->window_);
    }
  }
  ADD_FAILURE() << "not complete after " << mostFrames << " frames";
  return readPicture(this->window_);
}

//------------------------------------------------------------------------------
void ChangedScene::set(const std::string& name, const std::string& value)
{
  this->settings_[name] = value;
  this->pass_->SetSetting(name.c_str(), value.c_str());
}

//------------------------------------------------------------------------------
void ChangedScene::apply(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  switch (change.kind)
  {
    case ChangeKind::Camera:
      this->moveCamera(change);
      break;
    case ChangeKind::Light:
      this->changeLight(change);
      break;
    case ChangeKind::Matrix:
      this->moveProp(change);
      break;
    case ChangeKind::Points:
      this->editPoints(change);
      break;
    case ChangeKind::ClippingPlane:
      this->clip(change);
      break;
    case ChangeKind::Texture:
      this->changeTexture(change);
      break;
    case ChangeKind::Visibility:
    {
      vtkActor* actor = this->actors_[first % this->actors_.size()];
      actor->SetVisibility(!actor->GetVisibility());
      break;
    }
    case ChangeKind::LevelOfDetail:
      this->levels_->SetSelectedLODID(this->levelIds_[first % 2]);
      break;
    case ChangeKind::WindowSize:
      this->window_->SetSize(
        48 + 8 * static_cast<int>(first % 4), 40 + 8 * static_cast<int>(second % 3));
      break;
    case ChangeKind::StereoEye:
      this->chooseStereo(change);
      break;
    case ChangeKind::Renderer:
      this->shadowed_ = first % 3;
      for (unsigned i = 0; i < 2; ++i)
      {
        this->renderers_[i]->SetPass(
          this->shadowed_ == i || this->shadowed_ == 2 ? this->pass_.Get() : nullptr);
      }
      break;
    case ChangeKind::Technique:
      this->set("technique",
        vtkGnomonShadowPass::GetTechniqueName(
          static_cast<int>(first % 1000) % vtkGnomonShadowPass::GetNumberOfTechniques()));
      break;
    case ChangeKind::Setting:
    {
      const auto& [name, values] = settingChoices[first % settingChoices.size()];
      this->set(name, values[second % values.size()]);
      break;
    }
    case ChangeKind::PropKey:
    {
      vtkActor* actor = this->actors_[first % this->actors_.size()];
      const bool on = second % 2 != 0;
      switch (third % 3)
      {
        case 0:
          vtkGnomonPropKeys::SetCasts(actor, on);
          break;
        case 1:
          vtkGnomonPropKeys::SetReceives(actor, on);
          break;
        default:
          vtkGnomonPropKeys::SetOneSided(actor, on);
      }
      break;
    }
    case ChangeKind::Translucency:
      this->pane_->SetVisibility(first % 2 != 0);
      break;
    case ChangeKind::FarCaster:
      this->sendFarCaster(change);
      break;
  }
}

//------------------------------------------------------------------------------
void ChangedScene::moveCamera(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  vtkCamera* camera = this->renderers_[first % 2]->GetActiveCamera();
  switch (second % 4)
  {
    case 0:
      camera->Azimuth(third % 60 - 30.0);
      break;
    case 1:
      camera->Dolly(0.8 + 0.05 * (third % 9));
      break;
    case 2:
      camera->SetParallelProjection(third % 2 != 0);
      camera->SetParallelScale(3.0);
      break;
    default:
      camera->SetFocalPoint(0.1 * (third % 10), 0.0, 0.5);
  }
}

//------------------------------------------------------------------------------
void ChangedScene::changeLight(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  vtkLight* light = this->lights_[first % this->lights_.size()];
  switch (second % 5)
  {
    case 0:
      light->SetPosition(third % 7 - 3.0, third / 7 % 7 - 3.0, 4.0 + third / 49 % 3);
      break;
    case 1:
      light->SetSwitch(!light->GetSwitch());
      break;
    case 2:
      light->SetConeAngle(25.0 + 5.0 * (third % 5));
      break;
    case 3:
      light->SetDiffuseColor(1.0, 0.25 * (third % 5), 0.5);
      break;
    default:
      this->set("light_seed", std::to_string(third % 3));
      vtkGnomonLightKeys::SetCasts(light, third % 2 != 0);
  }
}

//------------------------------------------------------------------------------
void ChangedScene::moveProp(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  vtkActor* actor = this->actors_[1 + first % (this->actors_.size() - 1)]; // not the floor
  switch (second % 3)
  {
    case 0:
      actor->AddPosition(0.1 * (third % 7) - 0.3, 0.1 * (third / 7 % 7) - 0.3, 0.0);
      break;
    case 1:
      actor->RotateZ(third % 90);
      break;
    default:
      actor->SetScale(third % 2 ? 1.0 : -1.0, 1.0, 0.5 + 0.25 * (third / 2 % 4)); // mirrored, too
  }
}

//------------------------------------------------------------------------------
void ChangedScene::editPoints(const Change& change)
{
  vtkPoints* points = this->ballData_->GetPoints();
  const vtkIdType point = change.numbers[0] % points->GetNumberOfPoints();
  glm::dvec3 position;
  points->GetPoint(point, &position.x);
  position.z += 0.1 * (change.numbers[1] % 7) - 0.3;
  points->SetPoint(point, &position.x);
  points->Modified();
}

//------------------------------------------------------------------------------
void ChangedScene::clip(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  vtkPlane* plane = this->planes_[first % 2];
  vtkPlaneCollection* planes = this->clippedMapper_->GetClippingPlanes();
  const bool clips = planes && planes->IsItemPresent(plane);
  if (clips && second % 3 == 0)
  {
    this->clippedMapper_->RemoveClippingPlane(plane);
  }
  else if (!clips)
  {
    this->clippedMapper_->AddClippingPlane(plane);
  }
  plane->SetNormal(first % 2 ? 1.0 : 0.0, 0.5, first % 2 ? 0.0 : 1.0);
  plane->SetOrigin(0.1 * (third % 5), 2.0, 1.0 + 0.1 * (third / 5 % 5));
}

//------------------------------------------------------------------------------
void ChangedScene::changeTexture(const Change& change)
{
  const auto& [first, second, third] = change.numbers;
  switch (first % 4)
  {
    case 0:
      this->fence_->SetTexture(this->fence_->GetTexture() ? nullptr : this->texture_.Get());
      // VTK 9.1 by itself goes on drawing with the shader that samples the texture.
      this->fence_->GetMapper()->Modified();
      break;
    case 1:
      this->texture_->SetInterpolate(second % 2 != 0);
      break;
    default:
    {
      vtkImageData* image = this->texture_->GetInput();
      image->SetScalarComponentFromDouble(static_cast<int>(second % texels),
        static_cast<int>(second / texels % texels), 0, 3, third % 2 ? 255.0 : 0.0);
      image->Modified();
    }
  }
}

//------------------------------------------------------------------------------
void ChangedScene::chooseStereo(const Change& change)
{
  const std::array<int, 3> types{ VTK_STEREO_LEFT, VTK_STEREO_RIGHT, VTK_STEREO_ANAGLYPH };
  const unsigned choice = change.numbers[0] % 4;
  this->window_->SetStereoRender(choice < types.size());
  if (choice < types.size())
  {
    this->window_->SetStereoType(types[choice]);
  }
  // VTK 9.1 by itself draws the first frame in stereo by the matrices of the frame before.
  for (vtkRenderer* renderer : this->renderers_)
  {
    renderer->GetActiveCamera()->Modified();
  }
}

//------------------------------------------------------------------------------
void ChangedScene::sendFarCaster(const Change& change)
{
  const std::array<double, 4> distances{ 12.0, 37.0, 350.0, 1e5 };
  const auto& [first, second, third] = change.numbers;
  this->far_->SetVisibility(!this->far_->GetVisibility());
  const double distance = distances[first % distances.size()];
  this->far_->SetPosition(second % 2 ? distance : -0.3 * distance, third % 2 ? 0.7 * distance : 0.0,
    third / 2 % 2 ? 0.5 * distance : 3.0);
}

} // namespace gnomon::test
