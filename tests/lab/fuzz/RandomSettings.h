#pragma once

#include "RandomScenes.h"

#include "lights/SettingsTable.h"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::fuzz
{

using test::Random;

/// True with that probability.
inline bool chance(Random& random, double probability)
{
  return test::uniform(random, 0.0, 1.0) < probability;
}

template <typename Element>
const Element& pick(const std::vector<Element>& elements, Random& random)
{
  return elements.at(random() % elements.size());
}

/// Names and values, in the order in which they are set.
using NamedSettings = std::vector<std::pair<std::string, std::string>>;

/// Draw a technique and values for some of its settings. A few belong to other techniques or
/// contradict each other: errors that the frame's report states.
NamedSettings drawSettings(Random& random);

/// Draw one setting of a technique, with its value.
std::pair<std::string, std::string> drawSetting(const std::string& technique, Random& random);

/// "technique=nsm map_size=64"
std::string textOf(const NamedSettings& settings);

} // namespace gnomon::fuzz
