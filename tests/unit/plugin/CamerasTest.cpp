// All kinds of camera that vtkCamera has: maps against rays, and rays against the exact shadow.

#include "PassScene.h"

#include <vtkMatrix4x4.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

struct CameraKind
{
  const char* name;
  void (*set)(vtkCamera* camera);
};

void setParallel(vtkCamera* camera)
{
  camera->ParallelProjectionOn();
  camera->SetParallelScale(5.0);
}

/// A camera that looks up from just above the floor, which only sheared rays see from above.
void lookUp(vtkCamera* camera)
{
  setParallel(camera);
  camera->SetPosition(-1.0, -9.0, 0.1);
  camera->SetFocalPoint(0.0, 0.0, 0.9);
}

void setModel(vtkCamera* camera, double x, double y, double z)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 0, x);
  matrix->SetElement(1, 1, y);
  matrix->SetElement(2, 2, z);
  camera->SetModelTransformMatrix(matrix);
}

void setExplicit(vtkCamera* camera, const std::array<double, 16>& rows)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(rows.data());
  camera->SetExplicitProjectionTransformMatrix(matrix);
  camera->UseExplicitProjectionTransformMatrixOn();
}

template <typename Change>
void setUserView(vtkCamera* camera, const Change& change)
{
  vtkNew<vtkTransform> transform;
  change(transform.Get());
  camera->SetUserViewTransform(transform);
}

const CameraKind cameraKinds[] = {
  { "perspective", [](vtkCamera*) {} },
  { "parallel", setParallel },
  { "oblique",
    [](vtkCamera* camera)
    {
      lookUp(camera);
      camera->SetObliqueAngles(45.0, 45.0);
    } },
  { "obliqueFlat",
    [](vtkCamera* camera)
    {
      lookUp(camera);
      camera->SetObliqueAngles(63.4, 60.0);
    } },
  { "shearedPerspective", [](vtkCamera* camera) { camera->SetViewShear(0.4, -0.3, 1.0); } },
  { "shearedParallel",
    [](vtkCamera* camera)
    {
      lookUp(camera);
      camera->SetViewShear(-0.8, 0.5, 1.0);
    } },
  { "asideWindow", [](vtkCamera* camera) { camera->SetWindowCenter(0.4, -0.3); } },
  { "explicitOrthographic",
    [](vtkCamera* camera)
    {
      setExplicit(camera,
        { 0.15, 0.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0, -0.05, -1.1, 0.0, 0.0, 0.0, 1.0 });
    } },
  { "explicitOblique",
    [](vtkCamera* camera)
    {
      lookUp(camera);
      setExplicit(camera,
        { 0.15, 0.0, 0.1, 0.9, 0.0, 0.2, -0.1, -0.9, 0.0, 0.0, -0.05, -1.1, 0.0, 0.0, 0.0, 1.0 });
    } },
  { "explicitPerspective",
    [](vtkCamera* camera)
    {
      setExplicit(camera,
        { 1.9, 0.0, 0.2, 0.0, 0.0, 2.4, -0.1, 0.0, 0.0, 0.0, -1.1, -4.2, 0.0, 0.0, -1.0, 0.0 });
    } },
  { "offAxis",
    [](vtkCamera* camera)
    {
      camera->UseOffAxisProjectionOn();
      camera->SetScreenBottomLeft(-0.6, -0.4, -1.0);
      camera->SetScreenBottomRight(0.6, -0.4, -1.2); // a screen that stands aslant
      camera->SetScreenTopRight(0.6, 0.4, -1.2);
    } },
  { "projectedTwice",
    [](vtkCamera* camera)
    {
      vtkNew<vtkTransform> transform;
      transform->Scale(0.8, 1.1, 1.0);
      transform->RotateZ(20.0);
      camera->SetUserTransform(transform);
    } },
  { "userTurn",
    [](vtkCamera* camera)
    { setUserView(camera, [](vtkTransform* change) { change->RotateZ(30.0); }); } },
  { "userScale",
    [](vtkCamera* camera)
    { setUserView(camera, [](vtkTransform* change) { change->Scale(1.3, 0.7, 1.0); }); } },
  { "userMirror",
    [](vtkCamera* camera)
    { setUserView(camera, [](vtkTransform* change) { change->Scale(-1.0, 1.0, 1.0); }); } },
  { "heightsExaggerated", [](vtkCamera* camera) { setModel(camera, 1.0, 1.0, 2.5); } },
  { "modelFlattened", [](vtkCamera* camera) { setModel(camera, 0.6, 1.4, 0.5); } },
  { "modelSqueezed", [](vtkCamera* camera) { setModel(camera, 0.5, 1.0, 1.0); } },
  { "modelMirrored", [](vtkCamera* camera) { setModel(camera, 1.0, -1.0, 1.0); } },
  { "modelExaggeratedParallel",
    [](vtkCamera* camera)
    {
      setParallel(camera);
      setModel(camera, 1.0, 1.0, 2.5);
    } },
};

