// A QVTKOpenGLNativeWidget. A line of input has it move to another window ("reparent"), go
// ("delete"), or the program end.

#include "client.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>

#include <QApplication>
#include <QSocketNotifier>

#include <iostream>

int main(int argc, char* argv[])
{
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  const QApplication application(argc, argv);
  QWidget windows[2];
  for (QWidget& window : windows)
  {
    window.setGeometry(0, 0, client::width, client::height);
  }
  auto* view = new QVTKOpenGLNativeWidget(&windows[0]);
  view->resize(windows[0].size());
  vtkNew<vtkGenericOpenGLRenderWindow> drawing;
  view->setRenderWindow(drawing);
  vtkNew<vtkRenderer> renderer;
  drawing->AddRenderer(renderer);
  client::fill(renderer, view->interactor(), argc, argv);
  windows[0].show();

  QSocketNotifier input(0, QSocketNotifier::Read);
  QObject::connect(&input, &QSocketNotifier::activated,
    [&]
    {
      std::string word;
      std::cin >> word;
      if (word == "reparent")
      {
        view->setParent(&windows[1]);
        view->show();
        windows[1].show();
        windows[0].hide();
      }
      else if (word == "delete")
      {
        delete view;
      }
      else
      {
        QApplication::quit();
      }
    });
  return QApplication::exec();
}
