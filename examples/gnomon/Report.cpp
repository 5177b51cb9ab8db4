#include "Report.h"

#include "Errors.h"
#include "Files.h"
#include "StudyParts.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gnomon::tool
{
//------------------------------------------------------------------------------
std::string fileStem(const std::string& variantName)
{
  std::string stem;
  for (char letter : variantName)
  {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
      (letter >= '0' && letter <= '9') || letter == '_' || letter == '-';
    stem += plain ? letter : '-';
  }
  return stem;
}

//------------------------------------------------------------------------------
void prepareReportFolder(const std::string& folder, const std::string& file)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw BadInput(folder + ": the folder cannot be made: " + error.message());
  }
  if (!std::filesystem::is_directory(folder, error))
  {
    throw BadInput(folder + ": is not a folder, expected one for the report");
  }
  const std::filesystem::path probe = std::filesystem::path(folder) / file;
  errno = 0;
  const std::ofstream opened(probe, std::ios::app);
  if (!opened)
  {
    throw BadInput(probe.string() + ": cannot be written: " + std::strerror(errno));
  }
}

//------------------------------------------------------------------------------
void writeReport(const ComparisonResults& results, const std::string& folder)
{
  prepareReportFolder(folder);
  const std::filesystem::path base(folder);
  for (const VariantResult& variant : results.variants)
  {
    const std::string stem = fileStem(variant.name);
    writePicture(variant.picture, (base / (stem + ".png")).string());
    writePicture(variant.errors, (base / (stem + "-errors.png")).string());
    if (variant.classPicture.pixelCount() > 0)
    {
      writePicture(variant.classPicture, (base / (stem + "-classes.png")).string());
    }
  }
  Picture chart;
  if (results.frames > 0)
  {
    const StudyCase of{ results.scene, -1, results.soft };
    chart = frontChart(summarise(rowsOf(of, results)), results.soft, Motion::Camera);
    writePicture(chart, (base / "chart.png").string());
  }
  writeWholeFile((base / "results.csv").string(), toCsv(results));
  writeWholeFile((base / "results.json").string(), toJson(results));
  writeWholeFile((base / "report.html").string(), toHtml(results, chart));
}

} // namespace gnomon::tool
