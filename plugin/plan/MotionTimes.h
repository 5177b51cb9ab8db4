#pragma once

#include "plugin/plan/FrameWishes.h"

#include <cstddef>
#include <map>

namespace gnomon
{

/// Times of earlier frames, in milliseconds; 0 or absent: not known.
struct MotionTimes
{
  double restByRays = 0.0; ///< a moving frame whose lights are traced, without their images
  double restByMaps = 0.0; ///< a moving frame that traces no light
  /// One sample of an image that was traced, by the light's scene index.
  std::map<int, double> sample;
  int framesByMaps = 0;  ///< in a row
  double sky = 0.0;      ///< the view of the sky by few directions
  double reserved = 0.0; ///< of the frame that is planned: what the sky takes of it

  /// Take a frame's times into account. Rays that are not taken for some frames are forgotten by
  /// and by, so that they are tried again after a load has passed.
  /// @param rest of the frame, without images and the sky
  void add(bool byRays, double rest);
  /// @param milliseconds 0: the frame did not trace it, which is forgotten like rays
  void addSky(double milliseconds);
  void addImage(int sceneIndex, double samples, double milliseconds);
};

/// Return the milliseconds for a moving frame: the window's, over several processes the time
/// budget's, but at least 1.3 times those that VTK draws; 0: no limit.
double limitOf(const FrameWishes& wishes, const MotionTimes& times);

/// True if the view of the sky by few directions fits into a moving frame, beside one sample of
/// each light's image; true as well where there is no limit, or nothing is known.
bool skyIsInTime(const FrameWishes& wishes, const MotionTimes& times);

/// Return how many samples of a light's image fit into a moving frame.
/// @param lights how many lights are traced, each of which has the same share of the time
/// @param most to be returned where there is no limit, or nothing is known
int samplesInTime(const FrameWishes& wishes, const MotionTimes& times, int sceneIndex,
  std::size_t lights, int most);

} // namespace gnomon
