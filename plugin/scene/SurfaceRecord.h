#pragma once

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/Hash.h"
#include "plugin/scene/KeptInstances.h"
#include "plugin/scene/SurfaceExtraction.h"

#include "lights/Bounds.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
class vtkPolyData;
class vtkProp;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// What a surface is, from one frame to the next. The pointers name; they are not followed.
struct SurfaceKey
{
  const vtkProp* viewProp;
  std::size_t path;
  const vtkProp* actor; ///< who draws it
  bool translucent;
  const vtkPolyData* data;
  const vtkDataSet* glyphPoints;
  int glyphSource;
  SurfaceCells cells;

  bool operator==(const SurfaceKey& other) const
  {
    return this->viewProp == other.viewProp && this->path == other.path &&
      this->actor == other.actor && this->translucent == other.translucent &&
      this->data == other.data && this->glyphPoints == other.glyphPoints &&
      this->glyphSource == other.glyphSource && this->cells == other.cells;
  }
};

struct SurfaceKeyHash
{
  std::size_t operator()(const SurfaceKey& key) const
  {
    std::size_t seed = 0;
    hashCombine(seed, key.viewProp);
    hashCombine(seed, key.path);
    hashCombine(seed, key.actor);
    hashCombine(seed, key.translucent);
    hashCombine(seed, key.data);
    hashCombine(seed, key.glyphPoints);
    hashCombine(seed, key.glyphSource);
    hashCombine(seed, static_cast<int>(key.cells));
    return seed;
  }
};

/// What a surface's texture coordinates were read from. The array only names.
struct CoordinatesSource
{
  const vtkDataArray* array = nullptr; ///< null without a cut-out
  vtkMTimeType time = 0;
  glm::mat4 transform{ 1.0f };

  bool operator==(const CoordinatesSource& other) const
  {
    return this->array == other.array && this->time == other.time &&
      this->transform == other.transform;
  }
};
CoordinatesSource coordinatesSource(const DrawnProp& prop, const DrawnBlock& block);

/// What a surface's normals were read from. The array only names.
struct NormalsSource
{
  const vtkDataArray* array = nullptr; ///< null where they are not read
  vtkMTimeType time = 0;

  bool operator==(const NormalsSource& other) const
  {
    return this->array == other.array && this->time == other.time;
  }
};
NormalsSource normalsSource(const DrawnProp& prop, const DrawnBlock& block);

/// What is remembered of a surface beside its place in the snapshot.
struct SurfaceRecord
{
  SurfaceKey key;
  vtkMTimeType shapeTime = 0;
  glm::dmat4 worldFromModel{ 1.0 };
  std::vector<glm::dvec4> clipPlanes;
  glm::dvec4 radiusFromWorld{ 0.0 }; ///< of what is sized in pixels
  CoordinatesSource coordinates;
  NormalsSource normals;
  float facetHeight = 0.0f;                 ///< Surface::facetHeight, where the normals are
  std::vector<std::uint32_t> pointOfVertex; ///< as in DrawnTriangles, of one instance
  /// Where the polydata is drawn in its prop's model coordinates: once as it is, or as a glyph at
  /// any number of places.
  std::vector<glm::mat4> modelFromInstance{ glm::mat4(1.0f) };
  bool tooManyTriangles = false; ///< more than the bound, so that it has none
  /// Whether the snapshot keeps it as instances, of a source whose coordinates have their origin at
  /// this point of the polydata's.
  bool keptAsInstances = false;
  glm::dvec3 sourceCentre{ 0.0 };
  Bounds boundsSource;              ///< in source coordinates
  std::size_t leftOutNonFinite = 0; ///< instances, as in PlacedInstances
  std::size_t leftOutVanished = 0;
  std::vector<DroppedTriangle> dropped;
  Bounds boundsModel;
  Bounds boundsCentred;
};

/// A surface that was read from its polydata, and is not in the snapshot yet. Vertices count from
/// the surface's first.
struct FreshSurface
{
  SurfaceRecord record;
  std::size_t vertexCount = 0;               ///< of one instance
  std::vector<glm::vec3> positionsCentred;   ///< in source coordinates if it is kept as instances
  std::vector<glm::vec2> textureCoordinates; ///< as in Surface; of one instance until it is placed
  std::vector<glm::vec3> pointNormals;       ///< as in Surface
  PlacedInstances instances;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangleOfDrawn;
};

/// The box around the vertices that triangles use.
template <typename Triangle>
Bounds boundsOf(Triangle first, Triangle last, const glm::vec3* positions)
{
  Bounds bounds;
  for (; first != last; ++first)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      bounds.add(positions[(*first)[corner]]);
    }
  }
  return bounds;
}

/// The box around a transformed box.
Bounds transformed(const Bounds& box, const glm::dmat4& matrix);

/// When the shape of a surface last changed, or the instances that it is drawn as.
vtkMTimeType changeTime(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells);

/// Reads a surface from its polydata, without the positions; of glyphs, the source. These are to be
/// kept as instances where that is cheaper and no clipping planes cut them.
///
/// @param vertexOfPoint as for triangulate()
FreshSurface readSurface(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint);

/// Whether VTK draws a surface where its record says, and as large.
bool isWhere(const SurfaceRecord& record, const DrawnProp& prop, const DrawnBlock& block);

/// Computes a fresh surface's positions, and leaves out what the snapshot does not hold. Glyphs
/// that are not kept as instances, or cannot be, are expanded to the triangles of all of them.
void placeSurface(FreshSurface& fresh, const DrawnProp& prop, const DrawnBlock& block,
  const glm::dvec3& centreWorld);

/// Computes the matrices of the instances that a surface is kept as, where its record says that its
/// prop is; nothing as above.
std::optional<PlacedInstances> placeKeptInstances(
  const SurfaceRecord& record, const DrawnBlock& block, const glm::dvec3& centreWorld);

/// Takes over to a record where its instances are.
///
/// @param positionsSource the surface's vertices, as many as vertexCount
void recordPlaces(const PlacedInstances& placed, const glm::vec3* positionsSource,
  std::size_t vertexCount, SurfaceRecord& record);

/// Computes the centred positions of all instances of a surface, as many as its record has, where
/// its record says that its prop is.
void placeInstances(const DrawnBlock& block, const SurfaceRecord& record, std::size_t vertexCount,
  const glm::dvec3& centreWorld, glm::vec3* positionsCentred);

} // namespace gnomon
