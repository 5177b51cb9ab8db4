#include "VisibilityFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfVecAttribute.h>

#include <stdexcept>

namespace gnomon::check
{

//------------------------------------------------------------------------------
const std::vector<float>& VisibilityFile::channel(const std::string& name) const
{
  const auto place = this->channels.find(name);
  if (place == this->channels.end())
  {
    throw std::runtime_error("channel " + name + " is missing");
  }
  return place->second;
}

//------------------------------------------------------------------------------
Vec3 VisibilityFile::vector(const std::string& name, std::size_t pixel) const
{
  return { this->channel(name + ".X")[pixel], this->channel(name + ".Y")[pixel],
    this->channel(name + ".Z")[pixel] };
}

//------------------------------------------------------------------------------
VisibilityFile readVisibilityFile(const std::string& path)
{
  Imf::InputFile input(path.c_str());
  const Imf::Header& header = input.header();
  const Imath::Box2i window = header.dataWindow();
  VisibilityFile file;
  file.width = window.max.x - window.min.x + 1;
  file.height = window.max.y - window.min.y + 1;
  const auto* origin = header.findTypedAttribute<Imf::V3dAttribute>("origin");
  if (!origin)
  {
    throw std::runtime_error(path + ": the header has no attribute origin of type v3d");
  }
  file.origin = origin->value();

  const auto width = static_cast<std::size_t>(file.width);
  Imf::FrameBuffer frame;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
  {
    if (channel.channel().type != Imf::FLOAT)
    {
      throw std::runtime_error(path + ": channel " + channel.name() + " is not 32-bit float");
    }
    std::vector<float>& plane = file.channels[channel.name()];
    plane.resize(width * static_cast<std::size_t>(file.height));
    frame.insert(channel.name(),
      Imf::Slice::Make(Imf::FLOAT, plane.data(), window, sizeof(float), sizeof(float) * width));
  }
  input.setFrameBuffer(frame);
  input.readPixels(window.min.y, window.max.y);
  return file;
}

} // namespace gnomon::check
