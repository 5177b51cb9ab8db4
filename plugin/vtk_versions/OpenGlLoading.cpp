#include "plugin/vtk_versions/OpenGlLoading.h"

#include "vtkOpenGLRenderWindow.h"

#include GNOMON_VTK_GL_HEADER

namespace gnomon
{

#if GNOMON_VTK_HAS_GLAD

std::string loadOpenGl(vtkOpenGLRenderWindow* /*window*/, void (*(*find)(const char* name))())
{
  // glad's own search uses libGL, which knows no function until GLX has made a context.
  return gladLoadGL(find) > 0 ? "" : "the context names none";
}

void noteLoaded(vtkOpenGLRenderWindow* /*window*/) {}

#else

namespace
{

struct WindowAccess : vtkOpenGLRenderWindow
{
  static bool& isLoaded(vtkOpenGLRenderWindow* window)
  {
    return window->*(&WindowAccess::GlewInitValid);
  }
};

} // namespace

std::string loadOpenGl(vtkOpenGLRenderWindow* window, void (*(* /*find*/)(const char* name))())
{
  // GLEW built for GLX loads the functions, then reports that there is no X display.
  const GLenum result = glewInit();
  const bool loaded = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
  WindowAccess::isLoaded(window) = loaded;
  return loaded ? "" : reinterpret_cast<const char*>(glewGetErrorString(result));
}

void noteLoaded(vtkOpenGLRenderWindow* window)
{
  WindowAccess::isLoaded(window) = true;
}

#endif

} // namespace gnomon
