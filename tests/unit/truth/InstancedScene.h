#pragma once

// Scenes with instances, and the same scenes with all instances as triangles.

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cstddef>
#include <random>
#include <vector>

namespace gnomon::test
{

class SignedRandom
{
public:
  explicit SignedRandom(unsigned int seed)
    : random_(seed)
  {
  }
  double uniform() { return this->uniform_(this->random_); }
  glm::dvec3 vector()
  {
    const double x = this->uniform();
    const double y = this->uniform();
    return { x, y, this->uniform() };
  }
  /// Return a matrix that turns at random, and scales each axis by 10^-spread to 10^spread.
  glm::dmat4 turned(double spread)
  {
    const glm::dmat4 turn = glm::rotate(
      glm::dmat4(1.0), 3.0 * this->uniform(), this->vector() + glm::dvec3(0.0, 0.0, 2.0));
    const glm::dvec3 exponents = spread * this->vector();
    return glm::scale(turn, glm::pow(glm::dvec3(10.0), exponents));
  }

private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{ -1.0, 1.0 };
};

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
