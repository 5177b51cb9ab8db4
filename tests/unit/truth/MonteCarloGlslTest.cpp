// The GLSL of `montecarlo`, against twins.

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "lights/Bounds.h"
#include "lights/LightSamples.h"
#include "lights/LightViews.h"
#include "lights/ReducedMd5.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/montecarlo/DepthLayers.h"
#include "shadowtech/montecarlo/RaySpace.h"
#include "shadowtech/montecarlo/SlabBounds.h"
#include "shadowtech/montecarlo/UndecidedTiles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace gnomon::test
{
namespace
{

/// A compute shader around a file of montecarlo's.
std::string monteCarloGlsl(const std::string& included, const std::string& in,
  const std::string& out, const std::string& body)
{
  return computeGlsl(ShaderLibrary::source("shadowtech/montecarlo/" + included), in, out, body);
}

class MonteCarloGlsl : public GlslTest
{
protected:
  float uniform() { return static_cast<float>(this->random_() / 4294967296.0); }

  ShaderLibrary library_;
  std::mt19937 random_{ 7 };
};

TEST_F(MonteCarloGlsl, hashesAsTheCpuDoes)
{
  std::vector<glm::uvec4> seeds;
  for (std::uint32_t i = 0; i < 10000; ++i)
  {
    seeds.emplace_back(i % 173, i / 173, i % 3, 0);
    const std::uint32_t x = this->random_(), y = this->random_(), z = this->random_();
    seeds.emplace_back(x, y, z, this->random_());
  }
  for (const std::uint32_t key : { 0u, 7u, 0xdeadbeefu })
  {
    const auto hashes = runCompute<glm::uvec4>(this->library_,
      monteCarloGlsl("reduced_md5.glsl", "uvec4", "uvec4",
        "result[i] = reducedMd5(given[i], " + std::to_string(key) + "u);\n"),
      seeds);
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
      ASSERT_EQ(hashes[i], reducedMd5(seeds[i], key)) << i;
    }
  }
}

TEST_F(MonteCarloGlsl, takesTheJitteredSamplesOfTheLight)
{
  ShadowLight light;
  light.lightSampling = LightSampling::Jittered;
  light.lightSamples = 9;
  light.lightSeed = 3;
  std::vector<glm::ivec4> places;
  for (int i = 0; i < 9000; ++i)
  {
    places.emplace_back(i / 9 % 40, i / 360, i % 9, 0);
  }
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
  const LightArea areas[] = { rectangleArea(travel, { 0.0, 0.0, 1.0 }, { 0.5, 0.25 }),
    diskArea(travel, 0.75), ballArea(0.5) };
  for (const LightArea& area : areas)
  {
    light.area = area;
    const LightSamples samples(light);
    const auto points = runCompute<glm::vec4>(this->library_,
      monteCarloGlsl("light_points.glsl", "ivec4", "vec4",
        "ivec4 at = given[i];\n"
        "result[i] = vec4(lightPoint(fourPoints(at.xy, at.z), at.z), 0.0);\n"),
      places,
      { { "viewFromUnit", glm::mat3(area.worldFromUnit) }, { "lightSeed", light.lightSeed } },
      { "RAYS 3", "SHAPE " + std::to_string(static_cast<int>(area.shape)) });
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const glm::ivec4& at = places[i];
      const SamplePixel pixel =
        samples.pixel(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
      ASSERT_LT(glm::distance(glm::vec3(points[i]), samples.offset(at.z, pixel)), 3e-5f)
        << i << " of shape " << static_cast<int>(area.shape);
    }
  }
}

struct RayLine
{
  glm::vec4 begin;
  glm::vec4 end;
};

/// Slabs of a map with one page.
class SlabMap
{
public:
  /// Random slabs, two in a texel.
  SlabMap(int side, int boxes, std::mt19937& random)
    : side_(side)
    , slabs_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
        glm::vec4(2.0f, -2.0f, 2.0f, -2.0f))
  {
    for (int i = 0; i < boxes; ++i)
    {
      const auto number = [&](int below)
      { return static_cast<int>(random() % static_cast<unsigned>(below)); };
      const int width = 1 + number(side / 3);
      const int height = 1 + number(side / 3);
      const int x0 = number(side);
      const int y0 = number(side);
      const float begin = 0.05f + 0.8f * static_cast<float>(random() / 4294967296.0);
      for (int y = y0; y < std::min(y0 + height, side); ++y)
      {
        for (int x = x0; x < std::min(x0 + width, side); ++x)
        {
          // Slopes, so that neighbours differ; every other box in the second slab.
          const float depth = begin + 0.001f * static_cast<float>(x - x0);
          glm::vec4& texel = this->at(x, y);
          (i % 2 == 0 ? texel.x : texel.z) = depth;
          (i % 2 == 0 ? texel.y : texel.w) = depth + 0.002f * static_cast<float>(1 + i % 40);
        }
      }
    }
    this->upload();
  }

  /// One slab in each texel.
  SlabMap(int side, const std::function<glm::vec2(const glm::ivec2&)>& slabAt)
    : side_(side)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        this->slabs_.emplace_back(slabAt({ x, y }), 2.0f, -2.0f);
      }
    }
    this->upload();
  }

  glm::vec4& at(int x, int y)
  {
    return this->slabs_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->side_) +
      static_cast<std::size_t>(x)];
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < this->side_ && y < this->side_; }
  GLuint texture() const { return this->texture_.name(); }
  int side() const { return this->side_; }

  /// Return the extrema over a square of texels, cut by [0, whole)^2, like slab_bounds.comp.glsl.
  /// Texels beyond the map have no slab.
  glm::vec4 bounds(const glm::ivec2& lower, int size, int whole)
  {
    glm::vec4 result(2.0f, -2.0f, -10.0f, 10.0f);
    for (int y = std::max(lower.y, 0); y < std::min(lower.y + size, whole); ++y)
    {
      for (int x = std::max(lower.x, 0); x < std::min(lower.x + size, whole); ++x)
      {
        const glm::vec4 texel =
          this->holds(x, y) ? this->at(x, y) : glm::vec4(2.0f, -2.0f, 2.0f, -2.0f);
        const bool secondIsThicker = texel.w - texel.z > texel.y - texel.x;
        const glm::vec2 thickest(
          secondIsThicker ? texel.z : texel.x, secondIsThicker ? texel.w : texel.y);
        result = { std::min({ result.x, texel.x, texel.z }),
          std::max({ result.y, texel.y, texel.w }), std::max(result.z, thickest.x),
          std::min(result.w, thickest.y) };
      }
    }
    return result;
  }

  /// True if a line meets a slab; tested texel by texel in the order of its crossings, in double
  /// precision.
  bool meets(const glm::dvec3& begin, const glm::dvec3& end)
  {
    const glm::dvec3 way = end - begin;
    std::vector<double> crossings{ 0.0, 1.0 };
    for (int axis = 0; axis < 2; ++axis)
    {
      const auto [least, greatest] = std::minmax(begin[axis], end[axis]);
      for (int border = static_cast<int>(std::ceil(least)); border <= greatest; ++border)
      {
        const double t = (border - begin[axis]) / way[axis];
        if (t > 0.0 && t < 1.0)
        {
          crossings.push_back(t);
        }
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
    {
      const glm::dvec3 middle = begin + 0.5 * (crossings[i] + crossings[i + 1]) * way;
      const int x = static_cast<int>(std::floor(middle.x));
      const int y = static_cast<int>(std::floor(middle.y));
      if (!this->holds(x, y))
      {
        continue;
      }
      const double a = begin.z + crossings[i] * way.z;
      const double b = begin.z + crossings[i + 1] * way.z;
      const glm::dvec4 texel(this->at(x, y));
      const double least = std::min(a, b);
      const double greatest = std::max(a, b);
      if ((texel.x <= greatest && least <= texel.y) || (texel.z <= greatest && least <= texel.w))
      {
        return true;
      }
    }
    return false;
  }

  /// True if lines this near all meet a slab, or all do not: 1e-4 of a texel, and 1e-6 in depth.
  /// Other lines pass a texel's corner, or touch a slab, to within rounding.
  bool isDecided(const RayLine& line)
  {
    const glm::dvec3 begin(line.begin);
    const glm::dvec3 end(line.end);
    const bool met = this->meets(begin, end);
    for (int corner = 0; corner < 8; ++corner)
    {
      const auto side = [corner](int bit) { return (corner >> bit) % 2 == 0 ? 1.0 : -1.0; };
      const glm::dvec3 shift(1e-4 * side(0), 1e-4 * side(1), 1e-6 * side(2));
      if (this->meets(begin + shift, end + shift) != met)
      {
        return false;
      }
    }
    return true;
  }

private:
  void upload()
  {
    std::vector<glm::vec4> pages; // as slabs.glsl has them
    for (const glm::vec4& slabs : this->slabs_)
    {
      pages.emplace_back(slabs.x, -slabs.y, slabs.z, -slabs.w);
    }
    allocateMap(this->texture_, { GL_RGBA32F, GL_RGBA, 4 }, this->side_, 1);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, this->side_, this->side_, 1, GL_RGBA, GL_FLOAT,
      pages.data());
  }

  int side_;
  std::vector<glm::vec4> slabs_;
  GlTexture texture_;
};

