#include "ModelFile.h"

#include "Errors.h"
#include "Files.h"
#include "ImageFile.h"
#include "JsonValue.h"
#include "ReadGuarded.h"
#include "SceneFraming.h"
#include "Text.h"
#include "Vec3.h"

#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonOffScreenWindow.h"

#include <vtk3DSImporter.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkFloatArray.h>
#include <vtkGLTFImporter.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
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
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gnomon::tool
{

namespace
{

// A reader's output. readGuarded() turns a reader's crash into an error; these checks are of what
// VTK would read or draw wrongly later.

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

/// Count the vertices that are not finite, and refuse unreasonably large coordinates, as VTK draws
/// in float.
vtkIdType countNonFinite(vtkPolyData* surface)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* const p = surface->GetPoint(i);
    if (!std::isfinite(p[0] + p[1] + p[2]))
    {
      ++count;
    }
    else if (std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) > anyCoordinate.high)
    {
      std::ostringstream found;
      found << "found vertex " << i << " at " << p[0] << ", " << p[1] << ", " << p[2]
            << ", expected coordinates between " << anyCoordinate.low << " and "
            << anyCoordinate.high;
      throw BadInput(found.str());
    }
  }
  return count;
}

/// Use scalars only if they are colours, which VTK shows unchanged, of so many elements.
void keepColors(vtkDataSetAttributes* data, vtkIdType elements)
{
  vtkDataArray* const scalars = data->GetScalars();
  const int channels = scalars ? scalars->GetNumberOfComponents() : 0;
  const int type = scalars ? scalars->GetDataType() : VTK_VOID;
  if ((channels != 3 && channels != 4) || (type != VTK_UNSIGNED_CHAR && type != VTK_FLOAT) ||
    scalars->GetNumberOfTuples() != elements)
  {
    data->SetActiveScalars(nullptr);
  }
}

/// Return a surface with smooth normals and split sharp edges.
vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData* surface)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(60.0);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

/// Add a reader's surface prepared for the scene: triangles and polygons only, with normals, and
/// with scalars only if they are colours.
/// @return the surface; null without triangles
SceneModel* addSurface(vtkPolyData* source, const std::string& path, Model& model)
{
  if (!source || !source->GetPoints())
  {
    return nullptr;
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(source);
  const vtkIdType points = surface->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    checkCells(cells, points);
  }
  if (const vtkIdType left = surface->GetNumberOfVerts() + surface->GetNumberOfLines(); left > 0)
  {
    // Cell data counts vertices and lines first, so it is removed with them.
    surface->SetVerts(nullptr);
    surface->SetLines(nullptr);
    surface->GetCellData()->Initialize();
    model.notes.push_back(
      path + ": " + std::to_string(left) + " points and lines are left out, surfaces only");
  }
  if (std::max(surface->GetPolys()->GetMaxCellSize(), surface->GetStrips()->GetMaxCellSize()) < 3)
  {
    return nullptr;
  }

  const vtkIdType nonFinite = countNonFinite(surface);
  if (nonFinite == points)
  {
    throw BadInput("none of the " + std::to_string(nonFinite) + " vertices is finite");
  }
  if (nonFinite > 0)
  {
    model.notes.push_back(path + ": " + std::to_string(nonFinite) +
      " vertices are not finite; triangles with them are left out");
  }
  vtkPointData* const pointData = surface->GetPointData();
  for (int i = 0; i < pointData->GetNumberOfArrays(); ++i)
  {
    if (const vtkIdType values = pointData->GetAbstractArray(i)->GetNumberOfTuples();
        values != points)
    {
      throw BadInput("found " + std::to_string(values) + " values of a point array, expected " +
        std::to_string(points));
    }
  }
  keepColors(pointData, points);
  keepColors(surface->GetCellData(), surface->GetNumberOfCells());

  SceneModel part;
  part.name = std::filesystem::path(path).stem().string();
  // A vertex that is not finite would make its neighbours' normals invalid.
  part.surface = pointData->GetNormals() || nonFinite > 0 ? surface : withNormals(surface);
  part.property = defaultProperty();
  model.surfaces.push_back(std::move(part));
  return &model.surfaces.back();
}

