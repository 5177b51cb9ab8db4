#pragma once

#include "Errors.h"
#include "Files.h"

#include "lights/SettingsTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tool
{

struct NumberRange
{
  double low;
  double high;
};

/// The range of coordinates and matrix elements: far beyond any real scene, far below float's
/// maximum.
inline constexpr NumberRange anyCoordinate{ -1e30, 1e30 };
inline constexpr NumberRange colorChannel{ 0.0, 1.0 };

inline constexpr std::size_t largestJsonFileBytes = 16 * 1024 * 1024;

inline constexpr int deepestNesting = 32;

inline std::string formatNumber(double value)
{
  std::ostringstream stream;
  stream.precision(12);
  stream << value;
  return stream.str();
}

/// Return a value for an error message: short, and on one line.
inline std::string describe(const nlohmann::json& value)
{
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
  {
    return formatNumber(value.get<double>());
  }
  if (value.is_structured() && value.size() > 16)
  {
    return (value.is_array() ? "an array of " : "an object of ") + std::to_string(value.size()) +
      (value.is_array() ? " elements" : " keys");
  }
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.size() > 60 ? text.substr(0, 60) + "..." : text;
}

inline std::string describe(const NumberRange& range)
{
  return "between " + formatNumber(range.low) + " and " + formatNumber(range.high);
}

inline bool contains(const NumberRange& range, const nlohmann::json& value)
{
  // NaN is outside every range.
  return value.is_number() && value.get<double>() >= range.low && value.get<double>() <= range.high;
}

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
  JsonValue member(const std::string& key) const
  {
    const std::string path = this->path_.empty() ? key : this->path_ + "." + key;
    const nlohmann::json* found = nullptr;
    if (this->value_ && this->value_->is_object())
    {
      const auto place = this->value_->find(key);
      found = place == this->value_->end() ? nullptr : &*place;
    }
    return JsonValue(this->source_, path, found);
  }

  /// Refuse everything but an object.
  void requireObject() const { this->require(&nlohmann::json::is_object, "an object"); }
  /// Refuse an object with other keys.
  void requireKeys(const std::vector<std::string>& known) const
  {
    for (const auto& item : this->value_->items())
    {
      if (std::find(known.begin(), known.end(), item.key()) == known.end())
      {
        this->refuse("unknown key " + describe(item.key()) + ", expected one of: " + listOf(known));
      }
    }
  }

  std::vector<JsonValue> elements() const
  {
    const nlohmann::json& array = this->require(&nlohmann::json::is_array, "an array");
    std::vector<JsonValue> result;
    for (std::size_t i = 0; i < array.size(); ++i)
    {
      result.push_back(
        JsonValue(this->source_, this->path_ + "[" + std::to_string(i) + "]", &array[i]));
    }
    return result;
  }

  /// Return the elements of an array; none for an empty place.
  std::vector<JsonValue> elementsOrNone() const
  {
    return this->present() ? this->elements() : std::vector<JsonValue>();
  }
  double number(const NumberRange& range) const
  {
    if (!this->value_ || !contains(range, *this->value_))
    {
      this->fail("a number " + describe(range));
    }
    return this->value_->get<double>();
  }

  int integer(int low, int high) const
  {
    const NumberRange range{ static_cast<double>(low), static_cast<double>(high) };
    if (!this->value_ || !this->value_->is_number_integer() || !contains(range, *this->value_))
    {
      this->fail("a whole number " + describe(range));
    }
    return this->value_->get<int>();
  }

  bool boolean() const
  {
    return this->require(&nlohmann::json::is_boolean, "true or false").get<bool>();
  }

  std::string text() const
  {
    const auto text = this->require(&nlohmann::json::is_string, "a text").get<std::string>();
    if (text.empty())
    {
      this->fail("a text");
    }
    return text;
  }

  /// Return a text that is one of these.
  std::string choice(const std::vector<std::string>& names) const
  {
    const std::string text = this->text();
    if (std::find(names.begin(), names.end(), text) == names.end())
    {
      this->fail("one of: " + listOf(names));
    }
    return text;
  }

  template <std::size_t N>
  std::array<double, N> numbers(const NumberRange& range) const
  {
    std::array<double, N> result;
    this->readNumbers(result.data(), N, range);
    return result;
  }

  /// Throw "SOURCE: PATH: found THIS, expected ...".
  [[noreturn]] void fail(const std::string& expected) const
  {
    this->refuse((this->value_ ? "found " + describe(*this->value_) : std::string("missing")) +
      ", expected " + expected);
  }

  /// Throw "SOURCE: PATH: MESSAGE".
  [[noreturn]] void refuse(const std::string& message) const
  {
    throw BadInput(
      this->source_ + ": " + (this->path_.empty() ? "" : this->path_ + ": ") + message);
  }

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
  JsonValue(std::string source, std::string path, const nlohmann::json* value)
    : source_(std::move(source))
    , path_(std::move(path))
    , value_(value)
  {
  }

  /// Return the value if it is of a kind.
  const nlohmann::json& require(
    bool (nlohmann::json::*is)() const noexcept, const char* expected) const
  {
    if (!this->value_ || !(this->value_->*is)())
    {
      this->fail(expected);
    }
    return *this->value_;
  }

  void readNumbers(double* result, std::size_t count, const NumberRange& range) const
  {
    const bool isArray = this->value_ && this->value_->is_array() && this->value_->size() == count;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!isArray || !contains(range, (*this->value_)[i]))
      {
        this->fail("an array of " + std::to_string(count) + " numbers " + describe(range));
      }
      result[i] = (*this->value_)[i].get<double>();
    }
  }

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

/// Parse JSON text from `source`, by the rules of readJsonFile().
/// @throws BadInput
inline nlohmann::json parseJson(const std::string& text, const std::string& source)
{
  // nlohmann::json keeps the last of several equal keys and does not limit nesting.
  std::vector<std::set<std::string>> keysByDepth(deepestNesting + 2);
  const auto check = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed)
  {
    if (depth > deepestNesting)
    {
      throw BadInput(source + ": nested deeper than " + std::to_string(deepestNesting) +
        " levels, expected a flatter document");
    }
    const auto level = static_cast<std::size_t>(depth);
    if (event == nlohmann::json::parse_event_t::object_start)
    {
      keysByDepth[level + 1].clear();
    }
    else if (event == nlohmann::json::parse_event_t::key &&
      !keysByDepth[level].insert(parsed.get<std::string>()).second)
    {
      throw BadInput(
        source + ": key " + describe(parsed) + " occurs twice in one object, expected once");
    }
    return true;
  };
  try
  {
    return nlohmann::json::parse(text, check);
  }
  catch (const nlohmann::json::exception& error)
  {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    const std::string what = error.what();
    const std::size_t begin = what.find("] ");
    throw BadInput(
      source + ": not valid JSON: " + (begin == std::string::npos ? what : what.substr(begin + 2)));
  }
}

/// Read a JSON file. Syntax errors name line and column. Duplicate keys in an object, deep nesting,
/// and files of more than 16 MiB are refused.
/// @throws BadInput
inline nlohmann::json readJsonFile(const std::string& path)
{
  return parseJson(readWholeFile(path, largestJsonFileBytes), path);
}

} // namespace gnomon::tool
