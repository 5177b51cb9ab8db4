#include "ReportChart.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace gnomon::tool
{
namespace
{

constexpr int chartWidth = 640;
constexpr int chartHeight = 560;

using Colour = std::array<unsigned char, 3>;

/// Return one of ten colours that differ from each other and from white.
Colour variantColour(std::size_t index)
{
  static constexpr std::array<Colour, 10> palette = { { { { 31, 119, 180 } }, { { 214, 39, 40 } },
    { { 44, 160, 44 } }, { { 148, 103, 189 } }, { { 255, 127, 14 } }, { { 23, 190, 207 } },
    { { 140, 86, 75 } }, { { 227, 119, 194 } }, { { 127, 127, 127 } }, { { 188, 189, 34 } } } };
  return palette[index % palette.size()];
}

/// Return the step of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ... next to a value: the largest one not
/// above it (direction < 0), or the smallest one not below it (direction > 0).
double roundToStep(double value, int direction)
{
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  static constexpr double steps[] = { 1.0, 2.0, 5.0, 10.0 };
  double result = steps[direction < 0 ? 0 : 3] * decade;
  for (double step : steps)
  {
    if (direction < 0 && step * decade <= value)
    {
      result = std::max(result, step * decade);
    }
    if (direction > 0 && step * decade >= value)
    {
      result = std::min(result, step * decade);
    }
  }
  return result;
}

std::string shortNumber(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

/// Writes the variants' names beside their points, without overlap.
class PointLabels : public vtkContextItem
{
public:
  static PointLabels* New();
  vtkTypeMacro(PointLabels, vtkContextItem);

  struct Label
  {
    std::string text;
    Colour colour;
    double x; ///< the point's axis coordinates
    double y;
  };
  std::vector<Label> labels;
  /// Other points that labels avoid, in axis coordinates.
  std::vector<std::array<double, 2>> points;
  vtkAxis* xAxis = nullptr;
  vtkAxis* yAxis = nullptr;

  bool Paint(vtkContext2D* painter) override
  {
    std::vector<Box> taken;
    for (const std::array<double, 2>& point : this->points)
    {
      const float x = pixel(this->xAxis, point[0], 0);
      const float y = pixel(this->yAxis, point[1], 1);
      taken.push_back({ x - 8.0f, y - 8.0f, x + 8.0f, y + 8.0f });
    }
    painter->GetTextProp()->SetFontSize(14);
    painter->GetTextProp()->SetJustificationToLeft();
    painter->GetTextProp()->SetVerticalJustificationToBottom();
    for (const Label& label : this->labels)
    {
      float bounds[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
      painter->ComputeStringBounds(label.text, bounds);
      const float x = pixel(this->xAxis, label.x, 0);
      const float y = pixel(this->yAxis, label.y, 1);
      const Box box = this->place(x, y, bounds[2], bounds[3], taken);
      taken.push_back(box);
      painter->GetPen()->SetColor(label.colour[0], label.colour[1], label.colour[2], 110);
      painter->GetPen()->SetWidth(1.0f);
      painter->DrawLine(x, y, std::clamp(x, box.left, box.right), std::clamp(y, box.low, box.high));
      painter->GetTextProp()->SetColor(
        label.colour[0] / 255.0, label.colour[1] / 255.0, label.colour[2] / 255.0);
      painter->DrawString(box.left + 2.0f, box.low + 2.0f, label.text);
    }
    return true;
  }

private:
  struct Box
  {
    float left, low, right, high;
    bool overlaps(const Box& other) const
    {
      return this->left < other.right && other.left < this->right && this->low < other.high &&
        other.low < this->high;
    }
  };

  static float pixel(vtkAxis* axis, double value, int component)
  {
    const double share = (value - axis->GetMinimum()) / (axis->GetMaximum() - axis->GetMinimum());
    const float first = axis->GetPosition1()[component];
    const float last = axis->GetPosition2()[component];
    return first + static_cast<float>(share) * (last - first);
  }

  /// Return the nearest free place for a text of this size: right of the point, above or below it,
  /// at growing distances. If all are occupied, return the last one.
  Box place(float x, float y, float width, float height, const std::vector<Box>& taken) const
  {
    const float boxWidth = width + 4.0f;
    const float boxHeight = height + 4.0f;
    const float leftmost = this->xAxis->GetPosition1().GetX();
    const float rightmost = this->xAxis->GetPosition2().GetX() - boxWidth;
    const float lowest = this->yAxis->GetPosition1().GetY();
    const float highest = this->yAxis->GetPosition2().GetY() - boxHeight;
    Box box{ 0.0f, 0.0f, 0.0f, 0.0f };
    for (int ring = 0; ring < 12; ++ring)
    {
      const float away = 12.0f + 18.0f * static_cast<float>(ring);
      const std::array<std::array<float, 2>, 5> candidates = {
        { { { x + away, y - boxHeight / 2 } }, { { x - boxWidth / 2, y + away } },
          { { x - boxWidth / 2, y - away - boxHeight } }, { { x + 12.0f, y + away } },
          { { x + 12.0f, y - away - boxHeight } } }
      };
      for (const std::array<float, 2>& candidate : candidates)
      {
        const float left = std::clamp(candidate[0], leftmost, std::max(leftmost, rightmost));
        const float low = std::clamp(candidate[1], lowest, std::max(lowest, highest));
        box = { left, low, left + boxWidth, low + boxHeight };
        if (std::none_of(
              taken.begin(), taken.end(), [&box](const Box& other) { return box.overlaps(other); }))
        {
          return box;
        }
      }
    }
    return box;
  }
};
vtkStandardNewMacro(PointLabels);

vtkSmartPointer<vtkTable> pointTable(const std::vector<std::array<double, 2>>& points)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  for (int column = 0; column < 2; ++column)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(column == 0 ? "x" : "y");
    for (const std::array<double, 2>& point : points)
    {
      values->InsertNextValue(point[static_cast<std::size_t>(column)]);
    }
    table->AddColumn(values);
  }
  return table;
}

void setUpAxis(vtkAxis* axis, const LogScale& scale, const char* title)
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const LogTick& tick : scale.ticks())
  {
    positions->InsertNextValue(tick.position);
    labels->InsertNextValue(tick.label);
  }
  axis->SetTitle(title);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(scale.lower(), scale.upper());
  axis->SetCustomTickPositions(positions, labels);
  axis->GetTitleProperties()->SetFontSize(15);
  axis->GetTitleProperties()->BoldOff();
  axis->GetLabelProperties()->SetFontSize(13);
  axis->GetGridPen()->SetColor(225, 225, 225);
}

