#pragma once

#include "plugin/plan/Route.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon
{

class CastingLights;
struct CastingLight;

/// HookVariant::skyLayer without a sky.
inline constexpr int noSkyLayer = -1;

/// The tasks of a frame's shaders, besides their lights.
struct HookVariant
{
  Route route = Route::Inline;
  bool receiverPoints = false; ///< image route: the receivers stage writes points and normals, too
  bool multisampled = false;   ///< pixels have several samples, and a surface may cover some of
                               ///< them
  Numbering numbering = Numbering::All; ///< None on the inline route
  bool vtkViewIsRigid = true;           ///< ShownView::viewFromVtkView is the identity
  bool anySeenThrough = false;          ///< true if DrawnProps::seenThrough has some
  bool anyCatcher = false;              ///< DrawnProps::anyCatcher
  int layers = 0;                       ///< image route: FramePlan::layers
  int bits = 0;                         ///< image route: FramePlan::bits
  int skyLayer = noSkyLayer;            ///< image route: the layer of the view of the sky
  int edgeBit = noBit;                  ///< image route: FramePlan::edgeBit
  bool volumes = false;                 ///< PicturePlan::shadesVolumes (VolumeHook.h)
};

/// Return the expression of the factor of a light's colour if nothing hides the light; a uniform if
/// the light has a texture.
std::string litOf(const CastingLight& casting, int light);

/// The hook's code in VTK's shaders. Before VTK's light loop it puts, per casting light N,
///     vec3 lightColorN = lightColorN * (visibility of light N);
/// For a light with a texture the visibility is a colour, and the texture's mean in full light. The
/// local variable hides VTK's uniform of the same name, so VTK's loop works with the shadowed
/// colour, for every shading model and kind of light. The hook relies on the uniforms' names alone.
///
/// A sky lights by the material's own terms, before VTK's lights:
///     ambientColor = (view of the sky) * (ambientColor + (light of the sky) * diffuseColor);
/// Physically based materials use neither. There the hook changes two of VTK's lines, with `Lo` for
/// lights and `iblDiffuse` for an environment.
///
/// A shadow catcher is lit twice, as if nothing cast and as it is, and shows the difference.
///
/// On the image route the same programs also serve the receivers stage, where a uniform selects the
/// stage, or it has programs of its own (Numbering). On the deferred route they light each fragment
/// twice, as if all of it were lit and as if none were, and write its triangle.
class HookGlsl
{
public:
  HookGlsl() = default;
  HookGlsl(const HookVariant& variant, const CastingLights& lights);

  /// True if both are alike but for the stage that they serve.
  bool operator==(const HookGlsl& other) const;

  /// Serve a stage.
  /// @return true if the last one had other programs
  bool serve(bool receiversStage);

  /// The first half of the hook, before VTK's own replacements.
  void mark(
    std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const;
  /// The second half, after them.
  /// @param drawsReceivers true if this prop's shader must be able to write receivers
  /// @param corners of the primitives that are numbered by a geometry shader; 0: by the driver
  void fill(const std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, bool drawsReceivers, int corners) const;

  const HookVariant& variant() const { return this->variant_; }
  /// Return the names of the declared samplers by type.
  std::map<std::string, std::vector<std::string>> samplers() const;

private:
  void addImages();
  void addLights(const CastingLights& lights);
  std::string lightOfSky(const std::string& fragmentShader, const std::string& view) const;
  std::string lightInShadow(const std::string& fragmentShader) const;
  std::string lightWithoutCasters(const std::string& fragmentShader) const;
  std::string writeReceiver(bool receives, const std::string& primitive) const;

  HookVariant variant_;
  bool receiversStage_ = false; ///< of programs of its own
  bool hasLights_ = false;      ///< or a sky
  std::string extensions_;
  std::string declarations_;
  std::string uniformFlow_;     ///< statements that must be in uniform control flow
  std::string multiplications_; ///< and statements before VTK's light loop
  std::string darkenings_;      ///< deferred route: the same for the colour in shadow
  std::string brightenings_;    ///< with shadow catchers: the same for that without casters
};

} // namespace gnomon
