#pragma once

#include "Scene.h"

#include <nlohmann/json.hpp>

namespace gnomon::tool
{

/// Return a model made of shapes, each an array of its kind and numbers. Boxes and so on are as in
/// MeshBuilder, with points as three numbers:
///     ["box", low, high, more boxes...]  ["polygon", corners...]  ["plane", centre, side]
///     ["cone", base, height, bottom radius, top radius, segments]
///     ["sphere", centre, radius, slices, stacks]
///     ["lathe", origin, direction, segments, radius, height, more of the profile...]
///     ["limb", from, to, radius, taper, segments]
///     ["cup", foot, direction, radius]  ["torus", centre, radius of the ring, of the tube]
///     ["letter", centre, inner radius, outer radius, thickness]
///     ["repeat", count, step, shapes...]
/// or of a single shape of double coordinates and without normals:
///     ["triangles", corners...]  ["sheet", corner, right, forward]
/// Its name is the first shape's kind, its colour that of planes or casters.
/// @param shapes from BuiltinScenes.json, which is trusted
SceneModel makeShapes(const nlohmann::json& shapes);

} // namespace gnomon::tool
