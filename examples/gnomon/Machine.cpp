#include "Machine.h"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace gnomon::tool
{
namespace
{

/// Return the text after the colon of the first line that begins with `key`.
std::string valueOf(std::istream&& text, const std::string& key)
{
  for (std::string line; std::getline(text, line);)
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      return line.substr(std::min(line.find_first_not_of(" \t", line.find(':') + 1), line.size()));
    }
  }
  return "unknown";
}

} // namespace

//------------------------------------------------------------------------------
std::int64_t residentBytes()
{
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  file >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

//------------------------------------------------------------------------------
std::string processorName()
{
  return valueOf(std::ifstream("/proc/cpuinfo"), "model name") + ", " +
    std::to_string(std::thread::hardware_concurrency()) + " threads";
}

//------------------------------------------------------------------------------
std::string openGlName(vtkRenderWindow* window)
{
  const std::string capabilities = window->ReportCapabilities();
  return valueOf(std::istringstream(capabilities), "OpenGL renderer string") + ", version " +
    valueOf(std::istringstream(capabilities), "OpenGL version string");
}

} // namespace gnomon::tool
