#include "ModelChecks.h"

#include "Errors.h"
#include "Files.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::tool
{

namespace
{

/// A line of the file, joined with its continuation lines.
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
    const auto list = std::find_if(this->lists_.begin(), this->lists_.end(),
      [&](const List& candidate) { return candidate.keyword == keyword; });
    if (list != this->lists_.end())
    {
      this->checkNumbers(line, list->numbers);
      ++list->count;
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
    for (const List& list : this->lists_)
    {
      if (list.highest > list.count)
      {
        this->fail(list.lineOfHighest,
          "found index " + std::to_string(list.highest) + ", but the file has " +
            std::to_string(list.count) + " " + list.name + "; it may be truncated");
      }
    }
    if (this->lists_[0].count == 0)
    {
      throw BadInput(this->path_ + ": no vertices, expected lines of the form v x y z");
    }
    if (this->faces_ == 0)
    {
      throw BadInput(this->path_ + ": no faces, expected lines of the form f 1 2 3");
    }
  }

private:
  /// Lines of one keyword, which faces' corners refer to by number.
  struct List
  {
    const char* keyword;
    std::size_t numbers; ///< in a line
    const char* name;
    long count = 0;
    long highest = 0; ///< highest index of a face
    std::size_t lineOfHighest = 0;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& message) const
  {
    throw BadInput(this->path_ + ": line " + std::to_string(line) + ": " + message);
  }

  void checkNumbers(const Line& line, std::size_t count) const
  {
    for (std::size_t i = 1; i <= count; ++i)
    {
      const std::optional<float> value = parseWord<float>(line.words, i);
      if (!value || !std::isfinite(*value))
      {
        this->fail(line.number,
          "found " + quotedWord(line.words, i) + ", expected " + line.words[0] + " and " +
            std::to_string(count) + " finite numbers");
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

  /// Check a corner: 7, 7/2, 7//3 or 7/2/3.
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
      List& list = this->lists_[i];
      const std::optional<int> index = parseNumber<int>(parts[i]);
      good = index && *index != 0 && *index >= -list.count;
      if (good && *index > list.highest)
      {
        list.highest = *index;
        list.lineOfHighest = line.number;
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

  const std::string& path_;
  /// The lists, in the order of a corner's indices.
  std::array<List, 3> lists_ = { { { "v", 3, "vertices" }, { "vt", 2, "vt lines" },
    { "vn", 3, "vn lines" } } };
  long faces_ = 0;
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
