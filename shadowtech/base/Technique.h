#pragma once

#include "lights/CameraView.h"
#include "lights/LightViews.h"
#include "lights/MapReach.h"
#include "lights/SettingsTable.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"
#include "shadowtech/base/vtkGnomonPixelClass.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon
{

struct DrawnSurface;
struct Occluders;
class OccluderBuffers;
class Receivers;
class ReceiverTarget;
class ShaderLibrary;
class ShadowTracer;
class TileVerdicts;
class TracedTiles;
class VisibilityLayers;

/// The three kinds of technique.
enum class Evaluation
{
  Pointwise, ///< PointwiseTechnique: serves both routes
  ScreenGpu, ///< GpuScreenTechnique
  ScreenCpu  ///< CpuScreenTechnique
};

/// What an estimator is, before any instance of it exists: one line of the registry.
struct TechniqueInfo
{
  std::string name;
  Evaluation evaluation = Evaluation::Pointwise; ///< as its class says (Registry.cpp)
  bool exact = false;                            ///< equals the ray-traced visibility bit for bit
  /// The settings that it reads, beside the light's area.
  std::vector<const SettingsTable*> settings = {};
  /// The estimator by the letter of the publication, which `as_published` selects (a published one
  /// itself); empty: there is none.
  std::string asPublished = {};
  /// Takes longer for a point than VTK takes to shade it: each pixel is to be asked once, and again
  /// only after a change.
  bool isSlow = false;
  /// Shows the same without its map, which saves time where it serves several frames.
  bool mapIsOptional = false;
  bool conservativeMap = false; ///< its map is a conservative one
  /// Why this map needs the CPU, as a clause; empty if the GPU can draw it.
  std::string onlyCpuDraws = {};
  /// What the report calls the kernel of a technique that filters; empty: as the setting `kernel`.
  std::string kernel = {};

  /// Whether visibility has three channels in a light with a texture (channelsOf()). Of others the
  /// light is an even one of the texture's mean colour.
  bool seesTextures = false;

  /// The most memory of a light's maps, in bytes for each texel of one; none: casters decide it.
  std::function<double(const ShadowLight&)> bytesPerTexel = {};
  double bytesPerPixel = 0.0; ///< and of what it keeps for each pixel of the picture, at most

  /// Why it cannot do what a light's settings say, whose projection is resolved; empty if it can.
  /// Null: it always can.
  std::string (*refused)(const ShadowLight&) = nullptr;

  /// What the technique tells of its pixels; empty: nothing. A screen technique fills
  /// ScreenInput::classes, a pointwise one's GLSL has `int pixelClass_LIGHT` after each call.
  std::vector<PixelClass> classes = {};

  bool isPointwise() const { return this->evaluation == Evaluation::Pointwise; }
  bool has(const SettingsTable& table) const
  {
    return std::find(this->settings.begin(), this->settings.end(), &table) != this->settings.end();
  }
  /// Whether it bakes something from the light.
  bool bakesMap() const { return this->has(viewSettings()); }
};

/// The channels of a light's visibility as a technique computes it: 1, or 3 (red, green, blue)
/// where it sees the texture of the light's area.
inline int channelsOf(const TechniqueInfo& info, const ShadowLight& light)
{
  return info.seesTextures && light.area && light.texture ? 3 : 1;
}

/// A texture for a shader's sampler.
struct TextureBinding
{
  GLenum target = 0;
  GLuint texture = 0;
};

/// A uniform's name (as in the GLSL file, with its _LIGHT suffix; of an array, one element's) and
/// value.
struct Uniform
{
  std::string name;
  std::variant<int, float, glm::ivec2, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4,
    TextureBinding>
    value;
};

/// The camera's space, in which shaders have receivers.
struct ReceiverSpace
{
  glm::dmat4 centredFromView{ 1.0 }; ///< the camera's, rigid
  /// The area of a pixel across the view in squared world units is that of the square of side
  /// x + y * distance along the view.
  glm::dvec2 pixelSide{ 0.0 };
};

/// What a technique gets to draw its maps from.
struct MapInput
{
  const ShadowLight& light;
  const LightViews& views;
  const Occluders& occluders;
  const OccluderBuffers& buffers;
  ShaderLibrary& shaders;
  /// The last fits of views that await them, and the warps that were chosen (ReceiverFit.h).
  TextureBinding viewFits = {};
  /// A plane (n, d) in centred coordinates: of casters, only what has n.p + d >= 0 counts.
  std::optional<glm::dvec4> keptFromCentred = std::nullopt;
  /// Whether a conservative map is drawn by compute shaders rather than on the CPU.
  bool drawsOnGpu = false;
};

/// What a screen technique gets to draw one light's visibility image from, on the GPU.
struct LayerInput
{
  const ShadowLight& light;
  /// Of the light's views in this frame, for techniques that lay out more of them.
  const ViewFitting& fitting;
  const CameraView& camera;
  const ReceiverSpace& space; ///< the camera's
  const Occluders& occluders;
  const OccluderBuffers& buffers;  ///< up to date with the occluders
  const ReceiverTarget& receivers; ///< with points
  /// While this is the same, and so are the occluders, the receivers are.
  std::size_t receiversShown;
  const std::vector<DrawnSurface>& drawnSurfaces; ///< that the receivers' fragments name
  VisibilityLayers& layers;
  int layer;         ///< of the layers: this light's, the first one of several channels
  bool severalViews; ///< whether the pass draws other views beside this one
  ShaderLibrary& shaders;
  bool counting; ///< whether the report is worth reading back what only the GPU knows
  /// Where not null: to be filled with each pixel's class, an index into TechniqueInfo::classes.
  std::vector<std::uint8_t>* classes;
  std::vector<std::string>& notes; ///< FrameReport::notes
  int& mapBakes;                   ///< FrameReport::mapBakes
};

/// What a screen technique gets to compute one light's visibility image from, on the CPU.
struct ScreenInput
{
  const ShadowLight& light;
  /// Of the light's views in this frame, for techniques that lay out more of them.
  const ViewFitting& fitting;
  const Occluders& occluders;
  Receivers& receivers;
  ShadowTracer& tracer; ///< its structure is up to date with the occluders
  bool usesMap; ///< false: what the light baked is not to be used (TechniqueInfo::mapIsOptional)
  /// Where not null: to be filled with each pixel's class, an index into TechniqueInfo::classes.
  std::vector<std::uint8_t>* classes;
  /// Which tiles keep what the visibility and the classes hold; null: all are computed. Only exact
  /// techniques without a map need to heed it.
  TracedTiles* tiles;
  /// What is known of tiles without rays; null: nothing. Only exact techniques need to heed it.
  const TileVerdicts* verdicts;
  int& mapBakes; ///< FrameReport::mapBakes
};

/// One way to compute visibility, for one light: what all kinds share is the light's maps. The
/// render manager makes one per casting light from the registry, and keeps it while the light keeps
/// its technique.
class Technique
{
public:
  virtual ~Technique() = default;

  /// The light that the maps' views are laid out for, as the light's are (viewLayout()). Another
  /// one where a technique sees an area light from elsewhere than its centre, or reads more of the
  /// map than what the camera's receivers are on.
  virtual ShadowLight lightOfMap(const ShadowLight& light) const { return light; }
  /// How far around a receiver's place on the map the technique reads. Views are fitted for it, and
  /// the maps are stale when it changes.
  virtual MapReach mapReach(const ShadowLight&) const { return {}; }
  /// Bakes the light's maps. Called only when they are stale.
  virtual void bake(const MapInput&) {}
  /// Drops the light's maps. Called where they are stale and not baked
  /// (TechniqueInfo::mapIsOptional).
  virtual void dropMaps() {}
  /// Memory on the GPU of the baked maps, and of what else the technique keeps for the light.
  virtual std::size_t bytesOfMaps() const { return 0; }
};

/// A function of the point, in GLSL. Both routes call it: VTK's own shaders (inline) or a
/// full-screen pass (image).
class PointwiseTechnique : public Technique
{
public:
  /// A file that defines
  ///     float visibility_LIGHT(vec3 positionView, vec3 normalView)
  /// in GLSL 1.50 and its uniforms, for a light of this kind. The normal is the geometric one on
  /// the camera's side, of any length. Every identifier that ends in _LIGHT is numbered per light.
  virtual std::string visibilityGlsl(const ShadowLight&) const = 0;
  /// The uniforms of that source, as of the last bake, for receivers in a camera's view
  /// coordinates.
  virtual std::vector<Uniform> uniforms(const ReceiverSpace&) const = 0;
};

/// Draws the visibility of all pixels' receivers on the GPU, and reads nothing back.
class GpuScreenTechnique : public Technique
{
public:
  /// Fills the light's layer, or one for each channel: in [0, 1] for every pixel.
  virtual void drawVisibility(const LayerInput&, LightReport&) = 0;
};

/// Computes the visibility of all pixels' receivers on the CPU, where it may trace rays.
class CpuScreenTechnique : public Technique
{
public:
  /// Fills one float in [0, 1] per pixel; of several channels one image after the other.
  virtual void computeVisibility(const ScreenInput&, std::vector<float>&, LightReport&) = 0;
};

/// A technique of any kind, in the order of Evaluation.
using AnyTechnique = std::variant<std::unique_ptr<PointwiseTechnique>,
  std::unique_ptr<GpuScreenTechnique>, std::unique_ptr<CpuScreenTechnique>>;

/// What all kinds share.
inline Technique& baseOf(const AnyTechnique& technique)
{
  return std::visit([](const auto& any) -> Technique& { return *any; }, technique);
}

} // namespace gnomon
