#include "Panels.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

constexpr int columns = 120;
constexpr int rows = 50;

/// A panel of one grey, with a column of its own colour at either side.
Panel greyPanel(const std::string& title, unsigned char grey)
{
  Panel panel{ title, { columns, rows, {} } };
  panel.picture.rgb.assign(3 * panel.picture.pixelCount(), grey);
  for (int y = 0; y < rows; ++y)
  {
    panel.picture.rgb[3 * y * columns] = static_cast<unsigned char>(grey + 1);
    panel.picture.rgb[3 * (y * columns + columns - 1)] = static_cast<unsigned char>(grey + 2);
  }
  return panel;
}

/// A part of a picture.
Picture cut(const Picture& from, int left, int top, int width, int height)
{
  Picture part{ width, height, {} };
  for (int y = top; y < top + height; ++y)
  {
    const auto begin = from.rgb.begin() + 3 * (y * from.width + left);
    part.rgb.insert(part.rgb.end(), begin, begin + 3 * width);
  }
  return part;
}

TEST(Panels, StandSideBySideBelowTheirTitles)
{
  const std::vector<Panel> panels = { greyPanel("one", 10), greyPanel("two", 100),
    greyPanel("", 200) };
  const Picture joined = sideBySide(panels);
  ASSERT_EQ(joined.width, 3 * columns + 2 * panelGapColumns);
  ASSERT_EQ(joined.height, panelTitleRows + rows);
  std::vector<Picture> titles;
  for (int i = 0; i < 3; ++i)
  {
    const int left = i * (columns + panelGapColumns);
    EXPECT_EQ(cut(joined, left, panelTitleRows, columns, rows).rgb, panels[i].picture.rgb) << i;
    titles.push_back(cut(joined, left, 0, columns, panelTitleRows));
  }
  EXPECT_THAT(cut(joined, columns, panelTitleRows, panelGapColumns, rows).rgb, testing::Each(255));
  EXPECT_LT(*std::min_element(titles[0].rgb.begin(), titles[0].rgb.end()), 100);
  EXPECT_LT(*std::min_element(titles[1].rgb.begin(), titles[1].rgb.end()), 100);
  EXPECT_THAT(titles[2].rgb, testing::Each(255)) << "there is no title";
  EXPECT_NE(titles[0].rgb, titles[1].rgb);
}

TEST(Panels, OfDifferentSizesAreRefused)
{
  Panel other = greyPanel("two", 100);
  other.picture.width = rows;
  other.picture.height = columns;
  EXPECT_THROW(sideBySide({ greyPanel("one", 10), other }), std::invalid_argument);
}

} // namespace
} // namespace gnomon::tool
