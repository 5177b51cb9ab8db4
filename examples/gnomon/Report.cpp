#include "Report.h"

#include "ChartTemplate.h" // generated from Chart.svg
#include "Errors.h"
#include "Files.h"
#include "ReportTemplate.h" // generated from Report.html

#include <kainjow/mustache.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace gnomon::tool
{

namespace
{

using Json = nlohmann::ordered_json;
using kainjow::mustache::data;

std::string fixed(double value, int digits)
{
  char text[400];
  return { text,
    std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, digits).ptr };
}

std::string percent(double share)
{
  return threeDigits(100.0 * share) + " %";
}

/// Return JSON as data for a template. A number `x` is also there as `x_digits`, with three digits,
/// `x_percent` and `x_mb`.
data dataOf(const Json& json)
{
  if (json.is_object())
  {
    data object(data::type::object);
    for (const auto& [name, value] : json.items())
    {
      object.set(name, dataOf(value));
      if (value.is_number())
      {
        object.set(name + "_digits", threeDigits(value));
        object.set(name + "_percent", percent(value));
        object.set(name + "_mb", fixed(value.get<double>() / (1024.0 * 1024.0), 1) + " MB");
      }
    }
    return object;
  }
  if (json.is_array())
  {
    data list(data::type::list);
    for (const Json& value : json)
    {
      list.push_back(dataOf(value));
    }
    return list;
  }
  return json.is_boolean() ? data(json.get<bool>())
                           : data(json.is_string() ? json.get<std::string>() : json.dump());
}

std::string filled(const char* text, const Json& json)
{
  return kainjow::mustache::mustache(text).render(dataOf(json));
}

bool isSoft(const Row& row)
{
  return row.at("shadows") == "soft";
}

/// Return a row's case: "bunny, view 2", or "bunny" for the scene's own view.
std::string caseName(const Row& row)
{
  return row.at("scene").get<std::string>() +
    (row.at("view") > 0 ? ", view " + row.at("view").dump() : "");
}

std::string errorText(const Row& row)
{
  return isSoft(row) ? "an RMS error of " + threeDigits(errorOf(row))
                     : percent(errorOf(row)) + " wrong pixels";
}

/// Return the part of a page about only hard or only soft shadows: recommendations, the front and
/// the worst places.
/// @param mostRows largest number of rows; the most accurate ones stay
/// @param mostPlaces largest number of places
Json groupOf(const Rows& rows, std::size_t mostRows, std::size_t mostPlaces)
{
  constexpr const char* time = "camera_moving_over_plain";
  Rows means = meansOf(rows);
  for (Row& row : means)
  {
    row["error"] = errorText(row);
  }
  const bool isTimed = means.front().contains(time);
  const bool soft = isSoft(means.front());
  Rows front = isTimed ? frontOf(means, time) : Rows();
  // Places of the front come first, and then the most wrong ones.
  Rows ordered = front;
  std::stable_sort(
    means.begin(), means.end(), [](const Row& a, const Row& b) { return errorOf(a) > errorOf(b); });
  std::copy_if(means.begin(), means.end(), std::back_inserter(ordered),
    [&](const Row& row) { return std::find(front.begin(), front.end(), row) == front.end(); });
  Json group = { { "kind", soft ? "soft" : "hard" }, { "isSoft", soft },
    { "places", Json::array() } };
  for (const Row& row : ordered)
  {
    if (row.contains("place") && row.at("technique") != plainTechnique &&
      group["places"].size() < mostPlaces)
    {
      group["places"].push_back(row);
    }
  }
  if (isTimed)
  {
    front.erase(front.begin(), front.end() - std::min(mostRows, front.size()));
    group["front"] = { { "rows", front } };
    means.erase(std::remove_if(means.begin(), means.end(),
                  [](const Row& row) { return row.at("technique") == plainTechnique; }),
      means.end());
    const Rows shadowed = frontOf(means, time);
    group["best"] = shadowed.back();
    if (shadowed.size() > 1)
    {
      const double enough = soft ? 0.03 : 0.005; // the error that is acceptable during motion
      group["quick"] = *std::find_if(shadowed.begin(), shadowed.end() - 2,
        [&](const Row& row) { return errorOf(row) <= enough; });
    }
  }
  return group;
}

Json chartFigure(const std::string& of, const Rows& rows, Motion motion)
{
  return { { "of", of + "/" + motionKeys[static_cast<std::size_t>(motion)] },
    { "svg", filled(ChartTemplate, chartOf(meansOf(rows), motion)) } };
}

///@{
/// The space for points, in pixels of Chart.svg.
constexpr double left = 80.0;
constexpr double right = 620.0;
constexpr double top = 15.0;
constexpr double bottom = 460.0;
///@}

double rounded(double pixels)
{
  return std::round(10.0 * pixels) / 10.0;
}

/// A logarithmic axis for values >= 0. Zero has no logarithm, so it has a place beside the others.
class LogAxis
{
public:
  /// @param begin, end the axis' ends in the picture
  LogAxis(const std::vector<double>& values, double begin, double end)
    : begin_(begin)
    , end_(end)
    , hasZero_(std::count(values.begin(), values.end(), 0.0) > 0)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const double value : values)
    {
      least = value > 0.0 ? std::min(least, value) : least;
    }
    const double most = *std::max_element(values.begin(), values.end());
    constexpr double margin = 0.05;
    constexpr double narrowest = 0.8; // has two ticks
    this->low_ = most > 0.0 ? std::log10(least) - margin : 0.0;
    this->high_ = std::max(std::log10(std::max(most, least)) + margin, this->low_ + narrowest);
    this->high_ = most > 0.0 ? this->high_ : narrowest;
  }

  double place(double value) const
  {
    const double first = this->hasZero_ ? 0.12 : 0.0;
    const double share = value > 0.0
      ? first + (1.0 - first) * (std::log10(value) - this->low_) / (this->high_ - this->low_)
      : 0.03;
    return rounded(this->begin_ + share * (this->end_ - this->begin_));
  }

  Json ticks(const std::string& unit) const
  {
    Json ticks = Json::array();
    if (this->hasZero_)
    {
      ticks.push_back({ { "at", this->place(0.0) }, { "label", "0" } });
    }
    const bool isWide = this->high_ - this->low_ > 2.5;
    for (int third = -30; third < 30; ++third)
    {
      const int step = std::array{ 1, 2, 5 }[static_cast<std::size_t>((third + 30) % 3)];
      const double value = step * std::pow(10.0, std::floor(third / 3.0));
      const bool isInside = std::log10(value) > this->low_ && std::log10(value) < this->high_;
      if (isInside && (step == 1 || !isWide))
      {
        ticks.push_back({ { "at", this->place(value) }, { "label", shortNumber(value) + unit } });
      }
    }
    return ticks;
  }

