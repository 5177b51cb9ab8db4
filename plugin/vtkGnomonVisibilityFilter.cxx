#include "vtkGnomonVisibilityFilter.h"

#include "lights/LightManager.h"
#include "lights/vtkGnomonSun.h"
#include "plugin/data/DataScene.h"
#include "plugin/data/ReceiverStarts.h"
#include "plugin/data/VisibilityRun.h"
#include "plugin/scene/SurfaceExtraction.h"
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
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace
{

/// A light as the user added it.
struct AddedLight
{
  glm::dvec3 towards{ 0.0 }; ///< of a direction: unit
  double hours = 0.0;
  vtkSmartPointer<vtkLight> light; ///< null for a direction
};

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

bool isDirection(const glm::dvec3& vector)
{
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length);
}

bool areHours(double hours)
{
  return hours >= 0.0 && std::isfinite(hours);
}

/// Return two unit vectors across a unit vector (Duff et al., JCGT 6(1), 2017).
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& n)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return { { 1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x },
    { b, sign + n.y * n.y * a, -n.y } };
}

/// Return an array of one number for each element, all equal at first.
template <typename Array, typename Value>
vtkSmartPointer<Array> arrayOf(const char* name, vtkIdType count, int components, Value value)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  array->Fill(static_cast<double>(value));
  return array;
}

/// The arrays of an execution.
struct Results
{
  vtkSmartPointer<vtkFloatArray> fraction;
  vtkSmartPointer<vtkFloatArray> error;
  vtkSmartPointer<vtkFloatArray> hours;
  vtkSmartPointer<vtkUnsignedCharArray> bits;
  vtkSmartPointer<vtkUnsignedCharArray> why;
  vtkSmartPointer<vtkIdTypeArray> blocker;
  vtkSmartPointer<vtkIntArray> blockerInput;

  gnomon::VisibilityArrays pointers() const
  {
    const auto of = [](const auto& array) { return array ? array->GetPointer(0) : nullptr; };
    return { of(this->hours), of(this->fraction), of(this->error), of(this->bits), of(this->why),
      of(this->blocker), of(this->blockerInput) };
  }
  void addTo(vtkDataSetAttributes* data) const
  {
    for (vtkDataArray* array :
      { static_cast<vtkDataArray*>(this->fraction), static_cast<vtkDataArray*>(this->error),
        static_cast<vtkDataArray*>(this->hours), static_cast<vtkDataArray*>(this->bits),
        static_cast<vtkDataArray*>(this->why), static_cast<vtkDataArray*>(this->blocker),
        static_cast<vtkDataArray*>(this->blockerInput) })
    {
      if (array)
      {
        data->AddArray(array);
      }
    }
  }
};

} // namespace

/// Each member refers to those above it.
struct vtkGnomonVisibilityFilter::Internals
{
  std::vector<AddedLight> lights;
  vtkTimeStamp lightsTime;
  bool unfinished = false;
  vtkTimeStamp unfinishedTime;

  Key sceneKey;
  std::optional<gnomon::DataScene> scene;
  std::optional<gnomon::EmbreeTracer> tracer;

  Key runKey;
  Results results;
  std::optional<gnomon::ReceiverStarts> starts;
  std::optional<gnomon::VisibilityRun> run;
  bool finished = false;
  std::uint64_t rays = 0;

