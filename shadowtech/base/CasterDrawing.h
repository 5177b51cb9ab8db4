#ifndef gnomon_shadowtech_base_CasterDrawing_h
#define gnomon_shadowtech_base_CasterDrawing_h

#include "shadowtech/base/Technique.h"

#include <string>
#include <vector>

namespace gnomon
{

/// Makes OpenGL ready to draw casters into a framebuffer's layers of this size. A GlStateGuard is the
/// caller's business.
void beginCasters(GLuint framebuffer, int sizeTexels);

/// Draws the casters, as one view sees them, into what is attached to the framebuffer.
///
/// What a texel holds is the fragment shader's business. It is built with PERSPECTIVE or WARPED for
/// such views. With DEPTH_LINEAR among its defines it gets the map's linear depth as
/// `in float depthLinear`; the depth buffer has that by itself only where LightView::depthIsAffine.
/// Of warped views it may ask for `uniform vec3 texelScale`: a texel's size across the light is
/// texelScale times (texel, 1), squared.
/// Casters with holes are drawn by a shader of their own: main() ends with discardHoles() (cutout.glsl).
/// @param fragmentGlsl the fragment shader's source
void drawCasters(const LightView& view, const MapInput& input, const std::string& fragmentGlsl,
  std::vector<std::string> defines);

/// The uniform of map_visibility.glsl that says what rounding does to the depths that are compared.
/// @param followed how many times farther than to its own texel a receiver's plane is followed
Uniform depthSlacks(double followed = 1.0);

} // namespace gnomon

#endif