/// A way to shade, and the most of its pixels that may differ from rays.
struct MapWay
{
  Way way;
  double mostShare;
};

const MapWay mapWays[] = {
  { { "nsm", vtkGnomonShadowPass::ROUTE_INLINE }, 0.01 },
  { { "nsm", vtkGnomonShadowPass::ROUTE_IMAGE }, 0.01 },
  { { "pcf", vtkGnomonShadowPass::ROUTE_INLINE }, 0.02 },
  { { "lispsm", vtkGnomonShadowPass::ROUTE_INLINE }, 0.01 },
  { { "tsm", vtkGnomonShadowPass::ROUTE_IMAGE }, 0.01 },
  { { "pssm", vtkGnomonShadowPass::ROUTE_INLINE }, 0.01 },
  { { "planar", vtkGnomonShadowPass::ROUTE_IMAGE }, 0.01 },
  { { "silhouette", vtkGnomonShadowPass::ROUTE_IMAGE }, 0.0 },
  { { "raytraced", vtkGnomonShadowPass::ROUTE_DEFERRED }, 0.0 },
  { { "nsm fit=frame", vtkGnomonShadowPass::ROUTE_INLINE }, 0.01 },
};

struct Cameras : PassTestOf<CameraKind>
{
  Cameras()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 });
    this->scene.addSphere(this->ball, 0.7);
    this->scene.addSun(-this->toLight);
    this->scene.lookFrom({ -1.0, -9.0, 6.0 }, { 0.0, 0.0, 0.5 });
    vtkCamera* const camera = this->scene.renderer->GetActiveCamera();
    camera->SetClippingRange(2.0, 40.0);
    GetParam().set(camera);
  }

  const glm::dvec3 toLight{ -0.9, 0.5, 1.0 };
  const glm::dvec3 ball{ 2.0, -1.5, 0.8 };
  PassScene scene{ 160, 120 };
};

INSTANTIATE_TEST_SUITE_P(Kinds, Cameras, testing::ValuesIn(cameraKinds), byName);

TEST_P(Cameras, lampsShineOnSlopes)
{
  this->scene.addBox({ -2.25, -2.25, 0.95 }, { -0.75, -0.75, 1.05 })->RotateY(40.0);
  this->scene.renderer->RemoveAllLights();
  vtkLight* const lamp = this->scene.addSpot({ -3.0, -2.0, 5.0 }, { -3.0, -2.0, 9.0 }, 100.0);
  const Picture exact = this->scene.render(tracedWay);
  lamp->SetConeAngle(allDirections); // as from 90 degrees on
  EXPECT_EQ(differingPixels(this->scene.render(tracedWay), exact), 0u);
  for (const Way& way : { Way{ "nsm", vtkGnomonShadowPass::ROUTE_INLINE },
         Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
         Way{ "vsm", vtkGnomonShadowPass::ROUTE_INLINE } })
  {
    SCOPED_TRACE(way);
    EXPECT_LE(differingPixels(this->scene.render(way), exact, 30), 100u);
  }
}

TEST_P(Cameras, mapsAgreeWithRays)
{
  const Picture exact = this->scene.render(tracedWay);
  const VisibilityImages& kept = drawKept(this->scene);
  std::size_t lit = 0;
  std::size_t dark = 0;
  const std::size_t wrong = countPixels(kept,
    [&](std::size_t i)
    {
      const glm::dvec3 at = positionOf(kept, i);
      const glm::dvec3 toBall = glm::cross(this->ball - at, glm::normalize(this->toLight));
      // On the floor around the ball's shadow.
      const bool counts = std::abs(at.z) < 1e-4 && glm::length(toBall) >= 1.0;
      const bool blocked =
        hitsBox(glm::dvec2(at), this->toLight, { { -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 } });
      (blocked ? dark : lit) += counts ? 1 : 0;
      return counts && (kept.visibility.front()[i] < 0.5f) != blocked;
    });
  EXPECT_GT(lit, 500u);
  EXPECT_GT(dark, 10u);
  EXPECT_LE(wrong, 2u) << "rays";
  this->scene.pass->KeepVisibilityOff();
  for (const MapWay& map : mapWays)
  {
    SCOPED_TRACE(map.way);
    EXPECT_LE(static_cast<double>(differingPixels(this->scene.render(map.way), exact, 30)),
      map.mostShare * static_cast<double>(lit));
  }
}

} // namespace
