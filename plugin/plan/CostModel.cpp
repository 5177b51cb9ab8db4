#include "plugin/plan/CostModel.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gnomon
{
namespace
{

constexpr double millisecondsOfNanoseconds = 1e-6;

/// Frames among which the triangles of a map that is reused are shared.
constexpr double framesOfMap = 30.0;

double costOfPlain(const FrameCounters& counters, const CostFactors& factors)
{
  return static_cast<double>(counters.drawn) * factors.drawTriangle +
    static_cast<double>(counters.pixels) * factors.drawPixel;
}

} // namespace

bool isSoftwareRenderer(const std::string& renderer)
{
  // The software renderers of Mesa, Google and Microsoft.
  const std::array<const char*, 7> names = { "llvmpipe", "softpipe", "SWR", "Software Rasterizer",
    "SwiftShader", "GDI Generic", "Microsoft Basic Render" };
  return std::any_of(names.begin(), names.end(),
    [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

CostFactors defaultFactors(bool software)
{
  CostFactors factors;
  factors.drawTriangle = software ? 40.0 : 0.9;
  factors.drawPixel = software ? 20.0 : 0.47;
  factors.askPixel = software ? 9.5 : 0.43;
  factors.bakeTriangle = software ? 54.0 : 1.2;
  factors.bakeTexel = software ? 7.0 : 0.13;
  factors.fetchPixel = software ? 4.6 : 0.43;
  factors.receiverTriangle = software ? 26.0 : 2.9;
  factors.receiverPixel = software ? 12.0 : 3.4;
  factors.tracePixel = software ? 15.0 : 6.5;
  factors.refitTriangle = software ? 20.0 : 37.0;
  return factors;
}

const std::array<NamedFactor, 10>& namedFactors()
{
  static const std::array<NamedFactor, 10> factors = { {
    { "draw_triangle", &CostFactors::drawTriangle },
    { "draw_pixel", &CostFactors::drawPixel },
    { "ask_pixel", &CostFactors::askPixel },
    { "bake_triangle", &CostFactors::bakeTriangle },
    { "bake_texel", &CostFactors::bakeTexel },
    { "fetch_pixel", &CostFactors::fetchPixel },
    { "receiver_triangle", &CostFactors::receiverTriangle },
    { "receiver_pixel", &CostFactors::receiverPixel },
    { "trace_pixel", &CostFactors::tracePixel },
    { "refit_triangle", &CostFactors::refitTriangle },
  } };
  return factors;
}

std::string textOf(const CostFactors& factors)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  for (const NamedFactor& factor : namedFactors())
  {
    text << factor.name << ' ' << factors.*factor.member << '\n';
  }
  return text.str();
}

CostFactors readFactors(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error(path + " cannot be read");
  }
  CostFactors factors{};
  std::set<std::string> read;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    if (line.empty() || line[0] == '#')
    {
      continue;
    }
    const auto refuse = [&](const std::string& why)
    { throw std::runtime_error(path + ", line " + std::to_string(number) + ": " + why); };
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string name;
    std::string rest;
    double value = -1.0;
    words >> name >> value;
    if (!words || words >> rest || !(value >= 0.0) || !std::isfinite(value))
    {
      refuse("found \"" + line + "\", expected a name and a number that is not negative");
    }
    bool isKnown = false;
    for (const NamedFactor& factor : namedFactors())
    {
      if (name == factor.name)
      {
        isKnown = true;
        factors.*factor.member = value;
      }
    }
    if (!isKnown || !read.insert(name).second)
    {
      refuse("found " + name + (isKnown ? " again" : ", which is no factor"));
    }
  }
  for (const NamedFactor& factor : namedFactors())
  {
    if (read.count(factor.name) == 0)
    {
      throw std::runtime_error(path + ": " + factor.name + " is missing");
    }
  }
  return factors;
}

double costByMaps(const FrameCounters& counters, const CostFactors& factors)
{
  const double asked = static_cast<double>(counters.pixels) * factors.askPixel;
  const double triangles = static_cast<double>(counters.triangles) * factors.bakeTriangle;
  const double texels = static_cast<double>(counters.texels) * factors.bakeTexel;
  return millisecondsOfNanoseconds *
    (costOfPlain(counters, factors) + static_cast<double>(counters.lights) * asked +
      static_cast<double>(counters.movedLights) * (triangles + texels) +
      static_cast<double>(counters.newMaps) * triangles / framesOfMap);
}

double costByRays(const FrameCounters& counters, const CostFactors& factors)
{
  const auto drawn = static_cast<double>(counters.drawn);
  const auto pixels = static_cast<double>(counters.pixels);
  double nanoseconds = costOfPlain(counters, factors) + pixels * factors.fetchPixel;
  if (counters.viewMoved)
  {
    nanoseconds += drawn * factors.receiverTriangle + pixels * factors.receiverPixel;
  }
  const double traced =
    counters.viewMoved ? counters.tracedLights : static_cast<double>(counters.movedLights);
  nanoseconds += pixels * traced * factors.tracePixel;
  nanoseconds += counters.castersMoved ? drawn * factors.refitTriangle : 0.0;
  return millisecondsOfNanoseconds * nanoseconds;
}

} // namespace gnomon
