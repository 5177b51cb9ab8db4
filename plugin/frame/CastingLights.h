#pragma once

#include "lights/LightManager.h"
#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/LightTechnique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct FrameWishes;

/// What a light keeps from frame to frame.
struct KeptTechniques
{
  LightTechnique own;
  /// Shades translucent surfaces where the light's own technique works on the screen, and all of
  /// them in frames that move where the light leaves its technique to the pass; else none.
  std::optional<LightTechnique> plain;
};
/// By the lights' places in the scene.
using TechniquesOfLights = std::map<int, KeptTechniques>;
std::size_t bytesOfMaps(const TechniquesOfLights& techniques);

/// A light that casts in this frame, and what shades it.
struct CastingLight : KeptTechniques
{
  ShadowLight light;
  int channels = 1;            ///< of its visibility, a layer each
  int layer = 0;               ///< of the visibility layers, its first
  int bit = noBit;             ///< or of their image of bits
  bool shadesAtPoints = false; ///< whether shaders call a technique for it
  bool isStale = true;         ///< image route: whether its visibility is computed in this frame
  bool mayKeepTiles = false;   ///< and whether nothing changed but what may leave some tiles
  /// Of an area light in a picture at rest that may refine, the samples of its first frame; 0: all.
  int firstSamples = 0;
  /// Of a light that leaves its technique to the pass, the largest map that a memory budget allows.
  int mostMapTexels = std::numeric_limits<int>::max();
  /// Of a light that leaves its technique to the pass, what it asks for; none of others.
  std::optional<ShadowLight> asked = std::nullopt;
  /// What such a light has at rest, while a map shades it.
  struct Resting
  {
    ShadowLight light;
    LightTechnique technique;
  };
  std::optional<Resting> resting = std::nullopt;

  /// What the shader computes the light's visibility with on a route; null if it only fetches. From
  /// here on there is a plain technique where one is needed.
  /// @param translucentReceivers whether translucent surfaces receive
  const PointwiseTechnique* pointwiseOn(Route route, bool translucentReceivers);
};

/// Whether a light's technique traces from receivers on the CPU.
bool isOnCpu(const CastingLight& casting);
/// How many shadow rays a pixel at an edge gets. Area lights have no edges.
std::size_t edgeSamplesOf(const CastingLight& casting);

/// Whether OpenGL is new enough (4.3) for techniques that work on the GPU; the context is current.
bool canDrawMaps();

/// The lights stage: which of a renderer's lights cast, in the scene's order, each with the
/// technique that it keeps for as long as it asks for the same estimator.
class CastingLights
{
public:
  /// Reads the lights as they are now, and says of each in the report what becomes of it.
  /// @param ofView what lights whose maps are fitted to a camera keep for this view
  void collect(vtkRenderer* renderer, const ShadowSettings& defaults, const FrameWishes& wishes,
    TechniquesOfLights& ofView, FrameReport& report);

  ///@{
  /// For this frame, has a light that leaves its technique to the pass shaded by a plain map, or
  /// again by what it has at rest.
  /// @return takeMap: why it cannot be, as a clause; empty if it is
  std::string takeMap(CastingLight& casting, int mapSizeTexels, FrameReport& report);
  void takeResting(CastingLight& casting, FrameReport& report);
  ///@}

  /// Ends a frame: what the lights have goes back to where collect() took it from.
  void giveBack(TechniquesOfLights& ofView);

  bool empty() const { return this->lights_.empty(); }
  std::size_t size() const { return this->lights_.size(); }
  std::vector<CastingLight>::iterator begin() { return this->lights_.begin(); }
  std::vector<CastingLight>::iterator end() { return this->lights_.end(); }
  std::vector<CastingLight>::const_iterator begin() const { return this->lights_.begin(); }
  std::vector<CastingLight>::const_iterator end() const { return this->lights_.end(); }

  /// Whether any of their techniques is such a one.
  template <typename IsSuch>
  bool anyTechnique(const IsSuch& isSuch) const
  {
    return std::any_of(this->lights_.begin(), this->lights_.end(),
      [&](const CastingLight& casting) { return isSuch(casting.own.info()); });
  }

  /// Memory of the maps that serve all views.
  std::size_t bytesOfMaps() const { return gnomon::bytesOfMaps(this->ofAllViews_); }

  ///@{
  /// How many visibility layers they fill, and how many bits.
  int layers() const { return this->layers_; }
  int bits() const { return this->bits_; }
  ///@}

private:
  void placeVisibility();
  TechniquesOfLights& placeOf(const ShadowLight& light, TechniquesOfLights& ofView);
  CastingLight take(ShadowLight light, const EstimatorEntry& estimator, TechniquesOfLights& ofView);

  LightManager manager_;
  TechniquesOfLights ofAllViews_;    ///< of lights whose maps serve all views
  std::vector<CastingLight> lights_; ///< by their place in the scene
  int layers_ = 0;
  int bits_ = 0;
};

/// What the report says of a light that it has.
LightReport& reportOf(FrameReport& report, const ShadowLight& light);

} // namespace gnomon