  void dropRun()
  {
    this->run.reset();
    this->starts.reset();
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
  void add(const glm::dvec3& towards, double hours)
  {
    this->lights.push_back({ glm::normalize(towards), hours, nullptr });
  }
  /// @return null for a number that does not exist
  const AddedLight* find(int index) const
  {
    return index >= 0 && index < static_cast<int>(this->lights.size())
      ? &this->lights[static_cast<std::size_t>(index)]
      : nullptr;
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
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), internal.unfinishedTime.GetMTime());
  for (const AddedLight& added : internal.lights)
  {
    time = std::max(time, added.light ? gnomon::changeTime(added.light) : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirection(const double towards[3], double hours)
{
  if (!isDirection(glm::make_vec3(towards)) || !areHours(hours))
  {
    vtkErrorMacro("Direction " << this->GetNumberOfLights() << " (" << towards[0] << ", "
                               << towards[1] << ", " << towards[2] << ") with " << hours
                               << " hours gives no light.");
    return;
  }
  this->Internal->add(glm::make_vec3(towards), hours);
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
  std::vector<AddedLight> added;
  for (vtkIdType i = 0; i < count; ++i)
  {
    glm::dvec3 towards;
    directions->GetTuple(i, &towards.x);
    const double time = hours ? hours->GetComponent(i, 0) : 1.0;
    if (!isDirection(towards) || !areHours(time))
    {
      vtkErrorMacro("Tuple " << i << " of the directions (" << towards.x << ", " << towards.y
                             << ", " << towards.z << ") with " << time << " hours gives no light.");
      return;
    }
    added.push_back({ glm::normalize(towards), time, nullptr });
  }
  std::vector<AddedLight>& lights = this->Internal->lights;
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
  if (!light || !areHours(hours))
  {
    vtkErrorMacro("Light " << this->GetNumberOfLights() << (light ? "" : ", which is null,")
                           << " with " << hours << " hours cannot be added.");
    return;
  }
  this->Internal->lights.push_back({ {}, hours, light });
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::ClearLights()
{
  this->Internal->lights.clear();
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
  const AddedLight* const added = this->Internal->find(index);
  const glm::dvec3 direction = added ? added->towards : glm::dvec3(0.0);
  std::copy_n(&direction.x, 3, towards);
}

//------------------------------------------------------------------------------
vtkLight* vtkGnomonVisibilityFilter::GetLight(int index)
{
  const AddedLight* const added = this->Internal->find(index);
  return added ? added->light : nullptr;
}

//------------------------------------------------------------------------------
double vtkGnomonVisibilityFilter::GetHours(int index)
{
  const AddedLight* const added = this->Internal->find(index);
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
  if (!std::isfinite(glm::length(glm::dvec3(x, y, z))))
  {
    vtkErrorMacro("Up (" << x << ", " << y << ", " << z << ") is not finite.");
    return;
  }
  if (this->Up[0] != x || this->Up[1] != y || this->Up[2] != z)
  {
    this->Up[0] = x;
    this->Up[1] = y;
    this->Up[2] = z;
    this->Modified();
  }
}

namespace
{

/// Return the present inputs: the receivers, then the casters.
std::vector<gnomon::DataScene::Input> inputsOf(vtkInformationVector** input, bool receiversCast)
{
  std::vector<gnomon::DataScene::Input> inputs = { { vtkPolyData::GetData(input[0]),
    receiversCast } };
  for (int i = 0; i < input[1]->GetNumberOfInformationObjects(); ++i)
  {
    inputs.push_back({ vtkPolyData::GetData(input[1], i), true });
  }
  return inputs;
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
    key.settings.push_back(input.casts ? 1.0 : 0.0);
    // Cells of other kinds also count in the numbers of cells.
    key.settings.push_back(
      static_cast<double>(input.data->GetNumberOfVerts() + input.data->GetNumberOfLines()));
  }
  return key;
}

/// Return the lights as rays see them.
/// @param reason receives why one of them cannot shine
std::vector<gnomon::WeightedLight> weightedLights(const std::vector<AddedLight>& added,
  const gnomon::SceneFrame& frame, double diameterDegrees, std::string& reason)
{
  const double radius = std::tan(glm::radians(0.5 * diameterDegrees));
  std::vector<gnomon::WeightedLight> lights;
  lights.reserve(added.size());
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    gnomon::ShadowLight light;
    light.directionWorld = -added[i].towards;
    if (added[i].light)
    {
      std::string why;
      std::optional<gnomon::ShadowLight> place = gnomon::readPlace(added[i].light, why);
      why = place ? gnomon::enterFrame(*place, frame) : why;
      if (!why.empty())
      {
        reason = "light " + std::to_string(i) + ": " + why;
        return {};
      }
      light = *place;
    }
    gnomon::WeightedLight weighted{ { light, frame.centre }, added[i].hours };
    if (light.kind == gnomon::LightKind::Directional && !light.box)
    {
      const auto [x, y] = across(-light.directionWorld);
      weighted.discX = radius * x;
      weighted.discY = radius * y;
    }
    lights.push_back(weighted);
  }
  return lights;
}

} // namespace

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
  const std::vector<gnomon::DataScene::Input> inputs = inputsOf(input, this->ReceiversCast);
  vtkPolyData* const receivers = inputs.front().data;
  vtkPolyData* const result = vtkPolyData::GetData(output);
  result->ShallowCopy(receivers);

  const std::size_t lightCount = internal.lights.size();
  if (lightCount == 0)
  {
    vtkErrorMacro("There are no directions, suns or lights: add some.");
    return 1;
  }
  if (this->ExplainedLight >= static_cast<int>(lightCount) || this->ExplainedLight < -1)
  {
    vtkErrorMacro("The explained light " << this->ExplainedLight << " is none of the " << lightCount
                                         << " lights.");
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
    runKey.objects.emplace_back(this, internal.lightsTime.GetMTime());
    for (const AddedLight& added : internal.lights)
    {
      if (added.light)
      {
        runKey.objects.emplace_back(added.light, gnomon::changeTime(added.light));
      }
    }
    runKey.settings.insert(runKey.settings.end(),
      { this->AngularDiameter, static_cast<double>(samples), static_cast<double>(this->Elements),
        static_cast<double>(this->ReceivingSide), this->Up[0], this->Up[1], this->Up[2],
        this->ComputeBits ? 1.0 : 0.0, this->ComputeReasons ? 1.0 : 0.0,
        static_cast<double>(this->ExplainedLight) });
    if (!(internal.runKey == runKey))
    {
      internal.dropRun();
      internal.runKey = {};
      internal.finished = false;
      internal.rays = 0;
      std::string reason;
      gnomon::VisibilityRun::Plan plan;
      plan.lights = weightedLights(
        internal.lights, internal.scene->occluders().frame, this->AngularDiameter, reason);
      if (!reason.empty())
      {
        vtkErrorMacro("Shadows of " << reason << ".");
        return 1;
      }
      const glm::dvec3 up = glm::make_vec3(this->Up);
      plan.up = isDirection(up) ? glm::vec3(glm::normalize(up)) : glm::vec3(0.0f);
      plan.explained =
        this->ExplainedLight < 0 ? lightCount - 1 : static_cast<std::size_t>(this->ExplainedLight);
      plan.bothSides = this->ReceivingSide == BOTH;

      const vtkIdType count =
        ofPoints ? receivers->GetNumberOfPoints() : receivers->GetNumberOfCells();
      Results& results = internal.results = {};
      results.fraction = arrayOf<vtkFloatArray>(GetLitFractionName(), count, 1, 0);
      results.hours = arrayOf<vtkFloatArray>(GetHoursName(), count, 1, 0);
      if (samples > 1)
      {
        results.error = arrayOf<vtkFloatArray>(GetLitFractionErrorName(), count, 1, 0);
      }
      if (this->ComputeBits)
      {
        results.bits = arrayOf<vtkUnsignedCharArray>(
          GetBitsName(), count, static_cast<int>((lightCount + 7) / 8), 0);
      }
      if (this->ComputeReasons)
      {
        results.why = arrayOf<vtkUnsignedCharArray>(GetWhyName(), count, 1, NO_SURFACE);
        results.blocker = arrayOf<vtkIdTypeArray>(GetBlockerName(), count, 1, -1);
        results.blockerInput = arrayOf<vtkIntArray>(GetBlockerInputName(), count, 1, -1);
      }
      internal.starts.emplace(*internal.scene, ofPoints, samples, hasDisc,
        static_cast<gnomon::ReceivingSide>(this->ReceivingSide));
      internal.run.emplace(
        *internal.scene, *internal.starts, *internal.tracer, std::move(plan), results.pointers());
      internal.runKey = std::move(runKey);
    }

    if (!internal.finished)
    {
      internal.finished = internal.run->go(
        [this](double share)
        {
          this->UpdateProgress(share);
          return !this->GetAbortExecute();
        });
      internal.rays = internal.run->rays();
      internal.unfinished = !internal.finished;
    }
  }
  catch (const std::exception& error)
  {
    internal.dropScene();
    vtkErrorMacro("Shadows of " << receivers->GetNumberOfCells() << " cells with " << lightCount
                                << " lights: " << error.what() << ".");
    return 1;
  }
  if (internal.finished)
  {
    internal.dropRun();
    internal.results.addTo(ofPoints ? static_cast<vtkDataSetAttributes*>(result->GetPointData())
                                    : result->GetCellData());
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  os << indent << "AngularDiameter: " << this->AngularDiameter << "\n";
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
