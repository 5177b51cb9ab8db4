#include "LiveObjects.h"

#include "shadowtech/base/Gl.h"

#include <vtkRenderWindow.h>

namespace gnomon::test
{

LiveObjects countLiveObjects(vtkRenderWindow* window)
{
  window->MakeCurrent();
  // Mesa never reuses the names of vertex arrays.
  constexpr GLuint firstUnused = 1u << 16;
  LiveObjects live;
  for (const auto& [kind, isOne] : { std::pair("textures", glIsTexture), { "buffers", glIsBuffer },
         { "framebuffers", glIsFramebuffer }, { "renderbuffers", glIsRenderbuffer },
         { "vertex arrays", glIsVertexArray }, { "programs", glIsProgram },
         { "shaders", glIsShader } })
  {
    int& count = live[kind];
    for (GLuint name = 1; name < firstUnused; ++name)
    {
      count += isOne(name);
    }
  }
  return live;
}

LiveObjects withoutPrograms(LiveObjects live)
{
  live.erase("programs");
  live.erase("shaders");
  return live;
}

} // namespace gnomon::test
