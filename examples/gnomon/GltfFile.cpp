#include "GltfFile.h"

#include "Errors.h"
#include "Files.h"
#include "JsonValue.h"
#include "ModelFile.h"
#include "Text.h"
#include "Vec3.h"

#include <vtkMath.h>
#include <vtkMatrix4x4.h>

#include <cstdint>
#include <cstring>
#include <filesystem>

namespace gnomon::tool
{

namespace
{

using Matrix = std::array<double, 16>; ///< row-major

/// Return the JSON document of a .gltf or .glb file.
nlohmann::json readDocument(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  if (lowerExtension(path) != ".glb")
  {
    return parseJson(bytes, path);
  }
  // The header, and the first chunk's length and type.
  constexpr std::size_t lengthBegin = 12;
  constexpr std::size_t typeBegin = 16;
  constexpr std::size_t jsonBegin = 20;
  if (bytes.size() < jsonBegin || bytes.compare(0, 4, "glTF") != 0 ||
    bytes.compare(typeBegin, 4, "JSON") != 0)
  {
    throw BadInput(path + ": not a binary glTF file, expected the words glTF and JSON");
  }
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + lengthBegin, sizeof(length));
  return parseJson(bytes.substr(jsonBegin, length), path);
}

//------------------------------------------------------------------------------
Matrix multiplied(const Matrix& a, const Matrix& b)
{
  Matrix result;
  vtkMatrix4x4::Multiply4x4(a.data(), b.data(), result.data());
  return result;
}

/// Return a node's matrix, from "matrix" (column-major) or from translation, rotation and scale.
Matrix readTransform(const JsonValue& node)
{
  Matrix matrix{ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
  if (const JsonValue value = node.member("matrix"); value.present())
  {
    const Matrix columns = value.numbers<16>(anyCoordinate);
    vtkMatrix4x4::Transpose(columns.data(), matrix.data());
    return matrix;
  }
  const Vec3 scale = node.member("scale").numbersOr(Vec3{ { 1.0, 1.0, 1.0 } }, anyCoordinate);
  double rotation[3][3];
  vtkMath::Identity3x3(rotation);
  if (const JsonValue value = node.member("rotation"); value.present())
  {
    const std::array<double, 4> xyzw = value.numbers<4>({ -1e6, 1e6 });
    const double wxyz[4] = { xyzw[3], xyzw[0], xyzw[1], xyzw[2] };
    if (xyzw == std::array<double, 4>{})
    {
      value.fail("a quaternion that is not zero");
    }
    vtkMath::QuaternionToMatrix3x3(wxyz, rotation);
  }
  const Vec3 translation = node.member("translation").numbersOr(Vec3{}, anyCoordinate);
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      matrix[4 * row + column] = rotation[row][column] * scale[column];
    }
    matrix[4 * row + 3] = translation[row];
  }
  return matrix;
}

//------------------------------------------------------------------------------
class GltfReader
{
public:
  GltfReader(const std::string& path, const nlohmann::json& document)
    : path_(path)
    , root_(path, document)
  {
  }

  GltfView read()
  {
    this->requireKnownExtensions();
    this->measureNeighbours();
    this->visitScene();
    return std::move(this->view_);
  }

private:
  /// Return the elements of an optional array.
  std::vector<JsonValue> list(const char* key) const
  {
    return this->root_.member(key).elementsOrNone();
  }

  /// Read an index into an array of `count` elements.
  static std::size_t readIndex(const JsonValue& value, std::size_t count, const std::string& what)
  {
    if (count == 0)
    {
      value.refuse("the file has no " + what);
    }
    return static_cast<std::size_t>(value.integer(0, static_cast<int>(count) - 1));
  }

  /// Refuse extensions that vtkGLTFImporter would ignore, and show the file wrongly.
  void requireKnownExtensions() const
  {
    for (const JsonValue& extension : this->list("extensionsRequired"))
    {
      const std::string name = extension.text();
      if (name != "KHR_lights_punctual" && name != "KHR_materials_unlit")
      {
        extension.refuse(
          "the file needs glTF extension " + quoted(name) + ", which is not supported");
      }
    }
  }

  /// Sum up the sizes of the files that hold buffers and images.
  void measureNeighbours()
  {
    for (const char* key : { "buffers", "images" })
    {
      for (const JsonValue& value : this->list(key))
      {
        const JsonValue uri = value.member("uri");
        if (uri.present() && uri.text().compare(0, 5, "data:") != 0)
        {
          const auto neighbour = std::filesystem::path(this->path_).parent_path() / uri.text();
          this->view_.neighbourBytes += requireReadableFile(neighbour.string());
        }
      }
    }
  }

