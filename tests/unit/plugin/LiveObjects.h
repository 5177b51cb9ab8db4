#pragma once

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkTextureUnitManager.h>

#include <cstddef>
#include <ostream>
#include <vector>

namespace gnomon::test
{

/// Live OpenGL objects of a context.
struct LiveObjects
{
  int textures = 0;
  int buffers = 0;
  int framebuffers = 0;
  int renderbuffers = 0;
  int vertexArrays = 0;
  int programs = 0;
  int shaders = 0;

  bool operator==(const LiveObjects& other) const
  {
    return this->sameButPrograms(other) && this->programs == other.programs &&
      this->shaders == other.shaders;
  }
  bool sameButPrograms(const LiveObjects& other) const
  {
    return this->textures == other.textures && this->buffers == other.buffers &&
      this->framebuffers == other.framebuffers && this->renderbuffers == other.renderbuffers &&
      this->vertexArrays == other.vertexArrays;
  }
};

std::ostream& operator<<(std::ostream& stream, const LiveObjects& live);

/// Count the live objects of a window's context, which is current afterwards.
LiveObjects countLiveObjects(vtkRenderWindow* window);

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
