#include "vtkGnomonFlatteringLights.h"

#include "lights/Bounds.h"
#include "lights/vtkGnomonLightKeys.h"
#include "lights/vtkGnomonLightPlacement.h"
#include "plugin/data/CoarsePicture.h"
#include "plugin/scene/OccluderCollector.h"
#include "plugin/scene/ShownView.h"

#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

vtkStandardNewMacro(vtkGnomonFlatteringLights);

namespace
{

/// White surfaces that face both lights stay just below white.
constexpr double keyIntensity = 0.8;
constexpr double fillIntensity = 0.4;

/// Make a light a directional scene light that shines on a box.
/// @param towards the light, of any length, in the camera's view space
void place(vtkLight* light, const glm::dvec3& towardsView, vtkCamera* camera, const double box[6])
{
  const auto& rows = camera->GetViewTransformMatrix()->Element; // right, up and back
  glm::dvec3 towards(0.0);
  for (int row = 0; row < 3; ++row)
  {
    towards += towardsView[row] * glm::make_vec3(rows[row]);
  }
  light->SetLightTypeToSceneLight();
  light->SetTransformMatrix(nullptr);
  light->PositionalOff();
  light->SetPosition(glm::value_ptr(towards));
  light->SetFocalPoint(0.0, 0.0, 0.0);
  vtkGnomonLightPlacement::ShineOnBox(light, box);
}

std::string percent(double share)
{
  return std::to_string(std::lround(100.0 * share)) + " %";
}

std::string noteOn(const gnomon::CoarsePicture& picture, const gnomon::CoarsePicture::Choice& key)
{
  const std::string degrees = std::to_string(std::lround(std::abs(key.direction.left)));
  std::string note = "The key light shines from " + degrees + " degrees to the " +
    (key.direction.left > 0.0 ? "left" : "right") + " of the camera and " +
    std::to_string(std::lround(key.direction.above)) + " above it. It lights " +
    percent(key.shares.lit) + " of the visible props, and " +
    (picture.hasGround() ? percent(key.shares.inShadow) +
          " of what lies below or behind them "
          "is in shadow."
                         : "nothing lies below or behind them, so shade on the props counts.");
  if (!gnomon::showsShadow(key.shares))
  {
    note += " No direction tried both lights 50 % and has 5 % in shadow; this is the best found.";
  }
  return note;
}

} // namespace

//------------------------------------------------------------------------------
bool vtkGnomonFlatteringLights::Make(vtkRenderer* renderer, vtkLight* key, vtkLight* fill)
{
  this->Note.clear();
  this->LitShare = this->ShadowShare = 0.0;
  this->Modified();
  if (!renderer || !key || !fill)
  {
    vtkErrorMacro("Flattering lights need a renderer and two lights, not null.");
    return false;
  }
  double box[6];
  renderer->ComputeVisiblePropBounds(box);
  const gnomon::Bounds bounds{ { box[0], box[2], box[4] }, { box[1], box[3], box[5] } };
  if (!(bounds.radius() > 0.0) || !gnomon::isWithin(bounds, gnomon::largestOfWorld))
  {
    vtkErrorMacro("The renderer shows nothing to place lights for.");
    return false;
  }
  vtkCamera* const camera = renderer->GetActiveCamera();
  const double* const matrix = camera->GetViewTransformMatrix()->GetData();
  if (!std::all_of(matrix, matrix + 16, [](double number) { return std::isfinite(number); }))
  {
    vtkErrorMacro("Lights cannot be placed: the camera looks nowhere.");
    return false;
  }
  gnomon::KeyDirection direction;
  try
  {
    gnomon::OccluderCollector collector;
    collector.collect(renderer);
    const gnomon::Occluders& occluders = collector.occluders();
    const gnomon::CoarsePicture picture(
      occluders, gnomon::shownView(renderer, occluders.frame).camera);
    if (picture.isEmpty())
    {
      this->Note = "The camera sees no opaque surface: the key light is placed without a look.";
      direction = { 35.0, 40.0 };
    }
    else
    {
      const gnomon::CoarsePicture::Choice choice = picture.chooseKey();
      direction = choice.direction;
      this->Note = noteOn(picture, choice);
      this->LitShare = choice.shares.lit;
      this->ShadowShare = choice.shares.inShadow;
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Lights cannot be placed: " << error.what());
    return false;
  }
  place(key, direction.towardsView(), camera, box);
  key->SetIntensity(keyIntensity);

  const double side = direction.left > 0.0 ? -1.0 : 1.0;
  place(fill, gnomon::KeyDirection{ 25.0 * side, 0.0 }.towardsView(), camera, box);
  fill->SetIntensity(fillIntensity);
  fill->SetDiffuseColor(key->GetDiffuseColor());
  fill->SetSpecularColor(0.0, 0.0, 0.0);
  vtkGnomonLightKeys::SetCasts(fill, false);
  return true;
}

//------------------------------------------------------------------------------
void vtkGnomonFlatteringLights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Note: " << this->Note << "\n";
  os << indent << "LitShare: " << this->LitShare << "\n";
  os << indent << "ShadowShare: " << this->ShadowShare << "\n";
}
