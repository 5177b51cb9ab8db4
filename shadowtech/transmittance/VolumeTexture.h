#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/transmittance/VolumeStack.h"

#include <string>
#include <vector>

namespace gnomon
{

/// A light's stack of volumes on the GPU.
class VolumeTexture
{
public:
  /// @param stack must outlive this
  /// @throws TextureMemoryError
  explicit VolumeTexture(const VolumeStack& stack);

  /// Return the source that defines
  ///     float gnomonVolumes_LIGHT(vec3 positionView)
  /// in GLSL 1.50, the share of the light that volumes leave at a point, and its uniforms.
  std::string glsl() const;
  /// Return the uniforms of that source, for points in a camera's view coordinates.
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const;

private:
  const VolumeStack& stack_;
  GlTexture slices_;
};

/// A technique whose light volumes take their share of.
class ThroughVolumes : public PointwiseTechnique
{
public:
  /// @param surfaces, volumes must outlive this
  ThroughVolumes(const PointwiseTechnique& surfaces, const VolumeTexture& volumes)
    : surfaces_(surfaces)
    , volumes_(volumes)
  {
  }
  std::string visibilityGlsl(const ShadowLight& light) const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

private:
  const PointwiseTechnique& surfaces_;
  const VolumeTexture& volumes_;
};

} // namespace gnomon
