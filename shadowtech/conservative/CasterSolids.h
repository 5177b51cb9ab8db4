#ifndef gnomon_shadowtech_conservative_CasterSolids_h
#define gnomon_shadowtech_conservative_CasterSolids_h

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/conservative/KeptOfCasters.h"

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
    std::uint32_t clearCount = 0; ///< of its triangles, those with any clearance
  };
  std::vector<Solid> solids;
  /// For each of its triangles, from the first: the solid that it bounds, or `none`.
  std::vector<std::uint32_t> ofTriangle;
  /// For each of its triangles, from the first: CasterSolids::clearanceOf(), whatever other solids there are.
  std::vector<float> clearance;
  bool areFound = false; ///< whether they were looked for, where and as the surface is
  ///@{ Of the surface then.
  std::uint64_t positionsVersion = 0;
  bool mayHaveSome = false; ///< by its flags
  ///@}

  static constexpr std::uint32_t none = 0xffffffffu;

  std::size_t bytes() const;
};

/// Solids among the casters, kept from snapshot to snapshot: what shadow rays that start on them need not be asked for is in
/// docs/techniques/exact.md, "Closed surfaces".
///
/// Of solids whose boxes meet, those stay that have the most clear triangles, so that no two of them touch and none is inside of
/// another. Surfaces of which one side alone casts, that have cut-outs, or that are instances have none. To find
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

  /// Boxes around the solids.
  const std::vector<Bounds>& boxesCentred() const { return this->boxesCentred_; }

  /// The solid that a triangle of the snapshot bounds, by its number; `SurfaceSolids::none` if there is none.
  std::uint32_t solidOf(std::uint32_t triangle) const { return this->solids_[triangle]; }

  /// How far a triangle of a solid is from those of the same solid which a ray that starts on its outer side may
  /// start behind, or may seem to: from all whose normals make an angle with its own whose cosine is less than sharpCosine, but
  /// for neighbours across edges that bulge. 0 where the solid crosses itself, or where what is
  /// outside cannot be told. In world units; no more than is looked for, which is 1/512 of the solid's size; negative
  /// where the triangle is wound clockwise as it is seen from outside.
  /// @param triangle of a solid
  float clearanceOf(std::uint32_t triangle) const { return this->clearance_[triangle]; }

  std::size_t bytes() const;

private:
  void keepApart(const Occluders& occluders);

  KeptOfCasters<SurfaceSolids> kept_;
  bool areAllFound_ = true;
  std::vector<Bounds> boxesCentred_;
  ///@{ By triangles of the snapshot.
  std::vector<std::uint32_t> solids_;
  std::vector<float> clearance_;
  ///@}
};

} // namespace gnomon

#endif
