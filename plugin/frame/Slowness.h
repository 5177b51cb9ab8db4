#pragma once

#include <deque>

namespace gnomon
{

/// How much longer frames take than the model of costs says, by maps and by rays: the median of the
/// last 30 each. Of the way that is not taken, old frames are forgotten one by one, so that a load
/// that has passed is tried again.
class Slowness
{
public:
  /// The way that a frame takes, and how long it is to take.
  void begin(bool byMaps, double modelledMilliseconds);
  /// Whether a frame has begun whose time tells something.
  bool awaitsTime() const { return this->modelledMilliseconds_ > 0.0; }
  /// A frame that compiles or builds tells nothing.
  void drop() { this->modelledMilliseconds_ = 0.0; }
  void end(double milliseconds);

  ///@{
  /// A factor of the model; 1 where nothing is known.
  double ofMaps() const;
  double ofRays() const;
  ///@}

private:
  std::deque<double> maps_, rays_;
  bool byMaps_ = false;
  double modelledMilliseconds_ = 0.0; ///< 0: no frame has begun
};

} // namespace gnomon
