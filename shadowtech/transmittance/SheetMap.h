#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/transmittance/LightGrids.h"
#include "shadowtech/transmittance/PointFilter.h"
#include "shadowtech/transmittance/Sheets.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// A light's sheets as a deep shadow map (Lokovic and Veach, SIGGRAPH 2000): each texel holds the
/// first crossings of its central ray, with what is left behind them. The last one has what is left
/// behind all of the ray's.
///
/// A point is between four texels. At each it asks for the crossings before its own plane, so that
/// it does not count its own sheet. For rounding and curves it leaves out those in front of the
/// plane by less than (1 + s^2) / 4 texels, where s is the plane's slope against the ray; slopes
/// are limited to 8. So sheets shadow each other from there on, and their shadows' edges are a
/// texel wide.
class SheetMap : public PointFilter
{
public:
  /// The most crossings that a texel tells apart.
  static constexpr std::size_t crossings = 8;

  /// @param sheets needed for this call alone
  /// @param bounds of the sheets, centred
  /// @param resolution the texels along the longer side; half as many for the sides of a cube
  /// @throws TextureMemoryError
  SheetMap(const Sheets& sheets, const Bounds& bounds, const ShadowRayLight& light, int resolution);

  bool isColoured() const override { return this->channels_ == 3; }
  std::string name() const override { return "gnomonSheets_LIGHT"; }
  std::string glsl() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

  /// True if the light shines on no sheet.
  bool empty() const { return this->grids_.grids().empty(); }
  std::size_t bytes() const { return this->texture_.bytes(); }

private:
  std::vector<std::uint16_t> trace(const Sheets& sheets, const LightGrid& grid) const;
  int layers() const;

  LightGrids grids_;
  std::size_t channels_;
  SizedTexture texture_; ///< of each grid the crossings' z, then what is left by channel
};

} // namespace gnomon
