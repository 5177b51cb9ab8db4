#pragma once

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// Which pixels `selective` verifies beyond their texel, and by which tests, in this order.
struct ChainSettings
{
  int contourPixels = 4; ///< across the contour, half of it on either side; 0 for the whole image
  /// Texels around a pixel's place on the map whose triangles are tested; 0 for none.
  int neighbourTexels = 9;
  /// Neighbours of its own texel's triangle that are tested, too.
  Adjacency adjacency = Adjacency::Vertices;
  Leftovers leftovers = Leftovers::Trace;
  OutsideContour outside = OutsideContour::Map;
};
const SettingsTable& chainSettings();

/// `selective`: tests of increasing cost verify the contour between light and shadow, and undecided
/// pixels are traced (D. L. Moderno, Shadow Mapping and Ray-Tracing). It is exact inside the
/// contour without the test of coherence, and everywhere if the contour is the whole image.
class Selective : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon
