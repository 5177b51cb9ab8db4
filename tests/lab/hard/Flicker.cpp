#include "Flicker.h"

#include "Errors.h"

#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/Registry.h"

#include <vtkCamera.h>
#include <vtkMath.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::hard
{
namespace
{

using tool::FrameVariant;
using tool::Motion;

void moveAside(FrameVariant& variant, double texels)
{
  double bounds[6];
  variant.renderer()->ComputeVisiblePropBounds(bounds);
  const double diagonal =
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  const double distance = texels * diagonal / variant.spec().mapSizeTexels;
  vtkCamera* const camera = variant.renderer()->GetActiveCamera();
  std::array<double, 3> position;
  std::array<double, 3> target;
  std::array<double, 3> aside;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(target.data());
  vtkMath::Cross(camera->GetDirectionOfProjection(), camera->GetViewUp(), aside.data());
  vtkMath::Normalize(aside.data());
  for (std::size_t k = 0; k < 3; ++k)
  {
    position[k] += distance * aside[k];
    target[k] += distance * aside[k];
  }
  camera->SetPosition(position.data());
  camera->SetFocalPoint(target.data());
}

const std::vector<float>& draw(FrameVariant& variant, Motion motion, int step)
{
  variant.pass()->KeepVisibilityOn();
  variant.drawFrame(motion, step);
  const VisibilityImages& kept = variant.pass()->GetVisibility();
  if (kept.visibility.empty())
  {
    throw tool::Failure(variant.spec().name() + ": no light casts a shadow");
  }
  return kept.visibility.front();
}

/// Draw the first light's visibility with maps fitted to the camera at this step, seen from the
/// first camera position.
const std::vector<float>& drawFitted(FrameVariant& variant, Movement movement, int step)
{
  variant.renderer()->SetPass(tool::makePass(variant.spec())); // a new pass, fitted once here
  if (movement == Movement::CameraTurned)
  {
    draw(variant, Motion::Camera, step);
  }
  else
  {
    moveAside(variant, 0.1 * step);
    draw(variant, Motion::Static, 0);
    moveAside(variant, -0.1 * step);
  }
  return draw(variant, Motion::Static, 0);
}

/// Count pixels whose neighbour to the right or below has other visibility.
std::size_t countEdges(const std::vector<float>& truth, std::size_t width)
{
  std::size_t edges = 0;
  for (std::size_t i = 0; i + width < truth.size(); ++i)
  {
    edges += (i + 1) % width != 0 && (truth[i] != truth[i + 1] || truth[i] != truth[i + width]);
  }
  return edges;
}

} // namespace

Frames drawMovement(tool::VariantSpec spec, const tool::Scene& scene, int width, int height,
  Movement movement, int steps)
{
  const bool fits =
    spec.settings.count("fit") || findTechnique(spec.technique)->projection != Projection::Uniform;
  if (fits && movement != Movement::LightTurned)
  {
    spec.settings["fit"] = "once";
  }
  FrameVariant variant(spec, scene, width, height);
  Frames frames;
  for (int step = 0; step <= steps; ++step)
  {
    frames.push_back(movement == Movement::LightTurned ? draw(variant, Motion::Light, step)
        : fits                                         ? drawFitted(variant, movement, step)
                                                       : draw(variant, Motion::Static, 0));
  }
  return frames;
}

double flicker(const Frames& frames, const Frames& truth, int width)
{
  const auto isWrong = [&](std::size_t frame, std::size_t pixel)
  { return !(std::abs(frames[frame][pixel] - truth[frame][pixel]) <= 0.5f); };
  std::size_t turned = 0;
  std::size_t edges = 0;
  for (std::size_t frame = 1; frame < frames.size(); ++frame)
  {
    edges += countEdges(truth[frame], static_cast<std::size_t>(width));
    for (std::size_t pixel = 0; pixel < truth[frame].size(); ++pixel)
    {
      turned += isWrong(frame, pixel) != isWrong(frame - 1, pixel);
    }
  }
  return edges == 0 ? 0.0 : static_cast<double>(turned) / static_cast<double>(edges);
}

} // namespace gnomon::hard