TEST_F(MonteCarloGlsl, boundsAreExtremaOfTheirTexels)
{
  for (const auto& [side, whole] : { std::pair(64, 64), { 100, 128 }, { 1024, 1024 } })
  {
    SlabMap map(side, 12, this->random_);
    SlabBounds bounds;
    bounds.build(map.texture(), 1, side, 1, this->library_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    ASSERT_EQ(1 << bounds.topLevel(), whole);
    glBindTexture(GL_TEXTURE_2D_ARRAY, bounds.texture());
    for (int level = 0; level <= bounds.topLevel(); ++level)
    {
      const int size = 1 << level;
      const int cells = whole / size;
      std::vector<glm::vec4> found(static_cast<std::size_t>(cells * cells));
      glGetTexImage(GL_TEXTURE_2D_ARRAY, level, GL_RGBA, GL_FLOAT, found.data());
      const int trials = std::clamp(10000000 / (size * size), 10, 2000);
      for (int i = 0; i < trials; ++i)
      {
        // Including the corners.
        const auto place = [&]
        {
          return i % 5 == 0 ? (this->random_() % 2 ? cells - 1 : 0)
                            : static_cast<int>(this->random_() % static_cast<unsigned>(cells));
        };
        const int x = place();
        const glm::ivec2 cell(x, place());
        ASSERT_EQ(found[static_cast<std::size_t>(cell.y * cells + cell.x)],
          map.bounds(cell * size, size, whole))
          << side << ", level " << level << " at " << cell.x << ", " << cell.y;
      }
    }
  }
}

/// Return lines of any length from behind to before all slabs.
std::vector<RayLine> randomLines(int side, std::size_t count, std::mt19937& random)
{
  const auto number = [&] { return static_cast<float>(random() / 4294967296.0); };
  std::vector<RayLine> lines;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float reach = std::pow(number(), 3.0f);
    const auto place = [&] { return glm::vec2(number(), number()) * static_cast<float>(side); };
    const glm::vec2 from = place();
    const glm::vec2 to = glm::mix(from, place(), reach);
    lines.push_back(
      { glm::vec4(from, 0.3f + 0.7f * number(), 0.0f), glm::vec4(to, 0.3f * number(), 0.0f) });
  }
  return lines;
}

