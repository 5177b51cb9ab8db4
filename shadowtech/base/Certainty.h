#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct ReceiverTile;

/// What is known of a receiver's visibility without its shadow ray.
enum class Certainty : std::uint8_t
{
  Uncertain,
  Lit,
  Shadow,
  Unreached, ///< turned away from the light, so that its visibility is 0 without a ray
  Reached    ///< it has a shadow ray, of which nothing is known
};

/// Whether a certainty leaves nothing to ask.
inline bool isDecided(Certainty certainty)
{
  return certainty != Certainty::Uncertain && certainty != Certainty::Reached;
}

/// A triangle as the camera sees it.
struct ReceiverTriangle
{
  std::uint32_t triangle; ///< of the snapshot; never one of a surface with instances
  bool back;              ///< whether it is the side from which the corners run clockwise
  const std::array<glm::dvec3, 3>& cornersCentred;
  double mostFootprint; ///< the most that a pixel's side measures on it, in world units
};

/// Receivers in a straight line on one triangle.
struct ReceiverSegment
{
  glm::dvec3 firstCentred, lastCentred; ///< the line's ends
  float leastOffset, mostOffset;        ///< of their shadow rays, in world units
  std::uint32_t surface;                ///< Occluders::surfaces index
};

/// Who knows something of receivers without their shadow rays. Asked about triangles first, then
/// about lines, then about pixels; from several threads at once.
class ReceiverDecider
{
public:
  virtual ~ReceiverDecider() = default;

  /// What is known of all of a triangle's receivers, wherever on it they are.
  virtual Certainty ofTriangle(const ReceiverTriangle& /*triangle*/) const
  {
    return Certainty::Uncertain;
  }
  /// What is known of all receivers on a line. Asked only where the triangle is Reached.
  /// @return Lit, Shadow or Uncertain
  virtual Certainty ofSegment(const ReceiverSegment& /*segment*/) const
  {
    return Certainty::Uncertain;
  }
  /// Says what it knows of a tile's receivers, each Uncertain so far. Of those that need no shadow
  /// ray it may say anything.
  /// @param certain gets Lit or Shadow
  virtual void ofPixels(const ReceiverTile& tile, std::vector<Certainty>& certain) const = 0;
};

} // namespace gnomon
