#pragma once

namespace gnomon
{

struct SettingsTable;

/// A projection of a light's view onto its map.
enum class Projection
{
  OfTechnique, ///< the projection that the technique's name stands for
  Uniform,     ///< all texels have one size across the light
  Lispsm,      ///< a perspective towards the camera (Lispsm.h)
  Trapezoid,   ///< a perspective whose focus region fills 80 % of the map (Trapezoid.h)
  Splits,      ///< a uniform layer for each interval of distances from the camera (Splits.h)
  Cube         ///< the faces of a cube around a positional light
};

/// What uniform views are fitted to. Warped views and splits depend on the camera; for them `Off`
/// means `Frame`.
enum class ViewFit
{
  Off,  ///< the casters: a moved camera leaves maps valid
  Once, ///< the camera's view when the light got these settings
  Frame ///< the camera's view in each frame
};

/// Settings of a light's views (LightViews.h).
struct ViewSettings
{
  Projection projection = Projection::OfTechnique;
  /// The side of each layer of the map, in texels.
  int mapSizeTexels = 1024;
  ViewFit fit = ViewFit::Off;
  /// True: fitted uniform views move by whole texels and change size in steps. This keeps shadow
  /// edges from swimming when the camera moves.
  bool snap = true;
  int splits = 4;
  double splitLambda = 0.5; ///< 0: uniform splits, 1: logarithmic splits
  /// The share of a split's length in which it blends into the next. Blending hides the border
  /// between texel sizes.
  double splitBlend = 0.0;
};

/// Settings of every technique that bakes a map.
const SettingsTable& viewSettings();

} // namespace gnomon
