#include "RandomSettings.h"

#include "shadowtech/Registry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

namespace gnomon::fuzz
{
namespace
{

/// Cost is proportional to most numbers: counts of rays, maps, texels.
int largestDrawn(const IntegerSetting& values)
{
  return std::min(values.largest, std::max(64, 16 * values.smallest));
}

std::string drawInteger(const IntegerSetting& values, Random& random)
{
  if (values.largest == std::numeric_limits<int>::max() && chance(random, 0.2))
  {
    return std::to_string(values.largest); // a seed, which counts nothing
  }
  const double smallest = std::log(values.smallest + 1.0);
  const double largest = std::log(largestDrawn(values) + 1.0);
  return std::to_string(std::max(values.smallest,
    static_cast<int>(std::lround(std::exp(test::uniform(random, smallest, largest)))) - 1));
}

std::string drawReal(const RealSetting& values, Random& random)
{
  std::ostringstream text;
  text.precision(17);
  if (chance(random, 0.2))
  {
    text << (chance(random, 0.7) ? values.smallest : values.largest);
    return text.str();
  }
  const double decades = test::uniform(random, -6.0, chance(random, 0.1) ? 6.0 : 1.0);
  const double share =
    chance(random, 0.5) ? test::uniform(random, 0.0, 1.0) : std::pow(10.0, decades);
  text << std::clamp(share, values.smallest, values.largest);
  return text.str();
}

std::string drawValue(const Setting& setting, Random& random)
{
  if (const auto* integers = std::get_if<IntegerSetting>(&setting.values))
  {
    return drawInteger(*integers, random);
  }
  if (const auto* reals = std::get_if<RealSetting>(&setting.values))
  {
    return drawReal(*reals, random);
  }
  return pick(std::get<ChoiceSetting>(setting.values).names, random);
}

/// Return any technique, more often one that can be compared with rays.
const TechniqueEntry& drawTechnique(Random& random)
{
  static const std::vector<TechniqueEntry> exact = []
  {
    std::vector<TechniqueEntry> found;
    std::copy_if(registry().begin(), registry().end(), std::back_inserter(found),
      [](const TechniqueEntry& technique) { return technique.estimator->info.exact; });
    return found;
  }();
  return pick(chance(random, 0.3) ? exact : registry(), random);
}

/// Return the settings tables of a technique or estimator.
std::vector<const SettingsTable*> tablesOf(const TechniqueInfo& info)
{
  std::vector<const SettingsTable*> tables = info.settings;
  tables.push_back(&lightAreaSettings());
  return tables;
}

} // namespace

NamedSettings drawSettings(Random& random)
{
  const TechniqueEntry& technique = drawTechnique(random);
  NamedSettings settings{ { "technique", technique.name } };
  const EstimatorEntry* estimator = technique.estimator;
  if (chance(random, 0.1))
  {
    estimator = &pick(estimators(), random);
    settings.emplace_back("estimator", estimator->info.name);
  }
  for (const SettingsTable* table : tablesOf(estimator->info))
  {
    for (const Setting& setting : table->settings)
    {
      if (chance(random, setting.name == "map_size" ? 0.9 : 0.3))
      {
        settings.emplace_back(setting.name, drawValue(setting, random));
      }
    }
  }
  if (chance(random, 0.05))
  {
    const Setting& any = *pick(shadowSettings(), random);
    if (any.name != "technique")
    {
      settings.emplace_back(any.name, drawValue(any, random));
    }
  }
  return settings;
}

std::pair<std::string, std::string> drawSetting(const std::string& technique, Random& random)
{
  const SettingsTable& table = *pick(tablesOf(findTechnique(technique)->estimator->info), random);
  const Setting& setting = pick(table.settings, random);
  return { setting.name, drawValue(setting, random) };
}

std::string textOf(const NamedSettings& settings)
{
  std::string text;
  for (const auto& [name, value] : settings)
  {
    text += (text.empty() ? "" : " ") + name + "=" + value;
  }
  return text;
}

} // namespace gnomon::fuzz
