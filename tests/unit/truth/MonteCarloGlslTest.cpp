// What `montecarlo` computes on the GPU, against twins.

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

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace gnomon::test
{
namespace
{

/// Runs a compute shader with one invocation per input: `uniform int count`, buffer 0 in, buffer 1
/// out.
template <typename Out, typename In>
std::vector<Out> runCompute(ShaderLibrary& library, const std::string& glsl,
  const std::vector<In>& in, const std::vector<std::string>& defines = {},
  const std::vector<Uniform>& uniforms = {})
{
  const GLuint program = library.program({ { GL_COMPUTE_SHADER, glsl } }, defines);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  ShaderLibrary::setUniform(program, { "count", static_cast<int>(in.size()) });
  GlBuffer buffers[2];
  allocateStorage(buffers[0], in.size() * sizeof(In), in.data(), "a test's input");
  allocateStorage(buffers[1], in.size() * sizeof(Out), nullptr, "a test's output");
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0].name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1].name());
  glDispatchCompute(static_cast<GLuint>((in.size() + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<Out> out(in.size());
  glGetBufferSubData(
    GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(out.size() * sizeof(Out)), out.data());
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  return out;
}

/// The frame of such a shader.
std::string computeGlsl(const std::string& included, const std::string& in, const std::string& out,
  const std::string& body)
{
  return "layout(local_size_x = 64) in;\nuniform int count;\n"
         "layout(std430, binding = 0) readonly buffer In { " +
    in + " given[]; };\nlayout(std430, binding = 1) writeonly buffer Out { " + out +
    " result[]; };\n" + ShaderLibrary::source("shadowtech/montecarlo/" + included) +
    "\nvoid main()\n{\n  uint i = gl_GlobalInvocationID.x;\n  if (i < uint(count))\n  {\n" + body +
    "  }\n}\n";
}

class MonteCarloGlsl : public GlslTest
{
protected:
  float uniform() { return static_cast<float>(this->random_() / 4294967296.0); }

  ShaderLibrary library_;
  std::mt19937 random_{ 7 };
};

//------------------------------------------------------------------------------
TEST_F(MonteCarloGlsl, hashesAsTheCpuDoes)
{
  std::vector<glm::uvec4> seeds;
  for (std::uint32_t i = 0; i < 20000; ++i)
  {
    const bool pixel = i % 2 == 0;
    seeds.emplace_back(pixel ? i % 173 : this->random_(), pixel ? i / 173 : this->random_(),
      pixel ? i % 3 : this->random_(), pixel ? 0 : this->random_());
  }
  for (const std::uint32_t key : { 0u, 7u, 0xdeadbeefu })
  {
    const auto hashes = runCompute<glm::uvec4>(this->library_,
      computeGlsl("reduced_md5.glsl", "uvec4", "uvec4",
        "result[i] = reducedMd5(given[i], " + std::to_string(key) + "u);\n"),
      seeds);
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
      ASSERT_EQ(hashes[i], reducedMd5(seeds[i], key)) << i;
    }
  }
}

//------------------------------------------------------------------------------
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
      computeGlsl("light_points.glsl", "ivec4", "vec4",
        "ivec4 at = given[i];\n"
        "result[i] = vec4(lightPoint(fourPoints(at.xy, at.z), at.z), 0.0);\n"),
      places, { "RAYS 3", "SHAPE " + std::to_string(static_cast<int>(area.shape)) },
      { { "viewFromUnit", glm::mat3(area.worldFromUnit) }, { "lightSeed", light.lightSeed } });
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

//------------------------------------------------------------------------------
struct RayLine
{
  glm::vec4 begin;
  glm::vec4 end;
};

/// Slabs of a map with one page.
class SlabMap
{
public:
  /// Random ones, two in a texel.
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

