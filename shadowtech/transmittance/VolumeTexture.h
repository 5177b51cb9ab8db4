#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/transmittance/PointFilter.h"
#include "shadowtech/transmittance/VolumeStack.h"

#include <numeric>
#include <string>
#include <vector>

namespace gnomon
{

class VolumeTexture : public PointFilter
{
public:
  /// @param stack with grids; must outlive this
  /// @throws TextureMemoryError
  explicit VolumeTexture(const VolumeStack& stack)
    : stack_(stack)
  {
    const GlStateGuard guard;
    glActiveTexture(GL_TEXTURE0);
    const std::vector<LightGrid>& grids = stack.grids().grids();
    const glm::ivec3& points = grids.front().points;
    const int slices = std::accumulate(grids.begin(), grids.end(), 0,
      [](int sum, const LightGrid& grid) { return sum + grid.points.z; });
    allocateTexture(this->slices_, { GL_R16, GL_RED, 1, GL_UNSIGNED_SHORT }, points.x, points.y,
      slices, "what volumes leave of a light");
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    int first = 0;
    for (std::size_t i = 0; i < grids.size(); ++i)
    {
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, first, points.x, points.y, grids[i].points.z,
        GL_RED, GL_UNSIGNED_SHORT, stack.left()[i].data());
      first += grids[i].points.z;
    }
  }

  bool isColoured() const override { return false; }
  std::string name() const override { return "gnomonVolumes_LIGHT"; }
  std::string glsl() const override
  {
    const LightGrids& grids = this->stack_.grids();
    return glslDefine("VOLUME_GRIDS_LIGHT", static_cast<int>(grids.grids().size())) +
      glslDefine("VOLUME_LAMP_LIGHT", grids.isOfLamp() ? 1 : 0) +
      ShaderLibrary::source("shadowtech/transmittance/volumes.glsl");
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms = this->stack_.grids().uniforms("volume", space);
    uniforms.push_back(
      { "volumes_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->slices_.name() } });
    int first = 0;
    for (std::size_t i = 0; i < this->stack_.left().size(); ++i)
    {
      const int last = first + this->stack_.grids().grids()[i].points.z - 1;
      uniforms.push_back({ glslElement("volumeSlices_LIGHT", i), glm::vec2(first, last) });
      first = last + 1;
    }
    return uniforms;
  }

private:
  const VolumeStack& stack_;
  GlTexture slices_;
};

} // namespace gnomon
