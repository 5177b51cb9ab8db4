#ifndef gnomon_tests_check_Scene_h
#define gnomon_tests_check_Scene_h

#include <ImathVec.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

/// The independent check of visibility files: it shares no code with Gnomon.
namespace gnomon::check
{

using Vec3 = Imath::V3d;
using Triangle = std::array<Vec3, 3>; ///< corners, world coordinates

/// One surface of a scene file.
struct Surface
{
  std::vector<Triangle> triangles;
  bool casts = true;
  bool receives = true;
  bool oneSided = false; ///< casts only with triangles that are counter-clockwise for the light
};

/// A box that a directional light is limited to: nothing outside is lit or casts.
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

/// Reads a scene file with its models. It must state its camera and its lights.
/// @throws std::exception with a message that names the file
Scene readScene(const std::string& path);

/// Triangles of a model file in the file's own coordinates, without those that have no area.
/// @throws std::exception with a message that names the file
std::vector<Triangle> readModel(const std::string& path);

} // namespace gnomon::check

#endif
