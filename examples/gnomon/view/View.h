#pragma once

#include "ImageFile.h"
#include "Scene.h"
#include "view/LightHandle.h"
#include "view/PixelProbe.h"
#include "view/ViewPass.h"
#include "view/ViewState.h"
#include "view/ViewText.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A state's picture in a window, with or without an interactor. A ViewPass draws the scene. Layers
/// in front of it hold the frusta, then the handle and the text.
class View
{
public:
  /// @param window gets the renderers; must outlive this
  View(vtkRenderWindow* window, Scene scene, const ViewState& state);
  ~View();
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// Show a state from the next frame on.
  void apply(const ViewState& state);
  /// Return the state of the window: the last one applied, with the changes of VTK's interaction.
  ViewState state() const;

  /// Draw the state with all samples, and without the frame's time, which differs between frames.
  Picture still();

  const Scene& scene() const { return this->scene_; }
  vtkRenderWindow* window() const { return this->window_; }
  vtkRenderer* front() const { return this->front_; }
  ViewPass* pass() const { return this->pass_; }
  LightHandle& handle() { return this->handle_; }
  /// Return the selected light at its place in the state; null in a scene without lights.
  const SceneLight* selectedLight() const;
  ///@{
  /// Of the last frame.
  std::string cornerText() const { return this->text_.corner(); }
  int framesDrawn() const { return this->framesDrawn_; } ///< since the start
  ///@}

private:
  void setUpLayers();
  void beginFrame();
  void beforeLines();
  void beforeFront();
  std::vector<std::string> cornerLines();

  vtkRenderWindow* window_;
  const Scene scene_; ///< as loaded, without its lights' shadow settings
  ViewState state_;
  std::vector<SceneLight> lights_; ///< as the state places them
  vtkSmartPointer<vtkRenderer> renderer_;
  std::map<const vtkProp*, std::string> propNames_;
  vtkNew<vtkRenderer> lines_; ///< shares the scene's depths
  vtkNew<vtkRenderer> front_; ///< its camera has clipping planes of its own
  vtkNew<ViewPass> pass_;
  vtkNew<vtkPolyData> frusta_;
  ViewText text_;
  LightHandle handle_;
  std::unique_ptr<PixelProbe> probe_; ///< once asked for
  bool still_ = false;
  bool stereoBefore_ = false; ///< of the last frame
  double frameStart_ = 0.0;   ///< by steadyMilliseconds()
  int framesDrawn_ = 0;
};

/// Draw a state's picture without a screen.
/// @throws BadInput, Failure
Picture drawWithoutScreen(const ViewState& state, Scene scene);

} // namespace gnomon::tool