void addLine(
  vtkChart* chart, const std::vector<std::array<double, 2>>& points, const Colour& colour)
{
  if (points.size() < 2)
  {
    return; // a line of one point is an error in VTK
  }
  vtkPlot* const line = chart->AddPlot(vtkChart::LINE);
  line->SetInputData(pointTable(points), 0, 1);
  line->SetColor(colour[0], colour[1], colour[2], 130);
  line->SetWidth(1.5f);
}

void addMarkers(
  vtkChart* chart, const std::vector<std::array<double, 2>>& points, const Colour& colour)
{
  auto* const marker = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::POINTS));
  marker->SetInputData(pointTable(points), 0, 1);
  marker->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  marker->SetMarkerSize(11.0f);
  marker->SetColor(colour[0], colour[1], colour[2], 255);
}

Picture draw(vtkChart* chart, PointLabels* labels)
{
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->AddItem(labels);
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetSize(chartWidth, chartHeight);
  window->AddRenderer(renderer);
  window->Render();
  return capture(window);
}

} // namespace

//------------------------------------------------------------------------------
LogScale::LogScale(const std::vector<double>& values, const std::string& unit)
{
  double smallest = 0.0; // of the positive values
  double largest = 0.0;
  bool hasZero = false;
  for (double value : values)
  {
    hasZero = hasZero || value == 0.0;
    if (value > 0.0)
    {
      smallest = smallest > 0.0 ? std::min(smallest, value) : value;
      largest = std::max(largest, value);
    }
  }
  if (smallest == 0.0) // only zeros still need an axis
  {
    smallest = 0.1;
    largest = 1.0;
  }
  const double first = roundToStep(smallest, -1);
  double last = roundToStep(largest, +1);
  last = last > first ? last : 10.0 * first;
  this->lower_ = std::log10(first);
  this->upper_ = std::log10(last);

  const bool wide = this->upper_ - this->lower_ > 2.5;
  for (double decade = std::pow(10.0, std::floor(this->lower_)); decade <= last * 1.001;
       decade *= 10.0)
  {
    for (double step : { 1.0, 2.0, 5.0 })
    {
      const double value = step * decade;
      if (value >= first * 0.999 && value <= last * 1.001 && (step == 1.0 || !wide))
      {
        this->ticks_.push_back({ std::log10(value), shortNumber(value) + unit });
      }
    }
  }
  const double margin = 0.04 * (this->upper_ - this->lower_);
  this->zero_ = this->lower_ - std::min(1.0, 0.15 * (this->upper_ - this->lower_));
  if (hasZero)
  {
    this->ticks_.insert(this->ticks_.begin(), { this->zero_, "0" });
    this->lower_ = this->zero_;
  }
  this->lower_ -= margin;
  this->upper_ += margin;
}