private:
  double begin_;
  double end_;
  bool hasZero_;
  double low_ = 0.0; ///< decimal logarithms
  double high_ = 1.0;
};

} // namespace

double errorOf(const Row& row)
{
  return row.at(isSoft(row) ? "rms_error" : "wrong_share");
}

Rows rowsOf(const ComparisonResults& results, int view)
{
  const Json& variants = results.json.at("variants");
  std::map<std::string, std::size_t> indices;
  for (const Json& variant : variants)
  {
    indices.emplace(variant.at("name"), indices.size());
  }
  const Picture& truth = results.pictures.at(indices.at(results.json.at("truth"))).picture;
  Rows rows;
  for (std::size_t i = 0; i < variants.size(); ++i)
  {
    const Json& error = variants[i].at("error");
    Row row = { { "scene", results.json.at("scene") },
      { "shadows", results.soft ? "soft" : "hard" }, { "view", view },
      { "variant", variants[i].at("name") }, { "technique", variants[i].at("technique") } };
    for (const char* name : { "wrong_share", "rms_error", "mean_absolute_error" })
    {
      row[name] = error.at(name);
    }
    const Json times = variants[i].value("times", Json::object());
    for (const auto& [motion, timing] : times.items())
    {
      const double milliseconds = timing.at("frame_ms");
      row[motion + "_ms"] = milliseconds;
      row[motion + "_over_plain"] = milliseconds /
        variants[indices.at(plainTechnique)].at("times").at(motion).at("frame_ms").get<double>();
    }
    if (const std::optional<Place>& worst = results.pictures[i].worst)
    {
      row["place"] = { { "of", caseName(row) + ": " + errorText(row) },
        { "truth", dataUri(cropped(truth, *worst)) },
        { "technique", dataUri(cropped(results.pictures[i].picture, *worst)) } };
    }
    rows.push_back(row);
  }
  return rows;
}

