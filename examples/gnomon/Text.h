#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// The parts of a text between separators; one part where there is none.
std::vector<std::string> split(const std::string& text, char separator);

/// The words of a text between white space.
std::vector<std::string> splitWords(const std::string& text);

/// The word of that number in quotation marks, or what stands in its place.
std::string quotedWord(const std::vector<std::string>& words, std::size_t number);
/// A number that is the whole text and that the type can hold; "nan" and "inf" count for floats. It
/// does not depend on the locale.
template <class Number>
std::optional<Number> parseNumber(const std::string& text)
{
  // from_chars takes no plus sign.
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* begin = text.data() + (plus ? 1 : 0);
  const char* end = text.data() + text.size();
  Number value;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end ? std::optional<Number>(value)
                                                       : std::nullopt;
}

/// The same of a word, which may be missing.
template <class Number>
std::optional<Number> parseWord(const std::vector<std::string>& words, std::size_t number)
{
  return number < words.size() ? parseNumber<Number>(words[number]) : std::nullopt;
}
/// The text in quotation marks, cut short where it is long.
std::string quoted(const std::string& text);

/// Text that fits on one line of a terminal: control characters become spaces.
std::string oneLine(const std::string& text);

} // namespace gnomon::tool
