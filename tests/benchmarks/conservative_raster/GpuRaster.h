#ifndef gnomon_tests_benchmarks_GpuRaster_h
#define gnomon_tests_benchmarks_GpuRaster_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::test
{

/// @file
/// Conservative rasterisation by OpenGL, in the ways that it has, of what `crsm` asks of triangles.

/// The ways.
enum class RasterPath
{
  GeometryShader,   ///< vertices through the pipeline, a rectangle per triangle
  PulledRectangles, ///< triangles fetched by their number, a rectangle each
  PulledTriangles,  ///< the same, a larger triangle each
  Compute,          ///< an invocation for a small triangle, work groups for a large one
  Extension         ///< GL_NV_conservative_raster or GL_INTEL_conservative_rasterization
};

const std::vector<RasterPath>& allRasterPaths();
const char* nameOf(RasterPath path);

/// Why the current context cannot draw in that way; empty where it can.
std::string whyUnsupported(RasterPath path);

/// Two depths of a texel, of which each is infinite where no triangle gives one.
struct TexelDepths
{
  float nearest; ///< no triangle has less in the texel
  float
    contained; ///< the least, over triangles that contain the texel, of no less than their greatest
};

/// Draws triangles into a square map. A texel that any of them touches has a finite `nearest`, and none
/// has a finite `contained` that no triangle contains. cover.glsl says why.
class GpuRaster
{
public:
  /// A context must be current, here and in all that follows.
  /// @throws std::invalid_argument where the path is not supported
  explicit GpuRaster(RasterPath path);

  /// Brings the triangles to the GPU. They may be degenerate.
  /// @throws std::invalid_argument for coordinates that are not finite
  void send(
    const std::vector<glm::vec3>& positionsCentred, const std::vector<glm::uvec3>& triangles);

  /// Draws them all, and reads the map back, row by row.
  /// @param mapFromCentred to (X, Y, Q, W): texels X/W and Y/W from the map's corner, depth Q/W; W <= 0 behind the light
  /// @param marginTexels by which all texels count as larger, on each side
  void draw(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
    std::vector<TexelDepths>& texels);

private:
  void setUniforms(
    GLuint program, const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels) const;
  void drawShapes(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
    std::vector<TexelDepths>& texels);
  void compute(const glm::dmat4& mapFromCentred, int sizeTexels, double marginTexels,
    std::vector<TexelDepths>& texels);
  GLuint computeProgram(bool large);
  GLuint shapesProgram();

  RasterPath path_;
  ShaderLibrary shaders_;
  glm::dvec3 largestCentred_{ 0.0 }; ///< of each coordinate's sizes
  std::size_t triangleCount_ = 0;
  GlBuffer positions_, triangles_;
  GlVertexArray vertexArray_;
  ///@{ What is drawn into: a texture, or buffers.
  GlTexture depths_;
  GlFramebuffer framebuffer_;
  GlBuffer minima_, large_;
  ///@}
};

} // namespace gnomon::test

#endif
