#include "vtkPVGnomonShadowView.h"

#include "vtkCameraPass.h"
#include "vtkCommand.h"
#include "vtkGnomonShadowPass.h"
#include "vtkImageData.h"
#include "vtkImageProcessingPass.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkProcessModule.h"
#include "vtkRenderer.h"
#include "vtkXMLImageDataWriter.h"

#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkPVGnomonShadowView);

namespace
{

/// Return the camera's pass in a chain of passes; null if there is none.
vtkCameraPass* findCameraPass(vtkRenderPass* pass)
{
  while (auto* image = vtkImageProcessingPass::SafeDownCast(pass)) // FXAA, tone mapping
  {
    pass = image->GetDelegatePass();
  }
  return vtkCameraPass::SafeDownCast(pass);
}

/// Return the processes that draw a distributed view; null if this one draws alone.
vtkMultiProcessController* processesOf(vtkPVSynchronizedRenderer* renderers)
{
  const bool isClient = vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
  return renderers->GetEnabled() && !isClient ? vtkMultiProcessController::GetGlobalController()
                                              : nullptr;
}

/// True if the processes of a server draw the view, or those of a batch.
bool isDistributed(vtkPVRenderView* view, bool interactive)
{
  return interactive && view->GetUseLODForInteractiveRender()
    ? view->GetUseDistributedRenderingForLODRender()
    : view->GetUseDistributedRenderingForRender();
}

/// True on a client whose server draws the view.
bool isDrawnByServer(vtkPVRenderView* view, bool interactive)
{
  return isDistributed(view, interactive) &&
    vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
}

/// Set a setting that differs. Setting one that the technique lacks is an error, also to its
/// default, which ParaView sets.
template <typename Value>
void setSetting(vtkGnomonShadowPass* pass, const char* name, Value value)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  if (pass->GetSetting(name) != text.str())
  {
    pass->SetSetting(name, text.str().c_str());
  }
}

} // namespace

//----------------------------------------------------------------------------
vtkPVGnomonShadowView::vtkPVGnomonShadowView()
{
  this->Pass->SetTechnique("raytraced");
  // An observer keeps the pass's warnings from ParaView's output window, which opens on each
  // process. The report has them as notes.
  this->Pass->AddObserver(vtkCommand::WarningEvent, this, &vtkPVGnomonShadowView::LeaveToReport);
}

//----------------------------------------------------------------------------
vtkPVGnomonShadowView::~vtkPVGnomonShadowView() = default;

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::AboutToRenderOnLocalProcess(bool interactive)
{
  this->Superclass::AboutToRenderOnLocalProcess(interactive);
  vtkCameraPass* const camera = findCameraPass(this->GetRenderer()->GetPass());
  if (!camera)
  {
    this->TellOnce("The view has no pass of its camera, so it has no shadows.");
    return;
  }
  const bool isTiled = this->InTileDisplayMode() || this->InCaveDisplayMode();
  if (isTiled && this->ShowShadows)
  {
    this->TellOnce("Tile displays and CAVEs have no shadows.");
  }
  const bool isIn = camera->GetDelegatePass() == this->Pass.Get();
  // During a selection the pass draws without its delegate, which composites.
  if (!this->ShowShadows || isTiled || this->GetMakingSelection() ||
    isDrawnByServer(this, interactive))
  {
    if (isIn)
    {
      camera->SetDelegatePass(this->Pass->GetDelegatePass());
    }
    return;
  }
  if (!isIn)
  {
    this->Pass->SetDelegatePass(camera->GetDelegatePass());
    camera->SetDelegatePass(this->Pass);
  }
  this->Pass->SetController(processesOf(this->SynchronizedRenderers));
  const bool isComposited =
    this->Pass->GetController() && this->Pass->GetDelegatePass()->IsA("vtkIceTCompositePass");
  this->Pass->SetImageReductionFactor(
    isComposited ? this->SynchronizedRenderers->GetImageReductionFactor() : 1);
  this->Pass->SetInteractive(
    interactive ? vtkGnomonShadowPass::INTERACTIVE_ON : vtkGnomonShadowPass::INTERACTIVE_OFF);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::TellOnce(const char* why)
{
  if (this->Told != why)
  {
    this->Told = why;
    vtkWarningMacro(<< why);
  }
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::Render(bool interactive, bool skipRendering)
{
  this->Superclass::Render(interactive, skipRendering);
  const int process = vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
  const bool isWritten = !skipRendering && !this->GetMakingSelection() &&
    !this->VisibilityFile.empty() && process == 0 && !isDrawnByServer(this, interactive);
  if (isWritten)
  {
    vtkNew<vtkImageData> image;
    this->Pass->GetVisibilityImage(image);
    if (image->GetNumberOfPoints() > 0)
    {
      vtkNew<vtkXMLImageDataWriter> writer;
      writer->SetFileName(this->VisibilityFile.c_str());
      writer->SetInputData(image);
      writer->SetDataModeToBinary(); // ParaView of Debian 12 does not read appended data
      writer->Write();
    }
  }
  if (!skipRendering)
  {
    this->ShareReport(isDistributed(this, interactive));
  }
}

//----------------------------------------------------------------------------
/// Hand the report of a server's first process to the client, whose property it is.
void vtkPVGnomonShadowView::ShareReport(bool isDistributed)
{
  constexpr int tag = 59170;
  this->ServersReport.clear();
  vtkPVSession* const session = isDistributed ? this->GetSession() : nullptr;
  if (!session)
  {
    return;
  }
  const bool isClient = vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
  vtkMultiProcessController* const other =
    session->GetController(isClient ? vtkPVSession::RENDER_SERVER_ROOT : vtkPVSession::CLIENT);
  vtkMultiProcessStream stream;
  if (other && isClient)
  {
    other->Receive(stream, 1, tag);
    stream >> this->ServersReport;
  }
  else if (other) // null on a server's other processes and in a batch
  {
    stream << this->Pass->GetReportText();
    other->Send(stream, 1, tag);
  }
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetTechnique(const char* name)
{
  this->Pass->SetTechnique(name);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetEdgeSamples(int samples)
{
  setSetting(this->Pass, "edge_samples", samples);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetLightSize(double radius)
{
  setSetting(this->Pass, "light_radius", radius);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetLightSamples(int samples)
{
  setSetting(this->Pass, "light_samples", samples);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetMeasureStages(bool measure)
{
  this->Pass->SetMeasureStages(measure);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::SetVisibilityFile(const char* path)
{
  this->VisibilityFile = path ? path : "";
  this->Pass->SetKeepVisibility(!this->VisibilityFile.empty());
}

//----------------------------------------------------------------------------
const char* vtkPVGnomonShadowView::GetReportText()
{
  this->ReportText =
    this->ServersReport.empty() ? this->Pass->GetReportText() : this->ServersReport;
  return this->ReportText.c_str();
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadowView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShowShadows: " << this->ShowShadows << "\n";
  os << indent << "VisibilityFile: " << this->VisibilityFile << "\n";
  os << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
