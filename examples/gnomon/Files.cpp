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

//------------------------------------------------------------------------------
void writeWholeFile(const std::string& path, const std::string& bytes)
{
  namespace fs = std::filesystem;
  const auto fail = [&path](int reason)
  { throw Failure(path + ": writing failed: " + std::strerror(reason)); };

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
  const int flags = isDevice ? 0 : O_CREAT | O_EXCL;
  const int handle = ::open(part.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (handle < 0)
  {
    fail(errno);
  }
  if (fs::is_regular_file(old))
  {
    fs::permissions(part, old.permissions(), ignored);
  }
  int reason = 0;
  for (std::size_t written = 0; written < bytes.size() && reason == 0;)
  {
    const ssize_t count = ::write(handle, bytes.data() + written, bytes.size() - written);
    written += count > 0 ? static_cast<std::size_t>(count) : 0;
    reason = count < 0 && errno != EINTR ? errno : 0;
  }
  if (::close(handle) != 0 && reason == 0)
  {
    reason = errno;
  }
  if (!isDevice && reason == 0 && ::rename(part.c_str(), target.c_str()) != 0)
  {
    reason = errno;
  }
  if (reason != 0)
  {
    if (!isDevice)
    {
      ::unlink(part.c_str());
    }
    fail(reason);
  }
}

//------------------------------------------------------------------------------
std::string fileStem(const std::string& name)
{
  constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  std::string stem = name;
  for (std::size_t other = stem.find_first_not_of(plain); other != std::string::npos;
       other = stem.find_first_not_of(plain, other))
  {
    stem[other] = '-';
  }
  return stem;
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
