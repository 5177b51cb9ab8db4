#pragma once

#include "Comparison.h"

#include "plugin/vtkGnomonVisibilityImages.h"

#include <vector>

namespace gnomon::tool
{

/// 40 x 30 pixels of a floor that faces up and is lit from above, left half in shadow. The lowest 5
/// rows are background. The origin is far away.
inline VisibilityImages floorTruth()
{
  VisibilityImages images;
  images.width = 40;
  images.height = 30;
  images.origin = { { 1e6, 2e6, 3e6 } };
  images.sceneIndices = { 0 };
  images.channels = { LightChannel::All };
  images.visibility.resize(1);
  for (int y = 0; y < images.height; ++y)
  {
    for (int x = 0; x < images.width; ++x)
    {
      images.positionX.push_back(static_cast<float>(x));
      images.positionY.push_back(0.0f);
      images.positionZ.push_back(static_cast<float>(y));
      images.normalX.push_back(0.0f);
      images.normalY.push_back(1.0f);
      images.normalZ.push_back(0.0f);
      images.coverage.push_back(y < 25 ? 1.0f : 0.0f);
      images.visibility[0].push_back(x < 20 ? 0.0f : 1.0f);
    }
  }
  return images;
}

inline SceneLight lightFromAbove()
{
  SceneLight light;
  light.position = { { 0.0, 1.0, 0.0 } };
  light.target = { { 0.0, 0.0, 0.0 } };
  return light;
}

/// Flips so many pixels of the first light: 60 of 100 of them in the shadow, 40 in the light.
inline void flipHundredPixels(VisibilityImages& images)
{
  for (int i = 0; i < 100; ++i)
  {
    const int x = i < 60 ? i % 20 : 20 + i % 20;
    const int y = i / 20;
    float& value = images.visibility[0][static_cast<std::size_t>(y * images.width + x)];
    value = 1.0f - value;
  }
}

inline Picture greyPicture(int width, int height)
{
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.rgb.assign(3 * picture.pixelCount(), 200);
  return picture;
}

/// A comparison of three variants; the one called "nsm 1024 inline" has 100 flipped pixels.
inline ComparisonResults syntheticResults()
{
  const VisibilityImages truth = floorTruth();
  const std::vector<SceneLight> lights = { lightFromAbove() };
  VisibilityImages flipped = truth;
  flipHundredPixels(flipped);

  ComparisonResults results;
  results.scene = "floor & <half> shadow";
  results.width = truth.width;
  results.height = truth.height;
  results.frames = 21;
  results.triangles = 12345;
  results.lights = 1;
  results.truth = "raytraced";
  results.settings = { { "VTK", "9.1" }, { "Frames, all", "21, \"warm\"" } };
  results.notes = { "Light 2 casts no shadow: switched off." };

  const auto add = [&](const std::string& name, const std::string& technique,
                     const VisibilityImages& images, double milliseconds)
  {
    VariantResult variant;
    variant.name = name;
    variant.technique = technique;
    variant.errorSource = "Made up.";
    std::vector<PixelVerdict> verdicts;
    variant.error = measureError(images, truth, lights, &verdicts);
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      variant.timings[motion].milliseconds = milliseconds * static_cast<double>(motion + 1);
    }
    variant.picture = greyPicture(truth.width, truth.height);
    variant.errors = errorPicture(variant.picture, verdicts);
    results.variants.push_back(variant);
  };
  VisibilityImages lit = truth;
  lit.visibility[0].assign(lit.visibility[0].size(), 1.0f);
  add(plainTechnique, plainTechnique, lit, 30.0);
  add("nsm 1024 inline", "nsm", flipped, 36.0);
  add("raytraced", "raytraced", truth, 60.0);
  results.variants[1].route = "inline";
  results.variants[1].mapSizeTexels = 1024;
  results.variants[1].notes = { "A limit, of \"some\" kind." };
  for (MotionTiming& timing : results.variants[1].timings)
  {
    timing.stages = { { "maps", 8.25 }, { "shading", 26.5 } };
    timing.stageShare = 0.965;
  }
  results.variants[2].tracedPixels = 1000;
  results.variants[2].classes = { { "traced", 1000 }, { "no receiver", 24 } };
  results.variants[2].classPicture = greyPicture(truth.width, truth.height);
  return results;
}

} // namespace gnomon::tool
