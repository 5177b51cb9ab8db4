#include "Html.h"

#include <vtkBase64Utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
std::string escape(const std::string& text)
{
  static const std::map<char, std::string> entities = { { '&', "&amp;" }, { '<', "&lt;" },
    { '>', "&gt;" }, { '"', "&quot;" } };
  std::string result;
  for (const char letter : text)
  {
    const auto entity = entities.find(letter);
    const bool isControl = static_cast<unsigned char>(letter) < 0x20;
    result += entity != entities.end() ? entity->second : std::string(1, isControl ? '?' : letter);
  }
  return result;
}

//------------------------------------------------------------------------------
std::string dataUri(const Picture& picture)
{
  const std::vector<unsigned char> png = encodePng(picture);
  std::vector<unsigned char> text((png.size() + 2) / 3 * 4);
  vtkBase64Utilities::Encode(png.data(), static_cast<unsigned long>(png.size()), text.data());
  return "data:image/png;base64," + std::string(text.begin(), text.end());
}

//------------------------------------------------------------------------------
std::string fixed(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

//------------------------------------------------------------------------------
std::string threeDigits(double value)
{
  if (value == 0.0 || !std::isfinite(value))
  {
    return value == 0.0 ? "0" : "-";
  }
  const int magnitude = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  return fixed(value, std::clamp(2 - magnitude, 0, 9));
}

//------------------------------------------------------------------------------
std::string percent(double share)
{
  return threeDigits(100.0 * share) + " %";
}

//------------------------------------------------------------------------------
std::string megabytes(double bytes)
{
  return fixed(bytes / (1024.0 * 1024.0), 1) + " MB";
}

//------------------------------------------------------------------------------
std::string cell(const std::string& value, const std::string& detail)
{
  return "<td>" + escape(value) +
    (detail.empty() ? std::string() : "<small>" + escape(detail) + "</small>") + "</td>";
}

//------------------------------------------------------------------------------
std::string heading(const std::vector<std::string>& names)
{
  std::string row = "<thead><tr>";
  for (const std::string& name : names)
  {
    row += "<th>" + escape(name) + "</th>";
  }
  return row + "</tr></thead>\n";
}

//------------------------------------------------------------------------------
std::string fillTemplate(const std::string& text, const std::map<std::string, std::string>& values)
{
  std::string result;
  std::size_t position = 0;
  for (std::size_t open = text.find("{{"); open != std::string::npos;
       open = text.find("{{", position))
  {
    const std::size_t close = text.find("}}", open);
    result.append(text, position, open - position);
    result += values.at(text.substr(open + 2, close - open - 2));
    position = close + 2;
  }
  return result.append(text, position);
}

} // namespace gnomon::tool
