#include "Panels.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

constexpr int titlePixels = 22;
constexpr double titleGrey = 0.1;

int leftOf(std::size_t panel, int columns)
{
  return static_cast<int>(panel) * (columns + panelGapColumns);
}

/// Return the strip with the titles, each centred above its panel.
Picture drawTitles(const std::vector<Panel>& panels, int width)
{
  const int columns = panels.front().picture.width;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  for (std::size_t i = 0; i < panels.size(); ++i)
  {
    vtkNew<vtkTextActor> title;
    title->SetInput(panels[i].title.c_str());
    title->SetPosition(leftOf(i, columns) + columns / 2, panelTitleRows / 2);
    vtkTextProperty* const text = title->GetTextProperty();
    text->SetFontSize(titlePixels);
    text->SetColor(titleGrey, titleGrey, titleGrey);
    text->SetJustificationToCentered();
    text->SetVerticalJustificationToCentered();
    renderer->AddViewProp(title);
  }
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetSize(width, panelTitleRows);
  window->AddRenderer(renderer);
  window->Render();
  return capture(window);
}

/// Copy a picture into a larger one, with its top left corner at (left, top).
void paste(const Picture& from, Picture& to, int left, int top)
{
  for (int y = 0; y < from.height; ++y)
  {
    std::copy_n(from.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * from.width,
      static_cast<std::ptrdiff_t>(3) * from.width,
      to.rgb.begin() + static_cast<std::ptrdiff_t>(3) * ((top + y) * to.width + left));
  }
}

} // namespace

//------------------------------------------------------------------------------
Picture sideBySide(const std::vector<Panel>& panels)
{
  const int columns = panels.at(0).picture.width;
  const int rows = panels.at(0).picture.height;
  if (std::any_of(panels.begin(), panels.end(),
        [&](const Panel& panel)
        { return panel.picture.width != columns || panel.picture.height != rows; }))
  {
    throw std::invalid_argument("panels of different sizes");
  }
  Picture joined;
  joined.width = leftOf(panels.size(), columns) - panelGapColumns;
  joined.height = panelTitleRows + rows;
  joined.rgb.assign(3 * joined.pixelCount(), 255);
  paste(drawTitles(panels, joined.width), joined, 0, 0);
  for (std::size_t i = 0; i < panels.size(); ++i)
  {
    paste(panels[i].picture, joined, leftOf(i, columns), panelTitleRows);
  }
  return joined;
}

} // namespace gnomon::tool