  /// The extrema over a square of texels, as far as they are on the map: slab_bounds.comp.glsl.
  glm::vec4 bounds(int x0, int y0, int size)
  {
    glm::vec4 result(2.0f, -2.0f, -10.0f, 10.0f);
    for (int y = y0; y < y0 + size; ++y)
    {
      for (int x = x0; x < x0 + size; ++x)
      {
        if (!this->holds(x, y))
        {
          continue;
        }
        const glm::vec4 texel = this->at(x, y);
        const glm::vec2 first(texel.x, texel.y);
        const glm::vec2 second(texel.z, texel.w);
        result.x = std::min(result.x, std::min(first.x, second.x));
        result.y = std::max(result.y, std::max(first.y, second.y));
        glm::vec2 thickest(2.0f, -2.0f);
        for (const glm::vec2& slab : { first, second })
        {
          thickest = slab.y - slab.x > thickest.y - thickest.x ? slab : thickest;
        }
        result.z = std::max(result.z, thickest.x);
        result.w = std::min(result.w, thickest.y);
      }
    }
    return result;
  }

  /// Whether a line meets a slab, texel by texel in the order of its crossings, in double
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

  /// Whether lines this near to one all meet a slab, or all do not: 1e-4 of a texel, and 1e-6 in
  /// depth. Others pass a texel's corner, or touch a slab, to within rounding.
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
    allocateMap(this->texture_, { GL_RGBA32F, GL_RGBA, 4 }, this->side_, 1);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, this->side_, this->side_, 1, GL_RGBA, GL_FLOAT,
      this->slabs_.data());
  }

  int side_;
  std::vector<glm::vec4> slabs_;
  GlTexture texture_;
};

