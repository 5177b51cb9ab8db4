// pcss_estimator.glsl against a twin, its early out, and its points.

#include "EstimatorGlsl.h"
#include "HalfPlane.h"

#include "lights/KernelShape.h"
#include "lights/LightSamples.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/PcssPoints.h"
#include "shadowtech/depth_map/PoissonSquare.h"
#include "shadowtech/pcss/Pcss.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

constexpr double pcssSlack = 1e-6;

/// A light of the cube [-1, 1]^3 and the name that tests call it by.
struct AreaCase
{
  const char* name;
  ShadowLight light;
};

std::ostream& operator<<(std::ostream& stream, const AreaCase& each)
{
  return stream << each.name;
}

std::vector<AreaCase> areaCases()
{
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.2, -0.1, -1.0));
  const glm::dvec3 up(0.3, 1.0, 0.1);
  ShadowLight sun;
  sun.directionWorld = travel;
  ShadowLight spot;
  spot.kind = LightKind::Spot;
  spot.positionWorld = -4.0 * travel;
  spot.directionWorld = travel;
  spot.coneAngleDegrees = 40.0;
  // One face of their cubes sees all casters. Rectangles stand at a slant to it; the plane of a steep one cuts through it.
  ShadowLight wide = spot;
  wide.coneAngleDegrees = 75.0;
  wide.positionWorld = { 1.5, -1.2, 4.0 };
  wide.directionWorld = glm::normalize(glm::dvec3(0.2, 0.1, -1.0));
  const glm::dvec3 steep = glm::normalize(glm::dvec3(1.0, 0.3, -0.3));
  ShadowLight point = wide;
  point.kind = LightKind::Point;
  const auto with = [](ShadowLight light, const LightArea& area)
  {
    light.area = area;
    return light;
  };
  return { { "sun_disk", with(sun, diskArea(travel, 0.15)) },
    { "sun_rectangle", with(sun, rectangleArea(travel, up, { 0.2, 0.05 })) },
    { "spot_disk", with(spot, diskArea(travel, 0.5)) },
    { "spot_rectangle", with(spot, rectangleArea(travel, up, { 0.6, 0.2 })) },
    { "wide_spot_rectangle", with(wide, rectangleArea(travel, up, { 0.4, 0.3 })) },
    { "wide_spot_steep_rectangle", with(wide, rectangleArea(steep, up, { 0.4, 0.3 })) },
    { "point_ball", with(point, ballArea(0.4)) } };
}

/// Blocks at several heights over an empty ground, and single texels.
float blocks(const glm::ivec2& texel)
{
  const glm::ivec2 block = texel / 12;
  const unsigned bits = static_cast<unsigned>(block.x * 7 + block.y * 13) * 2654435761u;
  const bool single = texel.x % 17 == 5 && texel.y % 13 == 7;
  return single         ? 0.36f
    : bits >> 30u == 0u ? 0.3f + 0.05f * static_cast<float>(bits >> 28u & 3u)
                        : 1.0f;
}

/// A slope that ends in a step.
float slope(const glm::ivec2& texel)
{
  return texel.x < mapSize / 2 ? 0.3f + 0.004f * static_cast<float>(texel.x) : 1.0f;
}

/// Something above every level receiver, but some of it so low that it hides only its own ray.
float layers(const glm::ivec2& texel)
{
  const unsigned bits = static_cast<unsigned>(texel.x * 73 + texel.y * 1009) * 2654435761u;
  return 0.7f - 0.4f * std::exp2(-static_cast<float>(bits >> 29u));
}

/// A receiver in centred coordinates.
struct Receiver
{
  glm::dvec3 position;
  glm::dvec3 normal;
};

/// The estimator of the first view, written from Pcss.h.
class PcssTwin
{
public:
  PcssTwin(const ShadowLight& light, LightViews views, Depths depths)
    : light_(light)
    , views_(std::move(views))
    , depths_(std::move(depths))
    , counts_(pcssCounts(light.of<PcssSettings>().samples))
    , points_(pcssPoints(light.of<PcssSettings>().samples, light.area->shape))
  {
  }

  struct Answer
  {
    double lit = 1.0;
    int fetches = 0; ///< texels of the map that are read without an early out
  };

  /// Takes other points, as many.
  void setPoints(std::vector<glm::vec2> points) { this->points_ = std::move(points); }

