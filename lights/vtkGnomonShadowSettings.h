/**
 * @class   vtkGnomonShadowSettings
 * @brief   settings of lights' shadows
 *
 * A pass has settings for all lights (vtkGnomonShadowPass::SetSettings). A light may have its own
 * (vtkGnomonLightKeys::SetSettings), whose set values override the pass. Numbers are clamped to
 * their range. A technique that lacks a setting ignores it, with an error that names the techniques
 * that have it.
 *
 * @code
 * vtkNew<vtkGnomonShadowSettings> settings;
 * settings->SetTechnique("pcf");
 * settings->SetKernelToBox();
 * settings->SetKernelSize(5);
 * pass->SetSettings(settings);
 * @endcode
 *
 * `gnomon settings --class` generates this header from the techniques' tables.
 */

#ifndef vtkGnomonShadowSettings_h
#define vtkGnomonShadowSettings_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonNamedSettings.h"

class GNOMONLIGHTS_EXPORT vtkGnomonShadowSettings : public vtkGnomonNamedSettings
{
public:
  static vtkGnomonShadowSettings* New();
  vtkTypeMacro(vtkGnomonShadowSettings, vtkGnomonNamedSettings);

  // clang-format off

  // The technique

  ///@{
  /**
   * The shadow technique (see: gnomon techniques): one of: auto, nsm, pcf, pcss, esm, vsm, evsm,
   * msm, adaptive, lispsm, tsm, pssm, planar, sampled, montecarlo, coherence, selective, crsm,
   * crsma, silhouette, penumbra, raytraced. Default auto. The setting `technique`.
   */
  void SetTechnique(const char* value) { this->SetSetting("technique", value); }
  std::string GetTechnique() const { return this->GetSetting("technique"); }
  ///@}

  ///@{
  /**
   * What decides a point, in place of the technique's own estimator: one of: adaptive, compare,
   * pcf, pcss, pcss_as_published, single_exponential, variance, exponential, moments, montecarlo,
   * planar, raytraced, sampled, coherence, selective, penumbra, crsm, crsma, silhouette,
   * crsm_as_published, crsma_as_published. Default none. The setting `estimator`.
   */
  void SetEstimator(const char* value) { this->SetSetting("estimator", value); }
  std::string GetEstimator() const { return this->GetSetting("estimator"); }
  ///@}

  // The light

  ///@{
  /**
   * Above 0: makes the light a disc of that radius (a point light a ball); a directional one a disc
   * that fills so many degrees, in world units: a number of at least 0. Default 0. The setting
   * `light_radius`.
   */
  void SetLightRadius(double value) { this->SetReal("light_radius", value); }
  double GetLightRadius() const { return this->GetReal("light_radius"); }
  ///@}

  // The map

  ///@{
  /**
   * The side of a light's map, in texels: an integer in [16, 16384]. Default 1024. The setting
   * `map_size`.
   */
  void SetMapSize(int value) { this->SetInteger("map_size", value); }
  int GetMapSize() const { return this->GetInteger("map_size"); }
  ///@}

  ///@{
  /**
   * How the light's view is laid onto its map: one of: technique, uniform, lispsm, tsm, pssm, cube.
   * Default technique. The setting `projection`.
   */
  enum ProjectionType
  {
    PROJECTION_TECHNIQUE = 0,
    PROJECTION_UNIFORM = 1,
    PROJECTION_LISPSM = 2,
    PROJECTION_TSM = 3,
    PROJECTION_PSSM = 4,
    PROJECTION_CUBE = 5
  };
  void SetProjection(int value) { this->SetChoice("projection", value); }
  int GetProjection() const { return this->GetChoice("projection"); }
  std::string GetProjectionAsString() const { return this->GetSetting("projection"); }
  void SetProjectionToTechnique() { this->SetProjection(PROJECTION_TECHNIQUE); }
  void SetProjectionToUniform() { this->SetProjection(PROJECTION_UNIFORM); }
  void SetProjectionToLispsm() { this->SetProjection(PROJECTION_LISPSM); }
  void SetProjectionToTsm() { this->SetProjection(PROJECTION_TSM); }
  void SetProjectionToPssm() { this->SetProjection(PROJECTION_PSSM); }
  void SetProjectionToCube() { this->SetProjection(PROJECTION_CUBE); }
  ///@}

