#include "Judge.h"

#include "shadowtech/base/ShadowRay.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkMapper.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::hard
{
namespace
{

using check::Vec3;

Vec3 toCheck(const tool::Vec3& vector)
{
  return { vector[0], vector[1], vector[2] };
}

/// Append the balls of a vtkOpenGLSphereMapper as triangles fine enough to count as round.
void addBalls(check::Mesh& to, vtkProp3D* prop)
{
  auto* const actor = vtkActor::SafeDownCast(prop);
  auto* const points =
    actor ? vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0)) : nullptr;
  vtkDataArray* const radii = points ? points->GetPointData()->GetArray("radius") : nullptr;
  if (!radii)
  {
    throw std::runtime_error("a prop that is neither a surface nor balls with a `radius`");
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    ball->SetThetaResolution(256);
    ball->SetPhiResolution(128);
    ball->SetCenter(points->GetPoint(i));
    ball->SetRadius(radii->GetComponent(i, 0));
    ball->Update();
    check::addSurface(to, ball->GetOutput(), actor->GetMatrix());
  }
}

check::Light lightOf(const tool::SceneLight& light)
{
  using Type = tool::SceneLight::Type;
  check::Light result;
  result.kind = light.type == Type::Directional ? check::Light::Kind::Directional
    : light.type == Type::Spot                  ? check::Light::Kind::Spot
                                                : check::Light::Kind::Point;
  result.position = toCheck(light.position);
  result.direction = (toCheck(light.target) - result.position).normalized();
  result.coneAngleDegrees = light.coneAngleDegrees;
  return result;
}

/// The scene as the check's own reader reads it.
check::Scene checkSceneOf(const tool::Scene& scene)
{
  check::Scene result;
  result.camera = { toCheck(scene.camera.position), toCheck(scene.camera.target),
    toCheck(scene.camera.up), scene.camera.fovDegrees };
  for (const tool::SceneModel& model : scene.models)
  {
    vtkNew<vtkMatrix4x4> worldFromModel;
    worldFromModel->DeepCopy(model.matrix.data());
    check::Mesh mesh;
    check::addSurface(mesh, model.surface, worldFromModel);
    result.surfaces.push_back(
      { mesh.triangles, {}, {}, model.casts, model.receives, model.oneSided });
  }
  for (const tool::SceneProp& prop : scene.props)
  {
    check::Mesh mesh;
    addBalls(mesh, prop.make());
    result.surfaces.push_back({ mesh.triangles, {}, {} });
  }
  for (const tool::SceneLight& light : scene.lights)
  {
    result.lights.push_back(lightOf(light));
  }
  return result;
}

/// Return two unit vectors perpendicular to a direction and to each other.
std::array<Vec3, 2> across(const Vec3& direction)
{
  const Vec3 other = std::abs(direction.x) < 0.5 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
  const Vec3 first = direction.cross(other).normalized();
  return { first, direction.cross(first) };
}

double extentAlong(const check::Scene& scene, const Vec3& axis)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const check::Surface& surface : scene.surfaces)
  {
    for (const check::Triangle& triangle : surface.triangles)
    {
      for (const Vec3& corner : triangle)
      {
        low = std::min(low, corner.dot(axis));
        high = std::max(high, corner.dot(axis));
      }
    }
  }
  return high - low;
}

/// Return points of a disc. First rings of all sizes, which find most edges and small objects; then
/// a grid, which finds thin objects.
const std::vector<std::array<double, 2>>& discPoints()
{
  static const std::vector<std::array<double, 2>> points = []
  {
    std::vector<std::array<double, 2>> of;
    for (double radius = 1.0; radius > 1e-4; radius *= 0.75)
    {
      for (int i = 0; i < 16; ++i)
      {
        const double angle = 2.0 * vtkMath::Pi() * i / 16;
        of.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
      }
    }
    constexpr int half = 32;
    for (int y = -half; y <= half; ++y)
    {
      for (int x = -half; x <= half; ++x)
      {
        if (x * x + y * y <= half * half)
        {
          of.push_back({ static_cast<double>(x) / half, static_cast<double>(y) / half });
        }
      }
    }
    return of;
  }();
  return points;
}

} // namespace

Receiver receiverAt(const VisibilityImages& images, std::size_t pixel)
{
  const Vec3 origin(images.origin[0], images.origin[1], images.origin[2]);
  return { origin + Vec3(images.positionX[pixel], images.positionY[pixel], images.positionZ[pixel]),
    Vec3(images.normalX[pixel], images.normalY[pixel], images.normalZ[pixel]).normalized() };
}

Judge::Judge(const tool::Scene& scene)
  : scene_(checkSceneOf(scene))
  , tracer_(this->scene_)
{
  for (const tool::SceneModel& model : scene.models)
  {
    this->names_.push_back(model.name);
  }
  double size = 0.0;
  for (const Vec3& axis : { Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0) })
  {
    size = std::hypot(size, extentAlong(this->scene_, axis));
  }
  this->size_ = size;
  for (const check::Light& light : this->scene_.lights)
  {
    const auto [right, up] = across(light.direction);
    this->widths_.push_back(
      std::max(extentAlong(this->scene_, right), extentAlong(this->scene_, up)));
  }
}

