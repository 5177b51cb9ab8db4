#pragma once

#include "GnomonPluginModule.h" // For export macro
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"

namespace gnomon
{

/// Return a new window that shows nothing, with one sample per pixel: a vtkGnomonEGLRenderWindow,
/// or VTK's own window, off-screen, from a Gnomon that is built without EGL (GNOMON_EGL).
GNOMONPLUGIN_EXPORT vtkSmartPointer<vtkOpenGLRenderWindow> makeOffScreenWindow();

} // namespace gnomon