  ///@{
  /**
   * What uniform views are fitted to: all casters, or what the camera sees, once or in every frame:
   * one of: off, once, frame. Default off. The setting `fit`.
   */
  enum FitType
  {
    FIT_OFF = 0,
    FIT_ONCE = 1,
    FIT_FRAME = 2
  };
  void SetFit(int value) { this->SetChoice("fit", value); }
  int GetFit() const { return this->GetChoice("fit"); }
  std::string GetFitAsString() const { return this->GetSetting("fit"); }
  void SetFitToOff() { this->SetFit(FIT_OFF); }
  void SetFitToOnce() { this->SetFit(FIT_ONCE); }
  void SetFitToFrame() { this->SetFit(FIT_FRAME); }
  ///@}

  ///@{
  /**
   * Whether fitted views move by whole texels: one of: off, on. Default on. The setting `snap`.
   */
  void SetSnap(bool value) { this->SetChoice("snap", value ? 1 : 0); }
  bool GetSnap() const { return this->GetChoice("snap") != 0; }
  void SnapOn() { this->SetSnap(true); }
  void SnapOff() { this->SetSnap(false); }
  ///@}

  ///@{
  /**
   * The number of pssm's views: an integer in [1, 8]. Default 4. The setting `splits`.
   */
  void SetSplits(int value) { this->SetInteger("splits", value); }
  int GetSplits() const { return this->GetInteger("splits"); }
  ///@}

  ///@{
  /**
   * Where pssm splits: 0 uniform, 1 logarithmic: a number in [0, 1]. Default 0.5. The setting
   * `split_lambda`.
   */
  void SetSplitLambda(double value) { this->SetReal("split_lambda", value); }
  double GetSplitLambda() const { return this->GetReal("split_lambda"); }
  ///@}

  ///@{
  /**
   * The share of a split in which it is blended into the next: a number in [0, 0.5]. Default 0. The
   * setting `split_blend`.
   */
  void SetSplitBlend(double value) { this->SetReal("split_blend", value); }
  double GetSplitBlend() const { return this->GetReal("split_blend"); }
  ///@}

  // Depth maps

  ///@{
  /**
   * The surface on a ray that the map holds: one of: first, second, midpoint. Default first. The
   * setting `depth`.
   */
  enum DepthType
  {
    DEPTH_FIRST = 0,
    DEPTH_SECOND = 1,
    DEPTH_MIDPOINT = 2
  };
  void SetDepth(int value) { this->SetChoice("depth", value); }
  int GetDepth() const { return this->GetChoice("depth"); }
  std::string GetDepthAsString() const { return this->GetSetting("depth"); }
  void SetDepthToFirst() { this->SetDepth(DEPTH_FIRST); }
  void SetDepthToSecond() { this->SetDepth(DEPTH_SECOND); }
  void SetDepthToMidpoint() { this->SetDepth(DEPTH_MIDPOINT); }
  ///@}

  ///@{
  /**
   * How the map measures: along the view's axis, or along the ray: one of: linear, euclidean.
   * Default linear. The setting `metric`.
   */
  enum MetricType
  {
    METRIC_LINEAR = 0,
    METRIC_EUCLIDEAN = 1
  };
  void SetMetric(int value) { this->SetChoice("metric", value); }
  int GetMetric() const { return this->GetChoice("metric"); }
  std::string GetMetricAsString() const { return this->GetSetting("metric"); }
  void SetMetricToLinear() { this->SetMetric(METRIC_LINEAR); }
  void SetMetricToEuclidean() { this->SetMetric(METRIC_EUCLIDEAN); }
  ///@}

  ///@{
  /**
   * How far the map is pushed back on top of what acne needs, in world units: a number of at least
   * 0. Default 0. The setting `bias_constant`.
   */
  void SetBiasConstant(double value) { this->SetReal("bias_constant", value); }
  double GetBiasConstant() const { return this->GetReal("bias_constant"); }
  ///@}

