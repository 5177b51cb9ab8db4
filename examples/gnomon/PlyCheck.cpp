#include "ModelChecks.h"

#include "ByteReader.h"
#include "Files.h"
#include "Text.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace gnomon::tool
{

namespace
{

/// The longest line that vtkPLYReader reads, less room for its additions.
constexpr std::size_t longestLine = 4000;
/// vtkPLYReader counts a face's corners in a byte.
constexpr long mostCorners = 255;

struct Property
{
  std::string name;
  std::string type;
  std::string countType; ///< empty unless the property is a list
  bool isList() const { return !this->countType.empty(); }
};

struct Element
{
  std::string name;
  long count = 0;
  std::vector<Property> properties;

  bool has(const std::string& property) const
  {
    return std::any_of(this->properties.begin(), this->properties.end(),
      [&](const Property& candidate) { return candidate.name == property; });
  }
};

enum class Encoding
{
  Ascii,
  LittleEndian,
  BigEndian
};

template <class Number>
double readAs(ByteReader& reader, const char* what)
{
  return static_cast<double>(reader.read<Number>(what));
}

/// The reading function of each type.
const std::map<std::string, double (*)(ByteReader& reader, const char* what)> readersByType = {
  { "char", readAs<std::int8_t> }, { "int8", readAs<std::int8_t> },
  { "uchar", readAs<std::uint8_t> }, { "uint8", readAs<std::uint8_t> },
  { "short", readAs<std::int16_t> }, { "int16", readAs<std::int16_t> },
  { "ushort", readAs<std::uint16_t> }, { "uint16", readAs<std::uint16_t> },
  { "int", readAs<std::int32_t> }, { "int32", readAs<std::int32_t> },
  { "uint", readAs<std::uint32_t> }, { "uint32", readAs<std::uint32_t> },
  { "float", readAs<float> }, { "float32", readAs<float> }, { "double", readAs<double> },
  { "float64", readAs<double> }
};

bool isType(const std::string& name)
{
  return readersByType.count(name) > 0;
}

bool isCornerList(const std::string& property)
{
  return property == "vertex_indices" || property == "vertex_index";
}

class PlyChecker
{
public:
  PlyChecker(const std::string& path, const std::string& text)
    : path_(path)
    , text_(text)
  {
  }

  void check()
  {
    this->readHeader();
    this->checkElements();
    if (this->encoding_ == Encoding::Ascii)
    {
      this->checkAsciiBody();
    }
    else
    {
      this->checkBinaryBody();
    }
  }

private:
  [[noreturn]] void fail(const std::string& message) const
  {
    throw BadInput(this->path_ + ": " + message);
  }

  [[noreturn]] void failAtLine(const std::string& message) const
  {
    this->fail("line " + std::to_string(this->line_) + ": " + message);
  }

  /// Return the next line's words. vtkPLYReader does not read a line without line end.
  std::vector<std::string> nextLine(const std::string& expected)
  {
    ++this->line_;
    const std::size_t end = this->text_.find('\n', this->position_);
    if (end == std::string::npos)
    {
      this->failAtLine(
        "the file ends here, expected " + expected + " and a line end; it may be truncated");
    }
    if (end - this->position_ > longestLine)
    {
      this->failAtLine("found a line of " + std::to_string(end - this->position_) +
        " characters, expected at most " + std::to_string(longestLine));
    }
    const std::string line = this->text_.substr(this->position_, end - this->position_);
    this->position_ = end + 1;
    return splitWords(line);
  }

  void readHeader()
  {
    if (this->text_.compare(0, 3, "ply") != 0 || this->nextLine("ply").size() != 1)
    {
      this->fail("not a PLY file, expected \"ply\" in its first line");
    }
    bool formatSeen = false;
    for (;;)
    {
      const std::vector<std::string> words = this->nextLine("end_header");
      // vtkPLYReader ends the header at an empty line.
      const std::string keyword = words.empty() ? "" : words[0];
      if (keyword == "end_header")
      {
        break;
      }
      if (keyword == "format")
      {
        this->readFormat(words);
        formatSeen = true;
      }
      else if (keyword == "element")
      {
        this->readElement(words);
      }
      else if (keyword == "property")
      {
        this->readProperty(words);
      }
      else if (keyword != "comment" && keyword != "obj_info")
      {
        this->failAtLine("found " + quoted(keyword) +
          ", expected format, element, property, comment or end_header");
      }
    }
    if (!formatSeen)
    {
      this->fail("no format line, expected for example \"format ascii 1.0\"");
    }
  }

  void readFormat(const std::vector<std::string>& words)
  {
    static const std::map<std::string, Encoding> encodings = { { "ascii", Encoding::Ascii },
      { "binary_little_endian", Encoding::LittleEndian },
      { "binary_big_endian", Encoding::BigEndian } };
    const std::string name = words.size() == 3 ? words[1] : "";
    const auto found = encodings.find(name);
    if (found == encodings.end())
    {
      this->failAtLine("found " + quoted(name) +
        ", expected format ascii, binary_little_endian or binary_big_endian, and 1.0");
    }
    this->encoding_ = found->second;
  }

  void readElement(const std::vector<std::string>& words)
  {
    const std::optional<int> count =
      words.size() == 3 ? parseNumber<int>(words[2]) : std::optional<int>();
    if (!count || *count < 0)
    {
      this->failAtLine("expected element, a name and a count from 0 to 2147483647");
    }
    this->elements_.push_back({ words[1], *count, {} });
  }

  void readProperty(const std::vector<std::string>& words)
  {
    const bool list =
      words.size() == 5 && words[1] == "list" && isType(words[2]) && isType(words[3]);
    const bool scalar = words.size() == 3 && isType(words[1]);
    if (this->elements_.empty() || !(list || scalar))
    {
      this->failAtLine(
        "expected, after an element: property TYPE NAME, or property list COUNT-TYPE "
        "TYPE NAME");
    }
    this->elements_.back().properties.push_back(
      list ? Property{ words[4], words[3], words[2] } : Property{ words[2], words[1], "" });
  }

  /// Check the elements. vtkPLYReader reads vertices, then faces, regardless of other elements in
  /// between.
  void checkElements() const
  {
    if (this->elements_.size() < 2 || this->elements_[0].name != "vertex" ||
      this->elements_[1].name != "face")
    {
      this->fail("expected the elements vertex and face first, in this order");
    }
    const Element& vertex = this->elements_[0];
    const Element& face = this->elements_[1];
    for (const char* axis : { "x", "y", "z" })
    {
      if (!vertex.has(axis))
      {
        this->fail("element vertex has no property " + std::string(axis));
      }
    }
    if (!face.has("vertex_indices") && !face.has("vertex_index"))
    {
      this->fail("element face has no property vertex_indices");
    }
    if (vertex.count == 0 || face.count == 0)
    {
      this->fail("found " + std::to_string(vertex.count) + " vertices and " +
        std::to_string(face.count) + " faces, expected at least one of each");
    }
    for (const Property& property : vertex.properties)
    {
      if (property.isList())
      {
        this->fail("property " + property.name + " of element vertex is a list, expected a number");
      }
    }
    for (const Property& property : face.properties)
    {
      if (property.isList() != (isCornerList(property.name) || property.name == "texcoord"))
      {
        this->fail("property " + property.name + " of element face: expected " +
          (property.isList() ? "a number" : "a list"));
      }
    }
  }

  void checkCorner(double index) const
  {
    const double count = static_cast<double>(this->elements_[0].count);
    if (!(index >= 0.0 && index < count))
    {
      this->fail("found a face with vertex number " + std::to_string(static_cast<long>(index)) +
        ", expected 0 to " + std::to_string(this->elements_[0].count - 1));
    }
  }

  void checkCount(const Property& property, double count) const
  {
    const double least = isCornerList(property.name) ? 3.0 : 0.0;
    if (!(count >= least && count <= mostCorners))
    {
      this->fail("found a face with " + std::to_string(static_cast<long>(count)) + " values of " +
        property.name + ", expected " + std::to_string(static_cast<long>(least)) + " to " +
        std::to_string(mostCorners));
    }
  }

  void checkAsciiBody()
  {
    for (std::size_t e = 0; e < 2; ++e)
    {
      const Element& element = this->elements_[e];
      for (long i = 0; i < element.count; ++i)
      {
        const std::string what = element.name + " " + std::to_string(i);
        const std::vector<std::string> words = this->nextLine(what);
        std::size_t word = 0;
        const auto next = [&]
        {
          const std::optional<double> number = parseWord<double>(words, word);
          if (!number)
          {
            this->failAtLine("found " + quotedWord(words, word) + ", expected a number of " + what);
          }
          ++word;
          return *number;
        };
        this->checkProperties(element, [&](const std::string&) { return next(); });
      }
    }
  }

  void checkBinaryBody()
  {
    ByteReader reader(this->path_, this->text_, this->encoding_ == Encoding::BigEndian);
    reader.seek(this->position_);
    for (std::size_t e = 0; e < 2; ++e)
    {
      const Element& element = this->elements_[e];
      for (long i = 0; i < element.count; ++i)
      {
        this->checkProperties(element,
          [&](const std::string& type)
          { return readersByType.at(type)(reader, element.name.c_str()); });
      }
    }
  }

  /// Read one element.
  /// @param next returns the next value of a type
  template <class Next>
  void checkProperties(const Element& element, const Next& next) const
  {
    for (const Property& property : element.properties)
    {
      if (!property.isList())
      {
        next(property.type);
        continue;
      }
      const double count = next(property.countType);
      this->checkCount(property, count);
      for (long k = 0; k < static_cast<long>(count); ++k)
      {
        const double value = next(property.type);
        if (isCornerList(property.name))
        {
          this->checkCorner(value);
        }
      }
    }
  }

  const std::string& path_;
  const std::string& text_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  Encoding encoding_ = Encoding::Ascii;
  std::vector<Element> elements_;
};

} // namespace

//------------------------------------------------------------------------------
void checkPlyFile(const std::string& path)
{
  const std::string text = readWholeFile(path, largestModelBytes);
  PlyChecker(path, text).check();
}

} // namespace gnomon::tool
