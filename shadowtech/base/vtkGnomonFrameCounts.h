#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// The time of one stage of a frame.
struct StageTime
{
  std::string name; ///< lights, occluders, receivers, maps, visibility, shading, or "stage: part"
  double milliseconds = 0.0; ///< wall clock
};

/// The number of pixels of a class (TechniqueInfo::classes).
struct ClassCount
{
  std::string name;        ///< of the class
  std::int64_t pixels = 0; ///< of that class
};

/// Reuse of a stage's value in this frame.
struct ValueReport
{
  std::string name;    ///< "receivers", "visibility of light 3"
  bool reused = false; ///< true: cached by an earlier frame
  std::string changes; ///< what changed since then, "the camera, the light"; empty if reused
};

/// Counts of computing one light's visibility. If that is reused, these are the counts of the
/// frame that computed it.
struct LightCounts
{
  /// Why its optional map is unused; empty if it is used.
  std::string mapReason;
  /// Casting surfaces outside of all its views; 0 if the CPU bakes the map.
  int castersLeftOut = 0;
  std::int64_t tracedPixels = 0; ///< pixels decided by a ray
  /// Points of the light that cast its shadows; 1 for hard shadows. A traced pixel has a ray to
  /// each.
  int lightSamples = 1;
  /// The share of its points that are in the picture. Below 1, further frames add more.
  double progress = 1.0;
  /// Traced rays. For most techniques they are tracedPixels times lightSamples. If rays decide
  /// others (`penumbra`), pixels in tracedPixels have all of their rays, and other pixels some.
  std::int64_t rays = 0;
  ///@{
  /// Tiles of 64 x 16 pixels, for exact techniques traced by Embree: tilesDark are certainly dark,
  /// tilesTraced have rays, tilesLit are the others. Counted if several lights share receivers, or
  /// receivers rest; else all are 0.
  int tilesLit = 0;
  int tilesDark = 0;
  int tilesTraced = 0;
  ///@}
  /// Why no shadow ray was needed, as a clause; empty if any was, or if tiles were not counted.
  std::string skipReason;
  int planes = 0; ///< of planar shadows: planes that receive them
  /// Of planar shadows: pixels off these planes, which show no cast shadow. Counted only if
  /// visibility is kept or stages are measured.
  std::int64_t pixelsOffPlanes = 0;
  /// Pixels by class, for techniques that classify them. Counted only if visibility is kept or
  /// stages are measured.
  std::vector<ClassCount> classes;
};

/// Counts and notes of the stages of one frame.
struct FrameCounts
{
  ///@{
  /// Pixels whose driver-given triangle number was compared with the drawn depths, and the pixels
  /// where they disagree and geometry shaders do better. Shaders are checked in the first frame
  /// that shows what they draw. From then on geometry shaders number the triangles.
  std::int64_t numbersChecked = 0, numbersWrong = 0;
  ///@}
  std::int64_t probes = 0;        ///< pixels where maps or samples of `auto` were checked by rays
  std::vector<std::string> notes; ///< limits that this frame ran into, each a sentence
  /// Pixels, of all processes, that show another process's surface than the one whose receiver was
  /// traced, as depths were rounded otherwise. Counted if stages are measured.
  std::int64_t otherSurfaces = 0;

  /// Filled if stages are measured. Each stage then ends with glFinish, which costs time itself.
  /// Otherwise `stages` is empty and only wallMilliseconds counts.
  std::vector<StageTime> stages;

  /// Reuse of each value that a stage can cache.
  std::vector<ValueReport> values;
  int receiversDrawn = 0;        ///< receiver pictures that VTK drew
  int visibilityComputed = 0;    ///< lights whose visibility was computed for the picture's pixels
  std::int64_t raysTraced = 0;   ///< for these lights
  double skyProgress = 1.0;      ///< share of the sky's directions that pixels show; 1 without
  double skyMilliseconds = 0.0;  ///< time of tracing the view of the sky
  int mapBakes = 0;              ///< baked maps
  int programCompiles = 0;       ///< shader programs built, including VTK's with the hook
  int newPrograms = 0;           ///< of these, compiled by OpenGL; VTK caches earlier ones
  int bvhBuilds = 0;             ///< acceleration structures built
  int bvhRefits = 0;             ///< acceleration structures refitted
  int surfacesExtracted = 0;     ///< mapper inputs copied to the snapshot
  int surfacesRetransformed = 0; ///< surfaces with recomputed world positions
};

} // namespace gnomon
