// A viewer of PCL, in PCL's own window, or without a display ("egl"). Checks as pictures.py does.

#include <vtkGnomonEGLRenderWindow.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>

#include <pcl/visualization/pcl_visualizer.h>

#include <vtkActor.h>
#include <vtkLODActor.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>
#include <string>
#include <vector>

namespace
{

using Picture = std::vector<unsigned char>; ///< three bytes a pixel

int failures = 0;

/// Print a check's result, with the number of pixels that it stands on.
void tell(const char* name, bool isRight, int pixels)
{
  std::printf("%s %s: %d pixels\n", isRight ? "ok  " : "FAIL", name, pixels);
  failures += isRight ? 0 : 1;
}

Picture takePicture(vtkRenderWindow* window)
{
  window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  const int* const size = window->GetSize();
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, /*front=*/0, bytes);
  return Picture(bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues());
}

/// How many pixels of the second picture have a red that is darker by more than a number of 255.
int countDarker(const Picture& before, const Picture& after, int difference)
{
  int count = 0;
  for (std::size_t i = 0; i < before.size(); i += 3)
  {
    count += before[i] - after[i] > difference ? 1 : 0;
  }
  return count;
}

/// Four points above the ground, a sixth of the ball's height apart.
pcl::PointCloud<pcl::PointXYZ>::Ptr makeCloud()
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 4; ++i)
  {
    cloud->push_back(pcl::PointXYZ(1.5F, -1.5F + 0.5F * static_cast<float>(i), 0.5F));
  }
  return cloud;
}

} // namespace

int main(int argc, char* argv[])
{
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  if (argc > 1 && std::string(argv[1]) == "egl")
  {
    window = vtkSmartPointer<vtkGnomonEGLRenderWindow>::New();
  }
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  pcl::visualization::PCLVisualizer viewer(renderer, window, "viewer", /*create_interactor=*/false);
  viewer.setSize(320, 240);
  viewer.addCube(-3.0F, 3.0F, -3.0F, 3.0F, -0.1F, 0.0F, 1.0, 1.0, 1.0, "ground");
  viewer.setShapeRenderingProperties(pcl::visualization::PCL_VISUALIZER_REPRESENTATION,
    pcl::visualization::PCL_VISUALIZER_REPRESENTATION_SURFACE, "ground");
  viewer.addSphere(pcl::PointXYZ(0.0F, 0.0F, 1.0F), 0.5, 1.0, 1.0, 1.0, "ball");
  viewer.addPointCloud(makeCloud(), "cloud");
  viewer.setPointCloudRenderingProperties(
    pcl::visualization::PCL_VISUALIZER_POINT_SIZE, 9, "cloud");
  viewer.setCameraPosition(0.0, -6.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
  vtkNew<vtkLight> sun;
  sun->SetPosition(1.0, 0.3, 1.5);
  renderer->AddLight(sun);
  const Picture plain = takePicture(window);

  vtkNew<vtkGnomonShadowPass> shadows;
  renderer->SetPass(shadows);
  const Picture shown = takePicture(window);
  int count = countDarker(plain, shown, 40);
  tell("a shadow shows", count >= 400, count);
  count = countDarker(shown, plain, 0);
  tell("shadows make nothing brighter", count == 0, count);

  auto* const ball = vtkActor::SafeDownCast(viewer.getShapeActorMap()->at("ball"));
  vtkGnomonPropKeys::SetCasts(ball, false);
  count = countDarker(plain, takePicture(window), 40);
  tell("a caster that does not cast has none", count == 0, count);

  renderer->SetPass(nullptr);
  const Picture again = takePicture(window);
  count = countDarker(plain, again, 0) + countDarker(again, plain, 0);
  tell("without shadows, the picture is as it was", plain == again, count);

  viewer.getCloudActorMap()->at("cloud").actor->GetProperty()->RenderPointsAsSpheresOn();
  const Picture spheres = takePicture(window);
  renderer->SetPass(shadows);
  count = countDarker(spheres, takePicture(window), 40);
  tell("points as spheres cast", count >= 100, count);
  return failures > 0 ? 1 : 0;
}