//------------------------------------------------------------------------------
double LogScale::position(double value) const
{
  return value > 0.0 ? std::log10(value) : this->zero_;
}

//------------------------------------------------------------------------------
Picture drawFront(const std::vector<ChartWay>& ways, const std::string& timeTitle,
  const std::string& timeUnit, const std::string& errorTitle, const std::string& errorUnit)
{
  std::vector<ErrorAndTime> numbers;
  std::vector<double> times;
  std::vector<double> errors;
  for (const ChartWay& way : ways)
  {
    numbers.push_back(way.of);
    times.push_back(way.of.time);
    errors.push_back(way.of.error);
  }
  const LogScale timeScale(times, timeUnit);
  const LogScale errorScale(errors, errorUnit);
  vtkNew<vtkChartXY> chart;
  chart->SetShowLegend(false);
  setUpAxis(chart->GetAxis(vtkAxis::BOTTOM), timeScale, timeTitle.c_str());
  setUpAxis(chart->GetAxis(vtkAxis::LEFT), errorScale, errorTitle.c_str());
  vtkNew<PointLabels> labels;
  labels->xAxis = chart->GetAxis(vtkAxis::BOTTOM);
  labels->yAxis = chart->GetAxis(vtkAxis::LEFT);
  for (const ErrorAndTime& of : numbers)
  {
    labels->points.push_back({ { timeScale.position(of.time), errorScale.position(of.error) } });
  }
  addMarkers(chart, labels->points, { { 190, 190, 190 } });
  const Colour colour = variantColour(0);
  std::vector<std::array<double, 2>> front;
  for (const std::size_t way : paretoFront(numbers))
  {
    front.push_back(labels->points[way]);
    labels->labels.push_back({ ways[way].name, colour, front.back()[0], front.back()[1] });
  }
  addLine(chart, front, colour);
  addMarkers(chart, front, colour);
  return draw(chart, labels);
}

//------------------------------------------------------------------------------
Picture drawTimes(const std::vector<ChartLine>& lines)
{
  std::vector<double> quantities;
  std::vector<double> times;
  for (const ChartLine& line : lines)
  {
    for (const auto& [x, y] : line.points)
    {
      quantities.push_back(x);
      times.push_back(y);
    }
  }
  const LogScale xScale(quantities, "");
  const LogScale yScale(times, " ms");

  vtkNew<vtkChartXY> chart;
  chart->SetShowLegend(false);
  setUpAxis(chart->GetAxis(vtkAxis::BOTTOM), xScale, "");
  setUpAxis(chart->GetAxis(vtkAxis::LEFT), yScale, "time per frame");
  const double roomForNames = 0.25 * (xScale.upper() - xScale.lower());
  chart->GetAxis(vtkAxis::BOTTOM)->SetRange(xScale.lower(), xScale.upper() + roomForNames);
  vtkNew<PointLabels> labels;
  labels->xAxis = chart->GetAxis(vtkAxis::BOTTOM);
  labels->yAxis = chart->GetAxis(vtkAxis::LEFT);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    std::vector<std::array<double, 2>> points;
    for (const auto& [x, y] : lines[i].points)
    {
      points.push_back({ { xScale.position(x), yScale.position(y) } });
    }
    if (!points.empty())
    {
      addLine(chart, points, variantColour(i));
      addMarkers(chart, points, variantColour(i));
      labels->points.insert(labels->points.end(), points.begin(), points.end());
      labels->labels.push_back(
        { lines[i].name, variantColour(i), points.back()[0], points.back()[1] });
    }
  }
  return draw(chart, labels);
}

} // namespace gnomon::tool
