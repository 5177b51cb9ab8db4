#pragma once

#include "Errors.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A range of valid numbers.
struct NumberRange
{
  double low;
  double high;
};

/// The range of coordinates and matrix elements: far beyond any real scene, far below float's
/// maximum.
inline constexpr NumberRange anyCoordinate{ -1e30, 1e30 };
inline constexpr NumberRange colorChannel{ 0.0, 1.0 };

/// A place in a JSON document. It has a source and a key path ("lights[1].cone_angle"), so every
/// error names both, the value found and the value expected. The place may be empty; reading it is
/// then an error. All readers throw BadInput.
class JsonValue
{
public:
  /// Construct the root of a document from `source` (a file, or a command line option). The
  /// document must outlive this value and all values derived from it.
  JsonValue(std::string source, const nlohmann::json& document)
    : JsonValue(std::move(source), std::string(), &document)
  {
  }

  bool present() const { return this->value_ != nullptr; }
  const std::string& source() const { return this->source_; }

  /// Return the place of a key in an object; empty if the object lacks the key.
  JsonValue member(const std::string& key) const;
  /// Refuse everything but an object whose keys are all known.
  void requireObject(const std::vector<std::string>& known) const;
  /// Return the elements of an array.
  std::vector<JsonValue> elements() const;
  /// Return the elements of an array; none for an empty place.
  std::vector<JsonValue> elementsOrNone() const
  {
    return this->present() ? this->elements() : std::vector<JsonValue>();
  }
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
  /// Return the value, or the fallback for an empty place.
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

  /// Throw "SOURCE: PATH: found THIS, expected ...".
  [[noreturn]] void fail(const std::string& expected) const;
  /// Throw "SOURCE: PATH: MESSAGE".
  [[noreturn]] void refuse(const std::string& message) const;

  /// Call a function, and refuse what it refuses, at this place.
  template <class Work>
  void refuseOnError(const Work& work) const
  {
    try
    {
      work();
    }
    catch (const BadInput& error)
    {
      this->refuse(error.what());
    }
  }

private:
  JsonValue(std::string source, std::string path, const nlohmann::json* value);
  /// Return the value if it is of a kind.
  const nlohmann::json& require(
    bool (nlohmann::json::*is)() const noexcept, const char* expected) const;
  void readNumbers(double* result, std::size_t count, const NumberRange& range) const;

  std::string source_;
  std::string path_;
  const nlohmann::json* value_; ///< null: the place is empty
};

/// Read a JSON file. Syntax errors name line and column. Duplicate keys in an object, deep nesting,
/// and files of more than 16 MiB are refused.
/// @throws BadInput
nlohmann::json readJsonFile(const std::string& path);

/// Parse JSON text from `source`, by the rules of readJsonFile().
/// @throws BadInput
nlohmann::json parseJson(const std::string& text, const std::string& source);

} // namespace gnomon::tool
