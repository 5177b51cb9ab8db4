// The same scenes in other units of length. Powers of two change no bit of what is exact; powers of
// ten, and VTK's own shift and scale, hardly any pixel.

#include "PassScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/Registry.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkGlyph3DMapper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

enum class Lamp
{
  Sun,
  WideSun,
  Box,
  Spot,
  Disk,
  Point,
  Ball
};
constexpr Lamp allLamps[] = { Lamp::Sun, Lamp::WideSun, Lamp::Box, Lamp::Spot, Lamp::Disk,
  Lamp::Point, Lamp::Ball };

bool hasArea(Lamp lamp)
{
  return lamp == Lamp::WideSun || lamp == Lamp::Disk || lamp == Lamp::Ball;
}

/// A random scene of spheres, boxes, glyphs and smooth slabs over a floor, under one light. All its
/// lengths are those of the scene of unit 1, times the unit.
class UnitScene
{
public:
  /// @param unit length of one unit of the scene
  /// @param shifts true if VTK may shift and scale its vertices
  UnitScene(unsigned seed, Lamp lamp, double unit, bool shifts = false)
    : unit_(unit)
    , shifts_(shifts)
    , random_(seed)
  {
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-4.0, -4.0, 0.0);
    floor->SetPoint1(4.0, -4.0, 0.0);
    floor->SetPoint2(-4.0, 4.0, 0.0);
    this->add(floor);
    this->addBalls();
    this->addSlab();
    this->addGlyphs(seed == 1);
    if (seed % 5 == 0)
    {
      this->addSolids();
    }
    this->addLamp(lamp);
    vtkCamera* const camera = this->scene.renderer->GetActiveCamera();
    const glm::dvec3 from = unit * this->at(-2.0, 2.0, 5.0) + unit * glm::dvec3(0.0, -7.0, 0.0);
    camera->SetPosition(from.x, from.y, from.z);
    camera->SetFocalPoint(0.0, 0.0, 0.5 * unit);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetClippingRange(2.0 * unit, 30.0 * unit);
    this->scene.renderer->SetAmbient(0.0, 0.0, 0.0);
  }

  void choose(const std::string& technique, int route = vtkGnomonShadowPass::ROUTE_AUTO)
  {
    this->scene.choose({ technique.c_str(), route });
  }

  PassScene scene{ 120, 90 };