//------------------------------------------------------------------------------
TEST_F(MonteCarloGlsl, boundsAreExtremaOfTheirTexels)
{
  for (const int side : { 64, 100, 1024 })
  {
    SlabMap map(side, 12, this->random_);
    SlabBounds mips;
    mips.build(map.texture(), 1, side, 1, SlabHierarchy::Mips, this->library_);
    SlabBounds nBuffer;
    nBuffer.build(map.texture(), 1, side, 1, SlabHierarchy::NBuffer, this->library_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const int whole = 1 << nBuffer.topLevel();
    EXPECT_EQ(whole, side == 100 ? 128 : side);
    ASSERT_EQ(mips.topLevel(), nBuffer.topLevel());
    const std::size_t layer = static_cast<std::size_t>(whole) * static_cast<std::size_t>(whole);
    std::vector<glm::vec4> layers(layer * static_cast<std::size_t>(nBuffer.topLevel() + 1));
    glBindTexture(GL_TEXTURE_2D_ARRAY, nBuffer.texture());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_FLOAT, layers.data());
    glBindTexture(GL_TEXTURE_2D_ARRAY, mips.texture());

    // Beyond the map there is no slab, which as one of many in the greatest begin counts.
    const glm::vec4 none(2.0f, -2.0f, 2.0f, -2.0f);
    const auto finest = [&](int x, int y) { return map.holds(x, y) ? map.bounds(x, y, 1) : none; };
    for (int level = 0; level <= nBuffer.topLevel(); ++level)
    {
      const int size = 1 << level;
      const int offset = level == 0 ? 0 : size / 2 - 1;
      const int cells = whole / size;
      std::vector<glm::vec4> ofMips(static_cast<std::size_t>(cells * cells));
      glGetTexImage(GL_TEXTURE_2D_ARRAY, level, GL_RGBA, GL_FLOAT, ofMips.data());
      /// Over the texels of a window, as far as they are on the whole.
      const auto expected = [&](int left, int lower)
      {
        glm::vec4 bounds(2.0f, -2.0f, -10.0f, 10.0f);
        for (int y = std::max(lower, 0); y < std::min(lower + size, whole); ++y)
        {
          for (int x = std::max(left, 0); x < std::min(left + size, whole); ++x)
          {
            const glm::vec4 texel = finest(x, y);
            bounds = { std::min(bounds.x, texel.x), std::max(bounds.y, texel.y),
              std::max(bounds.z, texel.z), std::min(bounds.w, texel.w) };
          }
        }
        return bounds;
      };
      const int trials = std::clamp(10000000 / (size * size), 10, 2000);
      for (int i = 0; i < trials; ++i)
      {
        // The corners, too.
        const auto place = [&](int end)
        {
          return i % 5 == 0 ? (this->random_() % 2 ? end - 1 : 0)
                            : static_cast<int>(this->random_() % static_cast<unsigned>(end));
        };
        const int x = place(whole);
        const int y = place(whole);
        ASSERT_EQ(
          layers[layer * static_cast<std::size_t>(level) + static_cast<std::size_t>(y * whole + x)],
          expected(x - offset, y - offset))
          << "N-buffer of " << side << ", level " << level << " at " << x << ", " << y;
        const int column = place(cells);
        const int row = place(cells);
        ASSERT_EQ(ofMips[static_cast<std::size_t>(row * cells + column)],
          expected(column * size, row * size))
          << "mips of " << side << ", level " << level << " at " << column << ", " << row;
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Lines of any length from behind to before all slabs.
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

/// Which lines meet a slab.
std::vector<bool> walksOf(SlabMap& map, const std::vector<RayLine>& lines)
{
  std::vector<bool> met;
  for (const RayLine& line : lines)
  {
    met.push_back(map.meets(glm::vec3(line.begin), glm::vec3(line.end)));
  }
  return met;
}

/// What a search finds: x, whether there is a slab; y, how many cells it looked at (hierarchical
/// ones tell).
std::vector<glm::uvec2> search(ShaderLibrary& library, GLuint slabs, int side,
  const SlabBounds& bounds, const std::vector<RayLine>& lines,
  const std::vector<std::string>& defines,
  const std::vector<std::pair<std::string, std::string>>& replacements = {})
{
  const bool isLinear = std::find(defines.begin(), defines.end(), "LINEAR_SEARCH") != defines.end();
  std::string source = computeGlsl("slab_search.glsl", "mat2x4", "uvec2",
    std::string(
      "float where;\nbool meets = meetsSlabs(0, given[i][0].xyz, given[i][1].xyz, where);\n") +
      "result[i] = uvec2(meets, " + (isLinear ? "0" : "cellsVisited") + ");\n");
  for (const auto& [from, to] : replacements)
  {
    replaceOnce(source, from, to);
  }
  return runCompute<glm::uvec2>(library, source, lines, defines,
    { { "slabs", TextureBinding{ GL_TEXTURE_2D_ARRAY, slabs } },
      { "slabBounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, bounds.texture() } },
      { "mapSide", side }, { "topLevel", bounds.topLevel() } });
}

/// How many cells searches looked at.
struct Visits
{
  double mean = 0.0;
  unsigned int most = 0;
};
Visits visitsOf(const std::vector<glm::uvec2>& found)
{
  Visits visits;
  for (const glm::uvec2& each : found)
  {
    visits.mean += static_cast<double>(each.y) / static_cast<double>(found.size());
    visits.most = std::max(visits.most, each.y);
  }
  return visits;
}

TEST_F(MonteCarloGlsl, searchesAsAWalkFromTexelToTexel)
{
  for (const int boxes : { 6, 60 })
  {
    SlabMap map(128, boxes, this->random_);
    const std::vector<RayLine> lines = randomLines(map.side(), 500000, this->random_);
    const std::vector<bool> truth = walksOf(map, lines);
    const auto hits = static_cast<std::size_t>(std::count(truth.begin(), truth.end(), true));
    EXPECT_GT(hits, lines.size() / 50);
    EXPECT_LT(hits, lines.size() * 49 / 50);
    for (const char* kind : { "MIPS", "NBUFFER" })
    {
      SlabBounds bounds;
      bounds.build(map.texture(), 1, map.side(), 1,
        kind == std::string("MIPS") ? SlabHierarchy::Mips : SlabHierarchy::NBuffer, this->library_);
      const auto found =
        search(this->library_, map.texture(), map.side(), bounds, lines, { kind, "PAGES 1" });
      std::size_t differing = 0;
      for (std::size_t i = 0; i < lines.size(); ++i)
      {
        if ((found[i].x == 1u) != truth[i])
        {
          ++differing;
          EXPECT_FALSE(map.isDecided(lines[i])) << i;
        }
      }
      EXPECT_LE(differing, lines.size() / 10000) << kind << ", " << boxes << " boxes";
      RecordProperty(
        std::string("differing_") + kind + "_" + std::to_string(boxes), std::to_string(differing));
      // Sixty boxes, each as wide as a sixth of the map on the mean, are a maze.
      const Visits visits = visitsOf(found);
      EXPECT_LT(visits.mean, boxes == 6 ? 4.0 : 16.0) << kind << ", " << boxes << " boxes";
      EXPECT_LT(visits.most, (64u + 8u * 128u) / 4u) << "far from where it gives up";
      RecordProperty(std::string("visits_") + kind + "_" + std::to_string(boxes),
        std::to_string(visits.mean) + ", at most " + std::to_string(visits.most));
    }
  }
}

//------------------------------------------------------------------------------
/// Rays that begin inside of what is solid need no test of their own: the search sees it in the
/// first texel.
TEST_F(MonteCarloGlsl, searchesThatBeginInsideASlabEndThere)
{
  SlabMap map(128, 60, this->random_);
  std::vector<RayLine> lines = randomLines(map.side(), 50000, this->random_);
  for (RayLine& line : lines)
  {
    const glm::vec4 texel = map.at(static_cast<int>(line.begin.x), static_cast<int>(line.begin.y));
    line.begin.z = 0.5f * (texel.x + texel.y); // of an empty one 0, before all slabs
  }
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                [](const RayLine& line) { return line.begin.z == 0.0f; }),
    lines.end());
  ASSERT_GT(lines.size(), 10000u);
  for (const char* kind : { "MIPS", "NBUFFER" })
  {
    SlabBounds bounds;
    bounds.build(map.texture(), 1, map.side(), 1,
      kind == std::string("MIPS") ? SlabHierarchy::Mips : SlabHierarchy::NBuffer, this->library_);
    const auto found =
      search(this->library_, map.texture(), map.side(), bounds, lines, { kind, "PAGES 1" });
    for (const glm::uvec2& each : found)
    {
      ASSERT_EQ(each.x, 1u) << kind;
      ASSERT_LE(each.y, static_cast<unsigned int>(bounds.topLevel()) + 1u) << "it only descends";
    }
  }
}

//------------------------------------------------------------------------------
/// From what a camera sees of casters to points of a lamp, through the layers that they have.
TEST_F(MonteCarloGlsl, searchesInScenesLookAtFewCells)
{
  const std::vector<Prop> props = { { makePlane(12.0) },
    { makeBox({ -1.2, -1.0, 0.0 }, { 0.2, 0.3, 1.6 }) },
    { makeSphere(24, 32), at({ 1.2, 0.8, 1.3 }, 0.8) },
    { makeTriangleSoup(300, 5), at({ -2.5, 1.0, 1.0 }) } };
  const Occluders occluders = makeOccluders(props);
  Camera camera;
  camera.position = { 4.0, -9.0, 6.0 };
  camera.width = camera.height = 128;
  const ReceiverPixels receivers = makeReceivers(occluders, camera);
  ShadowLight light = spotLight({ -2.0, -2.5, 7.0 }, { 0.0, 0.0, 0.0 }, 40.0);
  light.area = diskArea(light.directionWorld, 0.5);
  light.mapSizeTexels = 512;
  LightViews views =
    fitLightViews(lightOfMap(light), occluders.centreWorld, occluders.castersCentred, 512);
  LightView& view = views.views.at(0);
  view.beginsAt = std::max(view.beginsAt, nearestOfArea(light));
  OccluderBuffers buffers;
  buffers.update(occluders);
  DepthLayers layers;
  {
    const GlStateGuard guard;
    layers.draw({ light, views, occluders, buffers, this->library_ }, view.beginsAt);
  }

  const glm::dmat4 rayFromCentred = gnomon::rayFromCentred(view, 512, view.beginsAt);
  const auto inRaySpace = [&](const glm::dvec3& centred)
  {
    const glm::dvec4 place = rayFromCentred * glm::dvec4(centred, 1.0);
    return glm::vec4(glm::dvec3(place) / place.w, 0.0);
  };
  const glm::dvec3 lamp = light.positionWorld - occluders.centreWorld;
  std::vector<RayLine> lines;
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const glm::dvec3 normal(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);
    const glm::dvec3 position =
      glm::dvec3(receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i]);
    const glm::dvec2 across(2.0 * this->uniform() - 1.0, 2.0 * this->uniform() - 1.0);
    const glm::dvec3 point = lamp + light.area->worldFromUnit * glm::dvec3(across, 0.0);
    if (receivers.surface[i] == ReceiverPixels::notCovered ||
      glm::dot(normal, point - position) <= 0.0)
    {
      continue;
    }
    // About two texels before the receiver, and as far as there are casters.
    const RayLine line{ inRaySpace(position + 0.05 * normal), inRaySpace(point) };
    const float first = -1.0f;
    const float share = std::min((first - line.begin.z) / (line.end.z - line.begin.z), 1.0f);
    const RayLine cut{ line.begin, glm::mix(line.begin, line.end, share) };
    const auto isOnMap = [](const glm::vec4& at)
    { return at.x >= 0.0f && at.y >= 0.0f && at.x < 512.0f && at.y < 512.0f; };
    if (isOnMap(cut.begin) && isOnMap(cut.end))
    {
      lines.push_back(cut);
    }
  }
  ASSERT_GT(lines.size(), 5000u);
  for (const char* kind : { "MIPS", "NBUFFER" })
  {
    SlabBounds bounds;
    bounds.build(layers.slabs(), layers.pages(), 512, 1,
      kind == std::string("MIPS") ? SlabHierarchy::Mips : SlabHierarchy::NBuffer, this->library_);
    const auto found =
      search(this->library_, layers.slabs(), 512, bounds, lines, { kind, "PAGES 2" });
    const Visits visits = visitsOf(found);
    EXPECT_LT(visits.mean, 8.0) << kind;
    EXPECT_LT(visits.most, 64u + 4u * 9u) << kind;
    RecordProperty(std::string("visits_") + kind,
      std::to_string(visits.mean) + ", at most " + std::to_string(visits.most));
  }
}

//------------------------------------------------------------------------------
/// Boxes between depths of 5 and 20 under an eye, as a map with two layers has them, and rays from
/// the ground at 20 to a light at 1 that fills the map's frustum there: the geometry of the rates
/// that the linear search was specified with.
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

  /// The first and the last depth along the eye's ray through a texel's centre, in ray space.
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

  /// Cut where there are no casters, as `montecarlo` cuts its rays.
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

/// Rates are means over maps, since those of single ones lie between none and thrice as much. Boxes
/// have sides that give the share of rays that meet something, 17.2 and 3.8 %, with which the rates
/// were specified.
TEST_F(MonteCarloGlsl, linearSearchNeverHitsWhatIsNotThereAndMissesLittle)
{
  struct Rate
  {
    int steps;
    double specified; ///< the share of all rays that are missed
    double misses = 0.0;
  };
  struct Case
  {
    int boxes;
    double least; ///< of a box's sides, and so on
    double greatest;
    double hits; ///< specified, too
    std::vector<Rate> rates;
  };
  Case cases[] = { { 6, 1.0, 2.8, 0.172, { { 8, 0.0015 }, { 32, 0.0004 } } },
    { 60, 0.1, 0.37, 0.038, { { 8, 0.009 }, { 16, 0.004 }, { 32, 0.0014 } } } };
  constexpr int maps = 10;
  constexpr std::size_t raysOfMap = 20000;
  for (Case& each : cases)
  {
    double hits = 0.0;
    for (int i = 0; i < maps; ++i)
    {
      const BoxesUnderALight scene(each.boxes, each.least, each.greatest, this->random_);
      SlabMap map(
        BoxesUnderALight::side, [&](const glm::ivec2& texel) { return scene.slabAt(texel); });
      const std::vector<RayLine> rays = BoxesUnderALight::rays(raysOfMap, this->random_);
      const std::vector<bool> truth = walksOf(map, rays);
      hits +=
        static_cast<double>(std::count(truth.begin(), truth.end(), true)) / (maps * raysOfMap);
      const auto misses = [&](std::vector<std::pair<std::string, std::string>> changes)
      {
        const auto found = search(this->library_, map.texture(), map.side(), SlabBounds(), rays,
          { "LINEAR_SEARCH", "PAGES 1" }, changes);
        double missed = 0.0;
        for (std::size_t ray = 0; ray < rays.size(); ++ray)
        {
          const bool hit = found[ray].x == 1u;
          missed += truth[ray] && !hit ? 1.0 / (maps * raysOfMap) : 0.0;
          EXPECT_TRUE(truth[ray] || !hit || !map.isDecided(rays[ray]))
            << "a hit where there is nothing: " << each.boxes << " boxes, ray " << ray;
        }
        return missed;
      };
      for (Rate& rate : each.rates)
      {
        const std::pair<std::string, std::string> steps(
          "#define STEPS 32", "#define STEPS " + std::to_string(rate.steps));
        rate.misses += misses({ steps });
      }
    }
    EXPECT_NEAR(hits, each.hits, 0.1 * each.hits) << each.boxes << " boxes";
    for (const Rate& rate : each.rates)
    {
      const std::string name = std::to_string(each.boxes) + "_" + std::to_string(rate.steps);
      EXPECT_LE(rate.misses, 1.5 * rate.specified) << name;
      RecordProperty("misses_" + name, std::to_string(rate.misses));
    }
    RecordProperty("hits_" + std::to_string(each.boxes), std::to_string(hits));
  }
}

//------------------------------------------------------------------------------
/// Pixels of surfaces across the view, for the filter.
struct FilteredPicture
{
  static constexpr int side = 32;
  std::vector<glm::vec4> fragments; ///< as ReceiverTarget has them
  std::vector<glm::vec4> points;
  std::vector<glm::vec4> visibility; ///< x, and y: the class
  std::vector<glm::vec4> slopes;     ///< xyz: what rays know of its gradient: nothing

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
  /// Both passes of visibility_filter.frag.glsl, for 3 x 3 rays and 5 pixels. Pixels are of side 1.
  std::vector<float> filtered(ShaderLibrary& library) const
  {
    GlTexture textures[7];
    const auto allocated = [&](GlTexture& texture, const std::vector<glm::vec4>* texels)
    {
      allocateTexture(texture, { GL_RGBA32F, GL_RGBA, 4 }, side, side, 0, "a test's picture");
      if (texels)
      {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_FLOAT, texels->data());
      }
      return TextureBinding{ GL_TEXTURE_2D, texture.name() };
    };
    const TextureBinding receivers = allocated(textures[0], &this->fragments);
    const TextureBinding places = allocated(textures[1], &this->points);
    const TextureBinding unfiltered = allocated(textures[2], &this->visibility);
    const TextureBinding rows = allocated(textures[3], nullptr);
    const TextureBinding result = allocated(textures[4], nullptr);
    const TextureBinding ofPixels = allocated(textures[5], &this->slopes);
    const TextureBinding ofRows = allocated(textures[6], nullptr);
    const GLuint program = ScreenPass::use(library,
      ShaderLibrary::source("shadowtech/montecarlo/visibility_filter.frag.glsl"),
      { "FILTER_PIXELS 5", "RAYS 3" });
    ScreenPass pass;
    const auto use =
      [&](const TextureBinding& source, const TextureBinding& slopesOfIt, const glm::ivec2& axis)
    {
      ShaderLibrary::setUniforms(program,
        { { "receiverFragments", receivers }, { "receiverPoints", places },
          { "unfiltered", unfiltered }, { "source", source }, { "slopes", slopesOfIt },
          { "axis", axis }, { "pixelSide", glm::vec2(1.0f, 0.0f) }, { "lit", 1.0f } },
        0, 0);
    };
    use(unfiltered, ofPixels, { 1, 0 });
    pass.fill({ { rows.texture }, { ofRows.texture } }, side, side);
    use(rows, ofRows, { 0, 1 });
    pass.fill({ { result.texture } }, side, side);
    std::vector<glm::vec4> texels(this->visibility.size());
    glBindTexture(GL_TEXTURE_2D, result.texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, texels.data());
    std::vector<float> values;
    for (const glm::vec4& texel : texels)
    {
      values.push_back(texel.x);
    }
    return values;
  }
};

