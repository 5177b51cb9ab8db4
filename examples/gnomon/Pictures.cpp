#include "Pictures.h"

#include "plugin/vtkGnomonOffScreenWindow.h"

#include <vtkBase64Utilities.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cstddef>

namespace gnomon::tool
{
namespace
{

/// Return the index of a pixel's first byte.
std::ptrdiff_t byteOf(const Picture& picture, int x, int y)
{
  return static_cast<std::ptrdiff_t>(3) * (y * picture.width + x);
}

int leftOf(std::size_t panel, int columns)
{
  return static_cast<int>(panel) * (columns + panelGapColumns);
}

/// Return the strip with the titles, each centred above its panel.
Picture drawTitles(const std::vector<Panel>& panels, int width)
{
  constexpr int titlePixels = 22;
  constexpr double titleGrey = 0.1;
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
  const auto window = makeOffScreenWindow();
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
    std::copy_n(from.rgb.begin() + byteOf(from, 0, y), 3 * from.width,
      to.rgb.begin() + byteOf(to, left, top + y));
  }
}

} // namespace

Picture sideBySide(const std::vector<Panel>& panels)
{
  const Picture& first = panels.at(0).picture;
  Picture joined{ leftOf(panels.size(), first.width) - panelGapColumns,
    panelTitleRows + first.height, {} };
  joined.rgb.assign(3 * joined.pixelCount(), 255);
  paste(drawTitles(panels, joined.width), joined, 0, 0);
  for (std::size_t i = 0; i < panels.size(); ++i)
  {
    paste(panels[i].picture, joined, leftOf(i, first.width), panelTitleRows);
  }
  return joined;
}

std::optional<Place> worstPlace(
  const std::vector<float>& differences, int width, int height, int side)
{
  side = std::min({ side, width, height });
  const int step = std::max(1, side / 2);
  std::optional<Place> worst;
  double most = 0.0;
  for (int top = 0; top < height; top += step)
  {
    for (int left = 0; left < width; left += step)
    {
      const Place place{ std::min(left, width - side), std::min(top, height - side), side };
      double sum = 0.0;
      for (int i = 0; i < side * side; ++i)
      {
        const int pixel = (place.top + i / side) * width + place.left + i % side;
        const double difference = differences[static_cast<std::size_t>(pixel)];
        sum += difference * difference;
      }
      if (sum > most)
      {
        most = sum;
        worst = place;
      }
    }
  }
  return worst;
}

Picture cropped(const Picture& picture, const Place& place)
{
  Picture result{ place.side, place.side, {} };
  for (int y = place.top; y < place.top + place.side; ++y)
  {
    const auto row = picture.rgb.begin() + byteOf(picture, place.left, y);
    result.rgb.insert(result.rgb.end(), row, row + 3 * place.side);
  }
  return result;
}

Picture reduced(const Picture& picture, int mostPixels)
{
  const int block =
    std::max(1, (std::max(picture.width, picture.height) + mostPixels - 1) / mostPixels);
  const int columns = std::min(block, picture.width);
  const int rows = std::min(block, picture.height);
  Picture result{ picture.width / columns, picture.height / rows, {} };
  for (int i = 0; i < 3 * result.width * result.height; ++i)
  {
    const int x = columns * (i / 3 % result.width);
    const int y = rows * (i / 3 / result.width);
    int sum = 0;
    for (int k = 0; k < rows * columns; ++k)
    {
      const std::ptrdiff_t byte = byteOf(picture, x + k % columns, y + k / columns) + i % 3;
      sum += picture.rgb[static_cast<std::size_t>(byte)];
    }
    result.rgb.push_back(static_cast<unsigned char>(sum / (rows * columns)));
  }
  return result;
}

std::string dataUri(const Picture& picture)
{
  if (picture.rgb.empty())
  {
    return {};
  }
  const std::vector<unsigned char> png = encodePng(picture);
  std::vector<unsigned char> text((png.size() + 2) / 3 * 4);
  vtkBase64Utilities::Encode(png.data(), static_cast<unsigned long>(png.size()), text.data());
  return "data:image/png;base64," + std::string(text.begin(), text.end());
}

} // namespace gnomon::tool
