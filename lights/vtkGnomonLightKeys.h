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
 * that scene files and the program gnomon take:
 * - "technique": one of vtkGnomonShadowPass's technique names;
 * - "map_size": the side of the light's map in texels (of each layer, where it has several), 16 to
 *   16384;
 * - "kernel": the name of a filter kernel, see below (default "bilinear");
 * - "kernel_size": its width in texels, 1 to 32 (default 3). On a warped map (projections "lispsm",
 *   "tsm") the kernel is as large, but of a shape that is even across the light;
 * - "kernel_width": its width across the light in world units, of positional lights at distance 1; the
 *   kernel's size then says how many taps are spread over it (default 0: the size in texels);
 * - "disc_grid", "disc_sets", "early_out": of the estimator "adaptive", which averages over a disc of
 *   "kernel_size" or "kernel_width": its points are the square of "disc_grid" (default 8), discs that
 *   differ the square of "disc_sets" (default 16); "early_out" is what is asked before all of a disc is
 *   read: "none", "ring" (its outermost points, which miss small lit gaps), or "exact" (the default);
 * - "pcss_samples": of "pcss", from how many points of an area light: "low" (16 to look for blockers, 16 to
 *   filter), "medium" (36 and 64, the default) or "high" (64 and 256). It takes "early_out", too: "none" or "exact";
 * - "depth": the surface on a ray that a map holds: "first" (the default), "second" (the nearest that
 *   faces away from the light; only closed surfaces whose front faces are outside cast), or "midpoint"
 *   (halfway between the first two surfaces; the first one where it is alone);
 * - "metric": how a map measures: "linear" along the view's axis (the default), or "euclidean" along
 *   the ray. Of parallel rays both are the same;
 * - "bias_constant", "bias_slope": how far a map is pushed away from the light beyond what keeps
 *   surfaces from shadowing themselves: in world units, and times what a caster's depth spans within the
 *   filter's reach (defaults 0);
 * - "bleeding": of maps of moments ("vsm", "evsm", "msm"), up to what visibility points are dark, 0 to
 *   0.99 (default 0.2);
 * - "variance_floor": of "vsm" and "evsm", the least variance of depths, as a share of the map's depth
 *   range, squared (default 1e-6);
 * - "blur": of "vsm" and "msm", "box" (the default; one box of texels for the whole map), or "sat" (a
 *   rectangle for each point, by summed-area tables: warped and split maps blur as evenly as others);
 * - "mip_maps": of maps of moments with "blur" "box", whether pixels that see many texels read coarser
 *   levels of the map: "off" (the default) or "on";
 * - "adjacency_ring": of "crsma", which triangles around one may cover a texel together with it: "edges" (the default;
 *   those across its edges), or "vertices" (all around its corners, which decides more and takes longer);
 * - "bake": of exact techniques with a map ("crsm", "crsma", "silhouette"), when a stale one is
 *   baked: "settled" (the default; after 16 frames without a change, or more where maps went stale
 *   soon; till then all is traced, with the same picture), or "always", at once;
 * - "light_samples", "light_seed": of area lights (vtkGnomonAreaLight) and techniques with soft shadows ("raytraced",
 *   "penumbra", "coherence", "sampled", "planar"), from how many points of the light, 1 to 65536 (default 64), and which ones (default 0);
 * - "light_sampling": of the same, "sobol" (the default; evenly spread points, whose errors cancel between neighbouring
 *   pixels), "jittered" (a random one in each cell of a square grid: "light_samples" is a square then; not with
 *   "sampled", which takes points in pairs) or "random";
 * - "batch": of "sampled", points of the light whose maps are held at a time, 1 to 8 (the default);
 * - "progressive": of "sampled", points of the light that each frame adds while nothing changes, 0 (the default) for
 *   all at once (vtkGnomonShadowPass::GetProgress);
 * - "mc_rays", "mc_layers", "mc_search", "mc_classify", "mc_pyramid", "mc_filter": of "montecarlo"
 *   (docs/techniques/montecarlo.md); "mc_rays" is how many rays a pixel has along either side of the light (default 3);
 * - "light_radius": makes any light an area light, a disk across it or of a point light a ball, in the units of
 *   vtkGnomonAreaLight's Radius (default 0: as large as it says itself);
 * - "as_published": "on" for "crsm" and "crsma" by the letter of their publication, which is not exact, and for "pcss" of spot lights
 *   by that of Apelles' listings, whose widths are no lengths (default "off").
 *
 * <b>Filter kernels.</b> Techniques that filter ("pcf") average over a kernel of the map's texels:
 * - "bilinear": a square around the point, whose texels count by how far it covers them. Edges are
 *   smooth. Of size 1 it is the usual bilinear filter of 2 x 2 texels.
 * - "box": the nearest texels, as many in a row as the size says, with equal weights. The cheapest;
 *   edges show steps.
 * - "poisson": 16 texels of a disc with the size as diameter, turned at random from place to place.
 *   The cheapest for wide edges, which show noise instead of steps.
 * - "castano": as bilinear, but texels count the less the farther they are from the point (Castano
 *   2013), so that edges end softly. It has the sizes 3, 5 and 7.
 *
 * <b>A directional light's box.</b> A directional light may be limited to a box, as the sun is that
 * comes in through a window: it begins at the box's near face, which stands across it with the
 * light's Position in its middle, and goes on for the box's depth. What lies outside gets nothing of
 * this light, whether or not it receives shadows from others, and what lies outside casts nothing
 * into the box; a caster that is partly inside casts with that part. The map then holds the box
 * alone, and is the finer for it. The limit is part of the visibility, so that a light without
 * shadows (CASTS 0, ShadowAttenuation 0) has none, and a ShadowAttenuation between leaves its share
 * outside. Receivers that do not receive shadows (vtkGnomonPropKeys) are lit everywhere.
 */

