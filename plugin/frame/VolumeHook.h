#pragma once

#include "plugin/frame/HookGlsl.h"

#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// The hook's code in VTK's shaders of volumes. Samples are in no layer, so shaders call the
/// lights' pointwise techniques. Where VTK lights a sample, its colours of light N,
///     in_lightDiffuseColor[N], in_lightSpecularColor[N],
/// are multiplied by the light's visibility at the sample. So it works for all kinds of VTK's
/// lighting. Local arrays that hide VTK's uniforms would leave VTK's text alone, but cost 0.7 of a
/// frame where llvmpipe draws. Lights are numbered as for surfaces: among those switched on.
class VolumeHook
{
public:
  /// Construct the hook that changes nothing.
  VolumeHook() = default;
  /// @param viewIsRigid HookVariant::vtkViewIsRigid
  VolumeHook(bool viewIsRigid, const CastingLights& lights);

  bool operator==(const VolumeHook& other) const
  {
    return this->declarations_ == other.declarations_ && this->factors_ == other.factors_;
  }

  /// Change a fragment shader after VTK's own replacements. Shaders that do not light a single
  /// volume's samples, or that declare no number of lights, stay as they are.
  void fill(std::string& fragmentShader) const;

private:
  std::string declarations_;
  std::vector<std::pair<int, std::string>> factors_; ///< by VTK's number of the light
};

} // namespace gnomon
