// Shared by the sources of vtkGnomonShadowPass.
#pragma once

#include "vtkGnomonShadowPass.h"

#include "plugin/frame/RenderManager.h"
#include "plugin/pass/Complaints.h"
#include "plugin/pass/FrameEnd.h"
#include "plugin/pass/OtherFrames.h"
#include "plugin/pass/PictureTimer.h"
#include "plugin/ranks/ManyRanks.h"
#include "plugin/scene/ShownView.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "plugin/window/PassContext.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include "vtkGnomonShadowSettings.h"
#include "vtkNew.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <list>
#include <memory>
#include <optional>
#include <string>

struct vtkGnomonShadowPass::Internals
{
  explicit Internals(vtkGnomonShadowPass* pass)
    : pictureTimer(pass)
    , otherFrames([this](vtkRenderer* renderer) { this->tellOfOther(renderer); })
  {
  }

  /// A renderer's frames: each renderer has values of its own.
  struct RendererFrames
  {
    vtkWeakPointer<vtkRenderer> renderer;
    std::unique_ptr<gnomon::RenderManager> manager;
  };

  /// A place that Install() took in a renderer's chain of passes.
  struct TakenPlace
  {
    vtkWeakPointer<vtkRenderer> renderer;
    vtkSmartPointer<vtkRenderPass> replaced; ///< null: the renderer had no pass
    bool hasDelegate;                        ///< what was replaced is the delegate
  };

  std::list<TakenPlace> places;
  vtkSmartPointer<vtkGnomonShadowSettings> settings =
    vtkSmartPointer<vtkGnomonShadowSettings>::New(); ///< of lights that say nothing
  /// Of the last setting that was set by name, if it was the sky's; empty after a success.
  std::optional<std::string> skyError;
  std::unique_ptr<gnomon::PassPrograms> programs = std::make_unique<gnomon::PassPrograms>();
  std::list<RendererFrames> renderers; ///< those drawn so far, the last one first
  gnomon::ViewCount viewCount;
  vtkNew<vtkRenderStepsPass> steps; ///< draws into the framebuffers of outer passes
  bool shadowed = false;            ///< whether the last frame was the manager's, which has it
  ///@{
  /// The report and visibility of a frame without the manager, or of one that outlives it.
  gnomon::FrameReport report;
  gnomon::VisibilityImages visibility;
  ///@}
  double progress = 1.0; ///< of the last frame that was no selection's
  gnomon::Complaints complaints;

  std::optional<gnomon::CostFactors> factors; ///< none: the default ones
  gnomon::PictureTimer pictureTimer;
  gnomon::OtherFrames otherFrames;

  std::unique_ptr<gnomon::ManyRanks> many; ///< of the last controller with several processes
  gnomon::Ranks* ranks = &gnomon::alone(); ///< those that draw the frame

  gnomon::PassContext context; ///< which holds the managers' GL objects

  gnomon::RenderManager& managerOf(vtkRenderer* renderer);
  void updateRanks(vtkMultiProcessController* controller);
  void keepLastFrame();
  void tellOfOther(vtkRenderer* renderer);
  gnomon::RenderManager& manager() { return *this->renderers.front().manager; }
};
