#include "plugin/data/ReceiverStarts.h"

#include "lights/LightSamples.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gnomon
{
namespace
{

/// Distance of a point's starts from it, as a share of the way to the middle of the triangle.
constexpr double inwardShare = 1.0 / 1024.0;

/// A triangle's length in pixels for shadowRayOffsetInside(), which needs a pixel's side. The
/// resulting share of the offset only has to be above 0.
constexpr double pixelsAlong = 1024.0;

constexpr std::uint32_t seedOfPlaces = 1;
constexpr std::uint32_t seedOfDiscs = 2;

using Corners = std::array<glm::dvec3, 3>;

glm::dvec3 areaVector(const Corners& corners)
{
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

glm::dvec3 middleOfCorners(const Corners& corners)
{
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

/// Return a fraction of 2^32 as a number in (0, 1).
double unit(std::uint32_t fraction)
{
  return std::ldexp(fraction + 0.5, -32);
}

/// Return the point of a triangle that is closest to a point (Ericson, Real-Time Collision
/// Detection, section 5.1.5): by projection onto the plane, then onto the edges.
glm::dvec3 closestPoint(const Corners& corners, const glm::dvec3& to)
{
  const glm::dvec3 area = areaVector(corners); // not 0: the snapshot has no such triangles
  const glm::dvec3 inPlane = to - glm::dot(to - corners[0], area) / glm::dot(area, area) * area;
  bool isInside = true;
  glm::dvec3 closest = corners[0];
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    const glm::dvec3 from = inPlane - corners[i];
    isInside &= glm::dot(glm::cross(edge, from), area) >= 0.0;
    const double along = glm::clamp(glm::dot(from, edge) / glm::dot(edge, edge), 0.0, 1.0);
    const glm::dvec3 candidate = corners[i] + along * edge;
    const double distance = glm::distance(candidate, to);
    if (distance < smallest)
    {
      smallest = distance;
      closest = candidate;
    }
  }
  return isInside ? inPlane : closest;
}

/// Spread 21 bits so that two other numbers' bits fit in between.
std::uint64_t spread3(std::uint64_t bits)
{
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

std::uint32_t hashOf(std::uint32_t key)
{
  key = (key ^ key >> 16) * 0x7feb352du; // Wellons 2018, "lowbias32"
  key = (key ^ key >> 15) * 0x846ca68bu;
  return key ^ key >> 16;
}

} // namespace

void SampleStarts::clear()
{
  this->position.clear();
  this->normal.clear();
  this->offset.clear();
  this->first.assign(1, 0);
  this->disc.clear();
}

ReceiverStarts::ReceiverStarts(
  const DataScene& scene, bool ofPoints, int samples, bool hasDisc, ReceivingSide side)
  : scene_(scene)
  , elements_(ofPoints ? scene.points() : scene.cells())
  , ofPoints_(ofPoints)
  , samples_(samples)
  , hasDisc_(hasDisc && samples > 1)
  , side_(side)
  , points_(samples, seedOfPlaces)
  , discPoints_(samples, seedOfDiscs)
{
}

std::vector<std::uint32_t> ReceiverStarts::order() const
{
  const Bounds bounds = [this]
  {
    Bounds all;
    for (const glm::vec3& position : this->scene_.occluders().positionsCentred)
    {
      all.add(glm::dvec3(position));
    }
    return all;
  }();
  const glm::dvec3 size = bounds.upper - bounds.lower;
  const double longest = std::max({ size.x, size.y, size.z, std::numeric_limits<double>::min() });
  constexpr double cells = 2097151.0; // 2^21 - 1
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (std::size_t i = 0; i < this->count(); ++i)
  {
    if (this->hasSurface(i))
    {
      const Corners corners =
        this->scene_.corners(this->elements_.triangles[this->elements_.first[i]]);
      const glm::dvec3 at = (middleOfCorners(corners) - bounds.lower) / longest * cells;
      keyed.emplace_back(spread3(static_cast<std::uint64_t>(at.x)) |
          spread3(static_cast<std::uint64_t>(at.y)) << 1 |
          spread3(static_cast<std::uint64_t>(at.z)) << 2,
        static_cast<std::uint32_t>(i));
    }
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(),
    [](const std::pair<std::uint64_t, std::uint32_t>& key) { return key.second; });
  return order;
}

void ReceiverStarts::append(std::size_t element, SampleStarts& starts, bool middle) const
{
  if (this->ofPoints_)
  {
    // Without a disc, a point's samples are equal, so one is enough.
    for (int i = 0; i < (middle ? 1 : this->samples_); ++i)
    {
      this->appendCorners(element, starts);
    }
  }
  else if (middle || this->samples_ == 1)
  {
    this->appendMiddle(element, starts);
  }
  else
  {
    this->appendSpread(element, starts);
  }
  if (this->hasDisc_ && !middle)
  {
    this->appendDisc(element, starts);
  }
}

float ReceiverStarts::offsetOf(std::uint32_t triangle) const
{
  const Corners corners = this->scene_.corners(triangle);
  const glm::dvec3 area = areaVector(corners);
  const double doubleArea = glm::length(area);
  const double longest = std::max({ glm::distance(corners[0], corners[1]),
    glm::distance(corners[1], corners[2]), glm::distance(corners[2], corners[0]) });
  const float noise = noiseOf(
    this->scene_.occluders(), Surface(), 0, triangle, corners, area / doubleArea, doubleArea);
  return shadowRayOffsetInside(noise, static_cast<float>(longest / pixelsAlong));
}

void ReceiverStarts::appendStart(
  std::uint32_t triangle, const glm::dvec3& at, float leastOffset, SampleStarts& starts) const
{
  const glm::dvec3 normal = glm::normalize(areaVector(this->scene_.corners(triangle)));
  starts.position.emplace_back(at);
  starts.normal.emplace_back(this->side_ == ReceivingSide::Back ? -normal : normal);
  starts.offset.push_back(std::max(leastOffset, this->offsetOf(triangle)));
}

/// Return the centroid of a cell's triangles, weighted by area.
glm::dvec3 ReceiverStarts::middleOf(std::size_t element) const
{
  glm::dvec3 sum(0.0);
  double area = 0.0;
  for (std::uint32_t i = this->elements_.first[element]; i < this->elements_.first[element + 1];
       ++i)
  {
    const Corners corners = this->scene_.corners(this->elements_.triangles[i]);
    const double doubleArea = glm::length(areaVector(corners));
    sum += doubleArea * middleOfCorners(corners);
    area += doubleArea;
  }
  return sum / area; // triangles of the snapshot have an area
}

/// Append a cell's start on the triangle closest to its middle. That may be an edge between two
/// triangles, so that the start is off both.
void ReceiverStarts::appendMiddle(std::size_t element, SampleStarts& starts) const
{
  const std::uint32_t begin = this->elements_.first[element];
  const std::uint32_t end = this->elements_.first[element + 1];
  std::uint32_t best = this->elements_.triangles[begin];
  if (end - begin == 1)
  {
    this->appendStart(best, middleOfCorners(this->scene_.corners(best)), 0.0f, starts);
    starts.first.push_back(static_cast<std::uint32_t>(starts.position.size()));
    return;
  }
  const glm::dvec3 middle = this->middleOf(element);
  glm::dvec3 at = closestPoint(this->scene_.corners(best), middle);
  float offset = this->offsetOf(best);
  for (std::uint32_t i = begin + 1; i < end; ++i)
  {
    const std::uint32_t triangle = this->elements_.triangles[i];
    const glm::dvec3 candidate = closestPoint(this->scene_.corners(triangle), middle);
    offset = std::max(offset, this->offsetOf(triangle));
    if (glm::distance(candidate, middle) < glm::distance(at, middle))
    {
      best = triangle;
      at = candidate;
    }
  }
  this->appendStart(best, at, offset, starts);
  starts.first.push_back(static_cast<std::uint32_t>(starts.position.size()));
}

/// Append starts spread over a cell. The unit square is cut into columns, one for each triangle,
/// with a width in proportion to its area. Each column maps to its triangle such that areas keep
/// their shares (Turk 1990).
void ReceiverStarts::appendSpread(std::size_t element, SampleStarts& starts) const
{
  const std::uint32_t begin = this->elements_.first[element];
  const std::uint32_t end = this->elements_.first[element + 1];
  double all = 0.0;
  for (std::uint32_t i = begin; i < end; ++i)
  {
    all += glm::length(areaVector(this->scene_.corners(this->elements_.triangles[i])));
  }
  const SamplePixel pixel = pixelOf(this->points_, element);
  for (int sample = 0; sample < this->samples_; ++sample)
  {
    const glm::uvec3 fractions = this->points_.point(sample, pixel);
    double across = unit(fractions.x) * all;
    std::uint32_t i = begin;
    Corners corners = this->scene_.corners(this->elements_.triangles[i]);
    double area = glm::length(areaVector(corners));
    while (across > area && i + 1 < end)
    {
      across -= area;
      corners = this->scene_.corners(this->elements_.triangles[++i]);
      area = glm::length(areaVector(corners));
    }
    const double root = std::sqrt(glm::clamp(across / area, 0.0, 1.0));
    const double share = unit(fractions.y);
    this->appendStart(this->elements_.triangles[i],
      (1.0 - root) * corners[0] + root * ((1.0 - share) * corners[1] + share * corners[2]), 0.0f,
      starts);
    starts.first.push_back(static_cast<std::uint32_t>(starts.position.size()));
  }
}

void ReceiverStarts::appendCorners(std::size_t element, SampleStarts& starts) const
{
  const std::optional<glm::dvec3> point = this->scene_.pointCentred(element);
  for (std::uint32_t i = this->elements_.first[element]; i < this->elements_.first[element + 1];
       ++i)
  {
    const std::uint32_t triangle = this->elements_.triangles[i];
    const Corners corners = this->scene_.corners(triangle);
    this->appendStart(
      triangle, glm::mix(*point, middleOfCorners(corners), inwardShare), 0.0f, starts);
  }
  starts.first.push_back(static_cast<std::uint32_t>(starts.position.size()));
}

/// Append disc points in random order, since both they and the starts come from one sequence.
void ReceiverStarts::appendDisc(std::size_t element, SampleStarts& starts) const
{
  const SamplePixel pixel = pixelOf(this->discPoints_, element);
  const std::size_t begin = starts.disc.size();
  for (int sample = 0; sample < this->samples_; ++sample)
  {
    const glm::uvec3 fractions = this->discPoints_.point(sample, pixel);
    starts.disc.push_back(
      diskPoint({ 2.0 * unit(fractions.x) - 1.0, 2.0 * unit(fractions.y) - 1.0 }));
  }
  std::uint32_t key = static_cast<std::uint32_t>(element);
  for (std::size_t i = static_cast<std::size_t>(this->samples_) - 1; i > 0; --i)
  {
    key = hashOf(key + 0x9e3779b9u);
    std::swap(starts.disc[begin + i], starts.disc[begin + key % (i + 1)]);
  }
}

} // namespace gnomon
