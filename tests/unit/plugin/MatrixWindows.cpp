#include "MatrixWindows.h"

#include "plugin/vtk_versions/OpenGlLoading.h"
#include "shadowtech/base/Gl.h"

#include <vtkGenericOpenGLRenderWindow.h>

namespace gnomon::test
{
namespace
{

class SeveralSamples : public MatrixWindow
{
public:
  explicit SeveralSamples(PassScene& scene)
    : MatrixWindow(scene)
  {
    scene.window->SetMultiSamples(4); // llvmpipe's number before Mesa 26, which has 8
  }
  ~SeveralSamples() override { this->scene_.window->SetMultiSamples(0); }
  bool hasSeveralSamples() const override { return true; }
};

/// A viewport that is a part of the window, and as large as the scene's window was.
class Part : public MatrixWindow
{
public:
  explicit Part(PassScene& scene)
    : MatrixWindow(scene)
    , width_(scene.window->GetSize()[0])
    , height_(scene.window->GetSize()[1])
  {
    scene.window->SetSize(2 * this->width_, 4 * this->height_);
    scene.renderer->SetViewport(0.25, 0.5, 0.75, 0.75);
  }
  ~Part() override
  {
    this->scene_.window->SetSize(this->width_, this->height_);
    this->scene_.renderer->SetViewport(0.0, 0.0, 1.0, 1.0);
  }
  Picture draw(int) override
  {
    this->scene_.render();
    return readPicture(this->scene_.window, { this->width_ / 2, 2 * this->height_ },
      { this->width_, this->height_ });
  }

private:
  int width_;
  int height_;
};

/// Two by two tiles of a larger picture.
class Tiled : public MatrixWindow
{
public:
  explicit Tiled(PassScene& scene)
    : MatrixWindow(scene)
  {
    scene.window->SetTileScale(2);
  }
  ~Tiled() override
  {
    this->scene_.window->SetTileScale(1);
    this->scene_.window->SetTileViewport(0.0, 0.0, 1.0, 1.0);
  }
  int views() const override { return 4; }
  Picture draw(int view) override
  {
    const double left = 0.5 * (view % 2);
    const double bottom = 0.5 * (view / 2);
    this->scene_.window->SetTileViewport(left, bottom, left + 0.5, bottom + 0.5);
    return this->scene_.render();
  }
};

class Stereo : public MatrixWindow
{
public:
  explicit Stereo(PassScene& scene)
    : MatrixWindow(scene)
  {
    scene.window->SetStereoRender(1);
  }
  ~Stereo() override { this->scene_.window->SetStereoRender(0); }
  int views() const override { return 2; }
  Picture draw(int view) override
  {
    this->scene_.window->SetStereoType(view == 0 ? VTK_STEREO_LEFT : VTK_STEREO_RIGHT);
    return this->scene_.render();
  }
};

/// A layer above another renderer, which has its own shadows.
class SecondLayer : public MatrixWindow
{
public:
  explicit SecondLayer(PassScene& scene)
    : MatrixWindow(scene)
  {
    this->below_.addFloor(5.0, -1.0);
    this->below_.addBox({ -5.0, -5.0, -1.0 }, { 5.0, -4.0, 1.0 });
    this->below_.addSun({ 0.3, 1.0, -1.0 });
    this->below_.window->RemoveRenderer(this->below_.renderer);
    this->below_.renderer->SetActiveCamera(scene.renderer->GetActiveCamera());
    scene.window->SetNumberOfLayers(2);
    scene.window->AddRenderer(this->below_.renderer);
    scene.renderer->SetLayer(1);
  }
  ~SecondLayer() override
  {
    this->scene_.window->RemoveRenderer(this->below_.renderer);
    this->scene_.renderer->SetLayer(0);
    this->scene_.window->SetNumberOfLayers(1);
  }

private:
  PassScene below_{ 1, 1 };
};

/// The window that toolkits' widgets draw through (QVTKOpenGLNativeWidget and others), in another
/// window's context.
class BorrowedContextWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static BorrowedContextWindow* New();
  vtkTypeMacro(BorrowedContextWindow, vtkGenericOpenGLRenderWindow);

  void borrow(vtkOpenGLRenderWindow* owner)
  {
    this->owner_ = owner;
    this->SetOwnContext(0);
    this->SetReadyForRendering(true);
    this->SetSupportsOpenGL(1);
  }
  void MakeCurrent() override { this->owner_->MakeCurrent(); }
  bool IsCurrent() override { return this->owner_->IsCurrent(); }
  /// The owner has loaded OpenGL's functions.
  void OpenGLInitContext() override
  {
    this->ContextCreationTime.Modified();
    this->Initialized = true;
    noteLoaded(this);
  }

private:
  vtkOpenGLRenderWindow* owner_ = nullptr;
};
vtkStandardNewMacro(BorrowedContextWindow);

/// Behaves like a toolkit's widget: VTK leaves the picture in the framebuffer that was bound. The
/// context stays the scene's, because VTK 9.1 crashes if a vtkGlyph3DMapper with CullingAndLOD
/// moves to another one.
class Widget : public MatrixWindow
{
public:
  explicit Widget(PassScene& scene)
    : MatrixWindow(scene)
    , width_(scene.window->GetSize()[0])
    , height_(scene.window->GetSize()[1])
  {
    scene.window->RemoveRenderer(scene.renderer);
    scene.window->MakeCurrent();
    glBindTexture(GL_TEXTURE_2D, this->picture_.create());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, this->width_, this->height_, 0, GL_RGBA,
      GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->picture_.name(), 0);
    this->window_->borrow(scene.window);
    this->window_->SetMultiSamples(0);
    this->window_->SetSize(this->width_, this->height_);
    this->window_->AddRenderer(scene.renderer);
  }
  ~Widget() override
  {
    this->window_->RemoveRenderer(this->scene_.renderer);
    this->window_->Finalize();
    this->framebuffer_.reset();
    this->picture_.reset();
    this->scene_.window->AddRenderer(this->scene_.renderer);
  }
  Picture draw(int) override
  {
    this->scene_.window->MakeCurrent();
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
    this->window_->Render();
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), this->framebuffer_.name());
    Picture picture{ this->width_, this->height_, {} };
    picture.rgb.resize(static_cast<std::size_t>(3 * this->width_ * this->height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, this->width_, this->height_, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return picture;
  }

private:
  int width_;
  int height_;
  GlTexture picture_;
  GlFramebuffer framebuffer_;
  vtkNew<BorrowedContextWindow> window_;
};

template <typename Window>
std::unique_ptr<MatrixWindow> make(PassScene& scene)
{
  return std::make_unique<Window>(scene);
}

} // namespace

MatrixWindow::MatrixWindow(PassScene& scene)
  : scene_(scene)
{
}

Picture MatrixWindow::draw(int)
{
  return this->scene_.render();
}

const std::vector<MatrixWindowKind>& matrixWindows()
{
  static const std::vector<MatrixWindowKind> windows = { { "whole window", make<MatrixWindow> },
    { "several samples", make<SeveralSamples> }, { "part of a window", make<Part> },
    { "tiles", make<Tiled> }, { "stereo", make<Stereo> }, { "second layer", make<SecondLayer> },
    { "widget", make<Widget> } };
  return windows;
}

} // namespace gnomon::test
