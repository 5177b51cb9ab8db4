#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/transmittance/PointFilter.h"
#include "shadowtech/transmittance/VolumeStack.h"

#include <string>
#include <vector>

namespace gnomon
{

/// A light's stack of volumes on the GPU.
class VolumeTexture : public PointFilter
{
public:
  /// @param stack with grids; must outlive this
  /// @throws TextureMemoryError
  explicit VolumeTexture(const VolumeStack& stack);

  bool isColoured() const override { return false; }
  std::string name() const override { return "gnomonVolumes_LIGHT"; }
  std::string glsl() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

private:
  const VolumeStack& stack_;
  GlTexture slices_;
};

} // namespace gnomon
