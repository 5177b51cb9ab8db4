#include "plugin/scene/VolumeReading.h"

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/ForgetUnasked.h"
#include "plugin/scene/MapperKind.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkGPUVolumeRayCastMapper.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockVolumeMapper.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/gtc/matrix_transform.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace gnomon
{
namespace
{

/// Scalars that a mapper draws: of points, or of cells.
struct MappedScalars
{
  vtkDataArray* array = nullptr;
  bool isOfCells = false;
};

MappedScalars scalarsOf(vtkVolumeMapper* mapper, vtkImageData* data)
{
  int cellFlag = 0;
  vtkDataArray* const array = vtkAbstractMapper::GetScalars(data, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag);
  return { cellFlag <= 1 ? array : nullptr, cellFlag == 1 };
}

/// Return the numbers of samples along an image's axes.
glm::ivec3 samplesOf(vtkImageData* data, bool isOfCells)
{
  const int* const points = data->GetDimensions();
  return glm::ivec3(points[0], points[1], points[2]) - (isOfCells ? 1 : 0);
}

vtkImageData* maskOf(vtkVolumeMapper* mapper)
{
  auto* const gpu = vtkGPUVolumeRayCastMapper::SafeDownCast(mapper);
  return gpu ? gpu->GetMaskInput() : nullptr;
}

/// Return the mapper's images: one, or those of its blocks. Null stands for other data.
std::vector<vtkImageData*> imagesOf(vtkVolumeMapper* mapper)
{
  vtkDataObject* const input = mapper->GetInputDataObject(0, 0);
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(input);
  if (!blocks)
  {
    return { vtkImageData::SafeDownCast(input) };
  }
  std::vector<vtkImageData*> images;
  const auto iterator = vtk::TakeSmartPointer(blocks->NewIterator()); // skips empty blocks
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    images.push_back(vtkImageData::SafeDownCast(iterator->GetCurrentDataObject()));
  }
  return images;
}

/// True if a mapper shows a component or the length of vectors.
bool showsVectors(vtkVolumeMapper* mapper)
{
  auto* const smart = vtkSmartVolumeMapper::SafeDownCast(mapper);
  auto* const blocks = vtkMultiBlockVolumeMapper::SafeDownCast(mapper);
  return (smart && smart->GetVectorMode() != vtkSmartVolumeMapper::DISABLED) ||
    (blocks && blocks->GetVectorMode() != vtkSmartVolumeMapper::DISABLED);
}

/// Return why an image of a volume cannot cast, as a clause; null if it can.
const char* whyNoMedium(vtkVolume* volume, vtkVolumeMapper* mapper, vtkImageData* data)
{
  vtkVolumeProperty* const property = volume->GetProperty();
  if (!data)
  {
    return "its grid is no image";
  }
  if (mapper->GetBlendMode() != vtkVolumeMapper::COMPOSITE_BLEND)
  {
    return "its samples are not composited";
  }
  if (property->GetTransferFunctionMode() != vtkVolumeProperty::TF_1D)
  {
    return "its transfer functions have two dimensions";
  }
  if (data->GetPointGhostArray() || data->GetCellGhostArray())
  {
    return "parts of its grid are blanked";
  }
  if (auto* const mask = maskOf(mapper))
  {
    const bool isBinary = vtkGPUVolumeRayCastMapper::SafeDownCast(mapper)->GetMaskType() ==
      vtkGPUVolumeRayCastMapper::BinaryMaskType;
    if (!isBinary || !vtkUnsignedCharArray::SafeDownCast(scalarsOf(mapper, mask).array))
    {
      return "its mask is not binary";
    }
  }
  vtkDataArray* const array = scalarsOf(mapper, data).array;
  const int components = array ? array->GetNumberOfComponents() : 1;
  if (components > 1 && showsVectors(mapper)) // ParaView asks for the length of single components
  {
    return "it shows a component or the length of vectors";
  }
  return components > 4 || (components == 3 && !property->GetIndependentComponents())
    ? "its components decide no opacity"
    : nullptr;
}

/// Return scalars as floats, shared with the array if it has floats.
std::shared_ptr<const float> floatsOf(vtkDataArray* array)
{
  if (auto* const floats = vtkFloatArray::SafeDownCast(array))
  {
    const vtkSmartPointer<vtkFloatArray> owner(floats);
    return { floats->GetPointer(0), [owner](const float*) {} };
  }
  const auto count = static_cast<std::size_t>(array->GetNumberOfValues());
  const std::shared_ptr<float> converted(new float[count], std::default_delete<float[]>());
  const auto convert = [&](const auto* from)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        std::transform(from + range.begin(), from + range.end(), converted.get() + range.begin(),
          [](auto value) { return static_cast<float>(value); });
      });
  };
  switch (array->GetDataType())
  {
    vtkTemplateMacro(convert(static_cast<const VTK_TT*>(array->GetVoidPointer(0))));
  }
  return converted;
}

