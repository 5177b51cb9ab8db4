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

/// The error of a technique's visibility against the truth, over the pixels that count. These are
/// covered, face the light (facesLight() of ShadowRay.h), and lie inside its cone or box if it has
/// one. With several lights, each pair of pixel and light counts once. A light with a texture
/// counts as three, one for each channel.
struct VisibilityError
{
  std::int64_t facingPixels = 0;  ///< pixels that count
  std::int64_t falseLight = 0;    ///< v - truth > 0.5
  std::int64_t falseShadow = 0;   ///< truth - v > 0.5, or v is NaN
  std::int64_t betweenPixels = 0; ///< neither lit nor dark: strictly inside darkBelow, litAbove
  double meanAbsolute = 0.0;
  double rootMeanSquare = 0.0;

  /// A visibility at or below darkBelow looks dark, at or above litAbove lit.
  static constexpr float darkBelow = 0.1f;
  static constexpr float litAbove = 0.9f;

  std::int64_t wrongPixels() const { return this->falseLight + this->falseShadow; }
  /// Return `pixels` as a share of the pixels that count; 0 if none counts.
  double share(std::int64_t pixels) const
  {
    return this->facingPixels > 0
      ? static_cast<double>(pixels) / static_cast<double>(this->facingPixels)
      : 0.0;
  }
};

/// A pixel's verdict about one or more lights, for a picture of errors. With several lights, the
/// last enumerator applies.
enum class PixelVerdict : unsigned char
{
  NotCounted, ///< covered by nothing, turned away, or outside the cone
  Right,
  FalseShadow,
  FalseLight
};

/// Return a mask with 1 for each pixel that counts for this light: covered, facing it, inside its
/// cone or box.
std::vector<unsigned char> facingPixels(const VisibilityImages& images, const SceneLight& light);

/// Measure a technique's error against the truth, over all lights of the truth.
/// @param lights the scene's lights, indexed by `truth.sceneIndices`
/// @param verdicts if given, receives one verdict per pixel
/// @param differences if given, receives each pixel's greatest difference from the truth; 0 for
/// pixels that do not count
/// @throws std::invalid_argument if the images differ in size or lights
VisibilityError measureError(const VisibilityImages& technique, const VisibilityImages& truth,
  const std::vector<SceneLight>& lights, std::vector<PixelVerdict>* verdicts = nullptr,
  std::vector<float>* differences = nullptr);

/// Return a mask with 1 for each traced pixel, of any light.
std::vector<unsigned char> tracedMask(const VisibilityImages& images);

/// Return the dimmed picture with false light in blue and false shadow in red. Pixels that are
/// right and traced are purple.
/// @param traced not 0 for each traced pixel; may be null
Picture errorPicture(const Picture& picture, const std::vector<PixelVerdict>& verdicts,
  const std::vector<unsigned char>* traced = nullptr);

/// The motion while frames are timed.
enum class Motion
{
  Static,
  Camera,
  Light
};
inline constexpr std::array<Motion, 3> allMotions = { Motion::Static, Motion::Camera,
  Motion::Light };
/// Return "static", "camera moving" or "light moving".
const char* motionName(Motion motion);
/// Return a motion's key in tables: "static", "camera_moving" or "light_moving".
std::string motionKey(Motion motion);

/// Times of one variant under one motion.
struct MotionTiming
{
  double milliseconds = 0.0; ///< a frame's wall clock, median
  /// Stage names and medians over the measured frames, in the order of the frame; empty for a
  /// variant without stages.
  std::vector<std::pair<std::string, double>> stages;
  /// The sum of stages divided by wall clock time, median over the measured frames; 0 without
  /// stages.
  double stageShare = 0.0;
};

/// A variant's memory in bytes.
struct VariantMemory
{
  std::size_t occluders = 0; ///< triangles on the CPU and the GPU
  std::size_t bvh = 0;       ///< ray tracing structure
  std::size_t maps = 0;
  std::size_t images = 0; ///< receivers and visibility
  /// The process' growth while the variant was set up and rendered its first frames. It includes
  /// software OpenGL's buffers, but not memory reused from earlier variants.
  std::int64_t residentGrowth = 0;
};

/// The names of the peers.
inline constexpr const char* plainTechnique = "plain VTK";
inline constexpr const char* shadowMapPassTechnique = "vtkShadowMapPass";

/// One row of a comparison.
struct VariantResult
{
  std::string name;        ///< unique, for users: "nsm 1024 inline"
  std::string technique;   ///< "nsm", or one of the peers' names above
  std::string route;       ///< "inline", "image", or "" for variants without routes
  int mapSizeTexels = 0;   ///< 0: no map
  std::string errorSource; ///< the source of its visibility, as a sentence
  VisibilityError error;
  /// The pixels that count and were traced; none for a variant that cannot trace.
  std::int64_t tracedPixels = 0;
  /// The number of pixels in each class, over all lights; empty if the variant has no classes.
  std::vector<std::pair<std::string, std::int64_t>> classes;
  std::array<MotionTiming, 3> timings; ///< in the order of allMotions
  VariantMemory memory;
  std::vector<std::string> notes; ///< limits that it reached, each a sentence
  Picture picture;
  Picture errors;             ///< see errorPicture
  std::optional<Place> worst; ///< its most wrong place; none if it is right everywhere
  /// The classes of the first light that has them, in their colours; without pixels if none has.
  Picture classPicture;
};

/// All data of a report: the interface between measuring and writing.
struct ComparisonResults
{
  std::string scene;
  int width = 0;
  int height = 0;
  int frames = 0; ///< timed frames per variant and motion; 0: no motion was timed
  std::size_t triangles = 0;
  int lights = 0;    ///< number of casting lights
  bool soft = false; ///< true if one of them has an area
  std::string truth; ///< name of the variant that others are measured against
  /// The settings that the numbers depend on, for users: name and value, in order.
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<std::string> notes; ///< about the scene, each a sentence
  std::vector<VariantResult> variants;
};

/// Return the motions under which frames were timed: all or none.
std::vector<Motion> timedMotions(const ComparisonResults& results);

/// Return the names of all variants' classes, in order of appearance.
std::vector<std::string> classNames(const ComparisonResults& results);
/// Return the names of all variants' stages under these motions, in order of appearance.
std::vector<std::string> stageNames(
  const ComparisonResults& results, const std::vector<Motion>& motions);
/// Return the number with this name; null without one.
template <typename Number>
const Number* findNamed(
  const std::vector<std::pair<std::string, Number>>& numbers, const std::string& name)
{
  const auto found = std::find_if(
    numbers.begin(), numbers.end(), [&](const auto& entry) { return entry.first == name; });
  return found == numbers.end() ? nullptr : &found->second;
}

} // namespace gnomon::tool