  ///@{
  /**
   * The same, times what a caster's depth spans within the filter's reach: a number in [0, 1000].
   * Default 0. The setting `bias_slope`.
   */
  void SetBiasSlope(double value) { this->SetReal("bias_slope", value); }
  double GetBiasSlope() const { return this->GetReal("bias_slope"); }
  ///@}

  // The filter's width

  ///@{
  /**
   * The kernel's width, in texels: an integer in [1, 32]. Default 3. The setting `kernel_size`.
   */
  void SetKernelSize(int value) { this->SetInteger("kernel_size", value); }
  int GetKernelSize() const { return this->GetInteger("kernel_size"); }
  ///@}

  ///@{
  /**
   * Above 0: the kernel's width across the light (from a position: at distance 1), over which as
   * many taps are spread as kernel_size says, in world units: a number of at least 0. Default 0.
   * The setting `kernel_width`.
   */
  void SetKernelWidth(double value) { this->SetReal("kernel_width", value); }
  double GetKernelWidth() const { return this->GetReal("kernel_width"); }
  ///@}

  // The filter's kernel

  ///@{
  /**
   * What is averaged over: one of: bilinear, box, poisson, castano. Default bilinear. The setting
   * `kernel`.
   */
  enum KernelType
  {
    KERNEL_BILINEAR = 0,
    KERNEL_BOX = 1,
    KERNEL_POISSON = 2,
    KERNEL_CASTANO = 3
  };
  void SetKernel(int value) { this->SetChoice("kernel", value); }
  int GetKernel() const { return this->GetChoice("kernel"); }
  std::string GetKernelAsString() const { return this->GetSetting("kernel"); }
  void SetKernelToBilinear() { this->SetKernel(KERNEL_BILINEAR); }
  void SetKernelToBox() { this->SetKernel(KERNEL_BOX); }
  void SetKernelToPoisson() { this->SetKernel(KERNEL_POISSON); }
  void SetKernelToCastano() { this->SetKernel(KERNEL_CASTANO); }
  ///@}

  // Percentage closer soft shadows

  ///@{
  /**
   * Points of the light to look for blockers with, and to filter with: 16 and 16, 36 and 64, 64 and
   * 256: one of: low, medium, high. Default medium. The setting `pcss_samples`.
   */
  enum PcssSamplesType
  {
    PCSS_SAMPLES_LOW = 0,
    PCSS_SAMPLES_MEDIUM = 1,
    PCSS_SAMPLES_HIGH = 2
  };
  void SetPcssSamples(int value) { this->SetChoice("pcss_samples", value); }
  int GetPcssSamples() const { return this->GetChoice("pcss_samples"); }
  std::string GetPcssSamplesAsString() const { return this->GetSetting("pcss_samples"); }
  void SetPcssSamplesToLow() { this->SetPcssSamples(PCSS_SAMPLES_LOW); }
  void SetPcssSamplesToMedium() { this->SetPcssSamples(PCSS_SAMPLES_MEDIUM); }
  void SetPcssSamplesToHigh() { this->SetPcssSamples(PCSS_SAMPLES_HIGH); }
  ///@}

  // Early out

  ///@{
  /**
   * What is asked before the whole kernel is read: nothing, its outermost ring (adaptive), or the
   * depths' bounds: one of: none, ring, exact. Default exact. The setting `early_out`.
   */
  enum EarlyOutType
  {
    EARLY_OUT_NONE = 0,
    EARLY_OUT_RING = 1,
    EARLY_OUT_EXACT = 2
  };
  void SetEarlyOut(int value) { this->SetChoice("early_out", value); }
  int GetEarlyOut() const { return this->GetChoice("early_out"); }
  std::string GetEarlyOutAsString() const { return this->GetSetting("early_out"); }
  void SetEarlyOutToNone() { this->SetEarlyOut(EARLY_OUT_NONE); }
  void SetEarlyOutToRing() { this->SetEarlyOut(EARLY_OUT_RING); }
  void SetEarlyOutToExact() { this->SetEarlyOut(EARLY_OUT_EXACT); }
  ///@}

