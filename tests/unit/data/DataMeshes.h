#pragma once

#include "SyntheticScene.h"

#include "plugin/vtkGnomonVisibilityFilter.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::test
{

/// The mesh as polydata with double points, moved.
vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh, const glm::dvec3& by = glm::dvec3(0.0));

/// One quad with these corners.
vtkSmartPointer<vtkPolyData> quad(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The floor z = 0 between two corners as cells x cells quads, facing +z: cell y * cells + x.
vtkSmartPointer<vtkPolyData> floorOf(const glm::dvec2& lower, const glm::dvec2& upper, int cells);

/// Several polydata with polygons as one.
vtkSmartPointer<vtkPolyData> together(const std::vector<vtkSmartPointer<vtkPolyData>>& parts);

/// An array of the result, of cells or else of points, as doubles: all its components in a row.
/// Empty if it is not there.
std::vector<double> arrayOf(vtkGnomonVisibilityFilter* filter, const char* name);

} // namespace gnomon::test