/// Return which lines meet a slab.
std::vector<bool> walksOf(SlabMap& map, const std::vector<RayLine>& lines)
{
  std::vector<bool> met;
  for (const RayLine& line : lines)
  {
    met.push_back(map.meets(glm::vec3(line.begin), glm::vec3(line.end)));
  }
  return met;
}

/// Return a search's source.
std::string searchGlsl(const std::string& cellsVisited)
{
  return monteCarloGlsl("slab_search.glsl", "mat2x4", "uvec2",
    "float where;\nbool meets = meetsSlabs(0, given[i][0].xyz, given[i][1].xyz, where);\n"
    "result[i] = uvec2(meets, " +
      cellsVisited + ");\n");
}

std::vector<Uniform> searchUniforms(GLuint slabs, int side, const SlabBounds& bounds)
{
  return { { "slabs", TextureBinding{ GL_TEXTURE_2D_ARRAY, slabs } },
    { "slabBounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, bounds.texture() } }, { "mapSide", side },
    { "topLevel", bounds.topLevel() } };
}

/// Results of the hierarchical search.
struct Searched
{
  int topLevel;
  std::vector<glm::uvec2> found; ///< x: 1 if there is a slab; y: visited cells
  double meanVisits = 0.0;
  unsigned int mostVisits = 0;
};
Searched searchAll(
  ShaderLibrary& library, GLuint slabs, int side, int pages, const std::vector<RayLine>& lines)
{
  SlabBounds bounds;
  bounds.build(slabs, pages, side, 1, library);
  Searched searched{ bounds.topLevel(),
    runCompute<glm::uvec2>(library, searchGlsl("cellsVisited"), lines,
      searchUniforms(slabs, side, bounds), { "PAGES " + std::to_string(pages) }) };
  for (const glm::uvec2& each : searched.found)
  {
    searched.meanVisits += static_cast<double>(each.y) / static_cast<double>(lines.size());
    searched.mostVisits = std::max(searched.mostVisits, each.y);
  }
  return searched;
}

TEST_F(MonteCarloGlsl, searchesAsAWalkFromTexelToTexel)
{
  for (const int boxes : { 6, 60 })
  {
    SlabMap map(128, boxes, this->random_);
    const std::vector<RayLine> lines = randomLines(map.side(), 100000, this->random_);
    const std::vector<bool> truth = walksOf(map, lines);
    const auto hits = static_cast<std::size_t>(std::count(truth.begin(), truth.end(), true));
    EXPECT_GT(hits, lines.size() / 50);
    EXPECT_LT(hits, lines.size() * 49 / 50);
    const Searched searched = searchAll(this->library_, map.texture(), map.side(), 1, lines);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      if ((searched.found[i].x == 1u) != truth[i])
      {
        ++differing;
        EXPECT_FALSE(map.isDecided(lines[i])) << i;
      }
    }
    EXPECT_LE(differing, lines.size() / 10000) << boxes << " boxes";
    // Sixty boxes, each a sixth of the map wide on average, form a maze.
    EXPECT_LT(searched.meanVisits, boxes == 6 ? 4.0 : 16.0) << boxes;
    EXPECT_LT(searched.mostVisits, (64u + 8u * 128u) / 4u) << "far from where it gives up";
  }
}

/// Rays that begin inside a solid need no test of their own: the search finds that in the first
/// texel.
TEST_F(MonteCarloGlsl, searchesThatBeginInsideASlabEndThere)
{
  SlabMap map(128, 60, this->random_);
  std::vector<RayLine> lines;
  for (RayLine line : randomLines(map.side(), 50000, this->random_))
  {
    const glm::vec4 texel = map.at(static_cast<int>(line.begin.x), static_cast<int>(line.begin.y));
    line.begin.z = 0.5f * (texel.x + texel.y);
    if (line.begin.z != 0.0f) // begins in an empty texel or before all slabs
    {
      lines.push_back(line);
    }
  }
  ASSERT_GT(lines.size(), 10000u);
  const Searched searched = searchAll(this->library_, map.texture(), map.side(), 1, lines);
  EXPECT_TRUE(std::all_of(searched.found.begin(), searched.found.end(),
    [](const glm::uvec2& each) { return each.x == 1u; }));
  EXPECT_LE(searched.mostVisits, static_cast<unsigned int>(searched.topLevel) + 1u)
    << "it only descends";
}

/// Boxes between depths of 5 and 20 under an eye, as a map with two layers holds them. Rays go from
/// the ground at 20 to a light at 1 that fills the map's frustum there. The linear search's rates
/// were specified with this geometry.
struct BoxesUnderALight
{
  static constexpr int side = 256;
  static constexpr double tangent = 0.5773503; ///< of half the map's angle, 30 degrees
  static constexpr double nearest = 5.0;
  static constexpr double ground = 20.0;

  std::vector<Bounds> boxes;

  BoxesUnderALight(int count, double least, double greatest, std::mt19937& random)
  {
    const auto number = [&](double from, double to)
    { return from + (to - from) * (random() / 4294967296.0); };
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 half =
        0.5 * glm::dvec3(number(least, greatest), number(least, greatest), number(least, greatest));
      const double z = number(nearest + half.z, ground - half.z);
      const glm::dvec3 centre(number(-1.0, 1.0) * tangent * z, number(-1.0, 1.0) * tangent * z, z);
      this->boxes.push_back({ centre - half, centre + half });
    }
  }

  /// Return the first and the last depth along the eye's ray through a texel's centre, in ray
  /// space.
  glm::vec2 slabAt(const glm::ivec2& texel) const
  {
    const glm::dvec2 across =
      tangent * (2.0 * (glm::dvec2(texel) + 0.5) / static_cast<double>(side) - 1.0);
    glm::dvec2 slab(2.0, -2.0);
    for (const Bounds& box : this->boxes)
    {
      double enters = box.lower.z;
      double leaves = box.upper.z;
      for (int axis = 0; axis < 2; ++axis)
      {
        const double a = box.lower[axis] / across[axis];
        const double b = box.upper[axis] / across[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
      }
      if (enters <= leaves)
      {
        slab = { std::min(slab.x, -1.0 / enters), std::max(slab.y, -1.0 / leaves) };
      }
    }
    return slab;
  }

  /// Cut the ray where no casters are, like `montecarlo`.
  static std::vector<RayLine> rays(std::size_t count, std::mt19937& random)
  {
    const auto place = [&] {
      return static_cast<float>(side) * glm::vec2(random() / 4294967296.0, random() / 4294967296.0);
    };
    std::vector<RayLine> lines;
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::vec4 begin(place(), -1.0 / ground, 0.0f);
      const glm::vec4 end(place(), -1.0f, 0.0f);
      const auto share =
        static_cast<float>((-1.0 / nearest + 1.0 / ground) / (-1.0 + 1.0 / ground));
      lines.push_back({ begin, glm::mix(begin, end, share) });
    }
    return lines;
  }
};

/// Rates are means over maps: those of single maps lie between none and three times as much. The
/// boxes' sides give the specified shares of rays with a hit, 17.2 and 3.8 %.
TEST_F(MonteCarloGlsl, linearSearchNeverHitsWhatIsNotThereAndMissesLittle)
{
  struct Rate
  {
    int steps;
    double specified; ///< the share of all rays whose hit is missed
    double misses = 0.0;
  };
  struct Case
  {
    int boxes;
    double least; ///< of a box's sides
    double greatest;
    double hits; ///< specified share of rays with a hit
    std::vector<Rate> rates;
  };
  Case cases[] = { { 6, 1.0, 2.8, 0.172, { { 8, 0.0015 }, { 32, 0.0004 } } },
    { 60, 0.1, 0.37, 0.038, { { 8, 0.009 }, { 16, 0.004 }, { 32, 0.0014 } } } };
  constexpr int maps = 10;
  constexpr std::size_t raysOfMap = 20000;
  constexpr double each = 1.0 / (maps * raysOfMap);
  for (auto& [boxes, least, greatest, specifiedHits, rates] : cases)
  {
    double hits = 0.0;
    for (int i = 0; i < maps; ++i)
    {
      const BoxesUnderALight scene(boxes, least, greatest, this->random_);
      SlabMap map(
        BoxesUnderALight::side, [&](const glm::ivec2& texel) { return scene.slabAt(texel); });
      const std::vector<RayLine> rays = BoxesUnderALight::rays(raysOfMap, this->random_);
      const std::vector<bool> truth = walksOf(map, rays);
      hits += each * static_cast<double>(std::count(truth.begin(), truth.end(), true));
      for (Rate& rate : rates)
      {
        std::string source = searchGlsl("0");
        replaceOnce(source, "#define STEPS 32", "#define STEPS " + std::to_string(rate.steps));
        const auto found = runCompute<glm::uvec2>(this->library_, source, rays,
          searchUniforms(map.texture(), map.side(), SlabBounds()), { "LINEAR_SEARCH", "PAGES 1" });
        for (std::size_t ray = 0; ray < rays.size(); ++ray)
        {
          const bool hit = found[ray].x == 1u;
          rate.misses += truth[ray] && !hit ? each : 0.0;
          EXPECT_TRUE(truth[ray] || !hit || !map.isDecided(rays[ray]))
            << "a hit where there is nothing: " << boxes << " boxes, ray " << ray;
        }
      }
    }
    EXPECT_NEAR(hits, specifiedHits, 0.1 * specifiedHits) << boxes << " boxes";
    for (const Rate& rate : rates)
    {
      EXPECT_LE(rate.misses, 1.5 * rate.specified) << boxes << " boxes, " << rate.steps << " steps";
    }
  }
}

/// Pixels of surfaces across the view, as input of the filter.
struct FilteredPicture
{
  static constexpr int side = 70;   ///< some tiles of 16 and a part of one
  std::vector<glm::vec4> fragments; ///< as ReceiverTarget has them
  std::vector<glm::vec4> points;
  std::vector<glm::vec4> visibility; ///< x, and y: the class
  std::vector<glm::vec4> slopes;     ///< xyz: its gradient by rays; 0: unknown

