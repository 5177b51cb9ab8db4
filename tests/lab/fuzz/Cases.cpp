#include "Cases.h"

#include "VtkMessages.h"

namespace gnomon::fuzz
{

//------------------------------------------------------------------------------
const std::vector<CaseKind>& caseKinds()
{
  static const std::vector<CaseKind> kinds = {
    { "scenes", "scenes, lights, cameras and settings, against rays and VTK alone", runScene },
    { "sequences", "changes of scenes, against a fresh pass in a fresh window", runSequence },
    { "files", "broken scene files, models and images, which `gnomon render` draws or refuses",
      runFile }
  };
  return kinds;
}

//------------------------------------------------------------------------------
std::string whatIsWrong(const CaseKind& kind, const Place& place)
{
  std::seed_seq seeds{ place.seed, place.index };
  std::string description;
  const tool::VtkMessages messages;
  try
  {
    kind.run(Random(seeds), description);
    if (messages.errors().empty() && messages.warnings().empty())
    {
      return "";
    }
    const auto& texts = messages.errors().empty() ? messages.warnings() : messages.errors();
    return "VTK says: " + texts.front() + "\n" + description;
  }
  catch (const std::exception& error)
  {
    return std::string(error.what()) + "\n" + description;
  }
}

} // namespace gnomon::fuzz
