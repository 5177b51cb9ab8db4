#include "vtkGnomonOffScreenWindow.h"

#if GNOMON_EGL
#include "vtkGnomonEGLRenderWindow.h"
#endif

namespace gnomon
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOpenGLRenderWindow> makeOffScreenWindow()
{
#if GNOMON_EGL
  return vtkSmartPointer<vtkGnomonEGLRenderWindow>::New();
#else
  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(1);
  return vtkOpenGLRenderWindow::SafeDownCast(window);
#endif
}

} // namespace gnomon
