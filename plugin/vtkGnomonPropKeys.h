/**
 * @class   vtkGnomonPropKeys
 * @brief   the role of a vtkProp in vtkGnomonShadowPass: casts, receives, one-sided
 *
 * The keys live in a prop's property keys. VTK hands an assembly's property keys down to its parts
 * when it draws. So set them on the assembly, where they count for all of its parts.
 *
 * @code
 * vtkGnomonPropKeys::SetCasts(ground, false);
 * @endcode
 */

#ifndef vtkGnomonPropKeys_h
#define vtkGnomonPropKeys_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationIntegerKey;
class vtkProp;
VTK_ABI_NAMESPACE_END

class GNOMONPLUGIN_EXPORT vtkGnomonPropKeys : public vtkObject
{
public:
  static vtkGnomonPropKeys* New();
  vtkTypeMacro(vtkGnomonPropKeys, vtkObject);

  /**
   * The light that a translucent prop lets through wherever a ray crosses its surface.
   */
  enum TransmitsType
  {
    TRANSMITS_NOTHING = 0, ///< it blocks all light
    TRANSMITS_GREY = 1,    ///< 1 - a, where a is the opacity with which VTK draws it there
    TRANSMITS_COLORED = 2  ///< 1 - a (1 - c) of each channel, where c is its diffuse colour there
  };

  ///@{
  /**
   * Return the keys. Each is 0 or 1, but for TRANSMITS.
   *
   * - CASTS: the prop blocks light. Default: 1 for opaque props, 0 for translucent ones unless
   *   vtkGnomonShadowPass::SetTranslucentCasters() has them cast.
   * - TRANSMITS: what a translucent prop that casts lets through, one of TransmitsType. Default:
   *   TRANSMITS_GREY.
   * - RECEIVES: the prop shows shadows. Default: 1.
   * - SHADOW_CATCHER: the prop shows nothing but shadows, in black. Their opacity is the share of
   *   the light, of lights and sky, that casters keep from it, for pictures that are laid over a
   *   page. VTK draws it in its turn: what is to be seen behind it comes before it. Default: 0.
   * - ONE_SIDED: the prop blocks light only with triangles whose front faces the light. The front
   *   shows the corners counter-clockwise. Default: 0, both sides block.
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationIntegerKey* TRANSMITS();
  static vtkInformationIntegerKey* RECEIVES();
  static vtkInformationIntegerKey* SHADOW_CATCHER();
  static vtkInformationIntegerKey* ONE_SIDED();
  ///@}

  ///@{
  /**
   * Set a key on a prop. Gives the prop property keys if it has none.
   */
  static void SetCasts(vtkProp* prop, bool casts) VTK_EXPECTS(prop != nullptr);
  static void SetTransmits(vtkProp* prop, int transmits) VTK_EXPECTS(prop != nullptr);
  static void SetReceives(vtkProp* prop, bool receives) VTK_EXPECTS(prop != nullptr);
  static void SetShadowCatcher(vtkProp* prop, bool catches) VTK_EXPECTS(prop != nullptr);
  static void SetOneSided(vtkProp* prop, bool oneSided) VTK_EXPECTS(prop != nullptr);
  ///@}

  ///@{
  /**
   * Return a key's value. If the prop does not have the key, return its default for opaque props.
   */
  static bool GetCasts(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  static int GetTransmits(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  static bool GetReceives(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  static bool GetShadowCatcher(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  static bool GetOneSided(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  ///@}

protected:
  vtkGnomonPropKeys() = default;
  ~vtkGnomonPropKeys() override = default;

private:
  vtkGnomonPropKeys(const vtkGnomonPropKeys&) = delete;
  void operator=(const vtkGnomonPropKeys&) = delete;
};

#endif