Rows meansOf(const Rows& rows)
{
  nlohmann::ordered_map<std::string, Rows> ofVariants;
  std::size_t cases = 0;
  for (const Row& row : rows)
  {
    Rows& ofVariant = ofVariants[row.at("variant")];
    ofVariant.push_back(row);
    cases = std::max(cases, ofVariant.size());
  }
  Rows means;
  for (const auto& [variant, ofVariant] : ofVariants)
  {
    if (ofVariant.size() < cases)
    {
      continue;
    }
    Row mean = *std::max_element(ofVariant.begin(), ofVariant.end(),
      [](const Row& a, const Row& b) { return errorOf(a) < errorOf(b); });
    for (const auto& [name, value] : mean.items())
    {
      const bool isRatio = name.find("_over_plain") != std::string::npos;
      double sum = 0.0;
      for (const Row& row : value.is_number_float() ? ofVariant : Rows())
      {
        const double number = row.at(name);
        sum += (isRatio ? std::log(number) : number) / static_cast<double>(cases);
        value = isRatio ? std::exp(sum) : sum;
      }
    }
    means.push_back(mean);
  }
  return means;
}

Rows frontOf(Rows rows, const std::string& time)
{
  constexpr double alike = 0.02;
  const auto keyOf = [&](const Row& row)
  { return std::pair(row.at(time).get<double>(), errorOf(row)); };
  std::stable_sort(
    rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return keyOf(a) < keyOf(b); });
  Rows front;
  for (const Row& row : rows)
  {
    if (front.empty() || errorOf(row) < (1.0 - alike) * errorOf(front.back()))
    {
      front.push_back(row);
    }
  }
  return front;
}

std::string csvLine(const std::vector<Json>& cells)
{
  std::string line;
  for (const Json& cell : cells)
  {
    std::string text = cell.is_string() ? cell.get<std::string>()
      : cell.is_number_float()          ? shortNumber(cell)
      : cell.is_null()                  ? ""
                                        : cell.dump();
    if (text.find_first_of(",\"\r\n") != std::string::npos)
    {
      for (std::size_t quote = text.find('"'); quote != std::string::npos;
           quote = text.find('"', quote + 2))
      {
        text.insert(quote, 1, '"');
      }
      text = '"' + text + '"';
    }
    line += (&cell == &cells.front() ? "" : ",") + text;
  }
  return line + "\r\n";
}

std::string csvOf(const Rows& rows)
{
  std::string text;
  for (const Row& row : rows)
  {
    std::vector<Json> head;
    std::vector<Json> cells;
    for (const auto& [name, value] : row.items())
    {
      if (!value.is_structured())
      {
        head.push_back(name);
        cells.push_back(value);
      }
    }
    text += (text.empty() ? csvLine(head) : "") + csvLine(cells);
  }
  return text;
}

