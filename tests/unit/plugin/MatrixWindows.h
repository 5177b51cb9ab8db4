#pragma once

#include "PassScene.h"

#include <memory>

namespace gnomon::test
{

/// Shows a scene's renderer in a window of some kind. Its destructor returns the renderer to the
/// scene's own window, unchanged.
class MatrixWindow
{
public:
  explicit MatrixWindow(PassScene& scene);
  virtual ~MatrixWindow() = default;
  MatrixWindow(const MatrixWindow&) = delete;
  MatrixWindow& operator=(const MatrixWindow&) = delete;

  /// Return the number of pictures that show the renderer: tiles and eyes take several.
  virtual int views() const { return 1; }
  /// Draw the renderer's part of the window, which must raise no OpenGL error.
  virtual Picture draw(int view);
  virtual bool hasSeveralSamples() const { return false; }

protected:
  PassScene& scene_;
};

struct MatrixWindowKind
{
  const char* name;
  std::unique_ptr<MatrixWindow> (*make)(PassScene& scene);
};
const std::vector<MatrixWindowKind>& matrixWindows();

} // namespace gnomon::test
