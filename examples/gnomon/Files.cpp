#include "Files.h"

#include "Errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
std::size_t requireReadableFile(const std::string& path)
{
  if (path.find('\0') != std::string::npos)
  {
    throw BadInput(path.c_str() + std::string(": the path holds a zero byte"));
  }
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
  {
    throw BadInput(path + ": no such file");
  }
  if (error)
  {
    throw BadInput(path + ": cannot be read: " + error.message());
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw BadInput(path + ": not a file" +
      (std::filesystem::is_directory(status) ? " but a directory" : ", but a device or a pipe"));
  }
  const auto bytes = std::filesystem::file_size(path, error);
  if (error || !std::ifstream(path, std::ios::binary))
  {
    throw BadInput(path + ": cannot be read: " + std::strerror(errno));
  }
  if (bytes == 0)
  {
    throw BadInput(path + ": the file is empty");
  }
  return static_cast<std::size_t>(bytes);
}

//------------------------------------------------------------------------------
std::string readWholeFile(const std::string& path, std::size_t largestBytes)
{
  const std::size_t bytes = requireReadableFile(path);
  if (bytes > largestBytes)
  {
    throw BadInput(path + ": the file has " + std::to_string(bytes) + " bytes, expected at most " +
      std::to_string(largestBytes));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(bytes, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(bytes)))
  {
    throw BadInput(path + ": cannot be read to its end");
  }
  return text;
}

//------------------------------------------------------------------------------
void requireWritableFile(
  const std::string& path, const std::string& option, const std::vector<std::string>& extensions)
{
  const std::string extension = lowerExtension(path);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
  {
    std::string list;
    for (const std::string& known : extensions)
    {
      list += (list.empty() ? "" : " or ") + known;
    }
    throw BadInput(option + ": " + path + ": the file type is \"" + extension +
      "\", expected a name that ends in " + list);
  }

  // Only opening the file reveals permissions, a name that is too long, or a read-only file system.
  int handle = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool created = handle >= 0;
  if (!created && errno == EEXIST)
  {
    handle = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
  }
  if (handle < 0)
  {
    throw BadInput(option + ": " + path + ": cannot be written: " + std::strerror(errno));
  }
  ::close(handle);
  if (created)
  {
    ::unlink(path.c_str());
  }
}

//------------------------------------------------------------------------------
void writeText(const std::string& path, const std::string& text)
{
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file)
  {
    throw Failure(path + ": writing failed: " + std::strerror(errno));
  }
}

//------------------------------------------------------------------------------
std::string lowerExtension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace gnomon::tool
