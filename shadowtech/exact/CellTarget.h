#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/exact/CellBatches.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace gnomon
{

/// @file
/// Cells of a conservative map on the GPU.

/// Some rows of a conservative map on the GPU. While an object lives, it changes OpenGL's state;
/// its destructor restores it.
class CellTarget
{
public:
  /// Return why the current context cannot bake the cells, as a clause; empty if it can.
  static std::string whyUnsupported();

  /// Allocate empty cells.
  /// @throws TextureMemoryError without enough memory, std::runtime_error if OpenGL fails. All
  /// other functions throw these, too, because missing casters would pass for lit.
  CellTarget(ShaderLibrary& shaders, int width, Span rows);

  /// Return how many rows OpenGL can hold at once, at least one.
  /// @param mostBytes limit for the cells of these rows
  static int mostRows(int width, std::size_t mostBytes);

  /// Rasterize edges.
  void draw(const SegmentBatch& batch);
  /// Leave all texels that the triangles touch undecided.
  void spoil(const TriangleBatch& batch);
  /// Rasterize triangles, or rings of them.
  void draw(const TriangleBatch& batch);
  void draw(const RingBatch& batch);
  /// Gather the noise of triangles.
  void drawNoise(const TriangleBatch& batch);
  /// Separate passes that read results of earlier ones. Call it after edges and spoil(), after
  /// triangles, and after noise.
  void endPass();

  /// Read the cells back, row by row.
  /// @param take called with each cell and its number among these rows, from several threads
  void read(const std::function<void(std::size_t texel, const Cell& cell)>& take);

private:
  void send(const PolygonBatch& polygons);
  void walk(const RowWalks& walks, const char* shader, std::vector<std::string> defines);
  void walkPolygons(const TriangleBatch& batch, std::vector<std::string> defines);
  void requireNoError() const;

  const GlStateGuard state_;
  const StorageBindingsGuard bindings_;
  ShaderLibrary& shaders_;
  int width_;
  Span rows_;
  GlBuffer polygons_, sides_, segments_, cells_, walks_, rings_;
};

} // namespace gnomon