/// Return the scalars at the ends of VTK's tables where four components together are a colour:
/// those that its texture shows as 0 and 1. For most types these are not the data's range.
glm::dvec2 rangeOfColours(vtkDataArray* array, const glm::dvec2& rangeOfData)
{
  switch (array->GetDataType())
  {
    case VTK_FLOAT:
      return { 0.0, 1.0 };
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR:
    case VTK_SHORT:
    case VTK_UNSIGNED_SHORT:
      return { 0.0, array->GetDataTypeMax() };
    default:
      return rangeOfData; // VTK scales other types
  }
}

/// Return the extinctions and gradient factors of a component, as VTK tabulates them.
/// @param table number of its functions
/// @param hasGradients true if any component has gradient opacity
VolumeOpacity opacityOf(
  vtkVolume* volume, vtkDataArray* array, int component, int table, bool hasGradients)
{
  vtkVolumeProperty* const property = volume->GetProperty();
  auto* const gpu = vtkGPUVolumeRayCastMapper::SafeDownCast(volume->GetMapper());
  VolumeOpacity opacity;
  opacity.component = component;
  opacity.weight = property->GetComponentWeight(table);
  array->GetFiniteRange(&opacity.range[0], component);
  const auto rangeOf = [&](vtkPiecewiseFunction* function, int type)
  {
    glm::dvec2 range = opacity.range;
    if (gpu && type == vtkGPUVolumeRayCastMapper::NATIVE)
    {
      function->GetRange(&range[0]);
    }
    return range;
  };
  const auto tableOf = [](vtkPiecewiseFunction* function, double from, double to)
  {
    constexpr int fewest = 1024, most = 16384;
    const int ideal = vtkMath::NearestPowerOfTwo(function->EstimateMinNumberOfSamples(from, to));
    std::vector<float> values(static_cast<std::size_t>(std::clamp(ideal, fewest, most)));
    function->GetTable(from, to, static_cast<int>(values.size()), values.data());
    return values;
  };
  vtkPiecewiseFunction* const ofScalars = property->GetScalarOpacity(table);
  const glm::dvec2 range = rangeOf(ofScalars, gpu ? gpu->GetScalarOpacityRangeType() : 0);
  opacity.extinctions = tableOf(ofScalars, range[0], range[1]);
  const double unit = property->GetScalarOpacityUnitDistance(component);
  std::transform(opacity.extinctions.begin(), opacity.extinctions.end(),
    opacity.extinctions.begin(), [unit](float value) { return extinctionOf(value, unit); });
  if (hasGradients && property->HasGradientOpacity(table))
  {
    vtkPiecewiseFunction* const ofGradients = property->GetGradientOpacity(table);
    const glm::dvec2 spanned = rangeOf(ofGradients, gpu ? gpu->GetGradientOpacityRangeType() : 0);
    opacity.ofGradients = tableOf(ofGradients, 0.0, 0.25 * (spanned[1] - spanned[0]));
  }
  else if (hasGradients)
  {
    opacity.ofGradients = { 1.0f };
  }
  if (component == 3 && table == 0)
  {
    opacity.range = rangeOfColours(array, opacity.range);
  }
  return opacity;
}

/// Set the planes that crop a volume, as VTK's shader places them among texels.
void setCropping(vtkVolumeMapper* mapper, Volume& volume)
{
  if (!mapper->GetCropping())
  {
    return;
  }
  const double* const planes = mapper->GetCroppingRegionPlanes();
  const glm::dmat4 indexFromModel = glm::inverse(volume.modelFromIndex);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto of = static_cast<std::size_t>(axis);
    for (int side = 0; side < 2; ++side)
    {
      glm::dvec4 plane(0.0, 0.0, 0.0, 1.0);
      plane[axis] = planes[2 * axis + side];
      const double index = (indexFromModel * plane)[axis];
      const double count = volume.samples[axis];
      volume.cropIndices[of][side] = volume.isOfCells ? index : index * count / (count - 1.0) - 0.5;
    }
  }
  volume.cropFlags =
    static_cast<std::uint32_t>(mapper->GetCroppingRegionFlags()) & Volume::allRegions;
}

void setMask(vtkVolumeMapper* mapper, Volume& volume)
{
  if (vtkImageData* const mask = maskOf(mapper))
  {
    const MappedScalars scalars = scalarsOf(mapper, mask);
    const vtkSmartPointer<vtkUnsignedCharArray> texels =
      vtkUnsignedCharArray::SafeDownCast(scalars.array);
    volume.maskTexels = samplesOf(mask, scalars.isOfCells);
    volume.mask = { texels->GetPointer(0), [texels](const std::uint8_t*) {} };
  }
}

/// Return the matrix from sample indices to the volume's own coordinates.
glm::dmat4 modelFromIndex(vtkImageData* data, bool isOfCells)
{
  const int* const extent = data->GetExtent();
  const glm::dvec3 first(extent[0], extent[2], extent[4]);
  return glm::translate(toGlm(data->GetIndexToPhysicalMatrix()), first + (isOfCells ? 0.5 : 0.0));
}

