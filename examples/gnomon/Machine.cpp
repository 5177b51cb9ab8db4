#include "Machine.h"

#include <vtkRenderWindow.h>

#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace gnomon::tool
{
namespace
{

/// Return the text after the colon of the first line that begins with `key`; empty without such a
/// line.
std::string valueOf(std::istream& text, const std::string& key)
{
  for (std::string line; std::getline(text, line);)
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
      return start == std::string::npos ? std::string() : line.substr(start);
    }
  }
  return {};
}

std::string processorModel()
{
  std::ifstream file("/proc/cpuinfo");
  const std::string model = valueOf(file, "model name");
  return model.empty() ? "unknown" : model;
}

} // namespace

//------------------------------------------------------------------------------
std::int64_t residentBytes()
{
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  file >> total >> resident;
  return file ? resident * sysconf(_SC_PAGESIZE) : 0;
}

//------------------------------------------------------------------------------
std::string processorName()
{
  return processorModel() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

//------------------------------------------------------------------------------
std::string openGlName(vtkRenderWindow* window)
{
  const std::string capabilities = window->ReportCapabilities();
  std::istringstream forRenderer(capabilities);
  std::istringstream forVersion(capabilities);
  return valueOf(forRenderer, "OpenGL renderer string") + ", version " +
    valueOf(forVersion, "OpenGL version string");
}

//------------------------------------------------------------------------------
std::string machineLine(vtkRenderWindow* window)
{
  const std::string renderer = openGlName(window);
  return processorModel() + ", " + std::to_string(std::thread::hardware_concurrency()) +
    " processors; OpenGL by " + (renderer.find("llvmpipe") == 0 ? "software (llvmpipe)" : renderer);
}

} // namespace gnomon::tool