TEST_F(MonteCarloGlsl, filterSmoothsNoiseOfOneSurface)
{
  constexpr int side = FilteredPicture::side;
  FilteredPicture noisy;
  for (glm::vec4& pixel : noisy.visibility)
  {
    pixel.x = 0.4f + 0.2f * this->uniform(); // an RMS of 0.058
  }
  double squares = 0.0;
  for (const float v : noisy.filtered(this->library_))
  {
    squares += (v - 0.5) * (v - 0.5) / (side * side);
  }
  EXPECT_LT(std::sqrt(squares), 0.015);

  FilteredPicture even;
  for (glm::vec4& pixel : even.visibility)
  {
    pixel.x = 0.7f;
  }
  for (const float v : even.filtered(this->library_))
  {
    EXPECT_NEAR(v, 0.7f, 1e-6f);
  }
}

TEST_F(MonteCarloGlsl, filterKeepsEdgesOfSurfacesAndOfShadows)
{
  constexpr int side = FilteredPicture::side;
  const auto half = [](int i) { return i % side < side / 2; };
  const auto expectKept =
    [&](FilteredPicture& picture, float left, float right, float tolerance, const char* what)
  {
    for (int i = 0; i < side * side; ++i)
    {
      picture.visibility[static_cast<std::size_t>(i)].x = half(i) ? left : right;
    }
    const std::vector<float> filtered = picture.filtered(this->library_);
    for (int i = 0; i < side * side; ++i)
    {
      ASSERT_NEAR(filtered[static_cast<std::size_t>(i)], half(i) ? left : right, tolerance)
        << what << " at " << i;
    }
  };
  FilteredPicture gap;
  for (int i = 0; i < side * side; ++i)
  {
    gap.points[static_cast<std::size_t>(i)].z = half(i) ? -10.0f : -110.0f;
  }
  expectKept(gap, 0.4f, 0.6f, 0.002f, "a gap in depth of 100 pixels: 1 % of the step");

  FilteredPicture crease;
  for (int i = 0; i < side * side; ++i)
  {
    // To the right a surface that stands along the view: its normal is x.
    crease.fragments[static_cast<std::size_t>(i)].z = half(i) ? 0.0f : 1.0f;
    crease.points[static_cast<std::size_t>(i)].w = half(i) ? 1.0f : 0.0f;
  }
  expectKept(crease, 0.4f, 0.6f, 1e-6f, "a crease");

  FilteredPicture edge;
  expectKept(edge, 0.0f, 1.0f, 0.001f, "a sharp shadow");

  FilteredPicture decided;
  for (glm::vec4& pixel : decided.visibility)
  {
    pixel.y = 2.0f; // by bounds
  }
  expectKept(decided, 0.4f, 0.6f, 0.0f, "what no ray has decided, bit for bit");

  FilteredPicture away;
  for (int i = 0; i < side * side; ++i)
  {
    away.visibility[static_cast<std::size_t>(i)].y = half(i) ? 1.0f : 5.0f;
  }
  expectKept(away, 0.4f, 0.6f, 1e-6f, "what is turned away gives nothing to others");
}

