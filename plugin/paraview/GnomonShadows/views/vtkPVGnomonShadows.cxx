#include "vtkPVGnomonShadows.h"

#include "vtkCameraPass.h"
#include "vtkCommand.h"
#include "vtkGnomonPropKeys.h"
#include "vtkGnomonShadowPass.h"
#include "vtkImageData.h"
#include "vtkImageProcessingPass.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPVSession.h"
#include "vtkProcessModule.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkXMLImageDataWriter.h"

#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkPVGnomonShadows);

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

bool isClient()
{
  return vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
}

/// Return the frames a second that a view asks for.
double updateRate(vtkPVRenderView* view)
{
  return view->GetRenderWindow()->GetDesiredUpdateRate();
}

/// True if a view draws for interaction.
bool isInteractive(vtkPVRenderView* view)
{
  return updateRate(view) > 1.0;
}

/// True if the processes of a server draw the view, or those of a batch.
bool isDistributed(vtkPVRenderView* view)
{
  return isInteractive(view) && view->GetUseLODForInteractiveRender()
    ? view->GetUseDistributedRenderingForLODRender()
    : view->GetUseDistributedRenderingForRender();
}

/// True on a client whose server draws the view.
bool isDrawnByServer(vtkPVRenderView* view)
{
  return isClient() && isDistributed(view);
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
vtkPVGnomonShadows::vtkPVGnomonShadows()
{
  this->SetNumberOfInputPorts(0);
  this->Pass->SetTechnique("auto");
  // An observer keeps the pass's warnings from ParaView's output window, which opens on each
  // process. The report has them as notes.
  this->Pass->AddObserver(vtkCommand::WarningEvent, this, &vtkPVGnomonShadows::LeaveToReport);
}

//----------------------------------------------------------------------------
vtkPVGnomonShadows::~vtkPVGnomonShadows() = default;

//----------------------------------------------------------------------------
bool vtkPVGnomonShadows::AddToView(vtkView* view)
{
  this->View = vtkPVRenderView::SafeDownCast(view);
  this->Session =
    vtkPVSession::SafeDownCast(vtkProcessModule::GetProcessModule()->GetActiveSession());
  if (this->View)
  {
    vtkRenderer* const renderer = this->View->GetRenderer();
    renderer->AddObserver(vtkCommand::StartEvent, this, &vtkPVGnomonShadows::BeginFrame);
    renderer->AddObserver(vtkCommand::EndEvent, this, &vtkPVGnomonShadows::EndFrame);
  }
  return false;
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::BeginFrame()
{
  if (this->View)
  {
    this->PlacePass();
  }
}

//----------------------------------------------------------------------------
/// Put the pass into the view's chain of passes, or take it out.
void vtkPVGnomonShadows::PlacePass()
{
  vtkRenderer* const renderer = this->View->GetRenderer();
  vtkCameraPass* const camera = findCameraPass(renderer->GetPass());
  const bool isIn = camera && camera->GetDelegatePass() == this->Pass.Get();
  const bool isTiled = this->View->InTileDisplayMode() || this->View->InCaveDisplayMode();
  if (this->ShowShadows && (isTiled || !camera))
  {
    this->TellOnce(camera ? "Tile displays and CAVEs have no shadows."
                          : "The view has no pass of its camera, so it has no shadows.");
  }
  // During a selection the pass draws without its delegate, which composites.
  if (!this->ShowShadows || isTiled || !camera || renderer->GetSelector() ||
    isDrawnByServer(this->View))
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
  this->SetKeys();
  const bool interactive = isInteractive(this->View);
  const bool isComposited =
    isDistributed(this->View) && this->Pass->GetDelegatePass()->IsA("vtkIceTCompositePass");
  this->Pass->SetController(
    isDistributed(this->View) ? vtkMultiProcessController::GetGlobalController() : nullptr);
  this->Pass->SetImageReductionFactor(!isComposited ? 1
      : interactive ? this->View->GetInteractiveRenderImageReductionFactor()
                    : this->View->GetStillRenderImageReductionFactor());
  // Servers have no interactor, by which the pass would know the time.
  this->Pass->SetTimeBudget(interactive && isDistributed(this->View)
      ? 1000.0 / updateRate(this->View)
      : GNOMON_TIME_BUDGET_OF_WINDOW);
  this->Pass->SetInteractive(
    interactive ? vtkGnomonShadowPass::INTERACTIVE_ON : vtkGnomonShadowPass::INTERACTIVE_OFF);
}

//----------------------------------------------------------------------------
/// Tell the view's lights and props what the properties ask of them.
void vtkPVGnomonShadows::SetKeys()
{
  vtkRenderer* const renderer = this->View->GetRenderer();
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* const lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* const light = lights->GetNextLight(iterator))
  {
    light->SetShadowAttenuation(static_cast<float>(this->ShadowStrength));
  }
  vtkPropCollection* const props = renderer->GetViewProps();
  props->InitTraversal(iterator);
  while (vtkProp* const prop = props->GetNextProp(iterator))
  {
    vtkInformation* const keys = prop->GetPropertyKeys();
    const bool hasKey = keys && keys->Has(vtkGnomonPropKeys::CASTS());
    const bool asks =
      this->TranslucentCasts && prop->IsA("vtkActor") && prop->HasTranslucentPolygonalGeometry();
    if (asks && !hasKey)
    {
      vtkGnomonPropKeys::SetCasts(prop, true);
    }
    else if (hasKey && !asks && vtkGnomonPropKeys::GetCasts(prop))
    {
      keys->Remove(vtkGnomonPropKeys::CASTS());
    }
  }
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::TellOnce(const char* why)
{
  if (this->Told != why)
  {
    this->Told = why;
    vtkWarningMacro(<< why);
  }
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::EndFrame()
{
  this->ServersReport.clear();
  if (this->View && this->ShowShadows && !this->View->GetRenderer()->GetSelector())
  {
    this->WriteVisibility();
    this->ShareReport();
  }
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::WriteVisibility()
{
  const int process = vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
  if (this->VisibilityFile.empty() || process > 0 || isDrawnByServer(this->View))
  {
    return;
  }
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

//----------------------------------------------------------------------------
/// Hand the report of a server's first process to the client, whose property it is.
void vtkPVGnomonShadows::ShareReport()
{
  constexpr int tag = 59170;
  if (!this->Session || !isDistributed(this->View))
  {
    return;
  }
  vtkMultiProcessController* const other = this->Session->GetController(
    isClient() ? vtkPVSession::RENDER_SERVER_ROOT : vtkPVSession::CLIENT);
  vtkMultiProcessStream stream;
  if (other && isClient())
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
void vtkPVGnomonShadows::SetCasting(int casting)
{
  this->Pass->SetCasting(casting);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetVolumesCast(bool cast)
{
  this->Pass->SetVolumeCasters(cast);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetSkyIntensity(double intensity)
{
  this->Pass->SetSkyIntensity(intensity);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetSmoothTerminators(bool smooth)
{
  this->Pass->SetSmoothTerminators(smooth);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetTechnique(const char* name)
{
  this->Pass->SetTechnique(name);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetEdgeSamples(int samples)
{
  samples > 0 ? setSetting(this->Pass, "edge_samples", samples)
              : setSetting(this->Pass, "edge_samples", "auto");
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetLightSize(double radius)
{
  setSetting(this->Pass, "light_radius", radius);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetLightSamples(int samples)
{
  setSetting(this->Pass, "light_samples", samples);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetMeasureStages(bool measure)
{
  this->Pass->SetMeasureStages(measure);
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::SetVisibilityFile(const char* path)
{
  this->VisibilityFile = path ? path : "";
  this->Pass->SetKeepVisibility(!this->VisibilityFile.empty());
}

//----------------------------------------------------------------------------
const char* vtkPVGnomonShadows::GetReportText()
{
  this->ReportText =
    this->ServersReport.empty() ? this->Pass->GetReportText() : this->ServersReport;
  return this->ReportText.c_str();
}

//----------------------------------------------------------------------------
void vtkPVGnomonShadows::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShowShadows: " << this->ShowShadows << "\n";
  os << indent << "ShadowStrength: " << this->ShadowStrength << "\n";
  os << indent << "TranslucentCasts: " << this->TranslucentCasts << "\n";
  os << indent << "VisibilityFile: " << this->VisibilityFile << "\n";
  os << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
