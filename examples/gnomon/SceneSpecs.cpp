#include "Errors.h"
#include "SceneJson.h"
#include "Text.h"

#include <optional>

namespace gnomon::tool
{

namespace
{

/// Parse an integer, a number, or text.
nlohmann::json parseScalar(const std::string& text)
{
  if (const std::optional<long long> whole = parseNumber<long long>(text))
  {
    return *whole;
  }
  if (const std::optional<double> number = parseNumber<double>(text))
  {
    return *number;
  }
  return text;
}

/// Parse "key=value;key=value" as the JSON object of a scene file. Values with commas become
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
      throw BadInput(source + ": key \"" + key + "\" occurs twice, expected once");
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
  return readLight(JsonValue(source, object), {});
}

//------------------------------------------------------------------------------
SceneCamera parseCamera(const std::string& spec, const SceneCamera& defaults)
{
  const std::string source = "--camera " + spec;
  const nlohmann::json object = parseAssignments(source, spec);
  return readCamera(JsonValue(source, object), defaults);
}

} // namespace gnomon::tool
