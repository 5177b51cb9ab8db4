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

/// White matt surfaces reach at most |0.8 K + 0.4 F|: just white under a key light at 45 degrees.
constexpr double keyIntensity = 0.8;
constexpr double fillIntensity = 0.4;

/// Make a light a directional scene light that shines on a box.
/// @param towards the light, unit length, in the world
void place(vtkLight* light, const glm::dvec3& towards, vtkCamera* camera, const double box[6])
{
  vtkGnomonLightPlacement::MakeKeyLight(light, camera, box);
  const glm::dvec3 middle = glm::make_vec3(light->GetFocalPoint());
  const double radius = glm::distance(middle, glm::make_vec3(light->GetPosition()));
  light->SetPosition(glm::value_ptr(middle + radius * towards));
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
  if (!key.shares.suffice())
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
  try
  {
    gnomon::OccluderCollector collector;
    collector.collect(renderer);
    const gnomon::Occluders& occluders = collector.occluders();
    const gnomon::CoarsePicture picture(
      occluders, gnomon::shownView(renderer, occluders.frame).camera);
    gnomon::CoarsePicture::Choice choice{ { 35.0, 40.0 }, {} }; // MakeKeyLight()'s
    this->Note = "The camera sees no opaque surface: the key light is placed without a look.";
    if (!picture.isEmpty())
    {
      choice = picture.chooseKey();
      this->Note = noteOn(picture, choice);
    }
    this->LitShare = choice.shares.lit;
    this->ShadowShare = choice.shares.inShadow;
    place(key, picture.towards(choice.direction), camera, box);
    // A fill light is at the camera's height, on the side that the key light leaves dark.
    const double fillLeft = choice.direction.left > 0.0 ? -25.0 : 25.0;
    place(fill, picture.towards({ fillLeft, 0.0 }), camera, box);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Lights cannot be placed: " << error.what());
    return false;
  }
  key->SetIntensity(keyIntensity);
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
