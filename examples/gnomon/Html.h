#pragma once

#include "ImageFile.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Text as HTML and XML show it. Bytes that no XML may hold become '?'.
std::string escape(const std::string& text);

/// A picture that stands in the page itself.
std::string dataUri(const Picture& picture);

/// A number with so many digits after the point.
std::string fixed(double value, int digits);
/// Three significant digits, without an exponent; "-" for what is not finite.
std::string threeDigits(double value);
/// A share in [0, 1]: "0.905 %".
std::string percent(double share);
std::string megabytes(double bytes);

/// A table's cell, with something smaller below it if wished.
std::string cell(const std::string& value, const std::string& detail = {});
/// A table's first row.
std::string heading(const std::vector<std::string>& names);

/// A text in which every {{name}} is replaced by its value.
/// @throws std::out_of_range for a name that has none
std::string fillTemplate(const std::string& text, const std::map<std::string, std::string>& values);

} // namespace gnomon::tool
