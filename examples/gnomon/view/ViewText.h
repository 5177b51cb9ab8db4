#pragma once

#include "view/ViewPass.h"
#include "view/ViewState.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Return lines that describe a frame: technique, wrong pixels, sun.
std::vector<std::string> linesOf(const ViewState& state, ViewPass* pass);

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
Caption captionOf(const ViewState& state, ViewPass* pass);

/// The text over a view: lines in the upper left corner, a legend below them, or the keys if asked
/// for.
class ViewText
{
public:
  /// @param renderer draws the text
  explicit ViewText(vtkRenderer* renderer);

  /// Fit the text to the picture's size.
  void show(const std::vector<std::string>& lines, const std::vector<LegendLine>& legend,
    const ViewState& state, const int size[2]);

  std::string corner() const { return this->corner_->GetInput(); }

private:
  void showLegend(const std::vector<LegendLine>& legend, int fontSize);

  vtkRenderer* renderer_;
  vtkNew<vtkTextActor> corner_;
  std::vector<vtkSmartPointer<vtkTextActor>> legend_; ///< as many as were ever needed
  vtkNew<vtkTextActor> help_;
};

} // namespace gnomon::tool
