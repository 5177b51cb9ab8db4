#include "shadowtech/base/System.h"

#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

namespace gnomon
{

double availableBytes()
{
  std::ifstream file("/proc/meminfo");
  std::string name;
  for (double kilobytes = 0.0; file >> name >> kilobytes; std::getline(file, name))
  {
    if (name == "MemAvailable:")
    {
      return 1024.0 * kilobytes;
    }
  }
  return std::numeric_limits<double>::infinity();
}

std::array<char, 512> nameOfMachine()
{
  std::array<char, 512> name{};
  gethostname(name.data(), name.size() / 2 - 1);
  std::string start;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> start;
  start.copy(name.data() + name.size() / 2, name.size() / 2 - 1);
  return name;
}

long processNumber()
{
  return getpid();
}

} // namespace gnomon
