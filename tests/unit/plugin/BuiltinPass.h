#pragma once

#include "PassScene.h"
#include "Scene.h"

namespace gnomon::test
{

/// A built-in scene in its own window, square unless a height is given, under a pass that keeps
/// visibility.
struct BuiltinPass
{
  vtkSmartPointer<vtkRenderer> renderer;
  vtkSmartPointer<vtkOpenGLRenderWindow> window = makeOffScreenWindow();
  vtkNew<vtkGnomonShadowPass> pass;

  BuiltinPass(const tool::Scene& scene, int width, int height = 0)
    : renderer(tool::makeRenderer(scene, height > 0 ? static_cast<double>(width) / height : 1.0))
  {
    this->window->SetMultiSamples(0);
    this->window->SetSize(width, height > 0 ? height : width);
    this->window->AddRenderer(this->renderer);
    this->pass->KeepVisibilityOn();
    this->pass->SmoothTerminatorsOff(); // techniques are compared on the triangles
    this->renderer->SetPass(this->pass);
  }
  BuiltinPass(const std::string& scene, int width, int height = 0)
    : BuiltinPass(tool::loadScene(scene), width, height)
  {
  }

  void choose(const char* text) const { test::choose(this->pass, text); }
  /// Draw by a technique and settings, if any are given.
  const VisibilityImages& draw(const char* text = "") const
  {
    this->choose(text);
    this->window->Render();
    return this->pass->GetVisibility();
  }
  Picture render(const char* text = "") const
  {
    this->draw(text);
    return readPicture(this->window);
  }
  Picture renderPlain() const
  {
    this->renderer->SetPass(nullptr);
    this->window->Render();
    this->renderer->SetPass(this->pass);
    return readPicture(this->window);
  }
  const FrameReport& report() const { return this->pass->GetReport(); }
};

/// Return a built-in scene's name as a part of a test's name.
inline std::string testNameOf(std::string scene)
{
  std::replace(scene.begin(), scene.end(), '-', '_');
  return scene;
}

} // namespace gnomon::test
