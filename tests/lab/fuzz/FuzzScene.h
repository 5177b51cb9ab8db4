#pragma once

#include "Cases.h"
#include "ChangingProps.h"
#include "Picture.h"
#include "RandomProps.h"
#include "RandomSettings.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActor.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <set>
#include <string>
#include <vector>

namespace gnomon::fuzz
{

/// A change of a scene; it is the same in all equal scenes.
struct Change
{
  std::size_t kind;
  unsigned seed; ///< of the kind's random numbers
};
Change drawChange(Random& random);

enum class Purpose
{
  Picture, ///< one view
  Changes  ///< one or two views; nothing depends on the frame in which it is set
};

/// A random scene in its own window, under the pass.
class FuzzScene
{
public:
  /// @param random equal generators make equal scenes
  FuzzScene(Random random, Purpose purpose);

  void apply(const Change& change);

  /// Draw frames until the pass's picture is complete.
  /// @throws Find for an error of OpenGL or VTK, and for values that are no visibilities
  test::Picture render();

  /// Replace the pass by a new one with the same settings.
  void renewPass();
  /// Decide all lights by shadow rays, with the samples of their settings.
  /// @param hard the lights that count as points, by their places in the renderer
  void traceInstead(const std::set<int>& hard);
  /// Remove the pass: VTK draws alone.
  void removePass();

  vtkGnomonShadowPass* pass() const { return this->pass_; }
  const FrameReport& report() const { return this->pass_->GetReport(); }
  /// True if visible surfaces have shadows that no visibility image holds.
  bool showsTranslucent() const;
  /// The scene and its changes, a line each.
  const std::string& description() const { return this->description_; }

private:
  struct Kind; ///< of change
  friend Change drawChange(Random& random);
  static const std::vector<Kind>& kinds();

  void placeWorld(Random& random);
  void addProps(Random& random);
  void addChangingProps(Random& random);
  void addLight(Random& random);
  void placeLight(vtkLight* light, Random& random);
  void shapeLight(vtkLight* light, Random& random);
  void setLight(std::size_t light, const std::string& name, const std::string& value);
  void placeCamera(vtkRenderer* renderer, Random& random);
  void sizeWindow(Random& random);
  void choosePass(Random& random);
  void set(const std::string& name, const std::string& value);
  void set(const NamedSettings& settings);
  void replacePass(const NamedSettings& settings);

  bool isWide(std::size_t light) const;
  const EstimatorEntry& estimatorOfLight(std::size_t light) const;
  std::string allowed(const std::string& value) const;
  vtkProp3D* someProp(Random& random) const;
  glm::dvec3 inWorld(const glm::dvec3& point) const;

  Purpose purpose_;
  vtkSmartPointer<vtkOpenGLRenderWindow> window_ = makeOffScreenWindow();
  std::vector<vtkSmartPointer<vtkRenderer>> renderers_;
  vtkSmartPointer<vtkGnomonShadowPass> pass_ = vtkSmartPointer<vtkGnomonShadowPass>::New();
  vtkNew<vtkMatrix4x4> world_; ///< from where the scene is a few units large
  double unit_ = 1.0;          ///< of the scene, in world units
  std::vector<vtkSmartPointer<vtkProp3D>> props_;
  std::vector<test::ChangingProp> changingProps_;
  std::vector<vtkSmartPointer<vtkLight>> lights_;
  NamedSettings settings_;                      ///< of the pass
  std::vector<NamedSettings> settingsOfLights_; ///< beside the pass's
  std::string description_;
};

} // namespace gnomon::fuzz
