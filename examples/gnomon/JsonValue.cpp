#include "JsonValue.h"

#include "Errors.h"
#include "Files.h"

#include "lights/SettingsTable.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

namespace gnomon::tool
{

namespace
{

constexpr std::size_t largestJsonFileBytes = 16 * 1024 * 1024;
constexpr int deepestNesting = 32;

std::string formatNumber(double value)
{
  std::ostringstream stream;
  stream.precision(12);
  stream << value;
  return stream.str();
}

/// Return a value for an error message: short, and on one line.
std::string describe(const nlohmann::json& value)
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

std::string describe(const NumberRange& range)
{
  return "between " + formatNumber(range.low) + " and " + formatNumber(range.high);
}

bool contains(const NumberRange& range, const nlohmann::json& value)
{
  // NaN is outside every range.
  return value.is_number() && value.get<double>() >= range.low && value.get<double>() <= range.high;
}

} // namespace

//------------------------------------------------------------------------------
JsonValue::JsonValue(std::string source, std::string path, const nlohmann::json* value)
  : source_(std::move(source))
  , path_(std::move(path))
  , value_(value)
{
}

//------------------------------------------------------------------------------
JsonValue JsonValue::member(const std::string& key) const
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

//------------------------------------------------------------------------------
void JsonValue::requireKeys(const std::vector<std::string>& known) const
{
  for (const auto& item : this->value_->items())
  {
    if (std::find(known.begin(), known.end(), item.key()) == known.end())
    {
      this->refuse("unknown key " + describe(item.key()) + ", expected one of: " + listOf(known));
    }
  }
}

//------------------------------------------------------------------------------
std::vector<JsonValue> JsonValue::elements() const
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

//------------------------------------------------------------------------------
double JsonValue::number(const NumberRange& range) const
{
  if (!this->value_ || !contains(range, *this->value_))
  {
    this->fail("a number " + describe(range));
  }
  return this->value_->get<double>();
}

//------------------------------------------------------------------------------
int JsonValue::integer(int low, int high) const
{
  const NumberRange range{ static_cast<double>(low), static_cast<double>(high) };
  if (!this->value_ || !this->value_->is_number_integer() || !contains(range, *this->value_))
  {
    this->fail("a whole number " + describe(range));
  }
  return this->value_->get<int>();
}

//------------------------------------------------------------------------------
bool JsonValue::boolean() const
{
  return this->require(&nlohmann::json::is_boolean, "true or false").get<bool>();
}

//------------------------------------------------------------------------------
std::string JsonValue::text() const
{
  const auto text = this->require(&nlohmann::json::is_string, "a text").get<std::string>();
  if (text.empty())
  {
    this->fail("a text");
  }
  return text;
}

//------------------------------------------------------------------------------
std::string JsonValue::choice(const std::vector<std::string>& names) const
{
  const std::string text = this->text();
  if (std::find(names.begin(), names.end(), text) == names.end())
  {
    this->fail("one of: " + listOf(names));
  }
  return text;
}

//------------------------------------------------------------------------------
const nlohmann::json& JsonValue::require(
  bool (nlohmann::json::*is)() const noexcept, const char* expected) const
{
  if (!this->value_ || !(this->value_->*is)())
  {
    this->fail(expected);
  }
  return *this->value_;
}

//------------------------------------------------------------------------------
void JsonValue::readNumbers(double* result, std::size_t count, const NumberRange& range) const
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

//------------------------------------------------------------------------------
void JsonValue::fail(const std::string& expected) const
{
  this->refuse((this->value_ ? "found " + describe(*this->value_) : std::string("missing")) +
    ", expected " + expected);
}

//------------------------------------------------------------------------------
void JsonValue::refuse(const std::string& message) const
{
  throw BadInput(this->source_ + ": " + (this->path_.empty() ? "" : this->path_ + ": ") + message);
}

//------------------------------------------------------------------------------
nlohmann::json readJsonFile(const std::string& path)
{
  return parseJson(readWholeFile(path, largestJsonFileBytes), path);
}

//------------------------------------------------------------------------------
nlohmann::json parseJson(const std::string& text, const std::string& source)
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

} // namespace gnomon::tool
