#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// Scenes and camera views made on the CPU, without VTK and OpenGL, in the form in which the plugin
/// hands them to the techniques.

namespace gnomon::test
{

/// A mesh in its own coordinates, counter-clockwise seen from outside.
struct Mesh
{
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// A square in the plane z = 0, facing +z, of cells x cells quads.
Mesh makePlane(double side, int cells = 1);
/// The same with hills of this height.
Mesh makeTerrain(double side, int cells, double height);
Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper);
/// A unit sphere around the origin; `bumps` displaces it along its normals.
Mesh makeSphere(int rings, int segments, double bumps = 0.0);
/// Triangles of all shapes and sizes in the unit cube, slivers among them.
Mesh makeTriangleSoup(int count, unsigned int seed);
/// The same triangles, each with corners of its own, at exactly the same places.
Mesh apart(const Mesh& mesh);
/// The mesh of a Wavefront file; polygons are fanned.
Mesh readObj(const std::string& path);

/// One prop: a mesh and where it stands.
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

/// makePlane() with holes of all shapes, by an interpolated texture that repeats.
Prop makePerforatedPlane(double side, int cells, const glm::dmat4& worldFromMesh = glm::dmat4(1.0));

/// The snapshot of these props, as the collector makes it: doubles less the centre, then floats.
/// The centre is the middle of their box, so that all coordinates round.
Occluders makeOccluders(const std::vector<Prop>& props);

/// Moves one surface of a snapshot, as a moved prop does, and marks what changed. The boxes around
/// all surfaces stay.
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

/// What the camera sees, as a rasteriser gives it: the triangle of each pixel is the one at a point
/// that is off the pixel's centre by up to 1/512 pixel.
struct View
{
  ReceiverImages images;
  std::vector<DrawnSurface> drawnSurfaces; ///< one per surface of the snapshot
};
View makeView(const Occluders& occluders, const Camera& camera);

/// makeView() and projectReceivers().
ReceiverPixels makeReceivers(const Occluders& occluders, const Camera& camera);

/// A receiver that a test places, centred.
struct PlacedReceiver
{
  glm::vec3 position;
  glm::vec3 normal;
  float offset; ///< of its shadow ray
};
/// A row of receivers of one surface.
ReceiverPixels rowOf(const std::vector<PlacedReceiver>& receivers, std::uint32_t surface = 0);

ShadowLight directionalLight(const glm::dvec3& direction);
ShadowLight spotLight(
  const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees);
ShadowLight pointLight(const glm::dvec3& position);
/// A directional light that begins at `position`, in a box of this width, height and depth.
ShadowLight boxLight(
  const glm::dvec3& direction, const glm::dvec3& position, const glm::dvec3& size);

/// Visibility by every triangle against every ray, in double precision.
std::vector<float> traceBruteForce(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers);

/// The smallest distance between a pixel's shadow ray and an edge of a casting triangle, over the
/// largest coordinate of the scene.
double edgeDistance(const ShadowLight& light, const Occluders& occluders,
  const ReceiverPixels& receivers, std::size_t pixel);

/// Visibility by a EmbreeTracer made for it.
std::vector<float> trace(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers);

/// The same receivers with the offset of their shadow rays multiplied.
ReceiverPixels withOffset(const ReceiverPixels& receivers, float factor);

/// A place and a size.
glm::dmat4 at(const glm::dvec3& position, double scale = 1.0);

/// Pixels whose visibilities differ.
std::size_t countDifferent(const std::vector<float>& a, const std::vector<float>& b);
std::size_t countCovered(const ReceiverPixels& receivers);

} // namespace gnomon::test
