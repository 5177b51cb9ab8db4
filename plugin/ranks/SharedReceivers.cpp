#include "plugin/ranks/SharedReceivers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace gnomon
{
namespace
{

constexpr std::size_t bitsOfWord = 64;

/// True if a word of bits has the bit of a pixel.
bool hasBit(const std::uint64_t* words, std::size_t pixel)
{
  return (words[pixel / bitsOfWord] >> pixel % bitsOfWord & 1u) != 0;
}

/// Give surfaces() its only surface.
Surface receivingSurface()
{
  Surface surface;
  surface.casts = false;
  return surface;
}

} // namespace

//------------------------------------------------------------------------------
SharedReceivers::SharedReceivers(Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot,
  std::vector<float> windowDepths)
{
  this->surfaces_.centreWorld = snapshot.centreWorld;
  this->surfaces_.surfaces.push_back(receivingSurface());

  // Which pixels show this rank's surface?
  const std::size_t pixels = own.size();
  const std::vector<float> ownDepths = windowDepths;
  ranks.takeLeast(windowDepths);
  std::vector<std::uint64_t> claims((pixels + bitsOfWord - 1) / bitsOfWord, 0);
  std::vector<Sent> sent;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    const std::uint32_t surface = own.surface[pixel];
    if (surface != ReceiverPixels::notCovered && ownDepths[pixel] == windowDepths[pixel] &&
      snapshot.surfaces[surface].receives)
    {
      claims[pixel / bitsOfWord] |= std::uint64_t(1) << pixel % bitsOfWord;
      Sent& receiver = sent.emplace_back();
      for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
      {
        receiver.numbers[i] = (own.*ReceiverPixels::planes[i])[pixel];
      }
    }
  }
  this->own_ = sent.size();
  const Ranks::Gathered<std::uint64_t> allClaims = ranks.gather(claims);
  const Ranks::Gathered<Sent> all = ranks.gather(sent);

  // Put them where they belong. Equal depths are decided by the receivers' numbers, so that it does
  // not matter which rank has which triangle; a triangle that two ranks have is the same receiver.
  this->pixels_.resize(own.width, own.height);
  for (const auto plane : ReceiverPixels::planes)
  {
    std::fill((this->pixels_.*plane).begin(), (this->pixels_.*plane).end(), 0.0f);
  }
  std::fill(this->pixels_.surface.begin(), this->pixels_.surface.end(), ReceiverPixels::notCovered);
  std::fill(this->pixels_.lifted.begin(), this->pixels_.lifted.end(), std::uint8_t(0));
  for (int rank = 0; rank < ranks.count(); ++rank)
  {
    const auto number = static_cast<std::size_t>(rank);
    const std::uint64_t* const claimed = &allClaims.elements[allClaims.firsts[number]];
    const Sent* next = all.elements.data() + all.firsts[number];
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      if (!hasBit(claimed, pixel))
      {
        continue;
      }
      const Sent& receiver = *next++;
      Sent before;
      for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
      {
        before.numbers[i] = (this->pixels_.*ReceiverPixels::planes[i])[pixel];
      }
      const bool isTaken = this->pixels_.surface[pixel] != ReceiverPixels::notCovered;
      if (isTaken)
      {
        if (std::memcmp(&before, &receiver, sizeof(Sent)) == 0)
        {
          continue;
        }
        ++this->ties_;
        if (!std::lexicographical_compare(std::begin(receiver.numbers), std::end(receiver.numbers),
              std::begin(before.numbers), std::end(before.numbers)))
        {
          continue;
        }
      }
      this->pixels_.surface[pixel] = 0;
      for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
      {
        (this->pixels_.*ReceiverPixels::planes[i])[pixel] = receiver.numbers[i];
      }
    }
  }
  this->receivers_.emplace(this->pixels_);
}

} // namespace gnomon
