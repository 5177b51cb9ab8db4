#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace gnomon
{

/// Costs of a frame on a machine, in nanoseconds for each triangle, pixel or texel.
struct CostFactors
{
  ///@{
  /// Plain VTK's frame.
  double drawTriangle, drawPixel;
  ///@}
  ///@{
  /// Map of one light: VTK's shader looks it up, or it is baked.
  double askPixel, bakeTriangle, bakeTexel;
  ///@}
  double fetchPixel; ///< VTK's shader fetches the exact visibility of all lights
  ///@{
  /// VTK draws triangle numbers for the receivers.
  double receiverTriangle, receiverPixel;
  ///@}
  double tracePixel;    ///< one shadow ray
  double refitTriangle; ///< Embree refits its structure to moved casters
};

/// True if OpenGL draws on the CPU, by the name of its renderer (GL_RENDERER).
bool isSoftwareRenderer(const std::string& renderer);

/// Return the factors of llvmpipe on two cores, or of an NVIDIA H200 beside 16 cores.
/// `gnomon calibrate` measures a machine.
CostFactors defaultFactors(bool software);

///@{
/// Factors as text, one name and number per line. Lines that begin with # are comments.
struct NamedFactor
{
  const char* name;
  double CostFactors::*member;
};
const std::array<NamedFactor, 10>& namedFactors();
std::string textOf(const CostFactors& factors);
/// @throws std::runtime_error that names the file and the line, if a factor is missing, repeated,
/// unknown, negative or not finite
CostFactors readFactors(const std::string& path);
///@}

/// Counts that determine the costs of a frame.
struct FrameCounters
{
  std::size_t drawn = 0;     ///< triangles and solids that VTK draws
  std::size_t triangles = 0; ///< that a map draws, those of solids' meshes among them
  std::size_t pixels = 0;
  std::size_t texels = 0;      ///< of one light's map
  std::size_t lights = 0;      ///< with hard shadows
  double tracedLights = 0.0;   ///< parts of them that rays decide if the view moves, summed
  std::size_t movedLights = 0; ///< lights whose maps are stale
  std::size_t newMaps = 0;     ///< lights whose maps are perhaps not baked yet, and then reused
  bool viewMoved = false;      ///< the camera or what it sees
  bool castersMoved = false;
};

///@{
/// Return the milliseconds of a frame with maps or with rays for its lights.
double costByMaps(const FrameCounters& counters, const CostFactors& factors);
double costByRays(const FrameCounters& counters, const CostFactors& factors);
///@}

} // namespace gnomon
