/**
 * @class   vtkGnomonLightKeys
 * @brief   what one vtkLight asks of vtkGnomonShadowPass
 *
 * The keys live in a light's information, next to which vtkLight's own ShadowAttenuation is the
 * shadow's strength (1: full shadows, 0: none). What a light does not say, the pass decides.
 *
 * @code
 * vtkGnomonLightKeys::SetTechnique(light, "raytraced");
 * vtkGnomonLightKeys::SetCasts(fillLight, false);
 * @endcode
 */

#ifndef vtkGnomonLightKeys_h
#define vtkGnomonLightKeys_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkObject.h"

class vtkInformationIntegerKey;
class vtkInformationStringKey;
class vtkLight;

class GNOMONLIGHTS_EXPORT vtkGnomonLightKeys : public vtkObject
{
public:
  static vtkGnomonLightKeys* New();
  vtkTypeMacro(vtkGnomonLightKeys, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The keys themselves, for code that fills information objects. CASTS is 0 or 1 (default 1),
   * TECHNIQUE one of vtkGnomonShadowPass's technique names, MAP_SIZE the side of the light's map in
   * texels, clamped to [16, 16384].
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationStringKey* TECHNIQUE();
  static vtkInformationIntegerKey* MAP_SIZE();
  ///@}

  ///@{
  /**
   * Set a key on a light. An empty technique or a map size of 0 or less takes the key away again,
   * so that the pass's own setting counts.
   */
  static void SetCasts(vtkLight* light, bool casts);
  static void SetTechnique(vtkLight* light, const char* technique);
  static void SetMapSize(vtkLight* light, int mapSizeTexels);
  ///@}

protected:
  vtkGnomonLightKeys() = default;
  ~vtkGnomonLightKeys() override = default;

private:
  vtkGnomonLightKeys(const vtkGnomonLightKeys&) = delete;
  void operator=(const vtkGnomonLightKeys&) = delete;
};

#endif
