#pragma once

#include "Text.h"
#include "view/ViewKeys.h"
#include "view/ViewPass.h"
#include "view/ViewState.h"

#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A line of a legend, on the colour that it explains.
struct LegendLine
{
  std::string text;
  std::array<std::uint8_t, 3> colour;
};
/// The description of a picture that does not show the technique alone; else empty.
struct Caption
{
  std::vector<std::string> lines;
  std::vector<LegendLine> legend; ///< of the pixels' colours
};
/// The text over a view: lines in the upper left corner, a legend below them, or the keys if asked
/// for.
class ViewText
{
public:
  static Caption captionOf(const ViewState& state, ViewPass* pass)
  {
    if (!pass->complaint().empty())
    {
      return { { nameOf(state.show) + ": " + pass->complaint() }, {} };
    }
    if (pass->error())
    {
      const VisibilityError& error = *pass->error();
      return { { "wrong pixels: " + countAndShare(error.wrongPixels(), error) },
        { { "false light " + countAndShare(error.falseLight, error), { 64, 128, 255 } },
          { "false shadow " + countAndShare(error.falseShadow, error), { 255, 48, 48 } },
          { "traced", { 108, 40, 135 } } } };
    }
    switch (state.show)
    {
      case Show::Classes:
        return { { "how pixels were decided:" },
          classesOf(pass->shown()->GetVisibility(), state.light) };
      case Show::Texels:
        return { { "how large the map's texels look:" },
          { { "as 4 pixels or more", { 255, 38, 26 } }, { "as a pixel", { 255, 255, 255 } },
            { "as a quarter or less", { 26, 77, 255 } } } };
      default:
        return {};
    }
  }

  /// Return lines that describe a frame: technique, wrong pixels, sun.
  static std::vector<std::string> linesOf(const ViewState& state, ViewPass* pass)
  {
    std::vector<std::string> lines = { techniqueLine(state, pass->shown()->GetReport()) };
    const std::vector<std::string> caption = captionOf(state, pass).lines;
    lines.insert(lines.end(), caption.begin(), caption.end());
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

  /// @param renderer draws the text
  explicit ViewText(vtkRenderer* renderer)
    : renderer_(renderer)
  {
    styleText(this->corner_, false);
    styleText(this->help_, true);
    this->corner_->GetTextProperty()->SetVerticalJustificationToTop();
    this->help_->GetTextProperty()->SetVerticalJustificationToBottom();
    this->help_->SetPosition(marginPixels, marginPixels);
    renderer->AddViewProp(this->corner_);
    renderer->AddViewProp(this->help_);
  }

  /// Fit the text to the picture's size.
  void show(const std::vector<std::string>& lines, const std::vector<LegendLine>& legend,
    const ViewState& state, const int size[2])
  {
    const int fontSize = std::clamp(size[1] / 38, 10, 18);
    this->corner_->SetInput(asOneText(lines).c_str());
    this->corner_->GetTextProperty()->SetFontSize(fontSize);
    this->corner_->SetPosition(marginPixels, size[1] - marginPixels);
    this->showLegend(state.help ? std::vector<LegendLine>() : legend, fontSize);
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

  std::string corner() const { return this->corner_->GetInput(); }

private:
  static constexpr int marginPixels = 6;

  /// Make light letters on a dark ground, which are legible over all scenes.
  static void styleText(vtkTextActor* text, bool inColumns)
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

  static std::string asOneText(const std::vector<std::string>& lines)
  {
    std::string text;
    for (const std::string& line : lines)
    {
      text += (text.empty() ? " " : "\n ") + line + " ";
    }
    return text;
  }

  static std::string countAndShare(std::int64_t pixels, const VisibilityError& error)
  {
    char text[64];
    std::snprintf(text, sizeof text, "%lld (%.2f %%)", static_cast<long long>(pixels),
      100.0 * error.share(pixels));
    return text;
  }

  static std::vector<LegendLine> classesOf(const VisibilityImages& images, std::size_t light)
  {
    const auto found =
      std::find(images.sceneIndices.begin(), images.sceneIndices.end(), static_cast<int>(light));
    if (found == images.sceneIndices.end())
    {
      return {};
    }
    const ClassImage& image =
      images.classes[static_cast<std::size_t>(found - images.sceneIndices.begin())];
    std::vector<std::size_t> counts(image.classes.size(), 0);
    for (const std::uint8_t index : image.ofPixels)
    {
      ++counts[index];
    }
    std::vector<LegendLine> legend;
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      if (counts[i] > 0)
      {
        legend.push_back(
          { image.classes[i].name + " " + std::to_string(counts[i]), image.classes[i].colour });
      }
    }
    return legend;
  }

  static std::vector<std::string> brokenIntoLines(const std::string& sentence)
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

  /// Return how the picture differs from the request: lights that refuse the technique, and maps
  /// that are smaller than their overlays.
  static std::vector<std::string> reservations(const ViewState& state, const FrameReport& report)
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
  static std::string techniqueLine(const ViewState& state, const FrameReport& report)
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

  void showLegend(const std::vector<LegendLine>& legend, int fontSize)
  {
    while (this->legend_.size() < legend.size())
    {
      auto& text = this->legend_.emplace_back(vtkSmartPointer<vtkTextActor>::New());
      styleText(text, false);
      text->GetTextProperty()->SetBackgroundOpacity(1.0);
      text->GetTextProperty()->SetVerticalJustificationToTop();
      this->renderer_->AddViewProp(text);
    }
    double box[4]; // x and y, smallest and largest in turn, from the text's position
    this->corner_->GetBoundingBox(this->renderer_, box);
    double top = this->corner_->GetPosition()[1] + box[2] - marginPixels;
    for (std::size_t i = 0; i < this->legend_.size(); ++i)
    {
      vtkTextActor* const text = this->legend_[i];
      text->SetVisibility(i < legend.size());
      if (i < legend.size())
      {
        const auto& [red, green, blue] = legend[i].colour;
        const double ink = 0.3 * red + 0.6 * green + 0.1 * blue > 120.0 ? 0.0 : 1.0;
        text->SetInput((" " + legend[i].text + " ").c_str());
        text->GetTextProperty()->SetColor(ink, ink, ink);
        text->GetTextProperty()->SetBackgroundColor(red / 255.0, green / 255.0, blue / 255.0);
        text->GetTextProperty()->SetFontSize(fontSize);
        text->SetPosition(marginPixels, top);
        text->GetBoundingBox(this->renderer_, box);
        top += box[2] - 1.0;
      }
    }
  }

  vtkRenderer* renderer_;
  vtkNew<vtkTextActor> corner_;
  std::vector<vtkSmartPointer<vtkTextActor>> legend_; ///< as many as were ever needed
  vtkNew<vtkTextActor> help_;
};

} // namespace gnomon::tool
