#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkWeakPointer.h>

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkObject;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The topics of a frame's errors and warnings. Each is looked at by itself, so that a frame that
/// ends early mends nothing that it did not reach.
enum class Topic
{
  Context,
  Lights,
  Headlight,
  LeftOut,
  Route,
  Misfit,
  Frame
};

/// Let an object report an error or a warning. Its observers of the event are told even while VTK's
/// warnings are switched off, as many programs do for the whole process.
/// @param event vtkCommand::ErrorEvent or WarningEvent
/// @param text empty for none
void tell(vtkObject* teller, unsigned long event, const std::string& text);

/// Remembers errors and warnings of frames, to say each once while it is true of any renderer.
class Complaints
{
public:
  /// @param renderer whose frame it is; null for objects without
  /// @param texts all that is true of the topic in this frame
  /// @return those to be said now
  std::vector<std::string> news(
    vtkRenderer* renderer, Topic topic, const std::vector<std::string>& texts);

  /// The same for one text at most; empty for none.
  std::string news(vtkRenderer* renderer, Topic topic, const std::string& text);

  /// Let an object report an error, if the error is news.
  /// @param error empty for none
  void tellError(vtkObject* teller, vtkRenderer* renderer, Topic topic, const std::string& error);

private:
  struct Complaint
  {
    vtkWeakPointer<vtkRenderer> renderer;
    bool hasRenderer;
    Topic topic;
    std::string text;
  };
  std::vector<Complaint> standing_;
};

} // namespace gnomon
