#include "vtkGnomonEGLRenderWindow.h"

#include "WindowScene.h"

#include "shadowtech/base/Gl.h"

#include <vtkFloatArray.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using gnomon::test::drawn;
using gnomon::test::makeSphereScene;
using gnomon::test::Picture;
using gnomon::test::readPicture;
using testing::HasSubstr;

namespace
{

/// Collects what VTK would print, while it lives.
class CapturedOutput : public vtkOutputWindow
{
public:
  static CapturedOutput* New();
  vtkTypeMacro(CapturedOutput, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Text += text; }

  std::string Text;
};
vtkStandardNewMacro(CapturedOutput);

/// Every test sees all that reaches standard error, directly or through VTK.
struct EGLRenderWindow : testing::Test
{
  void SetUp() override
  {
    // VTK says everything twice, to its log and to its output window; the window is enough.
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(this->output);
    testing::internal::CaptureStderr();
  }
  void TearDown() override
  {
    vtkOutputWindow::SetInstance(nullptr);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(this->output->Text, "");
  }
  /// Return and clear VTK's messages, so that the rest must be silent.
  std::string takeErrors() { return std::exchange(this->output->Text, std::string()); }

  vtkNew<CapturedOutput> output;
};

vtkSmartPointer<vtkGnomonEGLRenderWindow> makeWindow(int width = 64, int height = 48)
{
  auto window = vtkSmartPointer<vtkGnomonEGLRenderWindow>::New();
  window->SetSize(width, height);
  window->AddRenderer(makeSphereScene());
  return window;
}

/// Return the version of OpenGL, 45 for 4.5.
int versionOf(vtkGnomonEGLRenderWindow* window)
{
  int major = 0;
  int minor = 0;
  window->GetOpenGLVersion(major, minor);
  return 10 * major + minor;
}

std::string printed(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  return text.str();
}

std::size_t countColours(const Picture& picture)
{
  std::set<std::array<unsigned char, 3>> colours;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    colours.insert({ picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2] });
  }
  return colours.size();
}

std::ptrdiff_t countErrors(const std::string& text)
{
  const std::string begin = "ERROR: In ";
  std::ptrdiff_t count = 0;
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1))
  {
    ++count;
  }
  return count;
}

const glm::ivec3 background(51, 102, 153);

} // namespace

TEST_F(EGLRenderWindow, drawsWithoutADisplayAndWithoutAWord)
{
  ASSERT_EQ(std::getenv("DISPLAY"), nullptr);
  const auto window = makeWindow(160, 120);
  const auto picture = drawn(window);
  ASSERT_EQ(picture.rgb.size(), 3u * 160 * 120);
  EXPECT_EQ(picture.at(2, 117), background);
  const auto sphere = picture.at(80, 60);
  EXPECT_GT(sphere[0], sphere[1] + 40);   // the sphere is red
  EXPECT_GT(countColours(picture), 100u); // and shaded
}

TEST_F(EGLRenderWindow, isAsLargeAsVtksWindowsByDefault)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->AddRenderer(makeSphereScene());
  const auto picture = drawn(window);
  ASSERT_EQ(picture.rgb.size(), 3u * 300 * 300);
  EXPECT_GT(countColours(picture), 50u);
}

TEST_F(EGLRenderWindow, asksForOpenGL45AndTellsWhatItGot)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  EXPECT_EQ(window->GetContextVersion()[0], 4);
  EXPECT_EQ(window->GetContextVersion()[1], 5);
  window->Initialize();
  EXPECT_GE(versionOf(window), 45);
  EXPECT_THAT(window->ReportCapabilities(), HasSubstr("OpenGL version string:"));
  EXPECT_GT(window->GetMaximumHardwareLineWidth(), 0.0f);
  EXPECT_EQ(window->SupportsOpenGL(), 1);
}

