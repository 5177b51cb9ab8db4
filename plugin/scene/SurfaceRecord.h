#pragma once

#include "lights/Hash.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/KeptInstances.h"
#include "plugin/scene/SheetReading.h"
#include "plugin/scene/SurfaceExtraction.h"
#include "shadowtech/base/Patches.h"

#include "lights/Bounds.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
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

/// A surface's identity from frame to frame. The pointers are never dereferenced.
struct SurfaceKey
{
  const vtkProp* viewProp;
  std::size_t path;
  const vtkProp* actor; ///< the actor that draws it
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

/// @param prop the view prop's number in vtkRenderer::GetViewProps()
inline SharedName sharedName(int prop, const SurfaceKey& key)
{
  return { prop, static_cast<std::int64_t>(key.path), key.glyphSource,
    static_cast<std::int64_t>(key.cells) };
}

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

/// Source of a surface's texture coordinates. The array is never dereferenced.
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

/// Source of a surface's normals. The array is never dereferenced.
struct NormalsSource
{
  const vtkDataArray* array = nullptr; ///< null if they are not read
  vtkMTimeType time = 0;

  bool operator==(const NormalsSource& other) const
  {
    return this->array == other.array && this->time == other.time;
  }
};
NormalsSource normalsSource(const DrawnProp& prop, const DrawnBlock& block);

/// A value that nearly always is the default one, which takes no memory.
template <typename Value>
class Seldom
{
public:
  Seldom& operator=(const Value& value)
  {
    this->other_ = value == Value() ? nullptr : std::make_unique<const Value>(value);
    return *this;
  }
  const Value& get() const
  {
    static const Value usual;
    return this->other_ ? *this->other_ : usual;
  }

private:
  std::unique_ptr<const Value> other_;
};

/// A surface's cached state beside its triangles in the snapshot.
struct SurfaceRecord
{
  SurfaceKey key;
  vtkMTimeType shapeTime = 0;
  glm::dmat4 worldFromModel{ 1.0 };
  std::vector<glm::dvec4> clipPlanes;
  glm::dvec4 radiusFromWorld{ 0.0 }; ///< of solids sized in pixels
  Seldom<CoordinatesSource> coordinates;
  NormalsSource normals;
  Seldom<SheetSource> sheet;
  float facetHeight = 0.0f;                 ///< Surface::facetHeight, in the normals' coordinates
  std::vector<std::uint32_t> pointOfVertex; ///< as in DrawnTriangles, of one instance
  /// The places of the polydata in its prop's model coordinates: one as it is, any number as a
  /// glyph.
  std::vector<glm::mat4> modelFromInstance{ glm::mat4(1.0f) };
  bool tooManyTriangles = false; ///< more than the bound, so it has none
  /// Of a glyph that the snapshot may hold as instances: the source's triangles, and the instances
  /// in all processes that draw the picture. 0: it may not.
  std::size_t trianglesOfSource = 0;
  std::size_t instancesOfAll = 0;
  bool keptAsInstances = false;     ///< true if the snapshot holds it as instances of a source
  SceneFrame source;                ///< of source coordinates in the polydata's
  Bounds boundsSource;              ///< in source coordinates
  std::size_t leftOutNonFinite = 0; ///< instances, as in PlacedInstances
  std::size_t leftOutVanished = 0;
  std::vector<DroppedTriangle> dropped;
  Bounds boundsModel;  ///< as in DrawnTriangles, of all instances
  bool hasFar = false; ///< likewise
  Bounds boundsCentred;
};

/// A surface that was read from its polydata and is not in the snapshot yet. Vertices count from
/// the surface's first.
struct FreshSurface
{
  SurfaceRecord record;
  std::size_t vertexCount = 0;               ///< of one instance
  std::vector<glm::vec3> positionsCentred;   ///< in source coordinates if held as instances
  std::vector<glm::vec2> textureCoordinates; ///< as in Surface; of one instance until it is placed
  std::vector<glm::vec3> pointNormals;       ///< as in Surface
  PlacedInstances instances;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangleOfDrawn;
};

/// Return the box around the vertices that triangles use.
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

/// Return the box around a transformed box.
Bounds transformed(const Bounds& box, const glm::dmat4& matrix);

/// Return when the shape of a surface, or its instances, last changed.
vtkMTimeType changeTime(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells);

/// Read a surface from its polydata, without the positions. For glyphs, read the source. Glyphs are
/// held as instances if that is cheaper and no clipping planes cut them.
///
/// @param vertexOfPoint as for triangulate()
FreshSurface readSurface(const DrawnProp& prop, const DrawnBlock& block, SurfaceCells cells,
  std::vector<std::uint32_t>& vertexOfPoint);

/// True if a surface's box depends on its prop's matrix, as points may lie beyond largestOfWorld.
bool reachesBeyondWorld(const SurfaceRecord& record, const DrawnProp& prop);

/// True if VTK draws a surface at the place and in the size of its record.
bool isWhere(const SurfaceRecord& record, const DrawnProp& prop, const DrawnBlock& block);

/// Compute a fresh surface's positions, and remove triangles that the snapshot does not hold.
/// Glyphs that are not, or cannot be, held as instances are expanded to the triangles of all of
/// them.
void placeSurface(
  FreshSurface& fresh, const DrawnProp& prop, const DrawnBlock& block, const SceneFrame& frame);

/// Compute the matrices of a surface's instances from its record's place. Nothing if rays and maps
/// cannot use them (KeptInstances.h).
std::optional<PlacedInstances> placeKeptInstances(
  const SurfaceRecord& record, const DrawnBlock& block, const SceneFrame& frame);

/// Store the places of a surface's instances in its record.
///
/// @param positionsSource the surface's vertices, as many as vertexCount
void recordPlaces(const PlacedInstances& placed, const glm::vec3* positionsSource,
  std::size_t vertexCount, SurfaceRecord& record);

/// Compute the centred positions of all instances in a surface's record, from the record's place.
void placeInstances(const DrawnBlock& block, const SurfaceRecord& record, std::size_t vertexCount,
  const SceneFrame& frame, glm::vec3* positionsCentred);

} // namespace gnomon