  Answer at(const Receiver& receiver, bool patterned = true)
  {
    this->fetches_ = 0;
    Answer answer;
    answer.lit = this->visibility(receiver, patterned);
    answer.fetches = this->fetches_;
    return answer;
  }

private:
  double visibility(const Receiver& receiver, bool patterned)
  {
    const LightView& view = this->views_.views.front();
    const glm::dmat3 turn(view.rays.viewFromCentred);
    this->p_ = glm::dvec3(view.rays.viewFromCentred * glm::dvec4(receiver.position, 1.0));
    this->n_ = turn * receiver.normal;
    const bool positional = view.rays.positional;
    if (glm::dot(this->n_, positional ? this->p_ : glm::dvec3(0.0, 0.0, 1.0)) >= 0.0)
    {
      return 0.0; // it faces away
    }
    if (this->light_.kind == LightKind::Spot)
    {
      const glm::dvec3 p(this->views_.lightFromCentred * glm::dvec4(receiver.position, 1.0));
      if (p.z <= 0.0 ||
        glm::length(glm::dvec2(p)) > std::sqrt(this->views_.coneTangentSquared) * p.z)
      {
        return 0.0;
      }
    }
    const glm::dmat3 texels = texelFromAcross(view, mapSize);
    this->acrossFromTexel_ = glm::inverse(texels);
    const glm::dvec2 across = view.rays.across(this->p_);
    this->texel_ = mapped(texels, across);
    const glm::dmat3 area = turn * this->light_.area->worldFromUnit;
    this->axes_ = glm::dmat2x3(area[0], area[1]);
    if (this->light_.area->shape == LightArea::Shape::Ball)
    {
      // The disk across the ray: what leans with it is along the slope.
      const glm::dvec2 along = glm::normalize(across);
      const glm::dvec3 ray = glm::normalize(this->p_);
      const glm::dvec3 leaning(along * ray.z, -glm::length(glm::dvec2(ray)));
      const glm::dvec3 level(-along.y, along.x, 0.0);
      this->axes_ = this->light_.area->radius() *
        glm::dmat2x3(along.x * leaning - along.y * level, along.y * leaning + along.x * level);
    }
    this->lightTexels_ = texelJacobian(texels, across) *
      glm::dmat2(glm::dvec2(this->axes_[0]), glm::dvec2(this->axes_[1]));

    double largest = this->isAround() ? this->mostAround() : 1e300;
    Window window =
      this->isAround() ? this->window(largest) : Window{ glm::ivec2(0), glm::ivec2(mapSize - 1) };
    for (int step = 0; step < 4; ++step)
    {
      largest = std::min(largest, this->separationEstimate(window, largest));
      window = this->window(largest);
    }
    const glm::dvec2 width = this->isAround()
      ? (window.upper - window.lower) * glm::dvec2(texels[0].x, texels[1].y)
      : 2.0 * this->reach() * largest;
    this->slack_ = pcssSlack * std::max(std::max(width.x, width.y), 1.0);
    const auto turned = [&](int number)
    {
      glm::dvec2 place =
        this->patterned(this->points_[static_cast<std::size_t>(number)], patterned);
      const glm::dvec3 source = this->axes_ * place;
      const glm::dvec3 away = source - (positional ? this->p_ : glm::dvec3(0.0, 0.0, 1.0));
      return glm::dot(away, this->n_) < 0.0 ? -place : place;
    };
    // Of what hides a point of the light that is looked for at a separation.
    const auto hider = [&](int number, double separation) -> std::optional<double>
    {
      const glm::dvec2 place = turned(this->counts_.search + number);
      auto found = this->hiderAt(separation * place);
      if (found && *found >= separation && std::min(*found, largest) <= separation / 0.75)
      {
        return std::min(*found, largest);
      }
      bool holds = false;
      for (int again = 0; again < 4 && found && !holds; ++again)
      {
        separation = std::min(*found, largest);
        found = this->hiderAt(separation * place);
        const double share = again < 3 ? 0.9 : 0.75 * this->extent(place);
        holds = found && std::min(*found, largest) >= share * separation;
      }
      return holds ? std::optional(separation) : std::nullopt;
    };
    Blockers blockers = this->search(largest, turned);
    if (blockers.area == 0.0)
    {
      // What few points have missed, more may find.
      for (int i = 0; i < this->counts_.filter; ++i)
      {
        if (const auto separation = hider(i, largest))
        {
          blockers.add(*separation, 1.0);
        }
      }
    }
    if (blockers.area == 0.0)
    {
      return 1.0;
    }
    const double least = std::min(blockers.least, largest);
    const double mean = std::clamp(blockers.sum / blockers.area, least, largest);
    int hidden = 0;
    for (int i = 0; i < this->counts_.filter; ++i)
    {
      hidden += hider(i, least) || (least < 0.75 * mean && hider(i, mean)) ? 1 : 0;
    }
    return 1.0 - static_cast<double>(hidden) / this->counts_.filter;
  }

  struct Blockers
  {
    double area = 0.0;
    double sum = 0.0;
    double least = 1e300;

    void add(double separation, double part)
    {
      this->area += part;
      this->sum += part * separation;
      this->least = std::min(this->least, separation);
    }
  };

  template <typename Turned>
  Blockers search(double largest, const Turned& turned)
  {
    Blockers blockers;
    if (const auto own = this->hiderAt(glm::dvec2(0.0)))
    {
      blockers.add(*own, std::pow(this->counts_.search, -2.0));
    }
    for (int i = 0; i < this->counts_.search; ++i)
    {
      // Denser in the middle: as many points in every ring of the same width, or of the same angle.
      glm::dvec2 place = turned(i);
      place *= this->extent(place);
      double density = 1.0;
      if (this->isAround())
      {
        const double widest = largest * this->radiusOfAxes() / glm::length(this->p_);
        const double angle = this->extent(place) * std::atan(widest);
        place *= std::tan(angle) / widest / this->extent(place);
        density = std::atan(widest) / widest / std::pow(std::cos(angle), 2);
      }
      const auto found = this->hiderAt(largest * place);
      if (found && *found >= largest * this->extent(place))
      {
        blockers.add(*found, 2.0 * this->extent(place) * density / this->counts_.search);
      }
    }
    return blockers;
  }

  bool isRectangle() const { return this->light_.area->shape == LightArea::Shape::Rectangle; }

  double extent(const glm::dvec2& place) const
  {
    const glm::dvec2 away = glm::abs(place);
    return this->isRectangle() ? std::max(away.x, away.y) : glm::length(place);
  }

  /// The box around the light's outline.
  glm::dvec2 reach() const
  {
    glm::dvec2 farthest(0.0);
    const int corners = this->isRectangle() ? 4 : 1024;
    for (int i = 0; i < corners; ++i)
    {
      const double angle = glm::two_pi<double>() * (i + 0.5) / corners;
      const glm::dvec2 rim =
        (this->isRectangle() ? std::sqrt(2.0) : 1.0) * glm::dvec2(std::cos(angle), std::sin(angle));
      farthest = glm::max(farthest, glm::abs(this->lightTexels_ * rim));
    }
    return farthest;
  }