/// A renderer asks for the depths' bits when it first places the clipping planes. VTK's window asks
/// the default framebuffer, which there is none of here: an error of OpenGL, and 0 bits, for which
/// the nearer plane was put ten times as far away as it need be.
TEST_F(EGLRenderWindow, clippingPlanesArePlacedBetweenFramesAsBeforeTheFirst)
{
  const auto rangeOf = [](vtkRenderer* renderer)
  {
    renderer->ResetCameraClippingRange(-1.0, 1.0, -100.0, 100.0, -1.0, 1.0); // from near to far
    const double* range = renderer->GetActiveCamera()->GetClippingRange();
    return std::array<double, 2>{ { range[0], range[1] } };
  };
  const auto window = makeWindow();
  vtkNew<vtkRenderer> before;
  before->SetActiveCamera(window->GetRenderers()->GetFirstRenderer()->GetActiveCamera());
  window->AddRenderer(before);
  EXPECT_EQ(window->GetDepthBufferSize(), 24);
  const auto expected = rangeOf(before);
  EXPECT_NEAR(expected[0] / expected[1], 0.001, 1e-6);

  window->Render();
  EXPECT_GE(window->GetDepthBufferSize(), 24);
  vtkNew<vtkRenderer> after;
  after->SetActiveCamera(before->GetActiveCamera());
  window->AddRenderer(after);
  EXPECT_EQ(rangeOf(after), expected);
  window->MakeCurrent();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(EGLRenderWindow, twoWindowsAlternate)
{
  const auto first = makeWindow();
  const auto second = makeWindow(80, 60);
  const auto firstPicture = drawn(first);
  second->Render();
  EXPECT_FALSE(second->IsCurrent()) << "pictures leave no context behind";
  EXPECT_GE(versionOf(second), 30);
  second->WaitForCompletion();
  EXPECT_FALSE(first->IsCurrent());
  first->MakeCurrent();
  second->Render();
  EXPECT_TRUE(first->IsCurrent()) << "they restore the one before";
  first->ReleaseCurrent();
  const auto secondPicture = readPicture(second);
  EXPECT_EQ(readPicture(first), firstPicture); // reading makes the right context current
  for (int i = 0; i < 3; ++i)
  {
    first->Render();
    second->Render();
  }
  EXPECT_EQ(readPicture(first), firstPicture);
  EXPECT_EQ(readPicture(second), secondPicture);
}

TEST_F(EGLRenderWindow, oneWindowGoesAndTheOtherDrawsOn)
{
  const auto staying = makeWindow();
  const auto picture = drawn(staying);
  {
    const auto going = makeWindow();
    going->Render();
    staying->MakeCurrent();
  }
  EXPECT_TRUE(staying->IsCurrent()); // the one that went took nothing away
  EXPECT_EQ(drawn(staying), picture);
}

TEST_F(EGLRenderWindow, followsItsSize)
{
  const auto window = makeWindow(100, 100);
  window->Render();
  window->SetSize(200, 50);
  const auto wide = drawn(window);
  ASSERT_EQ(wide.rgb.size(), 3u * 200 * 50);
  window->SetSize(100, 100);
  window->Render();

  EXPECT_EQ(wide, drawn(makeWindow(200, 50)));
}

TEST_F(EGLRenderWindow, multisamplingIsOffUntilAskedFor)
{
  const auto window = makeWindow(100, 100);
  EXPECT_EQ(window->GetMultiSamples(), 0);
  const auto aliased = drawn(window);
  window->SetMultiSamples(4);
  const auto smooth = drawn(window);
  EXPECT_FALSE(smooth == aliased);
  EXPECT_GT(countColours(smooth), countColours(aliased)); // edges mix colours
}

TEST_F(EGLRenderWindow, startsAgainAfterFinalize)
{
  const auto window = makeWindow();
  window->Finalize(); // before there is anything
  const auto picture = drawn(window);
  window->Finalize();
  window->Finalize();
  EXPECT_FALSE(window->IsCurrent());
  EXPECT_EQ(window->GetGenericContext(), nullptr);
  EXPECT_EQ(drawn(window), picture);
}

TEST_F(EGLRenderWindow, aRendererOutlivesItsWindow)
{
  const auto renderer = makeSphereScene();
  Picture picture;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkGnomonEGLRenderWindow> window;
    window->SetSize(64, 48);
    window->AddRenderer(renderer);
    window->Render();
    if (i == 0)
    {
      picture = readPicture(window);
    }
    EXPECT_EQ(readPicture(window), picture);
  }
  EXPECT_EQ(renderer->GetRenderWindow(), nullptr);
}

TEST_F(EGLRenderWindow, everyListedDeviceCanBeAskedFor)
{
  const std::size_t bytes = drawn(makeWindow()).rgb.size();
  vtkNew<vtkGnomonEGLRenderWindow> window;
  EXPECT_EQ(window->GetDeviceIndex(), -1);
  ASSERT_GE(window->GetNumberOfDevices(), 1);
  for (int i = 0; i < window->GetNumberOfDevices(); ++i)
  {
    const auto onDevice = makeWindow();
    onDevice->SetDeviceIndex(i);
    EXPECT_EQ(drawn(onDevice).rgb.size(), bytes);
    EXPECT_GT(countColours(readPicture(onDevice)), 50u);
  }
}