  // Publications

  ///@{
  /**
   * By the letter of its publication, which is not right: one of: off, on. Default off. The setting
   * `as_published`.
   */
  void SetAsPublished(bool value) { this->SetChoice("as_published", value ? 1 : 0); }
  bool GetAsPublished() const { return this->GetChoice("as_published") != 0; }
  void AsPublishedOn() { this->SetAsPublished(true); }
  void AsPublishedOff() { this->SetAsPublished(false); }
  ///@}

  // Maps of moments

  ///@{
  /**
   * Up to what visibility points are dark: a number in [0, 0.99]. Default 0.2. The setting
   * `bleeding`.
   */
  void SetBleeding(double value) { this->SetReal("bleeding", value); }
  double GetBleeding() const { return this->GetReal("bleeding"); }
  ///@}

  ///@{
  /**
   * Averaged over the same box of texels everywhere, or over each point's own rectangle, by
   * summed-area tables (not esm, evsm): one of: box, sat. Default box. The setting `blur`.
   */
  enum BlurType
  {
    BLUR_BOX = 0,
    BLUR_SAT = 1
  };
  void SetBlur(int value) { this->SetChoice("blur", value); }
  int GetBlur() const { return this->GetChoice("blur"); }
  std::string GetBlurAsString() const { return this->GetSetting("blur"); }
  void SetBlurToBox() { this->SetBlur(BLUR_BOX); }
  void SetBlurToSat() { this->SetBlur(BLUR_SAT); }
  ///@}

  ///@{
  /**
   * With blur=box: whether pixels that see many texels read coarser levels: one of: off, on.
   * Default off. The setting `mip_maps`.
   */
  void SetMipMaps(bool value) { this->SetChoice("mip_maps", value ? 1 : 0); }
  bool GetMipMaps() const { return this->GetChoice("mip_maps") != 0; }
  void MipMapsOn() { this->SetMipMaps(true); }
  void MipMapsOff() { this->SetMipMaps(false); }
  ///@}

  ///@{
  /**
   * How many samples of a texel are drawn and averaged: one of: 1, 2, 4, 8. Default 1. The setting
   * `map_samples`.
   */
  enum MapSamplesType
  {
    MAP_SAMPLES_1 = 0,
    MAP_SAMPLES_2 = 1,
    MAP_SAMPLES_4 = 2,
    MAP_SAMPLES_8 = 3
  };
  void SetMapSamples(int value) { this->SetChoice("map_samples", value); }
  int GetMapSamples() const { return this->GetChoice("map_samples"); }
  std::string GetMapSamplesAsString() const { return this->GetSetting("map_samples"); }
  void SetMapSamplesTo1() { this->SetMapSamples(MAP_SAMPLES_1); }
  void SetMapSamplesTo2() { this->SetMapSamples(MAP_SAMPLES_2); }
  void SetMapSamplesTo4() { this->SetMapSamples(MAP_SAMPLES_4); }
  void SetMapSamplesTo8() { this->SetMapSamples(MAP_SAMPLES_8); }
  ///@}

  // Variance

  ///@{
  /**
   * The least variance of depths, in share of the map's depth range, squared: a number in [1e-09,
   * 1]. Default 1e-06. The setting `variance_floor`.
   */
  void SetVarianceFloor(double value) { this->SetReal("variance_floor", value); }
  double GetVarianceFloor() const { return this->GetReal("variance_floor"); }
  ///@}

  // The disc

  ///@{
  /**
   * A disc's points are the square of this: an integer in [2, 16]. Default 8. The setting
   * `disc_grid`.
   */
  void SetDiscGrid(int value) { this->SetInteger("disc_grid", value); }
  int GetDiscGrid() const { return this->GetInteger("disc_grid"); }
  ///@}

  ///@{
  /**
   * Discs that differ are the square of this: an integer in [1, 32]. Default 16. The setting
   * `disc_sets`.
   */
  void SetDiscSets(int value) { this->SetInteger("disc_sets", value); }
  int GetDiscSets() const { return this->GetInteger("disc_sets"); }
  ///@}