  /// Whether the light looks around from the middle of a cube. Other faces see no casters here.
  bool isAround() const { return this->views_.layout == ViewLayout::Cube; }

  double radiusOfAxes() const
  {
    return std::max(glm::length(this->axes_[0]), glm::length(this->axes_[1]));
  }

  /// At which the rays to the rim are eight texels from those to the light's centre plane.
  double mostAround() const
  {
    const glm::dmat3 acrossFromTexel = glm::inverse(this->acrossFromTexel_);
    return glm::length(this->p_) * std::min(acrossFromTexel[0].x, acrossFromTexel[1].y) /
      (8.0 * this->radiusOfAxes());
  }

  double distance(double depth) const
  {
    const LightView& view = this->views_.views.front();
    return (depth - view.depthOffset) / view.depthScale;
  }

  double separation(double depth) const
  {
    const double z = this->distance(depth);
    return std::max(
      this->views_.views.front().rays.positional ? 1.0 / z - 1.0 / this->p_.z : this->p_.z - z,
      0.0);
  }

  struct Window
  {
    glm::ivec2 first;
    glm::ivec2 last;
    glm::dvec2 lower{ -1.0 }; ///< slopes, of a cube's face
    glm::dvec2 upper{ 1.0 };
  };

  /// The largest slope of a plane through the light, on the face, that has all of these on its upper side.
  static double leastSlope(const std::vector<glm::dvec3>& corners, int axis, double sign)
  {
    double least = -1.0;
    const auto holds = [&](double slope)
    {
      return std::all_of(corners.begin(), corners.end(),
        [&](const glm::dvec3& corner)
        { return sign * corner[axis] - slope * corner.z >= -1e-12 * glm::length(corner); });
    };
    for (const glm::dvec3& corner : corners)
    {
      const double slope = sign * corner[axis] / corner.z;
      least = std::abs(slope) <= 1.0 && holds(slope) ? std::max(least, slope) : least;
    }
    return holds(1.0) ? 1.0 : least;
  }

  /// What is looked up at a separation.
  Window window(double separation) const
  {
    Window window{ texelOf(this->texel_ - this->reach() * separation),
      texelOf(this->texel_ + this->reach() * separation) };
    if (this->isAround())
    {
      std::vector<glm::dvec3> corners;
      for (const glm::dvec2& corner :
        { glm::dvec2(1.0, 1.0), { 1.0, -1.0 }, { -1.0, 1.0 }, { -1.0, -1.0 } })
      {
        corners.push_back(this->p_ + separation * (this->axes_ * corner));
      }
      for (int axis = 0; axis < 2; ++axis)
      {
        window.lower[axis] = leastSlope(corners, axis, 1.0);
        window.upper[axis] = -leastSlope(corners, axis, -1.0);
      }
      const glm::dmat3 texels = glm::inverse(this->acrossFromTexel_);
      window.first = texelOf(mapped(texels, window.lower) - 0.01);
      window.last = texelOf(mapped(texels, window.upper) + 0.01);
    }
    return window;
  }

  /// About the largest separation that a caster of a window has, as far as the nearest depths of the pyramid's blocks tell.
  double separationEstimate(const Window& window, double most) const
  {
    const glm::ivec2& first = window.first;
    const glm::ivec2& last = window.last;
    const int width = std::max(last.x - first.x, last.y - first.y) + 1;
    int block = 2;
    while (block < width)
    {
      block *= 2;
    }
    double bound = 0.0;
    for (int y = first.y / block; y <= last.y / block; ++y)
    {
      for (int x = first.x / block; x <= last.x / block; ++x)
      {
        const glm::ivec2 lower = block * glm::ivec2(x, y);
        const double least = this->nearest(lower, lower + block);
        bound = std::max(bound,
          this->isAround()
            ? this->separationEstimateAround(window, lower, lower + block, least, most)
            : this->separation(least));
      }
    }
    return bound;
  }

  double separationEstimateAround(const Window& window, const glm::ivec2& first,
    const glm::ivec2& end, double least, double most) const
  {
    if (least >= 1.0)
    {
      return 0.0;
    }
    // From (1 + s) X = P + L s: along the axis, and over the light's plane in the middle of the block.
    const double z = this->distance(least);
    const glm::dvec2 depths(this->axes_[0].z, this->axes_[1].z);
    const double farther =
      this->isRectangle() ? std::abs(depths.x) + std::abs(depths.y) : glm::length(depths);
    const double bound = z > farther ? std::max(this->p_.z - z, 0.0) / (z - farther) : most;
    const glm::dvec2 slope = 0.5 *
      (glm::clamp(mapped(this->acrossFromTexel_, glm::dvec2(first)), window.lower, window.upper) +
        glm::clamp(mapped(this->acrossFromTexel_, glm::dvec2(end)), window.lower, window.upper));
    const glm::dvec3 normal = glm::cross(this->axes_[0], this->axes_[1]);
    const double share =
      glm::dot(normal, this->p_) / (z * glm::dot(normal, glm::dvec3(slope, 1.0)));
    return std::max(std::min({ share - 1.0, bound, most }), 0.0);
  }

  /// The least depth of a block.
  double nearest(const glm::ivec2& first, const glm::ivec2& end) const
  {
    double least = 1.0;
    for (int y = first.y; y < end.y; ++y)
    {
      for (int x = first.x; x < end.x; ++x)
      {
        least = std::min<double>(least, this->depths_({ x, y }));
      }
    }
    return least;
  }