Vec3 Judge::towards(const Receiver& receiver, std::size_t light) const
{
  const check::Light& of = this->scene_.lights[light];
  return of.kind == check::Light::Kind::Directional ? -of.direction
                                                    : of.position - receiver.positionWorld;
}

double Judge::cosineAt(const Receiver& receiver, std::size_t light) const
{
  return receiver.normal.dot(this->towards(receiver, light).normalized());
}

double Judge::texelAt(const Receiver& receiver, std::size_t light, int mapSizeTexels) const
{
  const check::Light& of = this->scene_.lights[light];
  if (of.kind == check::Light::Kind::Directional)
  {
    return this->widths_[light] / mapSizeTexels;
  }
  // Up to this cone a spot light has one view (lights/LightViews.h), beyond it a cube's.
  constexpr double singleViewDegrees = 60.0;
  const double tangent =
    of.kind == check::Light::Kind::Spot && of.coneAngleDegrees <= singleViewDegrees
    ? std::tan(vtkMath::RadiansFromDegrees(of.coneAngleDegrees))
    : 1.0;
  return 2.0 * tangent * this->towards(receiver, light).length() / mapSizeTexels;
}

double Judge::pixelAt(const Receiver& receiver, int height) const
{
  const check::Camera& camera = this->scene_.camera;
  const double tangent = std::tan(vtkMath::RadiansFromDegrees(0.5 * camera.fovDegrees));
  return 2.0 * tangent * (receiver.positionWorld - camera.position).length() / height;
}

bool Judge::isLit(const Receiver& receiver, std::size_t light, double offset) const
{
  const Receiver off{ receiver.positionWorld + offset * receiver.normal, receiver.normal };
  const Vec3 to = this->towards(off, light);
  check::Ray ray{ off.positionWorld, to.normalized() };
  if (this->scene_.lights[light].kind != check::Light::Kind::Directional)
  {
    ray.length = to.length();
  }
  return !this->tracer_.blocked(ray);
}

bool Judge::isNearEdge(const Receiver& receiver, std::size_t light, double distance) const
{
  const Vec3 direction = this->towards(receiver, light).normalized();
  const std::array<Vec3, 2> axes = across(direction);
  const double cosine = direction.dot(receiver.normal);
  const auto placeAt = [&](const std::array<double, 2>& at) -> Vec3
  {
    const Vec3 aside = distance * (at[0] * axes[0] + at[1] * axes[1]);
    return receiver.positionWorld + aside - (aside.dot(receiver.normal) / cosine) * direction;
  };
  const auto isLitAt = [&](const std::array<double, 2>& at) {
    return this->isLit({ placeAt(at), receiver.normal }, light, this->storedOffset());
  };
  const bool isLit = isLitAt({ 0.0, 0.0 });
  const auto& points = discPoints();
  // In the air beside a surface, shadows have no edge.
  return std::any_of(points.begin(), points.end(),
    [&](const std::array<double, 2>& at)
    { return isLitAt(at) != isLit && this->surfaceAt(placeAt(at), distance); });
}

std::optional<check::Hit> Judge::surfaceAt(const Vec3& position, double distance) const
{
  return this->tracer_.nearestTo(position, distance, [](const check::Triangle&) { return true; });
}

double Judge::offsetOf(const Receiver& receiver, const Vec3& origin, int height) const
{
  const std::optional<check::Hit> hit = this->surfaceAt(receiver.positionWorld, 1e-4 * this->size_);
  if (!hit)
  {
    throw std::runtime_error("a receiver that lies on no surface");
  }
  const check::Triangle& corners = this->scene_.surfaces[hit->surface].triangles[hit->triangle];
  glm::vec3 largest(0.0f);
  glm::vec3 extent(0.0f);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, 3> values;
    for (std::size_t k = 0; k < 3; ++k)
    {
      values[k] = corners[k][axis] - origin[axis];
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    largest[axis] = static_cast<float>(std::max(std::abs(*low), std::abs(*high)));
    extent[axis] = static_cast<float>(*high - *low);
  }
  const double doubleArea = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
  const glm::vec3 normal(receiver.normal.x, receiver.normal.y, receiver.normal.z);
  const auto footprint = static_cast<float>(this->pixelAt(receiver, height));
  return static_cast<double>(shadowRayOffset(
    planeNoise(normal, largest, extent, static_cast<float>(doubleArea)), footprint));
}

bool Judge::isOnFloor(const Receiver& receiver) const
{
  const std::optional<check::Hit> hit = this->surfaceAt(receiver.positionWorld, 1e-4 * this->size_);
  return hit && hit->surface < this->names_.size() &&
    (this->names_[hit->surface] == "floor" || this->names_[hit->surface] == "plane");
}

} // namespace gnomon::hard