  // Planes

  ///@{
  /**
   * How many planes show shadows, at most: the largest: an integer in [1, 64]. Default 8. The
   * setting `planes`.
   */
  void SetPlanes(int value) { this->SetInteger("planes", value); }
  int GetPlanes() const { return this->GetInteger("planes"); }
  ///@}

  // Samples of area lights

  ///@{
  /**
   * How many points of the light cast shadows: an integer in [1, 65536]. Default 64. The setting
   * `light_samples`.
   */
  void SetLightSamples(int value) { this->SetInteger("light_samples", value); }
  int GetLightSamples() const { return this->GetInteger("light_samples"); }
  ///@}

  ///@{
  /**
   * Evenly spread points, random ones in the cells of a grid (light_samples is a square then), or
   * random ones: one of: sobol, jittered, random. Default sobol. The setting `light_sampling`.
   */
  enum LightSamplingType
  {
    LIGHT_SAMPLING_SOBOL = 0,
    LIGHT_SAMPLING_JITTERED = 1,
    LIGHT_SAMPLING_RANDOM = 2
  };
  void SetLightSampling(int value) { this->SetChoice("light_sampling", value); }
  int GetLightSampling() const { return this->GetChoice("light_sampling"); }
  std::string GetLightSamplingAsString() const { return this->GetSetting("light_sampling"); }
  void SetLightSamplingToSobol() { this->SetLightSampling(LIGHT_SAMPLING_SOBOL); }
  void SetLightSamplingToJittered() { this->SetLightSampling(LIGHT_SAMPLING_JITTERED); }
  void SetLightSamplingToRandom() { this->SetLightSampling(LIGHT_SAMPLING_RANDOM); }
  ///@}

  // Random points of area lights

  ///@{
  /**
   * Which random points these are: an integer in [0, 2147483647]. Default 0. The setting
   * `light_seed`.
   */
  void SetLightSeed(int value) { this->SetInteger("light_seed", value); }
  int GetLightSeed() const { return this->GetInteger("light_seed"); }
  ///@}

  // Maps of samples

  ///@{
  /**
   * How many points of the light have their maps held at a time: an integer in [1, 8]. Default 8.
   * The setting `batch`.
   */
  void SetBatch(int value) { this->SetInteger("batch", value); }
  int GetBatch() const { return this->GetInteger("batch"); }
  ///@}

  ///@{
  /**
   * Above 0: how many points of the light each frame adds while nothing changes, after a first
   * frame with hard shadows: an integer in [0, 65536]. Default 0. The setting `progressive`.
   */
  void SetProgressive(int value) { this->SetInteger("progressive", value); }
  int GetProgressive() const { return this->GetInteger("progressive"); }
  ///@}

  // Rays through depth layers

  ///@{
  /**
   * Rays of a pixel along either side of a grid on the light, so that 3 makes 9: an integer in [1,
   * 32]. Default 3. The setting `mc_rays`.
   */
  void SetMcRays(int value) { this->SetInteger("mc_rays", value); }
  int GetMcRays() const { return this->GetInteger("mc_rays"); }
  ///@}

  ///@{
  /**
   * What is solid in a texel: each of up to four casters, all between the first and the last
   * surface, all behind the first, or (eye) between the first and the last what the camera does not
   * see to be empty: one of: peeled, near_far, near, eye. Default peeled. The setting `mc_layers`.
   */
  enum McLayersType
  {
    MC_LAYERS_PEELED = 0,
    MC_LAYERS_NEAR_FAR = 1,
    MC_LAYERS_NEAR = 2,
    MC_LAYERS_EYE = 3
  };
  void SetMcLayers(int value) { this->SetChoice("mc_layers", value); }
  int GetMcLayers() const { return this->GetChoice("mc_layers"); }
  std::string GetMcLayersAsString() const { return this->GetSetting("mc_layers"); }
  void SetMcLayersToPeeled() { this->SetMcLayers(MC_LAYERS_PEELED); }
  void SetMcLayersToNearFar() { this->SetMcLayers(MC_LAYERS_NEAR_FAR); }
  void SetMcLayersToNear() { this->SetMcLayers(MC_LAYERS_NEAR); }
  void SetMcLayersToEye() { this->SetMcLayers(MC_LAYERS_EYE); }
  ///@}

