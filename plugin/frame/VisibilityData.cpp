#include "plugin/frame/VisibilityData.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkType.h>

#include <cstdint>
#include <string>

namespace gnomon
{
namespace
{

/// Puts planes of numbers, top row first, into an array of as many components.
/// @param origin is added, to each component its own
template <typename Array, typename Number>
void addArray(vtkImageData* image, const VisibilityImages& images, const std::string& name,
  const std::vector<const std::vector<Number>*>& planes,
  const std::array<typename Array::ValueType, 3>& origin = {})
{
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(planes.size()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(images.width) * images.height);
  for (std::size_t component = 0; component < planes.size(); ++component)
  {
    for (int y = 0; y < images.height; ++y)
    {
      const auto row = planes[component]->begin() +
        static_cast<std::ptrdiff_t>(images.height - 1 - y) * images.width;
      for (int x = 0; x < images.width; ++x)
      {
        array->SetTypedComponent(static_cast<vtkIdType>(y) * images.width + x,
          static_cast<int>(component),
          origin[component % 3] + static_cast<typename Array::ValueType>(row[x]));
      }
    }
  }
  image->GetPointData()->AddArray(array);
}

} // namespace

void fillImage(const VisibilityImages& images, vtkImageData* image)
{
  image->Initialize();
  image->SetDimensions(images.width, images.height, images.width > 0 ? 1 : 0);
  if (images.width == 0 || images.height == 0)
  {
    return;
  }
  for (std::size_t i = 0; i < images.visibility.size();)
  {
    const std::size_t channels = images.channels[i] == LightChannel::All ? 1 : 3;
    std::vector<const std::vector<float>*> planes;
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
      planes.push_back(&images.visibility[i + channel]);
    }
    addArray<vtkFloatArray, float>(
      image, images, "light " + std::to_string(images.sceneIndices[i]), planes);
    i += channels;
  }
  addArray<vtkDoubleArray, float>(image, images, "position",
    { &images.positionX, &images.positionY, &images.positionZ }, images.origin);
  addArray<vtkFloatArray, float>(
    image, images, "normal", { &images.normalX, &images.normalY, &images.normalZ });
  addArray<vtkFloatArray, float>(image, images, "coverage", { &images.coverage });
  addArray<vtkIntArray, int>(image, images, "prop", { &images.prop });
  addArray<vtkIdTypeArray, std::int64_t>(image, images, "cell", { &images.cell });
}

} // namespace gnomon
