#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkLogger.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkOutputWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// Catches what VTK would print, from construction to destruction: VTK reports errors as text and
/// goes on. Nest them; the innermost one catches.
class VtkMessages
{
public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// The texts so far, each on one line and without the source file that VTK puts in front.
  const std::vector<std::string>& errors() const;
  const std::vector<std::string>& warnings() const;

private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkLogger::Verbosity previousVerbosity_;
};

} // namespace gnomon::tool