template <class Reader>
vtkSmartPointer<vtkPolyData> outputOf(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

void readPly(const std::string& path, Model& model)
{
  addSurface(outputOf<vtkPLYReader>(path), path, model);
}

void readStl(const std::string& path, Model& model)
{
  // vtkSTLReader reads what is there of a truncated binary file. It checks text itself.
  const std::string bytes = readWholeFile(path, largestModelBytes);
  std::uint32_t triangles = 0;
  bytes.copy(reinterpret_cast<char*>(&triangles), 4, std::min<std::size_t>(80, bytes.size()));
  const std::size_t whole = 84 + std::size_t{ 50 } * triangles;
  if (bytes.size() != whole && bytes.find("facet") == std::string::npos)
  {
    throw BadInput("found " + std::to_string(bytes.size()) + " bytes, expected " +
      std::to_string(whole) + " or text; the file is truncated or damaged");
  }
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
  if (!vtkNew<vtkXMLPolyDataReader>()->CanReadFile(path.c_str()))
  {
    throw BadInput("not a VTK XML file with poly data, or a damaged one");
  }
  addSurface(outputOf<vtkXMLPolyDataReader>(path), path, model);
}

// OBJ: one surface per material.

/// A material of an .mtl file.
struct Material
{
  vtkSmartPointer<vtkProperty> property;
  vtkSmartPointer<vtkTexture> texture; ///< may be null
};

using Words = std::vector<std::string>; ///< of a line

/// Return the number at this index, in [0, high].
double numberAt(const Words& words, std::size_t index, double high)
{
  const std::optional<double> value = parseWord<double>(words, index);
  if (!value || !(*value >= 0.0 && *value <= high))
  {
    throw BadInput("found " + quotedWord(words, index) + ", expected " + words[0] +
      " and a number from 0 to " + std::to_string(static_cast<int>(high)));
  }
  return *value;
}

/// Return a map's file name, which follows the options and may contain spaces.
std::string fileNameOf(const Words& words)
{
  std::string name;
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    const std::string& word = words[i];
    if (!name.empty() ||
      !(word[0] == '-' || parseNumber<double>(word) || word == "on" || word == "off"))
    {
      name += (name.empty() ? "" : " ") + word;
    }
  }
  return name;
}

void apply(const Words& words, const std::filesystem::path& folder, Material& material)
{
  const std::string& keyword = words[0];
  vtkProperty* const property = material.property;
  if (keyword == "Kd" || keyword == "Ks")
  {
    Vec3 color;
    for (std::size_t i = 0; i < 3; ++i)
    {
      color[i] = numberAt(words, words.size() == 2 ? 1 : i + 1, 1.0); // one number is grey
    }
    if (keyword == "Kd")
    {
      property->SetDiffuseColor(color.data());
      property->SetAmbientColor(color.data());
    }
    else
    {
      property->SetSpecularColor(color.data());
      property->SetSpecular(1.0);
    }
  }
  else if (keyword == "Ns")
  {
    property->SetSpecularPower(numberAt(words, 1, 10000.0));
  }
  else if (keyword == "d" || keyword == "Tr")
  {
    const double value = numberAt(words, 1, 1.0);
    property->SetOpacity(keyword == "d" ? value : 1.0 - value);
  }
  else if (keyword == "map_Kd")
  {
    material.texture = readTexture((folder / fileNameOf(words)).string());
    material.texture->InterpolateOn();
  }
}

/// Read diffuse and specular colour, opacity and diffuse texture (Kd, Ks, Ns, d, Tr, map_Kd) of a
/// material library. Other statements have no counterpart and are skipped.
/// @throws BadInput
std::map<std::string, Material> readMaterials(const std::string& path)
{
  const std::vector<std::string> lines = split(readWholeFile(path, largestModelBytes), '\n');
  std::map<std::string, Material> materials;
  Material* current = nullptr;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Words words = splitWords(lines[i]);
    if (words.size() >= 2 && words[0] == "newmtl")
    {
      current = &materials[words[1]];
      current->property = defaultProperty();
    }
    else if (current && !words.empty())
    {
      try
      {
        apply(words, std::filesystem::path(path).parent_path(), *current);
      }
      catch (const BadInput& error)
      {
        throw BadInput(path + ": line " + std::to_string(i + 1) + ": " + error.what());
      }
    }
  }
  return materials;
}

