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
  constexpr std::size_t longest = 60;
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
  {
    return formatNumber(value.get<double>());
  }
  if (value.is_structured() && value.size() > 16)
  {
    return std::string(value.is_array() ? "an array of " : "an object of ") +
      std::to_string(value.size()) + (value.is_array() ? " elements" : " keys");
  }
  std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > longest)
  {
    text.resize(longest);
    text += "...";
  }
  return text;
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
JsonValue::JsonValue(std::string source, const nlohmann::json& document)
  : JsonValue(std::move(source), std::string(), &document)
{
}

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
std::vector<std::string> JsonValue::keys() const
{
  if (!this->value_ || !this->value_->is_object())
  {
    this->fail("an object");
  }
  std::vector<std::string> result;
  for (const auto& item : this->value_->items())
  {
    result.push_back(item.key());
  }
  return result;
}

//------------------------------------------------------------------------------
void JsonValue::requireObject(const std::vector<std::string>& known) const
{
  for (const std::string& key : this->keys())
  {
    if (std::find(known.begin(), known.end(), key) == known.end())
    {
      this->refuse("unknown key " + describe(key) + ", expected one of: " + listOf(known));
    }
  }
}

//------------------------------------------------------------------------------
std::size_t JsonValue::size() const
{
  if (!this->value_ || !this->value_->is_array())
  {
    this->fail("an array");
  }
  return this->value_->size();
}

//------------------------------------------------------------------------------
std::vector<JsonValue> JsonValue::elements() const
{
  std::vector<JsonValue> result;
  result.reserve(this->size());
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    result.push_back(
      JsonValue(this->source_, this->path_ + "[" + std::to_string(i) + "]", &(*this->value_)[i]));
  }
  return result;
}

//------------------------------------------------------------------------------
std::vector<JsonValue> JsonValue::elementsOrNone() const
{
  return this->present() ? this->elements() : std::vector<JsonValue>();
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
  if (!this->value_ || !this->value_->is_boolean())
  {
    this->fail("true or false");
  }
  return this->value_->get<bool>();
}

//------------------------------------------------------------------------------
std::string JsonValue::text() const
{
  if (!this->value_ || !this->value_->is_string() ||
    this->value_->get_ref<const std::string&>().empty())
  {
    this->fail("a text");
  }
  return this->value_->get<std::string>();
}

//------------------------------------------------------------------------------
void JsonValue::readNumbers(double* result, std::size_t count, const NumberRange& range) const
{
  bool good = this->value_ && this->value_->is_array() && this->value_->size() == count;
  for (std::size_t i = 0; good && i < count; ++i)
  {
    good = contains(range, (*this->value_)[i]);
  }
  if (!good)
  {
    this->fail("an array of " + std::to_string(count) + " numbers " + describe(range));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
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
