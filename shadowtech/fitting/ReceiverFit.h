#ifndef gnomon_shadowtech_fitting_ReceiverFit_h
#define gnomon_shadowtech_fitting_ReceiverFit_h

#include "lights/Bounds.h"
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

/// Fits a light's views to the receivers that the camera sees, on the GPU; nothing of it is read back.
///
/// A reduction over the receivers' images finds their bounds in each view; for splits, first their
/// distances from the camera, which say where to split (Sample Distribution Shadow Maps, Lauritzen,
/// Salvi, Lefohn 2011, section 3.1). Background, points that are not finite, and receivers that the
/// light does not reach, or that lie where there are no casters, do not count. From the bounds follows
/// the last fit F of each view (MapFit.h), which stays in a texture, for whoever draws and reads the
/// map.
///
/// A view without receivers gets an F that draws and finds nothing: what could be shadowed there, is
/// not seen.
class ReceiverFit
{
public:
  /// @param views that await their fit
  /// @param centredFromView the camera's rigid transformation from view to centred coordinates
  void compute(const ShadowLight& light, const LightViews& views, const ReceiverTextures& receivers,
    const glm::dmat4& centredFromView, ShaderLibrary& shaders);

  /// The fits: a texel per view, in two rows (fit_views.comp.glsl).
  TextureBinding fits() const { return { GL_TEXTURE_2D, this->fits_.name() }; }

  /// Reads back the bounds of the receivers in each view, as of the last compute(): x and y in
  /// texels before the fit, z the distance along the view. Waits for the GPU.
  std::vector<Bounds> readBounds() const;
  /// The same of the fits.
  std::vector<MapFit> readFits() const;

private:
  void allocate(int views);

  GlBuffer bounds_;
  GlTexture fits_;
  int views_ = 0;
};

} // namespace gnomon

#endif
