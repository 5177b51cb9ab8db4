#include "vtkGnomonVisibilityFilter.h"

#include "lights/NumberSetters.h"
#include "lights/vtkGnomonSun.h"
#include "plugin/data/AddedLights.h"
#include "plugin/data/DataScene.h"
#include "plugin/data/ReceiverStarts.h"
#include "plugin/data/SkyRun.h"
#include "plugin/data/VisibilityRun.h"
#include "plugin/scene/SurfaceExtraction.h"
#include "shadowtech/sky/SkyPatches.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
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

namespace
{

/// The end of errors of directions with hours.
const char* const givesNoLight =
  " hours gives no light, expected a finite vector with a length and hours of at least 0.";

/// The inputs that determine the results. Objects count by their times of change, settings by their
/// values, since an abort also changes the filter's own time.
struct Key
{
  std::vector<std::pair<const void*, vtkMTimeType>> objects;
  std::vector<double> settings;

  bool operator==(const Key& other) const
  {
    return this->objects == other.objects && this->settings == other.settings;
  }
};

/// The arrays of an execution.
struct Results
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  gnomon::VisibilityArrays pointers{};

  /// Add an array of one tuple for each element, all equal at first.
  /// @return its numbers
  template <typename Array>
  auto* add(const char* name, vtkIdType count, int components, double value)
  {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    array->Fill(value);
    this->arrays.push_back(array);
    return array->GetPointer(0);
  }
};

} // namespace

/// Each member refers to those above it.
struct vtkGnomonVisibilityFilter::Internals
{
  std::vector<gnomon::AddedLight> lights;
  gnomon::SkyModel skyModel = gnomon::SkyModel::Uniform;
  int skyDirections = 0; ///< 0: there is no sky
  vtkTimeStamp lightsTime;
  bool unfinished = false;
  vtkTimeStamp unfinishedTime;

  Key sceneKey;
  std::optional<gnomon::DataScene> scene;
  std::optional<gnomon::EmbreeTracer> tracer;

  Key runKey;
  Results results;
  std::optional<gnomon::ReceiverStarts> starts;
  std::optional<gnomon::VisibilityRun> run; ///< of the lights, if there are any
  std::optional<gnomon::SkyRun> skyRun;     ///< of the sky, if there is one
  bool finished = false;
  std::uint64_t rays = 0;

