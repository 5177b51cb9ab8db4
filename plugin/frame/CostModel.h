#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace gnomon
{

/// What the parts of a frame take on a machine, in nanoseconds for each triangle, pixel or texel.
struct CostFactors
{
  ///@{
  /// Plain VTK.
  double drawTriangle, drawPixel;
  ///@}
  ///@{
  /// A light's map: asked by VTK's shader, and drawn anew.
  double askPixel, bakeTriangle, bakeTexel;
  ///@}
  double fetchPixel; ///< exact visibility of all lights together, fetched by VTK's shader
  ///@{
  /// What pixels show, drawn anew.
  double receiverTriangle, receiverPixel;
  ///@}
  double tracePixel;    ///< a light's shadow ray
  double refitTriangle; ///< of the structure for rays
};

/// Of llvmpipe on two cores; of hardware a guess until somebody measures one: what is drawn takes a
/// twentieth, what the CPU traces as long. `gnomon calibrate` measures a machine.
CostFactors defaultFactors(bool software);

///@{
/// Factors as text: a line each, name and number. Lines that begin with # are comments.
struct NamedFactor
{
  const char* name;
  double CostFactors::*member;
};
const std::array<NamedFactor, 10>& namedFactors();
std::string textOf(const CostFactors& factors);
/// @throws std::runtime_error that names the file and the line, for what is not such a file:
/// factors that are missing, named twice, unknown, negative or no finite numbers
CostFactors readFactors(const std::string& path);
///@}

/// What there is in a frame.
struct FrameCounters
{
  std::size_t triangles = 0;
  std::size_t pixels = 0;
  std::size_t texels = 0;      ///< of a light's map
  std::size_t lights = 0;      ///< whose shadows are hard
  std::size_t movedLights = 0; ///< of these, whose maps would be drawn anew
  bool viewMoved = false;      ///< the camera or what it sees
  bool castersMoved = false;
};

///@{
/// A frame's time in milliseconds: if maps shade its lights, and if rays do.
double costByMaps(const FrameCounters& counters, const CostFactors& factors);
double costByRays(const FrameCounters& counters, const CostFactors& factors);
///@}

} // namespace gnomon
