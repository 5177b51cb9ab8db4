#pragma once

#include "view/ViewPass.h"
#include "view/ViewState.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <string>
#include <vector>

namespace gnomon::tool
{

/// What a frame shows, a line each: its technique, what its colours mean, its errors, its sun.
std::vector<std::string> linesOf(const ViewState& state, ViewPass* pass);

/// The text over a view: lines in the upper left corner, and the keys if asked for.
class ViewText
{
public:
  /// @param renderer that draws it
  explicit ViewText(vtkRenderer* renderer);

  /// As large as the picture lets it be.
  void show(const std::vector<std::string>& lines, const ViewState& state, const int size[2]);

  std::string corner() const { return this->corner_->GetInput(); }

private:
  vtkNew<vtkTextActor> corner_;
  vtkNew<vtkTextActor> help_;
};

} // namespace gnomon::tool
