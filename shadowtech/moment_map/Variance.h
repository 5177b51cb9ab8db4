#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `variance`: variance shadow maps (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). Two
/// moments, mean m and mean square, and Chebyshev's one-sided inequality: of depths with that mean
/// and a variance s, at most s / (s + (z - m)^2) lie as far as z > m.
///
/// The bound is exact where one plane shadows another, both across the light. Where a third one
/// lies between them, light bleeds through it: what lies below the setting `bleeding` counts as
/// shadow.
///
/// **The variance's floor.** Where the map is flat, the receiver's depth z and the mean differ by
/// rounding, d, which is less than 2^-20 of the depth range (CasterDrawing.cpp). To be lit by more
/// than 0.99, a point needs s >= 99 d^2, or 1e-10. What rounding makes of the variance itself where
/// it is 0, up to 2^-23 of [-1, 1] squared, only adds light: a point is half lit that lies as far
/// behind its caster as the root of the floor, at most; with the default of 1e-6, 0.1 % of the
/// depth range.
class Variance : public MomentMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  Moments moments() const override;
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
