#include "shadowtech/base/RunningSum.h"

#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{

//------------------------------------------------------------------------------
void RunningSum::begin(int width, int height, const char* what)
{
  this->isEmpty_ = true;
  if (this->width_ == width && this->height_ == height)
  {
    return;
  }
  this->width_ = 0; // in case the allocation fails
  const TexelFormat format = this->channels_ == 1 ? TexelFormat{ GL_R32F, GL_RED, 1 }
                                                  : TexelFormat{ GL_RGBA32F, GL_RGBA, 4 };
  glActiveTexture(GL_TEXTURE0);
  for (GlTexture& image : this->images_)
  {
    allocateTexture(image, format, width, height, 0, what);
  }
  this->width_ = width;
  this->height_ = height;
}

//------------------------------------------------------------------------------
void RunningSum::clear()
{
  for (GlTexture& image : this->images_)
  {
    image.reset();
  }
  this->isEmpty_ = true;
  this->width_ = 0;
  this->height_ = 0;
}

//------------------------------------------------------------------------------
std::vector<Uniform> RunningSum::before() const
{
  return { { "sumBefore", TextureBinding{ GL_TEXTURE_2D, this->texture() } },
    { "sumIsEmpty", this->isEmpty_ ? 1 : 0 } };
}

//------------------------------------------------------------------------------
void RunningSum::fill()
{
  this->newest_ = 1 - this->newest_;
  this->screenPass_.fill({ { this->texture() } }, this->width_, this->height_);
  this->isEmpty_ = false;
}

//------------------------------------------------------------------------------
std::size_t RunningSum::bytes() const
{
  return this->images_.size() * static_cast<std::size_t>(this->channels_) *
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_) *
    sizeof(float);
}

} // namespace gnomon
