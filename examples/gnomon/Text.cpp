#include "Text.h"

#include <algorithm>
#include <cctype>

namespace gnomon::tool
{

std::vector<std::string> split(const std::string& text, char separator)
{
  std::vector<std::string> parts(1);
  for (const char letter : text)
  {
    letter == separator ? void(parts.emplace_back()) : parts.back().push_back(letter);
  }
  return parts;
}

std::vector<std::string> splitWords(const std::string& text)
{
  constexpr const char* whiteSpace = " \t\r\n\v\f";
  std::vector<std::string> words;
  std::size_t begin = text.find_first_not_of(whiteSpace);
  while (begin != std::string::npos)
  {
    const std::size_t end = std::min(text.find_first_of(whiteSpace, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(whiteSpace, end);
  }
  return words;
}

std::string quotedWord(const std::vector<std::string>& words, std::size_t number)
{
  return number < words.size() ? quoted(words[number]) : "the line's end";
}

std::string quoted(const std::string& text)
{
  constexpr std::size_t longest = 60;
  return '"' + (text.size() > longest ? text.substr(0, longest) + "..." : text) + '"';
}

std::string oneLine(const std::string& text)
{
  std::string line = text;
  std::replace_if(
    line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return line;
}

} // namespace gnomon::tool
