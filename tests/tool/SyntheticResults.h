#pragma once

#include "Report.h"

#include "plugin/vtkGnomonVisibilityImages.h"

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

/// A row of a comparison or study.
inline Row row(const std::string& scene, const std::string& variant, double error, double overPlain,
  bool soft = false)
{
  return { { "scene", scene }, { "shadows", soft ? "soft" : "hard" }, { "view", 1 },
    { "variant", variant }, { "technique", variant }, { "wrong_share", error },
    { "rms_error", error }, { "mean_absolute_error", error }, { "static_ms", 10.0 * overPlain },
    { "static_over_plain", overPlain }, { "camera_moving_ms", 20.0 * overPlain },
    { "camera_moving_over_plain", 2.0 * overPlain }, { "light_moving_ms", 30.0 * overPlain },
    { "light_moving_over_plain", 3.0 * overPlain } };
}

/// A comparison of three variants on a scene with an awkward name; "nsm 1024 inline" is wrong in
/// 100 of 1000 pixels.
inline ComparisonResults syntheticResults()
{
  ComparisonResults results;
  results.json = { { "scene", "floor & <half> \"shadow\"" }, { "width", 40 }, { "height", 30 },
    { "frames", 21 }, { "triangles", 12345 }, { "casting_lights", 1 }, { "truth", "raytraced" },
    { "settings", { { "VTK", "9.1" } } },
    { "notes", { "Light 2 casts no shadow: switched off." } } };
  const auto add = [&](const std::string& name, const std::string& technique, int wrong, double ms)
  {
    nlohmann::ordered_json variant = { { "name", name }, { "technique", technique },
      { "route", "" }, { "map_size", 0 },
      { "error",
        { { "source", "Made up." }, { "facing_pixels", 1000 }, { "wrong_pixels", wrong },
          { "wrong_share", wrong / 1000.0 }, { "false_light_pixels", wrong * 6 / 10 },
          { "false_shadow_pixels", wrong * 4 / 10 }, { "mean_absolute_error", wrong / 1000.0 },
          { "rms_error", 0.5 }, { "between_pixels", 7 }, { "between_share", 0.007 } } },
      { "traced_pixels", 0 } };
    for (const char* motion : motionKeys)
    {
      variant["times"][motion] = { { "frame_ms", ms } };
    }
    variant["memory_bytes"] = { { "occluders", 1 << 20 }, { "bvh", 0 }, { "maps", 0 },
      { "images", 0 }, { "resident_growth", -5 } };
    variant["class_pixels"] = nlohmann::ordered_json::object();
    variant["notes"] = nlohmann::ordered_json::array();
    variant["picture"] = technique + ".png";
    variant["error_picture"] = technique + "-errors.png";
    results.json["variants"].push_back(variant);
    const Picture picture = greyPicture(40, 30);
    results.pictures.push_back({ picture, picture, {}, {} });
  };
  add(plainTechnique, plainTechnique, 500, 30.0);
  add("nsm 1024 inline", "nsm", 100, 36.0);
  add("raytraced", "raytraced", 0, 60.0);
  nlohmann::ordered_json& nsm = results.json["variants"][1];
  nsm["route"] = "inline";
  nsm["map_size"] = 1024;
  nsm["notes"] = { "A limit, of \"some\" kind." };
  nsm["times"]["camera_moving"]["stages_ms"] = { { "maps", 8.25 }, { "shading", 26.5 } };
  nsm["times"]["camera_moving"]["stage_share"] = 0.965;
  results.pictures[1].worst = Place{ 0, 0, 8 };
  nlohmann::ordered_json& truth = results.json["variants"][2];
  truth["traced_pixels"] = 1000;
  truth["class_pixels"] = { { "traced", 1000 }, { "no receiver", 24 } };
  truth["class_picture"] = "raytraced-classes.png";
  results.pictures[2].classes = greyPicture(40, 30);
  return results;
}

} // namespace gnomon::tool
