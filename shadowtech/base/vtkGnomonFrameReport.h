#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// The time that one stage of a frame took.
struct StageTime
{
  std::string name; ///< lights, occluders, receivers, maps, visibility, shading, or "stage: part"
  double milliseconds = 0.0; ///< wall clock
};

/// How many pixels are of a class (TechniqueInfo::classes).
struct ClassCount
{
  std::string name;        ///< the class's
  std::int64_t pixels = 0; ///< how many are of it
};

/// What became of one light. Of a light whose visibility is reused, it is what the frame that
/// computed it says.
struct LightReport
{
  int sceneIndex = 0;     ///< place in the renderer's light collection
  bool casts = false;     ///< false: skipped, and `reason` says why
  std::string reason;     ///< why it was skipped; empty when it casts
  std::string technique;  ///< the technique that shades it
  std::string estimator;  ///< what it decides points by
  std::string projection; ///< how its map is laid out; empty when it needs none
  int mapSizeTexels = 0;  ///< side of its map; 0 when it needs none
  /// What the memory budget leaves it in place of what it asks for, as a clause; empty where it has
  /// that.
  std::string budgetReason;
  /// What its views are fitted to: "off" (all casters), "frustum" (what the camera can see at most)
  /// or "receivers" (those that are drawn); empty when it needs no map.
  std::string fit;
  std::string fitReason; ///< why it is the frustum; empty when it is not
  /// Why its map is not used, of techniques that can do without; empty when it is.
  std::string mapReason;
  /// Who drew its map, where that is a conservative one: "cpu" or "gpu"; empty where it is not, or
  /// not used.
  std::string rasterizer;
  std::string rasterizerReason; ///< why that one, as a clause
  /// Casting surfaces that none of its views can see; 0 where the CPU draws the map.
  int castersLeftOut = 0;
  /// What filters it: a value of the setting `kernel`, or "disc" (adaptive), "square" (maps of
  /// moments); empty when nothing does.
  std::string kernel;
  int kernelTexels = 0;          ///< and how wide that is
  int mapSamples = 0;            ///< samples of its map's texels; 0 when they hold depths
  std::int64_t tracedPixels = 0; ///< pixels decided by a ray
  /// Points of the light that its shadows come from: 1 where they are hard. A traced pixel has a
  /// ray to each.
  int lightSamples = 1;
  /// The share of its points that are in the picture: below 1 where further frames are to add more.
  double progress = 1.0;
  /// Rays that were traced. Of most techniques as many as tracedPixels times lightSamples; where
  /// rays decide others (`penumbra`), tracedPixels have all of theirs, and other pixels some.
  std::int64_t rays = 0;
  ///@{
  /// Of exact techniques traced by Embree, how many tiles of 64 x 16 pixels are dark for certain,
  /// in how many there are rays, and how many others there are. Counted where several lights share
  /// receivers, or receivers rest; else all are 0.
  int tilesLit = 0;
  int tilesDark = 0;
  int tilesTraced = 0;
  ///@}
  /// Why no shadow ray was needed, where tiles were counted, as a clause; empty if any was.
  std::string skipReason;
  int planes = 0; ///< of planar shadows: how many planes show them
  /// Of planar shadows: pixels that lie on none of those and show no cast shadow. Counted only
  /// where visibility is kept or stages are measured.
  std::int64_t pixelsOffPlanes = 0;
  /// How its pixels' visibility came about, of techniques that tell. Counted only where visibility
  /// is kept or stages are measured.
  std::vector<ClassCount> classes;
};

/// Whether a stage's value was made in this frame.
struct ValueReport
{
  std::string name;    ///< "receivers", "visibility of light 3"
  bool reused = false; ///< it is that of an earlier frame
  std::string
    changes; ///< what changed since then, "the camera, the light"; empty where it is reused
};

/// What one frame did, for people and for tests. Counters count this frame only.
struct FrameReport
{
  /// "inline", "image", "deferred" or "none" (no light casts: plain VTK)
  std::string route;
  std::string routeReason;  ///< why this route, as a clause
  std::string tracer;       ///< "embree" or "gpu"; empty where no light's technique traces rays
  std::string tracerReason; ///< why this one, as a clause
  ///@{
  /// Pixels whose triangle, as the driver numbers it for fragment shaders, was compared with the
  /// depths that were drawn, and those in which they disagree. Shaders are checked in the first
  /// frame in which they draw. If any pixel disagrees, geometry shaders number the triangles.
  std::int64_t numbersChecked = 0, numbersWrong = 0;
  ///@}
  /// Whether geometry shaders number the triangles.
  bool numbersByGeometryShaders = false;
  /// What lights have that leave their technique to the pass, and why, as a clause; empty where
  /// none does.
  std::string choice;
  std::int64_t probes = 0; ///< pixels at which maps or samples of theirs were compared with rays
  /// Whether the frame was drawn without shadows because a map or an image is too large for the
  /// texture memory.
  bool outOfTextureMemory = false;
  std::vector<LightReport> lights; ///< every light of the renderer
  std::vector<std::string> notes;  ///< limits that this frame ran into, each a sentence
  /// Settings that are named for lights whose technique does not have them, or that make no sense
  /// together, each a sentence. They are ignored.
  std::vector<std::string> misfits;
  /// The only light is a headlight, which casts no shadow then.
  bool headlightIsAlone = false;
  /// Kinds of props that are visible and lit, and neither cast nor receive.
  std::vector<std::string> leftOut;

  /// Filled when stages are measured; each stage then ends with glFinish, which costs time of its
  /// own. Without it `stages` is empty and only wallMilliseconds counts.
  std::vector<StageTime> stages;
  double wallMilliseconds = 0.0; ///< the whole pass, as seen by the caller

  /// Of each value that a stage could reuse, whether it did.
  std::vector<ValueReport> values;
  int receiversDrawn = 0;      ///< pictures of receivers that VTK drew
  int visibilityComputed = 0;  ///< lights whose visibility was computed for the picture's pixels
  std::int64_t raysTraced = 0; ///< for them
  int mapBakes = 0;            ///< maps drawn
  int programCompiles = 0;     ///< shader programs made, VTK's with the hook included
  int newPrograms = 0; ///< of these, what OpenGL had to compile: VTK keeps those of earlier frames
  int bvhBuilds = 0;   ///< acceleration structures built
  int bvhRefits = 0;   ///< acceleration structures refitted
  int surfacesExtracted = 0;     ///< mapper inputs read into the snapshot
  int surfacesRetransformed = 0; ///< surfaces whose world positions were computed again

  std::size_t triangles = 0;        ///< in the snapshot, those of all instances
  std::size_t instances = 0;        ///< glyphs that the snapshot keeps as such, not as triangles
  std::size_t droppedNonFinite = 0; ///< triangles left out: a vertex is not finite
  std::size_t droppedZeroArea = 0;  ///< triangles left out: no area

  /// The snapshot on the CPU and the GPU, with all that is remembered of its surfaces: no more than
  /// 120 bytes a triangle and 1,500 a surface; of glyphs that are kept as instances 120 a triangle
  /// of one, and 200 an instance. The ray tracer's own memory is apart.
  std::size_t bytesOccluders = 0;
  std::size_t bytesBvh = 0;    ///< as Embree reports it, or the GPU's with the copy on the CPU
  std::size_t bytesMaps = 0;   ///< what the techniques baked, and what they keep to bake again
  std::size_t bytesImages = 0; ///< receivers, their rays and visibility, on the CPU and the GPU
};

} // namespace gnomon
