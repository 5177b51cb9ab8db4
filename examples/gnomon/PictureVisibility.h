#pragma once

#include "Pictures.h"
#include "Scene.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon::tool
{

/// Return visibility as the quotient of pictures of white, diffuse, flat surfaces under one light:
/// the share of light that the shadows leave; NaN if no light arrives.
///
/// A picture has only 8 bits and saturates at white, so several exposures go from dark to bright.
/// Each pixel uses the brightest exposure that is not white without shadows. Values above 1 (some
/// passes brighten) count as 1.
/// @param lit, shadowed the exposures without and with shadows
/// @param colour channel of the pictures: 0 red, 1 green, 2 blue
std::vector<float> visibilityFromPictures(
  const std::vector<Picture>& lit, const std::vector<Picture>& shadowed, std::size_t colour);

/// The result of measureVisibility().
struct PictureVisibility
{
  /// The truth's positions, normals and coverage with the measured visibility.
  VisibilityImages images;
  std::int64_t unreadable = 0; ///< pixels that count but cannot be measured
};

/// Measure, from pictures, the visibility that `addShadows` gives a scene. This serves renderers
/// that shade with visibility but do not export it. For each light of the truth, the scene is
/// rendered with white surfaces and only this light. Translucent models are left out.
///
/// VTK shades some pixels black although facingPixels() counts them: the light grazes them, and
/// both disagree on the side. Such pixels cannot be measured and get the truth's visibility.
///
/// @param addShadows adds shadows to a new renderer; called once per light
PictureVisibility measureVisibility(const Scene& scene, const VisibilityImages& truth,
  const std::function<void(vtkRenderer*)>& addShadows);

} // namespace gnomon::tool