  static glm::ivec2 texelOf(const glm::dvec2& place)
  {
    return glm::ivec2(glm::clamp(glm::floor(place), 0.0, mapSize - 1.0));
  }

  /// The separation of what hides the receiver at a place, by the light's point that the place is for.
  std::optional<double> hiderAt(const glm::dvec2& light)
  {
    ++this->fetches_;
    const LightView& view = this->views_.views.front();
    const glm::dvec3 ray = this->isAround() ? this->p_ + this->axes_ * light : this->p_;
    if (std::max(std::abs(ray.x), std::abs(ray.y)) > ray.z && this->isAround())
    {
      return std::nullopt; // another face's
    }
    const glm::ivec2 texel = this->isAround()
      ? texelOf(mapped(glm::inverse(this->acrossFromTexel_), glm::dvec2(ray) / ray.z))
      : texelOf(this->texel_ + this->lightTexels_ * light);
    const double depth = this->depths_(texel);
    const glm::dvec2 centre = mapped(this->acrossFromTexel_, glm::dvec2(texel) + 0.5);
    double z = ray.z;
    if (view.rays.positional)
    {
      const double along = glm::dot(this->n_, glm::dvec3(centre, 1.0));
      z = along < 0.0 ? std::min(z, glm::dot(this->n_, this->p_) / along) : z;
    }
    else
    {
      const glm::dvec2 away = centre - glm::dvec2(this->p_);
      z = std::min(z, this->p_.z - glm::dot(glm::dvec2(this->n_), away) / this->n_.z);
    }
    if (depth >= 1.0 || z * view.depthScale + view.depthOffset <= depth + this->slack_)
    {
      return std::nullopt;
    }
    return this->isAround() ? std::max(ray.z / this->distance(depth) - 1.0, 0.0)
                            : this->separation(depth);
  }

  static double noise(const glm::ivec2& cell)
  {
    std::uint32_t bits =
      static_cast<std::uint32_t>(cell.x) + 65536u * static_cast<std::uint32_t>(cell.y);
    bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
    bits ^= bits >> 16u;
    return static_cast<double>(bits >> 8u) / 16777216.0;
  }

  glm::dvec2 patterned(const glm::dvec2& place, bool patterned) const
  {
    if (!patterned)
    {
      return place;
    }
    const auto cell = glm::ivec2(4.0 * this->texel_);
    if (this->isRectangle())
    {
      const glm::dvec2 shift(noise(cell), noise(cell + 32768));
      return 2.0 * glm::fract(0.5 * place + 0.5 + shift) - 1.0;
    }
    const double angle = glm::two_pi<double>() * noise(cell);
    return { std::cos(angle) * place.x - std::sin(angle) * place.y,
      std::sin(angle) * place.x + std::cos(angle) * place.y };
  }

  ShadowLight light_;
  LightViews views_;
  Depths depths_;
  PcssCounts counts_;
  std::vector<glm::vec2> points_;
  glm::dvec3 p_{ 0.0 };
  glm::dvec3 n_{ 0.0 };
  glm::dvec2 texel_{ 0.0 };
  glm::dmat2x3 axes_{ 0.0 }; ///< the light's
  glm::dmat2 lightTexels_{ 0.0 };
  glm::dmat3 acrossFromTexel_{ 1.0 };
  double slack_ = 0.0;
  int fetches_ = 0;
};

/// A light's first view of a cube that casts, as the only one.
LightViews firstView(const ShadowLight& light)
{
  LightViews views =
    fitLightViews(light, glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, mapSize, 8);
  views.views.resize(1);
  for (int& view : views.viewOfFace)
  {
    view = view == 0 ? 0 : LightViews::noView;
  }
  return views;
}

/// Receivers on a plane that is tilted towards the light's first view.
std::vector<Receiver> receiversOf(const LightViews& views, const glm::dvec2& tilt)
{
  const LightView& view = views.views.front();
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, mapSize));
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(tilt, -1.0));
  const double distance = (0.7 - view.depthOffset) / view.depthScale;
  std::vector<Receiver> receivers;
  std::vector<glm::dvec2> places = randomPlaces(4);
  places.resize(700);
  for (const glm::dvec2& place : places)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, place);
    // The plane through (0, 0, distance).
    const double z = view.rays.positional
      ? normal.z * distance / glm::dot(normal, glm::dvec3(across, 1.0))
      : distance - glm::dot(glm::dvec2(normal), across) / normal.z;
    const glm::dvec3 position(view.rays.positional ? across * z : across, z);
    const Receiver receiver{ glm::dvec3(centredFromView * glm::dvec4(position, 1.0)),
      glm::dmat3(centredFromView) * normal };
    if (views.layout == ViewLayout::Cube)
    {
      const glm::dvec4 positionLight = views.lightFromCentred * glm::dvec4(receiver.position, 1.0);
      const int face = cubeFaceOf(glm::dvec3(positionLight));
      if (views.viewOfFace[static_cast<std::size_t>(face)] != 0)
      {
        continue; // another face's
      }
    }
    receivers.push_back(receiver);
  }
  return receivers;
}

