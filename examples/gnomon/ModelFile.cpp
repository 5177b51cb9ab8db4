#include "ModelFile.h"

#include "Errors.h"
#include "Files.h"
#include "GltfFile.h"
#include "JsonValue.h"
#include "MtlFile.h"
#include "ReadGuarded.h"
#include "SceneFraming.h"
#include "Text.h"
#include "Vec3.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <vtk3DSImporter.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkGLTFImporter.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderer.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace gnomon::tool
{

namespace
{

std::string nameOf(const std::string& path)
{
  return std::filesystem::path(path).stem().string();
}

void addNotes(const std::vector<std::string>& warnings, const std::string& path, Model& model)
{
  for (const std::string& warning : warnings)
  {
    model.notes.push_back(path + ": " + warning);
  }
}

//------------------------------------------------------------------------------
// Checks of a reader's output.

/// Refuse cells that refer to missing vertices.
void checkCells(vtkCellArray* cells, vtkIdType points)
{
  if (!cells->IsValid())
  {
    throw BadInput("the cells' offsets are damaged");
  }
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    iterator->GetCurrentCell(size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      if (ids[i] < 0 || ids[i] >= points)
      {
        throw BadInput("found a cell with vertex number " + std::to_string(ids[i]) +
          ", expected 0 to " + std::to_string(points - 1));
      }
    }
  }
}

/// Return the number of triangles that VTK draws for a surface: fans of polygons, and strips.
vtkIdType countTriangles(vtkPolyData* surface)
{
  vtkIdType triangles = 0;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
      triangles += std::max<vtkIdType>(0, cells->GetCellSize(i) - 2);
    }
  }
  return triangles;
}

/// Count the vertices that are not finite, and refuse unreasonably large coordinates, as VTK draws
/// in float.
vtkIdType countNonFinite(vtkPolyData* surface)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    Vec3 point;
    surface->GetPoint(i, point.data());
    const double largest = std::max({ std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) });
    if (!std::isfinite(point[0] + point[1] + point[2]))
    {
      ++count;
    }
    else if (largest > anyCoordinate.high)
    {
      std::ostringstream found;
      found << "found vertex " << i << " at " << point[0] << ", " << point[1] << ", " << point[2]
            << ", expected coordinates between " << anyCoordinate.low << " and "
            << anyCoordinate.high;
      throw BadInput(found.str());
    }
  }
  return count;
}

/// True if an array holds colours that VTK shows unchanged.
bool isColor(vtkDataArray* scalars)
{
  return scalars && scalars->GetNumberOfComponents() >= 3 &&
    scalars->GetNumberOfComponents() <= 4 &&
    (scalars->GetDataType() == VTK_UNSIGNED_CHAR || scalars->GetDataType() == VTK_FLOAT);
}

/// Return a surface with smooth normals and split sharp edges.
vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData* surface)
{
  constexpr double sharpEdgeDegrees = 60.0;
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(sharpEdgeDegrees);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

/// Return a reader's surface prepared for the scene: triangles and polygons only, with normals, and
/// with scalars only if they are colours. Null for a surface without triangles.
vtkSmartPointer<vtkPolyData> prepared(
  vtkPolyData* source, const std::string& path, std::vector<std::string>& notes)
{
  if (!source || !source->GetPoints())
  {
    return nullptr;
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(source);
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    checkCells(cells, surface->GetNumberOfPoints());
  }
  const vtkIdType left = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  if (left > 0)
  {
    // Cell data counts vertices and lines first, so it is removed with them.
    surface->SetVerts(nullptr);
    surface->SetLines(nullptr);
    surface->GetCellData()->Initialize();
    notes.push_back(
      path + ": " + std::to_string(left) + " points and lines are left out, surfaces only");
  }
  if (countTriangles(surface) == 0)
  {
    return nullptr;
  }

  const vtkIdType nonFinite = countNonFinite(surface);
  if (nonFinite == surface->GetNumberOfPoints())
  {
    throw BadInput("none of the " + std::to_string(nonFinite) + " vertices is finite");
  }
  if (nonFinite > 0)
  {
    notes.push_back(path + ": " + std::to_string(nonFinite) +
      " vertices are not finite; triangles with them are left out");
  }

  vtkPointData* pointData = surface->GetPointData();
  for (int i = pointData->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (pointData->GetAbstractArray(i)->GetNumberOfTuples() != surface->GetNumberOfPoints())
    {
      throw BadInput("found " +
        std::to_string(pointData->GetAbstractArray(i)->GetNumberOfTuples()) +
        " values of a point array, expected " + std::to_string(surface->GetNumberOfPoints()));
    }
  }
  if (!isColor(pointData->GetScalars()))
  {
    pointData->SetActiveScalars(nullptr);
  }
  vtkCellData* cellData = surface->GetCellData();
  if (!isColor(cellData->GetScalars()) ||
    cellData->GetScalars()->GetNumberOfTuples() != surface->GetNumberOfCells())
  {
    cellData->SetActiveScalars(nullptr);
  }
  // A vertex that is not finite would make its neighbours' normals invalid.
  return pointData->GetNormals() || nonFinite > 0 ? surface : withNormals(surface);
}

//------------------------------------------------------------------------------
// Readers return one surface.

void addSurface(vtkPolyData* surface, const std::string& path, Model& model)
{
  SceneModel part;
  part.name = nameOf(path);
  part.surface = prepared(surface, path, model.notes);
  part.property = defaultProperty();
  if (part.surface)
  {
    model.surfaces.push_back(std::move(part));
  }
}

void readPly(const std::string& path, Model& model)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  addSurface(reader->GetOutput(), path, model);
}

