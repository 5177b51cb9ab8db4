#pragma once

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// `selective`: tests of increasing cost verify the contour between light and shadow, and undecided
/// pixels are traced (D. L. Moderno, Shadow Mapping and Ray-Tracing). It is exact inside the
/// contour without the test of coherence, and everywhere if the contour is the whole image.
class Selective : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon
