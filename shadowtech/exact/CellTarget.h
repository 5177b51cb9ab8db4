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
/// The cells of a conservative map on the GPU.

/// Some rows of a map on the GPU. While one of these is alive OpenGL's state is its own; it is put
/// back in the end.
class CellTarget
{
public:
  /// Why the current context cannot draw them, as a clause; empty where it can.
  static std::string whyUnsupported();

  /// Empty cells.
  /// @throws TextureMemoryError where there is no room, std::runtime_error where OpenGL fails; so
  /// does all that follows: what was not drawn would pass for lit
  CellTarget(ShaderLibrary& shaders, int width, Span rows);

  /// How many rows OpenGL takes at once; one at least.
  /// @param mostBytes that their cells may take
  static int mostRows(int width, std::size_t mostBytes);

  /// Draws edges.
  void draw(const SegmentBatch& batch);
  /// Spoils texels.
  void spoil(const TriangleBatch& batch);
  /// Draws triangles.
  void draw(const TriangleBatch& batch);
  void draw(const RingBatch& batch);
  /// Notes the noise of triangles.
  void drawNoise(const TriangleBatch& batch);
  /// To be called between edges and what spoils texels, triangles, and their noise: each looks at
  /// what was drawn before.
  void endPass();

  /// Reads the cells, row by row.
  /// @param take told of each, from several threads, with its number among these rows
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
