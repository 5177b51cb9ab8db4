#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct ReceiverTile;

/// A receiver's visibility, as far as it is known without its shadow ray.
enum class Certainty : std::uint8_t
{
  Uncertain,
  Lit,
  Shadow,
  Unreached, ///< faces away from the light: visibility is 0 without a ray
  Reached    ///< has a shadow ray whose result is unknown
};

/// True if a certainty fixes the visibility.
inline bool isDecided(Certainty certainty)
{
  return certainty != Certainty::Uncertain && certainty != Certainty::Reached;
}

struct ReceiverTriangle
{
  std::uint32_t triangle; ///< of the snapshot; never one of a surface with instances
  bool back;              ///< true: the camera sees the corners run clockwise
  const std::array<glm::dvec3, 3>& cornersCentred;
  double mostFootprint; ///< largest side of a pixel on it, in world units
};

/// Receivers on a straight line on one triangle.
struct ReceiverSegment
{
  glm::dvec3 firstCentred, lastCentred; ///< the line's ends
  float leastOffset, mostOffset;        ///< of their shadow rays, in world units
  std::uint32_t surface;                ///< Occluders::surfaces index
};

/// Decides receivers without their shadow rays. Callers ask first for triangles, then for lines,
/// then for pixels, from several threads at once.
class ReceiverDecider
{
public:
  virtual ~ReceiverDecider() = default;

  /// Return what holds for all receivers on a triangle, wherever on it they lie.
  virtual Certainty ofTriangle(const ReceiverTriangle& /*triangle*/) const
  {
    return Certainty::Uncertain;
  }
  /// Return what holds for all receivers on a line. Called only if the triangle is Reached.
  /// @return Lit, Shadow or Uncertain
  virtual Certainty ofSegment(const ReceiverSegment& /*segment*/) const
  {
    return Certainty::Uncertain;
  }
  /// Decide a tile's receivers.
  /// @param certain of each pixel, row by row. Uncertain on entry where a decision is asked for,
  /// and set to Lit or Shadow if there is one. Others may be set to anything
  virtual void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const = 0;
};

} // namespace gnomon
