#include "Scene.h"

#include <nlohmann/json.hpp>
#include <vtk3DSImporter.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

namespace gnomon::check
{

namespace
{

/// A point of a file.
struct Corner
{
  Vec3 position;
  std::optional<Vec2> coordinates;
};

/// Append a triangle if it has an area. NaN and infinity have none.
void addTriangle(Mesh& mesh, const Corner& a, const Corner& b, const Corner& c)
{
  const double area = (b.position - a.position).cross(c.position - a.position).length();
  if (std::isfinite(area) && area > 0.0)
  {
    mesh.triangles.push_back({ a.position, b.position, c.position });
    if (a.coordinates)
    {
      mesh.coordinates.push_back({ *a.coordinates, *b.coordinates, *c.coordinates });
    }
  }
}

template <class Reader>
Mesh readWithReader(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  Mesh mesh;
  addSurface(mesh, reader->GetOutput(), nullptr);
  return mesh;
}

Mesh readWithImporter(const std::string& path)
{
  vtkNew<vtkGenericOpenGLRenderWindow> window; // importers require one; it draws nothing
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  vtkNew<vtk3DSImporter> importer;
  importer->SetFileName(path.c_str());
  importer->SetRenderWindow(window);
  importer->Update();
  Mesh mesh;
  vtkCollectionSimpleIterator position;
  vtkActorCollection* const actors = renderer->GetActors(); // each call rebuilds it
  actors->InitTraversal(position);
  while (vtkActor* actor = actors->GetNextActor(position))
  {
    actor->GetMapper()->Update();
    addSurface(mesh, vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput()), actor->GetMatrix());
  }
  return mesh;
}

Mesh readByExtension(const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".obj")
  {
    return readWithReader<vtkOBJReader>(path);
  }
  if (extension == ".vtp")
  {
    return readWithReader<vtkXMLPolyDataReader>(path);
  }
  if (extension == ".3ds")
  {
    return readWithImporter(path);
  }
  throw std::runtime_error(path + ": models of this type cannot be checked");
}

using Json = nlohmann::json;

Vec3 readVector(const Json& value)
{
  const auto numbers = value.get<std::array<double, 3>>();
  return { numbers[0], numbers[1], numbers[2] };
}

Camera readCamera(const Json& value)
{
  Camera camera;
  camera.position = readVector(value.at("position"));
  camera.target = readVector(value.at("target"));
  if (value.contains("up"))
  {
    camera.up = readVector(value.at("up"));
  }
  camera.fovDegrees = value.value("fov", camera.fovDegrees);
  return camera;
}

Light readLight(const Json& value)
{
  const std::string type = value.at("type");
  Light light;
  if (type == "directional")
  {
    light.direction = readVector(value.at("direction")).normalized();
    if (value.contains("box"))
    {
      const Json& box = value.at("box");
      light.position = readVector(box.at("position"));
      light.box.emplace();
      light.box->width = box.at("width");
      light.box->height = box.at("height");
      light.box->depth = box.at("depth");
      light.box->up = box.contains("up") ? readVector(box.at("up")) : Vec3(0.0, 1.0, 0.0);
    }
  }
  else if (type == "spot")
  {
    light.kind = Light::Kind::Spot;
    light.position = readVector(value.at("position"));
    light.direction = (readVector(value.at("target")) - light.position).normalized();
    light.coneAngleDegrees = value.value("cone_angle", 30.0);
  }
  else if (type == "point")
  {
    light.kind = Light::Kind::Point;
    light.position = readVector(value.at("position"));
  }
  else
  {
    throw std::runtime_error("lights of type " + type + " cannot be checked");
  }
  return light;
}

/// Row-major, last row 0, 0, 0, 1.
Vec3 transform(const std::array<double, 16>& m, const Vec3& p)
{
  return { m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
    m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11] };
}