/// Return all that a volume is read from, as times and values.
std::vector<double> sourceOf(
  vtkVolume* volume, vtkVolumeMapper* mapper, vtkImageData* data, vtkDataArray* array)
{
  std::vector<double> source;
  const auto addTime = [&](vtkObject* of)
  { source.push_back(of ? static_cast<double>(of->GetMTime()) : 0.0); };
  addTime(volume->GetProperty());
  addTime(data);
  addTime(array);
  vtkImageData* const mask = maskOf(mapper);
  addTime(mask);
  addTime(mask ? scalarsOf(mapper, mask).array : nullptr);
  source.push_back(mapper->GetCropping());
  source.push_back(mapper->GetCroppingRegionFlags());
  source.insert(
    source.end(), mapper->GetCroppingRegionPlanes(), mapper->GetCroppingRegionPlanes() + 6);
  if (auto* const gpu = vtkGPUVolumeRayCastMapper::SafeDownCast(mapper))
  {
    source.push_back(gpu->GetScalarOpacityRangeType());
    source.push_back(gpu->GetGradientOpacityRangeType());
  }
  return source;
}

/// Read a volume but for its places in the world.
std::shared_ptr<Volume> readVolume(
  vtkVolume* volume, vtkVolumeMapper* mapper, vtkImageData* data, const MappedScalars& scalars)
{
  vtkVolumeProperty* const property = volume->GetProperty();
  auto read = std::make_shared<Volume>();
  read->samples = samplesOf(data, scalars.isOfCells);
  read->isOfCells = scalars.isOfCells;
  read->interpolates = property->GetInterpolationType() == VTK_LINEAR_INTERPOLATION;
  read->modelFromIndex = modelFromIndex(data, scalars.isOfCells);
  read->scalars = floatsOf(scalars.array);
  read->components = scalars.array->GetNumberOfComponents();
  const bool hasGradients = property->HasGradientOpacity();
  const bool areIndependent = property->GetIndependentComponents() != 0;
  const int count = areIndependent ? read->components : 1;
  for (int table = 0; table < count; ++table)
  {
    const int component = areIndependent ? table : read->components - 1;
    read->opacities.push_back(opacityOf(volume, scalars.array, component, table, hasGradients));
  }
  setCropping(mapper, *read);
  setMask(mapper, *read);
  return read;
}

} // namespace

void VolumeReading::beginFrame()
{
  forgetUnasked(this->known_);
}

std::vector<std::shared_ptr<const Volume>> VolumeReading::find(
  vtkVolume* volume, vtkMatrix4x4* matrix, const char*& why)
{
  auto* const mapper = vtkVolumeMapper::SafeDownCast(volume->GetMapper());
  if (!mapper || volume->IsA("vtkMultiVolume"))
  {
    why = volume->GetMapper() ? "its mapper draws no single image" : nullptr;
    return {};
  }
  if (mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->GetInputAlgorithm()->UpdateWholeExtent();
  }
  std::vector<std::shared_ptr<const Volume>> found;
  for (vtkImageData* const image : imagesOf(mapper))
  {
    why = whyNoMedium(volume, mapper, image);
    if (why)
    {
      return {};
    }
    if (auto block = this->findBlock(volume, matrix, image, found.size()))
    {
      found.push_back(std::move(block));
    }
  }
  return found;
}

std::shared_ptr<const Volume> VolumeReading::findBlock(
  vtkVolume* volume, vtkMatrix4x4* matrix, vtkImageData* data, std::size_t block)
{
  auto* const mapper = static_cast<vtkVolumeMapper*>(volume->GetMapper());
  const MappedScalars scalars = scalarsOf(mapper, data);
  const glm::dmat4 worldFromModel = toGlm(matrix);
  const glm::ivec3 samples = samplesOf(data, scalars.isOfCells);
  if (!scalars.array || std::min({ samples.x, samples.y, samples.z }) < 2 ||
    !(std::abs(glm::determinant(worldFromModel)) > 0.0))
  {
    return nullptr;
  }
  Known& known = this->known_[{ volume, block }];
  known.asked = true;
  std::vector<double> source = sourceOf(volume, mapper, data, scalars.array);
  const std::vector<glm::dvec4> clipPlanes = clipPlanesOf(mapper);
  const bool isSame = known.volume && known.array == scalars.array && known.source == source;
  if (isSame && known.volume->worldFromModel == worldFromModel &&
    known.volume->clipPlanesWorld == clipPlanes)
  {
    return known.volume;
  }
  const std::shared_ptr<Volume> read =
    isSame ? std::make_shared<Volume>(*known.volume) : readVolume(volume, mapper, data, scalars);
  read->worldFromModel = worldFromModel;
  read->clipPlanesWorld = clipPlanes;
  known.array = scalars.array;
  known.source = std::move(source);
  known.volume = read;
  return read;
}

std::size_t VolumeReading::bytes() const
{
  std::size_t bytes = 0;
  for (const auto& entry : this->known_)
  {
    bytes += entry.second.volume ? entry.second.volume->bytes() : 0;
  }
  return bytes;
}

} // namespace gnomon
