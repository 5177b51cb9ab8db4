/**
 * @class   vtkGnomonLightKeys
 * @brief   settings of one vtkLight for vtkGnomonShadowPass
 *
 * The keys are stored in a light's information (vtkInformation). In addition, vtkLight's own
 * ShadowAttenuation is the shadow's strength (1: full shadows, 0: none). The pass decides all that
 * a light leaves unset.
 *
 * @code
 * vtkGnomonLightKeys::SetTechnique(light, "raytraced");
 * vtkGnomonLightKeys::SetSetting(light, "kernel", "box");
 * vtkGnomonLightKeys::SetCasts(fillLight, false);
 * @endcode
 *
 * <b>Settings.</b> A light's settings are a list of names with values, as in scene files and in the
 * program gnomon. docs/guide/settings.md and `gnomon settings` list them. A setting that the
 * light's technique lacks is an error of the frame, which names the techniques that have it. The
 * shadows are rendered without it.
 *
 * <b>A directional light's box.</b> A directional light may be limited to a box, like sunlight
 * through a window. The light starts at the box's near face, which lies across the light and has
 * Position at its centre. It ends after the box's depth. Surfaces outside get nothing of this
 * light, and casters outside cast nothing into the box. A caster that is partly inside casts with
 * that part. The map covers only the box, so its texels are finer.
 *
 * The limit is part of visibility. So a light without shadows (CASTS 0 or ShadowAttenuation 0) has
 * no limit, and a ShadowAttenuation in between leaves its share of light outside. Props that do not
 * receive shadows (vtkGnomonPropKeys) are lit everywhere.
 *
 * A null light is an error (vtkErrorMacro) that changes nothing, and for which getters return the
 * values of a light without settings. In Python it is a ValueError.
 */

#ifndef vtkGnomonLightKeys_h
#define vtkGnomonLightKeys_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

class vtkGnomonShadowSettings;
VTK_ABI_NAMESPACE_BEGIN
class vtkInformationDoubleVectorKey;
class vtkInformationIntegerKey;
class vtkInformationObjectBaseKey;
class vtkInformationStringVectorKey;
class vtkLight;
VTK_ABI_NAMESPACE_END

class GNOMONLIGHTS_EXPORT vtkGnomonLightKeys : public vtkObject
{
public:
  static vtkGnomonLightKeys* New();
  vtkTypeMacro(vtkGnomonLightKeys, vtkObject);

  ///@{
  /**
   * The keys, for code that fills information objects.
   *
   * - CASTS is 0 or 1. Default: unset, so that the pass chooses (vtkGnomonShadowPass::SetCasting).
   * - SETTINGS holds SetSetting()'s names and values, alternating.
   * - BOX limits a directional light to a box, see above. Its numbers are width, height and depth
   *   in world units, each > 0, and the up direction x, y, z of the near face. The up direction
   *   must not be along the light, and is in the light's own coordinates, as Position is. Other
   *   kinds of light ignore BOX.
   * - OBJECT holds SetSettings()'s object.
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationStringVectorKey* SETTINGS();
  static vtkInformationDoubleVectorKey* BOX();
  static vtkInformationObjectBaseKey* OBJECT();
  ///@}

  ///@{
  /**
   * Set one of a light's settings by name, see above, as text or as a number, where 1 and 0 switch
   * on and off. A null or empty text removes the setting, so the pass's value applies. An unknown
   * name or an invalid value is an error, returns false and changes nothing; GetSettingError() then
   * says why (vtkGnomonNamedSettings), of this thread's last call. GetSetting() returns null for a
   * setting that the light leaves unset.
   */
  static bool SetSetting(vtkLight* light, const char* name, const char* value)
    VTK_EXPECTS(light != nullptr);
  static bool SetSetting(vtkLight* light, const char* name, double number)
    VTK_EXPECTS(light != nullptr);
  static std::string GetSettingError();
  static const char* GetSetting(vtkLight* light, const char* name) VTK_EXPECTS(light != nullptr);
  ///@}

  ///@{
  /**
   * Set an object of typed settings, which several lights may share. Only settings that were set
   * apply. SetSetting() overrides them, and they override the pass. Null removes the object.
   * Default: null.
   */
  static void SetSettings(vtkLight* light, vtkGnomonShadowSettings* settings)
    VTK_EXPECTS(light != nullptr);
  static vtkGnomonShadowSettings* GetSettings(vtkLight* light) VTK_EXPECTS(light != nullptr);
  ///@}

  ///@{
  /**
   * True if the light casts shadows, whatever the pass chooses. GetCasts() is true where that is
   * unset.
   */
  static void SetCasts(vtkLight* light, bool casts) VTK_EXPECTS(light != nullptr);
  static bool GetCasts(vtkLight* light) VTK_EXPECTS(light != nullptr);
  ///@}

  ///@{
  /**
   * Set the setting "technique" or "map_size", as SetSetting() does. A map's size, in texels, is
   * clamped to [16, 16384]; 0 or less removes the setting. If the light does not set them,
   * GetTechnique returns null and GetMapSize 0.
   */
  static bool SetTechnique(vtkLight* light, const char* technique) VTK_EXPECTS(light != nullptr);
  static const char* GetTechnique(vtkLight* light) VTK_EXPECTS(light != nullptr);
  static void SetMapSize(vtkLight* light, int mapSizeTexels) VTK_EXPECTS(light != nullptr);
  static int GetMapSize(vtkLight* light) VTK_EXPECTS(light != nullptr);
  ///@}

  ///@{
  /**
   * Limit a directional light to a box, see above, or remove the limit. Sizes that are not positive
   * and finite, or an up direction without length, are an error and change nothing. With an up
   * direction along the light, the light casts no shadow, and the frame's report gives the reason.
   * GetBox returns the sizes and the up direction; without a box it returns false and changes
   * nothing.
   *
   * - `width`: size across the light and across `up`, in world units
   * - `height`: size across the light and along `up`, in world units
   * - `depth`: size along the light, in world units
   * - `up`: the near face's up direction, of any length, in the light's own coordinates
   */
  static void SetBox(vtkLight* light, double width, double height, double depth, const double up[3])
    VTK_EXPECTS(light != nullptr);
  static bool GetBox(vtkLight* light, double size[3], double up[3]) VTK_EXPECTS(light != nullptr);
  static void RemoveBox(vtkLight* light) VTK_EXPECTS(light != nullptr);
  ///@}

protected:
  vtkGnomonLightKeys() = default;
  ~vtkGnomonLightKeys() override = default;

private:
  vtkGnomonLightKeys(const vtkGnomonLightKeys&) = delete;
  void operator=(const vtkGnomonLightKeys&) = delete;
};

#endif
