#include "plugin/pass/SettingsText.h"

#include "lights/SettingsTable.h"
#include "shadowtech/Registry.h"

#include <nlohmann/json.hpp>

#include <variant>

namespace gnomon
{
namespace
{

using Json = nlohmann::ordered_json;

/// Names the kind of a setting's values, and gives their range.
struct Domain
{
  Json operator()(const IntegerSetting& values) const
  {
    return { { "type", "integer" }, { "range", { values.smallest, values.largest } } };
  }
  Json operator()(const RealSetting& values) const
  {
    const bool isLimited = values.largest != anyLength.largest;
    return { { "type", "real" },
      { "range", { values.smallest, isLimited ? Json(values.largest) : Json() } } };
  }
  Json operator()(const ChoiceSetting& values) const
  {
    return { { "type", "choice" }, { "range", values.names } };
  }
};

Json jsonOf(const Setting& setting)
{
  Json json = std::visit(Domain{}, setting.values);
  json["unit"] = setting.unit;
  json["default"] = defaultOf(setting);
  json["meaning"] = setting.meaning;
  json["techniques"] = Json::array();
  for (const TechniqueEntry& technique : registry())
  {
    if (has(technique.estimator->info, setting))
    {
      json["techniques"].push_back(technique.name);
    }
  }
  return json;
}

} // namespace

std::string textOfSettings()
{
  Json json = Json::object();
  for (const Setting* setting : shadowSettings())
  {
    json[setting->name] = jsonOf(*setting);
  }
  return json.dump();
}

} // namespace gnomon
