#pragma once

#include <ImathVec.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

class vtkMatrix4x4;
class vtkPolyData;

/// The independent check of visibility files: it shares no code with Gnomon.
namespace gnomon::check
{

using Vec3 = Imath::V3d;
using Triangle = std::array<Vec3, 3>; ///< corners, world coordinates
using Vec2 = Imath::V2d;

/// Triangles and their texture coordinates.
struct Mesh
{
  std::vector<Triangle> triangles;
  /// Corner by corner, one entry for each triangle; empty if the file has none.
  std::vector<std::array<Vec2, 3>> coordinates;
};

/// The texels of a repeated image that are drawn: those whose alpha is not 0.
struct Holes
{
  int width = 0;
  int height = 0;
  std::vector<bool> drawn; ///< rows from the bottom

  /// True if the texel at these texture coordinates is drawn.
  bool isDrawn(const Vec2& coordinates) const;
};

/// One surface of a scene file.
struct Surface
{
  std::vector<Triangle> triangles;
  std::optional<Holes> holes;                   ///< where its texture makes it transparent
  std::vector<std::array<Vec2, 3>> coordinates; ///< with holes, one entry for each triangle
  bool casts = true;
  bool receives = true;
  bool oneSided = false; ///< casts only with triangles that are counter-clockwise for the light
};

/// The box of a directional light: outside it nothing is lit or casts.
struct Box
{
  Vec3 up{ 0.0, 1.0, 0.0 };
  double width = 0.0;
  double height = 0.0;
  double depth = 0.0;
};

struct Light
{
  enum class Kind
  {
    Directional,
    Spot,
    Point
  };
  Kind kind = Kind::Directional;
  Vec3 position{ 0.0 };          ///< of a spot or point light, or the middle of a box's near face
  Vec3 direction{ 0.0 };         ///< the way the light travels; unit; none of a point light
  double coneAngleDegrees = 0.0; ///< half the cone of a spot light
  std::optional<Box> box;        ///< of a directional light
};

struct Camera
{
  Vec3 position{ 0.0 };
  Vec3 target{ 0.0 };
  Vec3 up{ 0.0, 1.0, 0.0 };
  double fovDegrees = 30.0; ///< full vertical angle
};

struct Scene
{
  Camera camera;
  std::vector<Surface> surfaces;
  std::vector<Light> lights;
};

/// Read a scene file with its models. It must state its camera and its lights.
/// @throws std::exception with a message that names the file
Scene readScene(const std::string& path);

/// Return the triangles of a model file in the file's own coordinates, without those that have no
/// area. Texture coordinates are those of the file's points, if it has an array of them.
/// @throws std::exception with a message that names the file
Mesh readModel(const std::string& path);

/// Append the triangles of a surface that have an area. Polygons become fans around their first
/// vertex, strips triangles of one sense of rotation.
/// @param worldFromData null for the identity
void addSurface(Mesh& mesh, vtkPolyData* data, vtkMatrix4x4* worldFromData);

/// Return the holes of a PNG image.
/// @throws std::exception with a message that names the file
Holes readHoles(const std::string& path);

/// False if the surface has a hole at a point of one of its triangles.
bool isDrawn(const Surface& surface, std::size_t triangle, const Vec3& point);

} // namespace gnomon::check