TEST_F(EGLRenderWindow, aDeviceThatIsNotThereIsAnErrorAndNoCrash)
{
  const auto window = makeWindow();
  window->SetDeviceIndex(99);
  window->Render();
  EXPECT_THAT(this->takeErrors(), HasSubstr("EGL device 99 was asked for, but EGL lists"));
  EXPECT_STREQ(window->ReportCapabilities(), "");
  this->takeErrors();
  readPicture(window);
  EXPECT_THAT(this->takeErrors(), HasSubstr("before the first Render()"));
  window->Finalize();

  window->SetDeviceIndex(-1); // and the window is none the worse for it
  EXPECT_GT(countColours(drawn(window)), 50u);
}

TEST_F(EGLRenderWindow, pixelsBeforeTheFirstFrameAreAnError)
{
  const auto window = makeWindow(8, 8);
  window->Initialize();
  std::vector<unsigned char> bytes(3 * 8 * 8);
  std::vector<float> floats(4 * 8 * 8);
  const auto expectError = [&](int result)
  {
    EXPECT_EQ(result, VTK_ERROR);
    EXPECT_THAT(this->takeErrors(), HasSubstr("before the first Render()"));
  };
  expectError(window->SetPixelData(0, 0, 7, 7, bytes.data(), 1));
  expectError(window->SetRGBAPixelData(0, 0, 7, 7, floats.data(), 1));
  expectError(window->GetZbufferData(0, 0, 7, 7, floats.data()));
  expectError(window->SetZbufferData(0, 0, 7, 7, floats.data()));
}

// X's interactor is the one that VTK's factory makes here, with and without an X server.
TEST_F(EGLRenderWindow, interactorsDrawAndOnlyXsIsAnError)
{
  for (const bool isDrawn : { false, true })
  {
    for (const char* kind : { "vtkXRenderWindowInteractor", "vtkGenericRenderWindowInteractor" })
    {
      SCOPED_TRACE(std::string(kind) + (isDrawn ? ", drawn before" : ""));
      const auto window = makeWindow();
      if (isDrawn)
      {
        window->Render();
      }
      const bool isX = kind[3] == 'X';
      const auto interactor = isX ? vtkSmartPointer<vtkRenderWindowInteractor>::New()
                                  : vtkSmartPointer(window->MakeRenderWindowInteractor());
      ASSERT_STREQ(interactor->GetClassName(), kind);
      interactor->SetRenderWindow(window);
      EXPECT_EQ(window->GetInteractor(), interactor);
      const std::string errors = this->takeErrors();
      EXPECT_EQ(countErrors(errors), isX ? 1 : 0);
      EXPECT_EQ(errors.find("Use a vtkGenericRenderWindowInteractor.") != std::string::npos, isX);
      interactor->Initialize();
      interactor->Start();
      interactor->Render();
      EXPECT_GT(countColours(readPicture(window)), 50u);
      interactor->TerminateApp();
      interactor->Disable();
    }
  }
}

TEST_F(EGLRenderWindow, callsOnASecondThreadAreOneErrorUntilTheFirstReleasesTheContext)
{
  const auto window = makeWindow();
  const auto picture = drawn(window);
  vtkNew<vtkFloatArray> depths;
  int bits[4];
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window);
  for (const std::function<void()>& call :
    std::initializer_list<std::function<void()>>{
      [&] { window->Render(); },
      [&] { window->Start(); },
      [&] { filter->Update(); },
      [&] { readPicture(window); },
      [&] { window->GetZbufferData(0, 0, 3, 3, depths); },
      [&] { window->SetZbufferData(0, 0, 63, 47, std::vector<float>(64 * 48).data()); },
      [&] { window->GetColorBufferSizes(bits); },
      [&] { window->GetDepthBufferSize(); },
      [&] { EXPECT_STREQ(window->ReportCapabilities(), ""); },
      [&] { window->Finalize(); },
    })
  {
    window->MakeCurrent();
    std::thread(call).join();
    const std::string errors = this->takeErrors();
    EXPECT_EQ(countErrors(errors), 1) << errors;
    EXPECT_THAT(errors, HasSubstr("call ReleaseCurrent() there first"));
    EXPECT_EQ(drawn(window), picture);
  }

  window->ReleaseCurrent();
  std::thread([&] { EXPECT_EQ(drawn(window), picture); }).join();
  EXPECT_EQ(drawn(window), picture);
}

