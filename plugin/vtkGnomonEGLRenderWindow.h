/**
 * @class   vtkGnomonEGLRenderWindow
 * @brief   a window without a display: OpenGL through EGL, with no X server
 *
 * For VTK builds that have only GLX windows, such as Debian's. The window draws into VTK's own
 * framebuffers and shows nothing; pictures are read with vtkWindowToImageFilter or GetPixelData as
 * from any window.
 *
 * @code
 * vtkNew<vtkGnomonEGLRenderWindow> window;
 * window->SetSize(1024, 1024);
 * window->AddRenderer(renderer);
 * window->Render();
 * @endcode
 *
 * SetDeviceIndex, or VTK_DEFAULT_EGL_DEVICE_INDEX in the environment, picks one of EGL's devices
 * (graphics cards, and Mesa's software renderer). Without them the window takes the first that
 * works of: hardware devices, the surfaceless platform, software devices, the default display.
 *
 * Multisampling is off by default (SetMultiSamples). If no context can be made, Initialize() and
 * all calls that need one draw nothing. One error (vtkErrorMacro) tells what was tried.
 *
 * <b>Beside other windows and threads.</b> Its functions leave the context of the thread that was
 * current before, of another window's (of X's, too) or none. So windows may take turns on a thread,
 * and threads on a window. Initialize(), MakeCurrent() and Start() alone leave the window's context
 * current, until ReleaseCurrent() or, in place of a context of X, the next reading of pixels. While
 * it is, calls on another thread are one error and draw nothing, and X's windows on this thread end
 * the process. A process that was forked afterwards cannot draw, which is one error.
 */

#ifndef vtkGnomonEGLRenderWindow_h
#define vtkGnomonEGLRenderWindow_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkOpenGLRenderWindow.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

namespace gnomon
{
class Complaints;
class CurrentContext;
class EglContext;
}

class GNOMONPLUGIN_EXPORT vtkGnomonEGLRenderWindow : public vtkOpenGLRenderWindow
{
public:
  static vtkGnomonEGLRenderWindow* New();
  vtkTypeMacro(vtkGnomonEGLRenderWindow, vtkOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set the OpenGL core version to ask for when the context is made. Lower versions down to 3.2 are
   * tried after it; the driver may give a higher one that is compatible (GetOpenGLVersion tells).
   * Default 4.5.
   */
  vtkSetVector2Macro(ContextVersion, int);
  vtkGetVector2Macro(ContextVersion, int);
  ///@}

  /**
   * Return the number of devices that EGL lists; 0 where it cannot list them. SetDeviceIndex takes
   * one of [0, GetNumberOfDevices()), or -1 (the default) for the best that works.
   */
  int GetNumberOfDevices() override;

  ///@{
  /**
   * Make the context, or let it go with all that lives in it. Both may be called again, in any
   * order; drawing makes the context by itself.
   */
  void Initialize() override;
  void Finalize() override;
  ///@}

  ///@{
  /**
   * Draw the renderers into the window's framebuffers. Without a context nothing is drawn.
   */
  void Start() override;
  void Render() override;
  ///@}

  ///@{
  /**
   * Make the context current on this thread, or release it.
   */
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  void PushContext() override;
  void PopContext() override;
  ///@}

  /**
   * Load OpenGL's functions.
   */
  void OpenGLInitContext() override;

  ///@{
  /**
   * Return a text about the driver, empty if no context can be made; return OpenGL's version; wait
   * until all is drawn.
   */
  const char* ReportCapabilities() override;
  void GetOpenGLVersion(int& major, int& minor);
  void WaitForCompletion() override;
  ///@}

  ///@{
  /**
   * Return EGL's display and context; null before Initialize().
   */
  void* GetGenericDisplayId() override;
  void* GetGenericContext() override;
  ///@}

  using vtkOpenGLRenderWindow::GetZbufferData;
  ///@{
  /**
   * Read and write pixels. An error before the first Render(), and without an array.
   */
  int GetZbufferData(int x1, int y1, int x2, int y2, float* z) override;
  int GetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer)
    VTK_EXPECTS(buffer != nullptr) override;
  int SetZbufferData(int x1, int y1, int x2, int y2, float* buffer) override;
  int SetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer)
    VTK_EXPECTS(buffer != nullptr) override;
  int SetPixelData(
    int x1, int y1, int x2, int y2, unsigned char* data, int front, int right = 0) override;
  int SetPixelData(int x1, int y1, int x2, int y2, vtkUnsignedCharArray* data, int front,
    int right = 0) VTK_EXPECTS(data != nullptr) override;
  int SetRGBAPixelData(
    int x1, int y1, int x2, int y2, float* data, int front, int blend = 0, int right = 0) override;
  int SetRGBAPixelData(int x1, int y1, int x2, int y2, vtkFloatArray* data, int front,
    int blend = 0, int right = 0) VTK_EXPECTS(data != nullptr) override;
  int SetRGBACharPixelData(int x1, int y1, int x2, int y2, unsigned char* data, int front,
    int blend = 0, int right = 0) override;
  int SetRGBACharPixelData(int x1, int y1, int x2, int y2, vtkUnsignedCharArray* data, int front,
    int blend = 0, int right = 0) VTK_EXPECTS(data != nullptr) override;
  ///@}

  ///@{
  /**
   * Return the bits per channel, or of the depths, of the framebuffer that the renderers draw into:
   * there is no other. Hardware selection asks for the first,
   * vtkRenderer::ResetCameraClippingRange for the second; before the first Render() that is 24, as
   * in VTK's own windows.
   */
  int GetColorBufferSizes(int* rgba) VTK_SIZEHINT(rgba, 4) override;
  int GetDepthBufferSize() override;
  ///@}

  ///@{
  /**
   * Make the interactor, or set it. The default is a vtkGenericRenderWindowInteractor, which gets
   * the events that the program sends it. X's interactor is an error: it gets no events, draws, and
   * its Start() returns at once.
   */
  vtkRenderWindowInteractor* MakeRenderWindowInteractor() override;
  void SetInteractor(vtkRenderWindowInteractor* interactor) override;
  ///@}

  ///@{
  /**
   * Answer as a window without a screen.
   */
  int* GetScreenSize() override;
  vtkTypeBool IsDirect() override { return 1; }
  void WindowRemap() override;
  ///@}

protected:
  vtkGnomonEGLRenderWindow();
  ~vtkGnomonEGLRenderWindow() override;

  int ReadPixels(
    const vtkRecti& rect, int front, int glFormat, int glType, void* data, int right = 0) override;
  void CreateAWindow() override;
  void DestroyWindow() override;

  int ContextVersion[2];

private:
  vtkGnomonEGLRenderWindow(const vtkGnomonEGLRenderWindow&) = delete;
  void operator=(const vtkGnomonEGLRenderWindow&) = delete;

  void BecomeCurrent();
  bool EnsureContext();
  template <typename Ask>
  int AskFrame(int otherwise, const Ask& ask);
  bool IsSelecting();
  template <typename Call>
  int WithFrame(const void* pixels, const Call& call);
  void TellOfContext(const std::string& error);

  std::unique_ptr<gnomon::EglContext> Context;
  std::vector<std::unique_ptr<gnomon::CurrentContext>> ContextStack;
  std::unique_ptr<gnomon::CurrentContext> Replaced; // X's, by MakeCurrent()
  std::unique_ptr<gnomon::Complaints> Complaints;
};

#endif
