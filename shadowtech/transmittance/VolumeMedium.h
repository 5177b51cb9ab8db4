#pragma once

#include "lights/Bounds.h"
#include "lights/SceneFrame.h"
#include "shadowtech/base/Volume.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon
{

/// The medium of a volume, by VTK's definition in the limit of short steps: scalars are
/// interpolated, then mapped to opacity, then scaled by the opacity of the gradient. Independent
/// components with extinctions s and weights w have sum(s^2) / sum(w s).
class VolumeMedium
{
public:
  VolumeMedium(std::shared_ptr<const Volume> volume, const SceneFrame& frame)
    : volume_(std::move(volume))
  {
    const Volume& of = *this->volume_;
    const glm::dmat4 worldFromIndex = of.worldFromModel * of.modelFromIndex;
    this->centredFromIndex_ = frame.centredFrom(worldFromIndex);
    this->indexFromCentred_ = glm::inverse(this->centredFromIndex_);
    const double margin = of.isOfCells ? 0.5 : 0.0;
    this->lower_ = glm::dvec3(-margin);
    this->upper_ = glm::dvec3(of.samples) - 1.0 + margin;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec4 plane(0.0, 0.0, 0.0, -this->lower_[axis]);
      plane[axis] = 1.0;
      this->planes_.push_back(plane);
      plane[axis] = -1.0;
      plane.w = this->upper_[axis];
      this->planes_.push_back(plane);
    }
    for (const glm::dvec4& plane : of.clipPlanesWorld)
    {
      this->planes_.push_back(glm::transpose(worldFromIndex) * plane);
    }
  }

  std::array<glm::dvec3, 8> corners() const
  {
    std::array<glm::dvec3, 8> corners = Bounds{ this->lower_, this->upper_ }.corners();
    for (glm::dvec3& corner : corners)
    {
      corner = this->centredFromIndex_ * glm::dvec4(corner, 1.0);
    }
    return corners;
  }

  /// Return the steps from sample to sample along the grid's axes, in centred coordinates.
  glm::dmat3 steps() const { return glm::dmat3(this->centredFromIndex_); }

  /// Return the extinction at an index within the volume's box, clipping planes aside.
  double extinctionAt(const glm::dvec3& index) const
  {
    const std::vector<VolumeOpacity>& opacities = this->volume_->opacities;
    if (!this->isShown(index))
    {
      return 0.0;
    }
    if (opacities.size() == 1)
    {
      return this->extinctionOf(opacities.front(), index);
    }
    double squares = 0.0, sum = 0.0;
    for (const VolumeOpacity& opacity : opacities)
    {
      const double extinction = this->extinctionOf(opacity, index);
      squares += opacity.weight > 0.0 ? extinction * extinction : 0.0;
      sum += opacity.weight * extinction;
    }
    return sum > 0.0 ? squares / sum : 0.0;
  }

  /// A ray's way through the volume's box and between its clipping planes.
  struct Passage
  {
    glm::dvec3 start, along; ///< in indices; the direction's length is the ray's
    double from, until;      ///< in lengths of the direction; from >= until if it passes by
    double modelLength;      ///< of the direction
  };
  /// @param origin, direction centred; the direction of any length but 0
  Passage passageOf(const glm::dvec3& origin, const glm::dvec3& direction) const
  {
    Passage passage;
    passage.start = this->indexFromCentred_ * glm::dvec4(origin, 1.0);
    passage.along = glm::dmat3(this->indexFromCentred_) * direction;
    passage.until = std::numeric_limits<double>::infinity();
    passage.from = -passage.until;
    passage.modelLength = glm::length(glm::dmat3(this->volume_->modelFromIndex) * passage.along);
    for (const glm::dvec4& plane : this->planes_)
    {
      const double height = glm::dot(glm::dvec3(plane), passage.start) + plane.w;
      const double slope = glm::dot(glm::dvec3(plane), passage.along);
      if (slope > 0.0)
      {
        passage.from = std::max(passage.from, -height / slope);
      }
      else if (slope < 0.0)
      {
        passage.until = std::min(passage.until, -height / slope);
      }
      else if (height < 0.0)
      {
        passage.until = -std::numeric_limits<double>::infinity();
      }
    }
    return passage;
  }

  /// Integrate the extinction along a part of a passage, by midpoints of steps shorter than half a
  /// voxel, or a tenth without interpolation.
  /// @param until may be infinite
  /// @param mostSteps longer steps are taken rather than more
  double opticalDepth(const Passage& passage, double from, double until, int mostSteps) const
  {
    from = std::max(from, passage.from);
    until = std::min(until, passage.until);
    if (!(from < until))
    {
      return 0.0;
    }
    const double longestStep = this->volume_->interpolates ? 0.45 : 0.1; // in samples along an axis
    const glm::dvec3 steps = glm::abs(passage.along) * ((until - from) / longestStep);
    const double wanted = std::ceil(std::max({ steps.x, steps.y, steps.z }));
    const int count = static_cast<int>(std::min<double>(wanted, mostSteps));
    const double step = (until - from) / count;
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
    {
      sum += this->extinctionAt(passage.start + (from + (i + 0.5) * step) * passage.along);
    }
    return sum * step * passage.modelLength;
  }

private:
  /// Return a table's value as OpenGL filters a texture.
  /// @param coordinate 0 to 1; others are clamped
  static double tableAt(const std::vector<float>& table, double coordinate, bool interpolates)
  {
    const auto size = static_cast<double>(table.size());
    const double texel =
      std::clamp(coordinate * size - (interpolates ? 0.5 : 0.0), 0.0, size - 1.0);
    const auto low = static_cast<std::size_t>(texel);
    const double share = interpolates ? texel - static_cast<double>(low) : 0.0;
    return share > 0.0 ? (1.0 - share) * table[low] + share * table[low + 1] : table[low];
  }

  /// Return the indices of the sample below and the one above, and the share of the one above.
  struct Neighbours
  {
    std::ptrdiff_t low, high;
    double share;

    Neighbours(double index, int samples, bool interpolates)
    {
      const double within = std::clamp(index, 0.0, samples - 1.0);
      this->low = static_cast<std::ptrdiff_t>(interpolates ? within : within + 0.5);
      this->high = std::min<std::ptrdiff_t>(this->low + 1, samples - 1);
      this->share = interpolates ? within - static_cast<double>(this->low) : 0.0;
    }
  };

  /// True if mask and cropping show a place.
  bool isShown(const glm::dvec3& index) const
  {
    const Volume& of = *this->volume_;
    if (of.cropFlags != Volume::allRegions)
    {
      unsigned int region = 0;
      for (int axis = 2; axis >= 0; --axis)
      {
        const glm::dvec2& planes = of.cropIndices[static_cast<std::size_t>(axis)];
        region = 3 * region + (index[axis] < planes[0] ? 0 : index[axis] < planes[1] ? 1 : 2);
      }
      if ((of.cropFlags >> region & 1u) == 0)
      {
        return false;
      }
    }
    if (!of.mask)
    {
      return true;
    }
    const glm::dvec3 texels(of.maskTexels);
    const glm::dvec3 texel = (index + 0.5) / glm::dvec3(of.samples) * texels;
    const glm::ivec3 at = glm::clamp(texel, glm::dvec3(0.0), texels - 1.0);
    const glm::ivec3& size = of.maskTexels;
    return of.mask.get()[(std::ptrdiff_t(at.z) * size.y + at.y) * size.x + at.x] > 0;
  }

  double scalarAt(const glm::dvec3& index, int component) const
  {
    const Volume& of = *this->volume_;
    const Neighbours x(index.x, of.samples.x, of.interpolates);
    const Neighbours y(index.y, of.samples.y, of.interpolates);
    const Neighbours z(index.z, of.samples.z, of.interpolates);
    const float* const scalars = of.scalars.get() + component;
    const auto row = [&](std::ptrdiff_t rowY, std::ptrdiff_t rowZ)
    {
      const float* const first =
        scalars + (rowZ * of.samples.y + rowY) * of.samples.x * of.components;
      const double low = first[x.low * of.components];
      return low + x.share * (first[x.high * of.components] - low);
    };
    if (!of.interpolates)
    {
      return row(y.low, z.low);
    }
    const auto slice = [&](std::ptrdiff_t sliceZ)
    {
      const double low = row(y.low, sliceZ);
      return low + y.share * (row(y.high, sliceZ) - low);
    };
    const double low = slice(z.low);
    return low + z.share * (slice(z.high) - low);
  }

  /// Return the gradient's magnitude as a share of a quarter of the scalars' range, by VTK's
  /// central differences: steps of n / (n - 1) samples, in units of the mean spacing.
  double gradientAt(const glm::dvec3& index, const VolumeOpacity& opacity) const
  {
    const Volume& of = *this->volume_;
    glm::dvec3 difference, spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double count = of.samples[axis];
      glm::dvec3 step(0.0);
      step[axis] = count / (count - 1.0);
      difference[axis] = this->scalarAt(index + step, opacity.component) -
        this->scalarAt(index - step, opacity.component);
      spacing[axis] = glm::length(of.modelFromIndex[axis]);
    }
    const double mean = (spacing.x + spacing.y + spacing.z) / 3.0;
    const double range = opacity.range[1] - opacity.range[0];
    return glm::length(difference * mean / (2.0 * spacing)) / (0.25 * (range != 0.0 ? range : 1.0));
  }

  /// Return one component's extinction.
  double extinctionOf(const VolumeOpacity& opacity, const glm::dvec3& index) const
  {
    const Volume& of = *this->volume_;
    const double range = opacity.range[1] - opacity.range[0];
    const double scalar = this->scalarAt(index, opacity.component) - opacity.range[0];
    double extinction =
      tableAt(opacity.extinctions, range > 0.0 ? scalar / range : 0.0, of.interpolates);
    if (extinction == 0.0 || opacity.ofGradients.empty())
    {
      return extinction;
    }
    const double gradient = this->gradientAt(index, opacity);
    for (const VolumeOpacity& other : of.opacities) // VTK multiplies by all of them, with weights
    {
      extinction *= tableAt(other.ofGradients, gradient, of.interpolates) * other.weight;
    }
    return extinction;
  }

  std::shared_ptr<const Volume> volume_;
  glm::dmat4 centredFromIndex_, indexFromCentred_;
  glm::dvec3 lower_, upper_;       ///< the box, in indices
  std::vector<glm::dvec4> planes_; ///< of the box and the clipping planes, in indices, as (n, d)
};

} // namespace gnomon