/// What a technique's GLSL answers at receivers on a map.
std::vector<float> run(const PointwiseTechnique& technique, const ShadowLight& light,
  const LightViews& views, const Depths& depths, const std::vector<Receiver>& receivers)
{
  GlTexture map;
  fillDepths(map, depths);
  ShaderLibrary library;
  DepthBounds bounds;
  bounds.bake(map.name(), mapSize, 1, library);
  const std::vector<glm::vec2> lightPoints =
    pcssPoints(light.of<PcssSettings>().samples, light.area->shape);
  GlTexture pointTexture;
  glBindTexture(GL_TEXTURE_2D, pointTexture.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, static_cast<GLsizei>(lightPoints.size()), 1, 0, GL_RG,
    GL_FLOAT, lightPoints.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  const glm::dmat3 lightFromUnit = glm::dmat3(views.lightFromCentred) * light.area->worldFromUnit;
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, {});
  uniforms.push_back({ "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, map.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(pcssSlack, 0.0) });
  uniforms.push_back(bounds.uniform());
  uniforms.push_back({ "lightPoints_LIGHT", TextureBinding{ GL_TEXTURE_2D, pointTexture.name() } });
  uniforms.push_back({ "lightFromUnit_LIGHT", glm::mat3(lightFromUnit) });
  std::vector<glm::vec4> points;
  for (const Receiver& receiver : receivers)
  {
    points.emplace_back(receiver.position, 1.0);
  }
  return visibilityAt(technique, light, library, std::move(points),
    glm::vec3(receivers.front().normal), std::move(uniforms));
}

class PcssGlsl
  : public GlslTest
  , public testing::WithParamInterface<AreaCase>
{
protected:
  static std::vector<float> run(const ShadowLight& light, const LightViews& views,
    const Depths& depths, const std::vector<Receiver>& receivers)
  {
    return test::run(Pcss(), light, views, depths, receivers);
  }
};

INSTANTIATE_TEST_SUITE_P(Lights, PcssGlsl, testing::ValuesIn(areaCases()),
  [](const testing::TestParamInfo<AreaCase>& each) { return std::string(each.param.name); });

/// The last one's plane cuts through the light.
const glm::dvec2 tilts[] = { { 0.0, 0.0 }, { 0.4, -0.2 }, { -1.5, 0.7 }, { -9.0, 0.5 } };

TEST_P(PcssGlsl, isItsTwin)
{
  std::size_t between = 0;
  for (const PcssSamples samples : { PcssSamples::Low, PcssSamples::Medium, PcssSamples::High })
  {
    for (const Depths& depths : { Depths(blocks), Depths(slope) })
    {
      for (const glm::dvec2& tilt : tilts)
      {
        ShadowLight light = GetParam().light;
        light.of<PcssSettings>().samples = samples;
        const LightViews views = firstView(light);
        const std::vector<Receiver> receivers = receiversOf(views, tilt);
        const std::vector<float> values = run(light, views, depths, receivers);
        PcssTwin twin(light, views, depths);
        std::size_t different = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          different += std::abs(values[i] - twin.at(receivers[i]).lit) < 1e-5 ? 0 : 1;
          between += values[i] > 0.0f && values[i] < 1.0f ? 1 : 0;
        }
        // Each of up to 320 places may lie within rounding of a texel's border.
        EXPECT_LE(different, values.size() / 50) << tilt.x;
      }
    }
  }
  EXPECT_GT(between, 500u);
}

TEST_P(PcssGlsl, theEarlyOutChangesNothing)
{
  for (const Depths& depths : { Depths(blocks), Depths(slope), Depths(layers),
         Depths([](const glm::ivec2&) { return 0.35f; }) })
  {
    for (const glm::dvec2& tilt : tilts)
    {
      ShadowLight light = GetParam().light;
      const LightViews views = firstView(light);
      const std::vector<Receiver> receivers = receiversOf(views, tilt);
      const std::vector<float> early = run(light, views, depths, receivers);
      light.of<EarlyOutSettings>().earlyOut = EarlyOut::None;
      EXPECT_EQ(early, run(light, views, depths, receivers)) << tilt.x;
    }
  }
}

/// The texels of the map that the shader itself reads for receivers, counted as it runs. They have a pixel each for themselves.
class PcssReads : public GlslTest
{
protected:
  struct Reads
  {
    int fewest = 1000000;
    int most = 0;
    double all = 0.0;
  };

  static Reads readsOf(const ShadowLight& light, const Depths& depths, const glm::dvec2& tilt)
  {
    const LightViews views = firstView(light);
    Reads reads;
    for (const float each : run(CountingPcss(), light, views, depths, receiversOf(views, tilt)))
    {
      const int count = static_cast<int>(each);
      reads.fewest = std::min(reads.fewest, count);
      reads.most = std::max(reads.most, count);
      reads.all += count;
    }
    return reads;
  }

private:
  /// Answers with how many texels it has read.
  class CountingPcss : public Pcss
  {
  public:
    std::string visibilityGlsl(const ShadowLight& light) const override
    {
      std::string text = this->Pcss::visibilityGlsl(light);
      replaceOnce(text, "float depthAt_LIGHT(int view, ivec2 texel)\n{",
        "int reads_LIGHT = 0;\nfloat depthAt_LIGHT(int view, ivec2 texel)\n{\n  ++reads_LIGHT;");
      replaceOnce(text, "float visibility_LIGHT(", "float visibilityOfPcss_LIGHT(");
      return text +
        "float visibility_LIGHT(vec3 positionView, vec3 normalView)\n{\n  reads_LIGHT = 0;\n"
        "  visibilityOfPcss_LIGHT(positionView, normalView);\n  return float(reads_LIGHT);\n}\n";
    }
  };
};

const Depths cover = [](const glm::ivec2&) { return 0.35f; };
const Depths nothing = [](const glm::ivec2&) { return 1.0f; };

/// Apelles, table 4.1.
TEST_F(PcssReads, areThoseOfItsPresets)
{
  const PcssCounts expected[] = { { 16, 16 }, { 36, 64 }, { 64, 256 } };
  for (int preset = 0; preset < 3; ++preset)
  {
    ShadowLight light = areaCases().front().light;
    light.of<PcssSettings>().samples = static_cast<PcssSamples>(preset);
    light.of<EarlyOutSettings>().earlyOut = EarlyOut::None;
    const auto [search, filter] = pcssCounts(light.of<PcssSettings>().samples);
    EXPECT_EQ(search, expected[preset].search);
    EXPECT_EQ(filter, expected[preset].filter);
    // The receiver's own texel, the search, and the filter; where that finds nothing it has searched.
    for (const Depths& depths : { cover, nothing })
    {
      const Reads plain = readsOf(light, depths, {});
      EXPECT_EQ(plain.fewest, 1 + search + filter);
      EXPECT_EQ(plain.most, 1 + search + filter);
    }
    // The filter searches, too, and looks at two depths, at each of them five times at most.
    const Reads mixed = readsOf(light, layers, {});
    EXPECT_GE(mixed.fewest, 1 + search + filter);
    EXPECT_GT(mixed.most, 1 + search + filter);
    EXPECT_LE(mixed.most, 1 + search + 3 * 5 * filter);
    // What bounds decide reads none of the map.
    light.of<EarlyOutSettings>().earlyOut = EarlyOut::Exact;
    EXPECT_EQ(readsOf(light, cover, {}).most, 0);
    EXPECT_EQ(readsOf(light, nothing, {}).most, 0);
  }
}

TEST_F(PcssReads, growFromLowToHighAndShrinkByTheEarlyOut)
{
  for (const AreaCase& each : areaCases())
  {
    double previous = 0.0;
    for (const PcssSamples samples : { PcssSamples::Low, PcssSamples::Medium, PcssSamples::High })
    {
      ShadowLight light = each.light;
      light.of<PcssSettings>().samples = samples;
      light.of<EarlyOutSettings>().earlyOut = EarlyOut::None;
      const double all = readsOf(light, blocks, tilts[1]).all;
      EXPECT_GT(all, 2.0 * previous) << each;
      previous = all;
      light.of<EarlyOutSettings>().earlyOut = EarlyOut::Exact;
      EXPECT_LE(readsOf(light, blocks, tilts[1]).all, all) << each;
    }
  }
}

/// Answers with something of the points as the receiver's cell of the map takes them.
class PatternedPcss : public Pcss
{
public:
  /// @param expression of GLSL, of `taken`, the cell's points, and `given`, those of the set
  explicit PatternedPcss(std::string expression)
    : expression_(std::move(expression))
  {
  }

  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    std::string text = this->Pcss::visibilityGlsl(light);
    replaceOnce(text, "float estimate_LIGHT(ViewPoint point, float slack)\n{",
      "float estimate_LIGHT(ViewPoint point, float slack)\n{\n" + this->expression_ +
        "}\n"
        "float estimateOfPcss_LIGHT(ViewPoint point, float slack)\n{");
    return text;
  }

private:
  std::string expression_;
};

