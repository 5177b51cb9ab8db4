/**
 * @class   vtkGnomonLightPlacement
 * @brief   places a vtkLight by its target, or turns it by pitch and yaw
 *
 * @code
 * vtkNew<vtkLight> sun;
 * vtkGnomonLightPlacement::SetPitchAndYaw(sun, -40.0, 30.0);
 * vtkGnomonLightPlacement::ShineOnBox(sun, renderer->ComputeVisiblePropBounds());
 * @endcode
 *
 * Shadows do not need it, as maps are fitted to the casters wherever a directional light's position
 * is. It gives a spot light a position from which it lights the whole target. It gives a
 * directional light a meaningful position and focal point, for light widgets and boxes
 * (vtkGnomonLightKeys::SetBox). All positions and lengths are in the light's own coordinates. These
 * are world coordinates unless the light has a transform matrix or is a headlight or camera light.
 *
 * Invalid input is an error of the light (vtkErrorMacro) and leaves the light unchanged: a number
 * that is not finite, a radius that is not positive, a light whose position is its focal point. A
 * null object is an error, too, and a ValueError in Python.
 */

#ifndef vtkGnomonLightPlacement_h
#define vtkGnomonLightPlacement_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

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
   * Make a light shine on a sphere, and keep its direction. The focal point becomes the sphere's
   * centre. A spot light moves to where its cone just holds the sphere. Other lights move to the
   * point of the sphere that faces the light. So a directional light's box of width, height and
   * depth 2 * radius holds the sphere.
   *
   * @param light its direction goes from Position to FocalPoint
   * @param center centre of the sphere, finite
   * @param radius radius of the sphere, finite, > 0
   */
  static void ShineOnSphere(vtkLight* light, const double center[3], double radius)
    VTK_EXPECTS(light != nullptr);

  /**
   * Make a light shine on the sphere around a box, as ShineOnSphere() does. An empty box is an
   * error.
   *
   * @param light as in ShineOnSphere()
   * @param bounds xmin, xmax, ymin, ymax, zmin, zmax (vtkProp's GetBounds, vtkRenderer's
   * ComputeVisiblePropBounds)
   */
  static void ShineOnBox(vtkLight* light, const double bounds[6]) VTK_EXPECTS(light != nullptr);

  /**
   * Make a light shine on points, as ShineOnSphere() does. The sphere around them is centred on the
   * middle of their bounds, and at most as large as the sphere around the bounds. No points, or one
   * point only, are an error.
   */
  static void ShineOnPoints(vtkLight* light, vtkPoints* points) VTK_EXPECTS(light != nullptr)
    VTK_EXPECTS(points != nullptr);

  /**
   * Make a light the key light for a camera: a directional light that shines on a box. It shines
   * from 35 degrees to the left of the camera and 40 degrees above it. It becomes a scene light,
   * which stays in place when the camera moves. Its transform matrix is removed. An empty box, or a
   * camera without a direction of view, is an error of the light.
   *
   * @code
   * vtkNew<vtkLight> key;
   * vtkGnomonLightPlacement::MakeKeyLight(
   *   key, renderer->GetActiveCamera(), renderer->ComputeVisiblePropBounds());
   * renderer->AddLight(key);
   * @endcode
   */
  static void MakeKeyLight(vtkLight* light, vtkCamera* camera, const double bounds[6])
    VTK_EXPECTS(light != nullptr) VTK_EXPECTS(camera != nullptr);

  ///@{
  /**
   * Turn a light to a direction, given in degrees. With pitch and yaw 0, it shines along -z. Yaw
   * turns it to the left, around +y. Pitch then raises it; at -90 it shines straight down. A
   * positional light turns about its position, a directional light about its focal point. The
   * distance between both is kept.
   *
   * GetPitchAndYaw returns both, in this order, of any light: a pitch in [-90, 90] and a yaw in
   * [-180, 180], which is 0 straight up and down. A light without a direction is an error of the
   * light, and gives zeros.
   *
   * vtkLight's SetDirectionAngle takes -pitch and yaw, but moves the focal point to the origin and
   * makes the light directional.
   */
  static void SetPitchAndYaw(vtkLight* light, double pitchDegrees, double yawDegrees)
    VTK_EXPECTS(light != nullptr);
  static void GetPitchAndYaw(vtkLight* light, double degrees[2]) VTK_EXPECTS(light != nullptr);
  ///@}

  /**
   * True for a headlight, and for a camera light that stands where one does: the camera hardly sees
   * its shadows, so it casts none unless its key asks.
   */
  static bool IsHeadlight(vtkLight* light) VTK_EXPECTS(light != nullptr);

protected:
  vtkGnomonLightPlacement() = default;
  ~vtkGnomonLightPlacement() override = default;

private:
  vtkGnomonLightPlacement(const vtkGnomonLightPlacement&) = delete;
  void operator=(const vtkGnomonLightPlacement&) = delete;
};

#endif
