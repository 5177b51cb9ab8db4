#include "vtkGnomonEGLRenderWindow.h"

#include "plugin/pass/Complaints.h"
#include "plugin/vtk_versions/OpenGlLoading.h"
#include "plugin/window/EglContext.h"

#include "shadowtech/base/Gl.h"

#include "vtkCallbackCommand.h"
#include "vtkFloatArray.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkGnomonEGLRenderWindow);

namespace
{

/// X's interactors take a window's display for X's, and crash. An interactor that is marked as
/// initialized and done does not ask for it. Naming its members through a subclass gives access.
struct XInteractorAccess : vtkRenderWindowInteractor
{
  static void keepFromDisplay(vtkRenderWindowInteractor* interactor)
  {
    interactor->*(&XInteractorAccess::Initialized) = 1;
    interactor->*(&XInteractorAccess::Enabled) = 1;
    interactor->*(&XInteractorAccess::Done) = true;
    vtkNew<vtkCallbackCommand> nothing;
    interactor->AddObserver(vtkCommand::StartEvent, nothing); // instead of X's loop of events
  }
};

} // namespace

//------------------------------------------------------------------------------
vtkGnomonEGLRenderWindow::vtkGnomonEGLRenderWindow()
  : ContextVersion{ 4, 5 }
  , Complaints(std::make_unique<gnomon::Complaints>())
{
  this->DeviceIndex = -1;
  if (const char* text = std::getenv("VTK_DEFAULT_EGL_DEVICE_INDEX"))
  {
    char* end = nullptr;
    const long index = std::strtol(text, &end, 10);
    if (end == text || *end != '\0' || index < -1 || index > VTK_INT_MAX)
    {
      vtkErrorMacro("VTK_DEFAULT_EGL_DEVICE_INDEX is \""
        << text << "\"; expected the number of an EGL device, or -1. It is ignored.");
    }
    else
    {
      this->DeviceIndex = static_cast<int>(index);
    }
  }
  this->SetSize(300, 300); // as VTK's windows
  this->SetMultiSamples(0);
  this->SetOffScreenRendering(1);
  this->SetFrameBlitModeToNoBlit(); // there is nothing to show the picture on
}

