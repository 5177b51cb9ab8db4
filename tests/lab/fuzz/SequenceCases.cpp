#include "Cases.h"
#include "FuzzScene.h"

#include <string>
#include <vector>

namespace gnomon::fuzz
{
namespace
{

/// @throws Find if two frames' visibility or receivers differ by a bit
void compare(const VisibilityImages& kept, const VisibilityImages& fresh)
{
  if (kept.width != fresh.width || kept.height != fresh.height ||
    kept.sceneIndices != fresh.sceneIndices || kept.origin != fresh.origin)
  {
    throw Find("other lights or another size than a fresh pass's");
  }
  std::string text;
  const auto compareImages = [&text](const std::string& name, const auto& a, const auto& b)
  {
    std::size_t count = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
      count += a[i] == b[i] ? 0 : 1;
    }
    text += count ? "; " + std::to_string(count) + " values of " + name : "";
  };
  for (std::size_t i = 0; i < kept.visibility.size(); ++i)
  {
    compareImages("the visibility of light " + std::to_string(kept.sceneIndices[i]),
      kept.visibility[i], fresh.visibility[i]);
  }
  compareImages("the coverage", kept.coverage, fresh.coverage);
  compareImages("positions' x", kept.positionX, fresh.positionX);
  compareImages("positions' y", kept.positionY, fresh.positionY);
  compareImages("positions' z", kept.positionZ, fresh.positionZ);
  compareImages("normals' x", kept.normalX, fresh.normalX);
  compareImages("normals' y", kept.normalY, fresh.normalY);
  compareImages("normals' z", kept.normalZ, fresh.normalZ);
  if (!text.empty())
  {
    throw Find("differ from a fresh pass's" + text);
  }
}

/// Compare a scene with an equal one whose pass is new.
void compare(FuzzScene& kept, FuzzScene& fresh)
{
  const test::Picture keptPicture = kept.render();
  const test::Picture freshPicture = fresh.render();
  compare(kept.pass()->GetVisibility(), fresh.pass()->GetVisibility());
  if (const std::size_t pixels = test::differingPixels(keptPicture, freshPicture))
  {
    throw Find(std::to_string(pixels) + " pixels differ from a fresh pass's");
  }
}

/// True if VTK alone, too, shows another picture after frames between the changes.
bool vtkRemembers(const Random& start, const std::vector<Change>& changes)
{
  FuzzScene kept(start, Purpose::Changes);
  FuzzScene fresh(start, Purpose::Changes);
  kept.removePass();
  fresh.removePass();
  kept.render();
  for (const Change& change : changes)
  {
    kept.apply(change);
    kept.removePass();
    kept.render();
    fresh.apply(change);
    fresh.removePass();
  }
  return test::differingPixels(kept.render(), fresh.render()) > 0;
}

} // namespace

//------------------------------------------------------------------------------
void runSequence(Random random, std::string& description)
{
  const Random start(random());
  FuzzScene kept(start, Purpose::Changes);
  FuzzScene renewed(start, Purpose::Changes);
  description = kept.description();
  compare(kept, renewed);
  std::vector<Change> changes;
  for (unsigned left = 3 + random() % (chance(random, 0.1) ? 18 : 6); left > 0; --left)
  {
    changes.push_back(drawChange(random));
    kept.apply(changes.back());
    description = kept.description();
    renewed.apply(changes.back());
    renewed.renewPass();
    compare(kept, renewed);
  }
  FuzzScene fresh(start, Purpose::Changes);
  for (const Change& change : changes)
  {
    fresh.apply(change);
  }
  try
  {
    compare(kept, fresh);
  }
  catch (const Find& find)
  {
    if (!vtkRemembers(start, changes))
    {
      throw Find(std::string("in a fresh window: ") + find.what());
    }
  }
}

} // namespace gnomon::fuzz