  void dropRun()
  {
    this->run.reset();
    this->skyRun.reset();
    this->starts.reset();
  }
  /// Continue until all is done or goOn() returns false.
  /// @param goOn called with the completed share
  /// @return true if all is done
  bool go(const std::function<bool(double)>& goOn)
  {
    const double ofLights =
      static_cast<double>(this->lights.size()) * static_cast<double>(this->starts->samples());
    const double all = ofLights + this->skyDirections;
    const bool isDone =
      (!this->run || this->run->go([&](double share) { return goOn(share * ofLights / all); })) &&
      (!this->skyRun ||
        this->skyRun->go(
          [&](double share) { return goOn((ofLights + share * this->skyDirections) / all); }));
    this->rays = (this->run ? this->run->rays() : 0) + (this->skyRun ? this->skyRun->rays() : 0);
    return isDone;
  }
  void dropScene()
  {
    this->dropRun();
    this->results = {};
    this->finished = false;
    this->runKey = {};
    this->tracer.reset();
    this->scene.reset();
    this->sceneKey = {};
  }
};

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
void vtkGnomonVisibilityFilter::AddDirection(const double towards[3], double hours)
{
  if (!gnomon::isDirection(glm::make_vec3(towards)) || !gnomon::areHours(hours))
  {
    vtkErrorMacro("Direction " << this->GetNumberOfLights() << " (" << towards[0] << ", "
                               << towards[1] << ", " << towards[2] << ") with " << hours
                               << givesNoLight);
    return;
  }
  this->Internal->lights.push_back({ glm::normalize(glm::make_vec3(towards)), hours, nullptr });
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirection(double x, double y, double z, double hours)
{
  const double towards[3] = { x, y, z };
  this->AddDirection(towards, hours);
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirections(vtkDataArray* directions, vtkDataArray* hours)
{
  if (!directions || directions->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("Directions need an array of three components.");
    return;
  }
  const vtkIdType count = directions->GetNumberOfTuples();
  if (hours && (hours->GetNumberOfComponents() != 1 || hours->GetNumberOfTuples() != count))
  {
    vtkErrorMacro("The hours of " << count
                                  << " directions need an array of as many numbers, not of "
                                  << hours->GetNumberOfTuples() << " tuples with "
                                  << hours->GetNumberOfComponents() << " components.");
    return;
  }
  std::vector<gnomon::AddedLight> added;
  for (vtkIdType i = 0; i < count; ++i)
  {
    glm::dvec3 towards;
    directions->GetTuple(i, &towards.x);
    const double time = hours ? hours->GetComponent(i, 0) : 1.0;
    if (!gnomon::isDirection(towards) || !gnomon::areHours(time))
    {
      vtkErrorMacro("Tuple " << i << " of the directions (" << towards.x << ", " << towards.y
                             << ", " << towards.z << ") with " << time << givesNoLight);
      return;
    }
    added.push_back({ glm::normalize(towards), time, nullptr });
  }
  std::vector<gnomon::AddedLight>& lights = this->Internal->lights;
  lights.insert(lights.end(), added.begin(), added.end());
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSunDay(vtkGnomonSun* sun, double stepMinutes)
{
  if (!sun)
  {
    vtkErrorMacro("There is no sun to add a day of.");
    return;
  }
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  if (sun->MakeDayPath(stepMinutes, directions, hours))
  {
    this->SetUp(sun->GetUp());
    this->AddDirections(directions, hours);
  }
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSunYear(vtkGnomonSun* sun, int dayStep, double stepMinutes)
{
  if (!sun)
  {
    vtkErrorMacro("There is no sun to add a year of.");
    return;
  }
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  if (sun->MakeYearPath(dayStep, stepMinutes, directions, hours))
  {
    this->SetUp(sun->GetUp());
    this->AddDirections(directions, hours);
  }
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddLight(vtkLight* light, double hours)
{
  if (!light || !gnomon::areHours(hours))
  {
    vtkErrorMacro("Light " << this->GetNumberOfLights() << (light ? "" : ", which is null,")
                           << " with " << hours
                           << " hours cannot be added, expected a number of at least 0.");
    return;
  }
  this->Internal->lights.push_back({ {}, hours, light });
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSky(int model, int directions)
{
  if (model < UNIFORM || model > OVERCAST)
  {
    vtkErrorMacro(
      "A sky of model " << model << " does not exist: 0 is uniform, 1 a dome, 2 overcast.");
    return;
  }
  if (!gnomon::SkyDirections::isCount(directions))
  {
    vtkErrorMacro(
      "A sky takes a power of two in [16, 65536] as directions, not " << directions << ".");
    return;
  }
  this->Internal->skyModel = static_cast<gnomon::SkyModel>(model);
  this->Internal->skyDirections = directions;
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSkyPatches(const double up[3], const double north[3])
{
  const glm::dvec3 zenith = glm::make_vec3(up);
  const glm::dvec3 ahead = glm::make_vec3(north);
  if (!gnomon::isDirection(zenith) || !gnomon::isDirection(ahead) ||
    !gnomon::isDirection(glm::cross(glm::normalize(zenith), glm::normalize(ahead))))
  {
    vtkErrorMacro("The sky's up (" << up[0] << ", " << up[1] << ", " << up[2] << ") and north ("
                                   << north[0] << ", " << north[1] << ", " << north[2]
                                   << ") are to be two directions.");
    return;
  }
  this->SetUp(up);
  for (const gnomon::SkyPatch& patch :
    gnomon::skyPatches(glm::normalize(zenith), glm::normalize(ahead)))
  {
    this->AddDirection(&patch.towards.x, patch.solidAngle);
  }
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetSkyModel()
{
  return static_cast<int>(this->Internal->skyModel);
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetSkyDirections()
{
  return this->Internal->skyDirections;
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
void vtkGnomonVisibilityFilter::ClearLights()
{
  this->Internal->lights.clear();
  this->Internal->skyDirections = 0;
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetNumberOfLights()
{
  return static_cast<int>(this->Internal->lights.size());
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::GetDirection(int index, double towards[3])
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  const glm::dvec3 direction = added ? added->towards : glm::dvec3(0.0);
  std::copy_n(&direction.x, 3, towards);
}

//------------------------------------------------------------------------------
vtkLight* vtkGnomonVisibilityFilter::GetLight(int index)
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  return added ? added->light : nullptr;
}

//------------------------------------------------------------------------------
double vtkGnomonVisibilityFilter::GetHours(int index)
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  return added ? added->hours : 0.0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkGnomonVisibilityFilter::GetNumberOfRays()
{
  return static_cast<vtkTypeInt64>(this->Internal->rays);
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

Key sceneKeyOf(const std::vector<gnomon::DataScene::Input>& inputs)
{
  Key key;
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
  Results& results = internal.results = {};
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
    Key sceneKey = sceneKeyOf(inputs);
    if (!internal.scene || !(internal.sceneKey == sceneKey))
    {
      internal.dropScene();
      internal.scene.emplace(inputs);
      internal.tracer.emplace();
      internal.tracer->update(internal.scene->occluders());
      internal.sceneKey = sceneKey;
    }

    Key runKey = std::move(sceneKey);
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
