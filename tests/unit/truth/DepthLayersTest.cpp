// The layers of `montecarlo`, against rays along the light through the texels' centres.

#include "EstimatorGlsl.h"
#include "RandomScenes.h"

#include "lights/LightViews.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/montecarlo/DepthLayers.h"
#include "shadowtech/montecarlo/RaySpace.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace gnomon::test
{
namespace
{

/// A surface along a texel's ray.
struct Hit
{
  double depth; ///< in ray space
  double span;  ///< of its plane within the texel
  bool front;   ///< faces the light
};

/// The layers of a light with a single view, and the rays along which they were seen.
class Layers
{
public:
  Layers(ShadowLight light, const std::vector<Prop>& props, RayLayers kind, int side)
    : side_(side)
    , occluders_(makeOccluders(props))
  {
    light.mapSizeTexels = side;
    light.monteCarlo.layers = kind;
    const LightViews views = viewsOf(lightOfMap(light), this->occluders_);
    this->view_ = views.views.at(0);
    if (this->view_.rays.positional)
    {
      this->nearest_ = this->view_.beginsAt;
    }
    OccluderBuffers buffers;
    buffers.update(this->occluders_);
    ShaderLibrary shaders;
    DepthLayers layers;
    {
      const GlStateGuard guard;
      layers.draw({ light, views, this->occluders_, buffers, shaders }, this->nearest_);
    }
    std::vector<glm::vec4> pages(this->texels() * static_cast<std::size_t>(layers.pages()));
    glBindTexture(GL_TEXTURE_2D_ARRAY, layers.slabs());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_FLOAT, pages.data());
    this->slabs_.resize(this->texels());
    for (std::size_t i = 0; i < pages.size(); ++i)
    {
      std::vector<glm::dvec2>& slabs = this->slabs_[i % this->texels()];
      slabs.emplace_back(pages[i].x, -pages[i].y);
      slabs.emplace_back(pages[i].z, -pages[i].w);
    }
  }

  int side() const { return this->side_; }
  /// Return a texel's slabs, including empty ones.
  const std::vector<glm::dvec2>& slabs(int x, int y) const
  {
    return this->slabs_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->side_) +
      static_cast<std::size_t>(x)];
  }
  bool isEmpty(int x, int y) const
  {
    const std::vector<glm::dvec2>& all = this->slabs(x, y);
    return std::all_of(
      all.begin(), all.end(), [](const glm::dvec2& slab) { return slab == glm::dvec2(2.0, -2.0); });
  }

  /// Return the depth in ray space of a distance along the view.
  double depthAt(double z) const
  {
    return this->view_.rays.positional ? -this->nearest_ / z
                                       : z * this->view_.depthScale + this->view_.depthOffset;
  }
  /// Return the hits of a texel's ray in order. Nothing if they change when a corner is drawn
  /// slightly off its place, as rasterisers may.
  std::optional<std::vector<Hit>> hits(int x, int y) const
  {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    std::vector<Hit> hits = this->hitsAt(centre);
    for (const glm::dvec2& off :
      { glm::dvec2(0.015, 0.015), { -0.015, 0.015 }, { 0.015, -0.015 }, { -0.015, -0.015 } })
    {
      const std::vector<Hit> beside = this->hitsAt(centre + off);
      if (!std::equal(hits.begin(), hits.end(), beside.begin(), beside.end(),
            [](const Hit& a, const Hit& b) { return a.front == b.front; }))
      {
        return std::nullopt;
      }
    }
    return hits;
  }

private:
  std::size_t texels() const
  {
    return static_cast<std::size_t>(this->side_) * static_cast<std::size_t>(this->side_);
  }

  std::vector<Hit> hitsAt(const glm::dvec2& texel) const
  {
    std::vector<Hit> hits;
    for (const CastingTriangle& triangle : this->triangles_)
    {
      const auto meetAt = [&](const glm::dvec2& place)
      {
        const LightRay ray = rayAt(this->view_, this->side_, place); // 1 long along the view
        return meet(triangle, ray.origin, ray.direction);
      };
      const auto hit = meetAt(texel);
      if (hit && hit->isInside())
      {
        const double depth = this->depthAt(hit->at);
        const double span =
          std::abs(this->depthAt(meetAt(texel + glm::dvec2(1.0, 0.0))->at) - depth) +
          std::abs(this->depthAt(meetAt(texel + glm::dvec2(0.0, 1.0))->at) - depth);
        hits.push_back({ depth, span, hit->cosine < 0.0 });
      }
    }
    std::sort(
      hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    return hits;
  }

  int side_;
  Occluders occluders_;
  std::vector<CastingTriangle> triangles_ = castingTriangles(occluders_);
  LightView view_;
  double nearest_ = 1.0;
  std::vector<std::vector<glm::dvec2>> slabs_;
};

/// Corners are drawn to within 1/256 of a texel, and depths are rounded: a small part of the
/// plane's span in the texel.
double tolerance(const Hit& hit)
{
  return hit.span / 100.0 + 4e-6;
}

/// A box, a sphere and two sheets of either winding over a floor; none of them touch.
std::vector<Prop> things()
{
  return { { makePlane(8.0) }, { makeBox({ -1.2, -1.0, 0.5 }, { 0.2, 0.3, 1.6 }) },
    { makeSphere(12, 16), at({ 1.2, 0.8, 1.3 }, 0.8) },
    { makePlane(1.5), glm::rotate(at({ -0.3, 0.4, 2.6 }), 0.5, glm::dvec3(1.0, 0.4, 0.0)) },
    { makePlane(1.2), glm::rotate(at({ 0.6, -0.5, 2.2 }), 2.7, glm::dvec3(0.2, 1.0, 0.0)) } };
}

