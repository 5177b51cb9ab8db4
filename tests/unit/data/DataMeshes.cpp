#include "DataMeshes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace gnomon::test
{

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh, const glm::dvec3& by)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const glm::dvec3& point : mesh.points)
  {
    points->InsertNextPoint(point.x + by.x, point.y + by.y, point.z + by.z);
  }
  vtkNew<vtkCellArray> cells;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    cells->InsertNextCell({ triangle.x, triangle.y, triangle.z });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

vtkSmartPointer<vtkPolyData> quad(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
  auto data = polyData({ { a, b, c, d }, {} });
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 2, 3 });
  data->SetPolys(cells);
  return data;
}

vtkSmartPointer<vtkPolyData> floorOf(const glm::dvec2& lower, const glm::dvec2& upper, int cells)
{
  Mesh mesh;
  vtkNew<vtkCellArray> quads;
  for (int y = 0; y <= cells; ++y)
  {
    for (int x = 0; x <= cells; ++x)
    {
      const glm::dvec2 at = lower + (upper - lower) * glm::dvec2(x, y) / double(cells);
      mesh.points.emplace_back(at, 0.0);
      const vtkIdType corner = y * (cells + 1) + x;
      if (x < cells && y < cells)
      {
        quads->InsertNextCell({ corner, corner + 1, corner + cells + 2, corner + cells + 1 });
      }
    }
  }
  auto data = polyData(mesh);
  data->SetPolys(quads);
  return data;
}

vtkSmartPointer<vtkPolyData> together(const std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (vtkPolyData* part : parts)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      points->InsertNextPoint(part->GetPoint(i));
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < part->GetNumberOfCells(); ++i)
    {
      part->GetCellPoints(i, ids);
      for (vtkIdType j = 0; j < ids->GetNumberOfIds(); ++j)
      {
        ids->SetId(j, first + ids->GetId(j));
      }
      cells->InsertNextCell(ids);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

std::vector<double> shownArrayOf(vtkGnomonVisibilityFilter* filter, const char* name)
{
  vtkPolyData* const output = filter->GetOutput();
  vtkDataSetAttributes* data = output->GetPointData();
  if (filter->GetElements() == vtkGnomonVisibilityFilter::CELLS)
  {
    data = output->GetCellData();
  }
  vtkDataArray* const array = data->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      values.push_back(array->GetComponent(i, component));
    }
  }
  return values;
}

std::vector<double> arrayOf(vtkGnomonVisibilityFilter* filter, const char* name)
{
  filter->Update();
  return shownArrayOf(filter, name);
}

} // namespace gnomon::test