private:
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->random_);
  }
  glm::dvec3 at(double low, double high, double z)
  {
    const double x = this->uniform(low, high);
    return { x, this->uniform(low, high), z };
  }

  /// Return a polydata with its points, which are floats, times the unit.
  vtkSmartPointer<vtkPolyData> inUnits(vtkAlgorithm* source) const
  {
    source->Update();
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->ShallowCopy(source->GetOutputDataObject(0));
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      double point[3];
      data->GetPoint(i, point);
      points->InsertNextPoint(
        point[0] * this->unit_, point[1] * this->unit_, point[2] * this->unit_);
    }
    data->SetPoints(points);
    return data;
  }

  vtkActor* add(vtkAlgorithm* source)
  {
    vtkActor* const actor = this->scene.add(this->inUnits(source));
    if (!this->shifts_)
    {
      vtkOpenGLPolyDataMapper::SafeDownCast(actor->GetMapper())
        ->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    }
    return actor;
  }

  void addBalls()
  {
    for (int i = 0; i < 3; ++i)
    {
      vtkNew<vtkSphereSource> ball; // with normals
      ball->SetRadius(this->uniform(0.2, 0.7));
      ball->SetThetaResolution(8 + 8 * i);
      ball->SetPhiResolution(12);
      vtkActor* const actor = this->add(ball);
      const glm::dvec3 place = this->at(-2.0, 2.0, this->uniform(0.3, 1.5));
      actor->SetPosition(place.x * this->unit_, place.y * this->unit_, place.z * this->unit_);
      actor->RotateX(this->uniform(0.0, 90.0));
      actor->SetScale(1.0, this->uniform(0.5, 1.5), 1.0);
    }
  }

  /// Add a box with averaged normals, cut by a plane in every other scene.
  void addSlab()
  {
    vtkNew<vtkCubeSource> box;
    const glm::dvec3 low = this->at(-2.0, 0.0, 0.0);
    box->SetBounds(low.x, low.x + 1.5, low.y, low.y + 1.0, 0.2, this->uniform(0.4, 1.2));
    vtkNew<vtkPolyDataNormals> smooth;
    smooth->SetInputConnection(box->GetOutputPort());
    smooth->SplittingOff();
    vtkActor* const actor = this->add(smooth);
    if (this->uniform(0.0, 1.0) < 0.5)
    {
      vtkNew<vtkPlane> plane;
      plane->SetNormal(0.3, -1.0, 0.2);
      plane->SetOrigin((low.x + 0.7) * this->unit_, (low.y + 0.6) * this->unit_, 0.0);
      actor->GetMapper()->AddClippingPlane(plane);
    }
  }

  vtkNew<vtkPolyData> places(int count)
  {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 place = this->unit_ * this->at(-3.0, 3.0, this->uniform(0.2, 1.0));
      vertices->InsertNextCell({ points->InsertNextPoint(place.x, place.y, place.z) });
    }
    vtkNew<vtkPolyData> places;
    places->SetPoints(points);
    places->SetVerts(vertices);
    return places;
  }

  vtkActor* add(vtkMapper* mapper)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->scene.renderer->AddActor(actor);
    return actor;
  }

  /// Add few glyphs, or so many that the snapshot holds them as instances.
  void addGlyphs(bool many)
  {
    vtkNew<vtkConeSource> cone;
    cone->SetRadius(many ? 0.02 : 0.1);
    cone->SetHeight(many ? 0.1 : 0.4);
    cone->SetResolution(many ? 1000 : 12);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(this->places(many ? 150 : 6));
    mapper->SetSourceData(this->inUnits(cone));
    mapper->SetScaleFactor(1.0);
    this->add(mapper);
  }

  /// Add spheres that are sized in world units, and others that are sized in pixels.
  void addSolids()
  {
    vtkNew<vtkOpenGLSphereMapper> spheres;
    spheres->SetInputData(this->places(5));
    spheres->SetRadius(static_cast<float>(0.25 * this->unit_));
    this->add(spheres);
    vtkNew<vtkPolyDataMapper> points;
    points->SetInputData(this->places(5));
    vtkProperty* const property = this->add(points)->GetProperty();
    property->SetRepresentationToPoints();
    property->RenderPointsAsSpheresOn();
    property->SetPointSize(7.0f);
  }

  void addLamp(Lamp lamp)
  {
    const glm::dvec3 from = this->at(-3.0, 3.0, this->uniform(4.0, 6.0));
    const glm::dvec3 place = this->unit_ * from;
    vtkNew<vtkGnomonAreaLight> light;
    light->SetLightTypeToSceneLight();
    light->SetShapeToDisk();
    light->SetPosition(place.x, place.y, place.z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    const bool isSun = lamp == Lamp::Sun || lamp == Lamp::WideSun || lamp == Lamp::Box;
    light->SetPositional(!isSun);
    light->SetConeAngle(lamp == Lamp::Spot || lamp == Lamp::Disk ? 40.0 : allDirections);
    light->SetExponent(0.0);
    light->SetRadius(lamp == Lamp::WideSun ? 3.0 : hasArea(lamp) ? 0.2 * this->unit_ : 0.0);
    if (lamp == Lamp::Box)
    {
      const double up[3] = { 0.0, 1.0, 0.0 };
      vtkGnomonLightKeys::SetBox(
        light, 3.0 * this->unit_, 4.0 * this->unit_, 9.0 * this->unit_, up);
    }
    this->scene.renderer->AddLight(light);
  }

  double unit_;
  bool shifts_;
  std::mt19937 random_;
};

/// How a picture differs from the one of unit 1.
struct Differences
{
  std::size_t covered = 0;
  std::size_t triangles = 0; ///< pixels that show another triangle
  std::size_t visibility = 0;
  std::size_t places = 0; ///< pixels whose position is not the same, times the unit
  double mean = 0.0;      ///< of the visibility, absolute
};

Differences differencesOf(const VisibilityImages& one, const VisibilityImages& other, double unit)
{
  Differences differences;
  for (std::size_t i = 0; i < one.coverage.size(); ++i)
  {
    if (one.coverage[i] == 0.0f && other.coverage[i] == 0.0f)
    {
      continue;
    }
    ++differences.covered;
    if (one.coverage[i] != other.coverage[i] || one.prop[i] != other.prop[i] ||
      one.cell[i] != other.cell[i])
    {
      ++differences.triangles;
      continue;
    }
    const float off = std::abs(one.visibility.front()[i] - other.visibility.front()[i]);
    differences.visibility += off != 0.0f ? 1 : 0;
    differences.mean += static_cast<double>(off);
    differences.places += positionOf(one, i) * unit != positionOf(other, i) ? 1 : 0;
  }
  differences.mean /= static_cast<double>(std::max<std::size_t>(differences.covered, 1));
  return differences;
}

