#include "vtkGnomonShadowPass.h"

#include "plugin/VisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/FrameReport.h"

#include "vtkObjectFactory.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

vtkStandardNewMacro(vtkGnomonShadowPass);

struct vtkGnomonShadowPass::Internals
{
  std::string technique = gnomon::defaultTechnique;
  gnomon::FrameReport report;
  gnomon::VisibilityImages visibility;
};

vtkGnomonShadowPass::vtkGnomonShadowPass()
  : MapSize(1024)
  , Route(ROUTE_AUTO)
  , MeasureStages(false)
  , KeepVisibility(false)
  , Internal(new Internals)
{
}
vtkGnomonShadowPass::~vtkGnomonShadowPass() = default;
void vtkGnomonShadowPass::Render(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  this->UpdateCamera(renderer);
  this->UpdateLightGeometry(renderer);
  this->UpdateLights(renderer);
  this->UpdateGeometry(renderer, s->GetFrameBuffer());
}
void vtkGnomonShadowPass::SetTechnique(const char* name) { this->Internal->technique = name; }
const char* vtkGnomonShadowPass::GetTechnique() const { return this->Internal->technique.c_str(); }
const char* vtkGnomonShadowPass::GetDefaultTechnique() { return gnomon::defaultTechnique; }
int vtkGnomonShadowPass::GetNumberOfTechniques() { return static_cast<int>(gnomon::registry().size()); }
const char* vtkGnomonShadowPass::GetTechniqueName(int i) { return gnomon::registry()[static_cast<std::size_t>(i)].info.name.c_str(); }
const char* vtkGnomonShadowPass::GetTechniqueSummary(int i) { return gnomon::registry()[static_cast<std::size_t>(i)].info.summary.c_str(); }
const gnomon::FrameReport& vtkGnomonShadowPass::GetReport() const { return this->Internal->report; }
const gnomon::VisibilityImages& vtkGnomonShadowPass::GetVisibility() const { return this->Internal->visibility; }
void vtkGnomonShadowPass::ReleaseGraphicsResources(vtkWindow* w) { this->Superclass::ReleaseGraphicsResources(w); }
bool vtkGnomonShadowPass::PreReplaceShaderValues(std::string&, std::string&, std::string&, vtkAbstractMapper*, vtkProp*) { return true; }
bool vtkGnomonShadowPass::PostReplaceShaderValues(std::string&, std::string&, std::string&, vtkAbstractMapper*, vtkProp*) { return true; }
bool vtkGnomonShadowPass::SetShaderParameters(vtkShaderProgram*, vtkAbstractMapper*, vtkProp*, vtkOpenGLVertexArrayObject*) { return true; }
vtkMTimeType vtkGnomonShadowPass::GetShaderStageMTime() { return 0; }
void vtkGnomonShadowPass::PrintSelf(ostream& os, vtkIndent indent) { this->Superclass::PrintSelf(os, indent); }
