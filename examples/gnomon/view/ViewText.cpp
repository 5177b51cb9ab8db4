#include "view/ViewText.h"

#include "Text.h"
#include "view/ViewKeys.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkTextProperty.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::tool
{
namespace
{

constexpr int marginPixels = 6;

/// Light letters on a dark ground, which can be read before all scenes.
void styleText(vtkTextActor* text, bool inColumns)
{
  vtkTextProperty* const look = text->GetTextProperty();
  look->SetColor(1.0, 1.0, 1.0);
  look->SetBackgroundColor(0.05, 0.06, 0.08);
  look->SetBackgroundOpacity(0.72);
  if (inColumns)
  {
    look->SetFontFamilyToCourier();
  }
}

std::string asOneText(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines)
  {
    text += (text.empty() ? " " : "\n ") + line + " ";
  }
  return text;
}

std::string countAndShare(std::int64_t pixels, const VisibilityError& error)
{
  char text[64];
  std::snprintf(text, sizeof text, "%lld (%.2f %%)", static_cast<long long>(pixels),
    100.0 * error.share(pixels));
  return text;
}

/// What stands behind the colours of pixels.
std::vector<std::string> legendOf(const ViewState& state, ViewPass* pass)
{
  if (!pass->complaint().empty())
  {
    return { nameOf(state.show) + ": " + pass->complaint() };
  }
  if (pass->error())
  {
    const VisibilityError& error = *pass->error();
    return { "wrong pixels: " + countAndShare(error.wrongPixels(), error),
      "blue: false light " + countAndShare(error.falseLight, error),
      "red: false shadow " + countAndShare(error.falseShadow, error), "purple: traced" };
  }
  switch (state.show)
  {
    case Show::Classes:
      return { "how pixels were decided" };
    case Show::Texels:
      return { "texels: red larger than pixels, blue smaller" };
    default:
      return {};
  }
}

/// Breaks a sentence into lines.
std::vector<std::string> brokenIntoLines(const std::string& sentence)
{
  constexpr std::size_t mostLetters = 60;
  std::vector<std::string> lines(1);
  for (const std::string& word : splitWords(sentence))
  {
    if (lines.back().size() + word.size() >= mostLetters)
    {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// Where the picture is not what was asked for: lights that refuse the technique, and maps that are
/// smaller than the overlays say.
std::vector<std::string> reservations(const ViewState& state, const FrameReport& report)
{
  std::vector<std::string> lines;
  for (const std::string& misfit : report.misfits)
  {
    const std::vector<std::string> more = brokenIntoLines(misfit);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  const bool overlaid = state.frusta || state.show == Show::Texels;
  for (const LightReport& light : report.lights)
  {
    if (overlaid && light.sceneIndex == static_cast<int>(state.light) && light.fit == "receivers")
    {
      lines.emplace_back("fitted to receivers: the map holds less than shown");
    }
  }
  return lines;
}

/// "auto: silhouette", "pssm, map 1024".
std::string techniqueLine(const ViewState& state, const FrameReport& report)
{
  if (state.show == Show::Truth)
  {
    return "the truth: every pixel traced";
  }
  std::string text = state.technique;
  for (const LightReport& light : report.lights)
  {
    if (light.casts)
    {
      text += light.technique != state.technique ? ": " + light.technique : "";
      text += light.mapSizeTexels > 0 ? ", map " + std::to_string(light.mapSizeTexels) : "";
      break;
    }
  }
  return text;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<std::string> linesOf(const ViewState& state, ViewPass* pass)
{
  std::vector<std::string> lines = { techniqueLine(state, pass->shown()->GetReport()) };
  const std::vector<std::string> legend = legendOf(state, pass);
  lines.insert(lines.end(), legend.begin(), legend.end());
  const std::vector<std::string> more = reservations(state, pass->shown()->GetReport());
  lines.insert(lines.end(), more.begin(), more.end());
  if (state.sun)
  {
    char elevation[48];
    std::snprintf(
      elevation, sizeof elevation, ", %.1f degrees high", placeOf(*state.sun).elevationDegrees);
    lines.push_back("sun " + state.sun->time() + elevation);
  }
  return lines;
}

//------------------------------------------------------------------------------
ViewText::ViewText(vtkRenderer* renderer)
{
  styleText(this->corner_, false);
  styleText(this->help_, true);
  this->corner_->GetTextProperty()->SetVerticalJustificationToTop();
  this->help_->GetTextProperty()->SetVerticalJustificationToBottom();
  this->help_->SetPosition(marginPixels, marginPixels);
  renderer->AddViewProp(this->corner_);
  renderer->AddViewProp(this->help_);
}

//------------------------------------------------------------------------------
void ViewText::show(
  const std::vector<std::string>& lines, const ViewState& state, const int size[2])
{
  this->corner_->SetInput(asOneText(lines).c_str());
  this->corner_->GetTextProperty()->SetFontSize(std::clamp(size[1] / 38, 10, 18));
  this->corner_->SetPosition(marginPixels, size[1] - marginPixels);
  this->help_->SetVisibility(state.help);
  if (state.help)
  {
    const auto rows = static_cast<double>(viewKeys().size() + lines.size() + 4);
    constexpr double rowsOfFont = 1.28;   // a row's height in sizes of the font, and
    constexpr double columnsOfFont = 0.6; // a letter's width
    constexpr double columns = 78.0;
    const double most = std::min(size[1] / rows / rowsOfFont, size[0] / columns / columnsOfFont);
    this->help_->SetInput(helpText(state).c_str());
    this->help_->GetTextProperty()->SetFontSize(std::clamp(static_cast<int>(most), 6, 16));
  }
}

} // namespace gnomon::tool