  ///@{
  /**
   * How rays are searched: from cell to cell of a hierarchy, or in steps of equal length, which
   * misses some: one of: hierarchical, linear. Default hierarchical. The setting `mc_search`.
   */
  enum McSearchType
  {
    MC_SEARCH_HIERARCHICAL = 0,
    MC_SEARCH_LINEAR = 1
  };
  void SetMcSearch(int value) { this->SetChoice("mc_search", value); }
  int GetMcSearch() const { return this->GetChoice("mc_search"); }
  std::string GetMcSearchAsString() const { return this->GetSetting("mc_search"); }
  void SetMcSearchToHierarchical() { this->SetMcSearch(MC_SEARCH_HIERARCHICAL); }
  void SetMcSearchToLinear() { this->SetMcSearch(MC_SEARCH_LINEAR); }
  ///@}

  ///@{
  /**
   * What bounds over the map decide without a search: nothing, pixels, or pixels and then single
   * rays: one of: off, pixels, rays. Default rays. The setting `mc_classify`.
   */
  enum McClassifyType
  {
    MC_CLASSIFY_OFF = 0,
    MC_CLASSIFY_PIXELS = 1,
    MC_CLASSIFY_RAYS = 2
  };
  void SetMcClassify(int value) { this->SetChoice("mc_classify", value); }
  int GetMcClassify() const { return this->GetChoice("mc_classify"); }
  std::string GetMcClassifyAsString() const { return this->GetSetting("mc_classify"); }
  void SetMcClassifyToOff() { this->SetMcClassify(MC_CLASSIFY_OFF); }
  void SetMcClassifyToPixels() { this->SetMcClassify(MC_CLASSIFY_PIXELS); }
  void SetMcClassifyToRays() { this->SetMcClassify(MC_CLASSIFY_RAYS); }
  ///@}

  ///@{
  /**
   * How the bounds over the map lie: on a grid, or around every texel, which takes ten times the
   * memory: one of: mips, nbuffer. Default mips. The setting `mc_pyramid`.
   */
  enum McPyramidType
  {
    MC_PYRAMID_MIPS = 0,
    MC_PYRAMID_NBUFFER = 1
  };
  void SetMcPyramid(int value) { this->SetChoice("mc_pyramid", value); }
  int GetMcPyramid() const { return this->GetChoice("mc_pyramid"); }
  std::string GetMcPyramidAsString() const { return this->GetSetting("mc_pyramid"); }
  void SetMcPyramidToMips() { this->SetMcPyramid(MC_PYRAMID_MIPS); }
  void SetMcPyramidToNbuffer() { this->SetMcPyramid(MC_PYRAMID_NBUFFER); }
  ///@}

  ///@{
  /**
   * Radius of the filter that takes off the noise, on surfaces; 0: none, in pixels: an integer in
   * [0, 32]. Default 5. The setting `mc_filter`.
   */
  void SetMcFilter(int value) { this->SetInteger("mc_filter", value); }
  int GetMcFilter() const { return this->GetInteger("mc_filter"); }
  ///@}

  // Coherence

  ///@{
  /**
   * How many texels have to agree for the map to be believed; off: it is not, in texels: one of:
   * off, 4, 9. Default 4. The setting `coherence`.
   */
  enum CoherenceType
  {
    COHERENCE_OFF = 0,
    COHERENCE_4 = 1,
    COHERENCE_9 = 2
  };
  void SetCoherence(int value) { this->SetChoice("coherence", value); }
  int GetCoherence() const { return this->GetChoice("coherence"); }
  std::string GetCoherenceAsString() const { return this->GetSetting("coherence"); }
  void SetCoherenceToOff() { this->SetCoherence(COHERENCE_OFF); }
  void SetCoherenceTo4() { this->SetCoherence(COHERENCE_4); }
  void SetCoherenceTo9() { this->SetCoherence(COHERENCE_9); }
  ///@}

