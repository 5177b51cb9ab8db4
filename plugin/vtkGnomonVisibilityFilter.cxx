#include "vtkGnomonVisibilityFilterInternals.h"

#include "lights/NumberSetters.h"
#include "plugin/scene/SurfaceExtraction.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkGnomonVisibilityFilter);

//------------------------------------------------------------------------------
vtkGnomonVisibilityFilter::vtkGnomonVisibilityFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkGnomonVisibilityFilter::~vtkGnomonVisibilityFilter() = default;

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkGnomonVisibilityFilter::GetMTime()
{
  Internals& internal = *this->Internal;
  if (internal.unfinished)
  {
    internal.unfinishedTime.Modified();
  }
  return std::max({ this->Superclass::GetMTime(), internal.unfinishedTime.GetMTime(),
    gnomon::changeTime(internal.lights) });
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkGnomonVisibilityFilter::GetNumberOfRays()
{
  return static_cast<vtkTypeInt64>(this->Internal->rays);
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::SetSkyDistance(double distance)
{
  gnomon::setWithin(this, "SkyDistance", distance, 0.0, VTK_DOUBLE_MAX, this->SkyDistance);
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::SetAngularDiameter(double degrees)
{
  gnomon::setClamped(this, "AngularDiameter", degrees, 0.0, 89.0, this->AngularDiameter);
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::SetUp(double x, double y, double z)
{
  gnomon::setFinite(this, "Up", x, y, z, this->Up);
}

namespace
{

/// Return a vector's direction; 0 if it has none.
glm::vec3 unitUp(const double up[3])
{
  const glm::dvec3 vector = glm::make_vec3(up);
  return gnomon::isDirection(vector) ? glm::vec3(glm::normalize(vector)) : glm::vec3(0.0f);
}

gnomon::ExecutionKey sceneKeyOf(const std::vector<gnomon::DataScene::Input>& inputs)
{
  gnomon::ExecutionKey key;
  for (const gnomon::DataScene::Input& input : inputs)
  {
    for (const auto kind : { gnomon::SurfaceCells::Polygons, gnomon::SurfaceCells::Strips })
    {
      const bool hasPoints = input.data->GetPoints() != nullptr;
      key.objects.emplace_back(
        input.data, hasPoints ? gnomon::shapeTime(input.data, kind) : input.data->GetMTime());
    }
    // Cells of other kinds also count in the numbers of cells.
    const vtkIdType others = input.data->GetNumberOfVerts() + input.data->GetNumberOfLines();
    key.settings.insert(
      key.settings.end(), { input.casts ? 1.0 : 0.0, static_cast<double>(others) });
  }
  return key;
}

} // namespace

//------------------------------------------------------------------------------
/// Report what is missing for an execution.
bool vtkGnomonVisibilityFilter::CanRun()
{
  const Internals& internal = *this->Internal;
  const int lightCount = this->GetNumberOfLights();
  if (lightCount == 0 && internal.skyDirections == 0)
  {
    vtkErrorMacro("There are no directions, suns or lights, and no sky: add some.");
    return false;
  }
  if (internal.skyDirections > 0 && internal.skyModel != gnomon::SkyModel::Uniform &&
    unitUp(this->Up) == glm::vec3(0.0f))
  {
    vtkErrorMacro("The sky has a horizon, and up is (0, 0, 0): call SetUp().");
    return false;
  }
  if (lightCount > 0 && (this->ExplainedLight >= lightCount || this->ExplainedLight < -1))
  {
    vtkErrorMacro("The explained light " << this->ExplainedLight << " is none of the " << lightCount
                                         << " lights.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
/// Begin to trace what the filter has to compute.
/// @return false, with an error, if a light cannot shine
bool vtkGnomonVisibilityFilter::BeginRun(vtkPolyData* receivers, int samples)
{
  Internals& internal = *this->Internal;
  const std::size_t lightCount = internal.lights.size();
  const vtkIdType count =
    this->Elements == POINTS ? receivers->GetNumberOfPoints() : receivers->GetNumberOfCells();
  gnomon::ExecutionArrays& results = internal.results = {};
  internal.starts.emplace(*internal.scene, this->Elements == POINTS, samples,
    this->AngularDiameter > 0.0, static_cast<gnomon::ReceivingSide>(this->ReceivingSide));
  if (!internal.lights.empty())
  {
    std::string reason;
    gnomon::VisibilityRun::Plan plan;
    plan.lights = gnomon::weightedLights(
      internal.lights, internal.scene->occluders().frame, this->AngularDiameter, reason);
    if (!reason.empty())
    {
      vtkErrorMacro("Shadows of " << reason << ".");
      return false;
    }
    plan.up = unitUp(this->Up);
    plan.explained =
      this->ExplainedLight < 0 ? lightCount - 1 : static_cast<std::size_t>(this->ExplainedLight);
    plan.bothSides = this->ReceivingSide == BOTH;
    gnomon::VisibilityArrays& to = results.pointers;
    to.fraction = results.add<vtkFloatArray>(GetLitFractionName(), count, 1, 0);
    if (samples > 1)
    {
      to.error = results.add<vtkFloatArray>(GetLitFractionErrorName(), count, 1, 0);
    }
    to.hours = results.add<vtkFloatArray>(GetHoursName(), count, 1, 0);
    if (this->ComputeBits)
    {
      to.bits = results.add<vtkUnsignedCharArray>(
        GetBitsName(), count, static_cast<int>((lightCount + 7) / 8), 0);
    }
    if (this->ComputeReasons)
    {
      to.fate = results.add<vtkUnsignedCharArray>(GetWhyName(), count, 1, NO_SURFACE);
      to.blockerCell = results.add<vtkIdTypeArray>(GetBlockerName(), count, 1, -1);
      to.blockerInput = results.add<vtkIntArray>(GetBlockerInputName(), count, 1, -1);
    }
    internal.run.emplace(*internal.scene, *internal.starts, *internal.tracer, std::move(plan), to);
  }
  if (internal.skyDirections > 0)
  {
    gnomon::Sky sky{ internal.skyModel, unitUp(this->Up) };
    if (this->SkyDistance > 0.0)
    {
      sky.farthest =
        static_cast<float>(internal.scene->occluders().frame.unitsPerWorld() * this->SkyDistance);
    }
    const gnomon::SkyRun::Arrays to{ results.add<vtkFloatArray>(GetSkyViewName(), count, 1, 0),
      results.add<vtkFloatArray>(GetSkyViewErrorName(), count, 1, 0) };
    internal.skyRun.emplace(*internal.starts, *internal.tracer, sky, internal.skyDirections,
      this->ReceivingSide == BOTH, to);
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  // An abort is of one execution. Older releases of VTK clear it by themselves, newer ones do not.
  this->AbortExecute = 0;
  return this->Superclass::RequestUpdateExtent(request, input, output);
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::RequestData(
  vtkInformation* /*request*/, vtkInformationVector** input, vtkInformationVector* output)
{
  Internals& internal = *this->Internal;
  internal.unfinished = false;
  vtkPolyData* const receivers = vtkPolyData::GetData(input[0]);
  std::vector<gnomon::DataScene::Input> inputs = { { receivers, this->ReceiversCast } };
  for (int i = 0; i < input[1]->GetNumberOfInformationObjects(); ++i)
  {
    inputs.push_back({ vtkPolyData::GetData(input[1], i), true });
  }
  vtkPolyData* const result = vtkPolyData::GetData(output);
  result->ShallowCopy(receivers);

  if (!this->CanRun())
  {
    return 1;
  }
  const bool ofPoints = this->Elements == POINTS;
  const bool hasDisc = this->AngularDiameter > 0.0;
  const int samples = ofPoints && !hasDisc ? 1 : this->Samples;

  try
  {
    gnomon::ExecutionKey sceneKey = sceneKeyOf(inputs);
    if (!internal.scene || !(internal.sceneKey == sceneKey))
    {
      internal.dropScene();
      internal.scene.emplace(inputs);
      internal.tracer.emplace();
      internal.tracer->update(internal.scene->occluders());
      internal.sceneKey = sceneKey;
    }

    gnomon::ExecutionKey runKey = std::move(sceneKey);
    // Times grow, so the last change stands for all.
    runKey.objects.emplace_back(
      this, std::max(internal.lightsTime.GetMTime(), gnomon::changeTime(internal.lights)));
    runKey.settings.insert(runKey.settings.end(),
      { this->AngularDiameter, this->SkyDistance, static_cast<double>(samples),
        static_cast<double>(this->Elements), static_cast<double>(this->ReceivingSide), this->Up[0],
        this->Up[1], this->Up[2], this->ComputeBits ? 1.0 : 0.0, this->ComputeReasons ? 1.0 : 0.0,
        static_cast<double>(this->ExplainedLight) });
    if (!(internal.runKey == runKey))
    {
      internal.dropRun();
      internal.runKey = {};
      internal.finished = false;
      internal.rays = 0;
      if (!this->BeginRun(receivers, samples))
      {
        return 1;
      }
      internal.runKey = std::move(runKey);
    }

    if (!internal.finished)
    {
      internal.finished = internal.go(
        [this](double share)
        {
          this->UpdateProgress(share);
          return !this->GetAbortExecute();
        });
      internal.unfinished = !internal.finished;
    }
  }
  catch (const std::exception& error)
  {
    internal.dropScene();
    vtkErrorMacro("Shadows of " << receivers->GetNumberOfCells() << " cells with "
                                << this->GetNumberOfLights() << " lights: " << error.what() << ".");
    return 1;
  }
  if (internal.finished)
  {
    internal.dropRun();
    auto* const data =
      ofPoints ? static_cast<vtkDataSetAttributes*>(result->GetPointData()) : result->GetCellData();
    for (const vtkSmartPointer<vtkDataArray>& array : internal.results.arrays)
    {
      data->AddArray(array);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  os << indent << "AngularDiameter: " << this->AngularDiameter << "\n";
  os << indent << "SkyDirections: " << this->Internal->skyDirections << "\n";
  os << indent << "SkyDistance: " << this->SkyDistance << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Elements: " << (this->Elements == CELLS ? "Cells" : "Points") << "\n";
  os << indent << "ReceivingSide: "
     << (this->ReceivingSide == FRONT     ? "Front"
            : this->ReceivingSide == BACK ? "Back"
                                          : "Both")
     << "\n";
  os << indent << "ReceiversCast: " << (this->ReceiversCast ? "On" : "Off") << "\n";
  os << indent << "Up: " << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << "\n";
  os << indent << "ComputeBits: " << (this->ComputeBits ? "On" : "Off") << "\n";
  os << indent << "ComputeReasons: " << (this->ComputeReasons ? "On" : "Off") << "\n";
  os << indent << "ExplainedLight: " << this->ExplainedLight << "\n";
}

//------------------------------------------------------------------------------
/// Update a filter, for plugin/python/gnomon/data.py: foreign calls release Python's lock, which
/// VTK's wrappers hold.
extern "C" GNOMONPLUGIN_EXPORT void gnomonUpdate(vtkObjectBase* filter)
{
  vtkAlgorithm::SafeDownCast(filter)->Update();
}