Surface readSurface(const Json& value, const std::filesystem::path& folder)
{
  Surface surface;
  const std::string file = (folder / value.at("file").get<std::string>()).string();
  Mesh mesh = readModel(file);
  surface.triangles = std::move(mesh.triangles);
  if (value.contains("texture"))
  {
    if (mesh.coordinates.empty())
    {
      throw std::runtime_error(file + ": has no texture coordinates");
    }
    surface.holes = readHoles((folder / value.at("texture").get<std::string>()).string());
    surface.coordinates = std::move(mesh.coordinates);
  }
  if (value.contains("matrix"))
  {
    const auto matrix = value.at("matrix").get<std::array<double, 16>>();
    for (Triangle& triangle : surface.triangles)
    {
      for (Vec3& corner : triangle)
      {
        corner = transform(matrix, corner);
      }
    }
  }
  surface.casts = value.value("casts", true);
  surface.receives = value.value("receives", true);
  surface.oneSided = value.value("one_sided", false);
  return surface;
}

} // namespace

void addSurface(Mesh& mesh, vtkPolyData* data, vtkMatrix4x4* worldFromData)
{
  vtkDataArray* const coordinates = data->GetPointData()->GetTCoords();
  const auto corner = [&](vtkIdType point)
  {
    double p[4] = { 0.0, 0.0, 0.0, 1.0 };
    data->GetPoint(point, p);
    if (worldFromData)
    {
      worldFromData->MultiplyPoint(p, p);
    }
    Corner result{ Vec3(p[0], p[1], p[2]), std::nullopt };
    if (coordinates)
    {
      result.coordinates =
        Vec2(coordinates->GetComponent(point, 0), coordinates->GetComponent(point, 1));
    }
    return result;
  };
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  const auto polygons = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell())
  {
    polygons->GetCurrentCell(size, points);
    for (vtkIdType i = 2; i < size; ++i)
    {
      addTriangle(mesh, corner(points[0]), corner(points[i - 1]), corner(points[i]));
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
        mesh, corner(points[i - 2 + odd]), corner(points[i - 1 - odd]), corner(points[i]));
    }
  }
}

Mesh readModel(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw std::runtime_error(path + ": no such file");
  }
  Mesh mesh = readByExtension(path);
  if (mesh.triangles.empty())
  {
    throw std::runtime_error(path + ": has no triangles");
  }
  if (mesh.coordinates.size() != mesh.triangles.size())
  {
    mesh.coordinates.clear(); // only some of its parts have coordinates
  }
  return mesh;
}

Holes readHoles(const std::string& path)
{
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(path.c_str()))
  {
    throw std::runtime_error(path + ": no PNG image");
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* const image = reader->GetOutput();
  const int components = image->GetNumberOfScalarComponents();
  Holes holes;
  holes.width = image->GetDimensions()[0];
  holes.height = image->GetDimensions()[1];
  for (int y = 0; y < holes.height; ++y)
  {
    for (int x = 0; x < holes.width; ++x)
    {
      holes.drawn.push_back(
        components < 4 || image->GetScalarComponentAsDouble(x, y, 0, components - 1) > 0.0);
    }
  }
  return holes;
}

bool Holes::isDrawn(const Vec2& coordinates) const
{
  const auto texel = [](double coordinate, int size)
  {
    const double place = (coordinate - std::floor(coordinate)) * size;
    return std::min(static_cast<int>(place), size - 1);
  };
  const int column = texel(coordinates.x, this->width);
  const int row = texel(coordinates.y, this->height);
  return this->drawn[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->width) +
    static_cast<std::size_t>(column)];
}

bool isDrawn(const Surface& surface, std::size_t triangle, const Vec3& point)
{
  if (!surface.holes)
  {
    return true;
  }
  // Weights from the areas opposite the corners, seen along the normal.
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3 normal = (b - a).cross(c - a);
  const double inA = (c - b).cross(point - b).dot(normal);
  const double inB = (a - c).cross(point - c).dot(normal);
  const double inC = (b - a).cross(point - a).dot(normal);
  const auto& [ta, tb, tc] = surface.coordinates[triangle];
  return surface.holes->isDrawn((inA * ta + inB * tb + inC * tc) / (inA + inB + inC));
}

Scene readScene(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error(path + ": cannot be read");
  }
  try
  {
    const Json root = Json::parse(file);
    Scene scene;
    scene.camera = readCamera(root.at("camera"));
    for (const Json& light : root.at("lights"))
    {
      scene.lights.push_back(readLight(light));
    }
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    for (const Json& model : root.at("models"))
    {
      scene.surfaces.push_back(readSurface(model, folder));
    }
    return scene;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(path + ": " + error.what());
  }
}

} // namespace gnomon::check
