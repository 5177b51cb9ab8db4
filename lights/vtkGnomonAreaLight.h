/**
 * @class   vtkGnomonAreaLight
 * @brief   a light that is as large as lamps and windows are, and so gives soft shadows
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
 * A rectangle or a disk around the light's Position, across the direction to its FocalPoint. All of
 * its points shine alike, unless it has a Texture. Which of them a surface sees is its visibility;
 * shading is VTK's own, from the centre, and so are the cone and the box (vtkGnomonLightKeys) that
 * the light may have. Techniques with hard shadows take the centre's. "raytraced", "penumbra",
 * "coherence", "sampled" and "planar" take the whole area, by as many points as the setting
 * "light_samples" says (vtkGnomonLightKeys::SetSetting), and so do "pcss", by "pcss_samples", and
 * "montecarlo", by "mc_rays". vtkGnomonLightSamplingPass has VTK shade from all of its points
 * instead.
 *
 * It is positional and shines into all directions (ConeAngle 90) until it is told otherwise.
 *
 * <b>Units.</b> Sizes are in world units, whatever the light's transform. Of a directional light
 * (PositionalOff) they are angles in degrees: the whole angles that the light fills in the sky,
 * which for the sun's disk is 0.53. A rectangle's must be below 180 then, and a disk's too.
 *
 * <b>OSPRay.</b> Radius is the same number as that of vtkOSPRayLightNode::SetRadius: of a positional
 * light the radius, of a directional one the angular diameter in degrees. SetRadius and SetShape
 * give a disk OSPRay's key, too, where OSPRay's module is loaded by then, so that it is as large to
 * vtkOSPRayPass, and take it off a rectangle, which is a point there. A vtkLight that has OSPRay's
 * key (RADIUS) gives soft shadows as well, without being of this class: a disk across the direction
 * of a spot light or directional light, and of a light that shines into all directions a ball,
 * which looks like a disk of that radius from all sides. The setting "light_radius", of a light or
 * of the pass, makes any light such a disk or ball.
 *
 * A light of size 0 is a point. One whose size is not finite or beyond 1e12, or which has no
 * direction, or of a rectangle an up direction along it, casts no shadow, which the frame's report
 * says. So does one with a bad Texture.
 */

#ifndef vtkGnomonAreaLight_h
#define vtkGnomonAreaLight_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkSmartPointer.h"

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
   * What it is: RECTANGLE, with Width, Height and Up, or DISK (the default), with Radius.
   */
  virtual void SetShape(int shape);
  vtkGetMacro(Shape, int);
  void SetShapeToRectangle() { this->SetShape(RECTANGLE); }
  void SetShapeToDisk() { this->SetShape(DISK); }
  ///@}

  ///@{
  /**
   * A disk's size, in the units of vtkOSPRayLightNode::SetRadius, see above. What is negative
   * counts as 0. 0.5 by default.
   */
  virtual void SetRadius(double radius);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * A rectangle's size across Up and along it, see above. What is negative counts as 0. 1 by
   * default.
   */
  vtkSetClampMacro(Width, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Width, double);
  vtkSetClampMacro(Height, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /**
   * Which way is up in a rectangle, and in a disk with a Texture: not along the light, of any
   * length, in the light's own coordinates as its Position is. The height lies in the plane of Up
   * and the light's direction. (0, 1, 0) by default.
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * How the light's colour is spread over its area: a picture that its light comes through, as
   * through the panes of a window. A point of the light shines with the light's colour times the
   * colour of the texel there (the nearest one), channel by channel; null, the default, and all
   * white: all points shine alike. What nothing hides the light from gets the light's colour times
   * the picture's mean. Who looks at the light from where it shines to, with Up upwards, sees the
   * picture as it is: its first row at the bottom, as images of VTK have it. A disk shows what of
   * the picture lies inside of the circle that touches its sides.
   *
   * The image has one slice, with 1 to 4 components a point: grey or colours, and an alpha, which
   * means nothing. Values of unsigned char and unsigned short go from 0 to the type's greatest, of
   * float and double from 0 to 1, each in 255 steps. They are taken as they stand, as light colours
   * are: no colour space is converted. With anything else, or with the setting "light_radius", the
   * light casts no shadow, for the reason that the frame's report gives, and is VTK's own, without
   * texture.
   *
   * "raytraced", "penumbra", "coherence", "montecarlo" and "sampled" show it; of others visibility
   * has one channel, and the light is an even one of the picture's mean. With
   * vtkGnomonLightSamplingPass all of them show it.
   *
   * The light shares the image, and sees when it is modified. A pipeline is not updated.
   */
  vtkSetSmartPointerMacro(Texture, vtkImageData);
  vtkGetSmartPointerMacro(Texture, vtkImageData);
  ///@}

  /**
   * A light of this class with the same parameters; it shares the transform matrix and the texture,
   * if there are any.
   */
  vtkLight* ShallowClone() override;

  /**
   * Copy all parameters; of a light that is none of this class, those that all lights have. The
   * transform matrix and the information are copied, not shared; the texture is shared.
   */
  void DeepCopy(vtkLight* light);

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
