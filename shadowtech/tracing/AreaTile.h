#pragma once

#include "lights/LightSamples.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gnomon
{

/// The number of pixels of a row whose rays to an area light are computed together.
constexpr std::size_t pixelsTogether = 16;
static_assert(TracedTile::columns % pixelsTogether == 0, "they lie in one row");

template <typename Number>
using Together = std::array<Number, pixelsTogether>;

/// Return the rays of a tile's pixels that need any, to all samples of an area light.
inline SampleRays raysToAll(const TracedTile& tile, std::uint32_t count)
{
  SampleRays rays;
  rays.samples.resize(count);
  std::iota(rays.samples.begin(), rays.samples.end(), 0u);
  rays.pixels.resize(TracedTile::pixels);
  for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
  {
    if (tile.needed[pixel] != 0)
    {
      rays.pixels[pixel] = { count, 1, 0, count };
    }
  }
  return rays;
}

/// The rays of a tile's pixels to an area light's samples.
class AreaTile
{
public:
  /// @param traced with the rays to the light's centre
  AreaTile(const ReceiverTile& tile, const TracedTile& traced, const ShadowRayLight& light,
    const LightSamples& samples)
    : samples_(samples)
    , x_(static_cast<std::size_t>(samples.count()))
    , y_(x_.size())
    , z_(x_.size())
  {
    for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
    {
      if (traced.needed[pixel] == 0)
      {
        continue;
      }
      const std::size_t row = pixel / TracedTile::columns;
      const std::size_t column = pixel % TracedTile::columns;
      this->pixels_[pixel] = samples.pixel(static_cast<std::uint32_t>(tile.firstColumn + column),
        static_cast<std::uint32_t>(tile.firstRow + row));
      const ReceiverPixels& receivers = tile.receivers;
      const std::size_t from = tile.at(column, row);
      const AreaRays rays =
        areaRays(light, receivers.position(from), receivers.normal(from), traced.direction(pixel));
      for (glm::length_t axis = 0; axis < 3; ++axis)
      {
        const auto i = static_cast<std::size_t>(axis);
        this->normal_[i][pixel] = rays.normal[axis];
        this->toCentre_[i][pixel] = rays.toCentre[axis];
        this->ray_[i][pixel] = rays.ray[axis];
      }
      this->perUnit_[pixel] = rays.perUnit;
    }
    for (const TurnedPixel& turned : traced.turned)
    {
      const glm::vec3 normal = tile.receivers.curves[turned.receiver].normal;
      for (glm::length_t axis = 0; axis < 3; ++axis)
      {
        this->normal_[static_cast<std::size_t>(axis)][turned.pixel] = normal[axis];
      }
    }
  }

  /// Compute the directions of a pixel's rays to all samples.
  void directionsOf(std::size_t pixel, const LightSamples::Coordinates& directions) const
  {
    this->samples_.offsets(this->pixels_[pixel], directions);
    const AreaRays rays = this->raysOf(pixel);
    float *const x = directions.x, *const y = directions.y, *const z = directions.z;
    const auto count = static_cast<std::size_t>(this->samples_.count());
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::vec3 direction = directionToSample(rays, { x[i], y[i], z[i] });
      x[i] = direction.x;
      y[i] = direction.y;
      z[i] = direction.z;
    }
  }

  /// Sums of a texture's colours over a pixel's samples: at all samples, and at the points that its
  /// rays go to (sideOfSample()).
  struct Colours
  {
    glm::vec3 all{ 0.0f };
    glm::vec3 lit{ 0.0f };
  };
  Colours coloursOf(std::size_t pixel, const PlacedTexture& texture)
  {
    this->samples_.offsets(
      this->pixels_[pixel], { this->x_.data(), this->y_.data(), this->z_.data() });
    const AreaRays rays = this->raysOf(pixel);
    Colours sums;
    for (std::size_t i = 0; i < this->x_.size(); ++i)
    {
      const glm::vec3 sample(this->x_[i], this->y_[i], this->z_[i]);
      sums.all += texture.colourAt(sample);
      sums.lit += texture.colourAt(sideOfSample(rays, sample) * sample);
    }
    return sums;
  }

  /// Turn the rays of pixelsTogether pixels to one sample each.
  /// @param first the first of these pixels; pixels that need no ray get an arbitrary one
  void turn(std::size_t first, const Together<std::uint32_t>& samples, TracedTile& traced) const
  {
    Together<float> x, y, z;
    this->samples_.offsets(
      samples.data(), &this->pixels_[first], pixelsTogether, { x.data(), y.data(), z.data() });
#pragma GCC ivdep
    for (std::size_t i = 0; i < pixelsTogether; ++i)
    {
      const glm::vec3 towards = directionToSample(this->raysOf(first + i), { x[i], y[i], z[i] });
      traced.directionX[first + i] = towards.x;
      traced.directionY[first + i] = towards.y;
      traced.directionZ[first + i] = towards.z;
    }
  }

  /// Set what these rays take off if blocked: the colours of the points that they go to.
  void colour(std::size_t first, const Together<std::uint32_t>& samples,
    const PlacedTexture& texture, TracedTile& traced) const
  {
    Together<float> x, y, z;
    this->samples_.offsets(
      samples.data(), &this->pixels_[first], pixelsTogether, { x.data(), y.data(), z.data() });
    for (std::size_t i = 0; i < pixelsTogether; ++i)
    {
      const glm::vec3 sample(x[i], y[i], z[i]);
      const glm::vec3 colour =
        texture.colourAt(sideOfSample(this->raysOf(first + i), sample) * sample);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        traced.samplesOfRay[channel][first + i] = colour[static_cast<glm::length_t>(channel)];
      }
    }
  }

private:
  AreaRays raysOf(std::size_t pixel) const
  {
    return { { this->normal_[0][pixel], this->normal_[1][pixel], this->normal_[2][pixel] },
      { this->toCentre_[0][pixel], this->toCentre_[1][pixel], this->toCentre_[2][pixel] },
      { this->ray_[0][pixel], this->ray_[1][pixel], this->ray_[2][pixel] }, this->perUnit_[pixel] };
  }

  const LightSamples& samples_;
  ///@{
  /// By pixel; 0 for pixels that need no ray.
  TracedTile::Plane<SamplePixel> pixels_{};
  std::array<TracedTile::Plane<float>, 3> normal_{}, toCentre_{}, ray_{};
  TracedTile::Plane<float> perUnit_{};
  ///@}
  std::vector<float> x_, y_, z_; ///< a pixel's offsets
};

} // namespace gnomon