/// Turns of a disk, and shifts of a square whose edges meet, leave the points as far from each other as they are.
TEST_P(PcssGlsl, patternsKeepThePointsDistances)
{
  const ShadowLight& light = GetParam().light;
  const LightViews views = firstView(light);
  const std::vector<Receiver> receivers = receiversOf(views, {});
  const Depths depths = blocks;
  const bool isRectangle = light.area->shape == LightArea::Shape::Rectangle;
  const std::string preamble =
    "  vec2 pattern = patternOf_LIGHT(point);\n"
    "  vec3 none = vec3(0.0, 0.0, 1.0);\n"; // nothing is behind the receiver
  // Over the square's edges, if that is shorter.
  const std::string wrap = isRectangle ? "    given = min(given, 2.0 - given);\n"
                                         "    taken = min(taken, 2.0 - taken);\n"
                                       : "";
  const std::vector<float> most =
    test::run(PatternedPcss(preamble +
                "  float most = 0.0;\n"
                "  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)\n"
                "  for (int j = 0; j < i; ++j)\n"
                "  {\n"
                "    ivec2 ij = PCSS_SEARCH_POINTS_LIGHT + ivec2(i, j);\n"
                "    vec2 given = abs(texelFetch(lightPoints_LIGHT, ivec2(ij.x, 0), 0).rg\n"
                "      - texelFetch(lightPoints_LIGHT, ivec2(ij.y, 0), 0).rg);\n"
                "    vec2 taken = abs(lightPoint_LIGHT(ij.x, pattern, none)\n"
                "      - lightPoint_LIGHT(ij.y, pattern, none));\n" +
                wrap +
                "    most = max(most, abs(length(taken) - length(given)));\n"
                "  }\n"
                "  return most;\n"),
      light, views, depths, receivers);
  EXPECT_LT(*std::max_element(most.begin(), most.end()), 1e-5f);
  // And from cell to cell they lie elsewhere.
  const std::vector<float> places =
    test::run(PatternedPcss(preamble + "  return lightPoint_LIGHT(0, pattern, none).x;\n"), light,
      views, depths, receivers);
  const auto [least, largest] = std::minmax_element(places.begin(), places.end());
  RecordProperty("places", std::to_string(*least) + " to " + std::to_string(*largest));
  EXPECT_GT(*largest - *least, 0.3f);
}

