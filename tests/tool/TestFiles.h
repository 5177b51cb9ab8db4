#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace gnomon::tool
{

/// A folder of its own for one test, gone when the test ends.
class TestFolder
{
public:
  TestFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "gnomon-test-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
    {
      throw std::runtime_error("no folder for temporary files");
    }
    this->folder_ = pattern;
  }
  ~TestFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->folder_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string path() const { return this->folder_.string(); }
  std::string operator/(const std::string& name) const { return (this->folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

inline std::string readBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

inline void writeBytes(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The message of the exception of type Error that `work` throws; a hint when it throws none.
template <typename Error, typename Work>
std::string messageOf(const Work& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "(nothing was thrown)";
}

} // namespace gnomon::tool
