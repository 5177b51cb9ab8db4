#pragma once

#include "vtkGnomonFrameCounts.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// The shadows of one light in a frame.
struct LightReport : LightCounts
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
  /// The target of its views' fit: "off" (all casters), "frustum" (all that the camera can see) or
  /// "receivers" (all that it does see). Empty if it needs no map.
  std::string fit;
  std::string fitReason; ///< why it is the frustum; else empty
  /// The filter's kernel: a value of the setting `kernel`, or "disc" (adaptive), "square" (maps of
  /// moments). Empty without a filter.
  std::string kernel;
  int kernelTexels = 0; ///< width of the filter's kernel
  int mapSamples = 0;   ///< samples per texel of its map; 0 for maps of depths
};

/// The report of one frame, for users and tests. Counters count this frame only.
struct FrameReport : FrameCounts
{
  /// "inline", "image", "deferred" or "none" (no light casts: plain VTK)
  std::string route;
  std::string routeReason; ///< why this route, as a clause
  /// True if geometry shaders number the triangles.
  bool numbersByGeometryShaders = false;
  /// The technique of lights that leave it to the pass, and the reason, as a clause; empty if no
  /// light does.
  std::string choice;
  /// True if the frame was drawn without shadows because a map or an image exceeds the texture
  /// memory.
  bool outOfTextureMemory = false;
  std::vector<LightReport> lights; ///< every light of the renderer
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

  double wallMilliseconds = 0.0; ///< the whole pass, as seen by the caller

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
