#pragma once

#include "lights/CameraView.h"
#include "lights/LightViews.h"
#include "lights/MapReach.h"
#include "lights/SettingsTable.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"
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
class EmbreeTracer;
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

/// The description of an estimator, independent of any instance: its entry in the registry.
struct TechniqueInfo
{
  std::string name;
  Evaluation evaluation = Evaluation::Pointwise; ///< follows from its class (Registry.cpp)
  bool exact = false;                            ///< equals the ray-traced visibility bit for bit
  /// The tables of settings that it reads, besides the light's area.
  std::vector<const SettingsTable*> settings = {};
  /// The name of the estimator by the letter of the publication, which `as_published` selects. A
  /// published estimator names itself. Empty: there is none.
  std::string asPublished = {};
  /// True if a point takes longer than its shading by VTK. The image route then asks once per
  /// pixel, and again only after a change.
  bool isSlow = false;
  /// True if it shows the same without its map. The map saves time if it serves several frames.
  bool mapIsOptional = false;
  bool conservativeMap = false; ///< its map is a conservative one, which the CPU bakes
  bool marchesVolumes = false;  ///< its rays march through volumes, where others read slices
  /// The kernel's name in the report, for a technique with a filter; empty: the value of the
  /// setting `kernel`.
  std::string kernel = {};

  /// True if its visibility has three channels in a light with a texture (channelsOf()). For other
  /// techniques such a light is even, with the texture's mean colour.
  bool seesTextures = false;

  /// The largest memory of a light's maps, in bytes per texel of one map; null: depends on the
  /// casters.
  std::function<double(const ShadowLight&)> bytesPerTexel = {};
  double bytesPerPixel = 0.0; ///< largest memory besides maps, per pixel of the picture

  /// Functions that return why it cannot follow a light's settings, whose projection is resolved;
  /// empty if it can. The first reason counts.
  std::vector<std::string (*)(const ShadowLight&)> refused = {};

  /// The classes of its pixels; empty: it does not classify them. A screen technique fills
  /// ScreenInput::classes or LayerInput::classes. A pointwise one sets `int pixelClass_LIGHT` in
  /// each call of its GLSL.
  std::vector<PixelClass> classes = {};

  bool isPointwise() const { return this->evaluation == Evaluation::Pointwise; }
  bool has(const SettingsTable& table) const
  {
    return std::find(this->settings.begin(), this->settings.end(), &table) != this->settings.end();
  }
  bool bakesMap() const { return this->has(viewSettings()); }
};

/// Return the channels of a light's visibility: 1, or 3 (red, green, blue) if the technique sees
/// the texture of the light's area.
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

/// A uniform's name, as in the GLSL file with its _LIGHT suffix, and its value. An element of an
/// array is a uniform of its own.
struct Uniform
{
  std::string name;
  std::variant<int, float, glm::ivec2, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4,
    TextureBinding>
    value;
};

/// The camera's space, which receivers have in shaders.
struct ReceiverSpace
{
  glm::dmat4 centredFromView{ 1.0 }; ///< of the camera, rigid
  /// A pixel's side across the view in world units is x + y * distance along the view. Its square
  /// is the pixel's area.
  glm::dvec2 pixelSide{ 0.0 };
};

/// The input of a technique that bakes its maps.
struct MapInput
{
  const ShadowLight& light;
  const LightViews& views;
  const Occluders& occluders;
  const OccluderBuffers& buffers;
  ShaderLibrary& shaders;
  /// The fits of views that await them and the chosen warps, found on the GPU (ReceiverFit.h).
  TextureBinding viewFits = {};
  /// A plane (n, d) in centred coordinates: only the part of the casters with n.p + d >= 0 counts.
  std::optional<glm::dvec4> keptFromCentred = std::nullopt;
};

/// The input of a screen technique that draws one light's visibility image on the GPU.
struct LayerInput
{
  const ShadowLight& light;
  /// The fitting of the light's views in this frame, for techniques that lay out further views.
  const ViewFitting& fitting;
  const CameraView& camera;
  const ReceiverSpace& space; ///< of the camera
  const Occluders& occluders;
  const OccluderBuffers& buffers;                 ///< up to date with the occluders
  const ReceiverTarget& receivers;                ///< with points
  const std::vector<DrawnSurface>& drawnSurfaces; ///< named by the receivers' fragments
  VisibilityLayers& layers;
  ShaderLibrary& shaders;
  std::vector<std::string>& notes; ///< FrameCounts::notes
  int& mapBakes;                   ///< FrameCounts::mapBakes