/// Return the polygons of one material, with the vertices that they use.
vtkSmartPointer<vtkPolyData> extractMaterial(vtkPolyData* source, vtkDataArray* materialIds, int id)
{
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType cell = 0; cell < source->GetNumberOfPolys(); ++cell)
  {
    if (materialIds->GetTuple1(cell) == id)
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      source->GetPolys()->GetCellAtId(cell, size, ids);
      polygons->InsertNextCell(size, ids);
    }
  }
  vtkNew<vtkPolyData> part;
  part->SetPoints(source->GetPoints());
  part->GetPointData()->ShallowCopy(source->GetPointData());
  part->SetPolys(polygons);
  vtkNew<vtkCleanPolyData> used; // keeps the order of vertices
  used->SetInputData(part);
  used->PointMergingOff();
  used->ConvertPolysToLinesOff();
  used->ConvertLinesToPointsOff();
  used->Update();
  return used->GetOutput();
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

void readObj(const std::string& path, Model& model)
{
  // vtkOBJReader reads what is no number as zero.
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
  const vtkSmartPointer<vtkPolyData> whole = outputOf<vtkOBJReader>(path);
  vtkDataArray* ids = whole->GetCellData()->GetArray("MaterialIds");
  vtkFieldData* const fields = whole->GetFieldData();
  auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("MaterialNames"));
  if (!ids || !names)
  {
    addSurface(whole, path, model);
    return;
  }
  checkCells(whole->GetPolys(), whole->GetNumberOfPoints());
  const std::map<std::string, Material> materials =
    readLibraries(fields->GetAbstractArray("MaterialLibraries"), path, model.notes);
  for (int id = 0; id < static_cast<int>(names->GetNumberOfValues()); ++id)
  {
    const std::string name = names->GetValue(id);
    const vtkSmartPointer<vtkPolyData> part = extractMaterial(whole, ids, id);
    // vtkOBJReader stores texture coordinates per material, in an array of the material's name.
    part->GetPointData()->SetActiveTCoords(name.c_str());
    SceneModel* const added = addSurface(part, path, model);
    const auto material = materials.find(name);
    if (added && material != materials.end())
    {
      added->name += ":" + name;
      added->property = material->second.property;
      added->texture = material->second.texture;
    }
  }
}

/// A renderer of a window that is not rendered, so it opens no display. Importers need it.
struct ImportRenderer
{
  ImportRenderer() { this->window->AddRenderer(this->renderer); }
  vtkSmartPointer<vtkOpenGLRenderWindow> window = makeOffScreenWindow(); // outlives the renderer
  vtkNew<vtkRenderer> renderer;
};

void importActors(
  vtkImporter* importer, vtkRenderer* renderer, const std::string& path, Model& model)
{
  importer->SetRenderWindow(renderer->GetRenderWindow());
  importer->Update();
  vtkActorCollection* const actors = renderer->GetActors(); // each call rebuilds it
  vtkCollectionSimpleIterator iterator;
  actors->InitTraversal(iterator);
  while (vtkActor* actor = actors->GetNextActor(iterator))
  {
    actor->GetMapper()->Update();
    if (SceneModel* const part =
          addSurface(vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput()), path, model))
    {
      part->property = actor->GetProperty();
      part->texture = actor->GetTexture();
      part->translucent = actor->GetForceTranslucent();
      std::copy_n(actor->GetMatrix()->GetData(), 16, part->matrix.begin());
    }
  }
}

