#pragma once

#include "Errors.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace gnomon::tool
{

/// Reads a binary file's bytes in order, and throws at their end.
class ByteReader
{
public:
  /// Construct a reader of bytes, which must outlive it.
  ByteReader(const std::string& path, const std::string& bytes, bool bigEndian = false)
    : path_(path)
    , bytes_(bytes)
    , bigEndian_(bigEndian)
  {
  }

  std::size_t position() const { return this->position_; }
  std::size_t size() const { return this->bytes_.size(); }
  void seek(std::size_t position) { this->position_ = position; }

  /// Read the next value. `what` names it in the error of a file that ends here.
  template <class T>
  T read(const char* what)
  {
    char raw[sizeof(T)];
    std::memcpy(raw, this->take(sizeof(T), what), sizeof(T));
    if (this->bigEndian_)
    {
      std::reverse(raw, raw + sizeof(T));
    }
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  void skip(std::size_t bytes, const char* what) { this->take(bytes, what); }

  /// Read text up to and including a zero byte.
  std::string readName(std::size_t longest, const std::string& what)
  {
    const std::size_t end = this->bytes_.find('\0', this->position_);
    if (end == std::string::npos || end - this->position_ > longest)
    {
      this->fail("found no end of the name of " + what + ", expected one after at most " +
        std::to_string(longest) + " characters");
    }
    std::string name = this->bytes_.substr(this->position_, end - this->position_);
    this->position_ = end + 1;
    return name;
  }

  [[noreturn]] void fail(const std::string& message) const
  {
    throw BadInput(this->path_ + ": at byte " + std::to_string(this->position_) + ": " + message);
  }

private:
  const char* take(std::size_t bytes, const char* what)
  {
    if (this->position_ > this->bytes_.size() || bytes > this->bytes_.size() - this->position_)
    {
      this->fail(std::string("the file ends, expected ") + what + " (" + std::to_string(bytes) +
        " bytes); it is truncated or damaged");
    }
    const char* begin = this->bytes_.data() + this->position_;
    this->position_ += bytes;
    return begin;
  }

  std::string path_;
  const std::string& bytes_;
  bool bigEndian_;
  std::size_t position_ = 0;
};

} // namespace gnomon::tool