std::string csvOf(const Json& results)
{
  using Path = Json::json_pointer;
  const Json& variants = results.at("variants");
  Rows rows(variants.size());
  const auto add = [&](const std::string& column, const Path& path)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      rows[i][column] = variants[i].value(path, Json());
    }
  };
  /// Add a column for each member that the variants' objects at a path have.
  const auto addMembers = [&](const Path& path, const std::string& before, const std::string& after)
  {
    for (const Json& variant : variants)
    {
      const Json members = variant.value(path, Json::object());
      for (const auto& [name, value] : members.items())
      {
        add(before + name + after, path / name);
      }
    }
  };
  add("variant", Path("/name"));
  for (const char* name : { "technique", "route", "map_size" })
  {
    add(name, Path() / name);
  }
  addMembers(Path("/error"), "", "");
  add("traced_pixels", Path("/traced_pixels"));
  for (const std::string key : motionKeys)
  {
    const Path times = Path("/times") / key;
    if (results.at("frames") > 0)
    {
      add(key + "_ms", times / "frame_ms");
      addMembers(times / "stages_ms", key + "_", "_ms");
      add(key + "_stage_share", times / "stage_share");
    }
  }
  for (const auto& [column, name] :
    { std::pair("occluder_bytes", "occluders"), { "bvh_bytes", "bvh" }, { "map_bytes", "maps" },
      { "image_bytes", "images" }, { "resident_growth_bytes", "resident_growth" } })
  {
    add(column, Path("/memory_bytes") / name);
  }
  addMembers(Path("/class_pixels"), "class ", "_pixels");
  for (Row& row : rows)
  {
    row.erase("source");
    row["map_size"] = row["map_size"] == 0 ? Json() : row["map_size"];
  }
  return csvOf(rows);
}

std::string shortNumber(double value)
{
  char text[32];
  return { text,
    std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 9).ptr };
}

std::string threeDigits(double value)
{
  if (value == 0.0 || !std::isfinite(value))
  {
    return value == 0.0 ? "0" : "-";
  }
  const int magnitude = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  return fixed(value, std::clamp(2 - magnitude, 0, 9));
}

std::string pageOf(const ComparisonResults& results)
{
  constexpr std::size_t most = 5;
  constexpr int mostPixels = 400;
  const Rows rows = rowsOf(results);
  Json page = results.json;
  const bool isTimed = page.at("frames") > 0;
  page["title"] = "Shadows compared: " + page.at("scene").get<std::string>();
  page["isTimed"] = isTimed;
  page["groups"].push_back(groupOf(rows, most, most));
  page["report"] = { { "isOneLight", page.at("casting_lights") == 1 }, { "count", rows.size() },
    { "dark", shortNumber(VisibilityError::darkBelow) },
    { "lit", shortNumber(VisibilityError::litAbove) } };
  for (const auto& [name, value] : page.at("settings").items())
  {
    page["report"]["settings"].push_back({ { "name", name }, { "value", value } });
  }
  if (isTimed)
  {
    page["charts"].push_back(chartFigure(page.at("scene"), rows, Motion::Camera));
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    Json& variant = page["variants"][i];
    std::int64_t bytes = 0;
    for (const char* part : { "occluders", "bvh", "maps", "images" })
    {
      bytes += variant.at("memory_bytes").at(part).get<std::int64_t>();
    }
    const VariantPictures& pictures = results.pictures[i];
    variant["row"] = rows[i];
    variant["bytes"] = bytes;
    for (const Picture* picture : { &pictures.picture, &pictures.errors, &pictures.classes })
    {
      if (picture->pixelCount() > 0)
      {
        variant["pictures"].push_back(dataUri(reduced(*picture, mostPixels)));
      }
    }
    for (const Json& note : variant.at("notes"))
    {
      page["notes"].push_back(
        variant.at("name").get<std::string>() + ": " + note.get<std::string>());
    }
  }
  return filled(ReportTemplate, page);
}

std::string pageOf(const Rows& rows, const std::string& machine)
{
  constexpr std::size_t mostPlaces = 4;
  nlohmann::ordered_map<std::string, Rows> groups;
  std::set<std::string> cases;
  for (const bool soft : { false, true })
  {
    for (const Row& row : rows)
    {
      if (isSoft(row) == soft)
      {
        groups[std::string("all scenes with ") + (soft ? "soft" : "hard") + " shadows"].push_back(
          row);
        cases.insert(caseName(row));
      }
    }
  }
  Json page = { { "title", "What accuracy costs" }, { "isTimed", true },
    { "study", { { "cases", cases.size() }, { "machine", machine } } } };
  for (const auto& [name, ofKind] : groups)
  {
    page["groups"].push_back(groupOf(ofKind, ofKind.size(), mostPlaces));
  }
  for (const Row& row : rows)
  {
    groups[row.at("scene")].push_back(row);
  }
  for (const auto& [name, ofGroup] : groups)
  {
    page["study"]["scenes"].push_back(name);
    for (const Motion motion : allMotions)
    {
      page["charts"].push_back(chartFigure(name, ofGroup, motion));
    }
  }
  return filled(ReportTemplate, page);
}

