#ifndef gnomon_tests_unit_plugin_Variant_h
#define gnomon_tests_unit_plugin_Variant_h

#include "PassScene.h"

#include "shadowtech/Registry.h"

#include <ostream>
#include <string>
#include <vector>

namespace gnomon::test
{

/// A technique and settings, as "vsm blur=sat kernel_size=16".
struct Variant
{
  std::string text;

  std::string technique() const;
  /// As the settings choose it.
  const TechniqueInfo& info() const;
  ///@{
  /// Give them to the pass.
  void choose(vtkGnomonShadowPass* pass) const;
  void choose(PassScene& scene) const { this->choose(scene.pass); }
  ///@}
  /// Give the pass one more setting, if the technique has it.
  void set(vtkGnomonShadowPass* pass, const char* name, const std::string& value) const;
  /// Without a map one size is as good as several.
  std::vector<int> mapSizes(std::vector<int> sizes) const;
  /// Whether lights that see all around have it: warps and splits are for a single view.
  bool takesCubes() const;
  bool isMoments() const { return has(this->info(), "bleeding"); }
  bool hasSetting(const std::string& nameAndValue) const;
  /// For the tests' names: "vsm_blur_sat_kernel_size_16".
  std::string name() const;
};

inline std::ostream& operator<<(std::ostream& stream, const Variant& variant)
{
  return stream << variant.name();
}

/// All techniques of the registry, and those with other maps, kernels and areas of light.
const std::vector<Variant>& variants();

/// Those of them that a predicate holds for.
template <typename Predicate>
std::vector<Variant> variantsThat(Predicate predicate)
{
  std::vector<Variant> result;
  for (const Variant& variant : variants())
  {
    if (predicate(variant))
    {
      result.push_back(variant);
    }
  }
  return result;
}

} // namespace gnomon::test

#endif
