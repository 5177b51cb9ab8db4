#ifndef gnomon_shadowtech_conservative_CellTarget_h
#define gnomon_shadowtech_conservative_CellTarget_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/conservative/TexelCells.h"
#include "shadowtech/conservative/TexelShapes.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gnomon
{

/// @file
/// The cells of a conservative map on the GPU, and what is drawn into them there.

/// How the texels are found that a triangle may touch. Which of them it does touch, all ways ask alike.
enum class CellPath
{
  Compute,    ///< an invocation walks its rows, or one of them where there are many texels
  Rasterised, ///< a larger triangle is drawn, and each fragment asks for its texel
  /// The same, but for the half texel that GL_NV_conservative_raster or GL_INTEL_conservative_rasterization adds.
  Extension
};
const char* nameOf(CellPath path);

/// Why the current context cannot draw in that way, as a clause; empty where it can.
std::string whyUnsupported(CellPath path);

/// Who walks which rows of what is drawn by compute shaders.
struct RowWalks
{
  ///@{ The number of a shape and a row of it.
  std::vector<glm::uvec2> ofShapes; ///< an invocation walks all that follow
  std::vector<glm::uvec2> ofRows;   ///< those of a work group walk a row each
  ///@}

  /// @param columns how many the shape has, about
  void add(std::size_t shape, Span rows, double columns);
};

/// What a part of the rows of a map is drawn from on the GPU: polygons.
struct PolygonBatch
{
  std::vector<PolygonRecord> records;
  std::vector<SideRecord> sides;

  std::size_t add(const PolygonOnTexels& polygon);
};

/// Edges.
struct SegmentBatch
{
  std::vector<SegmentRecord> records;
  RowWalks walks;

  void draw(const SegmentOnTexels& segment);
};

/// Triangles, of which some spoil texels.
struct TriangleBatch
{
  PolygonBatch polygons;
  RowWalks walks;
  std::vector<glm::vec2> placesClip; ///< three corners each of what is rasterised instead

  /// @param path nothing is rasterised by Compute
  void draw(const MapPolygon& polygon, double margin, int width, Span rows, CellPath path);
};

/// Which polygons are a ring, the middle first, and which edges are around it.
struct RingRecord
{
  std::uint32_t firstPolygon, polygonCount;
  std::uint32_t firstSegment, segmentCount;
};
static_assert(sizeof(RingRecord) == 16, "as shaders read it");

/// Parts of the casters' surface.
struct RingBatch
{
  PolygonBatch polygons;
  std::vector<SegmentRecord> borders;
  std::vector<RingRecord> records;
  RowWalks walks;

  void draw(const MapRing& ring, double margin, Span rows);
};

/// A triangle around a polygon: a fragment of each texel that it meets comes from it.
/// @param reach how far from the polygon centres of such texels, or where OpenGL finds all texels that it touches their places,
/// may be, in x and in y, in texels
/// @return its corners, in clip coordinates of those rows
std::array<glm::vec2, 3> shapeAround(const MapPolygon& polygon, double reach, int width, Span rows);

/// Some rows of a map on the GPU. While one of these is alive OpenGL's state is its own; it is put back in the end.
class CellTarget
{
public:
  /// Empty cells.
  /// @throws TextureMemoryError where there is no room
  CellTarget(ShaderLibrary& shaders, CellPath path, int width, Span rows);

  /// How many rows OpenGL takes at once; one at least.
  /// @param mostBytes that their cells may take
  static int mostRows(int width, std::size_t mostBytes);

  /// Draws edges.
  /// @throws TextureMemoryError
  void draw(const SegmentBatch& batch);
  /// Spoils texels.
  /// @throws TextureMemoryError
  void spoil(const TriangleBatch& batch);
  /// To be called between edges and what spoils texels, and triangles: what lies behind an end does not count for how far
  /// they climb.
  void endEdges();
  /// Draws triangles.
  /// @throws TextureMemoryError
  void draw(const TriangleBatch& batch);
  /// @throws TextureMemoryError
  void draw(const RingBatch& batch);

  /// Reads the cells, row by row.
  /// @param take told of each, from several threads, with its number among these rows
  void read(const std::function<void(std::size_t texel, const Cell& cell)>& take);

private:
  void send(const PolygonBatch& polygons);
  void walk(const RowWalks& walks, const char* shader, std::vector<std::string> defines);
  void rasterise(const TriangleBatch& batch);
  void use(GLuint program) const;

  const GlStateGuard state_;
  const StorageBindingsGuard bindings_;
  ShaderLibrary& shaders_;
  CellPath path_;
  int width_;
  Span rows_;
  GlBuffer polygons_, sides_, segments_, cells_, walks_, rings_;
  GlBuffer places_;
  GlVertexArray vertexArray_;
  GlFramebuffer framebuffer_;
};

} // namespace gnomon

#endif
