#include "vtkGnomonShadowPass.h"

#include "plugin/RenderManager.h"
#include "plugin/VisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/FrameReport.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>

vtkStandardNewMacro(vtkGnomonShadowPass);

//------------------------------------------------------------------------------
struct vtkGnomonShadowPass::Internals
{
  std::string technique = gnomon::defaultTechnique;
  std::unique_ptr<gnomon::RenderManager> manager = std::make_unique<gnomon::RenderManager>();
  gnomon::FrameReport plainReport; ///< of frames that were drawn without the manager
  bool shadowed = false;           ///< whether the last frame was the manager's

  vtkWeakPointer<vtkOpenGLRenderWindow> window; ///< whose context holds the manager's GL objects
  vtkTimeStamp contextChecked;
  bool contextServes = false;
};

namespace
{

struct RendererAccess : vtkRenderer
{
  static vtkTypeBool& useShadows(vtkRenderer* renderer)
  {
    return renderer->*(&RendererAccess::UseShadows);
  }
};

/// Switches a renderer's UseShadows off for as long as this lives: vtkOpenGLRenderer's
/// UpdateGeometry would draw the props with vtkShadowMapPass, within our own frame. Naming the
/// member through a subclass gives access to it; the renderer's own function would tell all
/// observers that the renderer was modified.
class WithoutVtkShadows
{
public:
  explicit WithoutVtkShadows(vtkRenderer* renderer)
    : useShadows_(RendererAccess::useShadows(renderer))
    , before_(this->useShadows_)
  {
    this->useShadows_ = 0;
  }
  ~WithoutVtkShadows() { this->useShadows_ = this->before_; }
  WithoutVtkShadows(const WithoutVtkShadows&) = delete;
  WithoutVtkShadows& operator=(const WithoutVtkShadows&) = delete;

private:
  vtkTypeBool& useShadows_;
  vtkTypeBool before_;
};

} // namespace

//------------------------------------------------------------------------------
vtkGnomonShadowPass::vtkGnomonShadowPass()
  : MapSize(1024)
  , Route(ROUTE_AUTO)
  , MeasureStages(false)
  , KeepVisibility(false)
  , ObeyUseShadows(false)
  , Internal(new Internals)
{
}

