#pragma once

#include "../lights/Random.h"

#include "lights/LightArea.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// @file
/// Scenes and camera views made on the CPU, without VTK and OpenGL, in the form in which the plugin
/// passes them to the techniques.

namespace gnomon::test
{

/// A mesh in its own coordinates, counter-clockwise seen from outside.
struct Mesh
{
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// Return a square in the plane z = 0, facing +z, of cells x cells quads.
Mesh makePlane(double side, int cells = 1);
/// Return the same square with hills of this height.
Mesh makeTerrain(double side, int cells, double height);
Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper);
/// Return a unit sphere around the origin; `bumps` displaces it along its normals.
Mesh makeSphere(int rings, int segments, double bumps = 0.0);
/// Return triangles of all shapes and sizes in the unit cube, slivers among them.
Mesh makeTriangleSoup(int count, unsigned int seed);
void addTriangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
/// Return the same triangles, each with its own corners, at exactly the same places.
Mesh apart(const Mesh& mesh);

/// One prop: a mesh and its matrix.
struct Prop
{
  Mesh mesh;
  glm::dmat4 worldFromMesh{ 1.0 };
  bool casts = true;
  bool receives = true;
  bool oneSided = false;
  std::shared_ptr<const CutoutMask> cutout = nullptr;
  std::vector<glm::vec2> textureCoordinates = {}; ///< with a cut-out, of the mesh's points
};

/// Return makePlane() with holes of all shapes, by an interpolated texture that repeats.
Prop makePerforatedPlane(double side, int cells, const glm::dmat4& worldFromMesh = glm::dmat4(1.0));

/// Return the snapshot of these props as the collector makes it: doubles less the centre, then
/// floats. By default the centre is the middle of their box, so all coordinates are rounded.
Occluders makeOccluders(
  const std::vector<Prop>& props, const std::optional<glm::dvec3>& centre = std::nullopt);

/// Move one surface of a snapshot, like a moved prop, and mark the changes. The boxes around all
/// surfaces stay.
void moveSurface(Occluders& occluders, std::size_t surface, const glm::dvec3& by);

/// A camera in world coordinates.
struct Camera
{
  glm::dvec3 position{ 0.0 };
  glm::dvec3 target{ 0.0 };
  glm::dvec3 up{ 0.0, 0.0, 1.0 };
  double fovDegrees = 40.0;    ///< full vertical angle
  double parallelHeight = 0.0; ///< of a parallel projection; 0 for perspective
  int width = 256;
  int height = 256;
};

/// A camera's view, as a rasteriser gives it: each pixel's triangle is that at a point off the
/// pixel's centre by up to 1/512 pixel.
struct View
{
  ReceiverImages images;
  std::vector<DrawnSurface> drawnSurfaces; ///< one per surface of the snapshot
};
View makeView(const Occluders& occluders, const Camera& camera);

/// Return the receivers of makeView().
ReceiverPixels makeReceivers(const Occluders& occluders, const Camera& camera);

/// A receiver that a test places, centred.
struct PlacedReceiver
{
  glm::vec3 position;
  glm::vec3 normal;
  float offset; ///< of its shadow ray
};
/// Return a row of receivers of one surface.
ReceiverPixels rowOf(const std::vector<PlacedReceiver>& receivers, std::uint32_t surface = 0);

ShadowLight directionalLight(const glm::dvec3& direction);
ShadowLight spotLight(
  const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees);
ShadowLight pointLight(const glm::dvec3& position);
/// Return a directional light that begins at `position`, in a box of this width, height and depth.
ShadowLight boxLight(
  const glm::dvec3& direction, const glm::dvec3& position, const glm::dvec3& size);

ShadowLight withArea(ShadowLight light, const LightArea& area, int samples = 64);
ShadowLight withMap(ShadowLight light, int sizeTexels);

/// A triangle that casts, with its corners centred.
struct CastingTriangle
{
  std::uint32_t surface;
  std::uint32_t triangle; ///< of the snapshot
  std::array<glm::dvec3, 3> corners;
};
std::vector<CastingTriangle> castingTriangles(const Occluders& occluders);

/// Where a line meets a triangle's plane.
struct LineHit
{
  double at;          ///< in lengths of the direction
  double cosine;      ///< of direction and normal, times their lengths
  glm::dvec3 weights; ///< barycentric

  double leastWeight() const { return glm::min(glm::min(weights.x, weights.y), weights.z); }
  bool isInside() const { return this->leastWeight() >= 0.0; }
};
/// Intersect by three volumes; none if the line lies along the plane. Differences of floats are
/// exact in double, so the signs of weights agree on an edge that neighbours share.
std::optional<LineHit> meet(
  const CastingTriangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction);

/// Return visibility by a new EmbreeTracer.
std::vector<float> trace(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers);

/// Return a matrix of a place and a size.
glm::dmat4 at(const glm::dvec3& position, double scale = 1.0);

/// Count the numbers below `end` for which holds() is true.
template <typename Holds>
std::size_t countBelow(std::size_t end, const Holds& holds)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < end; ++i)
  {
    count += holds(i) ? 1 : 0;
  }
  return count;
}

/// Count the pixels whose visibilities differ.
std::size_t countDifferent(const std::vector<float>& a, const std::vector<float>& b);
std::size_t countCovered(const ReceiverPixels& receivers);

// Scenes with instances, and the same scenes with all instances as triangles.

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