  void visitScene()
  {
    this->nodes_ = this->list("nodes");
    this->visited_.assign(this->nodes_.size(), false);
    const std::vector<JsonValue> scenes = this->list("scenes");
    const JsonValue chosen = this->root_.member("scene");
    if (scenes.empty())
    {
      this->root_.member("scenes").fail("at least one scene");
    }
    const JsonValue& scene =
      scenes[chosen.present() ? readIndex(chosen, scenes.size(), "scenes") : 0];
    const JsonValue roots = scene.member("nodes");
    const Matrix identity{ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    for (const JsonValue& root : roots.elements())
    {
      this->visitNode(root, identity, 0);
    }
  }

  void visitNode(const JsonValue& index, const Matrix& worldFromParent, int depth)
  {
    constexpr int deepest = 256;
    const std::size_t number = readIndex(index, this->nodes_.size(), "nodes");
    if (this->visited_[number] || depth > deepest)
    {
      index.refuse("node " + std::to_string(number) +
        " occurs twice in the scene or is nested too deeply, expected a tree of nodes");
    }
    this->visited_[number] = true;
    const JsonValue& node = this->nodes_[number];
    const Matrix worldFromNode = multiplied(worldFromParent, readTransform(node));

    if (const JsonValue camera = node.member("camera"); camera.present())
    {
      const std::vector<JsonValue> cameras = this->list("cameras");
      this->readCamera(cameras[readIndex(camera, cameras.size(), "cameras")], worldFromNode);
    }
    const JsonValue light = node.member("extensions").member("KHR_lights_punctual").member("light");
    if (light.present())
    {
      const std::vector<JsonValue> lights =
        this->root_.member("extensions").member("KHR_lights_punctual").member("lights").elements();
      this->readLight(lights[readIndex(light, lights.size(), "lights")], worldFromNode);
    }
    if (node.member("skin").present())
    {
      this->view_.notes.push_back(this->path_ + ": node " + std::to_string(number) +
        ": its skin is left out, the mesh is shown at rest");
    }
    for (const JsonValue& child : node.member("children").elementsOrNone())
    {
      this->visitNode(child, worldFromNode, depth + 1);
    }
  }

  /// Return a node's direction of view, its -z axis.
  static Vec3 readForward(const JsonValue& place, const Matrix& worldFromNode)
  {
    const Vec3 forward = transformed(worldFromNode, { { 0.0, 0.0, -1.0 } }, 0.0);
    if (!(length(forward) > 0.0))
    {
      place.refuse("the matrices of its nodes are singular, so it has no direction");
    }
    return normalized(forward);
  }

  void readCamera(const JsonValue& value, const Matrix& worldFromNode)
  {
    const std::string type = value.member("type").text();
    SceneCamera camera;
    if (type == "perspective")
    {
      camera.fovDegrees = vtkMath::DegreesFromRadians(
        value.member("perspective").member("yfov").number({ 1e-4, 3.12 }));
    }
    else if (type == "orthographic")
    {
      camera.parallelScale = value.member("orthographic").member("ymag").number({ 1e-30, 1e30 });
    }
    else
    {
      value.member("type").fail("perspective or orthographic");
    }
    if (this->view_.camera)
    {
      return;
    }
    camera.position = transformed(worldFromNode, { { 0.0, 0.0, 0.0 } }, 1.0);
    const Vec3 forward = readForward(value, worldFromNode);
    camera.target = camera.position + forward;
    camera.up = normalized(transformed(worldFromNode, { { 0.0, 1.0, 0.0 } }, 0.0));
    if (!(length(cross(forward, camera.up)) > 1e-6))
    {
      value.refuse("the matrices of its nodes are singular, so it has no up direction");
    }
    this->view_.camera = camera;
  }

  void readLight(const JsonValue& value, const Matrix& worldFromNode)
  {
    SceneLight light;
    const JsonValue kind = value.member("type");
    const std::string type = kind.text();
    light.position = transformed(worldFromNode, { { 0.0, 0.0, 0.0 } }, 1.0);
    light.target = light.position + readForward(value, worldFromNode);
    light.color = value.member("color").numbersOr(light.color, { 0.0, 1.0 });
    light.intensity = value.member("intensity").numberOr(light.intensity, { 0.0, 1e9 });
    if (type == "spot")
    {
      light.type = SceneLight::Type::Spot;
      const JsonValue cone = value.member("spot").member("outerConeAngle");
      const double halfTurn = vtkMath::Pi() / 2.0;
      light.coneAngleDegrees = std::min(89.9,
        vtkMath::DegreesFromRadians(cone.numberOr(halfTurn / 2.0, { 1e-3, halfTurn + 1e-6 })));
    }
    else if (type == "point")
    {
      light.type = SceneLight::Type::Point;
    }
    else if (type != "directional")
    {
      kind.fail("directional, spot or point");
    }
    this->view_.lights.push_back(light);
  }

  const std::string& path_;
  JsonValue root_;
  std::vector<JsonValue> nodes_;
  std::vector<bool> visited_;
  GltfView view_;
};

} // namespace

//------------------------------------------------------------------------------
GltfView readGltfView(const std::string& path)
{
  const nlohmann::json document = readDocument(path);
  return GltfReader(path, document).read();
}

} // namespace gnomon::tool
