#include "QuickTier.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fnmatch.h>

namespace gnomon::test
{
namespace
{

/// The most values of a parameterised test in the quick tier.
constexpr std::size_t quickValues = 1;

/// FNV-1a hash: the same on all machines.
std::size_t hashOf(const std::string& text)
{
  std::size_t hash = 2166136261u;
  for (const char letter : text)
  {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u & 0xffffffffu;
  }
  return hash;
}

bool matches(const std::string& name, const std::string& patterns)
{
  std::istringstream stream(patterns);
  for (std::string pattern; std::getline(stream, pattern, ':');)
  {
    if (fnmatch(pattern.c_str(), name.c_str(), 0) == 0)
    {
      return true;
    }
  }
  return false;
}

} // namespace

std::string filterOfTier(
  const std::string& tier, const std::string& slow, const std::string& filter)
{
  if (tier != "quick" && tier != "slow")
  {
    return filter;
  }
  // A parameterised test has one case per value.
  std::map<std::string, std::vector<std::string>> casesOfTest;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i)
  {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j)
    {
      const std::string name = suite.GetTestInfo(j)->name();
      const std::string test = std::string(suite.name()) + "." + name.substr(0, name.find('/'));
      casesOfTest[test].push_back(std::string(suite.name()) + "." + name);
    }
  }
  std::string result = filter;
  char before = filter.find('-') == std::string::npos ? '-' : ':';
  for (const auto& [test, cases] : casesOfTest)
  {
    const std::size_t first = hashOf(test) % cases.size();
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
      const bool isChosen = (i + cases.size() - first) % cases.size() < quickValues;
      const bool isQuick = isChosen && !matches(cases[i], slow);
      if (isQuick != (tier == "quick"))
      {
        result += before + cases[i];
        before = ':';
      }
    }
  }
  return result;
}

} // namespace gnomon::test
