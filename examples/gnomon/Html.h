#pragma once

#include "ImageFile.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Return text escaped for HTML and XML. Bytes that are invalid in XML become '?'.
std::string escape(const std::string& text);

/// Return a picture as a data URI.
std::string dataUri(const Picture& picture);

/// Return a number with this many digits after the point.
std::string fixed(double value, int digits);
/// Return a number with three significant digits, without exponent; "-" for a number that is not
/// finite.
std::string threeDigits(double value);
/// Return a share, in [0, 1], as a percentage: "0.905 %".
std::string percent(double share);
std::string megabytes(double bytes);

/// Return a table's cell, with optional smaller text below.
std::string cell(const std::string& value, const std::string& detail = {});
/// Return a table's first row.
std::string heading(const std::vector<std::string>& names);

/// Return a text with every {{name}} replaced by its value.
/// @throws std::out_of_range for a name without value
std::string fillTemplate(const std::string& text, const std::map<std::string, std::string>& values);

} // namespace gnomon::tool
