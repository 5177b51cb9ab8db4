/**
 * @class   vtkGnomonPropKeys
 * @brief   what one vtkProp does in vtkGnomonShadowPass: casts, receives, one-sided
 *
 * The keys live in a prop's property keys. VTK hands an assembly's property keys down to its parts
 * when it draws, so set them on the assembly, where they count for all of its parts.
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
   * The keys themselves. CASTS: the prop blocks light (0 or 1, default 1 for what is opaque and 0
   * for what is translucent, which blocks all light if asked to). RECEIVES: it shows shadows
   * (default 1). ONE_SIDED: it blocks light only with triangles whose front side, the one that they
   * show counter-clockwise, faces the light (default 0: both sides block).
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationIntegerKey* RECEIVES();
  static vtkInformationIntegerKey* ONE_SIDED();
  ///@}

  ///@{
  /**
   * Set a key on a prop, giving it property keys if it has none.
   */
  static void SetCasts(vtkProp* prop, bool casts);
  static void SetReceives(vtkProp* prop, bool receives);
  static void SetOneSided(vtkProp* prop, bool oneSided);
  ///@}

  ///@{
  /**
   * Read a key, or where the prop does not have it, its default for opaque props.
   */
  static bool GetCasts(vtkProp* prop);
  static bool GetReceives(vtkProp* prop);
  static bool GetOneSided(vtkProp* prop);
  ///@}

protected:
  vtkGnomonPropKeys() = default;
  ~vtkGnomonPropKeys() override = default;

private:
  vtkGnomonPropKeys(const vtkGnomonPropKeys&) = delete;
  void operator=(const vtkGnomonPropKeys&) = delete;
};

#endif
