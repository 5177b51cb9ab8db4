// Water that the user's own vertex shader moves, with the shadows of posts that stand in it.
//
// The shader's replacement lifts each vertex and turns its normal. A shadow map is looked up where
// the shader puts the surface, so that shadows bend over the waves. Casters have the vertices of
// the data: the water, flat there, is told not to cast.
//
//   shader_waves [picture.png [width height]]

#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

vtkSmartPointer<vtkActor> add(
  vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetProperty()->SetAmbient(0.3); // ambient light is never shadowed
  renderer->AddActor(actor);
  return actor;
}

// Waves of two directions, by shader code before VTK's own. vertexMC is then the data's point:
// by default VTK may shift and scale it.
void addWaves(vtkActor* water)
{
  auto* mapper = vtkOpenGLPolyDataMapper::SafeDownCast(water->GetMapper());
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  vtkShaderProperty* shader = water->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Dec", true,
    "//VTK::PositionVC::Dec\n"
    "vec3 wave(vec2 p, vec2 k, float a) // its height, and its slopes along x and y\n"
    "{ return a * vec3(sin(dot(k, p)), k * cos(dot(k, p))); }\n"
    "vec3 waves(vec2 p)\n"
    "{ return wave(p, vec2(0.9, 0.5), 0.25) + wave(p, vec2(-0.7, 1.6), 0.11); }\n",
    false);
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
    "vec4 moved = vertexMC + vec4(0.0, 0.0, waves(vertexMC.xy).x, 0.0);\n"
    "#define vertexMC moved\n"
    "//VTK::PositionVC::Impl\n"
    "#undef vertexMC\n",
    false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true,
    "vec3 turned = normalize(vec3(-waves(vertexMC.xy).yz, 1.0));\n"
    "#define normalMC turned\n"
    "//VTK::Normal::Impl\n"
    "#undef normalMC\n",
    false);
}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.86, 0.92, 0.97);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-20, -12, 0);
  plane->SetPoint1(20, -12, 0);
  plane->SetPoint2(-20, 28, 0);
  plane->SetResolution(300, 300);
  auto water = add(renderer, plane, 0.25, 0.55, 0.66);
  vtkGnomonPropKeys::SetCasts(water, false);
  addWaves(water);

  vtkNew<vtkCylinderSource> post;
  post->SetRadius(0.22);
  post->SetHeight(4.0);
  post->SetResolution(24);
  for (int i = 0; i < 12; ++i)
  {
    auto actor = add(renderer, post, 0.52, 0.38, 0.26);
    actor->RotateX(90.0);
    actor->SetPosition(i % 2 ? 1.2 : -1.2, 2.4 * (i / 2) - 2.0, 0.0);
  }
  vtkNew<vtkCubeSource> deck;
  deck->SetBounds(-1.6, 1.6, -2.6, 11.0, 1.6, 1.85);
  add(renderer, deck, 0.72, 0.56, 0.40);

  vtkNew<vtkLight> sun; // directional: it shines towards the origin
  sun->SetPosition(-0.9, 0.25, 0.75);
  renderer->AddLight(sun);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetTechnique("pcf"); // a map: rays start on the triangles of the data
  shadows->SetMapSize(4096);
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(9, -11, 6.5);
  renderer->GetActiveCamera()->SetFocalPoint(1.6, 2.0, 0.0);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCameraClippingRange();

  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 600);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "shader_waves.png");
  writer->Write();
}
