#pragma once

#include "view/ViewState.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSphereHandleRepresentation.h>

namespace gnomon::tool
{

/// A ball where a light is, or from where it shines, with a line to what it shines at and the
/// outline of its area. A directional light's ball is on a dome around what the camera looks at.
class LightHandle
{
public:
  /// @param renderer that draws it in front of the scene, and has the scene's camera
  explicit LightHandle(vtkRenderer* renderer);

  void setVisible(bool visible);
  /// Puts it where the light is.
  void follow(const SceneLight& light);
  /// Where it was dragged to.
  /// @param light that it followed last
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
