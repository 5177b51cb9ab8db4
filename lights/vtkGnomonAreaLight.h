/**
 * @class   vtkGnomonAreaLight
 * @brief   a light with an area, such as a lamp or a window, which gives soft shadows
 *
 * @code
 * vtkNew<vtkGnomonAreaLight> lamp;
 * lamp->SetPosition(0.0, 0.0, 5.0);
 * lamp->SetFocalPoint(0.0, 0.0, 0.0);
 * lamp->SetShapeToRectangle();
 * lamp->SetWidth(1.0);
 * lamp->SetHeight(0.5);
 * @endcode
 *
 * The area is a rectangle or a disk around the light's Position, across the direction to its
 * FocalPoint. All its points emit alike unless it has a Texture. A surface's visibility is the
 * share of points that it sees. VTK shades from the centre; a cone or box (vtkGnomonLightKeys)
 * starts there, too.
 *
 * Techniques with hard shadows use the centre. "raytraced", "penumbra", "coherence", "sampled" and
 * "planar" sample the whole area at "light_samples" points. "pcss" samples it at "pcss_samples"
 * points, "montecarlo" by "mc_rays" rays. These are settings (vtkGnomonLightKeys::SetSetting).
 * vtkGnomonLightSamplingPass makes VTK shade from all points.
 *
 * By default it is positional and shines in all directions (ConeAngle 90).
 *
 * <b>Units.</b> Sizes are in world units; the light's transform does not scale them. Sizes of a
 * directional light (PositionalOff) are angles in degrees, below 180: the whole angles that the
 * light fills in the sky. The sun's disk fills 0.53 degrees.
 *
 * <b>OSPRay.</b> Radius has the meaning of vtkOSPRayLightNode::SetRadius: a positional light's
 * radius, or a directional light's angular diameter in degrees. If OSPRay's module is loaded,
 * SetRadius and SetShape set OSPRay's key on a disk, so vtkOSPRayPass shows the same size. They
 * remove the key from a rectangle, which OSPRay shows as a point.
 *
 * Any vtkLight with OSPRay's key (RADIUS) gives soft shadows. A spot light or directional light
 * becomes a disk across its direction. A light that shines in all directions becomes a ball, which
 * looks like a disk of that radius from all sides. The setting "light_radius", of a light or of the
 * pass, makes any light such a disk or ball.
 *
 * <b>Errors.</b> A light of size 0 is a point. Some lights cast no shadow, and the frame's report
 * gives the reason: a size that is immense beside the scene, a light without direction, a rectangle
 * or textured disk with Up along the light, an invalid Texture.
 */

#ifndef vtkGnomonAreaLight_h
#define vtkGnomonAreaLight_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkSmartPointer.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

class GNOMONLIGHTS_EXPORT vtkGnomonAreaLight : public vtkLight
{
public:
  static vtkGnomonAreaLight* New();
  vtkTypeMacro(vtkGnomonAreaLight, vtkLight);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum
  {
    RECTANGLE = 0,
    DISK = 1
  };

  ///@{
  /**
   * The light's shape: RECTANGLE, with Width, Height and Up, or DISK, with Radius. Other values are
   * clamped. Default: DISK.
   */
  virtual void SetShape(int shape);
  vtkGetMacro(Shape, int);
  void SetShapeToRectangle() { this->SetShape(RECTANGLE); }
  void SetShapeToDisk() { this->SetShape(DISK); }
  ///@}

  ///@{
  /**
   * A disk's size, in the units of vtkOSPRayLightNode::SetRadius, see above. Negative values are
   * clamped to 0; NaN is an error and changes nothing. Default: 0.5.
   */
  virtual void SetRadius(double radius);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * A rectangle's size across Up (Width) and along Up (Height), in the units above. Negative values
   * are clamped to 0; NaN is an error and changes nothing. Default: 1.
   */
  virtual void SetWidth(double width);
  vtkGetMacro(Width, double);
  virtual void SetHeight(double height);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * The up direction of a rectangle, and of a disk with a Texture. It has any length, must not be
   * along the light, and is in the light's own coordinates, as Position is. The height lies in the
   * plane of Up and the light's direction. A vector that is not finite is an error and changes
   * nothing. Default: (0, 1, 0).
   */
  virtual void SetUp(double x, double y, double z);
  void SetUp(const double up[3]) { this->SetUp(up[0], up[1], up[2]); }
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * A picture that the light passes, as through a stained glass window. A point of the light emits
   * the light's colour times the nearest texel's colour, channel by channel. An unshadowed surface
   * gets the light's colour times the picture's mean. Null (the default) and an all-white picture
   * make all points emit alike.
   *
   * A viewer who faces the light, with Up upwards, sees the picture with its first row at the
   * bottom, as in VTK's images. A disk shows the picture's part inside the circle that touches its
   * sides.
   *
   * The image has one slice, with 1 to 4 components per point: grey or colour, with an alpha that
   * is ignored. Unsigned char and unsigned short values range from 0 to the type's maximum, float
   * and double values from 0 to 1. All are rounded to 255 steps. As with light colours, no colour
   * space is converted. With any other image, or with the setting "light_radius", the light casts
   * no shadow and shines without texture, as in VTK. The frame's report gives the reason.
   *
   * "raytraced", "penumbra", "coherence", "montecarlo" and "sampled" show the picture. Other
   * techniques' visibility has one channel, so they show a uniform light of the picture's mean.
   * With vtkGnomonLightSamplingPass all techniques show the picture.
   *
   * The light shares the image and notices its modifications. It does not update a pipeline.
   */
  vtkSetSmartPointerMacro(Texture, vtkImageData);
  vtkGetSmartPointerMacro(Texture, vtkImageData);
  ///@}

  /**
   * Return a new light of this class with the same parameters. It shares the transform matrix and
   * the texture.
   */
  vtkLight* ShallowClone() override;

  /**
   * Copy all parameters. From a light of another class, copy the parameters of vtkLight. The
   * transform matrix and the information are copied, not shared; the texture is shared.
   */
  void DeepCopy(vtkLight* light) VTK_EXPECTS(light != nullptr);

protected:
  vtkGnomonAreaLight();
  ~vtkGnomonAreaLight() override = default;

  int Shape = DISK;
  double Radius = 0.5;
  double Width = 1.0;
  double Height = 1.0;
  double Up[3] = { 0.0, 1.0, 0.0 };
  vtkSmartPointer<vtkImageData> Texture;

private:
  void CopyArea(vtkGnomonAreaLight* light);
  void TellOSPRay();

  vtkGnomonAreaLight(const vtkGnomonAreaLight&) = delete;
  void operator=(const vtkGnomonAreaLight&) = delete;
};

#endif
