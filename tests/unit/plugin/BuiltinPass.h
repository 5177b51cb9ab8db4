#pragma once

#include "Scene.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <string>

namespace gnomon::test
{

/// A built-in scene in its own square window, under a pass that keeps visibility.
struct BuiltinPass
{
  vtkSmartPointer<vtkRenderer> renderer;
  vtkNew<vtkGnomonEGLRenderWindow> window;
  vtkNew<vtkGnomonShadowPass> pass;

  BuiltinPass(const std::string& scene, int sidePixels)
    : renderer(tool::makeRenderer(tool::loadScene(scene), 1.0))
  {
    this->window->SetMultiSamples(0);
    this->window->SetSize(sidePixels, sidePixels);
    this->window->AddRenderer(this->renderer);
    this->pass->KeepVisibilityOn();
    this->pass->SmoothTerminatorsOff(); // techniques are compared on the triangles
    this->renderer->SetPass(this->pass);
  }
};

/// Return a built-in scene's name as a part of a test's name.
inline std::string testNameOf(std::string scene)
{
  std::replace(scene.begin(), scene.end(), '-', '_');
  return scene;
}

} // namespace gnomon::test