/// The map's depths may begin anywhere before its nearest caster, as if there were a near plane.
TEST_P(PcssGlsl, doesNotDependOnWhereDepthsBegin)
{
  const ShadowLight& light = GetParam().light;
  const LightViews fitted = firstView(light);
  const std::vector<Receiver> receivers = receiversOf(fitted, tilts[1]);
  const std::vector<float> expected = run(light, fitted, blocks, receivers);
  const LightView& from = fitted.views.front();
  for (const double begin : { -4.0, -0.5, 0.1, 0.29 }) // the nearest caster is at 0.3
  {
    LightViews views = fitted;
    LightView& to = views.views.front();
    to.depthScale = from.depthScale / (1.0 - begin);
    to.depthOffset = (from.depthOffset - begin) / (1.0 - begin);
    const Depths depths = [&](const glm::ivec2& texel)
    { return static_cast<float>((blocks(texel) - begin) / (1.0 - begin)); };
    const std::vector<float> values = run(light, views, depths, receivers);
    std::size_t different = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      different += std::abs(values[i] - expected[i]) < 1e-5 ? 0 : 1;
    }
    // Depths are floats: a receiver may lie on a texel's plane, a place on a texel's border.
    EXPECT_LE(different, values.size() / 50) << begin;
  }
}

TEST_P(PcssGlsl, shadowsMoreReceiversByLargerLights)
{
  std::size_t previous = 0;
  for (const double size : { 0.1, 0.3, 1.0, 3.0 })
  {
    ShadowLight light = GetParam().light;
    light.area->worldFromUnit *= size;
    const LightViews views = firstView(light);
    const std::vector<float> values = run(light, views, blocks, receiversOf(views, tilts[1]));
    const auto shadowed = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](float lit) { return lit < 1.0f; }));
    EXPECT_GT(shadowed, previous) << size;
    previous = shadowed;
  }
}

TEST(Pcss, pointsKeepTheirDistance)
{
  for (const int count : { 16, 36, 64, 256, 512 })
  {
    const std::vector<glm::dvec2> points = poissonSquare(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    double least = 2.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_LE(std::max(std::abs(points[i].x), std::abs(points[i].y)), 1.0);
      for (std::size_t j = 0; j < i; ++j)
      {
        least = std::min(least, wrappedDistance(points[i], points[j]));
      }
    }
    // Random points: 0.1 of it for 16, 0.02 for 256.
    EXPECT_GE(least, 0.69 * largestPoissonDistance(count)) << count;
    EXPECT_LE(least, largestPoissonDistance(count)) << count;
  }
}

TEST(Pcss, pointsOfADiskFillItEvenly)
{
  for (const PcssSamples samples : { PcssSamples::Low, PcssSamples::Medium, PcssSamples::High })
  {
    const std::vector<glm::vec2> points = pcssPoints(samples, LightArea::Shape::Disk);
    const PcssCounts counts = pcssCounts(samples);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(counts.search + counts.filter));
    // Four rings of equal area: chi-square with 3 degrees of freedom, which random points exceed once in
    // twenty times.
    double chiSquare = 0.0;
    const double expected = 0.25 * counts.filter;
    std::vector<int> rings(4, 0);
    for (std::size_t i = static_cast<std::size_t>(counts.search); i < points.size(); ++i)
    {
      const double radius = glm::length(points[i]);
      ASSERT_LE(radius, 1.0 + 1e-6);
      ++rings[static_cast<std::size_t>(std::min(3.0, 4.0 * radius * radius))];
    }
    for (const int ring : rings)
    {
      chiSquare += (ring - expected) * (ring - expected) / expected;
    }
    EXPECT_LT(chiSquare, 7.8);
  }
}

/// The penumbra of a straight edge under a round sun, by 16 points.
class EdgeOfSun
{
public:
  EdgeOfSun()
  {
    this->light_.directionWorld = { 0.0, 0.0, -1.0 };
    this->light_.area = diskArea(this->light_.directionWorld, 0.5);
    this->light_.of<PcssSettings>().samples = PcssSamples::Low;
    this->views_ = firstView(this->light_);
    const LightView& view = this->views_.views.front();
    this->distance_ = (0.7 - view.depthOffset) / view.depthScale;
    this->radiusTexels_ = 0.5 * mostTexelsAcross(this->views_, mapSize) * 0.4 / view.depthScale;
  }

  PcssTwin twin() const
  {
    return { this->light_, this->views_,
      [](const glm::ivec2& texel) { return texel.x < mapSize / 2 ? 0.3f : 1.0f; } };
  }

  /// @param x across the penumbra, from -1 to 1
  /// @param cell along it
  double visibility(PcssTwin& twin, double x, int cell, bool patterned) const
  {
    const LightView& view = this->views_.views.front();
    const glm::dvec2 place(32.0 + x * this->radiusTexels_, 12.0 + 0.25 * cell);
    const glm::dvec3 position(
      mapped(glm::inverse(texelFromAcross(view, mapSize)), place), this->distance_);
    const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
    return twin
      .at({ glm::dvec3(centredFromView * glm::dvec4(position, 1.0)), { 0.0, 0.0, 1.0 } }, patterned)
      .lit;
  }

private:
  ShadowLight light_ = areaCases().front().light;
  LightViews views_;
  double distance_ = 0.0;
  double radiusTexels_ = 0.0;
};

/// How a profile across the penumbra is: its rows, which are as many patterns, averaged first.
struct Bands
{
  double offBy = 0.0;     ///< root mean square from the truth
  std::size_t levels = 0; ///< different ones
  int columns = 0;
};

Bands bandsOf(PcssTwin twin, bool patterned)
{
  const EdgeOfSun edge;
  Bands bands;
  std::set<long> levels;
  for (int i = -16; i <= 16; ++i, ++bands.columns)
  {
    const double x = 0.05 * i;
    double mean = 0.0;
    constexpr int rows = 100;
    for (int row = 0; row < rows; ++row)
    {
      mean += edge.visibility(twin, x, 32 + row, patterned) / rows;
    }
    levels.insert(std::lround(1e6 * mean));
    bands.offBy += std::pow(mean - diskShare(x), 2);
  }
  bands.offBy = std::sqrt(bands.offBy / bands.columns);
  bands.levels = levels.size();
  return bands;
}

