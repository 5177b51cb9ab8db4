#pragma once

#include "PassScene.h"

namespace gnomon::test
{

/// A technique and settings, like "vsm blur=sat kernel_size=16".
struct Variant
{
  std::string text;

  std::string technique() const;
  /// Return the info of the estimator that the settings choose.
  const TechniqueInfo& info() const;
  /// Set the technique and settings on the scene's pass.
  void choose(PassScene& scene) const { scene.choose(this->text.c_str()); }
  /// Set one more setting on the pass, if the technique has it.
  void set(vtkGnomonShadowPass* pass, const char* name, const std::string& value) const;
  /// Return the sizes of a map to test; only one without a map.
  std::vector<int> mapSizes(std::vector<int> sizes) const;
  /// True if lights that see all around can have it; warps and splits need a single view.
  bool takesCubes() const;
  /// True if it has no settings.
  bool isDefault() const { return this->text == this->technique(); }
  bool isPointwise() const { return this->info().isPointwise(); }
  bool isMoments() const { return has(this->info(), "bleeding"); }
  bool hasSetting(const std::string& nameAndValue) const;
  /// Return the name for tests: "vsm_blur_sat_kernel_size_16".
  std::string name() const;
};

inline std::ostream& operator<<(std::ostream& stream, const Variant& variant)
{
  return stream << variant.name();
}

/// Return all techniques of the registry, and variants with other maps, kernels and light areas.
const std::vector<Variant>& variants();

/// Return the variants for which a predicate holds.
std::vector<Variant> variantsThat(const std::function<bool(const Variant&)>& isSuch);

/// Return the variants of a test: half of the techniques with their defaults, and an eighth of the
/// other variants. They differ from test to test.
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
