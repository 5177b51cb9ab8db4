#pragma once

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// The pixels that `selective` looks at more closely than at their texel, and what is done with
/// them, in this order.
struct ChainSettings
{
  int contourPixels = 4;   ///< across the contour, half of it on either side; 0: the whole image
  int neighbourTexels = 9; ///< around a pixel's place on the map, whose triangles are met; 0: none
  Adjacency adjacency = Adjacency::Vertices; ///< of its own texel's triangle: met as well
  Leftovers leftovers = Leftovers::Trace;
  OutsideContour outside = OutsideContour::Map;
};
const SettingsTable& chainSettings();

/// `selective`: the contour between light and shadow is looked at closely, by one test after the
/// other (D. L. Moderno, Shadow Mapping and Ray-Tracing), and what they leave is traced. Exact
/// inside of the contour without the test of coherence; everywhere if the contour is the whole
/// image.
class Selective : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon
