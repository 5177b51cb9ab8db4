// Shadows in a window of Qt: a QVTKOpenGLNativeWidget beside a menu of techniques.
//
// The pass asks for OpenGL 4.3, and VTK's widget for 3.2 unless told otherwise: set the default
// format before the first widget. While the mouse turns the camera, `auto` may take a map; the
// picture at rest is exact again.
//
//   qt_shadows [picture.png]    with a path: writes what the window shows, and ends

#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkConeSource.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QComboBox>
#include <QSurfaceFormat>
#include <QTimer>
#include <QVBoxLayout>

void add(vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetProperty()->SetAmbient(0.25); // ambient light is never shadowed
  renderer->AddActor(actor);
}

int main(int argc, char* argv[])
{
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setVersion(4, 5);
  QSurfaceFormat::setDefaultFormat(format);
  const QApplication application(argc, argv);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  vtkNew<vtkConeSource> cone;
  cone->SetDirection(0, 0, 1);
  cone->SetCenter(0, 0, 0.5);
  cone->SetResolution(64);
  add(renderer, cone, 0.85, 0.45, 0.25);
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-1.5, -1.5, 0);
  ground->SetPoint1(1.5, -1.5, 0);
  ground->SetPoint2(-1.5, 1.5, 0);
  add(renderer, ground, 0.70, 0.72, 0.76);
  renderer->GetActiveCamera()->SetPosition(1, -6, 4);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.4);
  vtkNew<vtkLight> sun; // directional: it shines towards the origin
  sun->SetPosition(-1, -0.3, 1);
  renderer->AddLight(sun);
  vtkNew<vtkGnomonShadowPass> shadows;
  renderer->SetPass(shadows);

  QWidget window;
  auto* view = new QVTKOpenGLNativeWidget(&window);
  vtkNew<vtkGenericOpenGLRenderWindow> drawing;
  view->setRenderWindow(drawing);
  drawing->AddRenderer(renderer);
  auto* techniques = new QComboBox(&window);
  techniques->addItem("auto");
  for (int i = 0; i < vtkGnomonShadowPass::GetNumberOfTechniques(); ++i)
  {
    techniques->addItem(vtkGnomonShadowPass::GetTechniqueName(i));
  }
  QObject::connect(techniques, &QComboBox::currentTextChanged,
    [&](const QString& name)
    {
      shadows->SetTechnique(name.toUtf8().constData());
      drawing->Render();
    });
  auto* layout = new QVBoxLayout(&window);
  layout->addWidget(techniques);
  layout->addWidget(view, 1);
  window.resize(800, 600);
  window.show();

  if (argc > 1)
  {
    QTimer::singleShot(500, &window,
      [&]
      {
        const bool written = window.grab().save(argv[1]);
        QApplication::exit(written ? 0 : 1);
      });
  }
  return QApplication::exec();
}
