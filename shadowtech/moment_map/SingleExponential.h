#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `single_exponential`: exponential shadow maps (Annen, Mertens, Seidel, Flerackers and Kautz
/// 2008, "Exponential Shadow Maps", section 3) with one moment, as vtkShadowMapPass has them.
///
/// The mean of exp(c d) over the kernel, divided by exp(c z) at the receiver's depth z, is the lit
/// share where casters lie far before the receiver. A caster that lies `gap` before it lets through
/// exp(-c gap): light leaks at contacts, within some percent of the map's depth range.
///
/// No bias is tuned: exp(c d) is convex, so its mean over a plane lies on the lit side.
class SingleExponential : public MomentMapTechnique
{
public:
  static TechniqueInfo info();

  /// c, of depths in [-1, 1]; a twin of exponential_warps.glsl. exp(c) fits into a float.
  static constexpr double exponent = 40.0;

protected:
  Moments moments() const override;
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