/// Where all rays agree there is little noise: narrow penumbrae do not spread over what is lit and
/// what is dark.
TEST_F(MonteCarloGlsl, filterKeepsNarrowPenumbrae)
{
  constexpr int side = FilteredPicture::side;
  constexpr int width = 4; // pixels, of a filter of 11
  FilteredPicture ramp;
  for (int i = 0; i < side * side; ++i)
  {
    const float across = (static_cast<float>(i % side - side / 2) + 0.5f) / width;
    ramp.visibility[static_cast<std::size_t>(i)].x = std::clamp(across, 0.0f, 1.0f);
  }
  const std::vector<float> filtered = ramp.filtered(this->library_);
  for (std::size_t i = 0; i < filtered.size(); ++i)
  {
    ASSERT_NEAR(filtered[i], ramp.visibility[i].x, 0.025f) << i;
  }
}

/// A penumbra stays as wide as it is, and along it noise is taken off.
TEST_F(MonteCarloGlsl, filterGoesAlongPenumbraeWhoseSlopeRaysTell)
{
  constexpr int side = FilteredPicture::side;
  constexpr float width = 12.0f; // pixels, of a filter of 11
  const auto acrossAt = [](std::size_t pixel)
  { return (static_cast<float>(static_cast<int>(pixel) % side - side / 2) + 0.5f) / width; };
  FilteredPicture ramp;
  FilteredPicture noisy;
  for (std::size_t i = 0; i < ramp.visibility.size(); ++i)
  {
    const float across = acrossAt(i);
    ramp.visibility[i].x = std::clamp(0.5f + across, 0.0f, 1.0f);
    ramp.slopes[i].x = std::abs(across) < 0.5f ? 1.0f / width : 0.0f;
    noisy.visibility[i].x =
      std::clamp(0.5f + across + 0.2f * (this->uniform() - 0.5f), 0.0f, 1.0f); // an RMS of 0.058
  }
  noisy.slopes = ramp.slopes;
  /// Over pixels this near to the middle of the penumbra.
  const auto rmsError = [&](const FilteredPicture& picture, float nearest)
  {
    const std::vector<float> filtered = picture.filtered(this->library_);
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < filtered.size(); ++i)
    {
      const double off = filtered[i] - ramp.visibility[i].x;
      const bool counts = std::abs(acrossAt(i)) < nearest;
      squares += counts ? off * off : 0.0;
      count += counts ? 1.0 : 0.0;
    }
    return std::sqrt(squares / count);
  };
  EXPECT_LT(rmsError(ramp, 1.0f), 0.007);
  EXPECT_LT(rmsError(noisy, 0.3f), 0.017);
}

