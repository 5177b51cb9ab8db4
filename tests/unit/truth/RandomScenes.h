#pragma once

#include "SyntheticScene.h"

#include "lights/LightViews.h"

#include <random>
#include <string>
#include <vector>

/// @file
/// Scenes, lights and maps drawn at random, for techniques that must never be wrong.

namespace gnomon::test
{

using Random = std::mt19937;

double uniform(Random& random, double low, double high);
glm::dvec3 unitVector(Random& random);

/// A sphere without its upper part.
Mesh makeCup(int rings, int segments);

/// Kinds of scenes that are hard in ways of their own: needles, open cups, folds, T-junctions,
/// duplicates, crossing boxes, holes, one-sided casters, coincident sheets, a lamp in its shade.
const std::vector<const char*>& randomSceneNames();

/// The name of a kind as a part of a test's name: letters alone.
std::string lettersOf(std::string name);

/// A scene of that kind, a few units large.
std::vector<Prop> makeRandomScene(const std::string& name, Random& random);

/// A light of any kind that shines on such a scene.
ShadowLight makeRandomLight(Random& random);

/// What a technique gets for one picture.
struct RandomPicture
{
  Occluders occluders;
  View view;         ///< what the camera sees
  ShadowLight light; ///< with a projection, a fit and a map's size that suit it
  LightViews views;
  std::string description; ///< for failures
};

/// A picture of such a scene from somewhere.
/// @param world where the scene is put, and its scale
RandomPicture makeRandomPicture(
  const std::string& name, unsigned int seed, const glm::dmat4& world = glm::dmat4(1.0));

/// The views of a light's map, fitted to all casters.
LightViews viewsOf(const ShadowLight& light, const Occluders& occluders);

/// How many pictures of each kind: as many as GNOMON_EXACT_RUNS says, and few where it is not set.
unsigned int exactRuns(unsigned int few = 24);

} // namespace gnomon::test
