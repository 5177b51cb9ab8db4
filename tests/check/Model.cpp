#include "Scene.h"

#include <vtk3DSImporter.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkGLTFImporter.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace gnomon::check
{

namespace
{

/// Takes what has an area. NaN and infinity have none.
void addTriangle(std::vector<Triangle>& triangles, const Triangle& triangle)
{
  const double area = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).length();
  if (std::isfinite(area) && area > 0.0)
  {
    triangles.push_back(triangle);
  }
}

/// Polygons become fans around their first vertex; every other triangle of a strip is turned round.
void addSurface(std::vector<Triangle>& triangles, vtkPolyData* data, vtkMatrix4x4* worldFromData)
{
  const auto corner = [&](vtkIdType point)
  {
    double p[4] = { 0.0, 0.0, 0.0, 1.0 };
    data->GetPoint(point, p);
    if (worldFromData)
    {
      worldFromData->MultiplyPoint(p, p);
    }
    return Vec3(p[0], p[1], p[2]);
  };
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  const auto polygons = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell())
  {
    polygons->GetCurrentCell(size, points);
    for (vtkIdType i = 2; i < size; ++i)
    {
      addTriangle(triangles, { corner(points[0]), corner(points[i - 1]), corner(points[i]) });
    }
  }
  const auto strips = vtk::TakeSmartPointer(data->GetStrips()->NewIterator());
  for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell())
  {
    strips->GetCurrentCell(size, points);
    for (vtkIdType i = 2; i < size; ++i)
    {
      const vtkIdType odd = i % 2;
      addTriangle(
        triangles, { corner(points[i - 2 + odd]), corner(points[i - 1 - odd]), corner(points[i]) });
    }
  }
}

template <class Reader>
std::vector<Triangle> readWithReader(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  std::vector<Triangle> triangles;
  addSurface(triangles, reader->GetOutput(), nullptr);
  return triangles;
}

template <class Importer>
std::vector<Triangle> readWithImporter(const std::string& path)
{
  vtkNew<vtkGenericOpenGLRenderWindow> window; // importers ask for one; it draws nothing
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  vtkNew<Importer> importer;
  importer->SetFileName(path.c_str());
  importer->SetRenderWindow(window);
  importer->Update();
  std::vector<Triangle> triangles;
  vtkCollectionSimpleIterator position;
  renderer->GetActors()->InitTraversal(position);
  while (vtkActor* actor = renderer->GetActors()->GetNextActor(position))
  {
    actor->GetMapper()->Update();
    addSurface(
      triangles, vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput()), actor->GetMatrix());
  }
  return triangles;
}

std::vector<Triangle> readByExtension(const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".obj")
  {
    return readWithReader<vtkOBJReader>(path);
  }
  if (extension == ".ply")
  {
    return readWithReader<vtkPLYReader>(path);
  }
  if (extension == ".stl")
  {
    return readWithReader<vtkSTLReader>(path);
  }
  if (extension == ".vtp")
  {
    return readWithReader<vtkXMLPolyDataReader>(path);
  }
  if (extension == ".3ds")
  {
    return readWithImporter<vtk3DSImporter>(path);
  }
  if (extension == ".gltf" || extension == ".glb")
  {
    return readWithImporter<vtkGLTFImporter>(path);
  }
  throw std::runtime_error(path + ": models of this type cannot be checked");
}

} // namespace

//------------------------------------------------------------------------------
std::vector<Triangle> readModel(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw std::runtime_error(path + ": no such file");
  }
  std::vector<Triangle> triangles = readByExtension(path);
  if (triangles.empty())
  {
    throw std::runtime_error(path + ": has no triangles");
  }
  return triangles;
}

} // namespace gnomon::check
