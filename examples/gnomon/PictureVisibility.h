#pragma once

#include "ImageFile.h"
#include "Scene.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include "lights/vtkGnomonVersions.h"

#include <cstdint>
#include <functional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// Two pictures of the same white, unspecular, flat surfaces under one light of `exposure` times
/// the plain brightness: without and with shadows.
struct ExposedPair
{
  Picture lit;
  Picture shadowed;
};

/// Visibility as the quotient of two pictures: what the shadows leave of the light.
///
/// A picture has only 8 bits and ends at white, so several exposures are taken, from dark to
/// bright, and each pixel uses the brightest one that is not white without shadows. Where even that
/// one is black, no light arrives and the visibility is 0. Values above 1 (some passes brighten)
/// count as 1.
/// @param colour which of the pictures' is looked at: 0 red, 1 green, 2 blue
std::vector<float> visibilityFromPictures(
  const std::vector<ExposedPair>& exposures, std::size_t colour);

/// What measureVisibility finds.
struct PictureVisibility
{
  VisibilityImages
    images; ///< the truth's positions, normals and coverage with the visibility found
  std::int64_t unreadable = 0; ///< pixels that count but could not be read
};

/// The visibility that `addShadows` gives a scene, read off pictures: for renderers that shade with
/// visibility but do not hand it out. For each light of the truth, the scene is drawn with white
/// surfaces and this light alone. Translucent models are left out.
///
/// Pixels that facingPixels() counts although VTK shades them black (they graze the light so
/// closely that the two disagree on the side) cannot be read; they get the truth's visibility.
///
/// @param addShadows gives a new renderer its shadows; called once per light
PictureVisibility measureVisibility(const Scene& scene, const VisibilityImages& truth,
  const std::function<void(vtkRenderer*)>& addShadows);

} // namespace gnomon::tool
