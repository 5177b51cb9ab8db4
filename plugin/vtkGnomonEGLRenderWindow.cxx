#include "vtkGnomonEGLRenderWindow.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLState.h"

#include <vtk_glew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

vtkStandardNewMacro(vtkGnomonEGLRenderWindow);

struct vtkGnomonEGLRenderWindow::Context
{
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

vtkGnomonEGLRenderWindow::vtkGnomonEGLRenderWindow()
  : EGL(new Context)
{
  this->SetOffScreenRendering(1);
  this->SetMultiSamples(0);
  this->SetReadyForRendering(true);
  this->SetFrameBlitModeToNoBlit();
}

vtkGnomonEGLRenderWindow::~vtkGnomonEGLRenderWindow()
{
  this->Finalize();
}

void vtkGnomonEGLRenderWindow::Initialize()
{
  if (this->EGL->context != EGL_NO_CONTEXT)
  {
    return;
  }
  this->EGL->display =
    eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  EGLint major, minor;
  eglInitialize(this->EGL->display, &major, &minor);
  eglBindAPI(EGL_OPENGL_API);
  const EGLint configAttributes[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
    EGL_OPENGL_BIT, EGL_NONE };
  EGLConfig config;
  EGLint count = 0;
  eglChooseConfig(this->EGL->display, configAttributes, &config, 1, &count);
  const EGLint attributes[] = { EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  this->EGL->context = eglCreateContext(this->EGL->display, config, EGL_NO_CONTEXT, attributes);
  this->MakeCurrent();
  this->OpenGLInit();
}

void vtkGnomonEGLRenderWindow::Finalize()
{
  if (this->EGL->context == EGL_NO_CONTEXT)
  {
    return;
  }
  this->MakeCurrent();
  this->Superclass::Finalize();
  eglMakeCurrent(this->EGL->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(this->EGL->display, this->EGL->context);
  this->EGL->context = EGL_NO_CONTEXT;
}

void vtkGnomonEGLRenderWindow::Render()
{
  this->Initialize();
  this->Superclass::Render();
}

void vtkGnomonEGLRenderWindow::MakeCurrent()
{
  if (this->EGL->context != EGL_NO_CONTEXT)
  {
    eglMakeCurrent(this->EGL->display, EGL_NO_SURFACE, EGL_NO_SURFACE, this->EGL->context);
  }
}

bool vtkGnomonEGLRenderWindow::IsCurrent()
{
  return this->EGL->context != EGL_NO_CONTEXT && eglGetCurrentContext() == this->EGL->context;
}

int vtkGnomonEGLRenderWindow::SupportsOpenGL()
{
  return 1;
}

void vtkGnomonEGLRenderWindow::OpenGLInitContext()
{
  this->ContextCreationTime.Modified();
  if (!this->Initialized)
  {
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    this->GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
    this->Initialized = this->GlewInitValid;
  }
}

void vtkGnomonEGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
