#include "shadowtech/transmittance/VolumeTexture.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/gtc/matrix_transform.hpp>

#include <numeric>

namespace gnomon
{

//------------------------------------------------------------------------------
VolumeTexture::VolumeTexture(const VolumeStack& stack)
  : stack_(stack)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  const std::vector<VolumeStack::Grid>& grids = stack.grids();
  const glm::ivec3& points = grids.front().points; // of sides of a cube, all have the same
  const int slices = std::accumulate(grids.begin(), grids.end(), 0,
    [](int sum, const VolumeStack::Grid& grid) { return sum + grid.points.z; });
  allocateTexture(this->slices_, { GL_R16, GL_RED, 1, GL_UNSIGNED_SHORT }, points.x, points.y,
    slices, "what volumes leave of a light");
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  int first = 0;
  for (const VolumeStack::Grid& grid : grids)
  {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, first, points.x, points.y, grid.points.z, GL_RED,
      GL_UNSIGNED_SHORT, grid.left.data());
    first += grid.points.z;
  }
}

//------------------------------------------------------------------------------
std::string VolumeTexture::glsl() const
{
  return glslDefine("VOLUME_GRIDS_LIGHT", static_cast<int>(this->stack_.grids().size())) +
    glslDefine("VOLUME_LAMP_LIGHT", this->stack_.isOfLamp() ? 1 : 0) +
    ShaderLibrary::source("shadowtech/transmittance/volumes.glsl");
}

//------------------------------------------------------------------------------
std::vector<Uniform> VolumeTexture::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms{ { "volumes_LIGHT",
    TextureBinding{ GL_TEXTURE_2D_ARRAY, this->slices_.name() } } };
  const glm::dmat4 toOrigin =
    glm::translate(glm::dmat4(1.0), -this->stack_.origin()) * space.centredFromView;
  int first = 0;
  for (std::size_t i = 0; i < this->stack_.grids().size(); ++i)
  {
    const VolumeStack::Grid& grid = this->stack_.grids()[i];
    const int last = first + grid.points.z - 1;
    const auto add = [&](const char* name, const auto& value) {
      uniforms.push_back({ glslElement(name, i), value });
    };
    add("volumeFromView_LIGHT", glm::mat4(glm::dmat4(grid.lightFromCentred) * toOrigin));
    add("volumeLower_LIGHT", glm::vec3(grid.lower));
    add("volumeExtent_LIGHT", glm::vec3(grid.upper - grid.lower));
    add("volumeSlices_LIGHT", glm::vec2(first, last));
    first = last + 1;
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string ThroughVolumes::visibilityGlsl(const ShadowLight& light) const
{
  return this->volumes_.glsl() + "#define visibility_LIGHT gnomonSurfaces_LIGHT\n" +
    this->surfaces_.visibilityGlsl(light) +
    "#undef visibility_LIGHT\n"
    "float visibility_LIGHT(vec3 positionView, vec3 normalView)\n{\n"
    "  return gnomonSurfaces_LIGHT(positionView, normalView) * "
    "gnomonVolumes_LIGHT(positionView);\n}\n";
}

//------------------------------------------------------------------------------
std::vector<Uniform> ThroughVolumes::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->surfaces_.uniforms(space);
  const std::vector<Uniform> ofVolumes = this->volumes_.uniforms(space);
  uniforms.insert(uniforms.end(), ofVolumes.begin(), ofVolumes.end());
  return uniforms;
}

} // namespace gnomon
