#pragma once

#include <cstddef>
#include <cstdint>
#include <locale>
#include <sstream>
#include <string>

namespace gnomon::tool
{

/// One line of a CSV file, quoted where needed.
class CsvRow
{
public:
  CsvRow() { this->number_.imbue(std::locale::classic()); }

  CsvRow& operator<<(const std::string& text)
  {
    this->line_ += this->line_.empty() && !this->started_ ? "" : ",";
    this->started_ = true;
    if (text.find_first_of(",\"\r\n") == std::string::npos)
    {
      this->line_ += text;
      return *this;
    }
    this->line_ += '"';
    for (char letter : text)
    {
      this->line_ += letter == '"' ? "\"\"" : std::string(1, letter);
    }
    this->line_ += '"';
    return *this;
  }
  CsvRow& operator<<(double number)
  {
    this->number_.str({});
    this->number_.precision(9);
    this->number_ << number;
    return *this << this->number_.str();
  }
  CsvRow& operator<<(std::int64_t number) { return *this << std::to_string(number); }
  CsvRow& operator<<(std::size_t number) { return *this << std::to_string(number); }
  CsvRow& empty() { return *this << std::string(); }

  std::string line() const { return this->line_ + "\r\n"; }

private:
  std::string line_;
  std::ostringstream number_;
  bool started_ = false;
};

} // namespace gnomon::tool
