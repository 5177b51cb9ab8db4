#pragma once

#include <algorithm>
#include <cstddef>

namespace gnomon
{

/// The points that are probed at once.
inline constexpr std::size_t probesOfALook = 4096;

/// A count of wrong answers of a cheap visibility.
struct WrongProbes
{
  std::size_t asked = 0; ///< points that face the light
  std::size_t wrong = 0; ///< those where visibility is off by more than 0.5

  double share() const
  {
    return static_cast<double>(this->wrong) / static_cast<double>(std::max<std::size_t>(asked, 1));
  }

  ///@{
  /// Return a bound of the share of wrong pixels in the population of which these are a sample.
  /// The share is beyond it in one case of forty: Wilson's interval (Wilson 1927) with z = 2.
  /// Without points the bounds are 0 and 1. Sampling until one is clear makes it wrong more often.
  double leastShare() const;
  double mostShare() const;
  ///@}
};

/// A sum of the squared errors of an area light's visibility.
struct SquaredErrors
{
  std::size_t points = 0;    ///< that face the light
  double sum = 0.0;          ///< of the squares, means over the visibility's channels
  double sumOfSquares = 0.0; ///< of these again
  double expected = 0.0;     ///< what a square in a penumbra may be; rare ones may be missed

  void add(const SquaredErrors& others);
  ///@{
  /// Return a bound of the root mean square error of the population of which these are a sample:
  /// Wilson's, as if all squares but zeros were of one size, at least the expected one. Without
  /// points both are 0. The upper one has z = 3, as each of many looks may pass it by chance.
  double leastRms() const { return this->rms(-2.0); }
  double mostRms() const { return this->rms(3.0); }
  ///@}

private:
  double rms(double z) const;
};

} // namespace gnomon
