#pragma once

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Drawn;

/// Smooth edges of hard shadows: receivers between the centres of pixels, where edges can be.
///
/// An *edge pixel* faces the light, and among its eight neighbours and itself are lit and dark ones
/// or several surfaces. A sample is a place in an edge pixel. Its receiver lies on the pixel's own
/// triangle or on a neighbour's, where that goes on with the surface that the pixel shows: the same
/// drawn surface, turned by less than 45 degrees, within a pixel's side of the own triangle's
/// plane. So what is behind an outline does not colour it. Samples count that face the light and, at
/// outlines, are seen by the camera, if the tracer can say so (FreeSegments).
///
/// Between surfaces most pixels are evenly lit: four samples tell which ones need all.
class EdgeSamples
{
public:
  /// Gives each edge pixel the mean visibility of its samples.
  /// @param technique that computed the visibility of the pixels' centres, and its input
  /// @param classes of the pixels, of TracedClass
  /// @param perPixel 4, 16 or 64
  /// @param visibility of the pixels
  /// @param report whose rays are added to
  void smooth(CpuScreenTechnique& technique, const ScreenInput& input,
    const std::vector<std::uint8_t>& classes, std::size_t perPixel, std::vector<float>& visibility,
    LightReport& report);

  /// Memory that is kept for the next picture.
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
