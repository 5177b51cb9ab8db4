#pragma once

#include "Commands.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "view/SunTime.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{

/// What the pixels of a view show.
enum class Show
{
  Technique, ///< the scene, shaded with the technique's shadows
  Truth,     ///< the same with ray-traced shadows
  Error,     ///< where the technique differs from the truth (errorPicture())
  Classes,   ///< how each pixel's visibility came about, for the selected light (classPicture())
  Texels     ///< how large the texels of the selected light's map look (texelPicture())
};
/// "technique", "truth", "error", "classes", "texels".
std::string nameOf(Show show);

/// Where a light of the scene is, and how large.
struct LightPlace
{
  Vec3 position;
  Vec3 target;
  /// In the units of vtkGnomonAreaLight: a disk's radius, half the width of a rectangle, whose
  /// height keeps its proportion; of other lights the setting `light_radius`.
  double size = 0.0;
};
LightPlace placeOf(const SceneLight& light);
void place(SceneLight& light, const LightPlace& place);

/// All that a picture of the viewer depends on. Same state, same bytes, with or without a screen.
struct ViewState
{
  std::string scene; ///< as loadScene() takes it
  PictureSize size{ 960, 720 };
  SceneCamera camera;
  std::vector<LightPlace> lights; ///< one for each of the scene's
  std::size_t light = 0;          ///< the selected one: of handle, classes and texels

  std::string technique = "auto"; ///< as parseTechnique() takes it
  int mapSizeTexels = 1024;
  int truthSamples = 64; ///< of each area light for every pixel, by which the truth is traced

  Show show = Show::Technique;
  bool handle = true; ///< of the selected light
  bool frusta = false;
  bool help = false;
  std::optional<std::array<int, 2>> probe; ///< a pixel, row 0 at the bottom
  std::optional<SunTime> sun;              ///< that the directional light was last placed by

  ///@{
  /// What VTK's own keys change.
  std::string surfaces; ///< "wireframe" or "surface"; empty: as the scene has them
  bool stereo = false;
  ///@}
};

/// A scene as its file has it.
/// @param name as loadScene() takes it
ViewState initialState(const std::string& name, const Scene& scene);

/// The state's technique, with the map size if it has a map.
/// @throws BadInput
VariantSpec variantOf(const ViewState& state);

/// As JSON, each number with all of its digits.
std::string textOf(const ViewState& state);

/// @param scene that the state names
/// @param source of the text, for errors
/// @throws BadInput
ViewState parseState(const std::string& text, const std::string& source, const Scene& scene);

/// Reads a settings file and the scene that it names.
/// @throws BadInput
std::pair<ViewState, Scene> readView(const std::string& path);

} // namespace gnomon::tool
