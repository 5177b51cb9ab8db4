#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Return the parts of a text between separators; one part without a separator.
std::vector<std::string> split(const std::string& text, char separator);

/// Return the words of a text, separated by white space.
std::vector<std::string> splitWords(const std::string& text);

/// Return the word with this index in quotation marks, or a description of the missing word.
std::string quotedWord(const std::vector<std::string>& words, std::size_t number);
/// Parse the whole text as a number of this type; nothing if it is none. Floating-point numbers may
/// be "nan" and "inf". The result does not depend on the locale.
template <class Number>
std::optional<Number> parseNumber(const std::string& text)
{
  // from_chars refuses a plus sign.
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* begin = text.data() + (plus ? 1 : 0);
  const char* end = text.data() + text.size();
  Number value;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end ? std::optional<Number>(value)
                                                       : std::nullopt;
}

/// Parse the word with this index, as parseNumber() does; nothing for a missing word.
template <class Number>
std::optional<Number> parseWord(const std::vector<std::string>& words, std::size_t number)
{
  return number < words.size() ? parseNumber<Number>(words[number]) : std::nullopt;
}
/// Return the text in quotation marks, shortened if it is long.
std::string quoted(const std::string& text);

/// Return text for one line of a terminal: control characters become spaces.
std::string oneLine(const std::string& text);

} // namespace gnomon::tool
