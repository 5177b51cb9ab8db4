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
#include <random>
#include <regex>
#include <system_error>

namespace gnomon::tool
{

namespace fs = std::filesystem;

std::size_t requireReadableFile(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const std::uintmax_t bytes = fs::file_size(path, error);
  using Type = fs::file_type;
  std::string fault = path.find('\0') != std::string::npos ? "the path holds a zero byte"
    : status.type() == Type::not_found                     ? "no such file"
    : status.type() == Type::directory                     ? "not a file but a directory"
    : status.type() != Type::regular && status.type() != Type::none
    ? "not a file, but a device or a pipe"
    : "";
  if (fault.empty() && (error || !std::ifstream(path, std::ios::binary)))
  {
    fault = std::string("cannot be read: ") + std::strerror(errno);
  }
  if (fault.empty() && bytes == 0)
  {
    fault = "the file is empty";
  }
  if (!fault.empty())
  {
    throw BadInput(path.c_str() + (": " + fault));
  }
  return static_cast<std::size_t>(bytes);
}

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
  // An existing file is replaced by one beside it.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (handle < 0 ||
    (!created && std::filesystem::is_regular_file(path) &&
      ::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0))
  {
    throw BadInput(option + ": " + path + ": cannot be written: " + std::strerror(errno));
  }
  ::close(handle);
  if (created)
  {
    ::unlink(path.c_str());
  }
}

void writeWholeFile(const std::string& path, const std::string& bytes)
{
  std::error_code ignored;
  const fs::file_status old = fs::status(path, ignored);
  const bool isDevice = fs::exists(old) && !fs::is_regular_file(old); // or a pipe
  // Renaming onto a link would replace the link.
  const fs::path target = fs::is_regular_file(old) ? fs::canonical(path, ignored) : fs::path(path);
  fs::path part = target;
  if (!isDevice)
  {
    part.replace_filename(".gnomon-" + std::to_string(std::random_device()()));
  }
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  int reason = file ? 0 : errno;
  if (fs::is_regular_file(old))
  {
    fs::permissions(part, old.permissions(), ignored);
  }
  if (!isDevice && reason == 0 && ::rename(part.c_str(), target.c_str()) != 0)
  {
    reason = errno;
  }
  if (!file || reason != 0)
  {
    if (!isDevice)
    {
      ::unlink(part.c_str());
    }
    throw Failure(path + ": writing failed: " + std::strerror(reason));
  }
}

std::string fileStem(const std::string& name)
{
  return std::regex_replace(name, std::regex("[^A-Za-z0-9_-]"), "-");
}

std::string lowerExtension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace gnomon::tool
