#include "Report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::tool
{
namespace
{

using Json = nlohmann::ordered_json;

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

//------------------------------------------------------------------------------
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
