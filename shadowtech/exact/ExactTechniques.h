#pragma once

#include "shadowtech/exact/ConservativeTechnique.h"

#include <vector>

namespace gnomon
{

/// The exact techniques for hard shadows. They differ in which casters must cover a texel:
/// - `crsm`: one triangle contains it (conservative shadow maps after Hertel et al. 2009, with
///   correct depth bounds).
/// - `crsma`: a triangle and its neighbours contain it (adjacency after Morais 2016, with a border
///   and correct depth bounds).
/// - `silhouette`: the texel holds no edge at which the casters' surface ends.
const std::vector<ConservativeEntry>& exactTechniques();

} // namespace gnomon
