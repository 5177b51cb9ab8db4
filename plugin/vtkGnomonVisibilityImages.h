#pragma once

#include "vtkGnomonPixelClass.h" // flat, as where it is installed

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// How the visibility of one light's pixels came about.
struct ClassImage
{
  std::vector<PixelClass> classes;    ///< empty where the technique does not tell
  std::vector<std::uint8_t> ofPixels; ///< each pixel's class, an index into them
};

/// Which part of a light's colour an image of visibility is of.
enum class LightChannel : std::uint8_t
{
  All, ///< of a light without texture
  Red,
  Green,
  Blue
};

/// One frame's visibility as data. Row 0 is the *top* row; pixel (x, y) is at y * width + x.
struct VisibilityImages
{
  int width = 0;  ///< in pixels
  int height = 0; ///< in pixels
  /// Positions are in world coordinates less this point.
  std::array<double, 3> origin{ { 0.0, 0.0, 0.0 } };

  /// visibility[k] belongs to the light with number sceneIndices[k] in the renderer's light
  /// collection: 1 lit, 0 in shadow, turned away or outside the cone. Lights that do not cast are
  /// not listed. A light with a texture (vtkGnomonAreaLight::SetTexture) has three images in a row,
  /// and what is lit has the texture's mean instead of 1.
  std::vector<std::vector<float>> visibility;
  std::vector<int> sceneIndices;      ///< which light each image of `visibility` belongs to
  std::vector<LightChannel> channels; ///< and which part of its colour

  std::vector<ClassImage> classes; ///< of each image of `visibility`

  std::vector<float> positionX; ///< of what the camera sees, less `origin`; so Y and Z
  std::vector<float> positionY; ///< see positionX
  std::vector<float> positionZ; ///< see positionX
  std::vector<float> normalX;   ///< geometric, unit, on the camera's side; so Y and Z
  std::vector<float> normalY;   ///< see normalX
  std::vector<float> normalZ;   ///< see normalX
  std::vector<float> coverage;  ///< 1 where a surface was drawn, else 0

  /// Whose surface that is: a number in vtkRenderer::GetViewProps(); -1 where there is none.
  std::vector<int> prop;
  /// Which cell of the mapper's input, a vtkPolyData; -1 for other input (composite data, other
  /// data sets, glyphs, molecules), parts of assemblies, levels of detail, spheres and tubes.
  std::vector<std::int64_t> cell;
};

} // namespace gnomon
