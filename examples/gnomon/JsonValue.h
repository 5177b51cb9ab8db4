#pragma once

#include "Errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
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
  /// Construct an empty place.
  JsonValue() = default;
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
  /// Refuse everything but an object.
  void requireObject() const { this->require(&nlohmann::json::is_object, "an object"); }
  /// Refuse an object with other keys.
  void requireKeys(const std::vector<std::string>& known) const;
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
  /// Return a text that is one of these.
  std::string choice(const std::vector<std::string>& names) const;
  template <std::size_t N>
  std::array<double, N> numbers(const NumberRange& range) const
  {
    std::array<double, N> result;
    this->readNumbers(result.data(), N, range);
    return result;
  }

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
  const nlohmann::json* value_ = nullptr; ///< null: the place is empty
};

/// The members of an object. One description of them reads and writes: each call takes a member's
/// value from the object, or puts it there.
class JsonMembers
{
public:
  /// Read. A member that is missing keeps its value.
  explicit JsonMembers(const JsonValue& from)
    : from_(from)
  {
    from.requireObject();
  }
  /// Write.
  explicit JsonMembers(nlohmann::ordered_json& to)
    : to_(&to)
  {
  }

  bool reads() const { return !this->to_; }
  /// Return a member's place to read; an empty one to write.
  JsonValue place(const std::string& name)
  {
    if (std::find(this->known_.begin(), this->known_.end(), name) == this->known_.end())
    {
      this->known_.push_back(name);
    }
    return this->from_.member(name);
  }

  /// Add a member.
  /// @param read returns the value of a place, or fails
  /// @param required true: the member must be there
  template <class Value, class Read>
  void add(const std::string& name, Value& value, const Read& read, bool required = false)
  {
    if (const JsonValue from = this->place(name); from.present() || (required && this->reads()))
    {
      value = std::invoke(read, from);
    }
    this->write(name, value);
  }
  /// Add an object, whose members `describe` adds. A missing one stays as it is.
  template <class Value, class Describe>
  void addObject(const std::string& name, Value& value, const Describe& describe)
  {
    const JsonValue from = this->place(name);
    if (from.present() || !this->reads())
    {
      JsonMembers members = this->reads() ? JsonMembers(from) : JsonMembers((*this->to_)[name]);
      describe(members, value);
      members.refuseOthers();
    }
  }

  /// Refuse members that no call has named.
  void refuseOthers() const
  {
    if (this->reads())
    {
      this->from_.requireKeys(this->known_);
    }
  }

  ///@{
  /// Write a member; nothing to read.
  template <class Value>
  void write(const std::string& name, const Value& value)
  {
    if (this->to_)
    {
      (*this->to_)[name] = value;
    }
  }
  template <class Value>
  void write(const std::string& name, const std::optional<Value>& value)
  {
    if (value)
    {
      this->write(name, *value);
    }
  }
  ///@}

private:
  const JsonValue from_;
  nlohmann::ordered_json* const to_ = nullptr;
  std::vector<std::string> known_;
};

///@{
/// Functions that read values of a kind.
inline auto numberIn(const NumberRange& range)
{
  return [=](const JsonValue& value) { return value.number(range); };
}
template <std::size_t N>
auto numbersIn(const NumberRange& range)
{
  return [=](const JsonValue& value) { return value.numbers<N>(range); };
}
inline auto integerIn(int low, int high)
{
  return [=](const JsonValue& value) { return value.integer(low, high); };
}
inline auto oneOf(const std::vector<std::string>& names)
{
  return [=](const JsonValue& value) { return value.choice(names); };
}
///@}

/// Read a JSON file. Syntax errors name line and column. Duplicate keys in an object, deep nesting,
/// and files of more than 16 MiB are refused.
/// @throws BadInput
nlohmann::json readJsonFile(const std::string& path);

/// Parse JSON text from `source`, by the rules of readJsonFile().
/// @throws BadInput
nlohmann::json parseJson(const std::string& text, const std::string& source);

} // namespace gnomon::tool
