#ifndef gnomon_plugin_VisibilityImages_h
#define gnomon_plugin_VisibilityImages_h

#include <array>
#include <vector>

namespace gnomon
{

/// One frame's visibility as data. Row 0 is the *top* row; pixel (x, y) is at y * width + x.
struct VisibilityImages
{
  int width = 0;  ///< in pixels
  int height = 0; ///< in pixels
  /// Positions are in world coordinates less this point.
  std::array<double, 3> origin{ { 0.0, 0.0, 0.0 } };

  /// visibility[k] belongs to the light with number sceneIndices[k] in the renderer's light
  /// collection: 1 lit, 0 in shadow, turned away or outside the cone. Lights that do not cast are
  /// not listed.
  std::vector<std::vector<float>> visibility;
  std::vector<int> sceneIndices; ///< which light each image of `visibility` belongs to

  std::vector<float> positionX; ///< of what the camera sees, less `origin`; so Y and Z
  std::vector<float> positionY; ///< see positionX
  std::vector<float> positionZ; ///< see positionX
  std::vector<float> normalX;   ///< geometric, unit, on the camera's side; so Y and Z
  std::vector<float> normalY;   ///< see normalX
  std::vector<float> normalZ;   ///< see normalX
  std::vector<float> coverage;  ///< 1 where a surface was drawn, else 0
};

} // namespace gnomon

#endif
