#ifndef gnomon_shadowtech_base_RayTracer_h
#define gnomon_shadowtech_base_RayTracer_h

#include "lights/ShadowLight.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PixelClass.h"
#include "shadowtech/base/Receivers.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon
{

/// How RayTracer::trace() comes to a pixel's visibility: indices into classesOfTracing().
enum class TracedClass : std::uint8_t
{
  Traced,
  Lit,       ///< for certain, without a ray
  Shadow,    ///< the same
  Unreached, ///< turned away from the light, or outside its cone or box
  NoReceiver ///< nothing is seen, or what receives no shadow
};
std::vector<PixelClass> classesOfTracing();

/// Shadow rays against the casting surfaces, by Embree in robust mode: the truth, and the one entry
/// point for whoever traces.
class RayTracer
{
public:
  RayTracer();
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  /// What an update did.
  struct Update
  {
    int builds = 0; ///< surfaces whose structure was built
    int refits = 0; ///< surfaces whose structure was refitted to moved vertices or instances
  };

  /// Brings the acceleration structure up to date with the snapshot; does nothing when neither
  /// topologyVersion nor positionsVersion changed. The snapshot's vertex and index arrays and texture
  /// coordinates are shared, not copied: they must stay where they are until the next update.
  Update update(const Occluders& occluders);

  /// Visibility of the light from every receiver, by the shadow ray of ShadowRay.h: 1 lit, 0
  /// shadowed, turned away from the light (facesLight()) or outside its cone or box. Pixels that
  /// are not covered, or whose surface does not receive, get 1.
  ///
  /// @param visibility resized to one for each pixel of the picture
  /// @param decider who knows something without rays; null: nobody
  /// @param classes where not null, resized likewise, each pixel's TracedClass
  /// @return the number of rays traced
  std::size_t trace(const ShadowLight& light, const Occluders& occluders,
    const Receivers& receivers, std::vector<float>& visibility,
    const ReceiverDecider* decider = nullptr, std::vector<std::uint8_t>* classes = nullptr) const;

  /// Memory that Embree holds for this tracer.
  std::size_t bytes() const;
  /// Memory that this tracer holds itself, to find each surface's structure again.
  std::size_t bytesOfTable() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon

#endif
