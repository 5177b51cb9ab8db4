#include "ModelChecks.h"

#include "Errors.h"
#include "Files.h"
#include "Text.h"

#include <cmath>

namespace gnomon::tool
{

namespace
{

/// A line of the file, joined with its continuations.
struct Line
{
  std::size_t number = 0;
  std::vector<std::string> words;
};

class ObjChecker
{
public:
  explicit ObjChecker(const std::string& path)
    : path_(path)
  {
  }

  void check(const Line& line)
  {
    if (line.words.empty())
    {
      return;
    }
    const std::string& keyword = line.words[0];
    if (keyword == "v")
    {
      this->checkNumbers(line, 3);
      ++this->points_;
    }
    else if (keyword == "vt")
    {
      this->checkNumbers(line, 2);
      ++this->textureCoordinates_;
    }
    else if (keyword == "vn")
    {
      this->checkNumbers(line, 3);
      ++this->normals_;
    }
    else if (keyword == "f")
    {
      this->checkFace(line);
    }
    else if (keyword == "p" || keyword == "l")
    {
      for (std::size_t i = 1; i < line.words.size(); ++i)
      {
        this->checkIndices(line, line.words[i]);
      }
    }
    else if (keyword == "usemtl")
    {
      // vtkOBJReader has 100 bytes for the name.
      constexpr std::size_t longestName = 99;
      if (line.words.size() < 2 || line.words[1].size() > longestName)
      {
        this->fail(line.number, "expected a material's name of at most 99 characters");
      }
    }
  }

  void finish() const
  {
    this->require(this->highestPoint_, this->points_, "vertices");
    this->require(this->highestTextureCoordinate_, this->textureCoordinates_, "vt lines");
    this->require(this->highestNormal_, this->normals_, "vn lines");
    if (this->points_ == 0)
    {
      throw BadInput(this->path_ + ": no vertices, expected lines of the form v x y z");
    }
    if (this->faces_ == 0)
    {
      throw BadInput(this->path_ + ": no faces, expected lines of the form f 1 2 3");
    }
  }

private:
  /// The highest index that a face names, and where.
  struct Highest
  {
    long index = 0;
    std::size_t line = 0;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& message) const
  {
    throw BadInput(this->path_ + ": line " + std::to_string(line) + ": " + message);
  }

  void checkNumbers(const Line& line, std::size_t count) const
  {
    for (std::size_t i = 1; i <= count; ++i)
    {
      const bool there = i < line.words.size();
      const std::optional<float> value =
        there ? parseNumber<float>(line.words[i]) : std::optional<float>();
      if (!value || !std::isfinite(*value))
      {
        this->fail(line.number,
          "found " + (there ? quoted(line.words[i]) : std::string("the line's end")) +
            ", expected " + line.words[0] + " and " + std::to_string(count) + " finite numbers");
      }
    }
  }

  void checkFace(const Line& line)
  {
    if (line.words.size() < 4)
    {
      this->fail(line.number,
        "found a face with " + std::to_string(line.words.size() - 1) +
          " corners, expected at least 3");
    }
    ++this->faces_;
    for (std::size_t i = 1; i < line.words.size(); ++i)
    {
      this->checkIndices(line, line.words[i]);
    }
  }

  /// One corner: 7, 7/2, 7//3 or 7/2/3.
  void checkIndices(const Line& line, const std::string& corner)
  {
    const std::vector<std::string> parts = split(corner, '/');
    bool good = parts.size() <= 3;
    for (std::size_t i = 0; good && i < parts.size(); ++i)
    {
      if (i == 1 && parts.size() == 3 && parts[i].empty())
      {
        continue;
      }
      long& count = i == 0 ? this->points_ : i == 1 ? this->textureCoordinates_ : this->normals_;
      Highest& highest = i == 0 ? this->highestPoint_
        : i == 1                ? this->highestTextureCoordinate_
                                : this->highestNormal_;
      const std::optional<int> index = parseNumber<int>(parts[i]);
      good = index && *index != 0 && *index >= -count;
      if (good && *index > highest.index)
      {
        highest = { *index, line.number };
      }
    }
    if (!good)
    {
      this->fail(line.number,
        "found " + quoted(corner) +
          ", expected a corner like 7, 7/2, 7//3 or 7/2/3 whose numbers count from 1, or back from "
          "-1");
    }
  }

  void require(const Highest& highest, long count, const std::string& what) const
  {
    if (highest.index > count)
    {
      this->fail(highest.line,
        "found index " + std::to_string(highest.index) + ", but the file has " +
          std::to_string(count) + " " + what + "; it may be truncated");
    }
  }

  const std::string& path_;
  long points_ = 0;
  long textureCoordinates_ = 0;
  long normals_ = 0;
  long faces_ = 0;
  Highest highestPoint_;
  Highest highestTextureCoordinate_;
  Highest highestNormal_;
};

} // namespace

//------------------------------------------------------------------------------
void checkObjFile(const std::string& path)
{
  const std::string text = readWholeFile(path, largestModelBytes);
  ObjChecker checker(path);
  Line line;
  bool continued = false;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    ++number;
    std::vector<std::string> words = splitWords(text.substr(begin, end - begin));
    begin = end + 1;
    if (!continued)
    {
      line = { number, {} };
    }
    continued = !words.empty() && words.back() == "\\";
    if (continued)
    {
      words.pop_back();
    }
    line.words.insert(line.words.end(), words.begin(), words.end());
    if (!continued)
    {
      checker.check(line);
    }
  }
  if (continued)
  {
    checker.check(line);
  }
  checker.finish();
}

} // namespace gnomon::tool