/// Return the wrong pixels as a share of the covered ones.
double wrongShare(const VisibilityImages& kept, const VisibilityImages& truth)
{
  std::size_t covered = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.coverage.size(); ++i)
  {
    covered += truth.coverage[i] != 0.0f ? 1 : 0;
    wrong += std::abs(kept.visibility.front()[i] - truth.visibility.front()[i]) > 0.5f ? 1 : 0;
  }
  return static_cast<double>(wrong) / static_cast<double>(covered);
}

VisibilityImages keptOf(UnitScene& of)
{
  return drawKept(of.scene);
}

/// Return the number of pixels whose visibility is 0.
std::size_t shadowed(const VisibilityImages& kept)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept.coverage.size(); ++i)
  {
    count += kept.coverage[i] != 0.0f && kept.visibility.front()[i] == 0.0f ? 1 : 0;
  }
  return count;
}

} // namespace

//------------------------------------------------------------------------------
/// 30 scenes in units from 2^-50 to 2^50, in steps of 2^5, with each technique. With GNOMON_UNITS
/// set, all of the cross; else each scene has one technique and a fourth of the units.
TEST(Units, ofPowersOfTwoChangeNoBit)
{
  const char* const techniques[] = { "raytraced", "silhouette", "penumbra" };
  const bool all = std::getenv("GNOMON_UNITS") != nullptr;
  constexpr int scenes = 30;
  for (int scene = 1; scene <= scenes; ++scene)
  {
    const auto seed = static_cast<unsigned>(scene);
    const Lamp lamp = allLamps[seed % std::size(allLamps)];
    for (int i = all ? 0 : scene % 3; i < 3; i += all ? 1 : 3)
    {
      UnitScene ofOne(seed, lamp, 1.0);
      ofOne.choose(techniques[i]);
      const VisibilityImages one = keptOf(ofOne);
      EXPECT_GT(shadowed(one), 50u);
      for (int k = all ? -50 : -50 + 5 * (scene % 4); k <= 50; k += all ? 5 : 20)
      {
        SCOPED_TRACE("scene " + std::to_string(scene) + ", unit 2^" + std::to_string(k) + ", " +
          techniques[i] + ", lamp " + std::to_string(static_cast<int>(lamp)));
        UnitScene ofOther(seed, lamp, std::ldexp(1.0, k));
        ofOther.choose(techniques[i]);
        const Differences differences = differencesOf(one, keptOf(ofOther), std::ldexp(1.0, k));
        EXPECT_GT(differences.covered, 1000u);
        EXPECT_EQ(differences.triangles, 0u);
        EXPECT_EQ(differences.visibility, 0u);
        EXPECT_EQ(differences.places, 0u);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Every registered technique at powers of ten, with VTK's own shift and scale: visibility stays,
/// and so does the share of wrong pixels.
TEST(Units, ofPowersOfTenChangeHardlyAPixel)
{
  const auto draw = [](const std::string& technique, double unit)
  {
    UnitScene scene(7, Lamp::Sun, unit, true);
    scene.choose(technique);
    return keptOf(scene);
  };
  const VisibilityImages truthOfOne = draw("raytraced", 1.0);
  std::map<std::string, VisibilityImages> ofOne;
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    ofOne[technique.name] = draw(technique.name, 1.0);
  }
  for (const int power : { -18, -13, -8, 9, 12, 18 })
  {
    const double unit = std::pow(10.0, power);
    const VisibilityImages truth = draw("raytraced", unit);
    for (const gnomon::TechniqueEntry& technique : gnomon::registry())
    {
      SCOPED_TRACE(std::string(technique.name) + ", unit 1e" + std::to_string(power));
      const VisibilityImages& one = ofOne[technique.name];
      const VisibilityImages other = draw(technique.name, unit);
      const Differences differences = differencesOf(one, other, unit);
      EXPECT_GT(differences.covered, 1000u);
      EXPECT_LE(differences.triangles, differences.covered / 100);
      EXPECT_LE(differences.mean, 1e-3);
      EXPECT_NEAR(wrongShare(other, truth), wrongShare(one, truthOfOne), 1e-3);
      if (technique.estimator->info.exact)
      {
        EXPECT_LE(differences.visibility, 1u + differences.covered / 10000);
      }
    }
  }
}
