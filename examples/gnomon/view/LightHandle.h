#pragma once

#include "view/ViewState.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSphereHandleRepresentation.h>

namespace gnomon::tool
{

/// A ball at a light's position, a line to its target, and the outline of its area. The ball of a
/// directional light lies on a dome around the camera's focal point.
class LightHandle
{
public:
  /// @param renderer draws the handle in front of the scene, with the scene's camera
  explicit LightHandle(vtkRenderer* renderer);

  void setVisible(bool visible);
  /// Move the handle to the light.
  void follow(const SceneLight& light);
  /// Return the place to which the handle was dragged.
  /// @param light the one passed to the last follow()
  LightPlace placeOfBall(const SceneLight& light) const;

  vtkSphereHandleRepresentation* ball() const { return this->ball_; }

private:
  Vec3 domeCentre() const;
  double domeRadius() const;

  vtkRenderer* renderer_;
  vtkNew<vtkSphereHandleRepresentation> ball_;
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkActor> actor_;
};

} // namespace gnomon::tool
