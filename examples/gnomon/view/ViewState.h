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

/// The contents of a view's pixels.
enum class Show
{
  Technique, ///< the scene, shaded with the technique's shadows
  Truth,     ///< the same with ray-traced shadows
  Error,     ///< where the technique differs from the truth (errorPicture())
  Classes,   ///< each pixel's class for the selected light (classPicture())
  Texels     ///< the texel size of the selected light's map (texelPicture())
};
/// "technique", "truth", "error", "classes", "texels".
std::string nameOf(Show show);

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

/// The state of the viewer's picture, but for props that the user moves. Same state, same bytes,
/// with or without a screen.
struct ViewState
{
  std::string scene; ///< as loadScene() takes it
  PictureSize size{ 960, 720 };
  SceneCamera camera;
  std::vector<LightPlace> lights; ///< one for each of the scene's
  std::size_t light = 0;          ///< the selected one: of handle, classes and texels

  std::string technique = "auto"; ///< as parseTechnique() takes it
  int mapSizeTexels = 1024;
  int truthSamples = 64; ///< of the truth, for each area light and pixel

  Show show = Show::Technique;
  bool handle = true; ///< of the selected light
  bool frusta = false;
  bool help = false;
  std::optional<std::array<int, 2>> probe; ///< a pixel, row 0 at the bottom
  std::optional<SunTime> sun;              ///< the last one that placed the directional light

  ///@{
  /// Changed by VTK's own keys.
  std::string surfaces; ///< "wireframe" or "surface"; empty: the scene's own
  bool stereo = false;
  ///@}
};

/// Return the state of a scene as loaded.
/// @param name as loadScene() takes it
ViewState initialState(const std::string& name, const Scene& scene);

/// Return the state's technique, with the map size if it has a map.
/// @throws BadInput
VariantSpec variantOf(const ViewState& state);

/// Return the state as JSON, each number with all of its digits.
std::string textOf(const ViewState& state);

/// Parse a state.
/// @param source name of the text, for errors
/// @param scene the one that the state names
/// @throws BadInput
ViewState parseState(const std::string& text, const std::string& source, const Scene& scene);

/// Read a settings file and its scene.
/// @throws BadInput
std::pair<ViewState, Scene> readView(const std::string& path);

} // namespace gnomon::tool
