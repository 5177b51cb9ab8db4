#pragma once

#include "shadowtech/exact/ConservativeTechnique.h"

#include <vector>

namespace gnomon
{

/// `crsm` and `crsma` by the letter of their publication (Morais 2016, chapter 4): not exact
/// (PublishedMap.h).
const std::vector<ConservativeEntry>& publishedCrsm();

} // namespace gnomon
