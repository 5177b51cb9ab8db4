/**
 * @class   vtkPVGnomonLightKeys
 * @brief   the keys of one of ParaView's lights
 *
 * ParaView makes it the light's information. Without OSPRay, ParaView's own light drops its radius.
 */

#ifndef vtkPVGnomonLightKeys_h
#define vtkPVGnomonLightKeys_h

#include "vtkGnomonViewsModule.h" // for export macro
#include "vtkInformation.h"

class VTKGNOMONVIEWS_EXPORT vtkPVGnomonLightKeys : public vtkInformation
{
public:
  static vtkPVGnomonLightKeys* New();
  vtkTypeMacro(vtkPVGnomonLightKeys, vtkInformation);

  /**
   * The light's setting `light_radius`, in world units, of directional lights the whole angle in
   * degrees. 0, the default: the light has the view's.
   */
  void SetRadius(double radius);

protected:
  vtkPVGnomonLightKeys() = default;
  ~vtkPVGnomonLightKeys() override = default;

private:
  vtkPVGnomonLightKeys(const vtkPVGnomonLightKeys&) = delete;
  void operator=(const vtkPVGnomonLightKeys&) = delete;
};

#endif
