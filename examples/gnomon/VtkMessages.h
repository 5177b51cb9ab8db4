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

/// Catches VTK's messages from construction to destruction, because VTK only prints errors and
/// continues. Objects may be nested; the innermost one catches.
class VtkMessages
{
public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages& operator=(VtkMessages&&) = delete; ///< nor copied

  /// Return the texts caught, each on one line and without VTK's prefix of the source file.
  const std::vector<std::string>& errors() const;
  const std::vector<std::string>& warnings() const;

private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkLogger::Verbosity previousVerbosity_;
};

} // namespace gnomon::tool
