#ifndef gnomon_lights_MapReach_h
#define gnomon_lights_MapReach_h

#include <cmath>

namespace gnomon
{

/// How far around a receiver's place on the map its technique reads: texels whose centres lie within
/// a square and a disc, one after the other (their Minkowski sum). What a view keeps around its
/// casters and how far a map is pushed back follow from it. The default is one look-up at the nearest
/// texel.
struct MapReach
{
  double squareTexels = 0.5; ///< half the square's side
  double discTexels = 0.0;   ///< the disc's radius

  /// The farthest along either axis.
  double largestTexels() const { return this->squareTexels + this->discTexels; }
  /// Texels to keep free around a view, so that all that is read lies on its own layer.
  int borderTexels() const { return static_cast<int>(std::ceil(this->largestTexels())); }

  bool operator==(const MapReach& other) const
  {
    return this->squareTexels == other.squareTexels && this->discTexels == other.discTexels;
  }
};

} // namespace gnomon

#endif