  int layer = 0; ///< this light's layer, or the first of its channels
  /// A number that changes with the receivers. They are the same while it and the occluders are.
  std::size_t receiversShown = 0;
  bool severalViews = false; ///< the pass draws other views besides this one
  bool counting = false;     ///< the report needs counts that must be read back from the GPU
  /// If not null, to be filled with each pixel's class, an index into TechniqueInfo::classes.
  std::vector<std::uint8_t>* classes = nullptr;
};

/// The input of a screen technique that computes one light's visibility image on the CPU.
struct ScreenInput
{
  const ShadowLight& light;
  /// The fitting of the light's views in this frame, for techniques that lay out further views.
  const ViewFitting& fitting;
  const Occluders& occluders;
  Receivers& receivers;
  EmbreeTracer& tracer; ///< its structure is up to date with the occluders
  int& mapBakes;        ///< FrameCounts::mapBakes

  bool usesMap = false; ///< false: ignore the light's baked map (TechniqueInfo::mapIsOptional)
  /// If not null, to be filled with each pixel's class, an index into TechniqueInfo::classes.
  std::vector<std::uint8_t>* classes = nullptr;
  /// The tiles whose visibility and classes are reused; null: compute all. Only exact techniques
  /// without a map need to heed it.
  TracedTiles* tiles = nullptr;
  /// Tiles that are decided without rays; null: none. Only exact techniques need to heed them.
  const TileVerdicts* verdicts = nullptr;
};

/// One way to compute visibility, for one light. All kinds of technique share its functions for
/// maps. The render manager makes one per casting light from the registry, and reuses it while the
/// light keeps its technique.
class Technique
{
public:
  virtual ~Technique() = default;

  /// Return the light whose views the maps have; the layout is that of the given light's views
  /// (viewLayout()). Techniques change the light to see an area light from elsewhere than its
  /// centre, or to read more of the map than the part under the camera's receivers.
  virtual ShadowLight lightOfMap(const ShadowLight& light) const { return light; }
  /// Return how far around a receiver's place on the map the technique reads. Views are fitted for
  /// this reach, and the maps are stale when it changes.
  virtual MapReach mapReach(const ShadowLight&) const { return {}; }
  /// Bake the light's maps. Called only if they are stale.
  virtual void bake(const MapInput&) {}
  /// Drop the light's maps. Called if they are stale and not baked (TechniqueInfo::mapIsOptional).
  virtual void dropMaps() {}
  /// Return the bytes of the baked maps, and of everything that the technique caches for the light.
  virtual std::size_t bytesOfMaps() const { return 0; }
};

/// A function of the point, in GLSL. Both routes call it: VTK's own shaders (inline) or a
/// full-screen pass (image).
class PointwiseTechnique : public Technique
{
public:
  /// Return the source that defines
  ///     float visibility_LIGHT(vec3 positionView, vec3 normalView)
  ///     float visibilityAt_LIGHT(vec3 positionView)
  /// in GLSL 1.50 and its uniforms, for a light of this kind. The normal is the geometric one on
  /// the camera's side, of any length; the second function is of places without a surface. Every
  /// identifier that ends in _LIGHT is numbered per light.
  virtual std::string visibilityGlsl(const ShadowLight&) const = 0;
  /// Return the uniforms of that source, as of the last bake, for receivers in a camera's view
  /// coordinates.
  virtual std::vector<Uniform> uniforms(const ReceiverSpace&) const = 0;
};

/// Draws the visibility of all pixels' receivers on the GPU, without reading back.
class GpuScreenTechnique : public Technique
{
public:
  /// Fill the light's layer, or one layer per channel: in [0, 1] for every pixel.
  virtual void drawVisibility(const LayerInput&, LightCounts&) = 0;
};

/// Computes the visibility of all pixels' receivers on the CPU, and may trace rays.
class CpuScreenTechnique : public Technique
{
public:
  /// Fill one float in [0, 1] per pixel; of several channels one image after the other.
  virtual void computeVisibility(const ScreenInput&, std::vector<float>&, LightCounts&) = 0;
};

/// A technique of any kind, in the order of Evaluation.
using AnyTechnique = std::variant<std::unique_ptr<PointwiseTechnique>,
  std::unique_ptr<GpuScreenTechnique>, std::unique_ptr<CpuScreenTechnique>>;

inline Technique& baseOf(const AnyTechnique& technique)
{
  return std::visit([](const auto& any) -> Technique& { return *any; }, technique);
}

} // namespace gnomon
