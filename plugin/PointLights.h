#ifndef gnomon_plugin_PointLights_h
#define gnomon_plugin_PointLights_h

#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <vtkNew.h>

#include <cstddef>
#include <vector>

class vtkLight;
class vtkLightCollection;
class vtkRenderer;

namespace gnomon
{

/// An area light, and the points of it that stand for it.
struct PointedLight
{
  ShadowLight light;
  std::vector<glm::dvec3> offsets; ///< of the points from the centre, as LightArea measures them
};

/// For as long as this lives, a renderer has lights without areas in place of its area lights, in the same order. They
/// stand at the centres, until they move over their areas together. Then it has its own again, which nobody has touched.
///
/// Each is as its area light is, but for where it shines from. A spot's cone moves along with its point. A directional light turns about
/// its position, and with it its box: about the middle of the near face.
class PointLights
{
public:
  PointLights(vtkRenderer* renderer, const std::vector<PointedLight>& areas);
  ~PointLights();
  PointLights(const PointLights&) = delete;
  PointLights& operator=(const PointLights&) = delete;

  /// Moves every light to its point of this number.
  void moveTo(std::size_t point);

private:
  vtkRenderer* renderer_;
  vtkLightCollection* own_;
  vtkNew<vtkLightCollection> standIns_;
  const std::vector<PointedLight>& areas_;
};

} // namespace gnomon

#endif