TEST_F(EGLRenderWindow, saysOneErrorInAForkedProcess)
{
  const auto window = makeWindow();
  const auto picture = drawn(window);
  for (const bool isNew : { false, true })
  {
    const pid_t child = fork();
    if (child == 0)
    {
      this->takeErrors();
      const auto drawn = isNew ? makeWindow() : window;
      drawn->Render();
      drawn->Render();
      const std::string errors = this->takeErrors();
      _exit(countErrors(errors) == 1 && errors.find("forked") != std::string::npos ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << isNew;
  }
  EXPECT_EQ(drawn(window), picture);
}

TEST_F(EGLRenderWindow, noArrayIsOneErrorOfEachMethod)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  vtkFloatArray* const floats = nullptr;
  vtkUnsignedCharArray* const bytes = nullptr;
  float* const numbers = nullptr;
  unsigned char* const colours = nullptr;
  const std::vector<std::function<void()>> calls{
    [&] { window->GetZbufferData(0, 0, 1, 1, floats); },
    [&] { window->GetZbufferData(0, 0, 1, 1, numbers); },
    [&] { window->SetZbufferData(0, 0, 1, 1, floats); },
    [&] { window->SetZbufferData(0, 0, 1, 1, numbers); },
    [&] { window->SetPixelData(0, 0, 1, 1, bytes, 1); },
    [&] { window->SetPixelData(0, 0, 1, 1, colours, 1); },
    [&] { window->SetRGBAPixelData(0, 0, 1, 1, floats, 1); },
    [&] { window->SetRGBAPixelData(0, 0, 1, 1, numbers, 1); },
    [&] { window->SetRGBACharPixelData(0, 0, 1, 1, bytes, 1); },
    [&] { window->SetRGBACharPixelData(0, 0, 1, 1, colours, 1); },
  };
  for (const auto& call : calls)
  {
    call();
    const std::string errors = this->takeErrors();
    EXPECT_THAT(errors, HasSubstr("no array"));
    EXPECT_EQ(countErrors(errors), 1);
  }
}

TEST_F(EGLRenderWindow, printsWhatItStandsOn)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  EXPECT_THAT(printed(window),
    testing::AllOf(
      HasSubstr("ContextVersion: 4.5"), HasSubstr("DeviceIndex: -1"), HasSubstr("Context: EGL ")));
}

// The tests below need an environment of their own, which their registration with CTest sets.

using EGLRenderWindowWithoutEgl = EGLRenderWindow;
TEST_F(EGLRenderWindowWithoutEgl, saysWhatWasTriedAndDrawsNothing)
{
  const auto window = makeWindow();
  window->Render();
  const std::string errors = this->takeErrors();
  EXPECT_THAT(errors, HasSubstr("No OpenGL context without a display could be made"));
  EXPECT_THAT(errors, HasSubstr("EGL default display"));
  EXPECT_EQ(window->SupportsOpenGL(), 0);
}

using EGLRenderWindowOnOldOpenGL = EGLRenderWindow;
TEST_F(EGLRenderWindowOnOldOpenGL, fallsBackToTheVersionThatIsThere)
{
  const auto window = makeWindow();
  window->GetRenderers()->GetFirstRenderer()->SetPass(nullptr); // shadows need 4.3, the window 3.2
  window->Render();
  EXPECT_EQ(versionOf(window), 33);
  EXPECT_GT(countColours(readPicture(window)), 50u);
}

using EGLRenderWindowDeviceVariable = EGLRenderWindow;
TEST_F(EGLRenderWindowDeviceVariable, picksTheDevice)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  EXPECT_EQ(window->GetDeviceIndex(), 0);
  window->Initialize();
  EXPECT_THAT(printed(window), HasSubstr("Context: EGL device 0"));
}

using EGLRenderWindowBadDeviceVariable = EGLRenderWindow;
TEST_F(EGLRenderWindowBadDeviceVariable, isNamedAndIgnored)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  EXPECT_THAT(this->takeErrors(), HasSubstr("VTK_DEFAULT_EGL_DEVICE_INDEX is \"first\""));
  EXPECT_EQ(window->GetDeviceIndex(), -1);
}
