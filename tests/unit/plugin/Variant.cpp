#include "Variant.h"

#include <cctype>
#include <iterator>
#include <numeric>

namespace gnomon::test
{
namespace
{

/// Return the value of a setting; empty if the variant leaves it as it is.
std::string valueOf(const Variant& variant, const std::string& setting)
{
  const std::size_t place = variant.text.find(" " + setting + "=");
  const std::size_t begin = place + setting.size() + 2;
  return place == std::string::npos
    ? ""
    : variant.text.substr(begin, variant.text.find(' ', begin) - begin);
}

const char* const otherVariants[] = {
  // depths, compared point by point or filtered, and soft shadows
  // maps
  "nsm fit=frame",
  "nsm fit=frame snap=off",
  "pssm snap=off",
  "nsm metric=euclidean",
  "tsm metric=euclidean",
  "pcf metric=euclidean",
  "pcf fit=frame",
  "lispsm fit=frame",
  "pcf bias_constant=0.01 bias_slope=2",
  // kernels
  "pcf kernel_size=1",
  "pcf kernel_size=8",
  "pcf kernel=box kernel_size=1",
  "pcf kernel=box kernel_size=4",
  "pcf kernel=box kernel_size=9",
  "pcf kernel=poisson kernel_size=6",
  "pcf kernel=poisson kernel_size=32",
  "pcf kernel=castano kernel_size=3",
  "pcf kernel=castano kernel_size=7",
  "pcf kernel_width=0.1",
  "pcf kernel=poisson kernel_width=1",
  "lispsm estimator=pcf",
  "lispsm estimator=pcf kernel=poisson kernel_size=8",
  "lispsm estimator=pcf kernel=box kernel_size=17",
  "lispsm estimator=pcf kernel=box kernel_width=0.1",
  "tsm estimator=pcf",
  "tsm estimator=pcf kernel=castano kernel_size=7",
  "tsm estimator=pcf kernel=box kernel_size=9",
  "adaptive kernel_size=10",
  "adaptive kernel_size=10 early_out=ring",
  "lispsm estimator=adaptive kernel_size=6",
  // areas of light
  "pcss light_radius=0.05",
  "pcss light_radius=0.53",
  "pcss light_radius=4",
  "pcss light_radius=10",
  "lispsm estimator=pcss light_radius=0.05",
  "tsm estimator=pcss light_radius=0.05 metric=euclidean",
  "montecarlo light_radius=0.02",
  "montecarlo light_radius=0.5",
  "sampled light_radius=0.5 light_samples=4",
  "coherence light_radius=0.5",
  "penumbra light_radius=0.5",
  "raytraced light_radius=0.5 light_samples=16",
  "planar light_radius=0.5 light_samples=4",
  // moments
  "esm projection=pssm",
  "vsm fit=frame",
  "vsm projection=lispsm",
  "vsm projection=tsm",
  "vsm projection=pssm",
  "evsm projection=lispsm",
  "evsm projection=pssm",
  "msm projection=lispsm",
  "msm projection=pssm",
  "vsm blur=sat",
  "vsm fit=frame blur=sat",
  "vsm projection=lispsm blur=sat",
  "msm blur=sat",
  "msm projection=tsm blur=sat",
  "msm projection=pssm blur=sat",
  "vsm mip_maps=on",
  "evsm mip_maps=on",
  "msm mip_maps=on",
  "evsm projection=pssm mip_maps=on",
  "msm projection=lispsm mip_maps=on",
  "vsm map_samples=4",
  "evsm projection=lispsm map_samples=4 kernel_size=1",
  "msm blur=sat map_samples=4",
  // kernels, which change what maps hold
  "esm kernel_size=16",
  "vsm kernel_size=1",
  "vsm kernel_size=16",
  "vsm projection=lispsm kernel_size=16",
  "vsm projection=tsm kernel_size=1",
  "vsm fit=frame blur=sat kernel_size=16",
  "evsm kernel_size=1",
  "evsm projection=pssm kernel_size=16",
  "msm kernel_size=1",
  "msm projection=lispsm kernel_size=16",
  "msm projection=tsm blur=sat kernel_size=16",
  "msm mip_maps=on kernel_size=16",
};

} // namespace

std::string Variant::technique() const
{
  return this->text.substr(0, this->text.find(' '));
}

const TechniqueInfo& Variant::info() const
{
  const std::string estimator = valueOf(*this, "estimator");
  return estimator.empty() ? findTechnique(this->technique())->estimator->info
                           : findEstimator(estimator)->info;
}

void Variant::set(vtkGnomonShadowPass* pass, const char* name, const std::string& value) const
{
  if (has(this->info(), name))
  {
    pass->SetSetting(name, value.c_str());
  }
}

std::vector<int> Variant::mapSizes(std::vector<int> sizes) const
{
  sizes.resize(this->info().bakesMap() ? sizes.size() : 1);
  return sizes;
}

bool Variant::takesCubes() const
{
  const std::string projection = valueOf(*this, "projection");
  return projection.empty() ? findTechnique(this->technique())->projection == Projection::Uniform
                            : projection == "uniform";
}

bool Variant::hasSetting(const std::string& nameAndValue) const
{
  return (this->text + " ").find(" " + nameAndValue + " ") != std::string::npos;
}

std::string Variant::name() const
{
  std::string name = this->text;
  for (char& letter : name)
  {
    letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  }
  return name;
}

const std::vector<Variant>& variants()
{
  static const std::vector<Variant> all = []
  {
    std::vector<Variant> result;
    for (const TechniqueEntry& technique : registry())
    {
      result.push_back({ technique.name });
    }
    for (const char* text : otherVariants)
    {
      result.push_back({ text });
    }
    return result;
  }();
  return all;
}

std::vector<Variant> variantsThat(const std::function<bool(const Variant&)>& isSuch)
{
  std::vector<Variant> such;
  std::copy_if(variants().begin(), variants().end(), std::back_inserter(such), isSuch);
  return such;
}

std::vector<Variant> someVariants(
  const std::string& test, const std::function<bool(const Variant&)>& isFor)
{
  const int place = std::accumulate(test.begin(), test.end(), 0); // the same on all machines
  int placeOfDefault = place;
  int placeOfOther = place;
  return variantsThat(
    [&](const Variant& variant)
    {
      const bool isDefault = variant.isDefault();
      return isFor(variant) && (isDefault ? ++placeOfDefault % 2 == 0 : ++placeOfOther % 8 == 0);
    });
}

} // namespace gnomon::test
