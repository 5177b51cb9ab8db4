#pragma once

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Drawn;

/// Traces receivers between the centres of pixels near edges, for smooth edges of hard shadows.
///
/// An *edge pixel* faces the light. It and its eight neighbours include both lit and dark pixels,
/// or several surfaces. A sample is a place in an edge pixel. Its receiver lies on the pixel's own
/// triangle, or on a neighbour's triangle that continues the pixel's surface. A triangle continues
/// it on the same drawn surface, turned by less than 45 degrees, within a pixel's side of the own
/// triangle's plane. So surfaces behind an outline do not colour the pixel. Samples count if they
/// face the light and, at outlines, if the camera sees them; the latter needs a FreeSegments.
///
/// Between surfaces most pixels are evenly lit: four samples decide which of them need all samples.
class EdgeSamples
{
public:
  /// Replace the visibility of each edge pixel by the mean of its samples.
  /// @param technique that computed the visibility of the pixels' centres, and its input
  /// @param classes of the pixels, of TracedClass
  /// @param perPixel 4, 16 or 64
  /// @param visibility of the pixels
  /// @param report the traced rays are added to it
  void smooth(CpuScreenTechnique& technique, const ScreenInput& input,
    const std::vector<std::uint8_t>& classes, std::size_t perPixel, std::vector<float>& visibility,
    LightReport& report);

  /// Return the bytes cached for the next picture.
  std::size_t bytes() const
  {
    return this->receivers_.bytes() + bytesOf(this->visibility_) + bytesOf(this->classes_);
  }

private:
  void place(const Drawn& drawn, const FreeSegments* hiders,
    const std::vector<std::uint32_t>& pixels, std::size_t perPixel);
  float mean(std::size_t pixel, std::size_t perPixel, float ofCentre) const;

  ReceiverPixels receivers_;          ///< of the samples
  std::vector<float> visibility_;     ///< likewise
  std::vector<std::uint8_t> classes_; ///< likewise
};

} // namespace gnomon
