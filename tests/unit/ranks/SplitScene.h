#pragma once

#include "BuiltinPass.h"

#include <vtkMultiProcessController.h>

namespace gnomon::test
{

/// Says which process has a triangle of a model.
struct Distribution
{
  const char* name;
  std::function<int(vtkIdType triangle, vtkIdType triangles, int ranks)> rankOf;
  bool hasGhosts = false; ///< each process also has the first triangles of the next one's
};
///@{
/// Blocks, in turns, and by chance.
extern const Distribution blocks, roundRobin, byChance, blocksWithGhosts;
///@}
/// Whole surfaces, by the number of their triangles.
extern const Distribution wholes;

struct RankView : BuiltinPass
{
  RankView(const tool::Scene& scene, int width, int height);
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
  void turnCamera(double degrees);

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
