#pragma once

#include "ImageFile.h"
#include "Scene.h"
#include "WorstPlace.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{

/// How far a technique's visibility is from the truth, over the pixels that count: covered, facing
/// the light (facesLight() of ShadowRay.h) and, where it has one, inside its cone or box. Of
/// several lights, every pair of a pixel and a light counts once; a light with a texture counts as
/// three, one for each channel.
struct VisibilityError
{
  std::int64_t facingPixels = 0;  ///< pixels that count
  std::int64_t falseLight = 0;    ///< v - truth > 0.5
  std::int64_t falseShadow = 0;   ///< truth - v > 0.5, or v is not a number
  std::int64_t betweenPixels = 0; ///< neither lit nor dark: strictly inside darkBelow, litAbove
  double meanAbsolute = 0.0;
  double rootMeanSquare = 0.0;

  /// A visibility at or below the first looks dark to people, at or above the second lit.
  static constexpr float darkBelow = 0.1f;
  static constexpr float litAbove = 0.9f;

  std::int64_t wrongPixels() const { return this->falseLight + this->falseShadow; }
  /// `pixels` per pixel that counts; 0 where none does.
  double share(std::int64_t pixels) const
  {
    return this->facingPixels > 0
      ? static_cast<double>(pixels) / static_cast<double>(this->facingPixels)
      : 0.0;
  }
};

/// What one pixel has to say about one or more lights, for a picture of the errors; of several
/// lights the last of these.
enum class PixelVerdict : unsigned char
{
  NotCounted, ///< covered by nothing, turned away, or outside the cone
  Right,
  FalseShadow,
  FalseLight
};

/// 1 per pixel that counts for this light: covered, facing it, inside its cone or box.
std::vector<unsigned char> facingPixels(const VisibilityImages& images, const SceneLight& light);

/// A technique's error against the truth, over all lights that the truth lists.
/// @param lights the scene's lights; `truth.sceneIndices` counts them
/// @param verdicts if given, receives one verdict per pixel
/// @param differences if given, receives each pixel's greatest difference from the truth; 0 where
/// it does not count
/// @throws std::invalid_argument when the two differ in size or lights
VisibilityError measureError(const VisibilityImages& technique, const VisibilityImages& truth,
  const std::vector<SceneLight>& lights, std::vector<PixelVerdict>* verdicts = nullptr,
  std::vector<float>* differences = nullptr);

/// 1 per pixel of which any light's visibility was decided by a ray.
std::vector<unsigned char> tracedMask(const VisibilityImages& images);

/// The dimmed picture with false light in blue and false shadow in red; where `traced` is given and
/// not 0, the pixels that a ray decided and that are right in purple.
Picture errorPicture(const Picture& picture, const std::vector<PixelVerdict>& verdicts,
  const std::vector<unsigned char>* traced = nullptr);

/// What moves while frames are timed.
enum class Motion
{
  Static,
  Camera,
  Light
};
inline constexpr std::array<Motion, 3> allMotions = { Motion::Static, Motion::Camera,
  Motion::Light };
/// "static", "camera moving", "light moving".
const char* motionName(Motion motion);
/// The same as a key of tables: "static", "camera_moving", "light_moving".
std::string motionKey(Motion motion);

/// Times of one variant under one motion.
struct MotionTiming
{
  double milliseconds = 0.0; ///< a frame's wall clock, median
  /// Stage names and medians of the measured frames, in the order of the frame; empty for a variant
  /// that has no stages.
  std::vector<std::pair<std::string, double>> stages;
  /// Sum of the stages by wall clock, median over the measured frames; 0 without stages.
  double stageShare = 0.0;
};

/// Bytes that a variant takes.
struct VariantMemory
{
  std::size_t occluders = 0; ///< triangles on the CPU and the GPU
  std::size_t bvh = 0;       ///< ray tracing structure
  std::size_t maps = 0;
  std::size_t images = 0; ///< receivers and visibility
  /// How much the process grew while the variant was set up and drew its first frames. Software
  /// OpenGL keeps its buffers there; what is reused from earlier variants does not show.
  std::int64_t residentGrowth = 0;
};

/// The names under which the peers appear.
inline constexpr const char* plainTechnique = "plain VTK";
inline constexpr const char* shadowMapPassTechnique = "vtkShadowMapPass";

/// One row of a comparison.
struct VariantResult
{
  std::string name;        ///< unique, for people: "nsm 1024 inline"
  std::string technique;   ///< "nsm", or one of the peers' names above
  std::string route;       ///< "inline", "image", or "" where routes mean nothing
  int mapSizeTexels = 0;   ///< 0: no map
  std::string errorSource; ///< how its visibility was obtained, as a sentence
  VisibilityError error;
  /// Pixels, of those that count, that were decided by a ray; none where the variant cannot trace.
  std::int64_t tracedPixels = 0;
  /// How its pixels' visibility came about, over all lights; empty where it does not tell.
  std::vector<std::pair<std::string, std::int64_t>> classes;
  std::array<MotionTiming, 3> timings; ///< in the order of allMotions
  VariantMemory memory;
  std::vector<std::string> notes; ///< limits that it ran into, each a sentence
  Picture picture;
  Picture errors;             ///< see errorPicture
  std::optional<Place> worst; ///< where it is most wrong; nowhere if it is right everywhere
  /// The classes in their colours, of the first light that tells; without pixels where none does.
  Picture classPicture;
};

/// Everything that a report says: the border between measuring and writing.
struct ComparisonResults
{
  std::string scene;
  int width = 0;
  int height = 0;
  int frames = 0; ///< timed frames per variant and motion; 0: no motion was timed
  std::size_t triangles = 0;
  int lights = 0;    ///< that cast
  bool soft = false; ///< whether one of them has an area
  std::string truth; ///< the name of the variant that the others are measured against
  /// What the numbers depend on, for people: name and value, in order.
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<std::string> notes; ///< about the scene, each a sentence
  std::vector<VariantResult> variants;
};

/// The motions under which frames were timed: all or none.
std::vector<Motion> timedMotions(const ComparisonResults& results);

/// The names of all classes that any variant tells, in order of appearance.
std::vector<std::string> classNames(const ComparisonResults& results);
/// The names of all stages that any variant has under these motions, in order of appearance.
std::vector<std::string> stageNames(
  const ComparisonResults& results, const std::vector<Motion>& motions);
/// The number of that name; null where there is none.
template <typename Number>
const Number* findNamed(
  const std::vector<std::pair<std::string, Number>>& numbers, const std::string& name)
{
  const auto found = std::find_if(
    numbers.begin(), numbers.end(), [&](const auto& entry) { return entry.first == name; });
  return found == numbers.end() ? nullptr : &found->second;
}

} // namespace gnomon::tool
