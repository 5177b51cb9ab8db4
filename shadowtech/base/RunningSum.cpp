#include "shadowtech/base/RunningSum.h"

#include "shadowtech/base/Bytes.h"

namespace gnomon
{

//------------------------------------------------------------------------------
void RunningSum::begin(int width, int height, const char* what)
{
  this->isEmpty_ = true;
  const TexelFormat format = this->channels_ == 1 ? TexelFormat{ GL_R32F, GL_RED, 1 }
                                                  : TexelFormat{ GL_RGBA32F, GL_RGBA, 4 };
  glActiveTexture(GL_TEXTURE0);
  for (SizedTexture& image : this->images_)
  {
    image.allocate(format, width, height, 0, what);
  }
}

//------------------------------------------------------------------------------
void RunningSum::clear()
{
  this->images_ = {};
  this->isEmpty_ = true;
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
  const SizedTexture& image = this->images_[this->newest_];
  this->screenPass_.fill({ { image.name() } }, image.width(), image.height());
  this->isEmpty_ = false;
}

//------------------------------------------------------------------------------
std::size_t RunningSum::bytes() const
{
  return bytesOfAll(this->images_, &SizedTexture::bytes);
}

} // namespace gnomon
