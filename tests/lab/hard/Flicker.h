#pragma once

#include "FrameVariant.h"
#include "Scene.h"

#include <vector>

namespace gnomon::hard
{

/// @file
/// Flicker of shadows: the share of the pixels at shadows' edges that turn from right to wrong or
/// back between two frames. The camera or the light moves by small steps. The truth flickers by 0;
/// a shadow that moves with its map's texels flickers much.
///
/// A moving picture samples errors at other points, and would flicker by that alone. For a moving
/// camera, maps are therefore fitted to its place and looked up from its first place.

/// The object that moves, and its step.
enum class Movement
{
  CameraAside, ///< by a tenth of a texel of a map of the whole scene
  CameraTurned,
  LightTurned
};

/// The first light's visibility in every frame of a movement, pixel by pixel.
using Frames = std::vector<std::vector<float>>;

/// @param steps after the first frame
/// @throws tool::Failure if no light casts a shadow
Frames drawMovement(tool::VariantSpec spec, const tool::Scene& scene, int width, int height,
  Movement movement, int steps);

/// Return the share of the truth's edge pixels that turn, over all steps.
double flicker(const Frames& frames, const Frames& truth, int width);

} // namespace gnomon::hard
