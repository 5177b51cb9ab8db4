#pragma once

namespace gnomon
{

struct SettingsTable;

/// How a light's view is laid onto its map.
enum class Projection
{
  OfTechnique, ///< as the technique's name says
  Uniform,     ///< all texels are of one size across the light
  Lispsm,      ///< a perspective towards the camera (Lispsm.h)
  Trapezoid,   ///< another one (Trapezoid.h)
  Splits,      ///< uniform layers for parts of the distance from the camera (Splits.h)
  Cube         ///< the faces of a cube around a positional light
};

/// What uniform views are fitted to. Warped ones and splits are made for a camera, and take `Frame`
/// where they are not fitted once.
enum class ViewFit
{
  Off,  ///< the casters: maps stay as they are when the camera moves
  Once, ///< what the camera saw when the light got these settings
  Frame ///< what the camera sees in this frame
};

/// How the views of a light's map are laid out (LightViews.h).
struct ViewSettings
{
  Projection projection = Projection::OfTechnique;
  /// The side of the map, of each layer where it has several.
  int mapSizeTexels = 1024;
  ViewFit fit = ViewFit::Off;
  /// Whether fitted uniform views move by whole texels and change their size by steps, so that
  /// edges do not swim when the camera moves.
  bool snap = true;
  int splits = 4;
  double splitLambda = 0.5; ///< 0: uniform splits, 1: logarithmic ones
  /// The share of a split's length in which it is blended into the next, so that no border shows
  /// where texels change their size.
  double splitBlend = 0.0;
};

/// Of every technique that bakes a map.
const SettingsTable& viewSettings();

} // namespace gnomon
