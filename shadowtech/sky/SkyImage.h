#pragma once

#include "shadowtech/sky/Sky.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace gnomon
{

struct Occluders;
class EmbreeTracer;
class Receivers;
struct ReceiverPixels;

/// How much of a sky each pixel sees, from as many batches of directions as were traced.
///
/// Blocks of 4 x 4 pixels repeat, and each of their pixels has SkyDirections of its own. So sixteen
/// pixels of a larger block look in the same directions around their normals, and their rays share
/// a packet.
///
/// Where smooth shading implies a curve (ReceiverPixels::Curve), directions are around its normal,
/// so that facets do not show. Those below the facet's own plane are mirrored in it. So all rays of
/// a convex body leave it.
class SkyImage
{
public:
  explicit SkyImage(int directions);

  int directions() const { return this->directions_.count(); }
  std::size_t batches() const { return this->batches_; }

  /// Forget what was traced.
  void clear();
  /// Trace batches until so many are done. The result does not depend on the steps between.
  /// @return the number of rays
  std::size_t trace(const Sky& sky, const Receivers& receivers, const Occluders& occluders,
    const EmbreeTracer& tracer, std::size_t batches);
  /// Compute each pixel's view: 1 where it shows no receiver.
  void view(std::vector<float>& view) const;

  /// Trace two directions of each pixel, and give it the sums of its neighbours, too: of 8 x 8
  /// pixels, those near its plane whose normals differ little. Forgets what was traced; batches()
  /// is 0 then.
  /// @param receivers of the whole picture
  /// @return the number of rays
  std::size_t traceFew(const Sky& sky, const ReceiverPixels& receivers, const Occluders& occluders,
    const EmbreeTracer& tracer);

  std::size_t bytes() const;

private:
  static constexpr std::size_t side = 4;
  /// Returns the directions that a pixel of a block traces.
  using DirectionsOf = std::function<std::vector<glm::vec3>(std::size_t place)>;
  std::size_t traceAll(const Sky& sky, const Receivers& receivers, const Occluders& occluders,
    const EmbreeTracer& tracer, std::size_t sideOfBlock, const DirectionsOf& directionsOf);

  SkyDirections directions_;
  /// The directions of each pixel of a block, batch by batch.
  std::array<std::vector<glm::vec3>, side * side> pattern_;
  std::size_t batches_ = 0;
  ///@{
  /// By pixel: sums of radiance over the directions, and over those that are free. Pixels without
  /// receiver have none.
  std::vector<float> all_, seen_;
  ///@}
  std::vector<float> open_;                     ///< openView()
  std::vector<float> allOfLines_, seenOfLines_; ///< kept, as new memory costs more than old
};

} // namespace gnomon