#ifndef vtkGnomonLightKeys_h
#define vtkGnomonLightKeys_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkObject.h"

class vtkInformationDoubleVectorKey;
class vtkInformationIntegerKey;
class vtkInformationStringVectorKey;
class vtkLight;

class GNOMONLIGHTS_EXPORT vtkGnomonLightKeys : public vtkObject
{
public:
  static vtkGnomonLightKeys* New();
  vtkTypeMacro(vtkGnomonLightKeys, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The keys themselves, for code that fills information objects. CASTS is 0 or 1 (default 1). SETTINGS
   * holds what SetSetting sets, names and values in turn. BOX limits a
   * directional light to a box, see above: width, height and depth, each > 0, then the direction x,
   * y, z that is up in the near face, not along the light. The up direction is in the light's own
   * coordinates, as its Position is. Other kinds of light ignore it.
   */
  static vtkInformationIntegerKey* CASTS();
  static vtkInformationStringVectorKey* SETTINGS();
  static vtkInformationDoubleVectorKey* BOX();
  ///@}

  ///@{
  /**
   * Set what is asked of a light's shadows, by name, see above. A null or empty value takes the setting
   * away again, so that the pass's own counts. A setting that does not exist, and a value that it does
   * not take, are an error and change nothing. A technique's name is looked up when a frame is drawn.
   * GetSetting returns null where the light says nothing.
   */
  static void SetSetting(vtkLight* light, const char* name, const char* value);
  static const char* GetSetting(vtkLight* light, const char* name);
  ///@}

  /**
   * Whether the light casts shadows at all.
   */
  static void SetCasts(vtkLight* light, bool casts);

  ///@{
  /**
   * Set one of the settings. Sizes are clamped to what the setting takes; 0 or less takes it away.
   */
  static void SetTechnique(vtkLight* light, const char* technique);
  static void SetMapSize(vtkLight* light, int mapSizeTexels);
  static void SetKernel(vtkLight* light, const char* kernel);
  static void SetKernelSize(vtkLight* light, int kernelSizeTexels);
  ///@}

  ///@{
  /**
   * Limit a directional light to a box, and lift that limit again. Sizes that are not positive and
   * finite, and an up direction of no length, are an error and change nothing; an up direction
   * along the light makes the light cast no shadow, which the frame's report says.
   */
  static void SetBox(
    vtkLight* light, double width, double height, double depth, const double up[3]);
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