//------------------------------------------------------------------------------
vtkGnomonShadowPass::~vtkGnomonShadowPass()
{
  this->ReleaseGraphicsResources(this->Internal->window);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::Render(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  this->NumberOfRenderedProps = 0;
  if (renderer->GetSelector())
  {
    this->RenderPlain(s, "a selection is drawn");
    return;
  }
  if (this->ObeyUseShadows && !renderer->GetUseShadows())
  {
    this->RenderPlain(s, "the renderer's UseShadows is off");
    return;
  }
  if (!this->PrepareContext(renderer))
  {
    this->RenderPlain(s, "OpenGL 4.3 is not available");
    return;
  }

  gnomon::RenderManager& manager = *this->Internal->manager;
  bool marked = false;
  bool drawn = false;
  try
  {
    manager.beginFrame(this->MeasureStages);

    // lights. The camera first: it sets the viewport, clears, and head lights follow it.
    this->UpdateCamera(renderer);
    this->UpdateLightGeometry(renderer);
    this->UpdateLights(renderer);
    const bool casting =
      manager.collectLights(renderer, { this->Internal->technique, this->MapSize });
    if (casting)
    {
      // occluders
      manager.collectOccluders(renderer);

      // From here on, mappers call the hook.
      if (!manager.chooseRoute(this->Route, this->KeepVisibility))
      {
        vtkErrorMacro("The inline route was asked for, but "
          << manager.report().routeReason << "; this frame takes the image route.");
      }
      this->PreRender(s);
      marked = true;

      // receivers
      if (manager.route() == gnomon::Route::Image)
      {
        manager.drawReceivers(s);
      }

      // maps
      manager.bakeMaps();

      // visibility
      if (manager.route() == gnomon::Route::Image)
      {
        manager.computeVisibility(this->KeepVisibility);
      }

      // shading
      manager.beginShading(renderer);
    }
    drawn = true;
    this->DrawProps(s);
    if (casting)
    {
      manager.endShading();
    }
    manager.endFrame();
    this->Internal->shadowed = true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("The scene is drawn without shadows: " << error.what());
    manager.abandonFrame();
  }
  if (marked)
  {
    this->PostRender(s);
  }
  if (!drawn)
  {
    this->RenderPlain(s, "an error was met");
  }
  this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::RenderPlain(const vtkRenderState* s, const char* reason)
{
  this->Internal->shadowed = false;
  this->Internal->plainReport = gnomon::FrameReport{};
  this->Internal->plainReport.route = "none";
  this->Internal->plainReport.routeReason = reason;

  vtkRenderer* renderer = s->GetRenderer();
  this->UpdateCamera(renderer);
  this->UpdateLightGeometry(renderer);
  this->UpdateLights(renderer);
  this->DrawProps(s);
  this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::DrawProps(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  const WithoutVtkShadows withoutVtkShadows(renderer);
  this->UpdateGeometry(renderer, s->GetFrameBuffer());
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PrepareContext(vtkRenderer* renderer)
{
  Internals& internal = *this->Internal;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorMacro("The renderer has no OpenGL render window.");
    return false;
  }
  window->MakeCurrent();
  if (window != internal.window ||
    window->GetContextCreationTime() > internal.contextChecked.GetMTime())
  {
    this->ReleaseGraphicsResources(internal.window);
    internal.window = window;
    internal.contextChecked.Modified();
    int major = 0;
    int minor = 0;
    window->GetOpenGLVersion(major, minor);
    internal.contextServes = major > 4 || (major == 4 && minor >= 3);
    if (!internal.contextServes)
    {
      vtkErrorMacro("Shadows need OpenGL 4.3, and this context has "
        << major << "." << minor << ". The scene is drawn without shadows.");
    }
  }
  return internal.contextServes;
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& internal = *this->Internal;
  if (internal.window)
  {
    // Mappers may hold the last reference to a pass that they were drawn with, and drop it while
    // another window is being drawn.
    internal.window->PushContext();
    internal.manager = std::make_unique<gnomon::RenderManager>();
    internal.window->PopContext();
  }
  else
  {
    const gnomon::GlContextLost contextLost;
    internal.manager = std::make_unique<gnomon::RenderManager>();
  }
  internal.window = nullptr;
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetTechnique(const char* name)
{
  const std::string technique = name ? name : "";
  if (!gnomon::findTechnique(technique))
  {
    vtkErrorMacro("There is no technique '" << technique
                                            << "'. There are: " << gnomon::techniqueNames() << ".");
    return;
  }
  if (this->Internal->technique != technique)
  {
    this->Internal->technique = technique;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechnique() const
{
  return this->Internal->technique.c_str();
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetDefaultTechnique()
{
  return gnomon::defaultTechnique;
}

//------------------------------------------------------------------------------
int vtkGnomonShadowPass::GetNumberOfTechniques()
{
  return static_cast<int>(gnomon::registry().size());
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueName(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].info.name.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueSummary(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].info.summary.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const gnomon::FrameReport& vtkGnomonShadowPass::GetReport() const
{
  return this->Internal->shadowed ? this->Internal->manager->report() : this->Internal->plainReport;
}

//------------------------------------------------------------------------------
const gnomon::VisibilityImages& vtkGnomonShadowPass::GetVisibility() const
{
  return this->Internal->manager->visibility();
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PreReplaceShaderValues(std::string& vtkNotUsed(vertexShader),
  std::string& vtkNotUsed(geometryShader), std::string& fragmentShader,
  vtkAbstractMapper* vtkNotUsed(mapper), vtkProp* vtkNotUsed(prop))
{
  this->Internal->manager->shaders().markShader(fragmentShader);
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PostReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* vtkNotUsed(mapper),
  vtkProp* prop)
{
  // Where other passes write outputs of their own, this is not the receivers stage.
  const bool alone = prop->GetPropertyKeys()->Length(vtkOpenGLRenderPass::RenderPasses()) == 1;
  this->Internal->manager->shaders().fillShader(
    vertexShader, geometryShader, fragmentShader, alone);
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper,
  vtkProp* prop, vtkOpenGLVertexArrayObject* vtkNotUsed(vao))
{
  this->Internal->manager->setShaderParameters(program, mapper, prop);
  return true;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkGnomonShadowPass::GetShaderStageMTime()
{
  return this->Internal->manager->shaders().stageTime();
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const routes[] = { "auto", "inline", "image" };
  os << indent << "Technique: " << this->GetTechnique() << "\n";
  os << indent << "MapSize: " << this->MapSize << "\n";
  os << indent << "Route: " << routes[this->Route] << "\n";
  os << indent << "MeasureStages: " << (this->MeasureStages ? "on" : "off") << "\n";
  os << indent << "KeepVisibility: " << (this->KeepVisibility ? "on" : "off") << "\n";
  os << indent << "ObeyUseShadows: " << (this->ObeyUseShadows ? "on" : "off") << "\n";
  os << indent << "Last frame's route: " << this->GetReport().route << "\n";
}
