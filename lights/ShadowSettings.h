#ifndef gnomon_lights_ShadowSettings_h
#define gnomon_lights_ShadowSettings_h

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon
{

/// Which texels around a receiver a filter reads, and with which weights.
enum class FilterKernel
{
  Bilinear, ///< a square of any place: texels count by how far it covers them
  Box,      ///< n x n texels of equal weight
  Poisson,  ///< a few texels of equal weight, scattered over a disc that turns from place to place
  Castano   ///< a square of any place whose texels count the less the farther they are
};

/// What `adaptive` and `pcss` ask before they read their whole kernel.
enum class EarlyOut
{
  None, ///< nothing
  Ring, ///< the outermost points, and believes them where they agree
  Exact ///< the least and the largest depth around the point, which never errs
};

/// How many points of the light percentage closer soft shadows look for blockers with, and how many they
/// filter with (Apelles, table 4.1).
enum class PcssSamples
{
  Low,    ///< 4 x 4 and 4 x 4
  Medium, ///< 6 x 6 and 8 x 8
  High    ///< 8 x 8 and 16 x 16
};

/// How maps of moments are averaged.
enum class MapBlur
{
  Box, ///< when they are drawn, by a box that is the same on the whole map
  Sat ///< when they are read, by a summed-area table, over a rectangle that each look-up has of its own
};

/// Which of the surfaces on a light's ray a depth map holds.
enum class DepthSurface
{
  First,   ///< the nearest
  Second,  ///< the nearest that faces away from the light
  Midpoint ///< between the nearest two
};

/// How a depth map measures.
enum class DepthMetric
{
  Linear,   ///< along the view's axis
  Euclidean ///< along the ray
};

/// How a light's view is laid onto its map.
enum class Projection
{
  OfTechnique, ///< as the technique's name says
  Uniform,     ///< all texels are of one size across the light
  Lispsm,      ///< a perspective towards the camera (Lispsm.h)
  Trapezoid,   ///< another one (Trapezoid.h)
  Splits,      ///< uniform layers for parts of the distance from the camera (Splits.h)
  Cube         ///< the faces of a cube around a positional light
};

/// What uniform views are fitted to. Warped ones and splits are made for a camera, and take `Frame`
/// where they are not fitted once.
enum class ViewFit
{
  Off,  ///< the casters: maps stay as they are when the camera moves
  Once, ///< what the camera saw when the light got these settings
  Frame ///< what the camera sees in this frame
};

/// Which triangles around one may cover a texel together with it.
enum class AdjacencyRing
{
  Edges,   ///< those across its edges
  Vertices ///< all around its corners
};

/// When a stale map is baked that a technique can do without.
enum class BakeTime
{
  Settled, ///< after some frames in which nothing that it depends on changed (BakeBackoff)
  Always   ///< at once
};

/// Which neighbours of a triangle count as adjacent to it.
enum class Adjacency
{
  Off,
  Edges,   ///< those that share an edge with it
  Vertices ///< those that share a vertex with it
};

/// What becomes of pixels that nothing decides for certain.
enum class Leftovers
{
  Trace,   ///< they get their shadow ray
  Lit,     ///< they are lit: what nothing can prove to be in shadow mostly is
  Majority ///< they get the status that most of the nine texels around them say
};

/// What becomes of pixels outside of a contour.
enum class OutsideContour
{
  Map,  ///< they keep the status that the map says
  Check ///< those whose nine texels do not agree are treated as if they were inside
};

/// Which points of an area light are taken, by each pixel for itself or by all alike.
enum class LightSampling
{
  Sobol,    ///< evenly spread ones, whose errors cancel between neighbouring pixels
  Jittered, ///< a random one in each cell of a square grid, as Curtis published it
  Random    ///< random ones
};

/// What rays through a light's map take for solid in a texel.
enum class RayLayers
{
  Peeled,  ///< each of the first few casters by itself
  NearFar, ///< all between the first and the last surface
  Near,    ///< all behind the first surface
  Eye      ///< all between the first and the last surface that the camera does not see to be empty
};

/// How a ray is searched for what it meets.
enum class RaySearch
{
  Hierarchical, ///< from cell to cell of a hierarchy: nothing is missed
  Linear        ///< in steps of equal length, with bisection
};

/// What is decided from bounds over a region of the map, before it is searched.
enum class RayClasses
{
  Off,
  Pixels, ///< all rays of a pixel at once
  Rays    ///< and then every ray by itself
};

/// How bounds over the texels of such a map are laid out.
enum class SlabHierarchy
{
  Mips,   ///< a pyramid: squares on a grid
  NBuffer ///< squares around every texel, for as many times the memory as there are levels
};

/// The most points of a light whose maps `sampled` holds at a time: one shader reads all of them.
constexpr int mostBatchSamples = 8;

/// The most planes that planar shadows can be asked for.
constexpr int mostPlanes = 64;

/// What a user can ask of a light's shadows. A light says what it wants by name
/// (vtkGnomonLightKeys), the pass says the rest, and these are the defaults of both.
struct ShadowSettings
{
  /// A name of the registry of techniques (shadowtech/Registry.h); empty: the registry's default.
  std::string technique;

  /// A name of the registry of estimators; empty: the technique's.
  std::string estimator;
  /// Whether the estimator is to follow its publication to the letter, where that is not exact.
  bool asPublished = false;
  Projection projection = Projection::OfTechnique;

  ViewFit fit = ViewFit::Off;
  /// Whether fitted uniform views move by whole texels and change their size by steps, so that edges
  /// do not swim when the camera moves.
  bool snap = true;
  int splits = 4;
  double splitLambda = 0.5; ///< 0: uniform splits, 1: logarithmic ones
  /// The share of a split's length in which it is blended into the next, so that no border shows where
  /// texels change their size.
  double splitBlend = 0.0;

  /// The side of the light's map, of each layer where it has several.
  int mapSizeTexels = 1024;

  /// Of techniques that filter. The default is the narrowest that shows no single texels (as a box
  /// does) and also smooths the steps of an edge that runs across the texels.
  FilterKernel kernel = FilterKernel::Bilinear;
  int kernelTexels = 3; ///< the side of a kernel's square, the diameter of its disc

  ///@{
  /// Of techniques with a map of moments, which bound the lit share from above. A bound up to
  /// `bleeding` counts as shadow, and the rest is spread over [0, 1]. No variance counts as less than
  /// the floor, in squares of the map's depth range (Variance.h).
  double bleeding = 0.2;
  double varianceFloor = 1e-6;
  int mapSamples = 1; ///< 1, 2, 4 or 8 samples of a texel, which are averaged
  MapBlur blur = MapBlur::Box;
  bool mipMaps = false; ///< whether pixels that see many texels read coarser levels of the map
  ///@}
  /// The kernel's width across the light, in world units, of a positional light at distance 1; 0:
  /// kernelTexels.
  double kernelWidth = 0.0;

  /// Of the adaptive filter: the points of its disc are the square of the first, the discs that it has
  /// the square of the second.
  int discGrid = 8;
  int discSets = 16;
  EarlyOut earlyOut = EarlyOut::Exact;

  PcssSamples pcssSamples = PcssSamples::Medium;

  AdjacencyRing adjacencyRing = AdjacencyRing::Edges; ///< of crsma

  DepthSurface depth = DepthSurface::First;
  DepthMetric metric = DepthMetric::Linear;
  double biasConstant = 0.0; ///< in world units
  double biasSlope = 0.0;    ///< times what a caster's depth spans within the filter's reach

  /// Of exact techniques with a map, which trace everything without one.
  BakeTime bake = BakeTime::Settled;

  ///@{
  /// Of `selective`, and of `coherence` the second: the pixels that are looked at more closely than at
  /// their texel, and what is done with them, in this order. Widths are across the contour, half of it on either side;
  /// 0: the whole image. Texels are those around a pixel's place on the map; 0: not done.
  int contourPixels = 4;
  int coherenceTexels = 4;                   ///< that have to agree for the map to be believed
  int neighbourTexels = 9;                   ///< whose triangles are intersected
  Adjacency adjacency = Adjacency::Vertices; ///< of its own texel's triangle: intersected as well
  Leftovers leftovers = Leftovers::Trace;
  OutsideContour outside = OutsideContour::Map;
  ///@}

  /// Of planar shadows: how many planes show shadows, at most.
  int planes = 8;

  ///@{
  /// Of techniques with soft shadows from many points of the light (LightSamples.h). A radius above 0
  /// replaces what the light says of its area (vtkGnomonAreaLight), in the units of OSPRay's key RADIUS: world
  /// units, of a directional light the degrees of the whole angle that it fills.
  double lightRadius = 0.0;
  int lightSamples = 64;
  int lightSeed = 0; ///< which points these are
  LightSampling lightSampling = LightSampling::Sobol;
  int batchSamples = 8; ///< of `sampled`: points whose maps are held at a time
  /// Of `sampled`: points that each frame adds while nothing changes, the first one showing the hard shadow of
  /// the centre; 0: all are in every frame.
  int progressiveSamples = 0;
  ///@}

  ///@{
  /// Of `montecarlo`.
  int mcRays = 3; ///< to the cells of a grid of so many along either side of the light
  RayLayers mcLayers = RayLayers::Peeled;
  SlabHierarchy mcPyramid = SlabHierarchy::Mips;
  RaySearch mcSearch = RaySearch::Hierarchical;
  RayClasses mcClassify = RayClasses::Rays;
  int mcFilter = 5; ///< in pixels; 0: none
  ///@}

  /// Whether another light's map holds the same for the same views and filter.
  bool storesAs(const ShadowSettings& other) const
  {
    return this->mapSamples == other.mapSamples && this->blur == other.blur &&
      this->mipMaps == other.mipMaps && this->discGrid == other.discGrid &&
      this->discSets == other.discSets && this->earlyOut == other.earlyOut &&
      this->pcssSamples == other.pcssSamples && this->adjacencyRing == other.adjacencyRing &&
      this->depth == other.depth && this->metric == other.metric &&
      this->biasConstant == other.biasConstant && this->biasSlope == other.biasSlope &&
      this->mcLayers == other.mcLayers && this->mcPyramid == other.mcPyramid;
  }
};

///@{
/// What values a setting takes, and where it lives.
struct TextSetting
{
  std::string ShadowSettings::*member;
};
struct IntegerSetting
{
  int ShadowSettings::*member;
  int smallest;
  int largest;
};
struct RealSetting
{
  double ShadowSettings::*member;
  double smallest;
  double largest;
};
struct ChoiceSetting
{
  std::vector<std::string> names; ///< by the number of the choice
  int (*get)(const ShadowSettings&);
  void (*set)(ShadowSettings&, int choice);
};
///@}

/// What a setting is about, and so whom it concerns (concerns(), shadowtech/Registry.h).
enum class SettingSubject
{
  Map,          ///< how shadows are made of a map, and which technique makes them
  LightSamples, ///< how many points of an area light are taken, and how they lie
  LightSeed,    ///< which of such points
  Planes,       ///< the planes of planar shadows
  Light         ///< what the light is, whoever makes its shadows
};

/// One setting: a line of the table that light keys, scene files and command lines are made from.
struct Setting
{
  std::string name; ///< as in scene files, "kernel_size"; on the command line "--kernel-size"
  std::string help; ///< one line for people
  std::variant<TextSetting, IntegerSetting, RealSetting, ChoiceSetting> values;
  SettingSubject about = SettingSubject::Map;

  /// Sets it from text.
  /// @return false for what it does not take; nothing changes then
  bool set(ShadowSettings& settings, const std::string& text) const;
  std::string get(const ShadowSettings& settings) const;
  /// What it takes, for error messages: "one of: bilinear, box, poisson, castano", "an integer in [1, 32]".
  std::string expected() const;
};

/// All settings, in the order in which they are listed to people.
const std::vector<Setting>& shadowSettings();

/// The setting of that name; nullptr when there is none.
const Setting* findSetting(const std::string& name);

/// "technique, map_size, ...": for error messages.
std::string settingNames();

} // namespace gnomon

#endif
