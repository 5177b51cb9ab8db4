#include "FrameCheck.h"

#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::fuzz
{
namespace
{

std::ptrdiff_t countOutside(const std::vector<float>& values, float least, float most)
{
  return std::count_if(
    values.begin(), values.end(), [=](float value) { return !(value >= least && value <= most); });
}

/// True if the frame's report states the reason of an error or warning.
bool isTold(const std::string& text, const FrameReport& report)
{
  const auto holds = [&text](const std::string& reason)
  { return !reason.empty() && text.find(reason) != std::string::npos; };
  return holds(report.routeReason) ||
    std::any_of(report.misfits.begin(), report.misfits.end(), holds) ||
    std::any_of(report.leftOut.begin(), report.leftOut.end(), holds);
}

} // namespace

//------------------------------------------------------------------------------
void checkFrame(vtkGnomonShadowPass* pass, const tool::VtkMessages& messages)
{
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
  {
    throw Find("OpenGL error " + std::to_string(error));
  }
  for (const auto* texts : { &messages.errors(), &messages.warnings() })
  {
    for (const std::string& text : *texts)
    {
      if (!isTold(text, pass->GetReport()))
      {
        throw Find("VTK says: " + text);
      }
    }
  }
  const VisibilityImages& kept = pass->GetVisibility();
  std::ptrdiff_t broken = 0;
  for (const std::vector<float>& visibility : kept.visibility)
  {
    broken += countOutside(visibility, 0.0f, 1.0f);
  }
  constexpr float most = std::numeric_limits<float>::max();
  for (const auto* plane : { &kept.positionX, &kept.positionY, &kept.positionZ, &kept.normalX,
         &kept.normalY, &kept.normalZ })
  {
    broken += countOutside(*plane, -most, most);
  }
  if (broken > 0)
  {
    throw Find(std::to_string(broken) + " numbers are no visibilities, or not finite");
  }
}

} // namespace gnomon::fuzz