//------------------------------------------------------------------------------
vtkGnomonEGLRenderWindow::~vtkGnomonEGLRenderWindow()
{
  this->Finalize();
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
  {
    renderer->SetRenderWindow(nullptr);
  }
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::GetNumberOfDevices()
{
  return gnomon::EglContext::numberOfDevices();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::Initialize()
{
  if (this->Initialized)
  {
    return;
  }
  this->CreateAWindow();
  if (this->Context)
  {
    this->OpenGLInit();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::CreateAWindow()
{
  try
  {
    gnomon::EglRequest request;
    request.majorVersion = this->ContextVersion[0];
    request.minorVersion = this->ContextVersion[1];
    request.deviceIndex = this->DeviceIndex;
    this->Context = std::make_unique<gnomon::EglContext>(request);
  }
  catch (const std::runtime_error& error)
  {
    this->TellOfContext(
      std::string("No OpenGL context without a display could be made. ") + error.what() + ".");
  }
}

//------------------------------------------------------------------------------
/// @param error empty: there is none
void vtkGnomonEGLRenderWindow::TellOfContext(const std::string& error)
{
  this->Complaints->tellError(this, nullptr, gnomon::Topic::Context, error);
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::Finalize()
{
  this->DestroyWindow();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::DestroyWindow()
{
  this->ReleaseGraphicsResources(this);
  this->Context.reset();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::WindowRemap()
{
  this->Finalize();
  this->Initialize();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::Start()
{
  if (this->EnsureContext())
  {
    this->Superclass::Start();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::Render()
{
  const gnomon::CurrentContext restored;
  if (this->EnsureContext())
  {
    this->Superclass::Render();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::MakeCurrent()
{
  if (this->Context && gnomon::GlxContext::isCurrent())
  {
    this->Replaced = std::make_unique<gnomon::CurrentContext>();
  }
  this->BecomeCurrent();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::BecomeCurrent()
{
  if (this->Context && !this->Context->isOfThisProcess())
  {
    this->TellOfContext(
      "The process was forked after this window was made" + gnomon::forkAdvice + ".");
  }
  else if (this->Context && !this->Context->makeCurrent())
  {
    this->TellOfContext("The window's context cannot be made current on this thread (" +
      gnomon::EglContext::lastError() +
      "). If another thread used the window, call ReleaseCurrent() there first.");
  }
}

//------------------------------------------------------------------------------
/// Make the context ready and current; report the reason if that fails, and return false.
bool vtkGnomonEGLRenderWindow::EnsureContext()
{
  this->Initialize();
  this->BecomeCurrent();
  const bool has = this->Initialized && this->IsCurrent();
  if (has)
  {
    this->TellOfContext("");
  }
  return has;
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    this->Context->release();
  }
  this->Replaced.reset();
}

//------------------------------------------------------------------------------
bool vtkGnomonEGLRenderWindow::IsCurrent()
{
  return this->Context && this->Context->isCurrent();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::PushContext()
{
  this->ContextStack.push_back(std::make_unique<gnomon::CurrentContext>());
  this->BecomeCurrent();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::PopContext()
{
  this->ContextStack.pop_back();
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::OpenGLInitContext()
{
  this->ContextCreationTime.Modified();
  if (this->Initialized)
  {
    return;
  }
  const std::string problem = gnomon::loadOpenGl(this, gnomon::EglContext::findFunction);
  if (!problem.empty())
  {
    this->TellOfContext("OpenGL's functions could not be loaded: " + problem + ".");
    return;
  }
  if (!GNOMON_HAS_GL(VERSION_3_2))
  {
    const auto* const version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    this->TellOfContext("VTK needs OpenGL 3.2; " + this->Context->platform() + " gives " +
      (version ? version : "none") + ".");
    return;
  }
  this->TellOfContext("");
  this->Initialized = true;
  GLfloat lineWidths[2] = { 1.0f, 1.0f };
  glGetFloatv(
    this->LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, lineWidths);
  this->MaximumHardwareLineWidth = lineWidths[1];
}

//------------------------------------------------------------------------------
const char* vtkGnomonEGLRenderWindow::ReportCapabilities()
{
  const gnomon::CurrentContext restored;
  return this->EnsureContext() ? this->Superclass::ReportCapabilities() : "";
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::GetOpenGLVersion(int& major, int& minor)
{
  const gnomon::CurrentContext restored;
  this->BecomeCurrent();
  this->Superclass::GetOpenGLVersion(major, minor);
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::WaitForCompletion()
{
  const gnomon::CurrentContext restored;
  this->BecomeCurrent();
  this->Superclass::WaitForCompletion();
}

//------------------------------------------------------------------------------
void* vtkGnomonEGLRenderWindow::GetGenericDisplayId()
{
  return this->Context ? this->Context->display() : nullptr;
}

//------------------------------------------------------------------------------
void* vtkGnomonEGLRenderWindow::GetGenericContext()
{
  return this->Context ? this->Context->context() : nullptr;
}

//------------------------------------------------------------------------------
vtkRenderWindowInteractor* vtkGnomonEGLRenderWindow::MakeRenderWindowInteractor()
{
  this->SetInteractor(vtkNew<vtkGenericRenderWindowInteractor>());
  return this->Interactor;
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  this->Superclass::SetInteractor(interactor);
  if (interactor && interactor->IsA("vtkXRenderWindowInteractor") && !interactor->GetInitialized())
  {
    XInteractorAccess::keepFromDisplay(interactor);
    vtkErrorMacro("A window without a display sends a "
      << interactor->GetClassName()
      << " no events: Start() returns at once. Use a vtkGenericRenderWindowInteractor.");
  }
}

//------------------------------------------------------------------------------
int* vtkGnomonEGLRenderWindow::GetScreenSize()
{
  // A screen of the window's own size.
  std::copy_n(this->Size, 2, this->ScreenSize);
  return this->ScreenSize;
}

//------------------------------------------------------------------------------
/// Read or write pixels of the frame.
/// @param pixels the array for them
template <typename Call>
int vtkGnomonEGLRenderWindow::WithFrame(const void* pixels, const Call& call)
{
  if (!pixels)
  {
    vtkErrorMacro("There is no array to read pixels into or write them from.");
    return VTK_ERROR;
  }
  if (!this->Initialized || !this->RenderFramebuffer->GetFBOIndex())
  {
    vtkErrorMacro("There are no pixels to read or write before the first Render().");
    return VTK_ERROR;
  }
  int result = VTK_ERROR;
  {
    const gnomon::CurrentContext restored;
    result = this->EnsureContext() ? call() : VTK_ERROR;
  }
  // Filters make the window current to read it. A selection goes on afterwards.
  if (!this->IsSelecting())
  {
    this->Replaced.reset();
  }
  return result;
}

//------------------------------------------------------------------------------
bool vtkGnomonEGLRenderWindow::IsSelecting()
{
  bool isSelecting = false;
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
  {
    isSelecting = isSelecting || renderer->GetSelector();
  }
  return isSelecting;
}

//------------------------------------------------------------------------------
/// Ask OpenGL about the bound frame.
/// @param otherwise returned if there is none
template <typename Ask>
int vtkGnomonEGLRenderWindow::AskFrame(int otherwise, const Ask& ask)
{
  const gnomon::CurrentContext restored;
  if (!this->Initialized || !this->RenderFramebuffer->GetFBOIndex() || !this->EnsureContext())
  {
    return otherwise;
  }
  this->GetState()->PushFramebufferBindings();
  this->RenderFramebuffer->Bind();
  const int answer = ask();
  this->GetState()->PopFramebufferBindings();
  return answer;
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::GetColorBufferSizes(int* rgba)
{
  if (!rgba)
  {
    return 0;
  }
  // A context without a surface has no other buffers, and newer VTK warns when it asks for them.
  std::fill_n(rgba, 4, 0);
  return this->AskFrame(0, [&] { return this->Superclass::GetColorBufferSizes(rgba); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::GetDepthBufferSize()
{
  return this->AskFrame(24, [&] { return this->Superclass::GetDepthBufferSize(); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::ReadPixels(
  const vtkRecti& rect, int front, int glFormat, int glType, void* data, int right)
{
  return this->WithFrame(
    data, [&] { return this->Superclass::ReadPixels(rect, front, glFormat, glType, data, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, float* z)
{
  return this->WithFrame(z, [&] { return this->Superclass::GetZbufferData(x1, y1, x2, y2, z); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer)
{
  return this->WithFrame(
    buffer, [&] { return this->Superclass::GetZbufferData(x1, y1, x2, y2, buffer); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetZbufferData(int x1, int y1, int x2, int y2, float* buffer)
{
  return this->WithFrame(
    buffer, [&] { return this->Superclass::SetZbufferData(x1, y1, x2, y2, buffer); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer)
{
  return this->WithFrame(
    buffer, [&] { return this->Superclass::SetZbufferData(x1, y1, x2, y2, buffer); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetPixelData(
  int x1, int y1, int x2, int y2, unsigned char* data, int front, int right)
{
  return this->WithFrame(
    data, [&] { return this->Superclass::SetPixelData(x1, y1, x2, y2, data, front, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetPixelData(
  int x1, int y1, int x2, int y2, vtkUnsignedCharArray* data, int front, int right)
{
  return this->WithFrame(
    data, [&] { return this->Superclass::SetPixelData(x1, y1, x2, y2, data, front, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetRGBAPixelData(
  int x1, int y1, int x2, int y2, float* data, int front, int blend, int right)
{
  return this->WithFrame(data,
    [&] { return this->Superclass::SetRGBAPixelData(x1, y1, x2, y2, data, front, blend, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetRGBAPixelData(
  int x1, int y1, int x2, int y2, vtkFloatArray* data, int front, int blend, int right)
{
  return this->WithFrame(data,
    [&] { return this->Superclass::SetRGBAPixelData(x1, y1, x2, y2, data, front, blend, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetRGBACharPixelData(
  int x1, int y1, int x2, int y2, unsigned char* data, int front, int blend, int right)
{
  return this->WithFrame(data,
    [&]
    { return this->Superclass::SetRGBACharPixelData(x1, y1, x2, y2, data, front, blend, right); });
}

//------------------------------------------------------------------------------
int vtkGnomonEGLRenderWindow::SetRGBACharPixelData(
  int x1, int y1, int x2, int y2, vtkUnsignedCharArray* data, int front, int blend, int right)
{
  return this->WithFrame(data,
    [&]
    { return this->Superclass::SetRGBACharPixelData(x1, y1, x2, y2, data, front, blend, right); });
}

//------------------------------------------------------------------------------
void vtkGnomonEGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ContextVersion: " << this->ContextVersion[0] << "." << this->ContextVersion[1]
     << "\n";
  os << indent << "DeviceIndex: " << this->DeviceIndex << "\n";
  os << indent << "Context: " << (this->Context ? this->Context->platform() : "(none)") << "\n";
}