/// Refuse binary .stl files whose size is not what their header says, as vtkSTLReader reads what is
/// there. It checks text itself.
void requireWholeStl(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  constexpr std::size_t countBegin = 80;
  constexpr std::size_t triangleBegin = 84;
  constexpr std::size_t triangleBytes = 50;
  std::uint32_t triangles = 0;
  bytes.copy(
    reinterpret_cast<char*>(&triangles), sizeof(triangles), std::min(countBegin, bytes.size()));
  const std::size_t whole = triangleBegin + triangleBytes * triangles;
  if (bytes.size() != whole && bytes.find("facet") == std::string::npos)
  {
    throw BadInput("found " + std::to_string(bytes.size()) + " bytes, expected " +
      std::to_string(whole) + " or text; the file is truncated or damaged");
  }
}

void readStl(const std::string& path, Model& model)
{
  requireWholeStl(path);
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  // vtkMergePoints sorts vertices into a grid over their bounds, which must be finite.
  reader->MergingOff();
  reader->Update();
  reader->SetMerging(countNonFinite(reader->GetOutput()) == 0);
  reader->Update();
  addSurface(reader->GetOutput(), path, model);
}

void readVtp(const std::string& path, Model& model)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  if (!reader->CanReadFile(path.c_str()))
  {
    throw BadInput("not a VTK XML file with poly data, or a damaged one");
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  addSurface(reader->GetOutput(), path, model);
}

//------------------------------------------------------------------------------
// OBJ: one surface per material.

/// Return the polygons of one material, with the vertices that they use.
vtkSmartPointer<vtkPolyData> extractMaterial(vtkPolyData* source, vtkDataArray* materialIds, int id)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(source->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> polygons;
  part->GetPointData()->CopyAllocate(source->GetPointData());
  std::vector<vtkIdType> newIds(static_cast<std::size_t>(source->GetNumberOfPoints()), -1);
  std::vector<vtkIdType> corners;
  for (vtkIdType cell = 0; cell < source->GetNumberOfPolys(); ++cell)
  {
    if (materialIds->GetTuple1(cell) != id)
    {
      continue;
    }
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    source->GetPolys()->GetCellAtId(cell, size, ids);
    corners.clear();
    for (vtkIdType i = 0; i < size; ++i)
    {
      vtkIdType& newId = newIds[static_cast<std::size_t>(ids[i])];
      if (newId < 0)
      {
        newId = points->InsertNextPoint(source->GetPoint(ids[i]));
        part->GetPointData()->CopyData(source->GetPointData(), ids[i], newId);
      }
      corners.push_back(newId);
    }
    polygons->InsertNextCell(size, corners.data());
  }
  part->SetPoints(points);
  part->SetPolys(polygons);
  return part;
}

/// Return the materials of all libraries that an OBJ file names. A missing library becomes a note.
std::map<std::string, Material> readLibraries(
  vtkAbstractArray* libraries, const std::string& path, std::vector<std::string>& notes)
{
  std::map<std::string, Material> materials;
  auto* names = vtkStringArray::SafeDownCast(libraries);
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const std::filesystem::path library =
      std::filesystem::path(path).parent_path() / std::string(names->GetValue(i));
    std::error_code error;
    if (std::filesystem::exists(library, error))
    {
      materials.merge(readMaterials(library.string()));
    }
    else
    {
      notes.push_back(path + ": its material library " + library.string() + " is missing");
    }
  }
  return materials;
}

/// Refuse vertices that vtkOBJReader would read as zeros.
void requireObjVertices(const std::string& path)
{
  std::ifstream file(path);
  std::string text;
  for (int number = 1; std::getline(file, text); ++number)
  {
    const std::vector<std::string> words = splitWords(text);
    for (std::size_t i = 1; i <= 3 && !words.empty() && words[0] == "v"; ++i)
    {
      const std::optional<float> value = parseWord<float>(words, i);
      if (!value || !std::isfinite(*value))
      {
        throw BadInput("line " + std::to_string(number) + ": found " + quotedWord(words, i) +
          ", expected v and three finite numbers");
      }
    }
  }
}