TEST(Pcss, turningThePointsLeavesNoBands)
{
  const EdgeOfSun edge;
  const Bands turned = bandsOf(edge.twin(), true);
  const Bands alike = bandsOf(edge.twin(), false);
  // As many points on a grid of the square, and on the disk that this makes.
  std::vector<glm::vec2> grid;
  for (int i = 0; i < 32; ++i)
  {
    const glm::vec2 place(0.5 * (i % 4) - 0.75, 0.5 * (i / 4 % 4) - 0.75);
    grid.push_back(diskPoint(place));
  }
  PcssTwin uniform = edge.twin();
  uniform.setPoints(grid);
  const Bands regular = bandsOf(uniform, false);
  for (const auto& [name, bands] :
    { std::pair("turned", turned), { "alike", alike }, { "regular", regular } })
  {
    RecordProperty(name,
      std::to_string(bands.offBy) + ", levels " + std::to_string(bands.levels) + " of " +
        std::to_string(bands.columns));
  }
  EXPECT_LT(turned.offBy, 0.02); // a level of 16 points is 0.0625
  EXPECT_GT(alike.offBy, 2.0 * turned.offBy);
  EXPECT_GT(regular.offBy, 2.0 * turned.offBy);
  EXPECT_GT(turned.levels, 2 * regular.levels);
}

/// Noise along a penumbra, where the truth is the same: cells have nothing to do with their neighbours, so that no frequency has
/// more of it than others.
TEST(Pcss, noiseOfTurnedPointsIsHardlyCoarserThanWhite)
{
  const EdgeOfSun edge;
  PcssTwin twin = edge.twin();
  constexpr int cells = 160;
  double power[cells / 2 + 1] = {};
  double square = 0.0;
  double withNext = 0.0;
  int rows = 0;
  for (int i = -5; i <= 5; ++i, ++rows)
  {
    const double x = 0.1 * i;
    std::vector<double> noise;
    double mean = 0.0;
    for (int cell = 0; cell < cells; ++cell)
    {
      noise.push_back(edge.visibility(twin, x, cell, true));
      mean += noise.back() / cells;
    }
    for (int cell = 0; cell < cells; ++cell)
    {
      const auto at = static_cast<std::size_t>(cell);
      noise[at] -= mean;
      square += noise[at] * noise[at];
      withNext += cell > 0 ? noise[at] * noise[at - 1] : 0.0;
    }
    for (int frequency = 1; frequency <= cells / 2; ++frequency)
    {
      double real = 0.0;
      double imaginary = 0.0;
      for (int cell = 0; cell < cells; ++cell)
      {
        const double angle = glm::two_pi<double>() * frequency * cell / cells;
        real += noise[static_cast<std::size_t>(cell)] * std::cos(angle);
        imaginary += noise[static_cast<std::size_t>(cell)] * std::sin(angle);
      }
      power[frequency] += real * real + imaginary * imaginary;
    }
  }
  double all = 0.0;
  double high = 0.0;
  double low = 0.0;
  for (int frequency = 1; frequency < cells / 2; ++frequency)
  {
    all += power[frequency];
    high += frequency > cells / 4 ? power[frequency] : 0.0;
    low += frequency <= cells / 8 ? power[frequency] : 0.0;
  }
  RecordProperty("noise", std::to_string(std::sqrt(square / (rows * cells))));
  RecordProperty("upper_half", std::to_string(high / all));
  RecordProperty("lowest_quarter", std::to_string(low / all));
  RecordProperty("with_next", std::to_string(withNext / square));
  EXPECT_GT(high / all, 0.4); // 0.5 of white noise
  EXPECT_LT(low / all, 0.35);
  EXPECT_LT(withNext / square, 0.1);
}

TEST(Pcss, widthsAreThoseOfSimilarTriangles)
{
  // Selected Real-Time Shadow Techniques, 2.9: a light of width 1, a receiver at 10 and a blocker at 5; a frustum
  // that is 10 wide at the near plane 1. The penumbra is 0.1 of the map's plane there, the filter 0.01.
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  light.positionWorld = { 0.0, 0.0, 10.0 };
  light.coneAngleDegrees = 50.0;
  light.area = rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, glm::dvec2(0.5));
  const Bounds casters{ { -1.0, -1.0, 5.0 }, { 1.0, 1.0, 5.0 } };
  const Bounds receivers{ { -5.0, -5.0, 0.0 }, glm::dvec3(5.0) };
  LightViews views = fitLightViews(light, glm::dvec3(0.0), casters, 1024, 1);
  // Half the light's diagonal times 1/5 - 1/10. Distances are cut 0.1 % short, so that rounding cuts no
  // caster off.
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 0.1, 2e-4);
  EXPECT_EQ(reachOfArea(LightArea(), views, casters, receivers), 0.0);
  light.kind = LightKind::Directional;
  views = fitLightViews(light, glm::dvec3(0.0), casters, 1024, 1);
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 5.0, 1e-3);
  // Nothing is nearer to a point light than the casters' box, whatever its faces' planes cut.
  light.kind = LightKind::Point;
  const Bounds wide{ glm::dvec3(-4.0), glm::dvec3(4.0) };
  views = fitLightViews(light, glm::dvec3(0.0), wide, 1024, 1);
  EXPECT_LT(reachOfArea(ballArea(0.3), views, wide, receivers), 0.3);
}

} // namespace
} // namespace gnomon::test
