// Arithmetic that must not depend on the processor for which the code is compiled.

#include <gtest/gtest.h>

namespace
{

/// Compiled for processors that can fuse multiplication and addition.
#ifdef __x86_64__
[[gnu::target("fma")]]
#endif
double
productAndSum(const volatile double& a, const volatile double& b, const volatile double& c)
{
  return a * b + c;
}

} // namespace

TEST(FloatingPoint, productsAreRoundedBeforeTheyAreAdded)
{
#ifdef __x86_64__
  if (!__builtin_cpu_supports("fma"))
  {
    GTEST_SKIP() << "this processor fuses nothing";
  }
#endif
  // The square is 1 + 2^-29 + 2^-60; a double holds all but the last bit.
  const double factor = 1.0 + 0x1p-30;
  const double less = -(1.0 + 0x1p-29);
  EXPECT_EQ(productAndSum(factor, factor, less), 0.0);
}
