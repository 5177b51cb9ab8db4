#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// The numbers that a place in a document accepts.
struct NumberRange
{
  double low;
  double high;
};

/// No coordinate or matrix element is larger; far beyond any real scene, far below the end of
/// float.
inline constexpr NumberRange anyCoordinate{ -1e12, 1e12 };
inline constexpr NumberRange colorChannel{ 0.0, 1.0 };

/// A place in a JSON document: it knows its source and its key path ("lights[1].cone_angle"), so
/// that every error names them, says what stands there and what was expected. The place may be
/// empty; reading it is then an error, too. All readers throw BadInput.
class JsonValue
{
public:
  /// The root of a document that came from `source` (a file, or an option of the command line). The
  /// document must outlive the value and all values taken from it.
  JsonValue(std::string source, const nlohmann::json& document);

  bool present() const { return this->value_ != nullptr; }
  const std::string& source() const { return this->source_; }

  /// The place of that key in an object; empty where the object lacks it.
  JsonValue member(const std::string& key) const;
  /// The keys of an object.
  std::vector<std::string> keys() const;
  /// Refuses everything but an object with no other keys than these.
  void requireObject(const std::vector<std::string>& known) const;
  /// The number of elements of an array, and the elements.
  std::size_t size() const;
  std::vector<JsonValue> elements() const;

  /// The elements of an array; none where the place is empty.
  std::vector<JsonValue> elementsOrNone() const;
  double number(const NumberRange& range) const;
  int integer(int low, int high) const;
  bool boolean() const;
  std::string text() const;
  template <std::size_t N>
  std::array<double, N> numbers(const NumberRange& range) const
  {
    std::array<double, N> result;
    this->readNumbers(result.data(), N, range);
    return result;
  }

  ///@{
  /// The same, or what is given where the place is empty.
  double numberOr(double fallback, const NumberRange& range) const
  {
    return this->present() ? this->number(range) : fallback;
  }
  bool booleanOr(bool fallback) const { return this->present() ? this->boolean() : fallback; }
  template <std::size_t N>
  std::array<double, N> numbersOr(
    const std::array<double, N>& fallback, const NumberRange& range) const
  {
    return this->present() ? this->numbers<N>(range) : fallback;
  }
  ///@}

  /// Ends with "SOURCE: PATH: found THIS, expected ...".
  [[noreturn]] void fail(const std::string& expected) const;
  /// Ends with "SOURCE: PATH: MESSAGE".
  [[noreturn]] void refuse(const std::string& message) const;

private:
  JsonValue(std::string source, std::string path, const nlohmann::json* value);
  void readNumbers(double* result, std::size_t count, const NumberRange& range) const;

  std::string source_;
  std::string path_;
  const nlohmann::json* value_; ///< null: nothing stands here
};

/// Reads a JSON file. Syntax errors name line and column; keys that stand twice in one object, deep
/// nesting and files of more than 16 MiB are refused.
/// @throws BadInput
nlohmann::json readJsonFile(const std::string& path);

/// Reads JSON text that came from `source`, with the same rules.
/// @throws BadInput
nlohmann::json parseJson(const std::string& text, const std::string& source);

} // namespace gnomon::tool
