#pragma once

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkTextureUnitManager.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gnomon::test
{

/// The numbers of live OpenGL objects of a context, by kind.
using LiveObjects = std::map<std::string, int>;

/// Count the live objects of a window's context, which is current afterwards.
LiveObjects countLiveObjects(vtkRenderWindow* window);
LiveObjects withoutPrograms(LiveObjects live);

/// Takes all texture units that VTK's manager can still give, and gives them back.
struct TakenUnits
{
  explicit TakenUnits(vtkOpenGLRenderWindow* window)
    : manager(window->GetState()->GetTextureUnitManager())
  {
    for (int unit = this->manager->Allocate(); unit >= 0; unit = this->manager->Allocate())
    {
      this->units.push_back(unit);
    }
  }
  ~TakenUnits() { this->giveBack(this->units.size()); }
  void giveBack(std::size_t count)
  {
    for (; count > 0; --count, this->units.pop_back())
    {
      this->manager->Free(this->units.back());
    }
  }

  vtkTextureUnitManager* manager;
  std::vector<int> units;
};

} // namespace gnomon::test
