#include "SampleFiles.h"

#include "../TestFiles.h"

namespace gnomon::tool
{

namespace
{

/// A number's four bytes, little-endian.
std::string bytesOf(std::size_t number)
{
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8)
  {
    bytes += static_cast<char>(number >> shift);
  }
  return bytes;
}

/// A chunk of a .glb file, filled up to a multiple of four bytes.
std::string chunkOf(const std::string& type, std::string content, char filler)
{
  content.resize((content.size() + 3) / 4 * 4, filler);
  return bytesOf(content.size()) + type + content;
}

} // namespace

std::string sampleFile(const std::string& name)
{
  return readBytes(GNOMON_SOURCE_DIR "/tests/tool/scenes/samples/" + name);
}

nlohmann::json sampleGltfWithBuffer()
{
  return nlohmann::json::parse(sampleFile("model.gltf"));
}

nlohmann::json sampleGltf()
{
  nlohmann::json document = sampleGltfWithBuffer();
  document["buffers"][0].erase("uri");
  return document;
}

std::string makeGlb(const nlohmann::json& document, const std::string& buffer)
{
  const std::string chunks =
    chunkOf("JSON", document.dump(), ' ') + chunkOf(std::string("BIN\0", 4), buffer, '\0');
  return "glTF" + bytesOf(2) + bytesOf(chunks.size() + 12) + chunks;
}

std::map<std::string, std::string> sampleModels()
{
  std::map<std::string, std::string> models;
  for (const char* name : { "model.obj", "ascii.ply", "little.ply", "big.ply", "ascii.stl",
         "binary.stl", "model.vtp", "model.3ds" })
  {
    models[name] = sampleFile(name);
  }
  models["model.gltf"] = sampleGltfWithBuffer().dump();
  models["model.glb"] = makeGlb(sampleGltf(), sampleFile("buffer.bin"));
  return models;
}

nlohmann::json sampleScene()
{
  return nlohmann::json::parse(sampleFile("scene.json"));
}

} // namespace gnomon::tool