//------------------------------------------------------------------------------
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
  EXPECT_NEAR(distanceToProjectionPoint(lampOver(1.0, 30.0)), 1.7320508, 1e-6);
  EXPECT_EQ(distanceToProjectionPoint(lampOver(0.0, 30.0)), 0.0);
  ShadowLight light = lampOver(1.0, 30.0);
  light.area = ballArea(1.0);
  EXPECT_NEAR(distanceToProjectionPoint(light), 2.0, 1e-12);
  EXPECT_NEAR(nearestOfArea(light), 1.0, 1e-12);
  light.area = rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, { 0.6, 0.8 });
  EXPECT_NEAR(distanceToProjectionPoint(light), 1.7320508, 1e-6);
  EXPECT_EQ(lightOfMap(light).positionWorld.z, 10.0 + distanceToProjectionPoint(light));

  // Lines between points of the cone and of the light stay in the cone from there.
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
  Bounds casters;
  casters.add({ -3.0, -2.0, -1.0 });
  casters.add({ 2.0, 4.0, 5.0 });
  ShadowLight sun;
  sun.directionWorld = glm::normalize(glm::dvec3(0.2, -0.3, -1.0));
  for (const ShadowLight& light : { lampOver(1.0, 40.0), sun })
  {
    const LightViews views = fitLightViews(lightOfMap(light), glm::dvec3(0.0), casters, 256);
    ASSERT_EQ(views.views.size(), 1u);
    const double nearest = 2.0;
    const glm::dmat4 matrix = rayFromCentred(views.views[0], 256, nearest);
    const auto at = [&](const glm::dvec3& point)
    {
      const glm::dvec4 image = matrix * glm::dvec4(point, 1.0);
      EXPECT_GT(image.w, 0.0);
      return glm::dvec3(image) / image.w;
    };
    const glm::dvec3 a = at({ -1.0, 1.0, 0.0 });
    const glm::dvec3 b = at({ 1.5, 3.0, 4.0 });
    EXPECT_GT(a.z, b.z) << "farther from the light";
    const glm::dvec3 between = at(glm::mix(glm::dvec3(-1.0, 1.0, 0.0), { 1.5, 3.0, 4.0 }, 0.3));
    const double share = (between.z - a.z) / (b.z - a.z);
    EXPECT_LT(glm::length(between - glm::mix(a, b, share)), 1e-10);
    // Where the map has it.
    const LightView& view = views.views[0];
    const glm::dvec3 inView(view.rays.viewFromCentred * glm::dvec4(-1.0, 1.0, 0.0, 1.0));
    const glm::dvec2 texel = mapped(texelFromAcross(view, 256), view.rays.across(inView));
    EXPECT_LT(glm::distance(glm::dvec2(a), texel), 1e-9);
    EXPECT_NEAR(a.z,
      view.rays.positional ? -nearest / inView.z : inView.z * view.depthScale + view.depthOffset,
      1e-12);
  }
}

} // namespace
} // namespace gnomon::test
