#include "ModelChecks.h"

#include "Errors.h"
#include "Files.h"
#include "Text.h"

namespace gnomon::tool
{

//------------------------------------------------------------------------------
void checkVtpFile(const std::string& path)
{
  const std::string text = readWholeFile(path, largestModelBytes);
  const std::size_t header = std::min(text.find("<AppendedData"), text.size());

  // vtkXMLPolyDataReader allocates memory for NumberOfPoints and similar counts, and fails on
  // negative ones. No compression reduces a file ten thousandfold.
  const std::string start = "NumberOf";
  constexpr long long mostComponents = 1000;
  const long long mostValues = 10000 * static_cast<long long>(text.size());
  for (std::size_t begin = text.find(start); begin < header; begin = text.find(start, begin + 1))
  {
    const std::size_t quote = text.find_first_of("\"'", begin);
    const std::size_t end = quote == std::string::npos ? quote : text.find(text[quote], quote + 1);
    if (end == std::string::npos)
    {
      return; // not XML: the reader reports it
    }
    const std::string name = text.substr(begin, text.find_first_of(" \t\r\n=", begin) - begin);
    const std::string value = text.substr(quote + 1, end - quote - 1);
    const bool components = name == "NumberOfComponents";
    const long long least = components ? 1 : 0;
    const long long most = components ? mostComponents : mostValues;
    const std::optional<long long> number = parseNumber<long long>(value);
    if (!number || *number < least || *number > most)
    {
      throw BadInput(path + ": " + name + ": found " + quoted(value) + ", expected a number from " +
        std::to_string(least) + " to " + std::to_string(most));
    }
  }
}

} // namespace gnomon::tool
