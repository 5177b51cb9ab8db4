#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/Frame.h"
#include "plugin/frame/NumberCheck.h"
#include "plugin/frame/PassPrograms.h"
#include "plugin/frame/ReceiverDrawing.h"
#include "plugin/frame/ValueKey.h"
#include "plugin/scene/OccluderCollector.h"

#include <cstddef>
#include <cstdint>
#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkObjectBase;
class vtkRenderState;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The receivers stage of a renderer's frames: the triangle that each pixel shows. VTK draws their
/// numbers; this checks them.
class ReceiversStage
{
public:
  /// @param collector of the snapshot
  /// @param values of the frame's shaders, which this completes
  ReceiversStage(Frame& frame, OccluderCollector& collector, PassPrograms& programs,
    ShaderManager::StageValues& values);

  void beginFrame() { this->shownProps_.reset(); }
  /// Return the facts about the props in view, from one walk a frame.
  const ShownProps& shownProps(const vtkRenderState* s);
  /// True if anything on the GPU reads the receivers' points.
  bool readsPoints() const;

  /// Compare the receivers' key with the cached one. If it differs, the cached receivers are
  /// dropped and new ones are due.
  void findStale(const vtkRenderState* s);
  bool areDue() const { return this->due_.has_value(); }

  /// Count the frames in a row that kept their receivers.
  int countRest();

  /// Image route: draw the receivers if they are due, and points for techniques that read them on
  /// the GPU.
  /// @param pass whose hook the props' shaders have
  void update(const vtkRenderState* s, vtkObjectBase* pass);
  /// Begin a stage in which the props' programs draw receivers, with or without the picture.
  void begin(const vtkRenderState* s);
  /// Check the numbers of receivers that were just drawn. If any is wrong, they are drawn again
  /// with numbers by geometry shaders, which stay if fewer are wrong then. Else the snapshot
  /// differs from the picture, and the driver is right.
  /// @return false if the receivers must be drawn again
  bool ensureRightNumbers(const vtkRenderState* s);
  /// Cache the receivers that were drawn, if they were due.
  void take();

private:
  ValueKey keyOf(const vtkRenderState* s);
  NumberCheck checkNumbers(const vtkRenderState* s);

  Frame& frame_;
  OccluderCollector& collector_;
  PassPrograms& programs_;
  ShaderManager::StageValues& values_;
  std::optional<ShownProps> shownProps_; ///< this frame's, once it is asked for
  std::optional<ValueKey> due_;          ///< the key of receivers that this frame draws
  std::size_t numbered_ = 0;             ///< how many images of receivers were drawn
  std::int64_t wrongByDriver_ = 0;       ///< numbers, while geometry shaders draw receivers
  int restingFrames_ = 0;                ///< in a row that kept their receivers
};

} // namespace gnomon
