#pragma once

#include <string>

class vtkTable;

namespace gnomon
{

struct FrameReport;

///@{
/// A report for others to read: as JSON, and its lights as the rows of a table.
std::string textOf(const FrameReport& report);
void fillTable(const FrameReport& report, vtkTable* lights);
///@}

} // namespace gnomon