  FilteredPicture()
  {
    for (int i = 0; i < side * side; ++i)
    {
      this->fragments.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
      this->points.emplace_back(i % side, i / side, -10.0f, 1.0f);
      this->visibility.emplace_back(1.0f, 5.0f, 0.0f, 0.0f); // searched
      this->slopes.emplace_back(0.0f);
    }
  }
  /// Return a pixel centre's distance to the right of the middle, in pixels.
  static float across(std::size_t pixel)
  {
    return static_cast<float>(static_cast<int>(pixel) % side - side / 2) + 0.5f;
  }
  /// Run both passes of visibility_filter.frag.glsl, for 3 x 3 rays and 5 pixels. Pixels have side
  /// 1.
  /// @param inTiles only in tiles that are not left out, like VisibilityFilter
  std::vector<float> filtered(ShaderLibrary& library, bool inTiles = false) const
  {
    GlTexture textures[7];
    const auto allocated = [&](int i, const void* texels = nullptr)
    {
      allocateTexture(textures[i], { GL_RGBA32F, GL_RGBA, 4 }, side, side, 0, "a test's picture");
      if (texels)
      {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_FLOAT, texels);
      }
      return TextureBinding{ GL_TEXTURE_2D, textures[i].name() };
    };
    const TextureBinding receivers = allocated(0, this->fragments.data());
    const TextureBinding places = allocated(1, this->points.data());
    const TextureBinding unfiltered = allocated(2, this->visibility.data());
    const TextureBinding ofPixels = allocated(3, this->slopes.data());
    // Rows that are left out must not be read.
    const std::vector<glm::vec4> nothing(this->visibility.size(), glm::vec4(std::nanf("")));
    const TextureBinding rows = allocated(4, nothing.data()), ofRows = allocated(5, nothing.data());
    const TextureBinding result = allocated(6, this->visibility.data());
    const std::string source =
      ShaderLibrary::source("shadowtech/montecarlo/visibility_filter.frag.glsl");
    std::vector<std::string> defines = { "FILTER_PIXELS 5", "RAYS 3" };
    UndecidedTiles tiles;
    GLuint program = 0;
    if (inTiles)
    {
      tiles.find(unfiltered.texture, glm::ivec2(side), library);
      defines.emplace_back("MIXED");
      program = UndecidedTiles::use(library, source, defines);
    }
    else
    {
      program = ScreenPass::use(library, source, defines);
    }
    ScreenPass pass;
    const auto draw = [&](const TextureBinding& read, const TextureBinding& slopesOfIt,
                        const glm::ivec2& axis, const glm::ivec2& reachTiles,
                        const std::vector<ScreenPass::Image>& images)
    {
      ShaderLibrary::setUniforms(program,
        { { "receiverFragments", receivers }, { "receiverPoints", places },
          { "unfiltered", unfiltered }, { "source", read }, { "slopes", slopesOfIt },
          { "axis", axis }, { "pixelSide", glm::vec2(1.0f, 0.0f) }, { "lit", 1.0f } },
        0, 0);
      if (!inTiles)
      {
        pass.fill(images, side, side);
        return;
      }
      ShaderLibrary::setUniforms(program, tiles.uniforms(reachTiles), 0, 5);
      tiles.fill(images);
    };
    draw(unfiltered, ofPixels, { 1, 0 }, { 1, 2 }, { { rows.texture }, { ofRows.texture } });
    draw(rows, ofRows, { 0, 1 }, { 1, 1 }, { { result.texture } });
    std::vector<float> values(this->visibility.size());
    glBindTexture(GL_TEXTURE_2D, result.texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values.data());
    return values;
  }
};

/// The error of values: root mean square and maximum.
struct Off
{
  double rms = 0.0;
  double most = 0.0;
};
/// @param of true for pixels that count
Off offFrom(
  const std::vector<float>& values, const std::vector<glm::vec4>& truth,
  const std::function<bool(std::size_t)>& of = [](std::size_t) { return true; })
{
  Off off;
  double count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_TRUE(std::isfinite(values[i])) << i;
    const double difference = of(i) ? std::abs(values[i] - truth[i].x) : 0.0;
    count += of(i) ? 1.0 : 0.0;
    off.rms += difference * difference;
    off.most = std::max(off.most, difference);
  }
  off.rms = std::sqrt(off.rms / count);
  return off;
}

TEST_F(MonteCarloGlsl, filterSmoothsNoiseOfOneSurface)
{
  FilteredPicture noisy, even;
  for (std::size_t i = 0; i < noisy.visibility.size(); ++i)
  {
    noisy.visibility[i].x = 0.4f + 0.2f * this->uniform(); // an RMS of 0.058
    even.visibility[i].x = 0.7f;
  }
  const std::vector<glm::vec4> truth(noisy.visibility.size(), glm::vec4(0.5f));
  EXPECT_LT(offFrom(noisy.filtered(this->library_), truth).rms, 0.015);
  EXPECT_LE(offFrom(even.filtered(this->library_), even.visibility).most, 1e-6);
}

