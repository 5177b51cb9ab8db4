#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

class ShaderLibrary;

/// The receivers stage's images (ReceiverTarget.h).
struct ReceiverTextures
{
  GLuint fragments = 0;
  GLuint points = 0;
  int width = 0;  ///< in pixels
  int height = 0; ///< in pixels
};

/// Fits a light's views to the receivers that the camera sees, on the GPU; nothing of it is read
/// back.
///
/// A reduction over the receivers' images finds their bounds in each view; for splits, first their
/// distances from the camera, which say where to split (Sample Distribution Shadow Maps, Lauritzen,
/// Salvi, Lefohn 2011, section 3.1). Background, points that are not finite, and receivers that the
/// light does not reach, or that lie where there are no casters, do not count. From the bounds
/// follows the last fit F of each view (MapFit.h), which stays in a texture, for whoever draws and
/// reads the map.
///
/// Of a view that chooses its warp (LightView::warps), that comes first: the one under which texels
/// are the smallest on the mean over what is seen, on pixels of a grid all over the picture. What
/// counts is the mean of both sides that a texel has after the last fit, in world units across the
/// light. The reason: edges of shadows are as long as what is seen is far, in the world, so that a
/// pixel has as many of them as it is far; and an edge makes the wronger pixels the larger its
/// texels look, which is less the farther it is. Both distances cancel. The published optimum of
/// LiSPSM, the least of the worst texel, leaves a quarter more wrong pixels in views along the
/// ground.
///
/// A view without receivers gets an F that draws and finds nothing: what could be shadowed there,
/// is not seen.
class ReceiverFit
{
public:
  /// @param views that await their fit
  /// @param centredFromView the camera's rigid transformation from view to centred coordinates
  void compute(const ShadowLight& light, const LightViews& views, const ReceiverTextures& receivers,
    const glm::dmat4& centredFromView, ShaderLibrary& shaders);

  /// The fits: a column per view (fit_rows.glsl).
  TextureBinding fits() const { return { GL_TEXTURE_2D, this->fits_.name() }; }

  /// A box per view, of the receivers in it: x and y in texels before the fit, z the distance along
  /// the view (bounds_buffer.glsl).
  GLuint bounds() const { return this->bounds_.name(); }
  /// The mean sides of texels that a warp was chosen by, one per warp of the view.
  GLuint texelSides() const { return this->sides_.name(); }

private:
  void allocate(int views, int rows);
  void chooseWarp(const ShadowLight& light, const LightView& view, std::vector<Uniform> uniforms,
    ShaderLibrary& shaders);

  GlBuffer bounds_;
  GlTexture fits_;
  int views_ = 0;
  int rows_ = 0;

  GlTexture warps_;
  GlBuffer sides_; ///< of the texels under each of them
};

/// The mean side of the texels under a warp, as a share of that under the uniform map, up to which
/// the warp is worth it: its texels move with the camera, and a mean over a grid is no more than
/// that.
constexpr double largestSideShare = 0.95;

/// What a view's column says of a warp that is chosen, from the row on that follows the fits
/// (fit_rows.glsl).
/// @param mapFromAcross one of the view's warps
std::vector<glm::vec4> chosenWarpRows(
  const LightView& view, const glm::dmat3& mapFromAcross, int sizeTexels);

} // namespace gnomon
