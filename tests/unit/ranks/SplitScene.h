#pragma once

#include "Scene.h"
#include "VtkMessages.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

namespace gnomon::test
{

/// Says which process has a triangle of a model.
struct Distribution
{
  const char* name;
  std::function<int(vtkIdType triangle, vtkIdType triangles, int ranks)> rankOf;
  bool hasGhosts = false; ///< each process also has the first triangles of the next one's
};
std::ostream& operator<<(std::ostream& stream, const Distribution& distribution);
/// Blocks, in turns, and by chance.
const Distribution& blocks();
const Distribution& roundRobin();
const Distribution& random();
const Distribution& blocksWithGhosts();
/// Whole surfaces, by the number of their triangles.
const Distribution& wholes();

/// Return the triangles of a surface that one process has.
vtkSmartPointer<vtkPolyData> partOf(
  vtkPolyData* surface, const Distribution& distribution, int rank, int ranks);

/// A view with a pass that keeps visibility.
struct RankView
{
  vtkSmartPointer<vtkRenderer> renderer;
  vtkSmartPointer<vtkOpenGLRenderWindow> window = makeOffScreenWindow();
  vtkNew<vtkGnomonShadowPass> pass;

  RankView(const tool::Scene& scene, int width, int height);
  const VisibilityImages& draw();
  const FrameReport& report() const { return this->pass->GetReport(); }
};

/// A scene in two views: one shows this process's part under a pass that shares the picture with
/// the other processes; the other shows all parts, which this process draws alone.
class SplitScene
{
public:
  SplitScene(
    tool::Scene scene, const Distribution& distribution, int width = 200, int height = 150);

  /// Call a function for both views.
  void change(const std::function<void(vtkRenderer*)>& of);

  /// Set the samples of edge pixels in both views.
  void smooth(const char* edgeSamples);
  /// Switch smooth terminators on or off in both views; off at first.
  void smoothTerminators(bool smooth);
  /// Return how many pixels of the shared view are neither lit nor dark.
  std::size_t mixedPixels() const;

  /// Draw both views. The pictures' visibility and receivers must be the same, bit for bit.
  /// @return the number of pixels in shadow
  std::size_t expectSame();

  RankView& shared() { return *this->shared_; }
  RankView& alone() { return *this->alone_; }

private:
  std::unique_ptr<RankView> shared_;
  std::unique_ptr<RankView> alone_;
};

/// Return the processes of the test.
vtkMultiProcessController* controller();

} // namespace gnomon::test
