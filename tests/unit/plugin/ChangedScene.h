#pragma once

#include "PassScene.h"

#include <vtkLODProp3D.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkTexture.h>

#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test
{

/// What a user changes between two frames.
enum class ChangeKind
{
  Camera,
  Light,
  Matrix,
  Points, ///< edited in place
  ClippingPlane,
  Texture,
  Visibility,
  LevelOfDetail,
  WindowSize,
  StereoEye,
  Renderer, ///< the pass goes to another renderer of the window, or to both
  Technique,
  Setting,
  PropKey,
  Translucency,
  FarCaster ///< comes in or goes out, and takes the scene's box with it
};
inline constexpr std::size_t changeKinds = 16;

/// One change. The numbers choose among what its kind offers, so that two equal scenes change
/// alike.
struct Change
{
  ChangeKind kind;
  std::array<unsigned, 3> numbers;
};
Change drawChange(std::mt19937& random);
std::ostream& operator<<(std::ostream& stream, const Change& change);

/// A small scene with one of each kind of thing that changes, in a window of its own, under a pass
/// that can be replaced by a new one.
class ChangedScene
{
public:
  ChangedScene();

  /// Changes the scene, or the pass and what a replaced pass is set to.
  void apply(const Change& change);
  /// Replaces the pass by a new one with the same settings.
  void renewPass();
  /// Draws frames until the pass shows all of what its techniques show.
  Picture renderAll();

  void keepVisibility(bool keep);
  vtkGnomonShadowPass* pass() const { return this->pass_; }

private:
  void addProps();
  void addLights();
  void setPass();
  void moveCamera(const Change& change);
  void changeLight(const Change& change);
  void moveProp(const Change& change);
  void editPoints(const Change& change);
  void clip(const Change& change);
  void changeTexture(const Change& change);
  void chooseStereo(const Change& change);
  void sendFarCaster(const Change& change);
  void set(const std::string& name, const std::string& value);

  vtkNew<vtkGnomonEGLRenderWindow> window_;
  std::array<vtkNew<vtkRenderer>, 2> renderers_; ///< beside each other
  vtkSmartPointer<vtkGnomonShadowPass> pass_;
  unsigned shadowed_ = 0; ///< the renderer with the pass, or both: 2
  std::map<std::string, std::string> settings_;
  bool keepsVisibility_ = false;

  std::vector<vtkSmartPointer<vtkActor>> actors_;
  std::vector<vtkSmartPointer<vtkLight>> lights_;
  vtkNew<vtkPolyData> ballData_;
  vtkSmartPointer<vtkPolyDataMapper> clippedMapper_;
  std::array<vtkNew<vtkPlane>, 2> planes_;
  vtkNew<vtkTexture> texture_;
  vtkNew<vtkLODProp3D> levels_;
  std::array<int, 2> levelIds_{};
  vtkSmartPointer<vtkActor> fence_;
  vtkSmartPointer<vtkActor> pane_;
  vtkSmartPointer<vtkActor> far_;
};

} // namespace gnomon::test
