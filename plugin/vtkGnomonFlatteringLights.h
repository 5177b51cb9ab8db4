/**
 * @class   vtkGnomonFlatteringLights
 * @brief   places a key light whose shadow the camera sees, and a fill light
 *
 * A headlight shows no shadow: from the camera, all that it lights hides what it does not. This
 * class tries some dozen directions beside and above the camera on a coarse traced picture, and
 * takes one that lights most of the props and shows their shadow.
 *
 * @code
 * vtkNew<vtkLight> key;
 * vtkNew<vtkLight> fill;
 * vtkNew<vtkGnomonFlatteringLights> lights;
 * if (lights->Make(renderer, key, fill))
 * {
 *   renderer->AddLight(key);
 *   renderer->AddLight(fill);
 * }
 * @endcode
 *
 * Same renderer, same lights. Invalid input is an error (vtkErrorMacro) and leaves the lights
 * unchanged. A null object is an error, too, and a ValueError in Python.
 *
 * @sa vtkGnomonLightPlacement::MakeKeyLight, which looks at no prop
 */

#ifndef vtkGnomonFlatteringLights_h
#define vtkGnomonFlatteringLights_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

#include <string> // For the note

VTK_ABI_NAMESPACE_BEGIN
class vtkLight;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

class GNOMONPLUGIN_EXPORT vtkGnomonFlatteringLights : public vtkObject
{
public:
  static vtkGnomonFlatteringLights* New();
  vtkTypeMacro(vtkGnomonFlatteringLights, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Place both lights for a renderer's visible props, as its active camera sees them. They become
   * directional scene lights without a transform matrix, which stay when the camera moves. They are
   * not added to the renderer, and its own lights do not count. It needs no OpenGL.
   *
   * - The key light keeps its colours, and gets the intensity 0.8. It shines from 20 to 70 degrees
   *   beside the camera and 25 to 65 above it. It lights at least half of the props' visible area,
   *   and at least 5 % of what lies below or behind the props is in shadow, if a direction does
   *   both. Below and behind is a plane that the rest of the picture lies in front of, up to 1.5
   *   radii from the middle of the props. Without one, shade on the props themselves counts.
   * - The fill light shines from the other side, near the camera, casts no shadow
   *   (vtkGnomonLightKeys) and makes no highlight. It gets the key light's diffuse colour, and the
   *   intensity 0.4.
   *
   * Props that are no surfaces (volumes, lines) or are translucent do not count. Where no other is
   * seen, the key light is the one of vtkGnomonLightPlacement::MakeKeyLight().
   *
   * @return false, with an error, if no prop is visible or the camera looks nowhere
   */
  bool Make(vtkRenderer* renderer, vtkLight* key, vtkLight* fill) VTK_EXPECTS(renderer != nullptr)
    VTK_EXPECTS(key != nullptr) VTK_EXPECTS(fill != nullptr);

  /**
   * Return what the last Make() found, as sentences: the key light's direction, both shares, and
   * whether they fall short. Empty before, and after an error.
   */
  std::string GetNote() { return this->Note; }

  ///@{
  /**
   * Shares that the last Make() found, in [0, 1]: of the props' visible area, how much is lit; of
   * what lies below or behind them, how much is in shadow. Where nothing does, the latter is the
   * share of the props that is not lit. Default: 0.
   */
  vtkGetMacro(LitShare, double);
  vtkGetMacro(ShadowShare, double);
  ///@}

protected:
  vtkGnomonFlatteringLights() = default;
  ~vtkGnomonFlatteringLights() override = default;

private:
  vtkGnomonFlatteringLights(const vtkGnomonFlatteringLights&) = delete;
  void operator=(const vtkGnomonFlatteringLights&) = delete;

  std::string Note;
  double LitShare = 0.0;
  double ShadowShare = 0.0;
};

#endif
