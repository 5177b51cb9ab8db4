#pragma once

#include "PassScene.h"

#include <memory>
#include <vector>

namespace gnomon::test
{

/// Shows a scene's renderer in a window of some kind. When it goes, the renderer is back in the
/// scene's own window, which is as it was.
class MatrixWindow
{
public:
  explicit MatrixWindow(PassScene& scene);
  virtual ~MatrixWindow() = default;
  MatrixWindow(const MatrixWindow&) = delete;
  MatrixWindow& operator=(const MatrixWindow&) = delete;

  /// How many pictures it takes to show the renderer: of tiles and of eyes there are several.
  virtual int views() const { return 1; }
  /// Draws the renderer's part of the window, which must raise no OpenGL error.
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
