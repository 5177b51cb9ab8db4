#pragma once

#include "Scene.h"

namespace gnomon::tool
{

/// Reads a scene file:
///
///     {"camera": {"position": [x,y,z], "target": [x,y,z], "up": [0,1,0], "fov": 45},
///      "models": [{"file": "bunny.obj", "matrix": [16 numbers, row-major], "color": [r,g,b],
///                  "texture": "screen.png", "casts": true, "receives": true, "one_sided": false}],
///      "lights": [{"type": "directional", "direction": [x,y,z], "color": [1,1,1], "intensity": 1,
///                  "technique": "pcf", "map_size": 1024, "kernel": "bilinear", "kernel_size": 3},
///                 {"type": "directional", "direction": [x,y,z], "box": {"position": [x,y,z],
///                  "up": [0,1,0], "width": 2, "height": 2, "depth": 5}},
///                 {"type": "point", "position": [x,y,z]},
///                 {"type": "spot", "position": [...], "target": [...], "cone_angle": 30},
///                 {"type": "area", "position": [...], "target": [...], "shape": "rectangle",
///                  "up": [0,1,0], "width": 1, "height": 1},
///                 {"type": "area", "position": [...], "target": [...], "shape": "disk",
///                  "radius": 0.5, "cone_angle": 30, "texture": "panes.png", "up": [0,1,0]}],
///      "background": [r,g,b]}
///
/// `direction` is the way the light travels, `fov` the full vertical angle in degrees, `cone_angle`
/// half the cone. A directional light with a `box` begins at the box's near face, which stands
/// across it around `position`, and reaches `depth` far; nothing else is lit by it or casts into it
/// (vtkGnomonLightKeys). An area light lies around its `position`, across the way to its `target`;
/// it is a rectangle unless it says otherwise, and shines into all directions unless it has a cone
/// (vtkGnomonAreaLight). Its `texture` is a PNG or JPEG image that says how its colour is spread
/// over it; a disk has an `up` with one only. Lights of all types take vtkGnomonLightKeys's
/// settings by name, as `technique`, `map_size`, `kernel` and `kernel_size` here. Paths are
/// relative to the scene file. Of a model only `file` must be given; its `color` replaces the
/// colours and textures of the file, its `texture` (an image of the nearest texel, repeated; where
/// its alpha is 0 the model has holes) the file's texture, and lights and cameras of the model file
/// are not used. A scene without "camera" or "lights" gets those of a bare model.
/// @throws BadInput
Scene readSceneFile(const std::string& path);

} // namespace gnomon::tool
