#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct FrameReport;

///@{
/// Return a report as JSON, and its lights as the rows of a table.
std::string textOf(const FrameReport& report);
void fillTable(const FrameReport& report, vtkTable* lights);
///@}

} // namespace gnomon