  // The chain of tests

  ///@{
  /**
   * How wide the contour between light and shadow is that is looked at, in pixels: one of: 2, 4, 6,
   * image. Default 4. The setting `contour`.
   */
  enum ContourType
  {
    CONTOUR_2 = 0,
    CONTOUR_4 = 1,
    CONTOUR_6 = 2,
    CONTOUR_IMAGE = 3
  };
  void SetContour(int value) { this->SetChoice("contour", value); }
  int GetContour() const { return this->GetChoice("contour"); }
  std::string GetContourAsString() const { return this->GetSetting("contour"); }
  void SetContourTo2() { this->SetContour(CONTOUR_2); }
  void SetContourTo4() { this->SetContour(CONTOUR_4); }
  void SetContourTo6() { this->SetContour(CONTOUR_6); }
  void SetContourToImage() { this->SetContour(CONTOUR_IMAGE); }
  ///@}

  ///@{
  /**
   * Of how many texels the triangles are met, in texels: one of: off, 1, 4, 9. Default 9. The
   * setting `neighbours`.
   */
  enum NeighboursType
  {
    NEIGHBOURS_OFF = 0,
    NEIGHBOURS_1 = 1,
    NEIGHBOURS_4 = 2,
    NEIGHBOURS_9 = 3
  };
  void SetNeighbours(int value) { this->SetChoice("neighbours", value); }
  int GetNeighbours() const { return this->GetChoice("neighbours"); }
  std::string GetNeighboursAsString() const { return this->GetSetting("neighbours"); }
  void SetNeighboursToOff() { this->SetNeighbours(NEIGHBOURS_OFF); }
  void SetNeighboursTo1() { this->SetNeighbours(NEIGHBOURS_1); }
  void SetNeighboursTo4() { this->SetNeighbours(NEIGHBOURS_4); }
  void SetNeighboursTo9() { this->SetNeighbours(NEIGHBOURS_9); }
  ///@}

  ///@{
  /**
   * Which neighbours of its own texel's triangle are met: those across its edges, or all around its
   * vertices: one of: off, edges, vertices. Default vertices. The setting `adjacency`.
   */
  enum AdjacencyType
  {
    ADJACENCY_OFF = 0,
    ADJACENCY_EDGES = 1,
    ADJACENCY_VERTICES = 2
  };
  void SetAdjacency(int value) { this->SetChoice("adjacency", value); }
  int GetAdjacency() const { return this->GetChoice("adjacency"); }
  std::string GetAdjacencyAsString() const { return this->GetSetting("adjacency"); }
  void SetAdjacencyToOff() { this->SetAdjacency(ADJACENCY_OFF); }
  void SetAdjacencyToEdges() { this->SetAdjacency(ADJACENCY_EDGES); }
  void SetAdjacencyToVertices() { this->SetAdjacency(ADJACENCY_VERTICES); }
  ///@}

  ///@{
  /**
   * What becomes of what is still uncertain: traced, lit, or what most of nine texels say: one of:
   * trace, lit, majority. Default trace. The setting `leftovers`.
   */
  enum LeftoversType
  {
    LEFTOVERS_TRACE = 0,
    LEFTOVERS_LIT = 1,
    LEFTOVERS_MAJORITY = 2
  };
  void SetLeftovers(int value) { this->SetChoice("leftovers", value); }
  int GetLeftovers() const { return this->GetChoice("leftovers"); }
  std::string GetLeftoversAsString() const { return this->GetSetting("leftovers"); }
  void SetLeftoversToTrace() { this->SetLeftovers(LEFTOVERS_TRACE); }
  void SetLeftoversToLit() { this->SetLeftovers(LEFTOVERS_LIT); }
  void SetLeftoversToMajority() { this->SetLeftovers(LEFTOVERS_MAJORITY); }
  ///@}

