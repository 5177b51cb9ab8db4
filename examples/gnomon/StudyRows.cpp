#include "StudyRows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace gnomon::tool
{
namespace
{

/// The side of a pixel in the pictures of the worst places.
constexpr int enlargement = 3;

/// Return two pictures of one height side by side, with a white strip between them.
Picture joined(const Picture& left, const Picture& right)
{
  constexpr int gap = 6;
  Picture result;
  result.width = left.width + gap + right.width;
  result.height = left.height;
  for (int y = 0; y < result.height; ++y)
  {
    const auto addRow = [&](const Picture& from)
    {
      const auto row = from.rgb.begin() + static_cast<std::ptrdiff_t>(3 * y * from.width);
      result.rgb.insert(result.rgb.end(), row, row + 3 * from.width);
    };
    addRow(left);
    result.rgb.insert(result.rgb.end(), 3 * gap, 255);
    addRow(right);
  }
  return result;
}

} // namespace

//------------------------------------------------------------------------------
std::string StudyCase::name() const
{
  return this->scene +
    (this->view < 0 ? std::string() : ", view " + std::to_string(this->view + 1));
}

//------------------------------------------------------------------------------
std::vector<StudyRow> rowsOf(const StudyCase& of, const ComparisonResults& results)
{
  const auto find = [&](const std::string& name) -> const VariantResult&
  {
    return *std::find_if(results.variants.begin(), results.variants.end(),
      [&](const VariantResult& variant) { return variant.name == name; });
  };
  const VariantResult& plain = find(plainTechnique);
  const VariantResult& truth = find(results.truth);
  std::vector<StudyRow> rows;
  for (const VariantResult& variant : results.variants)
  {
    StudyRow row;
    row.of = of;
    row.variant = variant.name;
    row.technique = variant.technique;
    row.wrongShare = variant.error.share(variant.error.wrongPixels());
    row.rootMeanSquare = variant.error.rootMeanSquare;
    row.meanAbsolute = variant.error.meanAbsolute;
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      row.milliseconds[motion] = variant.timings[motion].milliseconds;
      row.overPlain[motion] = row.milliseconds[motion] / plain.timings[motion].milliseconds;
    }
    if (variant.worst)
    {
      row.worst = joined(enlarged(truth.picture, *variant.worst, enlargement),
        enlarged(variant.picture, *variant.worst, enlargement));
    }
    rows.push_back(row);
  }
  return rows;
}

//------------------------------------------------------------------------------
std::vector<StudySummary> summarise(const std::vector<StudyRow>& rows)
{
  std::vector<std::string> order;
  std::map<std::string, std::vector<const StudyRow*>> ofVariants;
  std::size_t cases = 0;
  for (const StudyRow& row : rows)
  {
    std::vector<const StudyRow*>& ofVariant = ofVariants[row.variant];
    if (ofVariant.empty())
    {
      order.push_back(row.variant);
    }
    ofVariant.push_back(&row);
    cases = std::max(cases, ofVariant.size());
  }
  std::vector<StudySummary> summaries;
  for (const std::string& variant : order)
  {
    const std::vector<const StudyRow*>& ofVariant = ofVariants[variant];
    if (ofVariant.size() < cases)
    {
      continue;
    }
    StudySummary summary{ variant, ofVariant.front()->technique };
    const auto count = static_cast<double>(cases);
    for (const StudyRow* row : ofVariant)
    {
      summary.error += row->error() / count;
    }
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      double logarithms = 0.0;
      for (const StudyRow* row : ofVariant)
      {
        logarithms += std::log(row->overPlain[motion]);
      }
      summary.overPlain[motion] = std::exp(logarithms / count);
    }
    summaries.push_back(summary);
  }
  return summaries;
}

} // namespace gnomon::tool
