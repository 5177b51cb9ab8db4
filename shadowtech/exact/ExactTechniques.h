#pragma once

#include "shadowtech/exact/ConservativeTechnique.h"

#include <vector>

namespace gnomon
{

/// Which triangles around one may cover a texel together with it.
enum class AdjacencyRing
{
  Edges,   ///< those across its edges
  Vertices ///< all around its corners
};
struct CrsmaSettings
{
  AdjacencyRing ring = AdjacencyRing::Edges;
};
const SettingsTable& crsmaSettings();

/// Exact hard shadows, by what covers a texel of their map:
/// - `crsm`: one triangle contains it (conservative shadow maps after Hertel et al. 2009, with
///   depth bounds that hold);
/// - `crsma`: a triangle and its neighbours contain it (with adjacency after Morais 2016, with a
///   border and depth bounds that hold);
/// - `silhouette`: no edge of the casters' surface is there.
const std::vector<ConservativeEntry>& exactTechniques();

} // namespace gnomon
