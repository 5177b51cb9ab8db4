#pragma once

// Scenes with instances, and the same scenes with all instances as triangles.

#include "RandomScenes.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::test
{

/// Return a matrix that turns at random, and scales each axis by 10^-spread to 10^spread.
glm::dmat4 turned(Random& random, double spread);

/// Turn a surface of a snapshot into one with instances; its positions become source coordinates.
void makeInstanced(Occluders& occluders, std::size_t surface,
  const std::vector<glm::dmat4>& centredFromSource, bool mirrored = false);

/// Return the snapshot with the triangles of all instances, numbered like VTK's.
Occluders expanded(const Occluders& instanced);

/// Return a floor, and over it 60 open cups, turned and scaled in all ways.
Occluders cupsOverFloor(bool mirrored, bool oneSided);

/// Give the cups a texture with holes.
void perforate(Occluders& occluders);

} // namespace gnomon::test
