#pragma once

#include "Vec3.h"
#include "view/ViewState.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereHandleRepresentation.h>

#include <cmath>

namespace gnomon::tool
{

/// A ball at a light's position, a line to its target, and the outline of its area. The ball of a
/// directional light lies on a dome around the camera's focal point.
class LightHandle
{
public:
  /// @param renderer draws the handle in front of the scene, with the scene's camera
  explicit LightHandle(vtkRenderer* renderer)
    : renderer_(renderer)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(this->lines_);
    this->actor_->SetMapper(mapper);
    this->actor_->PickableOff();
    this->actor_->GetProperty()->LightingOff();
    this->actor_->GetProperty()->SetColor(1.0, 0.8, 0.1);
    this->actor_->GetProperty()->SetLineWidth(2.0f);
    renderer->AddActor(this->actor_);
    for (vtkProperty* const look :
      { this->ball_->GetProperty(), this->ball_->GetSelectedProperty() })
    {
      look->LightingOff();
      look->SetColor(1.0, 0.8, 0.1);
    }
    this->ball_->GetSelectedProperty()->SetColor(1.0, 0.4, 0.1);
    this->ball_->SetHandleSize(ballPixels);
    this->ball_->TranslationModeOn();
    this->ball_->SetRenderer(renderer);
    renderer->AddViewProp(this->ball_);
  }

  void setVisible(bool visible)
  {
    this->ball_->SetVisibility(visible);
    this->actor_->SetVisibility(visible);
  }

  void follow(const SceneLight& light)
  {
    const bool directional = isDirectional(light);
    const Vec3 axis = normalized(light.target - light.position);
    const Vec3 target = directional ? this->domeCentre() : light.target;
    Vec3 position = directional ? target + (-this->domeRadius()) * axis : light.position;
    this->ball_->SetWorldPosition(position.data());
    this->ball_->Modified(); // its size in pixels follows the camera

    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    if (light.type != SceneLight::Type::Point || light.area)
    {
      appendLine({ position, target }, points, lines);
    }
    // A directional light's size is a whole angle.
    const double size = placeOf(light).size;
    const double radius =
      directional ? this->domeRadius() * std::tan(0.5 * vtkMath::RadiansFromDegrees(size)) : size;
    if (radius > 0.0)
    {
      appendLine(outlineOf(light, position, axis, radius), points, lines);
    }
    this->lines_->SetPoints(points);
    this->lines_->SetLines(lines);
  }

  /// Return the place to which the handle was dragged.
  /// @param light the one passed to the last follow()
  LightPlace placeOfBall(const SceneLight& light) const
  {
    LightPlace place = placeOf(light);
    Vec3 ball;
    this->ball_->GetWorldPosition(ball.data());
    if (isDirectional(light))
    {
      // The light keeps its distance, which matters only if it has a box.
      const Vec3 towards = normalized(ball - this->domeCentre());
      const double distance = length(light.position - light.target);
      place.position = light.target + distance * towards;
    }
    else if (length(light.target - ball) > 0.0)
    {
      // A point light has no direction: its target moves with it.
      const bool aims = light.type == SceneLight::Type::Spot || light.area;
      place.target = aims ? light.target : light.target + (ball - light.position);
      place.position = ball;
    }
    return place;
  }

  vtkSphereHandleRepresentation* ball() const { return this->ball_; }

private:
  static constexpr double ballPixels = 9.0;

  static bool isDirectional(const SceneLight& light)
  {
    return light.type == SceneLight::Type::Directional;
  }

  static void appendLine(const std::vector<Vec3>& through, vtkPoints* points, vtkCellArray* lines)
  {
    lines->InsertNextCell(static_cast<int>(through.size()));
    for (const Vec3& point : through)
    {
      lines->InsertCellPoint(points->InsertNextPoint(point.data()));
    }
  }

  /// Return the outline of a light's area around a point.
  /// @param radius half of its width there
  static std::vector<Vec3> outlineOf(
    const SceneLight& light, const Vec3& centre, const Vec3& axis, double radius)
  {
    const bool rectangle = light.area && light.area->rectangle;
    const Vec3 leastAlong =
      std::abs(axis[1]) < 0.9 ? Vec3{ { 0.0, 1.0, 0.0 } } : Vec3{ { 1.0, 0.0, 0.0 } };
    const Vec3 right = normalized(cross(axis, rectangle ? light.area->up : leastAlong));
    const Vec3 up = cross(right, axis);
    const double height = rectangle ? radius * light.area->height / light.area->width : radius;
    const int corners = rectangle ? 4 : 48;
    std::vector<Vec3> outline;
    for (int i = 0; i <= corners; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * (i + (rectangle ? 0.5 : 0.0)) / corners;
      const double scale = rectangle ? std::sqrt(2.0) : 1.0;
      outline.push_back(centre + (scale * radius * std::cos(angle)) * right +
        (scale * height * std::sin(angle)) * up);
    }
    return outline;
  }

  Vec3 domeCentre() const
  {
    Vec3 centre;
    this->renderer_->GetActiveCamera()->GetFocalPoint(centre.data());
    return centre;
  }

  /// Return the dome's radius, a share of the picture's height.
  double domeRadius() const
  {
    constexpr double shareOfHeight = 0.3;
    vtkCamera* const camera = this->renderer_->GetActiveCamera();
    const double halfHeight = camera->GetParallelProjection()
      ? camera->GetParallelScale()
      : camera->GetDistance() * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
    return 2.0 * shareOfHeight * halfHeight;
  }

  vtkRenderer* renderer_;
  vtkNew<vtkSphereHandleRepresentation> ball_;
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkActor> actor_;
};

} // namespace gnomon::tool
