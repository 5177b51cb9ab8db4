#include "lights/LightSpace.h"

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon
{
namespace
{

/// Return the rotation whose rows are these orthogonal unit vectors.
glm::dmat4 rotationOnto(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z)
{
  return glm::dmat4(glm::transpose(glm::dmat3(x, y, z)));
}

} // namespace

glm::dmat4 lightFromCentred(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  const glm::dvec3& z = light.directionWorld;
  const glm::dvec3 origin = centreWorld - light.positionWorld;
  if (light.kind == LightKind::Point)
  {
    return glm::translate(glm::dmat4(1.0), origin);
  }
  if (light.box)
  {
    const glm::dvec3 x = glm::normalize(glm::cross(light.box->upWorld, z));
    return glm::translate(rotationOnto(x, glm::cross(z, x), z), origin);
  }
  // The least aligned axis leaves no direction degenerate.
  const glm::dvec3 x = glm::normalize(glm::cross(axisAcross(z), z));
  const glm::dmat4 rotation = rotationOnto(x, glm::cross(z, x), z);
  return light.kind == LightKind::Directional ? rotation : glm::translate(rotation, origin);
}

glm::dvec4 nearFaceCentred(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  return { light.directionWorld,
    -glm::dot(light.directionWorld, light.positionWorld - centreWorld) };
}

glm::dvec3 axisAcross(const glm::dvec3& direction)
{
  const glm::dvec3 magnitude = glm::abs(direction);
  if (magnitude.x <= magnitude.y && magnitude.x <= magnitude.z)
  {
    return { 1.0, 0.0, 0.0 };
  }
  return magnitude.y <= magnitude.z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
}

int cubeFaceOf(const glm::dvec3& positionLight)
{
  const glm::dvec3 length = glm::abs(positionLight);
  int axis = length.x >= length.y ? 0 : 1;
  axis = length[axis] >= length.z ? axis : 2;
  return 2 * axis + (positionLight[axis] >= 0.0 ? 0 : 1);
}

glm::dmat3 cubeFaceFromLight(int face)
{
  const int axis = face / 2;
  const double sign = face % 2 == 0 ? 1.0 : -1.0;
  // The other two axes, swapped for a mirrored axis so that the matrix stays a rotation.
  const int first = (axis + (sign > 0.0 ? 1 : 2)) % 3;
  const int second = 3 - axis - first;
  glm::dmat3 rows(0.0);
  rows[0][first] = 1.0;
  rows[1][second] = 1.0;
  rows[2][axis] = sign;
  return glm::transpose(rows);
}

} // namespace gnomon
