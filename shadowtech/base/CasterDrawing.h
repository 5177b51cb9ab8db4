#pragma once

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// Depths are compared with this slack, as a share of the map's depth range: four roundings of a
/// float (2^-24) in the transformations on either side, and as much again for the rasteriser.
constexpr float roundingSlack = 1.0f / (1 << 20);

/// What casters are drawn with.
struct CasterShader
{
  std::string fragmentGlsl; ///< the source
  std::vector<std::string> defines;
  std::vector<Uniform> uniforms = {};
  bool backOnly = false; ///< of two-sided surfaces, only the side that faces away
};

/// How casters become a picture: of what a view of the light sees, or of their shadows.
struct CasterPicture
{
  glm::dmat4 clipFromCentred{ 1.0 };
  /// Planes (n, d) in centred coordinates: what has n.p + d < 0 is clipped away. At most two.
  std::vector<glm::dvec4> keptFromCentred;
  CasterSelection selection;
};

/// Makes OpenGL ready to draw casters into a framebuffer's layers of this size. A GlStateGuard is
/// the caller's business.
void beginCasters(GLuint framebuffer, int sizeTexels);

/// Draws the casters into what is attached to the bound framebuffer. Those with holes are drawn by
/// a shader of their own: main() ends with discardHoles() (cutout.glsl).
void drawCasters(const CasterPicture& picture, const OccluderBuffers& buffers,
  ShaderLibrary& shaders, CasterShader shader);

/// Draws the casters, as the view of this number sees them, into what is attached to the
/// framebuffer.
///
/// What a texel holds is the fragment shader's business. It is built with PERSPECTIVE or WARPED for
/// such views. With DEPTH_LINEAR among its defines it gets the map's linear depth as
/// `in float depthLinear`; the depth buffer has that by itself only where LightView::depthIsAffine.
/// Where it is across the light, caster_map.glsl tells. The last fit of views that await it
/// (MapInput::viewFits) is applied here and there, and so is a warp that was chosen.
void drawCasters(std::size_t number, const MapInput& input, CasterShader shader);

/// The uniform of map_visibility.glsl that says what rounding does to the depths that are compared.
/// @param followed how many times farther than to its own texel a receiver's plane is followed
Uniform depthSlacks(double followed = 1.0);

} // namespace gnomon
