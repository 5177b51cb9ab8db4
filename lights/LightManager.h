#ifndef gnomon_lights_LightManager_h
#define gnomon_lights_LightManager_h

#include "lights/ShadowLight.h"

#include <string>
#include <vector>

class vtkLight;
class vtkRenderer;

namespace gnomon
{

/// A light that casts no shadow in this frame, and why.
struct SkippedLight
{
  int sceneIndex = 0; ///< place in the renderer's light collection
  std::string reason; ///< a whole clause for people, e.g. "switched off"
};

/// The frame's lights: those that cast, and those that do not with the reason.
struct LightSet
{
  std::vector<ShadowLight> casting;
  std::vector<SkippedLight> skipped;
};

/// What lights fall back on where they name nothing themselves (vtkGnomonLightKeys).
struct LightDefaults
{
  std::string technique;
  int mapSizeTexels = 1024;
  std::string kernel = defaultKernel;
  int kernelTexels = defaultKernelTexels;
};

/// Reads the renderer's vtkLights as they are at this moment.
///
/// Head and camera lights are taken through their transform, which the renderer's
/// UpdateLightsGeometryToFollowCamera() must have set for this frame. Lights that cannot show a
/// shadow are left out with a reason: switched off, black, no intensity, marked as not casting,
/// strength 0, and those whose numbers give no light (a cone without angle, an empty box).
class LightManager
{
public:
  static LightSet collect(vtkRenderer* renderer, const LightDefaults& defaults);
};

} // namespace gnomon

#endif
