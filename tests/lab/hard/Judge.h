#pragma once

#include "Scene.h"

#include "plugin/vtkGnomonVisibilityImages.h"
#include "tests/check/Scene.h"
#include "tests/check/Tracer.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::hard
{

/// One pixel of a picture's visibility.
struct Receiver
{
  check::Vec3 positionWorld;
  check::Vec3 normal; ///< geometric, unit, on the camera's side
};
Receiver receiverAt(const VisibilityImages& images, std::size_t pixel);

/// Finds the edges of a scene's shadows by its own rays, which share no code with Gnomon.
class Judge
{
public:
  explicit Judge(const tool::Scene& scene);

  const check::Scene& scene() const { return this->scene_; }

  /// Return the side of a texel at a receiver across the light's rays, in world units, in a map of
  /// the whole scene.
  double texelAt(const Receiver& receiver, std::size_t light, int mapSizeTexels) const;

  /// Return the side of a pixel at a receiver across the camera's rays, in world units.
  double pixelAt(const Receiver& receiver, int height) const;

  /// The offset from a receiver of rays that need not start where the truth's do. It exceeds the
  /// rounding of positions stored in float. World units.
  double storedOffset() const { return 1e-6 * this->size_; }

  /// Return the cosine between the receiver's normal and the direction to the light.
  double cosineAt(const Receiver& receiver, std::size_t light) const;

  /// True if nothing blocks the light at `offset` from the receiver.
  bool isLit(const Receiver& receiver, std::size_t light, double offset) const;

  /// True if the receiver's plane has lit and dark points within a distance from the receiver,
  /// measured across the light's rays.
  bool isNearEdge(const Receiver& receiver, std::size_t light, double distance) const;

  /// Return the offset of the truth's rays (shadowtech/base/ShadowRay.h), for a receiver anywhere
  /// in its pixel.
  /// @param origin of the coordinates in which rays are traced
  double offsetOf(const Receiver& receiver, const check::Vec3& origin, int height) const;

  /// True if a receiver lies on the scene's floor.
  bool isOnFloor(const Receiver& receiver) const;

private:
  check::Vec3 towards(const Receiver& receiver, std::size_t light) const;
  /// Return the nearest point of all surfaces within a distance.
  std::optional<check::Hit> surfaceAt(const check::Vec3& position, double distance) const;

  check::Scene scene_;
  std::vector<std::string> names_; ///< of the surfaces
  double size_ = 0.0;              ///< the diagonal of all surfaces' box
  std::vector<double> widths_;     ///< of all surfaces across each light's direction
  check::Tracer tracer_;
};

} // namespace gnomon::hard
