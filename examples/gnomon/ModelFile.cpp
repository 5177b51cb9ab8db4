#include "ModelFile.h"

#include "Errors.h"
#include "Files.h"
#include "SceneFraming.h"
#include "VtkMessages.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <vtk3DSImporter.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellData.h>
#include <vtkGLTFImporter.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOBJImporter.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::tool
{

namespace
{

//------------------------------------------------------------------------------
// Readers give one surface.
template <class Reader>
void readWithReader(const std::string& path, Model& model)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  SceneModel surface;
  surface.name = std::filesystem::path(path).stem().string();
  surface.surface = reader->GetOutput();
  surface.property = defaultProperty();
  model.surfaces.push_back(std::move(surface));
}

//------------------------------------------------------------------------------
// Importers give actors.
void readWithImporter(vtkImporter* importer, const std::string& path, Model& model)
{
  // Importers want a window; nothing is drawn in this one, so it opens no display.
  vtkNew<vtkGnomonEGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  importer->SetRenderWindow(window);
  importer->Update();

  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator iterator;
  actors->InitTraversal(iterator);
  while (vtkActor* actor = actors->GetNextActor(iterator))
  {
    actor->GetMapper()->Update();
    SceneModel surface;
    surface.name = std::filesystem::path(path).stem().string();
    surface.surface = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
    surface.property = actor->GetProperty();
    surface.texture = actor->GetTexture();
    surface.translucent = actor->GetForceTranslucent();
    std::copy_n(actor->GetMatrix()->GetData(), 16, surface.matrix.begin());
    model.surfaces.push_back(std::move(surface));
  }
}

template <class Importer>
void readWithImporter(const std::string& path, Model& model)
{
  vtkNew<Importer> importer;
  importer->SetFileName(path.c_str());
  readWithImporter(importer, path, model);
}

struct FileType
{
  const char* extension;
  void (*read)(const std::string& path, Model& model);
};

const FileType fileTypes[] = {
  { ".obj", readWithImporter<vtkOBJImporter> },
  { ".ply", readWithReader<vtkPLYReader> },
  { ".stl", readWithReader<vtkSTLReader> },
  { ".vtp", readWithReader<vtkXMLPolyDataReader> },
  { ".3ds", readWithImporter<vtk3DSImporter> },
  { ".glb", readWithImporter<vtkGLTFImporter> },
  { ".gltf", readWithImporter<vtkGLTFImporter> },
};

const FileType* findFileType(const std::string& path)
{
  const std::string extension = lowerExtension(path);
  const auto place = std::find_if(std::begin(fileTypes), std::end(fileTypes),
    [&](const FileType& type) { return extension == type.extension; });
  return place == std::end(fileTypes) ? nullptr : place;
}

vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData* surface)
{
  if (surface->GetPointData()->GetNormals())
  {
    return surface;
  }
  constexpr double sharpEdgeDegrees = 60.0;
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(sharpEdgeDegrees);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

} // namespace

//------------------------------------------------------------------------------
Model readModelFile(const std::string& path)
{
  const FileType* type = findFileType(path);
  if (!type)
  {
    throw BadInput(path + ": the file type is \"" + lowerExtension(path) +
      "\", expected one of: " + modelFileTypes());
  }
  requireReadableFile(path);
  Model model;
  VtkMessages messages;
  type->read(path, model);
  if (!messages.errors().empty())
  {
    throw BadInput(path + ": " + messages.errors().front());
  }
  for (SceneModel& surface : model.surfaces)
  {
    surface.surface = withNormals(surface.surface);
  }
  return model;
}

//------------------------------------------------------------------------------
bool isModelFile(const std::string& path)
{
  return findFileType(path) != nullptr;
}

//------------------------------------------------------------------------------
std::string modelFileTypes()
{
  std::string list;
  for (const FileType& type : fileTypes)
  {
    list += (list.empty() ? "" : ", ") + std::string(type.extension);
  }
  return list;
}

} // namespace gnomon::tool
