// The settings of vtkGnomonShadowPass, and what it tells of its last frame.
#include "vtkGnomonShadowPassInternals.h"

#include "lights/NumberSetters.h"
#include "lights/SettingsTable.h"
#include "plugin/frame/VisibilityData.h"
#include "plugin/pass/ReportText.h"
#include "plugin/pass/SettingsText.h"
#include "shadowtech/Registry.h"
#include "shadowtech/sky/Sky.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace
{

gnomon::ChoiceSetting powersOfTwo(int least, int most)
{
  gnomon::ChoiceSetting powers;
  for (int power = least; power <= most; power *= 2)
  {
    powers.names.push_back(std::to_string(power));
  }
  return powers;
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMaximumError(double share)
{
  gnomon::setWithin(this, "MaximumError", share, 0.0, 1.0, this->MaximumError);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMaximumSoftError(double rootMeanSquare)
{
  gnomon::setWithin(this, "MaximumSoftError", rootMeanSquare, 0.0, 1.0, this->MaximumSoftError);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetTimeBudget(double milliseconds)
{
  const bool isTime = milliseconds >= 0.0 && milliseconds <= VTK_DOUBLE_MAX; // NaN is none
  if (!isTime && milliseconds != GNOMON_TIME_BUDGET_OF_WINDOW)
  {
    vtkErrorMacro("TimeBudget was to be " << milliseconds
                                          << ", expected a number of at least 0, or "
                                             "GNOMON_TIME_BUDGET_OF_WINDOW (-1).");
    return;
  }
  gnomon::assign(this, &this->TimeBudget, &milliseconds);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMemoryBudget(double mebibytes)
{
  gnomon::setWithin(this, "MemoryBudget", mebibytes, 0.0, 1e9, this->MemoryBudget);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSkyIntensity(double intensity)
{
  gnomon::setWithin(this, "SkyIntensity", intensity, 0.0, 1e6, this->SkyIntensity);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSkyColor(double red, double green, double blue)
{
  const double rgb[3] = { red, green, blue };
  if (!std::all_of(rgb, rgb + 3, [](double value) { return value >= 0.0 && value <= 1.0; }))
  {
    vtkErrorMacro(<< "SkyColor was to be " << red << ", " << green << ", " << blue
                  << ", expected numbers in [0, 1].");
    return;
  }
  gnomon::assign(this, this->SkyColor, rgb, 3);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSkyDistance(double distance)
{
  gnomon::setWithin(this, "SkyDistance", distance, 0.0, VTK_DOUBLE_MAX, this->SkyDistance);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSkyUp(double x, double y, double z)
{
  const double length = glm::length(glm::dvec3(x, y, z));
  if (!(length > 0.0 && std::isfinite(length)))
  {
    vtkErrorMacro(<< "SkyUp was to be (" << x << ", " << y << ", " << z
                  << "), expected a finite vector with a length.");
    return;
  }
  const double up[3] = { x, y, z };
  gnomon::assign(this, this->SkyUp, up, 3);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSkyDirections(int directions)
{
  if (!gnomon::SkyDirections::isCount(directions))
  {
    vtkErrorMacro(<< "SkyDirections was to be " << directions
                  << ", expected a power of two in [16, 65536].");
    return;
  }
  if (this->SkyDirections != directions)
  {
    this->SkyDirections = directions;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::ReadCostFactors(const char* path)
{
  try
  {
    this->Internal->factors =
      path && *path ? std::optional(gnomon::readFactors(path)) : std::nullopt;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cost factors: " << error.what() << ".");
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSettings(vtkGnomonShadowSettings* settings)
{
  vtkSmartPointer<vtkGnomonShadowSettings>& held = this->Internal->settings;
  if (settings != held)
  {
    held = settings;
    if (!settings)
    {
      held = vtkSmartPointer<vtkGnomonShadowSettings>::New();
    }
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkGnomonShadowSettings* vtkGnomonShadowPass::GetSettings()
{
  return this->Internal->settings;
}

//------------------------------------------------------------------------------
/// A setting of the sky, which the pass has beside those of lights.
struct vtkGnomonShadowPass::SkySetting
{
  std::string name;
  gnomon::SettingValues values;
  void (*set)(vtkGnomonShadowPass*, const gnomon::SettingValue&);
  gnomon::SettingValue (*get)(const vtkGnomonShadowPass*);

  /// Return the setting with this name; nullptr without one.
  static const SkySetting* find(const char* name)
  {
    using Pass = vtkGnomonShadowPass;
    using Value = gnomon::SettingValue;
    static const std::array<SkySetting, 4> settings{ {
      { "sky_intensity", gnomon::RealSetting{ 0.0, 1e6 },
        [](Pass* pass, const Value& value) { pass->SetSkyIntensity(std::get<double>(value)); },
        [](const Pass* pass) { return Value(pass->SkyIntensity); } },
      { "sky_model", gnomon::ChoiceSetting{ { "uniform", "dome", "overcast" } },
        [](Pass* pass, const Value& value) { pass->SetSkyModel(std::get<int>(value)); },
        [](const Pass* pass) { return Value(pass->SkyModel); } },
      { "sky_distance", gnomon::anyLength,
        [](Pass* pass, const Value& value) { pass->SetSkyDistance(std::get<double>(value)); },
        [](const Pass* pass) { return Value(pass->SkyDistance); } },
      { "sky_directions", powersOfTwo(16, 65536),
        [](Pass* pass, const Value& value) { pass->SetSkyDirections(16 << std::get<int>(value)); },
        [](const Pass* pass) { return Value(std::ilogb(pass->SkyDirections / 16)); } },
    } };
    const auto found = std::find_if(settings.begin(), settings.end(),
      [&](const SkySetting& setting) { return name && setting.name == name; });
    return found == settings.end() ? nullptr : &*found;
  }
};

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetSetting(const char* name, const char* value)
{
  std::optional<std::string>& skyError = this->Internal->skyError;
  skyError.reset();
  if (const SkySetting* const sky = SkySetting::find(name))
  {
    const std::string text = value ? value : "";
    const std::optional<gnomon::SettingValue> read = gnomon::readValue(sky->values, text);
    skyError = read ? "" : gnomon::errorOf(sky->name, sky->values, text);
    if (read)
    {
      sky->set(this, *read);
    }
    else
    {
      vtkErrorMacro(<< *skyError << ".");
    }
    return read.has_value();
  }
  const vtkMTimeType before = this->Internal->settings->GetMTime();
  const bool isSet = this->Internal->settings->TrySetting(name, value);
  if (!isSet)
  {
    vtkErrorMacro(<< this->GetSettingError() << ".");
  }
  else if (this->Internal->settings->GetMTime() != before)
  {
    this->Modified();
  }
  return isSet;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetSetting(const char* name, double number)
{
  return this->SetSetting(name, gnomon::textOfNumber(name ? name : "", number).c_str());
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetSettingsText()
{
  return gnomon::textOfSettings();
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetSettingError() const
{
  return this->Internal->skyError.value_or(this->Internal->settings->GetSettingError());
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetSetting(const char* name) const
{
  const SkySetting* const sky = SkySetting::find(name);
  return sky ? gnomon::textOf(sky->values, sky->get(this))
             : this->Internal->settings->GetSetting(name);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMapSize(int mapSizeTexels)
{
  const vtkMTimeType before = this->Internal->settings->GetMTime();
  this->Internal->settings->SetMapSize(mapSizeTexels);
  if (this->Internal->settings->GetMTime() != before)
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGnomonShadowPass::GetMapSize() const
{
  return this->Internal->settings->GetMapSize();
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetTechnique(const char* name)
{
  return this->SetSetting("technique", name);
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechnique() const
{
  const std::string& technique = this->Internal->settings->GetValues().technique;
  return technique.empty() ? gnomon::defaultTechnique : technique.c_str();
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetDefaultTechnique()
{
  return gnomon::defaultTechnique;
}

//------------------------------------------------------------------------------
int vtkGnomonShadowPass::GetNumberOfTechniques()
{
  return static_cast<int>(gnomon::registry().size());
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueName(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].name.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueSummary(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].summary.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueSummary(const char* name)
{
  const std::string wanted = name ? name : "";
  const gnomon::TechniqueEntry* const technique = gnomon::findTechnique(wanted);
  return wanted == gnomon::automaticTechnique ? gnomon::automaticSummary
    : technique                               ? technique->summary.c_str()
                                              : nullptr;
}

//------------------------------------------------------------------------------
const gnomon::FrameReport& vtkGnomonShadowPass::GetReport() const
{
  return this->Internal->shadowed ? this->Internal->manager().report() : this->Internal->report;
}

//------------------------------------------------------------------------------
double vtkGnomonShadowPass::GetProgress() const
{
  return this->Internal->progress;
}

//------------------------------------------------------------------------------
const gnomon::VisibilityImages& vtkGnomonShadowPass::GetVisibility() const
{
  return this->Internal->shadowed ? this->Internal->manager().visibility()
                                  : this->Internal->visibility;
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetReportText() const
{
  return gnomon::textOf(this->GetReport());
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::GetReportTable(vtkTable* lights) const
{
  if (!lights)
  {
    vtkErrorMacro("The report needs a table to fill.");
    return;
  }
  gnomon::fillTable(this->GetReport(), lights);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::GetVisibilityImage(vtkImageData* image) const
{
  if (!image)
  {
    vtkErrorMacro("The visibility needs an image to fill.");
    return;
  }
  gnomon::fillImage(this->GetVisibility(), image);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkGnomonShadowPass::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->settings->GetMTime());
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const routes[] = { "auto", "inline", "image", "deferred" };
  os << indent << "Settings:\n";
  this->Internal->settings->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Route: " << routes[this->Route] << "\n";
  os << indent << "SmoothTerminators: " << (this->SmoothTerminators ? "on" : "off") << "\n";
  const char* const castings[] = { "auto", "all", "brightest" };
  os << indent << "Casting: " << castings[this->Casting] << "\n";
  const char* const interactives[] = { "auto", "off", "on" };
  os << indent << "Interactive: " << interactives[this->Interactive] << "\n";
  os << indent << "MaximumError: " << this->MaximumError << "\n";
  os << indent << "MaximumSoftError: " << this->MaximumSoftError << "\n";
  os << indent << "TimeBudget: " << this->TimeBudget << " ms\n";
  os << indent << "MemoryBudget: " << this->MemoryBudget << " MiB\n";
  os << indent << "TranslucentCasters: " << this->TranslucentCasters << "\n";
  os << indent << "VolumesReceive: " << this->VolumesReceive << "\n";
  os << indent << "VolumeCasters: " << this->VolumeCasters << "\n";
  os << indent << "VolumeResolution: " << this->VolumeResolution << "\n";
  os << indent << "SkyIntensity: " << this->SkyIntensity << "\n";
  os << indent << "SkyColor: " << this->SkyColor[0] << ", " << this->SkyColor[1] << ", "
     << this->SkyColor[2] << "\n";
  os << indent << "SkyModel: " << this->SkyModel << "\n";
  os << indent << "SkyUp: " << this->SkyUp[0] << ", " << this->SkyUp[1] << ", " << this->SkyUp[2]
     << "\n";
  os << indent << "SkyDistance: " << this->SkyDistance << "\n";
  os << indent << "SkyDirections: " << this->SkyDirections << "\n";
  os << indent << "CostFactors: " << (this->Internal->factors ? "read" : "default") << "\n";
  os << indent << "MeasureStages: " << (this->MeasureStages ? "on" : "off") << "\n";
  os << indent << "KeepVisibility: " << (this->KeepVisibility ? "on" : "off") << "\n";
  os << indent
     << "DelegatePass: " << (this->DelegatePass ? this->DelegatePass->GetClassName() : "(none)")
     << "\n";
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)")
     << "\n";
  os << indent << "ImageReductionFactor: " << this->ImageReductionFactor << "\n";
  os << indent << "ObeyUseShadows: " << (this->ObeyUseShadows ? "on" : "off") << "\n";
  os << indent << "Progress: " << this->GetProgress() << "\n";
  os << indent << "Last frame's route: " << this->GetReport().route << "\n";
}
