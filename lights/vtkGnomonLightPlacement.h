/**
 * @class   vtkGnomonLightPlacement
 * @brief   places a vtkLight by what it is to shine on, or turns it by pitch and yaw
 *
 * @code
 * vtkNew<vtkLight> sun;
 * vtkGnomonLightPlacement::SetPitchAndYaw(sun, -40.0, 30.0);
 * vtkGnomonLightPlacement::ShineOnBox(sun, renderer->ComputeVisiblePropBounds());
 * @endcode
 *
 * Shadows do not need it: the maps are fitted to the casters wherever a directional light's
 * position is. It gives spot lights a place from which they light all of something, and directional
 * lights a position and focal point that mean something, for light widgets and for boxes
 * (vtkGnomonLightKeys::SetBox). All numbers are in the light's own coordinates, which are the
 * world's unless it has a transform matrix or is a head or camera light.
 *
 * What cannot be done (a number that is not finite, a radius that is not positive, a light whose
 * position is its focal point) is an error of the light (vtkErrorMacro), and the light stays as it
 * was.
 */

#ifndef vtkGnomonLightPlacement_h
#define vtkGnomonLightPlacement_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkLight;
class vtkPoints;
VTK_ABI_NAMESPACE_END

class GNOMONLIGHTS_EXPORT vtkGnomonLightPlacement : public vtkObject
{
public:
  static vtkGnomonLightPlacement* New();
  vtkTypeMacro(vtkGnomonLightPlacement, vtkObject);

  /**
   * Make a light shine on a sphere, in the direction that it has. Its focal point becomes the
   * centre. A spot light moves to where its cone just holds the sphere, other lights to the point
   * of the sphere that the light comes from; so a directional light's box of width, height and
   * depth 2 * radius holds the sphere.
   */
  static void ShineOnSphere(vtkLight* light, const double center[3], double radius);

  /**
   * The same for the sphere around a box, given as xmin, xmax, ymin, ymax, zmin, zmax (vtkProp's
   * GetBounds, vtkRenderer's ComputeVisiblePropBounds).
   */
  static void ShineOnBox(vtkLight* light, const double bounds[6]);

  /**
   * The same for points: for the sphere around them whose centre is the middle of their bounds. It
   * is at most as large as the one around those bounds.
   */
  static void ShineOnPoints(vtkLight* light, vtkPoints* points);

  /**
   * Make a light the key light of a scene that a camera looks at: a directional one that shines on
   * the box, as above, over the camera's left shoulder, from 35 degrees to the left of the camera
   * and 40 degrees above it. It becomes a light of the scene, which stays when the camera moves. An
   * error of the light where the camera looks nowhere.
   *
   * @code
   * vtkNew<vtkLight> key;
   * vtkGnomonLightPlacement::MakeKeyLight(
   *   key, renderer->GetActiveCamera(), renderer->ComputeVisiblePropBounds());
   * renderer->AddLight(key);
   * @endcode
   */
  static void MakeKeyLight(vtkLight* light, vtkCamera* camera, const double bounds[6]);

  ///@{
  /**
   * Turn a light into a direction, in degrees. Pitch and yaw 0 is the way along -z. Yaw turns to
   * the left, around +y; pitch then raises it, so that -90 shines straight down. A positional light
   * turns about its position, a directional one about its focal point, as far from it as before.
   * (vtkLight's SetDirectionAngle takes -pitch and yaw, but puts the focal point into the origin
   * and makes the light directional.) GetPitchAndYaw gives both, in this order, for any light: a
   * pitch in [-90, 90] and a yaw in [-180, 180], which is 0 straight up and down. A light without a
   * direction is an error of the light, and gives zeros.
   */
  static void SetPitchAndYaw(vtkLight* light, double pitchDegrees, double yawDegrees);
  static void GetPitchAndYaw(vtkLight* light, double degrees[2]);
  ///@}

protected:
  vtkGnomonLightPlacement() = default;
  ~vtkGnomonLightPlacement() override = default;

private:
  vtkGnomonLightPlacement(const vtkGnomonLightPlacement&) = delete;
  void operator=(const vtkGnomonLightPlacement&) = delete;
};

#endif
