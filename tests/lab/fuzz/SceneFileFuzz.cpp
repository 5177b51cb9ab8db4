// libFuzzer's target for scene files: reading any bytes ends in a scene or in BadInput. Run it with
// tests/lab/fuzz/run.sh.

#include "Errors.h"
#include "Scene.h"
#include "SceneFile.h"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  // The folder that holds the models of the seeds.
  static const std::filesystem::path folder = std::getenv("GNOMON_FUZZ_FOLDER");
  static const std::string path =
    (folder / ("input_" + std::to_string(::getpid()) + ".json")).string();
  std::ofstream(path, std::ios::binary)
    .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  try
  {
    gnomon::tool::readSceneFile(path);
  }
  catch (const gnomon::tool::BadInput&)
  {
    // Most inputs are bad.
  }
  return 0;
}
