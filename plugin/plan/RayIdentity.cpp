#include "plugin/plan/RayIdentity.h"

#include "lights/Hash.h"

namespace gnomon
{
namespace
{

template <typename Vector>
void hashVector(std::size_t& seed, const Vector& vector)
{
  for (int i = 0; i < vector.length(); ++i)
  {
    hashCombine(seed, vector[i]);
  }
}

template <typename Matrix>
void hashColumns(std::size_t& seed, const Matrix& matrix)
{
  for (int column = 0; column < matrix.length(); ++column)
  {
    hashVector(seed, matrix[column]);
  }
}

} // namespace

RayIdentity identityOf(const ShadowLight& light)
{
  RayIdentity identity;
  std::size_t& seed = identity.centre;
  hashCombine(seed, static_cast<int>(light.kind));
  hashVector(seed, light.positionWorld);
  hashVector(seed, light.directionWorld);
  hashCombine(seed, light.coneAngleDegrees);
  if (light.box)
  {
    hashVector(seed, glm::dvec3(light.box->width, light.box->height, light.box->depth));
    hashVector(seed, light.box->upWorld);
  }
  if (light.texture)
  {
    hashCombine(seed, light.texture->texture.get());
    hashColumns(seed, light.texture->pictureFromWorld);
  }
  if (light.area)
  {
    hashCombine(identity.area, static_cast<int>(light.area->shape));
    hashColumns(identity.area, light.area->worldFromUnit);
  }
  return identity;
}

} // namespace gnomon
