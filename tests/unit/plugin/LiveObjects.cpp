#include "LiveObjects.h"

#include "shadowtech/base/Gl.h"

#include <vtkRenderWindow.h>

namespace gnomon::test
{

std::ostream& operator<<(std::ostream& stream, const LiveObjects& live)
{
  return stream << live.textures << " textures, " << live.buffers << " buffers, "
                << live.framebuffers << " framebuffers, " << live.renderbuffers
                << " renderbuffers, " << live.vertexArrays << " vertex arrays, " << live.programs
                << " programs, " << live.shaders << " shaders";
}

LiveObjects countLiveObjects(vtkRenderWindow* window)
{
  window->MakeCurrent();
  // Mesa never reuses the names of vertex arrays.
  constexpr GLuint firstUnused = 1u << 16;
  LiveObjects live;
  for (GLuint name = 1; name < firstUnused; ++name)
  {
    live.textures += glIsTexture(name);
    live.buffers += glIsBuffer(name);
    live.framebuffers += glIsFramebuffer(name);
    live.renderbuffers += glIsRenderbuffer(name);
    live.vertexArrays += glIsVertexArray(name);
    live.programs += glIsProgram(name);
    live.shaders += glIsShader(name);
  }
  return live;
}

} // namespace gnomon::test
