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

  ///@{
  /**
   * Return the keys. Each is 0 or 1.
   *
   * - CASTS: the prop blocks light. Default: 1 for opaque props, 0 for translucent ones. A
   *   translucent prop that casts blocks all light.
   * - RECEIVES: the prop shows shadows. Default: 1.
   * - ONE_SIDED: the prop blocks light only with triangles whose front faces the light. The front
   *   shows the corners counter-clockwise. Default: 0, both sides block.
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationIntegerKey* RECEIVES();
  static vtkInformationIntegerKey* ONE_SIDED();
  ///@}

  ///@{
  /**
   * Set a key on a prop. Gives the prop property keys if it has none.
   */
  static void SetCasts(vtkProp* prop, bool casts) VTK_EXPECTS(prop != nullptr);
  static void SetReceives(vtkProp* prop, bool receives) VTK_EXPECTS(prop != nullptr);
  static void SetOneSided(vtkProp* prop, bool oneSided) VTK_EXPECTS(prop != nullptr);
  ///@}

  ///@{
  /**
   * Return a key's value. If the prop does not have the key, return its default for opaque props.
   */
  static bool GetCasts(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
  static bool GetReceives(vtkProp* prop) VTK_EXPECTS(prop != nullptr);
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