/// Read a .3ds file without its lights and cameras.
void read3ds(const std::string& path, Model& model)
{
  const ImportRenderer into;
  vtkNew<vtk3DSImporter> importer;
  importer->SetFileName(path.c_str());
  importActors(importer, into.renderer, path, model);
}

/// Return the JSON document of a .gltf or .glb file.
nlohmann::json readGltfDocument(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  if (lowerExtension(path) != ".glb")
  {
    return parseJson(bytes, path);
  }
  // The header, and the first chunk's length and type.
  if (bytes.size() < 20 || bytes.compare(0, 4, "glTF") != 0 || bytes.compare(16, 4, "JSON") != 0)
  {
    throw BadInput(path + ": not a binary glTF file, expected the words glTF and JSON");
  }
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  return parseJson(bytes.substr(20, length), path);
}

/// Refuse indices of missing elements, which vtkGLTFImporter trusts or ignores.
void checkGltfIndices(const JsonValue& root)
{
  const auto check = [&](const JsonValue& index, const JsonValue& elements)
  {
    if (index.present())
    {
      index.integer(0, static_cast<int>(elements.elementsOrNone().size()) - 1);
    }
  };
  const char* const lights = "KHR_lights_punctual";
  const JsonValue nodes = root.member("nodes");
  check(root.member("scene"), root.member("scenes"));
  for (const JsonValue& scene : root.member("scenes").elements())
  {
    for (const JsonValue& node : scene.member("nodes").elementsOrNone())
    {
      check(node, nodes);
    }
  }
  for (const JsonValue& node : nodes.elementsOrNone())
  {
    check(node.member("camera"), root.member("cameras"));
    check(node.member("extensions").member(lights).member("light"),
      root.member("extensions").member(lights).member("lights"));
    for (const JsonValue& child : node.member("children").elementsOrNone())
    {
      check(child, nodes);
    }
  }
}

/// Flip texture coordinates, as glTF counts texture rows from the top and VTK from the bottom.
/// vtkGLTFImporter marks its actors with a key instead.
void flipTextureCoordinates(vtkPolyData* surface)
{
  if (vtkDataArray* source = surface->GetPointData()->GetTCoords())
  {
    vtkNew<vtkFloatArray> flipped;
    flipped->DeepCopy(source);
    for (vtkIdType i = 0; i < flipped->GetNumberOfTuples(); ++i)
    {
      flipped->SetComponent(i, 1, 1.0 - flipped->GetComponent(i, 1));
    }
    surface->GetPointData()->SetTCoords(flipped);
  }
}

/// Return a light of KHR_lights_punctual as its node places it, not a unit beside as VTK 9.1 does.
SceneLight lightOf(vtkLight* source, const Vec3& middle)
{
  SceneLight light;
  std::array<double, 16> worldFromNode;
  std::copy_n(source->GetTransformMatrix()->GetData(), 16, worldFromNode.begin());
  light.position = transformed(worldFromNode, { 0.0, 0.0, 0.0 }, 1.0);
  light.target = light.position + normalized(transformed(worldFromNode, { 0.0, 0.0, -1.0 }, 0.0));
  if (light.target == light.position)
  {
    throw BadInput("the matrices of a light's nodes are singular, so it has no direction");
  }
  source->GetDiffuseColor(light.color.data());
  light.intensity = source->GetIntensity();
  if (source->GetPositional())
  {
    light.type = source->GetConeAngle() < 90.0 ? SceneLight::Type::Spot : SceneLight::Type::Point;
    light.coneAngleDegrees = source->GetConeAngle();
    // VTK's lights do not fall off with distance by default, so use the intensity at the scene's
    // middle. The file's is in candela.
    const double distance = length(middle - light.position);
    light.intensity /= distance > 0.0 ? distance * distance : 1.0;
  }
  return light;
}

