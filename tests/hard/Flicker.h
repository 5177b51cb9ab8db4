#pragma once

#include "FrameVariant.h"
#include "Scene.h"

#include <array>
#include <vector>

namespace gnomon::hard
{

/// @file
/// How much shadows flicker: the share of the pixels at shadows' edges that turn from right to
/// wrong or back from one frame to the next, while the camera or the light moves by small steps.
/// The truth flickers by 0; a shadow that moves with its map's texels, by much.
///
/// A picture that moves scans what is wrong in it at other points, and would flicker by that alone.
/// So for a moving camera the maps are fitted to where it is, and looked up from where it was at
/// first.

/// What moves, and by how much per step.
enum class Movement
{
  CameraAside, ///< by a tenth of a texel of a map of the whole scene
  CameraTurned,
  LightTurned
};
constexpr std::array<Movement, 3> allMovements = { Movement::CameraAside, Movement::CameraTurned,
  Movement::LightTurned };

/// The first light's visibility in every frame of a movement, pixel by pixel.
using Frames = std::vector<std::vector<float>>;

/// @param steps after the first frame
/// @throws tool::Failure when no light casts a shadow
Frames drawMovement(tool::VariantSpec spec, const tool::Scene& scene, int width, int height,
  Movement movement, int steps);

/// The share of the truth's edge pixels that turn, over all steps.
double flicker(const Frames& frames, const Frames& truth, int width);

} // namespace gnomon::hard
