#pragma once

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

/// The slack of depth comparisons, as a share of the map's depth range. It covers four roundings of
/// a float (2^-24) in the transformations on either side, and as much again for the rasteriser.
constexpr float roundingSlack = 1.0f / (1 << 20);

/// The fragment shader that casters are drawn with.
struct CasterShader
{
  std::string fragmentGlsl; ///< the source
  std::vector<std::string> defines;
  std::vector<Uniform> uniforms = {};
  bool backOnly = false; ///< draw only the far side of two-sided surfaces
};

/// How casters are projected into a picture: into a light's view, or as shadows onto a plane.
struct CasterPicture
{
  glm::dmat4 clipFromCentred{ 1.0 };
  /// Planes (n, d) in centred coordinates that clip away n.p + d < 0. At most two.
  std::vector<glm::dvec4> keptFromCentred;
  CasterSelection selection;
};

/// Prepare OpenGL to draw casters into a framebuffer's layers of this size. The caller holds a
/// GlStateGuard.
void beginCasters(GLuint framebuffer, int sizeTexels);

/// Draw the casters into the attachments of the bound framebuffer. Casters with holes have their
/// own variant of the shader, so main() must end with discardHoles() (cutout.glsl).
void drawCasters(const CasterPicture& picture, const OccluderBuffers& buffers,
  ShaderLibrary& shaders, CasterShader shader);

/// Draw the casters as a view sees them into the framebuffer's attachments.
///
/// The fragment shader decides what a texel holds. It is compiled with PERSPECTIVE or WARPED for
/// such views. If its defines have DEPTH_LINEAR, it reads the map's linear depth as `in float
/// depthLinear`; the depth buffer is linear only if LightView::depthIsAffine. caster_map.glsl gives
/// the fragment's place across the light. This function and caster_map.glsl apply the fit that was
/// found on the GPU (MapInput::viewFits), and the chosen warp.
///
/// @param number the view's index in MapInput::views
void drawCasters(std::size_t number, const MapInput& input, CasterShader shader);

/// Return the uniform of map_visibility.glsl with the rounding of compared depths.
/// @param followed how far a receiver's plane is followed, in units of the distance to its own
/// texel
Uniform depthSlacks(double followed = 1.0);

} // namespace gnomon
