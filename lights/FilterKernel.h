#ifndef gnomon_lights_FilterKernel_h
#define gnomon_lights_FilterKernel_h

#include <optional>
#include <string>

namespace gnomon
{

/// Which texels around a receiver a filter reads, and with which weights.
enum class FilterKernel
{
  Bilinear, ///< a square of any place: texels count by how far it covers them
  Box,      ///< n x n texels of equal weight
  Poisson   ///< a few texels of equal weight, scattered over a disc that turns from place to place
};

///@{
/// The width of a kernel, the square's side or the disc's diameter, in texels.
constexpr int smallestKernelTexels = 1;
constexpr int largestKernelTexels = 32;
///@}

///@{
/// What lights have that name none. Of the kernels that show no single texels (any but a box) this
/// is the narrowest that also smooths the steps of an edge that runs across the texels.
inline constexpr const char* defaultKernel = "bilinear";
constexpr int defaultKernelTexels = 3;
///@}

/// The kernel of that name; nothing where there is none.
inline std::optional<FilterKernel> findKernel(const std::string& name)
{
  if (name == "bilinear")
  {
    return FilterKernel::Bilinear;
  }
  if (name == "box")
  {
    return FilterKernel::Box;
  }
  if (name == "poisson")
  {
    return FilterKernel::Poisson;
  }
  return std::nullopt;
}

/// For error messages.
inline std::string kernelNames()
{
  return "bilinear, box, poisson";
}

} // namespace gnomon

#endif
