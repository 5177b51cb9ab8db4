#ifndef gnomon_tests_RandomScenes_h
#define gnomon_tests_RandomScenes_h

#include "SyntheticScene.h"

#include "lights/LightViews.h"

#include <glm/glm.hpp>

#include <random>
#include <string>

/// @file
/// Scenes of many kinds, with all that is hard for maps, and a random light, projection and camera each: for
/// what must hold always.

namespace gnomon::test
{

using Random = std::mt19937;
double uniform(Random& random, double low, double high);

/// The kinds of scenes.
inline constexpr const char* randomSceneNames[] = { "one triangle", "spheres", "soup", "needles",
  "cups", "folds", "junctions", "duplicates", "touching boxes", "crossing boxes", "terrain",
  "perforated", "one-sided", "sheets", "lamp" };

/// The name of one as a part of a test's name: letters alone.
std::string lettersOf(std::string name);

/// One picture of one scene in one light.
struct RandomPicture
{
  Occluders occluders;
  View view;
  ShadowLight light;
  LightViews views; ///< of its maps
  std::string description;
};

/// @param world from the scene, which is a few units large, to the world
RandomPicture makeRandomPicture(
  const std::string& name, unsigned int seed, const glm::dmat4& world = glm::dmat4(1.0));

/// Pictures of each scene that tests look at: few by default; more where GNOMON_EXACT_RUNS says so.
unsigned int randomRuns();

} // namespace gnomon::test

#endif
