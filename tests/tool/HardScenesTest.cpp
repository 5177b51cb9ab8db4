// Every numerical hard case has a scene or says where it is held.

#include "HardScenes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace gnomon::tool
{
namespace
{

/// The hard cases of the literature: apelles N1 to N29, crsm N1 to N15, and so on.
std::set<std::string> allCases()
{
  std::set<std::string> cases;
  const auto add = [&](const std::string& begin, int count)
  {
    for (int i = 1; i <= count; ++i)
    {
      cases.insert(begin + std::to_string(i));
    }
  };
  add("apelles N", 29);
  add("crsm N", 15);
  add("selective 5.1.", 7);
  add("selective 5.2.", 12);
  add("montecarlo 5.", 16);
  add("survey ", 18);
  for (const char part : std::string("abcdefgh"))
  {
    cases.insert(std::string("survey 7.12") + part);
  }
  return cases;
}

} // namespace

//------------------------------------------------------------------------------
TEST(HardScenes, allHaveASceneOrSayWhereTheyAreHeld)
{
  std::set<std::string> named;
  for (const HardScene& scene : hardScenes())
  {
    EXPECT_EQ(scene.scene.name.rfind("hard-", 0), 0u) << scene.scene.name;
    EXPECT_EQ(findBuiltinScene(scene.scene.name), &scene.scene);
    named.insert(scene.cases.begin(), scene.cases.end());
  }
  for (const HardCaseElsewhere& elsewhere : hardCasesElsewhere())
  {
    EXPECT_TRUE(named.insert(elsewhere.hardCase).second) << elsewhere.hardCase << " has a scene";
  }
  EXPECT_EQ(named, allCases());
}

} // namespace gnomon::tool
