#pragma once

#include "lights/vtkGnomonVersions.h"

#include <ostream>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

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

} // namespace gnomon::test