void prepareReportFolder(const std::string& folder, const std::string& file)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw BadInput(folder + ": the folder cannot be made: " + error.message());
  }
  const std::filesystem::path probe = std::filesystem::path(folder) / file;
  errno = 0;
  if (!std::ofstream(probe, std::ios::app))
  {
    throw BadInput(probe.string() + ": cannot be written: " + std::strerror(errno));
  }
}

void writeReport(const ComparisonResults& results, const std::string& folder)
{
  prepareReportFolder(folder);
  for (std::size_t i = 0; i < results.pictures.size(); ++i)
  {
    const Json& variant = results.json.at("variants")[i];
    const VariantPictures& pictures = results.pictures[i];
    for (const auto& [name, picture] : { std::pair("picture", &pictures.picture),
           { "error_picture", &pictures.errors }, { "class_picture", &pictures.classes } })
    {
      if (variant.contains(name))
      {
        writePicture(*picture, folder + "/" + variant.at(name).get<std::string>());
      }
    }
  }
  if (results.json.at("frames") > 0)
  {
    writeWholeFile(
      folder + "/chart.svg", filled(ChartTemplate, chartOf(rowsOf(results), Motion::Camera)));
  }
  writeWholeFile(folder + "/results.csv", csvOf(results.json));
  // File names given by users may contain invalid UTF-8.
  writeWholeFile(folder + "/results.json",
    results.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  writeWholeFile(folder + "/report.html", pageOf(results));
}

Json chartOf(const Rows& rows, Motion motion)
{
  const auto index = static_cast<std::size_t>(motion);
  const std::string time = motionKeys[index] + std::string("_over_plain");
  const bool soft = rows.at(0).at("shadows") == "soft";
  const auto shownError = [&](const Row& row) { return (soft ? 1.0 : 100.0) * errorOf(row); };
  std::vector<double> times;
  std::vector<double> errors;
  for (const Row& row : rows)
  {
    times.push_back(row.at(time));
    errors.push_back(shownError(row));
  }
  const LogAxis timeAxis(times, left, right);
  const LogAxis errorAxis(errors, bottom, top);
  const std::string moving =
    motion == Motion::Static ? "nothing moving" : std::string("the ") + motionNames[index];
  Json chart = { { "xTicks", timeAxis.ticks("") }, { "yTicks", errorAxis.ticks(soft ? "" : " %") },
    { "xTitle", "time per frame over plain VTK's, " + moving },
    { "yTitle", soft ? "RMS error of visibility" : "wrong pixels" } };
  const auto addPoints = [&](const char* name, const Rows& shown)
  {
    for (const Row& row : shown)
    {
      chart[name].push_back({ { "x", timeAxis.place(row.at(time)) },
        { "y", errorAxis.place(shownError(row)) }, { "name", row.at("variant") } });
    }
  };
  addPoints("points", rows);
  addPoints("front", frontOf(rows, time));
  // Errors fall along the front, so labels beside its points keep their order from top to bottom.
  constexpr double lineHeight = 16.0;
  double lowest = bottom - 4.0;
  for (auto point = chart["front"].rbegin(); point != chart["front"].rend(); ++point)
  {
    const double x = (*point)["x"];
    const bool isLeft = x > (left + right) / 2.0;
    lowest = std::min(lowest, (*point)["y"].get<double>() + 4.0);
    (*point)["labelX"] = rounded(isLeft ? x - 12.0 : x + 12.0);
    (*point)["labelY"] = rounded(lowest);
    (*point)["anchor"] = isLeft ? "end" : "start";
    lowest -= lineHeight;
  }
  return chart;
}

} // namespace gnomon::tool
