// A QQuickVTKRenderItem in a window of Qt Quick. Input ends it.

#include "client.h"

#include <QQuickVTKRenderItem.h>
#include <QQuickVTKRenderWindow.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <QGuiApplication>
#include <QQuickWindow>
#include <QSocketNotifier>
#include <QTimer>

int main(int argc, char* argv[])
{
  QQuickVTKRenderWindow::setupGraphicsBackend();
  const QGuiApplication application(argc, argv);
  QQuickWindow window;
  window.setGeometry(0, 0, client::width, client::height);
  auto* drawing = new QQuickVTKRenderWindow;
  auto* item = new QQuickVTKRenderItem;
  for (QQuickItem* each : { static_cast<QQuickItem*>(drawing), static_cast<QQuickItem*>(item) })
  {
    each->setParentItem(window.contentItem());
    each->setSize(window.size());
  }
  item->setRenderWindow(drawing);
  const auto shadows =
    client::fill(item->renderer(), drawing->renderWindow()->GetInteractor(), argc, argv);
  if (shadows)
  {
    vtkNew<vtkCallbackCommand> drawAgain;
    drawAgain->SetClientData(&window);
    drawAgain->SetCallback(
      [](vtkObject*, unsigned long, void* window, void* milliseconds)
      {
        QTimer::singleShot(*static_cast<int*>(milliseconds), static_cast<QQuickWindow*>(window),
          &QQuickWindow::update);
      });
    shadows->AddObserver(vtkGnomonShadowPass::PictureUnfinishedEvent, drawAgain);
  }
  window.show();

  QSocketNotifier input(0, QSocketNotifier::Read);
  QObject::connect(&input, &QSocketNotifier::activated, &QGuiApplication::quit);
  return QGuiApplication::exec();
}
