// The pass in Qt's widget, on an X server: the same picture as in the window without a display.

#include "vtkGnomonOffScreenWindow.h"

#include "WindowScene.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRendererCollection.h>

#include <QApplication>
#include <QImage>
#include <QSurfaceFormat>

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <set>
#include <thread>

using gnomon::test::drawn;
using gnomon::test::makeSphereScene;
using gnomon::test::Picture;

namespace
{

constexpr int width = 320;
constexpr int height = 240;

/// Lets Qt show its windows and draw what is to be drawn.
void processEvents()
{
  for (int i = 0; i < 10; ++i)
  {
    QApplication::processEvents();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Picture readPicture(QVTKOpenGLNativeWidget& widget)
{
  const QImage image = widget.grabFramebuffer().convertToFormat(QImage::Format_RGB888);
  Picture picture{ image.width(), image.height(), {} };
  for (int y = image.height() - 1; y >= 0; --y) // Qt's first row is the top one
  {
    picture.rgb.insert(picture.rgb.end(), image.scanLine(y), image.scanLine(y) + 3 * image.width());
  }
  return picture;
}

std::size_t countColours(const Picture& picture)
{
  return std::set<unsigned char>(picture.rgb.begin(), picture.rgb.end()).size();
}

Picture drawWithoutDisplay()
{
  const auto window = gnomon::makeOffScreenWindow();
  window->SetSize(width, height);
  window->AddRenderer(makeSphereScene());
  return drawn(window);
}

} // namespace

TEST(QtWidget, showsTheSameBytesAsTheWindowWithoutADisplay)
{
  const auto expected = drawWithoutDisplay();

  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setVersion(4, 5); // VTK asks for 3.2
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  int arguments = 1;
  char name[] = "qt_widget_tests";
  char* values[] = { name, nullptr };
  const QApplication application(arguments, values);

  QVTKOpenGLNativeWidget widget;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  widget.setRenderWindow(window);
  widget.resize(width, height);
  const auto renderer = makeSphereScene();
  window->AddRenderer(renderer);
  widget.show();
  processEvents();
  const auto shadowed = readPicture(widget);
  auto* pass = vtkGnomonShadowPass::SafeDownCast(renderer->GetPass());
  EXPECT_EQ(pass->GetReport().route, "deferred") << pass->GetReport().routeReason;
  EXPECT_EQ(shadowed.rgb.size(), expected.rgb.size());
  EXPECT_TRUE(shadowed == expected);

  // Resized, and without the pass: Qt makes another framebuffer.
  widget.resize(width / 2, height);
  processEvents();
  EXPECT_EQ(readPicture(widget).rgb.size(), expected.rgb.size() / 2);
  widget.resize(width, height);
  processEvents();
  EXPECT_TRUE(readPicture(widget) == expected);

  // A timer draws what is left. While the window draws only in its owner's paint function, as Qt
  // Quick's does, an event asks for it.
  pass->SetSetting("technique", "penumbra");
  pass->SetSetting("light_radius", "0.2");
  pass->SetSetting("moving_samples", "4");
  window->Render();
  EXPECT_LT(pass->GetProgress(), 1.0);
  processEvents();
  EXPECT_EQ(pass->GetProgress(), 1.0);
  int asked = 0;
  vtkNew<vtkCallbackCommand> ask;
  ask->SetClientData(&asked);
  ask->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  pass->AddObserver(vtkGnomonShadowPass::PictureUnfinishedEvent, ask);
  for (int frame = 1; frame <= 2; ++frame)
  {
    renderer->GetActiveCamera()->Azimuth(1.0);
    window->Render();
    EXPECT_LT(pass->GetProgress(), 1.0);
    window->SetReadyForRendering(false);
    processEvents();
    window->SetReadyForRendering(true);
    EXPECT_EQ(asked, frame);
  }

  renderer->SetPass(nullptr);
  window->Render();
  processEvents();
  EXPECT_FALSE(readPicture(widget) == expected);

  // One pass in two widgets, with the samples that windows have by default.
  vtkNew<vtkGnomonShadowPass> shared;
  std::array<QVTKOpenGLNativeWidget, 2> widgets;
  std::array<vtkNew<vtkGenericOpenGLRenderWindow>, 2> windows;
  for (std::size_t i = 0; i < widgets.size(); ++i)
  {
    const auto shown = makeSphereScene();
    shown->SetPass(shared);
    windows[i]->AddRenderer(shown);
    widgets[i].setRenderWindow(windows[i]);
    widgets[i].resize(width, height);
    widgets[i].show();
  }
  processEvents();
  windows[0]->Render();
  processEvents();
  EXPECT_GT(countColours(readPicture(widgets[0])), 50u);
  EXPECT_TRUE(readPicture(widgets[0]) == readPicture(widgets[1]));
}
