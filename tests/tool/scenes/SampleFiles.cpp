#include "SampleFiles.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <vector>

namespace gnomon::tool
{

namespace
{

const std::vector<std::array<float, 3>> vertices = { { { -1, 0, -1 } }, { { 1, 0, -1 } },
  { { 1, 0, 1 } }, { { -1, 0, 1 } }, { { 0, 2, 0 } } };
const std::vector<std::array<int, 3>> triangles = { { { 0, 1, 2 } }, { { 0, 2, 3 } },
  { { 0, 4, 1 } }, { { 1, 4, 2 } }, { { 2, 4, 3 } }, { { 3, 4, 0 } } };

/// A value's bytes, little-endian unless asked otherwise.
template <class T>
std::string bytesOf(T value, bool bigEndian = false)
{
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
  if (bigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

std::string plyHeader(const std::string& format)
{
  return "ply\nformat " + format +
    " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string pngChunk(const std::string& type, const std::string& content)
{
  const std::string checked = type + content;
  const auto sum = static_cast<std::uint32_t>(crc32(
    0, reinterpret_cast<const unsigned char*>(checked.data()), static_cast<uInt>(checked.size())));
  return bytesOf(static_cast<std::uint32_t>(content.size()), true) + checked + bytesOf(sum, true);
}

std::string chunk3ds(unsigned tag, const std::string& content)
{
  return bytesOf(static_cast<std::uint16_t>(tag)) +
    bytesOf(static_cast<std::uint32_t>(content.size() + 6)) + content;
}

} // namespace

//------------------------------------------------------------------------------
std::string sampleObj()
{
  std::ostringstream text;
  for (const auto& v : vertices)
  {
    text << "v " << v[0] << " " << v[1] << " " << v[2] << "\n";
  }
  for (const auto& t : triangles)
  {
    text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string sampleAsciiPly()
{
  std::ostringstream text;
  text << plyHeader("ascii");
  for (const auto& v : vertices)
  {
    text << v[0] << " " << v[1] << " " << v[2] << "\n";
  }
  for (const auto& t : triangles)
  {
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string sampleBinaryPly(bool bigEndian)
{
  std::string bytes = plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& v : vertices)
  {
    for (const float x : v)
    {
      bytes += bytesOf(x, bigEndian);
    }
  }
  for (const auto& t : triangles)
  {
    bytes += '\3';
    for (const std::int32_t i : t)
    {
      bytes += bytesOf(i, bigEndian);
    }
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::string sampleAsciiStl()
{
  std::ostringstream text;
  text << "solid pyramid\n";
  for (const auto& t : triangles)
  {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const int i : t)
    {
      const auto& v = vertices[static_cast<std::size_t>(i)];
      text << "  vertex " << v[0] << " " << v[1] << " " << v[2] << "\n";
    }
    text << " endloop\nendfacet\n";
  }
  text << "endsolid pyramid\n";
  return text.str();
}

//------------------------------------------------------------------------------
std::string sampleBinaryStl()
{
  std::string bytes(80, '\0');
  bytes += bytesOf(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& t : triangles)
  {
    bytes += std::string(12, '\0');
    for (const int i : t)
    {
      for (const float x : vertices[static_cast<std::size_t>(i)])
      {
        bytes += bytesOf(x);
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::string sampleVtp()
{
  std::ostringstream text;
  text << "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
          "<Piece NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
          "NumberOfStrips=\"0\" NumberOfPolys=\"6\">\n"
          "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& v : vertices)
  {
    text << v[0] << " " << v[1] << " " << v[2] << "\n";
  }
  text << "</DataArray></Points>\n<Polys>"
          "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& t : triangles)
  {
    text << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
  text << "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n"
          "3 6 9 12 15 18\n</DataArray></Polys></Piece></PolyData></VTKFile>\n";
  return text.str();
}

//------------------------------------------------------------------------------
std::string sample3ds()
{
  std::string points = bytesOf(static_cast<std::uint16_t>(vertices.size()));
  for (const auto& v : vertices)
  {
    for (const float x : v)
    {
      points += bytesOf(x);
    }
  }
  std::string faces = bytesOf(static_cast<std::uint16_t>(triangles.size()));
  for (const auto& t : triangles)
  {
    for (const int i : t)
    {
      faces += bytesOf(static_cast<std::uint16_t>(i));
    }
    faces += std::string(2, '\0');
  }
  const std::string mesh = chunk3ds(0x4100, chunk3ds(0x4110, points) + chunk3ds(0x4120, faces));
  const std::string object = chunk3ds(0x4000, std::string("pyramid") + '\0' + mesh);
  return chunk3ds(0x4D4D, chunk3ds(0x3D3D, object));
}

//------------------------------------------------------------------------------
std::string base64(const std::string& bytes)
{
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

//------------------------------------------------------------------------------
std::string samplePng()
{
  constexpr std::uint32_t side = 8;
  std::string rows;
  for (std::uint32_t y = 0; y < side; ++y)
  {
    rows += '\0';
    for (std::uint32_t x = 0; x < side; ++x)
    {
      rows += { static_cast<char>(30 * x), static_cast<char>(30 * y), '\x40' };
    }
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<unsigned char*>(packed.data()), &size,
    reinterpret_cast<const unsigned char*>(rows.data()), static_cast<uLong>(rows.size()));
  packed.resize(size);
  const std::string header =
    bytesOf(side, true) + bytesOf(side, true) + std::string("\x08\x02\0\0\0", 5);
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + pngChunk("IDAT", packed) +
    pngChunk("IEND", "");
}

//------------------------------------------------------------------------------
std::string sampleGltfBuffer()
{
  std::string bytes;
  for (const auto& v : vertices)
  {
    for (const float x : v)
    {
      bytes += bytesOf(x);
    }
  }
  for (const auto& t : triangles)
  {
    for (const int i : t)
    {
      bytes += bytesOf(static_cast<std::uint16_t>(i));
    }
  }
  for (const auto& v : vertices)
  {
    bytes += bytesOf(0.5f * (v[0] + 1.0f)) + bytesOf(0.25f * (v[2] + 1.0f));
  }
  return bytes + samplePng();
}

//------------------------------------------------------------------------------
nlohmann::json sampleGltf()
{
  const std::size_t imageBytes = samplePng().size();
  nlohmann::json document = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0, 1, 2, 3]}],
    "nodes": [
      {"mesh": 0, "translation": [0, 0, 1]},
      {"camera": 0, "translation": [0, 1, 9]},
      {"translation": [0, 7, 1], "rotation": [-0.70710678, 0, 0, 0.70710678],
       "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"rotation": [-0.70710678, 0, 0, 0.70710678],
       "extensions": {"KHR_lights_punctual": {"light": 1}}}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "spot", "intensity": 72, "spot": {"outerConeAngle": 0.5}},
      {"type": "directional", "color": [1, 0.5, 0.25], "intensity": 2}]}},
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
    "meshes": [{"primitives": [
      {"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]}],
    "materials": [{"doubleSided": true, "pbrMetallicRoughness": {
      "baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.125, "roughnessFactor": 0.75,
      "baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}],
    "images": [{"bufferView": 3, "mimeType": "image/png"}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3",
       "min": [-1, 0, -1], "max": [1, 2, 1]},
      {"bufferView": 1, "componentType": 5123, "count": 18, "type": "SCALAR"},
      {"bufferView": 2, "componentType": 5126, "count": 5, "type": "VEC2"}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 60},
      {"buffer": 0, "byteOffset": 60, "byteLength": 36},
      {"buffer": 0, "byteOffset": 96, "byteLength": 40},
      {"buffer": 0, "byteOffset": 136}],
    "buffers": [{}]})");
  document["bufferViews"][3]["byteLength"] = imageBytes;
  document["buffers"][0]["byteLength"] = 136 + imageBytes;
  return document;
}

//------------------------------------------------------------------------------
nlohmann::json sampleGltfWithBuffer()
{
  nlohmann::json document = sampleGltf();
  document["buffers"][0]["uri"] =
    "data:application/octet-stream;base64," + base64(sampleGltfBuffer());
  return document;
}

//------------------------------------------------------------------------------
std::string makeGlb(const nlohmann::json& document, const std::string& buffer)
{
  std::string json = document.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary = buffer;
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const std::string chunks = bytesOf(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
    bytesOf(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
  return "glTF" + bytesOf(std::uint32_t{ 2 }) +
    bytesOf(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

//------------------------------------------------------------------------------
std::map<std::string, std::string> sampleModels()
{
  return { { "model.obj", sampleObj() }, { "ascii.ply", sampleAsciiPly() },
    { "little.ply", sampleBinaryPly(false) }, { "big.ply", sampleBinaryPly(true) },
    { "ascii.stl", sampleAsciiStl() }, { "binary.stl", sampleBinaryStl() },
    { "model.vtp", sampleVtp() }, { "model.3ds", sample3ds() },
    { "model.gltf", sampleGltfWithBuffer().dump() },
    { "model.glb", makeGlb(sampleGltf(), sampleGltfBuffer()) } };
}

//------------------------------------------------------------------------------
nlohmann::json sampleScene()
{
  return nlohmann::json::parse(R"({
    "camera": {"position": [3, 4, 5], "target": [0, 1, 0], "up": [0, 1, 0], "fov": 45},
    "models": [{"file": "model.obj", "matrix": [2,0,0,10, 0,2,0,20, 0,0,2,30, 0,0,0,1],
                "color": [1, 0.5, 0.25], "casts": false, "receives": false, "one_sided": true}],
    "lights": [{"type": "directional", "direction": [1, -2, 2], "color": [1, 0.5, 0],
                "intensity": 2, "technique": "raytraced", "map_size": 512},
               {"type": "spot", "position": [1, 2, 3], "target": [0, 0, 0], "cone_angle": 25}],
    "background": [0.25, 0.5, 0.75]})");
}

} // namespace gnomon::tool
