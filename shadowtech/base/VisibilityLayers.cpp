#include "shadowtech/base/VisibilityLayers.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{

//------------------------------------------------------------------------------
void VisibilityLayers::resize(int width, int height, int layers)
{
  if (this->have(width, height, layers))
  {
    return;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  this->width_ = 0; // in case that there is no memory
  allocateTexture(
    this->texture_, { GL_R32F, GL_RED, 1 }, width, height, layers, "the lights' visibility");
  this->width_ = width;
  this->height_ = height;
  this->layers_ = layers;
}

//------------------------------------------------------------------------------
void VisibilityLayers::estimate(int layer, const PointwiseTechnique& technique,
  const ShadowLight& light, const ReceiverTarget& receivers, const ReceiverSpace& space,
  ShaderLibrary& shaders, std::vector<std::uint8_t>* classes)
{
  const GlStateGuard guard;
  GlTexture ofPixels;
  std::vector<std::string> defines;
  if (classes)
  {
    glActiveTexture(GL_TEXTURE0);
    allocateTexture(ofPixels, { GL_R8UI, GL_RED_INTEGER, 1, GL_UNSIGNED_BYTE }, this->width_,
      this->height_, 0, "the pixels' classes");
    defines.emplace_back("CLASSES");
  }
  const GLuint program = ScreenPass::use(shaders,
    numberedForLight(technique.visibilityGlsl(light), 0) +
      ShaderLibrary::source("shadowtech/base/screen_visibility.frag.glsl"),
    defines);
  const int freeUnit = ShaderLibrary::setUniforms(program,
    { { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, receivers.fragments() } },
      { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, receivers.points() } } },
    0, 0);
  ShaderLibrary::setUniforms(program, technique.uniforms(space), 0, freeUnit);
  if (!classes)
  {
    this->fill(layer);
    return;
  }
  this->screenPass_.fill(
    { { this->texture_.name(), layer }, { ofPixels.name() } }, this->width_, this->height_);
  classes->resize(static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, ofPixels.name());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, classes->data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::fill(int layer)
{
  this->screenPass_.fill({ { this->texture_.name(), layer } }, this->width_, this->height_);
}

//------------------------------------------------------------------------------
void VisibilityLayers::upload(int firstLayer, const std::vector<float>& visibility)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->texture_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const std::size_t pixels =
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, firstLayer, this->width_, this->height_,
    static_cast<GLsizei>(visibility.size() / pixels), GL_RED, GL_FLOAT, visibility.data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::read(int layer, std::vector<float>& visibility) const
{
  const GlStateGuard guard;
  visibility.resize(
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_));
  GlFramebuffer framebuffer;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.create());
  glFramebufferTextureLayer(
    GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->texture_.name(), 0, layer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, this->width_, this->height_, GL_RED, GL_FLOAT, visibility.data());
}

//------------------------------------------------------------------------------
std::size_t VisibilityLayers::bytes() const
{
  return static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_) *
    static_cast<std::size_t>(this->layers_) * sizeof(float);
}

} // namespace gnomon
