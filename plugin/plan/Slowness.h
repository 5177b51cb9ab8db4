#pragma once

#include <deque>

namespace gnomon
{

/// How much longer frames take than the model of costs says, by maps and by rays: the median of the
/// last 30 frames each, or of the last five if that is more. Each frame of one way also drops the
/// oldest of the other, so that the other is tried again after a load has passed.
class Slowness
{
public:
  /// Begin a frame with its way and its modelled time.
  void begin(bool byMaps, double modelledMilliseconds);
  /// True if a frame has begun whose time counts.
  bool awaitsTime() const { return this->modelledMilliseconds_ > 0.0; }
  /// Drop a frame that compiles or builds, as its time does not count.
  void drop() { this->modelledMilliseconds_ = 0.0; }
  void end(double milliseconds);

  ///@{
  /// Return the factor on the model; 1 if nothing is known.
  double ofMaps() const;
  double ofRays() const;
  ///@}

private:
  std::deque<double> maps_, rays_;
  bool byMaps_ = false;
  double modelledMilliseconds_ = 0.0; ///< 0: no frame has begun
};

} // namespace gnomon