TEST_F(MonteCarloGlsl, filterKeepsEdgesOfSurfacesAndOfShadows)
{
  FilteredPicture gap, crease, edge, decided, away;
  const auto expectKept =
    [&](FilteredPicture& picture, float left, float right, double tolerance, const char* what)
  {
    for (std::size_t i = 0; i < picture.visibility.size(); ++i)
    {
      picture.visibility[i].x = FilteredPicture::across(i) < 0.0f ? left : right;
    }
    EXPECT_LE(offFrom(picture.filtered(this->library_), picture.visibility).most, tolerance)
      << what;
  };
  for (std::size_t i = 0; i < gap.points.size(); ++i)
  {
    const bool left = FilteredPicture::across(i) < 0.0f;
    gap.points[i].z = left ? -10.0f : -110.0f;
    // To the right is a surface that stands along the view: its normal is x.
    crease.fragments[i].z = left ? 0.0f : 1.0f;
    crease.points[i].w = left ? 1.0f : 0.0f;
    decided.visibility[i].y = 2.0f; // by bounds
    away.visibility[i].y = left ? 1.0f : 5.0f;
  }
  expectKept(gap, 0.4f, 0.6f, 0.002, "a gap in depth of 100 pixels: 1 % of the step");
  expectKept(crease, 0.4f, 0.6f, 1e-6, "a crease");
  expectKept(edge, 0.0f, 1.0f, 0.001, "a sharp shadow");
  expectKept(decided, 0.4f, 0.6f, 0.0, "what no ray has decided, bit for bit");
  expectKept(away, 0.4f, 0.6f, 1e-6, "what is turned away gives nothing to others");
}

/// A penumbra narrower than the filter's 11 pixels does not spread: where all rays agree there is
/// little noise.
TEST_F(MonteCarloGlsl, filterKeepsNarrowPenumbrae)
{
  FilteredPicture ramp;
  for (std::size_t i = 0; i < ramp.visibility.size(); ++i)
  {
    ramp.visibility[i].x = std::clamp(FilteredPicture::across(i) / 4.0f, 0.0f, 1.0f);
  }
  EXPECT_LE(offFrom(ramp.filtered(this->library_), ramp.visibility).most, 0.025);
}

/// A penumbra keeps its width, and loses noise along its edge.
TEST_F(MonteCarloGlsl, filterGoesAlongPenumbraeWhoseSlopeRaysTell)
{
  FilteredPicture ramp, noisy;
  for (std::size_t i = 0; i < ramp.visibility.size(); ++i)
  {
    const float lit = 0.5f + FilteredPicture::across(i) / 12.0f;
    const float slope = lit > 0.0f && lit < 1.0f ? 1.0f / 12.0f : 0.0f;
    ramp.visibility[i].x = std::clamp(lit, 0.0f, 1.0f);
    ramp.slopes[i].x = noisy.slopes[i].x = slope;
    noisy.visibility[i].x =
      std::clamp(lit + 0.2f * (this->uniform() - 0.5f), 0.0f, 1.0f); // an RMS of 0.058
  }
  const auto within = [](float pixels)
  { return [=](std::size_t i) { return std::abs(FilteredPicture::across(i)) < pixels; }; };
  EXPECT_LT(offFrom(ramp.filtered(this->library_), ramp.visibility, within(12.0f)).rms, 0.007);
  EXPECT_LT(offFrom(noisy.filtered(this->library_), ramp.visibility, within(3.6f)).rms, 0.017);
}

/// Tiles that are left out would not change, and are not read. Pictures are all lit or all dark by
/// bounds, except for a few pixels decided by rays near the tiles' sides and corners.
TEST_F(MonteCarloGlsl, filterLeavesOutOnlyTilesThatStayAsTheyAre)
{
  int changed = 0;
  for (const float decided : { 1.0f, 0.0f })
  {
    for (int picture = 0; picture < 40; ++picture)
    {
      FilteredPicture seen;
      for (glm::vec4& pixel : seen.visibility)
      {
        pixel = glm::vec4(decided, decided == 1.0f ? 2.0f : 3.0f, 0.0f, 0.0f);
      }
      const int corner = 16 * (1 + picture % 3);
      for (int i = 0; i < 3; ++i)
      {
        const int x = std::clamp(
          corner - 6 + static_cast<int>(12.0f * this->uniform()), 0, FilteredPicture::side - 1);
        const int y = std::clamp(
          corner - 6 + static_cast<int>(12.0f * this->uniform()), 0, FilteredPicture::side - 1);
        glm::vec4& pixel = seen.visibility[static_cast<std::size_t>(y * FilteredPicture::side + x)];
        pixel = glm::vec4(picture % 4 == 0 ? decided : this->uniform(), 5.0f, 0.0f, 0.0f);
      }
      const std::vector<float> whole = seen.filtered(this->library_);
      EXPECT_EQ(seen.filtered(this->library_, true), whole) << decided << " " << picture;
      for (std::size_t i = 0; i < whole.size(); ++i)
      {
        changed += whole[i] != seen.visibility[i].x ? 1 : 0;
      }
    }
  }
  EXPECT_GT(changed, 1000);
}

