// Some surfaces of many move: only the tiles that they may change are traced, and the picture
// equals that of a new pass.

#include "AreaLights.h"

#include <set>

using namespace gnomon::test;

namespace
{

/// A technique, and a light for it.
struct LitBy
{
  const char* name;
  const char* technique;
  std::function<void(PassScene&)> addLight;
  int others = 0; ///< lamps beside it
};

const glm::dvec3 awayFromSun(-3.0, 2.0, -6.0);
const glm::dvec3 overProps(2.0, -1.0, 4.0);
const glm::dvec3 below(0.0);

/// Balls and boxes over a floor, in rows.
struct MovedSurfaces : PassTestOf<LitBy>
{
  static constexpr int side = 6; ///< props in a row

  MovedSurfaces()
  {
    this->scene.addFloor(8.0);
    for (int i = 0; i < side * side; ++i)
    {
      this->props_.push_back(i % 2 == 0 ? this->scene.addBox(glm::dvec3(-0.3), glm::dvec3(0.3))
                                        : this->scene.addSphere(glm::dvec3(0.0), 0.35));
      this->props_.back()->SetPosition(
        1.5 * (i % side) - 3.75, 1.5 * (i / side) - 3.75, 0.5 + 0.05 * i);
      this->props_.back()->GetProperty()->SetInterpolationToPhong();
    }
    this->scene.add(this->soft_.Get());
    vtkGnomonPropKeys::SetCasts(this->props_[8], false);
    vtkGnomonPropKeys::SetReceives(this->props_[9], false);
    GetParam().addLight(this->scene);
    for (int i = 0; i < GetParam().others; ++i)
    {
      this->scene.addSpot({ 2.0 * i - 3.0, 3.0, 4.0 }, { 0.0, 0.0, 0.0 }, allDirections);
    }
    this->scene.choose(GetParam().technique);
    this->scene.lookFrom({ 0.0, -9.0, 9.0 });
  }

  PassScene scene{ 500, 330 }; ///< 8 x 21 tiles, the last ones cut off
  std::vector<vtkActor*> props_;
  vtkSmartPointer<vtkPolyData> soft_ = copyOf(ballOf({ 0.0, 0.0, 2.0 }, 0.6, 24, 16));
};

using RecolouredSurfaces = MovedSurfaces;

const LitBy sun{ "sun", "raytraced", [](PassScene& scene) { scene.addSun(awayFromSun); } };
const LitBy wideSun{ "wideSun", "raytraced light_samples=16",
  [](PassScene& scene) { addSoftSun(scene, awayFromSun, "3"); } };
void addLampAround(PassScene& scene)
{
  scene.addSpot(overProps, below, allDirections);
}
void addNarrowSpot(PassScene& scene)
{
  scene.addSpot(overProps, below, 50.0);
}

INSTANTIATE_TEST_SUITE_P(Lights, RecolouredSurfaces, testing::Values(sun, wideSun), byName);
INSTANTIATE_TEST_SUITE_P(Lights, MovedSurfaces,
  testing::Values(sun, wideSun, LitBy{ "lamp", "raytraced", addLampAround },
    LitBy{ "spot", "silhouette", addNarrowSpot },
    LitBy{ "spotByCells", "crsma adjacency_ring=vertices", addNarrowSpot },
    LitBy{ "spotByContours", "selective coherence=off contour=image", addNarrowSpot },
    LitBy{ "lamps", "raytraced", addLampAround, 2 },
    LitBy{ "wideLamp", "penumbra light_samples=16",
      [](PassScene& scene) { addDisk(scene, overProps, below, 0.3, allDirections); } },
    LitBy{ "pictureOfLight", "raytraced light_samples=16",
      [](PassScene& scene)
      {
        addDisk(scene, overProps, below, 0.3, allDirections)
          ->SetTexture(makeImage(
            2, 1, [](int x, int) { return x == 0 ? glm::dvec3(1.0, 0.2, 0.0) : glm::dvec3(0.5); }));
      } }),
  byName);

} // namespace

TEST_P(MovedSurfaces, areTracedAlone)
{
  std::mt19937 random(7);
  const auto number = [&] { return std::uniform_real_distribution<double>(-0.4, 0.4)(random); };
  drawKept(this->scene);
  const std::int64_t all = this->scene.report().raysTraced;
  const std::string technique = this->scene.pass->GetTechnique();
  const bool hasMap = std::set<std::string>{ "silhouette", "crsma", "selective" }.count(technique);
  for (int step = 0; step < 12; ++step)
  {
    // Move props of the lower rows: a prop that leaves the view changes all surfaces' numbers.
    vtkActor* const moved = this->props_[random() % (this->props_.size() / 2)];
    moved->AddPosition(number(), number(), number());
    moved->RotateX(60.0 * number());
    if (hasMap) // whose casters' edges are kept while points move or merge
    {
      movePoints(this->soft_,
        [&](const glm::dvec3& at)
        {
          return step % 2 == 0 ? at + 0.1 * glm::dvec3(number(), number(), number())
                               : glm::round(8.0 * at) / 8.0;
        });
    }
    // In some frames neither visibility nor classes are kept.
    this->scene.pass->SetKeepVisibility(step % 5 != 3);
    this->scene.render();
    EXPECT_GT(this->scene.report().raysTraced, 0) << step;
    // When classes are asked for again, no tile has cached ones. A prop that moves without casting
    // lets `silhouette` bake its map, which then decides all pixels.
    if (!hasMap)
    {
      EXPECT_EQ(this->scene.report().raysTraced < all / 2, step % 5 != 4) << step;
    }
    if (step % 5 == 3)
    {
      continue;
    }
    const gnomon::VisibilityImages& kept = this->scene.pass->GetVisibility();
    const gnomon::VisibilityImages anew = this->scene.drawAnew();
    EXPECT_EQ(kept.visibility, anew.visibility) << step;
    // `penumbra` classes also depend on casters near its rays.
    if (technique != "penumbra" && !hasMap)
    {
      EXPECT_EQ(kept.classes[0].ofPixels, anew.classes[0].ofPixels) << step;
    }
  }
}

TEST_P(RecolouredSurfaces, areNotTraced)
{
  drawKept(this->scene);
  const gnomon::VisibilityImages before = drawKept(this->scene);
  this->props_[3]->GetProperty()->SetColor(1.0, 0.0, 0.0);
  EXPECT_EQ(drawKept(this->scene).visibility, before.visibility);
  EXPECT_EQ(this->scene.report().receiversDrawn, 1);
  EXPECT_EQ(this->scene.report().raysTraced, 0);
}
