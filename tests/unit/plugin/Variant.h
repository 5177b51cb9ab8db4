#pragma once

#include "PassScene.h"

#include "shadowtech/Registry.h"

#include <functional>
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
  bool isPointwise() const { return this->info().isPointwise(); }
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
std::vector<Variant> variantsThat(const std::function<bool(const Variant&)>& isSuch);

/// What a test draws: half of the techniques by their defaults, and an eighth of the other
/// variants. Another test has others.
std::vector<Variant> someVariants(
  const std::string& test, const std::function<bool(const Variant&)>& isFor);

inline bool isForAll(const Variant&)
{
  return true;
}

inline std::string nameOfVariant(const testing::TestParamInfo<Variant>& variant)
{
  return variant.param.name();
}

/// Defines a test of a fixture with a Variant as parameter, by some of those that `isFor` allows.
#define TEST_BY_VARIANTS(Fixture, Test, isFor)                                                     \
  class Test : public Fixture                                                                      \
  {                                                                                                \
  };                                                                                               \
  INSTANTIATE_TEST_SUITE_P(                                                                        \
    All, Test, testing::ValuesIn(someVariants(#Test, isFor)), nameOfVariant);                      \
  TEST_P(Test, by)

} // namespace gnomon::test
