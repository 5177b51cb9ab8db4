#include "vtkGnomonEGLRenderWindow.h"

#include "WindowScene.h"

#include "vtkGnomonShadowPass.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkHardwareSelector.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRendererCollection.h>
#include <vtkSelection.h>
#include <vtkWindowToImageFilter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

using gnomon::test::drawn;
using gnomon::test::makeSphereScene;
using gnomon::test::readPicture;

namespace
{

gnomon::test::Picture draw(vtkRenderWindow* window)
{
  window->SetMultiSamples(0);
  window->SetSize(320, 240);
  window->AddRenderer(makeSphereScene());
  return drawn(window);
}

} // namespace

// Both windows draw into VTK's framebuffers with the same driver, so that not a byte may differ.
TEST(GlxWindow, showsTheSameBytesAsTheWindowWithoutADisplay)
{
  ASSERT_NE(std::getenv("DISPLAY"), nullptr) << "run under xvfb-run";
  vtkNew<vtkRenderWindow> onDisplay;
  ASSERT_STREQ(onDisplay->GetClassName(), "vtkXOpenGLRenderWindow");
  onDisplay->SetOffScreenRendering(1);
  const auto expected = draw(onDisplay);
  onDisplay->Finalize(); // one thread holds a GLX or an EGL context, not both

  vtkNew<vtkGnomonEGLRenderWindow> withoutDisplay;
  EXPECT_TRUE(draw(withoutDisplay) == expected);
}

// A thread has a context of GLX or of EGL. While it has one of EGL, GLX ends the process.
TEST(GlxWindow, takesTurnsWithTheWindowWithoutADisplay)
{
  for (const bool isXFirst : { false, true })
  {
    vtkNew<vtkRenderWindow> onDisplay;
    onDisplay->SetOffScreenRendering(1);
    vtkNew<vtkGnomonEGLRenderWindow> withoutDisplay;
    vtkNew<vtkGnomonShadowPass> pass;
    std::vector<vtkRenderWindow*> windows = { withoutDisplay, onDisplay };
    if (isXFirst)
    {
      std::reverse(windows.begin(), windows.end());
    }
    const auto first = draw(windows[0]);
    EXPECT_EQ(draw(windows[1]), first);
    windows[0]->GetRenderers()->GetFirstRenderer()->SetPass(pass);
    for (int turn = 0; turn < 3; ++turn)
    {
      for (vtkRenderWindow* window : windows)
      {
        window->Render();
        vtkNew<vtkWindowToImageFilter> grab;
        grab->SetInput(window);
        grab->SetInputBufferTypeToRGBA();
        grab->Update();
        vtkNew<vtkHardwareSelector> selector;
        selector->SetRenderer(window->GetRenderers()->GetFirstRenderer());
        selector->SetArea(0, 0, 20, 20);
        vtk::TakeSmartPointer(selector->Select());
        withoutDisplay->ReleaseCurrent(); // which a selection makes current
      }
    }
    EXPECT_EQ(readPicture(windows[1]), first);
  }
}

TEST(GlxWindow, itsInteractorIsHarmlessAtTheWindowWithoutADisplay)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  vtkNew<vtkRenderWindowInteractor> interactor;
  ASSERT_STREQ(interactor->GetClassName(), "vtkXRenderWindowInteractor");
  interactor->SetRenderWindow(window);
  interactor->Initialize();
  interactor->Start();
  EXPECT_FALSE(draw(window).rgb.empty());
}

// On the screen, and then through the window that QVTKOpenGLNativeWidget and other toolkits'
// widgets draw through: one without a context of its own, here that of the window on the screen.
TEST(GlxWindow, showsTheSameBytesOnTheScreenAndInAnotherToolkitsContext)
{
  vtkNew<vtkRenderWindow> onDisplay;
  const auto expected = draw(onDisplay);
  EXPECT_EQ(onDisplay->GetOffScreenRendering(), 0);

  onDisplay->MakeCurrent();
  vtkNew<vtkGenericOpenGLRenderWindow> generic;
  vtkNew<vtkCallbackCommand> yes;
  yes->SetCallback(
    [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<int*>(answer) = 1; });
  generic->AddObserver(vtkCommand::WindowIsCurrentEvent, yes);
  generic->AddObserver(vtkCommand::WindowSupportsOpenGLEvent, yes);
  generic->SetOwnContext(0);
  generic->SetReadyForRendering(true);
  EXPECT_TRUE(draw(generic) == expected);
  generic->Finalize();
}