void readObj(const std::string& path, Model& model)
{
  requireObjVertices(path);
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* whole = reader->GetOutput();
  vtkDataArray* ids = whole->GetCellData()->GetArray("MaterialIds");
  auto* names =
    vtkStringArray::SafeDownCast(whole->GetFieldData()->GetAbstractArray("MaterialNames"));
  if (!ids || !names)
  {
    addSurface(whole, path, model);
    return;
  }

  checkCells(whole->GetPolys(), whole->GetNumberOfPoints());
  std::map<std::string, Material> materials =
    readLibraries(whole->GetFieldData()->GetAbstractArray("MaterialLibraries"), path, model.notes);
  for (int id = 0; id < static_cast<int>(names->GetNumberOfValues()); ++id)
  {
    const std::string name = names->GetValue(id);
    const vtkSmartPointer<vtkPolyData> part = extractMaterial(whole, ids, id);
    // vtkOBJReader stores texture coordinates per material, in an array of the material's name.
    part->GetPointData()->SetActiveTCoords(name.c_str());
    const std::size_t before = model.surfaces.size();
    addSurface(part, path, model);
    const auto material = materials.find(name);
    if (model.surfaces.size() > before && material != materials.end())
    {
      model.surfaces.back().name += ":" + name;
      model.surfaces.back().property = material->second.property;
      model.surfaces.back().texture = material->second.texture;
    }
  }
}

//------------------------------------------------------------------------------
// Importers return actors.

void importActors(vtkImporter* importer, const std::string& path, Model& model)
{
  // Importers require a window. This one is not rendered, so it opens no display.
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
    SceneModel part;
    part.name = nameOf(path);
    part.surface =
      prepared(vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput()), path, model.notes);
    part.property = actor->GetProperty();
    part.texture = actor->GetTexture();
    part.translucent = actor->GetForceTranslucent();
    std::copy_n(actor->GetMatrix()->GetData(), 16, part.matrix.begin());
    if (part.surface)
    {
      model.surfaces.push_back(std::move(part));
    }
  }
}

/// Read a .3ds file without its lights and cameras.
void read3ds(const std::string& path, Model& model)
{
  vtkNew<vtk3DSImporter> importer;
  importer->SetFileName(path.c_str());
  importActors(importer, path, model);
}

/// Flip texture coordinates, as glTF counts texture rows from the top and VTK from the bottom.
/// vtkGLTFImporter marks its actors with a key instead.
void flipTextureCoordinates(vtkPolyData* surface)
{
  vtkDataArray* source = surface->GetPointData()->GetTCoords();
  if (!source)
  {
    return;
  }
  vtkNew<vtkFloatArray> flipped;
  flipped->DeepCopy(source);
  for (vtkIdType i = 0; i < flipped->GetNumberOfTuples(); ++i)
  {
    flipped->SetComponent(i, 1, 1.0 - flipped->GetComponent(i, 1));
  }
  surface->GetPointData()->SetTCoords(flipped);
}

void readGltf(const std::string& path, Model& model)
{
  const GltfView view = readGltfView(path);
  const auto readActors = [&]
  {
    vtkNew<vtkGLTFImporter> importer;
    importer->SetFileName(path.c_str());
    importActors(importer, path, model);
  };
  addNotes(
    readGuarded(path, requireReadableFile(path) + view.neighbourBytes, readActors), path, model);
  for (SceneModel& surface : model.surfaces)
  {
    flipTextureCoordinates(surface.surface);
  }
  model.notes.insert(model.notes.end(), view.notes.begin(), view.notes.end());

  Scene scene;
  scene.models = model.surfaces;
  const std::array<double, 6> bounds = boundsWorld(scene);
  const Vec3 middle{ { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) } };
  model.camera = view.camera;
  if (model.camera)
  {
    // The target is at the distance of the scene's middle, a useful centre of rotation.
    const Vec3 forward = model.camera->target - model.camera->position;
    const double ahead = dot(middle - model.camera->position, forward);
    model.camera->target = model.camera->position + (ahead > 0.0 ? ahead : 1.0) * forward;
  }
  for (SceneLight light : view.lights)
  {
    if (light.type != SceneLight::Type::Directional)
    {
      // VTK's lights do not fall off with distance by default, so use the intensity at the scene's
      // middle.
      const double distance = length(middle - light.position);
      light.intensity /= distance > 0.0 ? distance * distance : 1.0;
    }
    model.lights.push_back(light);
  }
}

struct FileType
{
  const char* extension;
  void (*read)(const std::string& path, Model& model);
};

const FileType fileTypes[] = {
  { ".obj", readObj },
  { ".ply", readPly },
  { ".stl", readStl },
  { ".vtp", readVtp },
  { ".3ds", read3ds },
  { ".glb", readGltf },
  { ".gltf", readGltf },
};

const FileType* findFileType(const std::string& path)
{
  const std::string extension = lowerExtension(path);
  const auto place = std::find_if(std::begin(fileTypes), std::end(fileTypes),
    [&](const FileType& type) { return extension == type.extension; });
  return place == std::end(fileTypes) ? nullptr : place;
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
  Model model;
  addNotes(
    readGuarded(path, requireReadableFile(path), [&] { type->read(path, model); }), path, model);
  if (model.surfaces.empty())
  {
    throw BadInput(path + ": found no triangles, expected a surface");
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
