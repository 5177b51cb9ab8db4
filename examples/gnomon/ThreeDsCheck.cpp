#include "ModelChecks.h"

#include "ByteReader.h"
#include "Files.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <set>

namespace gnomon::tool
{

namespace
{

/// Visits the chunks of a .3ds file as vtk3DSImporter does.
class ThreeDsChecker
{
public:
  ThreeDsChecker(const std::string& path, const std::string& bytes)
    : reader_(path, bytes)
  {
  }

  void check()
  {
    const Chunk main = this->readChunk(this->reader_.size());
    if (main.tag != 0x4D4D)
    {
      this->reader_.seek(0);
      this->reader_.fail("not a .3ds file, expected it to start with the main chunk 4D4D");
    }
    this->visitChunks(
      main.end, { { 0x3D3D, [this](const Chunk& editor) { this->checkEditor(editor); } } });
    for (const std::string& name : this->usedMaterials_)
    {
      if (this->materials_.count(name) == 0)
      {
        this->reader_.fail("no material has the name \"" + name + "\" that a mesh uses");
      }
    }
  }

private:
  struct Chunk
  {
    unsigned tag;
    std::size_t end;
  };

  Chunk readChunk(std::size_t parentEnd)
  {
    const std::size_t begin = this->reader_.position();
    const unsigned tag = this->reader_.read<std::uint16_t>("a chunk");
    const std::size_t bytes = this->reader_.read<std::uint32_t>("a chunk's length");
    constexpr std::size_t chunkHeaderBytes = 6;
    if (bytes < chunkHeaderBytes || bytes > parentEnd - begin)
    {
      this->reader_.seek(begin);
      this->reader_.fail("found a chunk of " + std::to_string(bytes) + " bytes, expected " +
        std::to_string(chunkHeaderBytes) + " to " + std::to_string(parentEnd - begin) +
        "; the file is truncated or damaged");
    }
    return { tag, begin + bytes };
  }

  /// Call the handler of each chunk's tag, for all chunks up to an end.
  void visitChunks(
    std::size_t end, const std::map<unsigned, std::function<void(const Chunk&)>>& visits)
  {
    while (this->reader_.position() < end)
    {
      const Chunk chunk = this->readChunk(end);
      if (const auto visit = visits.find(chunk.tag); visit != visits.end())
      {
        visit->second(chunk);
      }
      this->reader_.seek(chunk.end);
    }
  }

  void checkEditor(const Chunk& editor)
  {
    const auto checkObject = [this](const Chunk& object)
    {
      this->readName("an object");
      this->visitChunks(
        object.end, { { 0x4100, [this](const Chunk& mesh) { this->checkMesh(mesh); } } });
    };
    this->visitChunks(editor.end,
      { { 0xAFFF, [this](const Chunk& material) { this->checkMaterial(material); } },
        { 0x4000, checkObject } });
  }

  void checkMaterial(const Chunk& material)
  {
    const auto checkMap = [this](const Chunk& map)
    {
      this->visitChunks(
        map.end, { { 0xA300, [this](const Chunk&) { this->readName("a texture"); } } });
    };
    this->visitChunks(material.end,
      { { 0xA000, [this](const Chunk&) { this->materials_.insert(this->readName("a material")); } },
        { 0xA200, checkMap }, { 0xA230, checkMap } });
  }

  void checkMesh(const Chunk& mesh)
  {
    std::size_t vertices = 0;
    std::size_t highest = 0;
    std::size_t faces = 0;
    const auto checkVertices = [&](const Chunk&)
    {
      vertices = this->reader_.read<std::uint16_t>("the number of vertices");
      this->reader_.skip(vertices * 3 * sizeof(float), "vertices");
    };
    const auto checkFaces = [&](const Chunk& chunk)
    {
      faces = this->reader_.read<std::uint16_t>("the number of faces");
      for (std::size_t i = 0; i < faces; ++i)
      {
        for (int corner = 0; corner < 3; ++corner)
        {
          const std::size_t index = this->reader_.read<std::uint16_t>("a face");
          highest = std::max(highest, index);
        }
        this->reader_.skip(sizeof(std::uint16_t), "a face");
      }
      this->visitChunks(
        chunk.end, { { 0x4130, [&](const Chunk&) { this->checkMaterialGroup(faces); } } });
    };
    this->visitChunks(mesh.end, { { 0x4110, checkVertices }, { 0x4120, checkFaces } });
    if (faces > 0 && highest >= vertices)
    {
      this->reader_.fail("found a face with vertex number " + std::to_string(highest) +
        ", but the mesh has " + std::to_string(vertices) + " vertices");
    }
  }

  void checkMaterialGroup(std::size_t faces)
  {
    this->usedMaterials_.insert(this->readName("a material"));
    const std::size_t count = this->reader_.read<std::uint16_t>("the number of faces");
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t face = this->reader_.read<std::uint16_t>("a face's number");
      if (face >= faces)
      {
        this->reader_.fail("found face number " + std::to_string(face) + " in a material's list, " +
          "but the mesh has " + std::to_string(faces) + " faces");
      }
    }
  }

  std::string readName(const std::string& what)
  {
    // vtk3DSImporter has 80 bytes for a name, and may prepend a letter.
    constexpr std::size_t longestName = 78;
    return this->reader_.readName(longestName, what);
  }

  ByteReader reader_;
  std::set<std::string> materials_;
  std::set<std::string> usedMaterials_;
};

} // namespace

//------------------------------------------------------------------------------
void check3dsFile(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  ThreeDsChecker(path, bytes).check();
}

} // namespace gnomon::tool
