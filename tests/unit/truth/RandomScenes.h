#pragma once

#include "../lights/Random.h"
#include "SyntheticScene.h"

#include "lights/LightViews.h"

#include <string>
#include <vector>

/// @file
/// Random scenes, lights and maps, for techniques that must never be wrong.

namespace gnomon::test
{

/// Return a sphere without its upper part.
Mesh makeCup(int rings, int segments);

/// Return the kinds of scenes, each difficult in its own way: needles, open cups, folds,
/// T-junctions, duplicates, crossing boxes, holes, one-sided casters, coincident sheets, a lamp in
/// its shade.
const std::vector<const char*>& randomSceneNames();

/// Return a kind's name as a part of a test's name: letters alone.
std::string lettersOf(std::string name);
inline constexpr auto byLetters = [](const auto& info) { return lettersOf(info.param); };

/// Return a scene of that kind, a few units large.
std::vector<Prop> makeRandomScene(const std::string& name, Random& random);

/// Return a light of any kind that shines on such a scene.
ShadowLight makeRandomLight(Random& random);

/// The input of a technique for one picture.
struct RandomPicture
{
  Occluders occluders;
  View view;         ///< the camera's view
  ShadowLight light; ///< with a projection, a fit and a map's size that suit it
  LightViews views;
  std::string description; ///< for failures
};

/// Return a picture of such a scene from a random place.
/// @param world place and scale of the scene
RandomPicture makeRandomPicture(
  const std::string& name, unsigned int seed, const glm::dmat4& world = glm::dmat4(1.0));

/// Return the views of a light's map, fitted to all casters.
LightViews viewsOf(const ShadowLight& light, const Occluders& occluders);

/// A ray of the light, centred, of any length: from the light, or parallel to its direction.
struct LightRay
{
  glm::dvec3 origin;
  glm::dvec3 direction;
};
/// Return the ray of a view's map at a place, in texels.
LightRay rayAt(const LightView& view, int sizeTexels, const glm::dvec2& texels);

/// Return the number of pictures of each kind: GNOMON_EXACT_RUNS, or `few` if that is not set.
unsigned int exactRuns(unsigned int few = 24);

} // namespace gnomon::test
