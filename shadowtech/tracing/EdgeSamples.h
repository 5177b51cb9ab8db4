#pragma once

#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

class EmbreeTracer;
class RayFilter;
struct Drawn;

/// A picture that several processes draw, each its own part of the triangles. All of them must call
/// EdgeSamples::smooth() alike. The functions are collective.
struct SharedPicture
{
  /// This process's drawing. Fragments are 0 where the picture shows another process's triangle.
  const Drawn& drawn;
  /// x: a number of the surface that a pixel shows, the same in all processes; 0: none.
  const std::vector<glm::vec2>& surfaces;
  const ReceiverPixels& receivers;
  /// Replace each number by the least of all processes'.
  std::function<void(std::vector<float>&)> reduceToLeast;
  /// Return the receivers of all processes.
  std::function<const ReceiverPixels&(const ReceiverPixels& own)> share;
  /// Replace bits by those that any process has set.
  std::function<void(std::vector<std::uint64_t>&)> uniteBits;
};

struct EdgePixel
{
  std::uint32_t pixel;
  ///@{
  /// By channel; all alike without a coloured filter.
  glm::vec3 visibility; ///< mean of its samples
  glm::vec3 ofCentre;
  ///@}
};

/// Traces receivers between the centres of pixels near edges, for smooth edges of hard shadows.
///
/// An *edge pixel* faces the light. It and its eight neighbours differ in visibility, or include
/// several surfaces. A sample is a place in an edge pixel. Its receiver lies on the pixel's own
/// triangle, or on a neighbour's triangle that continues the pixel's surface. A triangle continues
/// it on the same drawn surface, turned by less than 45 degrees, within a pixel's side of the own
/// triangle's plane. So surfaces behind an outline do not colour the pixel. Samples count if they
/// face the light and, at outlines, if the camera sees them.
///
/// Between surfaces most pixels are evenly lit: four samples decide which of them need all samples.
///
/// Where several processes draw the picture, each tries its own triangles. The process with the
/// first triangle that holds a sample sends the receiver. Each tests if its casters hide it.
class EdgeSamples
{
public:
  /// Return the edge pixels whose samples have another mean visibility than their centre.
  /// @param technique that computed the visibility of the pixels' centres, and its input
  /// @param classes of the pixels, of TracedClass
  /// @param perPixel 4, 16 or 64
  /// @param visibility of the pixels' centres, as the filter leaves it
  /// @param filter null if all casters block. Each sample has what it leaves of its own ray
  /// @param several null if this process draws the picture alone
  /// @param counts the traced rays are added to it
  std::vector<EdgePixel> smooth(CpuScreenTechnique& technique, const ScreenInput& input,
    const std::vector<std::uint8_t>& classes, std::size_t perPixel,
    const std::vector<float>& visibility, const RayFilter* filter, const SharedPicture* several,
    LightCounts& counts);

  /// Return the bytes cached for the next picture.
  std::size_t bytes() const
  {
    return this->receivers_.bytes() + bytesOf(this->orders_) + bytesOf(this->outline_) +
      bytesOf(this->hidden_) + bytesOf(this->visibility_) + bytesOf(this->classes_);
  }

private:
  void place(const Drawn& drawn, const SharedPicture* several,
    const std::vector<std::uint32_t>& pixels, std::size_t perPixel, bool findsOutlines);
  void share(const SharedPicture& several);
  void dropHidden(const ReceiverImages& images, const EmbreeTracer& hiders,
    const SharedPicture* several, const std::vector<std::uint32_t>& pixels, std::size_t perPixel);
  glm::vec3 mean(std::size_t pixel, std::size_t perPixel, const glm::vec3& ofCentre) const;

  ReceiverPixels receivers_;          ///< of the samples
  std::vector<float> orders_;         ///< of their triangles (SamplePlacing)
  std::vector<std::uint8_t> outline_; ///< 1 for each pixel with samples that is at an outline
  std::vector<std::uint64_t> hidden_; ///< of each of these pixels: a bit for each sample
  std::vector<float> visibility_;     ///< likewise
  std::vector<std::uint8_t> classes_; ///< likewise
};

} // namespace gnomon