std::vector<ShadowLight> lights()
{
  return { directionalLight({ 0.4, 0.3, -1.0 }), directionalLight({ 0.0, 0.0, -1.0 }),
    spotLight({ -2.0, -2.5, 6.0 }, { 0.0, 0.0, 0.5 }, 40.0) };
}

using DepthLayersTest = GlslTest;

/// Return the largest depth of a solid that ends at a surface of a texel. A sheet spans the texel.
/// If a body's front spans more than the body's thickness, the body extends to that front's depths
/// in the texels beside it.
double reachOf(const Layers& layers, int x, int y, const std::vector<Hit>& hits, std::size_t i)
{
  double reach = hits[i].depth + hits[i].span;
  if (i == 0 || !hits[i - 1].front || hits[i].front)
  {
    return reach;
  }
  const Hit& front = hits[i - 1];
  const double farthest = front.depth + 1.01 * front.span + tolerance(front);
  for (const glm::ivec2& beside : { glm::ivec2(1, 0), { -1, 0 }, { 0, 1 }, { 0, -1 } })
  {
    const int column = x + beside.x;
    const int row = y + beside.y;
    if (std::clamp(column, 0, layers.side() - 1) != column ||
      std::clamp(row, 0, layers.side() - 1) != row)
    {
      continue;
    }
    const std::optional<std::vector<Hit>> others = layers.hits(column, row);
    if (!others)
    {
      return std::max(reach, farthest); // the neighbour's hits are uncertain
    }
    for (const Hit& other : *others)
    {
      if (other.front && other.depth <= farthest &&
        other.depth - 1.01 * other.span <= front.depth + tolerance(other))
      {
        reach = std::max(reach, other.depth + tolerance(other));
      }
    }
  }
  return reach;
}

/// Expect a texel of two layers to end at the last surface, or within its span.
void expectEnd(const glm::dvec2& slab, const std::vector<Hit>& hits)
{
  double least = -2.0, farthest = -2.0;
  for (const Hit& hit : hits)
  {
    least = std::max(least, hit.depth - tolerance(hit));
    farthest = std::max(farthest, hit.depth + hit.span + 2.0 * tolerance(hit));
  }
  EXPECT_GE(slab.y, least);
  EXPECT_LE(slab.y, farthest);
}

/// Expect a texel of peeled layers to be solid from fronts to backs, and empty from backs to
/// fronts.
/// @return the numbers of solids and gaps
glm::ivec2 expectSolids(const Layers& layers, int x, int y, const std::vector<Hit>& hits)
{
  glm::ivec2 found(0);
  const auto isSolid = [&](double depth, double slack)
  {
    const std::vector<glm::dvec2>& slabs = layers.slabs(x, y);
    return std::any_of(slabs.begin(), slabs.end(),
      [&](const glm::dvec2& slab) { return slab.x - slack <= depth && depth <= slab.y + slack; });
  };
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const Hit& hit = hits[i];
    EXPECT_TRUE(isSolid(hit.depth, tolerance(hit))) << hit.depth;
    if (i + 1 == hits.size())
    {
      continue;
    }
    const double middle = 0.5 * (hit.depth + hits[i + 1].depth);
    if (hit.front && !hits[i + 1].front)
    {
      ++found.x;
      EXPECT_TRUE(isSolid(middle, 0.0)) << middle;
    }
    else if (reachOf(layers, x, y, hits, i) + tolerance(hit) < middle)
    {
      ++found.y;
      EXPECT_FALSE(isSolid(middle, 0.0)) << middle;
    }
  }
  return found;
}

TEST_F(DepthLayersTest, areWhatEachTexelsRayMeets)
{
  for (const ShadowLight& light : lights())
  {
    for (const RayLayers kind : { RayLayers::Near, RayLayers::NearFar, RayLayers::Peeled })
    {
      const Layers layers(light, things(), kind, 64);
      int counted = 0, empty = 0;
      glm::ivec2 solidsAndGaps(0);
      for (int i = 0; i < 64 * 64 && !HasFailure(); ++i)
      {
        const int x = i % 64, y = i / 64;
        SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
        const std::optional<std::vector<Hit>> hits = layers.hits(x, y);
        if (!hits)
        {
          continue;
        }
        ++counted;
        if (hits->empty())
        {
          ++empty;
          EXPECT_TRUE(layers.isEmpty(x, y));
          continue;
        }
        const std::vector<glm::dvec2>& slabs = layers.slabs(x, y);
        const double begin = std::min_element(slabs.begin(), slabs.end(),
          [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x < b.x;
          })->x;
        EXPECT_NEAR(begin, hits->front().depth, tolerance(hits->front()));
        if (kind == RayLayers::NearFar)
        {
          expectEnd(slabs[0], *hits);
        }
        else if (kind == RayLayers::Peeled)
        {
          solidsAndGaps += expectSolids(layers, x, y, *hits);
        }
      }
      EXPECT_GT(counted, 64 * 64 * 8 / 10);
      EXPECT_GT(empty, light.directionWorld == lights()[1].directionWorld ? -1 : 50);
      EXPECT_TRUE(kind != RayLayers::Peeled || (solidsAndGaps.x > 150 && solidsAndGaps.y > 300));
    }
  }
}

} // namespace
} // namespace gnomon::test
