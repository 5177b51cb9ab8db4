#include "Cases.h"
#include "RunProgram.h"
#include "SampleFiles.h"

#include "Errors.h"
#include "ImageFile.h"
#include "Scene.h"

#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <fcntl.h>
#include <unistd.h>

#include <iostream>
#include <map>

namespace gnomon::fuzz
{
namespace
{

/// Return a .vtp file, with its arrays compressed and after the XML.
/// @param setCompressor chooses the compressor
std::string compressedVtp(void (vtkXMLPolyDataWriter::*setCompressor)())
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(sphere->GetOutputPort());
  (writer->*setCompressor)();
  writer->EncodeAppendedDataOff();
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

std::string sampleJpeg()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(24, 16, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* const values = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int i = 0; i < 24 * 16 * 3; ++i)
  {
    values[i] = static_cast<unsigned char>(i * i);
  }
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  return { bytes->GetPointer(0), bytes->GetPointer(bytes->GetNumberOfValues()) };
}

/// Return a .glb file with a JPEG image.
std::string glbWithJpeg()
{
  nlohmann::json document = tool::sampleGltf();
  const auto begin = document["bufferViews"][3]["byteOffset"].get<std::size_t>();
  const std::string image = sampleJpeg();
  document["bufferViews"][3]["byteLength"] = image.size();
  document["buffers"][0]["byteLength"] = begin + image.size();
  document["images"][0]["mimeType"] = "image/jpeg";
  return tool::makeGlb(document, tool::sampleFile("buffer.bin").substr(0, begin) + image);
}

/// Return valid files by name, one of every type that the program reads.
std::map<std::string, std::string> goodFiles()
{
  std::map<std::string, std::string> files = tool::sampleModels();
  files["scene.json"] = tool::sampleScene().dump(1);
  files["texture.png"] = tool::sampleFile("picture.png");
  files["texture.jpg"] = sampleJpeg();
  files["jpeg.glb"] = glbWithJpeg();
  files["zlib.vtp"] = compressedVtp(&vtkXMLPolyDataWriter::SetCompressorTypeToZLib);
  files["lz4.vtp"] = compressedVtp(&vtkXMLPolyDataWriter::SetCompressorTypeToLZ4);
  files["lzma.vtp"] = compressedVtp(&vtkXMLPolyDataWriter::SetCompressorTypeToLZMA);
  files["raw.vtp"] = compressedVtp(&vtkXMLPolyDataWriter::SetCompressorTypeToNone);
  files["paint.mtl"] = "newmtl red\nKd 0.8 0.1 0.2\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\n"
                       "newmtl picture\nKd 1 1 1\nmap_Kd texture.jpg\n";
  files["painted.obj"] = "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\n"
                         "vt 0 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nusemtl picture\n"
                         "f 1/1/1 4/2/1 3/3/1\n";
  files["lights.json"] = nlohmann::json::parse(R"({
    "camera": {"position": [3, 4, 5], "target": [0, 0, 0], "parallel_scale": 2},
    "models": [{"file": "painted.obj", "texture": "texture.png"}, {"file": "ascii.ply"}],
    "lights": [{"type": "area", "shape": "disk", "position": [1, 5, 1], "target": [0, 0, 0],
                "radius": 0.5, "texture": "texture.png", "up": [1, 0, 0]},
               {"type": "area", "shape": "rectangle", "position": [1, 5, 1], "target": [0, 0, 0],
                "width": 1, "height": 2, "up": [0, 0, 1]},
               {"type": "directional", "direction": [0, -1, 0], "bias_constant": 0.5,
                "box": {"position": [0, 3, 0], "up": [1, 0, 0], "width": 2, "height": 2,
                        "depth": 5}},
               {"type": "point", "position": [0, 3, 0], "map_size": 64}],
    "ground": true, "ambient": 0.2})")
                           .dump(1);
  return files;
}

/// Return the start and length of a random word in a text.
std::pair<std::size_t, std::size_t> drawWord(const std::string& bytes, Random& random)
{
  const char* const ends = " \t\r\n,:[]{}\"/<>=";
  const std::size_t first = bytes.find_first_not_of(ends, random() % bytes.size());
  if (first == std::string::npos)
  {
    return { 0, 0 };
  }
  const std::size_t end = bytes.find_first_of(ends, first);
  return { first, (end == std::string::npos ? bytes.size() : end) - first };
}

/// Replace one value of a JSON document by a random one, or remove it.
nlohmann::json withOtherValue(const nlohmann::json& document, Random& random)
{
  static const std::vector<const char*> values = { "-1", "0", "1", "3", "1e308", "-1e308", "0.5",
    "4294967295", "null", "true", "[]", "{}", "\"\"", "\"off\"", "[0, 0, 0]" };
  const nlohmann::json places = document.flatten();
  std::vector<std::string> names;
  for (const auto& place : places.items())
  {
    names.push_back(place.key());
  }
  nlohmann::json change{ { "op", "replace" }, { "path", pick(names, random) } };
  switch (random() % 3)
  {
    case 0:
      change["value"] = places[pick(names, random)];
      break;
    case 1:
      change["value"] = nlohmann::json::parse(pick(values, random));
      break;
    default:
      change["op"] = "remove";
  }
  return document.patch(nlohmann::json::array({ change }));
}

