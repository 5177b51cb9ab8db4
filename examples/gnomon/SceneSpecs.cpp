#include "Errors.h"
#include "SceneJson.h"

#include <charconv>
#include <optional>

namespace gnomon::tool
{

namespace
{

std::vector<std::string> split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = text.find(separator); end != std::string::npos;
       end = text.find(separator, begin))
  {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

/// A whole number, a number, or text.
nlohmann::json parseScalar(const std::string& text)
{
  const char* end = text.data() + text.size();
  long long whole = 0;
  if (const auto result = std::from_chars(text.data(), end, whole);
      result.ec == std::errc() && result.ptr == end)
  {
    return whole;
  }
  double number = 0.0;
  if (const auto result = std::from_chars(text.data(), end, number);
      result.ec == std::errc() && result.ptr == end)
  {
    return number;
  }
  return text;
}

/// "key=value;key=value" as the JSON object that a scene file would hold; values with commas become
/// arrays.
nlohmann::json parseAssignments(const std::string& source, const std::string& text)
{
  nlohmann::json object = nlohmann::json::object();
  for (const std::string& assignment : split(text, ';'))
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
    {
      throw BadInput(source + ": found \"" + assignment + "\", expected key=value;key=value...");
    }
    const std::string key = assignment.substr(0, equals);
    const std::string value = assignment.substr(equals + 1);
    nlohmann::json parsed = parseScalar(value);
    if (value.find(',') != std::string::npos)
    {
      parsed = nlohmann::json::array();
      for (const std::string& element : split(value, ','))
      {
        parsed.push_back(parseScalar(element));
      }
    }
    if (!object.emplace(key, parsed).second)
    {
      throw BadInput(source + ": key \"" + key + "\" stands twice, expected it once");
    }
  }
  return object;
}

} // namespace

//------------------------------------------------------------------------------
SceneLight parseLight(const std::string& spec)
{
  const std::string source = "--light " + spec;
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos)
  {
    throw BadInput(source + ": no type, expected for example directional:direction=-1,-2,-1");
  }
  nlohmann::json object = parseAssignments(source, spec.substr(colon + 1));
  if (!object.emplace("type", spec.substr(0, colon)).second)
  {
    throw BadInput(source + ": unknown key \"type\", expected the type in front of the colon only");
  }
  return *readLight(JsonValue(source, object), FileLights::Use);
}

//------------------------------------------------------------------------------
SceneCamera parseCamera(const std::string& spec, const SceneCamera& defaults)
{
  const std::string source = "--camera " + spec;
  const nlohmann::json object = parseAssignments(source, spec);
  return readCamera(JsonValue(source, object), defaults);
}

} // namespace gnomon::tool
