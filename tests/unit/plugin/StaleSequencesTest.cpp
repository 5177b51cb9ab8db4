// Nothing stale is ever shown: after any sequence of changes a pass that has drawn all of them
// shows what a new pass shows, to the last bit.
//
// The first sequences run with every test. More of them on demand, by the environment variables
// GNOMON_SEQUENCES (how many) and GNOMON_FIRST_SEQUENCE (where to begin).

#include "ChangedScene.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>
#include <string>

using namespace gnomon::test;

namespace
{

constexpr int changesOfSequence = 20;

int numberFrom(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

/// "visibility of light 1: 3 values differ", one line for each image that differs; empty if none.
std::string differences(const gnomon::VisibilityImages& a, const gnomon::VisibilityImages& b)
{
  if (a.width != b.width || a.height != b.height || a.sceneIndices != b.sceneIndices)
  {
    return "other lights or another size\n";
  }
  std::string text;
  const auto compare = [&text](const std::string& name, const auto& ofA, const auto& ofB)
  {
    std::size_t count = ofA.size() == ofB.size() ? 0 : std::max(ofA.size(), ofB.size());
    for (std::size_t i = 0; i < std::min(ofA.size(), ofB.size()); ++i)
    {
      count += ofA[i] == ofB[i] ? 0 : 1;
    }
    text += count ? name + ": " + std::to_string(count) + " values differ\n" : "";
  };
  for (std::size_t i = 0; i < a.visibility.size(); ++i)
  {
    compare(
      "visibility of light " + std::to_string(a.sceneIndices[i]), a.visibility[i], b.visibility[i]);
  }
  compare("coverage", a.coverage, b.coverage);
  compare("position, x", a.positionX, b.positionX);
  compare("position, y", a.positionY, b.positionY);
  compare("position, z", a.positionZ, b.positionZ);
  compare("normal, x", a.normalX, b.normalX);
  compare("normal, y", a.normalY, b.normalY);
  compare("normal, z", a.normalZ, b.normalZ);
  return text;
}

class StaleSequences
  : public PassTest
  , public testing::WithParamInterface<int>
{
};

INSTANTIATE_TEST_SUITE_P(Seeds, StaleSequences,
  testing::Range(numberFrom("GNOMON_FIRST_SEQUENCE", 1),
    numberFrom("GNOMON_FIRST_SEQUENCE", 1) + numberFrom("GNOMON_SEQUENCES", 12)));

} // namespace

//------------------------------------------------------------------------------
TEST_P(StaleSequences, showWhatANewPassShows)
{
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  ChangedScene longLived;
  ChangedScene renewed;
  // Every other sequence takes the inline route where its techniques can.
  const bool keeps = GetParam() % 2 != 0;
  longLived.keepVisibility(keeps);
  renewed.keepVisibility(keeps);
  std::string history;
  for (int number = 0; number < changesOfSequence; ++number)
  {
    const Change change = drawChange(random);
    history += "\n  " + testing::PrintToString(change);
    longLived.apply(change);
    renewed.apply(change);
    renewed.renewPass();
    const Picture kept = longLived.renderAll();
    const Picture fresh = renewed.renderAll();
    const std::string where =
      std::string("technique ") + longLived.pass()->GetTechnique() + " after" + history;
    ASSERT_EQ(differences(longLived.pass()->GetVisibility(), renewed.pass()->GetVisibility()), "")
      << where;
    ASSERT_EQ(differingPixels(kept, fresh), 0u) << where;
  }
  // What a technique does not have, or cannot do together, is an error.
  std::istringstream errors(this->takeErrors());
  for (std::string error; std::getline(errors, error);)
  {
    EXPECT_THAT(
      error, testing::AnyOf(testing::HasSubstr("' is for: "), testing::HasSubstr("; it takes ")))
      << history;
  }
}
