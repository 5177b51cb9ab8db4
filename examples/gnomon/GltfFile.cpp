#include "GltfFile.h"

#include "ByteReader.h"
#include "Files.h"
#include "ImageCheck.h"
#include "JsonValue.h"
#include "ModelChecks.h"
#include "Text.h"
#include "Vec3.h"

#include <vtkBase64Utilities.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

namespace gnomon::tool
{

namespace
{

using Matrix = std::array<double, 16>; ///< row-major

constexpr int largestInt = std::numeric_limits<int>::max();

/// The values of glTF's accessor.componentType.
enum ComponentType
{
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126
};

const std::map<int, std::size_t> bytesOfComponent = { { Byte, 1 }, { UnsignedByte, 1 },
  { Short, 2 }, { UnsignedShort, 2 }, { UnsignedInt, 4 }, { Float, 4 } };

const std::map<std::string, std::size_t> componentsOfType = { { "SCALAR", 1 }, { "VEC2", 2 },
  { "VEC3", 3 }, { "VEC4", 4 }, { "MAT2", 4 }, { "MAT3", 9 }, { "MAT4", 16 } };

/// A range of bytes in a buffer.
struct BufferView
{
  std::size_t buffer = 0;
  std::size_t offset = 0;
  std::size_t bytes = 0;
  std::size_t stride = 0; ///< 0: tightly packed
};

struct Accessor
{
  std::string type;
  int componentType = Float;
  std::size_t count = 0;
  BufferView view;
  std::size_t offset = 0; ///< in the view
};

struct Document
{
  std::string path;
  nlohmann::json json;
  std::string binaryChunk; ///< only in a .glb file
  bool hasBinaryChunk = false;
};

//------------------------------------------------------------------------------
Document readGlb(const std::string& path)
{
  Document document;
  document.path = path;
  const std::string bytes = readWholeFile(path, largestModelBytes);
  ByteReader reader(path, bytes);
  constexpr std::uint32_t magic = 0x46546C67;     // "glTF"
  constexpr std::uint32_t jsonChunk = 0x4E4F534A; // "JSON"
  constexpr std::uint32_t binaryChunk = 0x004E4942;
  if (reader.read<std::uint32_t>("the word glTF") != magic)
  {
    reader.seek(0);
    reader.fail("not a binary glTF file, expected it to start with the word glTF");
  }
  const auto version = reader.read<std::uint32_t>("the version");
  if (version != 2)
  {
    reader.fail("found glTF version " + std::to_string(version) + ", expected 2");
  }
  const auto announced = reader.read<std::uint32_t>("the file's length");
  if (announced != bytes.size())
  {
    reader.fail("the header announces " + std::to_string(announced) + " bytes, but the file has " +
      std::to_string(bytes.size()) + "; it is truncated or damaged");
  }
  for (int chunk = 0; reader.position() < bytes.size(); ++chunk)
  {
    const auto length = reader.read<std::uint32_t>("a chunk's length");
    const auto type = reader.read<std::uint32_t>("a chunk's type");
    const std::size_t begin = reader.position();
    reader.skip(length, "a chunk");
    if (chunk == 0 && type != jsonChunk)
    {
      reader.fail("the first chunk is not JSON");
    }
    if (chunk == 0)
    {
      document.json = parseJson(bytes.substr(begin, length), path);
    }
    else if (chunk == 1 && type == binaryChunk)
    {
      document.binaryChunk = bytes.substr(begin, length);
      document.hasBinaryChunk = true;
    }
  }
  return document;
}

Document readGltf(const std::string& path)
{
  if (lowerExtension(path) == ".glb")
  {
    return readGlb(path);
  }
  Document document;
  document.path = path;
  document.json = parseJson(readWholeFile(path, largestModelBytes), path);
  return document;
}

//------------------------------------------------------------------------------
/// The type and bytes of a "data:" URI.
struct DataUri
{
  std::string mimeType;
  std::string bytes;
};

std::optional<DataUri> readDataUri(const JsonValue& uri)
{
  const std::string text = uri.text();
  if (text.compare(0, 5, "data:") != 0)
  {
    return std::nullopt;
  }
  const std::string mark = ";base64,";
  const std::size_t comma = text.find(mark);
  if (comma == std::string::npos)
  {
    uri.fail("data:TYPE;base64,...");
  }
  const std::string encoded = text.substr(comma + mark.size());
  DataUri data;
  data.mimeType = text.substr(5, comma - 5);
  data.bytes.resize(encoded.size() / 4 * 3);
  data.bytes.resize(
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(encoded.data()),
      encoded.size(), reinterpret_cast<unsigned char*>(data.bytes.data()), data.bytes.size()));
  return data;
}

//------------------------------------------------------------------------------
/// Refuse images that VTK's readers cannot decode. Without `mimeType`, both PNG and JPEG are valid.
void requireImage(const JsonValue& place, const std::string& bytes, const std::string& mimeType)
{
  const std::string type = imageType(bytes);
  if (type.empty() || (!mimeType.empty() && type != mimeType))
  {
    place.refuse("found bytes of " + (type.empty() ? "another type" : "type " + type) +
      ", expected " + (mimeType.empty() ? "a PNG or JPEG image" : mimeType));
  }
  if (!isWholeImage(bytes))
  {
    place.refuse("the image cannot be decoded, it is truncated or damaged");
  }
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
class GltfChecker
{
public:
  explicit GltfChecker(const Document& document)
    : document_(document)
    , root_(document.path, document.json)
    , folder_(std::filesystem::path(document.path).parent_path())
  {
  }

  GltfView check()
  {
    this->checkAsset();
    this->readBuffers();
    this->readBufferViews();
    this->readAccessors();
    this->checkImages();
    this->checkTextures();
    this->checkMaterials();
    this->checkMeshes();
    this->checkSkins();
    this->checkAnimations();
    this->visitScene();
    return std::move(this->view_);
  }

private:
  /// Return the elements of an optional array.
  std::vector<JsonValue> list(const char* key) const
  {
    return this->root_.member(key).elementsOrNone();
  }

  /// Return the number of elements of an optional array.
  std::size_t count(const char* key) const
  {
    const JsonValue value = this->root_.member(key);
    return value.present() ? value.size() : 0;
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

  static void checkOptionalIndex(const JsonValue& value, std::size_t count, const std::string& what)
  {
    if (value.present())
    {
      readIndex(value, count, what);
    }
  }

  static std::size_t readSize(const JsonValue& value, int low)
  {
    return value.present() ? static_cast<std::size_t>(value.integer(low, largestInt)) : 0;
  }

  void checkAsset()
  {
    const JsonValue version = this->root_.member("asset").member("version");
    const std::string text = version.text();
    if (text.compare(0, 2, "2.") != 0)
    {
      version.fail("glTF version 2.0");
    }
    // vtkGLTFImporter ignores other required extensions, and would show the file wrongly.
    const std::set<std::string> supported = { "KHR_lights_punctual", "KHR_materials_unlit" };
    for (const JsonValue& extension : this->list("extensionsRequired"))
    {
      if (supported.count(extension.text()) == 0)
      {
        extension.refuse(
          "the file needs glTF extension " + quoted(extension.text()) + ", which is not supported");
      }
    }
    for (const JsonValue& extension : this->list("extensionsUsed"))
    {
      extension.text();
    }
  }

  void readBuffers()
  {
    for (const JsonValue& buffer : this->list("buffers"))
    {
      const auto bytes =
        static_cast<std::size_t>(buffer.member("byteLength").integer(1, largestInt));
      const JsonValue uri = buffer.member("uri");
      std::string content;
      if (!uri.present() && this->buffers_.empty() && this->document_.hasBinaryChunk)
      {
        content = this->document_.binaryChunk;
      }
      else if (const std::optional<DataUri> data = readDataUri(uri))
      {
        content = data->bytes;
      }
      else
      {
        content = this->readNeighbour(uri);
      }
      if (content.size() < bytes)
      {
        buffer.refuse("found " + std::to_string(content.size()) + " bytes of data, expected " +
          std::to_string(bytes) + "; it is truncated");
      }
      this->buffers_.push_back(std::move(content));
    }
  }

  /// Read a file that a URI names, relative to the glTF file.
  std::string readNeighbour(const JsonValue& uri) const
  {
    const std::string path = (this->folder_ / uri.text()).string();
    try
    {
      return readWholeFile(path, largestModelBytes);
    }
    catch (const BadInput& error)
    {
      uri.refuse(error.what());
    }
  }

  void readBufferViews()
  {
    for (const JsonValue& value : this->list("bufferViews"))
    {
      BufferView view;
      view.buffer = readIndex(value.member("buffer"), this->buffers_.size(), "buffers");
      view.bytes = static_cast<std::size_t>(value.member("byteLength").integer(1, largestInt));
      view.offset = readSize(value.member("byteOffset"), 0);
      view.stride = readSize(value.member("byteStride"), 1);
      const std::size_t there = this->buffers_[view.buffer].size();
      if (view.offset + view.bytes > there)
      {
        value.refuse("ends at byte " + std::to_string(view.offset + view.bytes) +
          " of a buffer of " + std::to_string(there) + " bytes");
      }
      this->bufferViews_.push_back(view);
    }
  }

  const BufferView& readView(const JsonValue& index) const
  {
    return this->bufferViews_[readIndex(index, this->bufferViews_.size(), "bufferViews")];
  }

  /// Refuse a range of elements that exceeds its view.
  static void requireInside(const JsonValue& place, const BufferView& view, std::size_t offset,
    std::size_t count, std::size_t elementBytes)
  {
    const std::size_t step = view.stride == 0 ? elementBytes : view.stride;
    const std::size_t end = offset + (count - 1) * step + elementBytes;
    if (end > view.bytes)
    {
      place.refuse("ends at byte " + std::to_string(end) + " of a bufferView of " +
        std::to_string(view.bytes) + " bytes");
    }
  }

  static int readComponentType(const JsonValue& value)
  {
    const int type = value.integer(0, largestInt);
    if (bytesOfComponent.count(type) == 0)
    {
      value.fail("5120, 5121, 5122, 5123, 5125 or 5126");
    }
    return type;
  }

  void readAccessors()
  {
    for (const JsonValue& value : this->list("accessors"))
    {
      Accessor accessor;
      accessor.componentType = readComponentType(value.member("componentType"));
      accessor.count = static_cast<std::size_t>(value.member("count").integer(1, largestInt));
      accessor.type = value.member("type").text();
      if (componentsOfType.count(accessor.type) == 0)
      {
        value.member("type").fail("SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
      }
      accessor.offset = readSize(value.member("byteOffset"), 0);
      const std::size_t elementBytes =
        bytesOfComponent.at(accessor.componentType) * componentsOfType.at(accessor.type);
      accessor.view = this->readView(value.member("bufferView"));
      requireInside(value, accessor.view, accessor.offset, accessor.count, elementBytes);
      checkBounds(value.member("min"), accessor);
      checkBounds(value.member("max"), accessor);
      if (const JsonValue sparse = value.member("sparse"); sparse.present())
      {
        this->checkSparse(sparse, accessor, elementBytes);
      }
      this->accessors_.push_back(accessor);
    }
  }

  /// Check an accessor's bounds. VTK reads one number per component, even if numbers are missing.
  static void checkBounds(const JsonValue& bounds, const Accessor& accessor)
  {
    const std::vector<JsonValue> numbers = bounds.elementsOrNone();
    if (bounds.present() && numbers.size() != componentsOfType.at(accessor.type))
    {
      bounds.refuse("found " + std::to_string(numbers.size()) + " numbers, but " + accessor.type +
        " has " + std::to_string(componentsOfType.at(accessor.type)));
    }
    for (const JsonValue& number : numbers)
    {
      number.number({ -std::numeric_limits<double>::max(), std::numeric_limits<double>::max() });
    }
  }

  void checkSparse(
    const JsonValue& sparse, const Accessor& accessor, std::size_t elementBytes) const
  {
    const auto count = static_cast<std::size_t>(sparse.member("count").integer(1, largestInt));
    const JsonValue values = sparse.member("values");
    requireInside(values, this->readView(values.member("bufferView")),
      static_cast<std::size_t>(values.member("byteOffset").integer(0, largestInt)), count,
      elementBytes);

    const JsonValue indices = sparse.member("indices");
    Accessor places;
    places.type = "SCALAR";
    places.componentType = readComponentType(indices.member("componentType"));
    places.count = count;
    places.view = this->readView(indices.member("bufferView"));
    places.offset = static_cast<std::size_t>(indices.member("byteOffset").integer(0, largestInt));
    requireInside(
      indices, places.view, places.offset, count, bytesOfComponent.at(places.componentType));
    this->requireIndices(indices, places, accessor.count);
  }

  /// Refuse indices that are not below `end`.
  void requireIndices(const JsonValue& place, const Accessor& indices, std::size_t end) const
  {
    const std::size_t size = bytesOfComponent.at(indices.componentType);
    if (indices.type != "SCALAR" ||
      (indices.componentType != UnsignedByte && indices.componentType != UnsignedShort &&
        indices.componentType != UnsignedInt))
    {
      place.refuse("expected indices of type SCALAR and component type 5121, 5123 or 5125");
    }
    const std::size_t step = indices.view.stride == 0 ? size : indices.view.stride;
    const char* data =
      this->buffers_[indices.view.buffer].data() + indices.view.offset + indices.offset;
    for (std::size_t i = 0; i < indices.count; ++i)
    {
      std::uint32_t index = 0; // glTF and this machine are little-endian
      std::memcpy(&index, data + i * step, size);
      if (index >= end)
      {
        place.refuse("found index " + std::to_string(index) + ", but there are " +
          std::to_string(end) + " elements");
      }
    }
  }

  void checkImages() const
  {
    for (const JsonValue& image : this->list("images"))
    {
      const JsonValue mimeType = image.member("mimeType");
      if (const JsonValue view = image.member("bufferView"); view.present())
      {
        const BufferView& bytes = this->readView(view);
        requireImage(
          image, this->buffers_[bytes.buffer].substr(bytes.offset, bytes.bytes), mimeType.text());
        continue;
      }
      const JsonValue uri = image.member("uri");
      if (const std::optional<DataUri> data = readDataUri(uri))
      {
        requireImage(image, data->bytes, data->mimeType);
      }
      else
      {
        requireImage(image, this->readNeighbour(uri), "");
      }
    }
  }

  void checkTextures() const
  {
    const std::size_t images = this->count("images");
    const std::size_t samplers = this->count("samplers");
    for (const JsonValue& texture : this->list("textures"))
    {
      readIndex(texture.member("source"), images, "images");
      checkOptionalIndex(texture.member("sampler"), samplers, "samplers");
    }
  }

  void checkMaterials() const
  {
    for (const JsonValue& material : this->list("materials"))
    {
      material.keys();
      this->checkTextureInfo(material, "normalTexture");
      this->checkTextureInfo(material, "occlusionTexture");
      this->checkTextureInfo(material, "emissiveTexture");
      if (const JsonValue pbr = material.member("pbrMetallicRoughness"); pbr.present())
      {
        pbr.keys();
        this->checkTextureInfo(pbr, "baseColorTexture");
        this->checkTextureInfo(pbr, "metallicRoughnessTexture");
        pbr.member("baseColorFactor").numbersOr(std::array<double, 4>{}, { 0.0, 1.0 });
      }
      material.member("emissiveFactor").numbersOr(Vec3{}, { 0.0, 1.0 });
    }
  }

  void checkTextureInfo(const JsonValue& parent, const char* key) const
  {
    if (const JsonValue info = parent.member(key); info.present())
    {
      readIndex(info.member("index"), this->count("textures"), "textures");
    }
  }

  const Accessor& readAccessor(const JsonValue& index) const
  {
    return this->accessors_[readIndex(index, this->accessors_.size(), "accessors")];
  }

  void checkMeshes() const
  {
    for (const JsonValue& mesh : this->list("meshes"))
    {
      for (const JsonValue& primitive : mesh.member("primitives").elements())
      {
        this->checkPrimitive(primitive);
      }
    }
  }

  void checkPrimitive(const JsonValue& primitive) const
  {
    const JsonValue attributes = primitive.member("attributes");
    const std::size_t points = this->readAccessor(attributes.member("POSITION")).count;
    this->checkAttributes(attributes, points);
    for (const JsonValue& target : primitive.member("targets").elementsOrNone())
    {
      this->checkAttributes(target, points);
    }
    checkOptionalIndex(primitive.member("material"), this->count("materials"), "materials");

    std::size_t corners = points;
    if (const JsonValue indices = primitive.member("indices"); indices.present())
    {
      const Accessor& accessor = this->readAccessor(indices);
      this->requireIndices(indices, accessor, points);
      corners = accessor.count;
    }
    const JsonValue mode = primitive.member("mode");
    const int kind = mode.present() ? mode.integer(0, 6) : 4;
    const std::array<std::size_t, 7> fewest{ { 1, 2, 2, 2, 3, 3, 3 } };
    if (corners < fewest[static_cast<std::size_t>(kind)])
    {
      primitive.refuse("found " + std::to_string(corners) + " vertices, expected at least " +
        std::to_string(fewest[static_cast<std::size_t>(kind)]));
    }
  }

  void checkAttributes(const JsonValue& attributes, std::size_t points) const
  {
    const std::map<std::string, std::set<std::string>> types = { { "POSITION", { "VEC3" } },
      { "NORMAL", { "VEC3" } }, { "TANGENT", { "VEC3", "VEC4" } }, { "TEXCOORD_0", { "VEC2" } },
      { "TEXCOORD_1", { "VEC2" } }, { "COLOR_0", { "VEC3", "VEC4" } }, { "JOINTS_0", { "VEC4" } },
      { "WEIGHTS_0", { "VEC4" } } };
    for (const std::string& name : attributes.keys())
    {
      const JsonValue value = attributes.member(name);
      const Accessor& accessor = this->readAccessor(value);
      if (accessor.count != points)
      {
        value.refuse("found " + std::to_string(accessor.count) + " values, but POSITION has " +
          std::to_string(points));
      }
      const auto expected = types.find(name);
      if (expected != types.end() && expected->second.count(accessor.type) == 0)
      {
        value.refuse(
          "found values of type " + accessor.type + ", expected " + *expected->second.begin());
      }
      const bool geometry = name == "POSITION" || name == "NORMAL" || name == "TANGENT";
      if (geometry && accessor.componentType != Float)
      {
        value.refuse("found component type " + std::to_string(accessor.componentType) +
          ", expected 5126 (float)");
      }
    }
  }

  void checkSkins() const
  {
    const std::size_t nodes = this->count("nodes");
    for (const JsonValue& skin : this->list("skins"))
    {
      const std::vector<JsonValue> joints = skin.member("joints").elements();
      for (const JsonValue& joint : joints)
      {
        readIndex(joint, nodes, "nodes");
      }
      if (const JsonValue matrices = skin.member("inverseBindMatrices"); matrices.present())
      {
        if (this->readAccessor(matrices).count != joints.size())
        {
          matrices.refuse("expected one matrix per joint");
        }
      }
    }
  }

  void checkAnimations() const
  {
    for (const JsonValue& animation : this->list("animations"))
    {
      const std::vector<JsonValue> samplers = animation.member("samplers").elements();
      for (const JsonValue& sampler : samplers)
      {
        this->readAccessor(sampler.member("input"));
        this->readAccessor(sampler.member("output"));
      }
      for (const JsonValue& channel : animation.member("channels").elements())
      {
        readIndex(channel.member("sampler"), samplers.size(), "samplers");
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
    // vtkGLTFImporter visits every node and every scene.
    for (const JsonValue& other : scenes)
    {
      for (const JsonValue& node : other.member("nodes").elementsOrNone())
      {
        readIndex(node, this->nodes_.size(), "nodes");
      }
    }
    for (const JsonValue& node : this->nodes_)
    {
      this->checkNode(node);
    }
  }

  void checkNode(const JsonValue& node) const
  {
    node.keys();
    readTransform(node);
    checkOptionalIndex(node.member("mesh"), this->count("meshes"), "meshes");
    checkOptionalIndex(node.member("camera"), this->count("cameras"), "cameras");
    checkOptionalIndex(node.member("skin"), this->count("skins"), "skins");
    for (const JsonValue& child : node.member("children").elementsOrNone())
    {
      readIndex(child, this->nodes_.size(), "nodes");
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
      this->view_.notes.push_back(this->document_.path + ": node " + std::to_string(number) +
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
      camera.parallelScale = value.member("orthographic").member("ymag").number({ 1e-6, 1e12 });
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

  const Document& document_;
  JsonValue root_;
  std::filesystem::path folder_;
  std::vector<std::string> buffers_;
  std::vector<BufferView> bufferViews_;
  std::vector<Accessor> accessors_;
  std::vector<JsonValue> nodes_;
  std::vector<bool> visited_;
  GltfView view_;
};

} // namespace

//------------------------------------------------------------------------------
GltfView readGltfView(const std::string& path)
{
  const Document document = readGltf(path);
  return GltfChecker(document).check();
}

} // namespace gnomon::tool
