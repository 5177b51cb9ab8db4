#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkWeakPointer.h>

#include <functional>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Tells of the first frame that a renderer draws without a pass, after frames with it.
class OtherFrames
{
public:
  /// @param tell receives the renderer at the end of that frame
  explicit OtherFrames(std::function<void(vtkRenderer*)> tell);
  ~OtherFrames();
  OtherFrames(const OtherFrames&) = delete;
  OtherFrames& operator=(const OtherFrames&) = delete;

  /// Note that the pass draws in a renderer's frame, which becomes the one to watch.
  void drawn(vtkRenderer* renderer);

private:
  void endFrame();
  void forget();

  std::function<void(vtkRenderer*)> tell_;
  vtkWeakPointer<vtkRenderer> renderer_; ///< null: nothing to watch
  bool drawn_ = false;                   ///< the pass drew in the renderer's present frame
  unsigned long observer_ = 0;
};

} // namespace gnomon
