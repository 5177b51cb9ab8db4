#pragma once

#include <cstddef>
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

/// The shadows of one light in a frame. If its visibility is reused, this is the report of the
/// frame that computed it.
struct LightReport
{
  int sceneIndex = 0;     ///< place in the renderer's light collection
  bool casts = false;     ///< false: skipped; `reason` states why
  std::string reason;     ///< why it was skipped; empty if it casts
  std::string technique;  ///< the technique that shades it
  std::string estimator;  ///< the estimator that decides its points
  std::string projection; ///< how its map is laid out; empty if it needs none
  int mapSizeTexels = 0;  ///< side of its map; 0 if it needs none
  /// How the memory budget limits its map, as a clause; empty if it does not.
  std::string budgetReason;
  /// What its views are fitted to: "off" (all casters), "frustum" (all that the camera can see) or
  /// "receivers" (all that it does see). Empty if it needs no map.
  std::string fit;
  std::string fitReason; ///< why it is the frustum; else empty
  /// Why its optional map is unused; empty if it is used.
  std::string mapReason;
  /// Casting surfaces outside of all its views; 0 if the CPU bakes the map.
  int castersLeftOut = 0;
  /// The filter's kernel: a value of the setting `kernel`, or "disc" (adaptive), "square" (maps of
  /// moments). Empty without a filter.
  std::string kernel;
  int kernelTexels = 0;          ///< width of the filter's kernel
  int mapSamples = 0;            ///< samples per texel of its map; 0 for maps of depths
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

/// Reuse of a stage's value in this frame.
struct ValueReport
{
  std::string name;    ///< "receivers", "visibility of light 3"
  bool reused = false; ///< true: cached by an earlier frame
  std::string changes; ///< what changed since then, "the camera, the light"; empty if reused
};

/// The report of one frame, for users and tests. Counters count this frame only.
struct FrameReport
{
  /// "inline", "image", "deferred" or "none" (no light casts: plain VTK)
  std::string route;
  std::string routeReason; ///< why this route, as a clause
  ///@{
  /// Pixels whose driver-given triangle number was compared with the drawn depths, and the pixels
  /// where they disagree and geometry shaders do better. Shaders are checked in the first frame
  /// that shows what they draw. From then on geometry shaders number the triangles.
  std::int64_t numbersChecked = 0, numbersWrong = 0;
  ///@}
  /// True if geometry shaders number the triangles.
  bool numbersByGeometryShaders = false;
  /// The technique of lights that leave it to the pass, and the reason, as a clause; empty if no
  /// light does.
  std::string choice;
  std::int64_t probes = 0; ///< pixels where their maps or samples were checked by rays
  /// True if the frame was drawn without shadows because a map or an image exceeds the texture
  /// memory.
  bool outOfTextureMemory = false;
  std::vector<LightReport> lights; ///< every light of the renderer
  std::vector<std::string> notes;  ///< limits that this frame ran into, each a sentence
  /// Settings of lights whose technique does not have them, or that contradict each other, each a
  /// sentence. They are ignored.
  std::vector<std::string> misfits;
  /// True if the only light is a headlight, which then casts no shadow.
  bool headlightIsAlone = false;
  /// Kinds of props that are visible and lit, but neither cast nor receive.
  std::vector<std::string> leftOut;

  ///@{
  /// The processes that draw the picture (vtkGnomonShadowPass::SetController); the pixels whose
  /// receiver is this one's; those in which several drew different surfaces at the same depth; and
  /// the bytes that this one received for receivers and visibility, its own among them.
  int processes = 1;
  std::int64_t ownReceivers = 0, depthTies = 0, bytesShared = 0;
  ///@}
  /// Pixels, of all processes, that show another process's surface than the one whose receiver was
  /// traced, as depths were rounded otherwise. Counted if stages are measured.
  std::int64_t otherSurfaces = 0;

  /// Filled if stages are measured. Each stage then ends with glFinish, which costs time itself.
  /// Otherwise `stages` is empty and only wallMilliseconds counts.
  std::vector<StageTime> stages;
  double wallMilliseconds = 0.0; ///< the whole pass, as seen by the caller

  /// Reuse of each value that a stage can cache.
  std::vector<ValueReport> values;
  int receiversDrawn = 0;        ///< receiver pictures that VTK drew
  int visibilityComputed = 0;    ///< lights whose visibility was computed for the picture's pixels
  std::int64_t raysTraced = 0;   ///< for these lights
  int mapBakes = 0;              ///< baked maps
  int programCompiles = 0;       ///< shader programs built, including VTK's with the hook
  int newPrograms = 0;           ///< of these, compiled by OpenGL; VTK caches earlier ones
  int bvhBuilds = 0;             ///< acceleration structures built
  int bvhRefits = 0;             ///< acceleration structures refitted
  int surfacesExtracted = 0;     ///< mapper inputs copied to the snapshot
  int surfacesRetransformed = 0; ///< surfaces with recomputed world positions

  std::size_t triangles = 0; ///< in the snapshot, those of all instances
  std::size_t instances = 0; ///< glyphs that the snapshot keeps as instances
  /// Triangles left out: a vertex is missing data, not finite or beyond 2^100 in the world.
  std::size_t droppedNonFinite = 0;
  std::size_t droppedZeroArea = 0; ///< triangles left out: no area

  /// The snapshot on the CPU and the GPU, with all that is cached of its surfaces. It is at most
  /// 120 bytes a triangle and 1,500 a surface. Glyphs kept as instances take 120 a triangle of one
  /// glyph, and 200 an instance. The ray tracer's own memory is separate.
  std::size_t bytesOccluders = 0;
  std::size_t bytesBvh = 0;    ///< as Embree reports it
  std::size_t bytesMaps = 0;   ///< baked maps and what techniques cache for baking
  std::size_t bytesImages = 0; ///< receivers, rays and visibility, on the CPU and the GPU
};

} // namespace gnomon
