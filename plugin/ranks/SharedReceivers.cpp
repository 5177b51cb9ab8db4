#include "plugin/ranks/SharedReceivers.h"

#include "shadowtech/base/Bytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace gnomon
{
namespace
{

constexpr std::size_t bitsOfWord = 64;

/// Give surfaces() its only surface.
Surface receivingSurface()
{
  Surface surface;
  surface.casts = false;
  return surface;
}

} // namespace

void keepNearest(
  Ranks& ranks, const std::vector<float>& windowDepths, std::vector<glm::vec2>& fragments)
{
  std::vector<float> nearest = windowDepths;
  ranks.reduceToLeast(nearest);
  for (std::size_t pixel = 0; pixel < fragments.size(); ++pixel)
  {
    if (windowDepths[pixel] != nearest[pixel])
    {
      fragments[pixel] = glm::vec2(0.0f);
    }
  }
}

void SharedReceivers::share(Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot)
{
  this->clear();
  this->surfaces_.frame = snapshot.frame;
  this->surfaces_.surfaces.assign(1, receivingSurface());

  const std::size_t pixels = own.size();
  this->claims_.assign((pixels + bitsOfWord - 1) / bitsOfWord, 0);
  this->packed_.clear();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    const std::uint32_t surface = own.surface[pixel];
    if (surface != ReceiverPixels::notCovered && snapshot.surfaces[surface].receives)
    {
      this->claims_[pixel / bitsOfWord] |= std::uint64_t(1) << pixel % bitsOfWord;
      PackedReceiver& receiver = this->packed_.emplace_back();
      for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
      {
        receiver.numbers[i] = (own.*ReceiverPixels::planes[i])[pixel];
      }
    }
  }
  ranks.gather(this->claims_, this->allClaims_);
  ranks.gather(this->packed_, this->all_);

  this->pixels_.resize(own.width, own.height);
  std::fill(this->pixels_.surface.begin(), this->pixels_.surface.end(), ReceiverPixels::notCovered);
  std::fill(this->pixels_.curved.begin(), this->pixels_.curved.end(), 0);
  this->isOwn_.assign(pixels, false);
  this->ties_ = 0;
  for (std::size_t rank = 0; rank + 1 < this->all_.firsts.size(); ++rank)
  {
    this->insert(static_cast<int>(rank) == ranks.own(),
      &this->allClaims_.elements[this->allClaims_.firsts[rank]],
      this->all_.elements.data() + this->all_.firsts[rank]);
  }
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    if (this->pixels_.surface[pixel] == ReceiverPixels::notCovered)
    {
      for (const auto plane : ReceiverPixels::planes)
      {
        (this->pixels_.*plane)[pixel] = 0.0f; // an earlier picture's
      }
    }
  }
  this->ownCount_ =
    static_cast<std::size_t>(std::count(this->isOwn_.begin(), this->isOwn_.end(), true));
  this->receivers_.emplace(this->pixels_);
}

void SharedReceivers::shareCurves(
  Ranks& ranks, const ReceiverPixels& own, const Occluders& snapshot, const PatchNames& names)
{
  std::vector<PlacedCurve> placed;
  for (std::size_t pixel = 0; pixel < own.curves.size(); ++pixel)
  {
    if (this->isOwn_[pixel] && own.curved[pixel] != 0)
    {
      const std::uint32_t surface = own.surface[pixel];
      ReceiverPixels::Curve curve = own.curves[pixel];
      const PatchName name =
        names[surface][curve.triangle - snapshot.surfaces[surface].firstTriangle];
      curve.process = name.process;
      curve.triangle = name.triangle;
      placed.push_back({ static_cast<std::uint32_t>(pixel), curve });
    }
  }
  ranks.gather(placed, this->allCurves_);
  this->pixels_.resize(this->pixels_.width, this->pixels_.height, true);
  for (const PlacedCurve& of : this->allCurves_.elements)
  {
    this->pixels_.curved[of.pixel] = 1;
    this->pixels_.curves[of.pixel] = of.curve;
  }
}

void SharedReceivers::shareSurfaces(
  Ranks& ranks, std::vector<glm::vec2>& fragments, const std::vector<std::size_t>& numbers)
{
  std::vector<float> shown(fragments.size(), 0.0f);
  for (std::size_t pixel = 0; pixel < fragments.size(); ++pixel)
  {
    glm::vec2& fragment = fragments[pixel];
    if (this->pixels_.surface[pixel] != ReceiverPixels::notCovered && !this->isOwn_[pixel])
    {
      fragment = glm::vec2(0.0f);
    }
    const float drawn = std::abs(fragment.x);                         // from 1
    if (drawn >= 1.0f && drawn <= static_cast<float>(numbers.size())) // NaN fails
    {
      shown[pixel] = -1.0f - static_cast<float>(numbers[static_cast<std::size_t>(drawn) - 1]);
    }
  }
  ranks.reduceToLeast(shown);
  this->surfaceOfPixel_.resize(shown.size());
  std::transform(shown.begin(), shown.end(), this->surfaceOfPixel_.begin(),
    [](float number) { return glm::vec2(number, 0.0f); });
}

std::size_t SharedReceivers::bytes() const
{
  return this->pixels_.bytes() + bytesOf(this->claims_) + bytesOf(this->packed_) +
    bytesOf(this->allClaims_.elements) + bytesOf(this->all_.elements) +
    bytesOf(this->allCurves_.elements) + bytesOf(this->surfaceOfPixel_) +
    this->isOwn_.capacity() / 8;
}

/// Insert a rank's receivers into the picture. Where several ranks drew the same depth, the
/// receivers' numbers decide, so that it does not matter which rank has which triangle. If two
/// ranks have the same triangle, their receivers are the same.
/// @param isOwn true if it is this rank
/// @param claims a bit for each pixel that has one of them
/// @param next the first of them
void SharedReceivers::insert(bool isOwn, const std::uint64_t* claims, const PackedReceiver* next)
{
  for (std::size_t word = 0; word * bitsOfWord < this->pixels_.size(); ++word)
  {
    for (std::uint64_t bits = claims[word]; bits != 0; bits &= bits - 1)
    {
      const std::size_t pixel = word * bitsOfWord + static_cast<std::size_t>(__builtin_ctzll(bits));
      const PackedReceiver& receiver = *next++;
      if (this->pixels_.surface[pixel] != ReceiverPixels::notCovered)
      {
        const PackedReceiver before = this->at(pixel);
        if (std::memcmp(&before, &receiver, sizeof(PackedReceiver)) == 0)
        {
          this->isOwn_[pixel] = this->isOwn_[pixel] || isOwn;
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
      this->isOwn_[pixel] = isOwn;
      for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
      {
        (this->pixels_.*ReceiverPixels::planes[i])[pixel] = receiver.numbers[i];
      }
    }
  }
}

SharedReceivers::PackedReceiver SharedReceivers::at(std::size_t pixel) const
{
  PackedReceiver receiver;
  for (std::size_t i = 0; i < ReceiverPixels::planes.size(); ++i)
  {
    receiver.numbers[i] = (this->pixels_.*ReceiverPixels::planes[i])[pixel];
  }
  return receiver;
}

} // namespace gnomon
