#pragma once

#include "Cases.h"
#include "Picture.h"
#include "RandomProps.h"
#include "RandomSettings.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
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

/// One change of a scene, the same in all scenes that are equal.
struct Change
{
  std::size_t kind;
  unsigned seed; ///< of the numbers that the kind draws
};
Change drawChange(Random& random);

enum class Purpose
{
  Picture, ///< one view
  Changes  ///< one or two views; nothing depends on the frame in which it is set
};

/// A scene drawn at random, in a window of its own, under the pass.
class FuzzScene
{
public:
  /// @param random equal ones make equal scenes
  FuzzScene(Random random, Purpose purpose);

  void apply(const Change& change);

  /// Draws frames until the pass shows all of what its techniques show.
  /// @throws Find for an error of OpenGL or VTK, and for numbers that are no visibilities
  test::Picture render();

  /// Replaces the pass by a new one with the same settings.
  void renewPass();
  /// Has shadow rays decide all lights, with the samples that their settings ask for.
  /// @param hard the lights that count as points, by their places in the renderer
  void traceInstead(const std::set<int>& hard);
  /// Leaves the scene to VTK alone.
  void removePass();

  vtkGnomonShadowPass* pass() const { return this->pass_; }
  const FrameReport& report() const { return this->pass_->GetReport(); }
  /// Whether surfaces are shown whose shadows no image of visibility has.
  bool showsTranslucent() const;
  /// What was drawn, and what has changed since: a line each.
  const std::string& description() const { return this->description_; }

private:
  struct Kind; ///< of change
  friend Change drawChange(Random& random);
  static const std::vector<Kind>& kinds();

  void placeWorld(Random& random);
  void addProps(Random& random);
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

  void moveCamera(Random& random);
  void moveLight(Random& random);
  void changeLight(Random& random);
  void moveProp(Random& random);
  void editPoints(Random& random);
  void replaceData(Random& random);
  void clip(Random& random);
  void changeTexture(Random& random);
  void changeLook(Random& random);
  void toggleProp(Random& random);
  void toggleVisibility(Random& random);
  void chooseLevel(Random& random);
  void chooseStereo(Random& random);
  void chooseRenderer(Random& random);
  void chooseTechnique(Random& random);
  void changeSetting(Random& random);
  void setPropKey(Random& random);
  void sendFarProp(Random& random);

  bool isWide(std::size_t light) const;
  const EstimatorEntry& estimatorOfLight(std::size_t light) const;
  std::string allowed(const std::string& value) const;
  vtkProp3D* someProp(Random& random) const;
  vtkActor* someActor(Random& random) const; ///< null if the prop is none
  glm::dvec3 inWorld(const glm::dvec3& point) const;

  Purpose purpose_;
  vtkNew<vtkGnomonEGLRenderWindow> window_;
  std::vector<vtkSmartPointer<vtkRenderer>> renderers_;
  vtkSmartPointer<vtkGnomonShadowPass> pass_ = vtkSmartPointer<vtkGnomonShadowPass>::New();
  vtkNew<vtkMatrix4x4> world_; ///< from where the scene is a few units large
  double unit_ = 1.0;          ///< of the scene, in world units
  std::vector<vtkSmartPointer<vtkProp3D>> props_;
  std::vector<vtkSmartPointer<vtkLight>> lights_;
  NamedSettings settings_;                      ///< of the pass
  std::vector<NamedSettings> settingsOfLights_; ///< beside the pass's
  std::string description_;
};

} // namespace gnomon::fuzz