  ///@{
  /**
   * Outside of the contour, whether the map is believed, or looked at more closely where nine
   * texels do not agree: one of: map, check. Default map. The setting `outside`.
   */
  enum OutsideType
  {
    OUTSIDE_MAP = 0,
    OUTSIDE_CHECK = 1
  };
  void SetOutside(int value) { this->SetChoice("outside", value); }
  int GetOutside() const { return this->GetChoice("outside"); }
  std::string GetOutsideAsString() const { return this->GetSetting("outside"); }
  void SetOutsideToMap() { this->SetOutside(OUTSIDE_MAP); }
  void SetOutsideToCheck() { this->SetOutside(OUTSIDE_CHECK); }
  ///@}

  // Optional maps

  ///@{
  /**
   * When a stale map is baked: after frames in which nothing changed, until when all is traced, or
   * at once: one of: settled, always. Default settled. The setting `bake`.
   */
  enum BakeType
  {
    BAKE_SETTLED = 0,
    BAKE_ALWAYS = 1
  };
  void SetBake(int value) { this->SetChoice("bake", value); }
  int GetBake() const { return this->GetChoice("bake"); }
  std::string GetBakeAsString() const { return this->GetSetting("bake"); }
  void SetBakeToSettled() { this->SetBake(BAKE_SETTLED); }
  void SetBakeToAlways() { this->SetBake(BAKE_ALWAYS); }
  ///@}

  // Edges of hard shadows

  ///@{
  /**
   * Shadow rays of a pixel at an edge: more than one smooth the edges of hard shadows: one of: 1,
   * 4, 16, 64. Default 1. The setting `edge_samples`.
   */
  enum EdgeSamplesType
  {
    EDGE_SAMPLES_1 = 0,
    EDGE_SAMPLES_4 = 1,
    EDGE_SAMPLES_16 = 2,
    EDGE_SAMPLES_64 = 3
  };
  void SetEdgeSamples(int value) { this->SetChoice("edge_samples", value); }
  int GetEdgeSamples() const { return this->GetChoice("edge_samples"); }
  std::string GetEdgeSamplesAsString() const { return this->GetSetting("edge_samples"); }
  void SetEdgeSamplesTo1() { this->SetEdgeSamples(EDGE_SAMPLES_1); }
  void SetEdgeSamplesTo4() { this->SetEdgeSamples(EDGE_SAMPLES_4); }
  void SetEdgeSamplesTo16() { this->SetEdgeSamples(EDGE_SAMPLES_16); }
  void SetEdgeSamplesTo64() { this->SetEdgeSamples(EDGE_SAMPLES_64); }
  ///@}

  // Adjacency

  ///@{
  /**
   * Which triangles around one may cover a texel with it: across its edges, or all around its
   * vertices, which decides more and takes longer: one of: edges, vertices. Default edges. The
   * setting `adjacency_ring`.
   */
  enum AdjacencyRingType
  {
    ADJACENCY_RING_EDGES = 0,
    ADJACENCY_RING_VERTICES = 1
  };
  void SetAdjacencyRing(int value) { this->SetChoice("adjacency_ring", value); }
  int GetAdjacencyRing() const { return this->GetChoice("adjacency_ring"); }
  std::string GetAdjacencyRingAsString() const { return this->GetSetting("adjacency_ring"); }
  void SetAdjacencyRingToEdges() { this->SetAdjacencyRing(ADJACENCY_RING_EDGES); }
  void SetAdjacencyRingToVertices() { this->SetAdjacencyRing(ADJACENCY_RING_VERTICES); }
  ///@}

  // Refinement of area lights' shadows

  ///@{
  /**
   * Above 0: how many points of the light cast shadows in the first frame after a change; while
   * nothing changes, each frame takes four times as many, until all do: an integer in [0, 65536].
   * Default 0. The setting `moving_samples`.
   */
  void SetMovingSamples(int value) { this->SetInteger("moving_samples", value); }
  int GetMovingSamples() const { return this->GetInteger("moving_samples"); }
  ///@}

  // clang-format on

protected:
  vtkGnomonShadowSettings() = default;
  ~vtkGnomonShadowSettings() override = default;

private:
  vtkGnomonShadowSettings(const vtkGnomonShadowSettings&) = delete;
  void operator=(const vtkGnomonShadowSettings&) = delete;
};

#endif
