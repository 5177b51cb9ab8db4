#pragma once

#include "shadowtech/exact/ConservativeTechnique.h"

#include <vector>

namespace gnomon
{

/// Return `crsm` and `crsma` exactly as published (Morais 2016, chapter 4). They are not exact
/// (PublishedMap.h).
const std::vector<ConservativeEntry>& publishedCrsm();

} // namespace gnomon
