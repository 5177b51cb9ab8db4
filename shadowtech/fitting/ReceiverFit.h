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

/// Fits a light's views to the receivers that the camera sees, on the GPU, without reading back.
///
/// A reduction over the receivers' images finds their bounds in each view. For splits it first
/// finds their distances from the camera, which set the splits (Sample Distribution Shadow Maps,
/// Lauritzen, Salvi, Lefohn 2011, section 3.1). Excluded are background, points that are not
/// finite, and receivers that the light does not reach or that lie where there are no casters. The
/// bounds give the last fit F of each view (MapFit.h), which stays in a texture for baking and
/// reading the map.
///
/// A view that chooses its warp (LightView::warps) first takes the warp with the smallest mean
/// texels on the receivers, on pixels of a grid all over the picture. The measure is the mean of
/// both sides that a texel has after the last fit, in world units across the light. It needs no
/// weights, because two distances cancel. The world's length of shadow edges in a pixel grows with
/// the pixel's distance. An edge makes more pixels wrong the larger its texels look, which is less
/// the farther it is. The published optimum of LiSPSM, the smallest worst texel, leaves a quarter
/// more wrong pixels in views along the ground.
///
/// A view without receivers gets an F that puts everything off the map: nothing that could be
/// shadowed there is visible.
class ReceiverFit
{
public:
  /// Compute the fits of views.
  /// @param views that await their fit
  /// @param centredFromView the camera's rigid transformation from view to centred coordinates
  void compute(const ShadowLight& light, const LightViews& views, const ReceiverTextures& receivers,
    const glm::dmat4& centredFromView, ShaderLibrary& shaders);

  /// Return the fits: a column per view (fit_rows.glsl).
  TextureBinding fits() const { return { GL_TEXTURE_2D, this->fits_.name() }; }

  /// Return a box per view around its receivers: x and y in texels before the fit, z the distance
  /// along the view (bounds_buffer.glsl).
  GLuint bounds() const { return this->bounds_.name(); }
  /// Return the mean sides of texels that decided the warp, one per warp of the view.
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
  GlBuffer sides_; ///< mean side of the texels under each warp
};

/// The largest mean side of texels under a warp, as a share of that under the uniform map, for
/// which the warp is chosen. Below 1, because a warp's texels move with the camera, and a mean over
/// a grid is only an estimate.
constexpr double largestSideShare = 0.95;

/// Return the rows of a view's column for a chosen warp, which follow the rows of the fits
/// (fit_rows.glsl).
/// @param mapFromAcross one of the view's warps
std::vector<glm::vec4> chosenWarpRows(
  const LightView& view, const glm::dmat3& mapFromAcross, int sizeTexels);

} // namespace gnomon
