/**
 * @class   vtkGnomonLightKeys
 * @brief   what one vtkLight asks of vtkGnomonShadowPass
 *
 * The keys live in a light's information, next to which vtkLight's own ShadowAttenuation is the
 * shadow's strength (1: full shadows, 0: none). What a light does not say, the pass decides.
 *
 * @code
 * vtkGnomonLightKeys::SetTechnique(light, "raytraced");
 * vtkGnomonLightKeys::SetSetting(light, "kernel", "box");
 * vtkGnomonLightKeys::SetCasts(fillLight, false);
 * @endcode
 *
 * <b>Settings.</b> What is asked of a light's shadows is a list of names with values, the same ones
 * that scene files and the program gnomon take. docs/guide/settings.md lists them, as does `gnomon
 * settings`. A setting that the light's technique does not have is an error of the frame, which
 * names the techniques that have it and draws the shadows without it.
 *
 * <b>A directional light's box.</b> A directional light may be limited to a box, as the sun is that
 * comes in through a window: it begins at the box's near face, which stands across it with the
 * light's Position in its middle, and goes on for the box's depth. What lies outside gets nothing
 * of this light, whether or not it receives shadows from others, and what lies outside casts
 * nothing into the box; a caster that is partly inside casts with that part. The map then holds the
 * box alone, and is the finer for it. The limit is part of the visibility, so that a light without
 * shadows (CASTS 0, ShadowAttenuation 0) has none, and a ShadowAttenuation between leaves its share
 * outside. Receivers that do not receive shadows (vtkGnomonPropKeys) are lit everywhere.
 */

#ifndef vtkGnomonLightKeys_h
#define vtkGnomonLightKeys_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"

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
   * The keys themselves, for code that fills information objects. CASTS is 0 or 1 (default 1).
   * SETTINGS holds what SetSetting sets, names and values in turn. BOX limits a directional light
   * to a box, see above: width, height and depth, each > 0, then the direction x, y, z that is up
   * in the near face, not along the light. The up direction is in the light's own coordinates, as
   * its Position is. Other kinds of light ignore it. OBJECT is what SetSettings sets.
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationStringVectorKey* SETTINGS();
  static vtkInformationDoubleVectorKey* BOX();
  static vtkInformationObjectBaseKey* OBJECT();
  ///@}

  ///@{
  /**
   * Set what is asked of a light's shadows, by name, see above. A null or empty value takes the
   * setting away again, so that the pass's own counts. A setting that does not exist, and a value
   * that it does not take, are an error and change nothing. GetSetting returns null where the light
   * says nothing.
   */
  static void SetSetting(vtkLight* light, const char* name, const char* value);
  static const char* GetSetting(vtkLight* light, const char* name);
  ///@}

  ///@{
  /**
   * Settings with types, which several lights may share. Those that were set count; SetSetting()
   * goes before them, the pass's come after. Null takes them away again.
   */
  static void SetSettings(vtkLight* light, vtkGnomonShadowSettings* settings);
  static vtkGnomonShadowSettings* GetSettings(vtkLight* light);
  ///@}

  ///@{
  /**
   * Whether the light casts shadows at all. Default true.
   */
  static void SetCasts(vtkLight* light, bool casts);
  static bool GetCasts(vtkLight* light);
  ///@}

  ///@{
  /**
   * Set one of the settings. The size is clamped to what the setting takes; 0 or less takes it
   * away. Where the light says nothing, GetTechnique returns null and GetMapSize 0.
   */
  static void SetTechnique(vtkLight* light, const char* technique);
  static const char* GetTechnique(vtkLight* light);
  static void SetMapSize(vtkLight* light, int mapSizeTexels);
  static int GetMapSize(vtkLight* light);
  ///@}

  ///@{
  /**
   * Limit a directional light to a box, and lift that limit again. Sizes that are not positive and
   * finite, and an up direction of no length, are an error and change nothing; an up direction
   * along the light makes the light cast no shadow, which the frame's report says. GetBox gives
   * width, height and depth, and the up direction; without a box it returns false and changes
   * nothing.
   */
  static void SetBox(
    vtkLight* light, double width, double height, double depth, const double up[3]);
  static bool GetBox(vtkLight* light, double size[3], double up[3]);
  static void RemoveBox(vtkLight* light);
  ///@}

protected:
  vtkGnomonLightKeys() = default;
  ~vtkGnomonLightKeys() override = default;

private:
  vtkGnomonLightKeys(const vtkGnomonLightKeys&) = delete;
  void operator=(const vtkGnomonLightKeys&) = delete;
};

#endif