/// Change some bytes or one word at random.
void mutate(std::string& bytes, Random& random)
{
  static const std::vector<std::string> extremes = { "-1", "0", "1e308", "-1e308", "nan", "inf",
    "4294967295", "2147483648", "99999999999999999999", "1e-308", "0.5", "" };
  if (bytes.empty())
  {
    return;
  }
  const std::size_t place = random() % bytes.size();
  const std::size_t length = 1 + random() % std::min<std::size_t>(64, bytes.size());
  switch (random() % 12)
  {
    case 0:
      bytes[place] = static_cast<char>(random());
      break;
    case 1:
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
      break;
    case 2:
      bytes.resize(place);
      break;
    case 3:
      bytes.erase(place, length);
      break;
    case 4:
      bytes.insert(random() % bytes.size(), bytes.substr(place, length));
      break;
    case 5: // sets all bits of a number in a binary file
      bytes.replace(place, 4, std::string(4, chance(random, 0.5) ? '\xff' : '\x7f'));
      break;
    case 6:
    case 7:
    case 8:
    {
      const auto [first, count] = drawWord(bytes, random);
      bytes.replace(first, count, pick(extremes, random));
      break;
    }
    default:
    {
      const auto [first, count] = drawWord(bytes, random);
      const auto [from, countFrom] = drawWord(bytes, random);
      bytes.replace(first, count, bytes.substr(from, countFrom));
    }
  }
}

/// Change a file in up to three places, or in none.
std::string broken(const std::string& name, std::string bytes, Random& random)
{
  unsigned places = chance(random, 0.1) ? 0 : 1 + random() % 3;
  const bool isJson = bytes.front() == '{';
  if (places > 0 && (isJson || name == "model.glb") && chance(random, 0.7))
  {
    --places;
    bytes = isJson
      ? withOtherValue(nlohmann::json::parse(bytes), random).dump(1)
      : tool::makeGlb(withOtherValue(tool::sampleGltf(), random), tool::sampleFile("buffer.bin"));
  }
  for (; places > 0; --places)
  {
    mutate(bytes, random);
  }
  return bytes;
}

/// Return the file to open so that the given file is read.
std::string entryOf(const std::string& name, Random& random)
{
  if (name == "paint.mtl" || name == "texture.jpg")
  {
    return "painted.obj";
  }
  const bool isOfScene = name == "texture.png" || name == "ascii.ply" || name == "painted.obj";
  return isOfScene && (name == "texture.png" || chance(random, 0.5)) ? "lights.json" : name;
}

/// Read a scene in a process of its own, as the program does, but without its start.
tool::Outcome readAlone(const tool::TestFolder& folder, const std::string& entry)
{
  const std::string errors = folder / "stderr.txt";
  const pid_t process = ::fork();
  if (process == 0)
  {
    ::dup2(::open(errors.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    int code = 0;
    try
    {
      tool::loadScene(folder / entry);
    }
    catch (const tool::BadInput& error)
    {
      std::cerr << "gnomon: error: " << error.what() << "\n";
      code = tool::badInputCode;
    }
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  return { WIFEXITED(status), WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status),
    tool::readBytes(errors), "" };
}

} // namespace

void runFile(Random random, std::string& description)
{
  const tool::TestFolder folder;
  static const std::map<std::string, std::string> files = goodFiles();
  const auto& [name, good] = *std::next(files.begin(), random() % files.size());
  const std::string bytes = broken(name, good, random);
  for (const auto& [fileName, ofFile] : files)
  {
    tool::writeBytes(folder / fileName, fileName == name ? bytes : ofFile);
  }
  const std::string entry = entryOf(name, random);
  description = entry + " is read, with this " + name + ":\n" + bytes;

  tool::Outcome outcome = readAlone(folder, entry);
  const bool isDrawn = outcome.exited && outcome.code == 0 && chance(random, 0.1);
  if (isDrawn)
  {
    outcome = tool::run(
      folder, "render " + entry + " -o out.png --size 24x16 --technique nsm --map-size 32");
  }
  const std::string said = (outcome.exited ? "exit code " : "signal ") +
    std::to_string(outcome.code) + ": " + outcome.errors;
  const bool isRead = outcome.exited && outcome.code == 0;
  const bool isRefused = outcome.exited && outcome.code == tool::badInputCode && bytes != good;
  // Settings that contradict each other are found while rendering.
  const bool isNamed =
    outcome.errors.find("gnomon: error: rendering: light ") != std::string::npos ||
    (outcome.errors.find("gnomon: error: ") != std::string::npos &&
      outcome.errors.find(name) != std::string::npos);
  if (!isRead && !(isRefused && isNamed))
  {
    throw Find(said);
  }
  if (isDrawn && isRead)
  {
    tool::readPicture(folder / "out.png");
  }
  else if (std::filesystem::exists(folder / "out.png"))
  {
    throw Find("a picture is left by " + said);
  }
}

} // namespace gnomon::fuzz