ShadowLight lampOver(double radius, double coneAngleDegrees)
{
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.positionWorld = { 1.0, 2.0, 10.0 };
  light.directionWorld = { 0.0, 0.0, -1.0 };
  light.coneAngleDegrees = coneAngleDegrees;
  light.area = diskArea(light.directionWorld, radius);
  return light;
}

TEST(RaySpace, stepsBackUntilItsConeHoldsTheLight)
{
  ShadowLight light = lampOver(0.0, 30.0);
  EXPECT_EQ(distanceToProjectionPoint(light), 0.0);
  light.area = ballArea(1.0);
  EXPECT_NEAR(distanceToProjectionPoint(light), 2.0, 1e-12);
  EXPECT_NEAR(nearestOfArea(light), 1.0, 1e-12);
  const LightArea flat[] = { diskArea(light.directionWorld, 1.0),
    rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, { 0.6, 0.8 }) };
  for (const LightArea& area : flat)
  {
    light.area = area;
    EXPECT_NEAR(distanceToProjectionPoint(light), std::sqrt(3.0), 1e-6);
    EXPECT_EQ(lightOfMap(light).positionWorld.z, 10.0 + distanceToProjectionPoint(light));
  }

  // Lines from points of the cone to points of the light stay in the cone.
  const ShadowLight seen = lightOfMap(light);
  std::mt19937 random(3);
  const auto number = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  const double tangent = std::tan(glm::radians(30.0));
  for (int i = 0; i < 10000; ++i)
  {
    const double distance = 5.0 + 4.0 * number();
    const double angle = 3.14159 * number();
    const glm::dvec3 receiver = light.positionWorld +
      distance * glm::dvec3(tangent * std::cos(angle), tangent * std::sin(angle), -1.0);
    const glm::dvec3 end =
      light.positionWorld + light.area->worldFromUnit * glm::dvec3(number(), number(), 0.0);
    const glm::dvec3 at = glm::mix(receiver, end, 0.5 + 0.5 * number()) - seen.positionWorld;
    ASSERT_LE(std::hypot(at.x, at.y), -at.z * tangent * (1.0 + 1e-9));
  }
  light.kind = LightKind::Point;
  EXPECT_EQ(distanceToProjectionPoint(light), 0.0) << "the faces of a cube see all around";
}

TEST(RaySpace, keepsLinesStraightAndDepthsInOrder)
{
  const Bounds casters{ { -3.0, -2.0, -1.0 }, { 2.0, 4.0, 5.0 } };
  ShadowLight sun;
  sun.directionWorld = glm::normalize(glm::dvec3(0.2, -0.3, -1.0));
  for (const ShadowLight& light : { lampOver(1.0, 40.0), sun })
  {
    const LightViews views =
      fitLightViews(lightOfMap(light), { glm::dvec3(0.0), casters, {}, { 256, 1 }, {} });
    ASSERT_EQ(views.views.size(), 1u);
    const LightView& view = views.views[0];
    const double nearest = 2.0;
    const auto at = [&](const glm::dvec3& point)
    {
      const glm::dvec4 image = rayFromCentred(view, 256, nearest) * glm::dvec4(point, 1.0);
      EXPECT_GT(image.w, 0.0);
      return glm::dvec3(image) / image.w;
    };
    const glm::dvec3 from(-1.0, 1.0, 0.0), to(1.5, 3.0, 4.0);
    const glm::dvec3 a = at(from), b = at(to), between = at(glm::mix(from, to, 0.3));
    EXPECT_GT(a.z, b.z) << "farther from the light";
    const double share = (between.z - a.z) / (b.z - a.z);
    EXPECT_LT(glm::length(between - glm::mix(a, b, share)), 1e-10);
    // The place in the map.
    const glm::dvec3 inView(view.rays.viewFromCentred * glm::dvec4(from, 1.0));
    const glm::dvec2 texel = mapped(texelFromAcross(view, 256), view.rays.across(inView));
    EXPECT_LT(glm::distance(glm::dvec2(a), texel), 1e-9);
    EXPECT_NEAR(a.z,
      view.rays.positional ? -nearest / inView.z : inView.z * view.depthScale + view.depthOffset,
      1e-12);
  }
}

} // namespace
} // namespace gnomon::test
