#include "vtkGnomonEGLRenderWindow.h"

#include "WindowScene.h"

#include <gtest/gtest.h>

#include <cstdlib>

using gnomon::test::makeSphereScene;
using gnomon::test::readPicture;

namespace
{

std::vector<unsigned char> draw(vtkRenderWindow* window)
{
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(320, 240);
  window->AddRenderer(makeSphereScene());
  window->Render();
  return readPicture(window);
}

} // namespace

//------------------------------------------------------------------------------
// Both windows draw into VTK's framebuffers with the same driver, so that not a byte may differ.
TEST(GlxWindow, showsTheSameBytesAsTheWindowWithoutADisplay)
{
  ASSERT_NE(std::getenv("DISPLAY"), nullptr) << "run under xvfb-run";
  vtkNew<vtkRenderWindow> onDisplay;
  ASSERT_STREQ(onDisplay->GetClassName(), "vtkXOpenGLRenderWindow");
  const auto expected = draw(onDisplay);
  onDisplay->Finalize(); // one thread holds a GLX or an EGL context, not both

  vtkNew<vtkGnomonEGLRenderWindow> withoutDisplay;
  EXPECT_TRUE(draw(withoutDisplay) == expected);
}
