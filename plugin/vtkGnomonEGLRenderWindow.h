/**
 * @class   vtkGnomonEGLRenderWindow
 * @brief   a window without a display: OpenGL through EGL, with no X server
 *
 * For VTK builds that have only GLX windows, such as Debian's. The context is surfaceless where EGL
 * allows it, so that it needs no display at all; VTK draws into its own framebuffers, and pictures
 * are read with vtkWindowToImageFilter or GetPixelData as from any window.
 *
 * @code
 * vtkNew<vtkGnomonEGLRenderWindow> window;
 * window->SetSize(1024, 1024);
 * window->AddRenderer(renderer);
 * window->Render();
 * @endcode
 */

#ifndef vtkGnomonEGLRenderWindow_h
#define vtkGnomonEGLRenderWindow_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkGenericOpenGLRenderWindow.h"

#include <memory> // For std::unique_ptr

class GNOMONPLUGIN_EXPORT vtkGnomonEGLRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkGnomonEGLRenderWindow* New();
  vtkTypeMacro(vtkGnomonEGLRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Initialize() override;
  void Finalize() override;
  void Render() override;
  void MakeCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override;
  void OpenGLInitContext() override;

protected:
  vtkGnomonEGLRenderWindow();
  ~vtkGnomonEGLRenderWindow() override;

private:
  vtkGnomonEGLRenderWindow(const vtkGnomonEGLRenderWindow&) = delete;
  void operator=(const vtkGnomonEGLRenderWindow&) = delete;

  struct Context;
  std::unique_ptr<Context> EGL;
};

#endif