/// Return a camera whose target is at the distance of the scene's middle, a useful centre of
/// rotation.
SceneCamera cameraOf(vtkCamera* source, const Vec3& middle)
{
  SceneCamera camera;
  source->GetPosition(camera.position.data());
  source->GetViewUp(camera.up.data());
  Vec3 forward;
  source->GetDirectionOfProjection(forward.data());
  if (!(length(cross(forward, camera.up)) > 1e-6))
  {
    throw BadInput("the matrices of the camera's nodes are singular, so it has no direction");
  }
  const double ahead = dot(middle - camera.position, forward);
  camera.target = camera.position + (ahead > 0.0 ? ahead : 1.0) * forward;
  camera.fovDegrees = source->GetViewAngle();
  if (source->GetParallelProjection())
  {
    camera.parallelScale = source->GetParallelScale();
  }
  return camera;
}

void readGltf(const std::string& path, Model& model)
{
  const nlohmann::json document = readGltfDocument(path);
  const JsonValue root(path, document);
  // vtkGLTFImporter would ignore extensions, and show the file wrongly.
  for (const JsonValue& extension : root.member("extensionsRequired").elementsOrNone())
  {
    const std::string name = extension.text();
    if (name != "KHR_lights_punctual" && name != "KHR_materials_unlit")
    {
      extension.refuse(
        "the file needs glTF extension " + quoted(name) + ", which is not supported");
    }
  }
  checkGltfIndices(root);
  if (root.member("skins").present())
  {
    model.notes.push_back(path + ": its skins are left out, meshes are shown at rest");
  }
  std::size_t bytes = requireReadableFile(path);
  for (const char* key : { "buffers", "images" })
  {
    for (const JsonValue& value : root.member(key).elementsOrNone())
    {
      const JsonValue uri = value.member("uri");
      if (uri.present() && uri.text().compare(0, 5, "data:") != 0)
      {
        const auto neighbour = std::filesystem::path(path).parent_path() / uri.text();
        bytes += requireReadableFile(neighbour.string());
      }
    }
  }
  const auto read = [&]
  {
    const ImportRenderer into;
    vtkNew<vtkGLTFImporter> importer;
    importer->SetFileName(path.c_str());
    importActors(importer, into.renderer, path, model);
    Scene scene;
    scene.models = model.surfaces;
    const std::array<double, 6> bounds = boundsWorld(scene);
    const Vec3 middle{ 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) };
    if (importer->GetNumberOfCameras() > 0 && importer->GetCamera(0))
    {
      model.camera = cameraOf(importer->GetCamera(0), middle);
    }
    vtkCollectionSimpleIterator iterator;
    into.renderer->GetLights()->InitTraversal(iterator);
    while (vtkLight* light = into.renderer->GetLights()->GetNextLight(iterator))
    {
      // VTK visits the last node first.
      model.lights.insert(model.lights.begin(), lightOf(light, middle));
    }
  };
  for (const std::string& warning : readGuarded(path, bytes, read))
  {
    model.notes.push_back(path + ": " + warning);
  }
  for (SceneModel& surface : model.surfaces)
  {
    flipTextureCoordinates(surface.surface);
  }
}

const std::map<std::string, void (*)(const std::string& path, Model& model)> readers = {
  { ".3ds", read3ds }, { ".glb", readGltf }, { ".gltf", readGltf }, { ".obj", readObj },
  { ".ply", readPly }, { ".stl", readStl }, { ".vtp", readVtp }
};

} // namespace

Model readModelFile(const std::string& path)
{
  const auto reader = readers.find(lowerExtension(path));
  if (reader == readers.end())
  {
    throw BadInput(path + ": the file type is \"" + lowerExtension(path) +
      "\", expected one of: " + modelFileTypes());
  }
  Model model;
  for (const std::string& warning :
    readGuarded(path, requireReadableFile(path), [&] { reader->second(path, model); }))
  {
    model.notes.push_back(path + ": " + warning);
  }
  if (model.surfaces.empty())
  {
    throw BadInput(path + ": found no triangles, expected a surface");
  }
  return model;
}

bool isModelFile(const std::string& path)
{
  return readers.count(lowerExtension(path)) != 0;
}

std::string modelFileTypes()
{
  std::vector<std::string> types;
  for (const auto& [type, read] : readers)
  {
    types.push_back(type);
  }
  return listOf(types);
}

} // namespace gnomon::tool
