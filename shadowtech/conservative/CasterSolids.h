#ifndef gnomon_shadowtech_conservative_CasterSolids_h
#define gnomon_shadowtech_conservative_CasterSolids_h

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/conservative/KeptOfCasters.h"
#include "shadowtech/conservative/MeetingBoxes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct SurfaceEdges;

/// The solids of one surface: its closed parts that are wound alike all over.
struct SurfaceSolids
{
  struct Solid
  {
    Bounds boxCentred;
    double reach =
      0.0; ///< how far around its triangles others are looked for; 0 where they are not
    std::uint32_t clearCount = 0; ///< of its triangles, those with any clearance
  };
  std::vector<Solid> solids;
  /// For each of its triangles, from the first: the solid that it bounds, or `none`.
  std::vector<std::uint32_t> ofTriangle;
  /// For each of its triangles, from the first: CasterSolids::clearanceOf(), whatever other solids there are.
  std::vector<float> clearance;
  /// Of solids too small against the scene to be of use, the largest reach that was left out.
  double largestLeftOut = 0.0;

  bool areFound = false; ///< whether they were looked for, where and as the surface is
  ///@{ Of the surface then.
  std::uint64_t positionsVersion = 0;
  bool mayHaveSome = false; ///< by its flags
  ///@}

  static constexpr std::uint32_t none = 0xffffffffu;

  std::size_t bytes() const;
};

/// Solids among the casters, kept from snapshot to snapshot: why shadow rays that start on them need not be asked for is in
/// docs/techniques/exact.md, "Closed surfaces".
///
/// Of solids whose boxes meet, those stay that have the most clear triangles, so that no two of them touch and none is inside of
/// another. Surfaces of which one side alone casts, that have cut-outs, or that are instances have none, nor are those looked at that are
/// so small against the scene that no light would have a use for them. To find
/// solids may take longer than to draw a map. So a surface that has moved since the last update has none, until
/// it stays for another.
class CasterSolids
{
public:
  /// @param edges of the snapshot's surfaces; null for those that do not cast
  /// @param parts CasterEdges::partOf()
  /// @throws std::runtime_error where Embree fails
  void update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges,
    const std::vector<std::uint32_t>& parts);

  /// Whether another update would find no more.
  bool areAllFound() const { return this->areAllFound_; }

  /// How far a triangle of a solid is from those of the same solid which a ray that starts on its outer side may
  /// start behind, or may seem to: from all whose normals make an angle with its own whose cosine is less than sharpCosine, but
  /// for neighbours across edges that bulge. In world units, and no more than is looked for, which is 1/512 of the solid's size at most. 0 where the solid
  /// crosses itself, where the triangle is wound clockwise as it is seen from outside, or its outer side may be inside of another part; and of all other triangles.
  /// @param triangle of the snapshot
  float clearanceOf(std::uint32_t triangle) const { return this->clearance_[triangle]; }

  std::size_t bytes() const;

private:
  void keepApart(const Occluders& occluders);

  KeptOfCasters<SurfaceSolids> kept_;
  MeetingBoxes meeting_;
  bool areAllFound_ = false;
  std::vector<float> clearance_; ///< by triangles of the snapshot
};

} // namespace gnomon

#endif
