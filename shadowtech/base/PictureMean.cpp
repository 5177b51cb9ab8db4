#include "shadowtech/base/PictureMean.h"

#include "shadowtech/base/GlState.h"

namespace gnomon
{
namespace
{

/// Unbind textures with several samples, which GlStateGuard does not restore.
void unbind(const DrawnPicture& picture, int units)
{
  for (int unit = 0; picture.samples > 1 && unit < units; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
  }
}

} // namespace

//------------------------------------------------------------------------------
void PictureMean::begin(const glm::ivec2& size, double gamma)
{
  const GlStateGuard guard;
  this->pictures_ = 0;
  this->sum_.begin(size.x, size.y, "the sum of pictures");
  this->size_ = size;
  this->gamma_ = gamma;
}

//------------------------------------------------------------------------------
void PictureMean::add(const DrawnPicture& picture)
{
  const GlStateGuard guard;
  std::vector<Uniform> uniforms = this->sum_.before();
  uniforms.push_back({ "picture", picture.colours });
  const int units = this->use("shadowtech/base/picture_sum.frag.glsl", picture, uniforms);
  this->sum_.fill();
  ++this->pictures_;
  unbind(picture, units);
}

//------------------------------------------------------------------------------
void PictureMean::show(const DrawnPicture& depths, const glm::ivec2& origin)
{
  const GlStateGuard guard;
  const int units = this->use("shadowtech/base/picture_mean.frag.glsl", depths,
    { { "sum", TextureBinding{ GL_TEXTURE_2D, this->sum_.texture() } }, { "depths", depths.depths },
      { "pictures", static_cast<float>(this->pictures_) }, { "origin", origin } });
  this->screenPass_.fillBound(origin, this->size_);
  unbind(depths, units);
}

//------------------------------------------------------------------------------
/// Use a shader that reads a picture.
/// @return the number of its texture units
int PictureMean::use(
  const std::string& glslPath, const DrawnPicture& picture, std::vector<Uniform> uniforms)
{
  std::vector<std::string> defines{ "SAMPLES " + std::to_string(picture.samples) };
  if (this->gamma_ != 1.0)
  {
    defines.emplace_back("ENCODED");
    uniforms.push_back({ "gamma", static_cast<float>(this->gamma_) });
  }
  const GLuint program = ScreenPass::use(this->shaders_, ShaderLibrary::source(glslPath), defines);
  return ShaderLibrary::setUniforms(program, uniforms, 0, 0);
}

} // namespace gnomon
