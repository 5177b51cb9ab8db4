#include "lights/ShadowSettings.h"

#include "lights/Splits.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace gnomon
{
namespace
{

std::string listOf(const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

/// A choice among an enumeration's values, named in their order.
template <typename Choice, Choice ShadowSettings::*Member>
ChoiceSetting choice(std::vector<std::string> names)
{
  return { std::move(names),
    [](const ShadowSettings& settings) { return static_cast<int>(settings.*Member); },
    [](ShadowSettings& settings, int number) { settings.*Member = static_cast<Choice>(number); } };
}

/// A choice among numbers.
template <int ShadowSettings::*Member, int... Numbers>
ChoiceSetting oneOf(std::vector<std::string> names)
{
  return { std::move(names),
    [](const ShadowSettings& settings)
    {
      constexpr std::array<int, sizeof...(Numbers)> numbers{ { Numbers... } };
      const auto found = std::find(numbers.begin(), numbers.end(), settings.*Member);
      return static_cast<int>(found - numbers.begin());
    },
    [](ShadowSettings& settings, int choice)
    {
      constexpr std::array<int, sizeof...(Numbers)> numbers{ { Numbers... } };
      settings.*Member = numbers[static_cast<std::size_t>(choice)];
    } };
}

/// The whole text as a number; nothing where it is none.
template <typename Number>
std::optional<Number> parse(const std::string& text)
{
  Number number{};
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end ? std::optional<Number>(number)
                                                       : std::nullopt;
}

/// The shortest text that reads as that number.
std::string shortest(double number)
{
  std::array<char, 32> text{};
  const std::to_chars_result result = std::to_chars(text.data(), text.data() + text.size(), number);
  return { text.data(), result.ptr };
}

struct SetFromText
{
  ShadowSettings& settings;
  const std::string& text;

  bool operator()(const TextSetting& values) const
  {
    this->settings.*values.member = this->text;
    return true;
  }
  bool operator()(const IntegerSetting& values) const
  {
    const std::optional<int> number = parse<int>(this->text);
    if (!number || *number < values.smallest || *number > values.largest)
    {
      return false;
    }
    this->settings.*values.member = *number;
    return true;
  }
  bool operator()(const RealSetting& values) const
  {
    const std::optional<double> number = parse<double>(this->text);
    if (!number || !(*number >= values.smallest && *number <= values.largest))
    {
      return false; // also what is not a number
    }
    this->settings.*values.member = *number;
    return true;
  }
  bool operator()(const ChoiceSetting& values) const
  {
    const auto found = std::find(values.names.begin(), values.names.end(), this->text);
    if (found == values.names.end())
    {
      return false;
    }
    values.set(this->settings, static_cast<int>(found - values.names.begin()));
    return true;
  }
};

struct GetText
{
  const ShadowSettings& settings;

  std::string operator()(const TextSetting& values) const { return this->settings.*values.member; }
  std::string operator()(const IntegerSetting& values) const
  {
    return std::to_string(this->settings.*values.member);
  }
  std::string operator()(const RealSetting& values) const
  {
    return shortest(this->settings.*values.member);
  }
  std::string operator()(const ChoiceSetting& values) const
  {
    return values.names[static_cast<std::size_t>(values.get(this->settings))];
  }
};

struct Expected
{
  std::string operator()(const TextSetting&) const { return "a name"; }
  std::string operator()(const IntegerSetting& values) const
  {
    return "an integer in [" + std::to_string(values.smallest) + ", " +
      std::to_string(values.largest) + "]";
  }
  std::string operator()(const RealSetting& values) const
  {
    return "a number in [" + shortest(values.smallest) + ", " + shortest(values.largest) + "]";
  }
  std::string operator()(const ChoiceSetting& values) const
  {
    return "one of: " + listOf(values.names);
  }
};

} // namespace

//------------------------------------------------------------------------------
const std::vector<Setting>& shadowSettings()
{
  using S = ShadowSettings;
  static const std::vector<Setting> settings = {
    { "technique", "the shadow technique (see: gnomon techniques)", TextSetting{ &S::technique } },
    { "estimator", "what decides a point, in place of the technique's own estimator",
      TextSetting{ &S::estimator } },
    { "as_published",
      "pcss, crsm and crsma by the letter of their publications, which is not right",
      choice<bool, &S::asPublished>({ "off", "on" }) },
    { "projection", "how the light's view is laid onto its map",
      choice<Projection, &S::projection>(
        { "technique", "uniform", "lispsm", "tsm", "pssm", "cube" }) },
    { "fit",
      "what uniform views are fitted to: all casters, or what the camera sees, once or in every "
      "frame",
      choice<ViewFit, &S::fit>({ "off", "once", "frame" }) },
    { "snap", "whether fitted views move by whole texels",
      choice<bool, &S::snap>({ "off", "on" }) },
    { "splits", "the number of pssm's views", IntegerSetting{ &S::splits, 1, mostSplits } },
    { "split_lambda", "where pssm splits: 0 uniform, 1 logarithmic",
      RealSetting{ &S::splitLambda, 0.0, 1.0 } },
    { "split_blend", "the share of a split in which it is blended into the next",
      RealSetting{ &S::splitBlend, 0.0, 0.5 } },
    { "map_size", "the side of a light's map, in texels",
      IntegerSetting{ &S::mapSizeTexels, 16, 16384 } },
    { "kernel", "what techniques that filter (pcf) average over",
      choice<FilterKernel, &S::kernel>({ "bilinear", "box", "poisson", "castano" }) },
    { "kernel_size", "the kernel's width in texels", IntegerSetting{ &S::kernelTexels, 1, 32 } },
    { "bleeding", "of maps of moments (vsm, evsm, msm): up to what visibility points are dark",
      RealSetting{ &S::bleeding, 0.0, 0.99 } },
    { "variance_floor",
      "of vsm and evsm: the least variance of depths, as a share of the map's depth range, squared",
      RealSetting{ &S::varianceFloor, 1e-9, 1.0 } },
    { "map_samples",
      "of maps of moments: with how many samples of a texel they are drawn, which are averaged",
      oneOf<&S::mapSamples, 1, 2, 4, 8>({ "1", "2", "4", "8" }) },
    { "blur",
      "of maps of moments: averaged over the same box of texels everywhere, or over each point's "
      "own rectangle, by summed-area tables (not evsm)",
      choice<MapBlur, &S::blur>({ "box", "sat" }) },
    { "mip_maps",
      "of maps of moments with blur=box: whether pixels that see many texels read coarser levels",
      choice<bool, &S::mipMaps>({ "off", "on" }) },
    { "kernel_width",
      "the kernel's width across the light, in world units (from a position: at distance 1), over "
      "which as many taps are spread as kernel_size says; 0: kernel_size texels",
      RealSetting{ &S::kernelWidth, 0.0, 1e12 } },
    { "disc_grid", "adaptive: a disc's points are the square of this",
      IntegerSetting{ &S::discGrid, 2, 16 } },
    { "disc_sets", "adaptive: discs that differ are the square of this",
      IntegerSetting{ &S::discSets, 1, 32 } },
    { "early_out",
      "adaptive, pcss: what is asked before the whole disc, or all of the light, is read (pcss: "
      "not "
      "ring)",
      choice<EarlyOut, &S::earlyOut>({ "none", "ring", "exact" }) },
    { "pcss_samples",
      "pcss: points of the light to look for blockers with, and to filter with: 16 and 16, 36 and "
      "64, "
      "64 and 256",
      choice<PcssSamples, &S::pcssSamples>({ "low", "medium", "high" }) },
    { "adjacency_ring",
      "crsma: which triangles around one may cover a texel with it: across its edges, or all "
      "around "
      "its vertices, which decides more and takes longer",
      choice<AdjacencyRing, &S::adjacencyRing>({ "edges", "vertices" }) },
    { "bake",
      "exact techniques: when a stale map is drawn: once nothing has changed for long enough to be "
      "worth it, till when all is traced, and kept where it pays, or at once",
      choice<BakeTime, &S::bake>({ "settled", "always" }) },
    { "contour",
      "selective: how wide the contour between light and shadow is that it looks at, in pixels; or "
      "the whole image",
      oneOf<&S::contourPixels, 2, 4, 6, 0>({ "2", "4", "6", "image" }) },
    { "coherence",
      "coherence, selective: how many texels have to agree for the map to be believed; off: it is "
      "not",
      oneOf<&S::coherenceTexels, 0, 4, 9>({ "off", "4", "9" }) },
    { "neighbours", "selective: of how many texels the triangles are intersected",
      oneOf<&S::neighbourTexels, 0, 1, 4, 9>({ "off", "1", "4", "9" }) },
    { "adjacency",
      "selective: which neighbours of a pixel's own texel's triangle are intersected: those across "
      "its edges, or all around its vertices",
      choice<Adjacency, &S::adjacency>({ "off", "edges", "vertices" }) },
    { "leftovers",
      "selective: what becomes of what is still uncertain: traced, lit, or what most of nine "
      "texels "
      "say",
      choice<Leftovers, &S::leftovers>({ "trace", "lit", "majority" }) },
    { "outside",
      "selective: outside of the contour, whether the map is believed, or looked at more closely "
      "where nine texels do not agree",
      choice<OutsideContour, &S::outside>({ "map", "check" }) },
    { "planes", "planar: how many planes show shadows, at most: the largest",
      IntegerSetting{ &S::planes, 1, mostPlanes }, SettingSubject::Planes },
    { "light_radius",
      "soft shadows: makes the light a disc of that radius (a point light a ball) in world "
      "units, a directional one a disc that fills so many degrees; 0: as large as it says itself",
      RealSetting{ &S::lightRadius, 0.0, 1e12 }, SettingSubject::Light },
    { "light_samples", "soft shadows of area lights: from how many points of the light",
      IntegerSetting{ &S::lightSamples, 1, 65536 }, SettingSubject::LightSamples },
    { "light_seed", "soft shadows of area lights: which points these are",
      IntegerSetting{ &S::lightSeed, 0, 2147483647 }, SettingSubject::LightSeed },
    { "light_sampling",
      "soft shadows of area lights: evenly spread points, random ones in the cells of a grid "
      "(light_samples is a square then), or random ones",
      choice<LightSampling, &S::lightSampling>({ "sobol", "jittered", "random" }),
      SettingSubject::LightSamples },
    { "batch", "sampled: how many points of the light have their maps drawn and held at a time",
      IntegerSetting{ &S::batchSamples, 1, mostBatchSamples } },
    { "progressive",
      "sampled: how many points of the light each frame adds while nothing changes, after a first "
      "frame with hard shadows; 0: all are in every frame",
      IntegerSetting{ &S::progressiveSamples, 0, 65536 } },
    { "mc_rays",
      "montecarlo: rays of a pixel along either side of a grid on the light, so that 3 makes 9",
      IntegerSetting{ &S::mcRays, 1, 32 } },
    { "mc_layers",
      "montecarlo: what is solid in a texel: each of up to four casters, all between the first and "
      "the last surface, all behind the first, or (eye) between the first and the last what the "
      "camera does not see to be empty",
      choice<RayLayers, &S::mcLayers>({ "peeled", "near_far", "near", "eye" }) },
    { "mc_search",
      "montecarlo: how rays are searched: from cell to cell of a hierarchy, or in steps of equal "
      "length, which misses some",
      choice<RaySearch, &S::mcSearch>({ "hierarchical", "linear" }) },
    { "mc_classify",
      "montecarlo: what bounds over the map decide without a search: nothing, pixels, or pixels "
      "and "
      "then single rays",
      choice<RayClasses, &S::mcClassify>({ "off", "pixels", "rays" }) },
    { "mc_pyramid",
      "montecarlo: how the bounds over the map lie: on a grid, or around every texel, which takes "
      "ten times the memory",
      choice<SlabHierarchy, &S::mcPyramid>({ "mips", "nbuffer" }) },
    { "mc_filter",
      "montecarlo: radius of the filter in pixels that takes off the noise, on surfaces; 0: none",
      IntegerSetting{ &S::mcFilter, 0, 32 } },
    { "depth", "the surface on a ray that a map holds",
      choice<DepthSurface, &S::depth>({ "first", "second", "midpoint" }) },
    { "metric", "how a map measures: along the view's axis, or along the ray",
      choice<DepthMetric, &S::metric>({ "linear", "euclidean" }) },
    { "bias_constant", "how far a map is pushed back on top, in world units",
      RealSetting{ &S::biasConstant, 0.0, 1e12 } },
    { "bias_slope", "the same, times what a caster's depth spans within the filter's reach",
      RealSetting{ &S::biasSlope, 0.0, 1000.0 } },
  };
  return settings;
}

//------------------------------------------------------------------------------
const Setting* findSetting(const std::string& name)
{
  const std::vector<Setting>& settings = shadowSettings();
  const auto found = std::find_if(
    settings.begin(), settings.end(), [&](const Setting& setting) { return setting.name == name; });
  return found == settings.end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
std::string settingNames()
{
  std::vector<std::string> names;
  for (const Setting& setting : shadowSettings())
  {
    names.push_back(setting.name);
  }
  return listOf(names);
}

//------------------------------------------------------------------------------
bool Setting::set(ShadowSettings& settings, const std::string& text) const
{
  return std::visit(SetFromText{ settings, text }, this->values);
}

//------------------------------------------------------------------------------
std::string Setting::get(const ShadowSettings& settings) const
{
  return std::visit(GetText{ settings }, this->values);
}

//------------------------------------------------------------------------------
std::string Setting::expected() const
{
  return std::visit(Expected{}, this->values);
}

} // namespace gnomon
