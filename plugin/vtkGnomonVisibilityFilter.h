/**
 * @class   vtkGnomonVisibilityFilter
 * @brief   shadow as data: how much light reaches each cell or point of a polydata
 *
 * @code
 * vtkNew<vtkGnomonVisibilityFilter> filter;
 * filter->SetInputConnection(facade->GetOutputPort());    // receivers
 * filter->AddInputConnection(1, town->GetOutputPort());   // casters, any number of them
 * filter->AddSunDay(sun, 10.0);                           // vtkGnomonSun, every 10 minutes
 * filter->Update();
 * filter->GetOutput()->GetCellData()->GetArray("Hours");  // of sun
 * @endcode
 *
 * The output is the receivers with arrays, one tuple for each cell, or for each point:
 *
 * - `LitFraction` (float): the hours lit over all hours of the lights, in [0, 1]. This and the next
 *   three are there if there are lights.
 * - `LitFractionError` (float), with several samples: the fraction's standard error, from how much
 *   the samples differ. It is 0 where they all agree: a shadow narrower than their spacing may be
 *   missed.
 * - `Hours` (float): the hours lit, as the lights' hours say.
 * - `Bits` (unsigned char), if asked: bit i % 8 (1 << i % 8) of component i / 8 is 1 if light
 *   i lights at least half of the samples.
 * - `SkyView` (float), if a sky is added: the light that arrives from it, 1 on a horizontal surface
 *   that nothing hides. `SkyViewError` (float): its standard error, from how much the directions
 *   differ.
 * - `Why` (unsigned char), of one light (SetExplainedLight) and the middle of the cell: a WhyType.
 * - `Blocker` (vtkIdType): the cell nearest to the receiver that blocks that light, a cell of its
 *   own polydata; -1 if none does. `BlockerInput` (int): 0 if that is the receivers, k for
 *   the k-th casters; -1.
 *
 * A shadow ray is the one of vtkGnomonShadowPass's exact techniques: it starts off the surface by a
 * bound on rounding, and Embree traces it (docs/dev/numerics.md). There is no epsilon to
 * choose. Casters are polygons and strips, both sides of them, in the triangles that VTK draws.
 * The picture can differ: it shadows the side that the camera sees, from the curved surface where
 * facets are shaded smooth, and knows props' keys, clipping planes, textures and glyphs.
 *
 * Receivers are polygons and strips. Their front counts: the side that shows the corners
 * counter-clockwise (SetReceivingSide). Vertices, lines and degenerate cells get 0 and NO_SURFACE.
 *
 * A light takes a few hundred bytes, for any number of cells. Bits take a bit more for each cell.
 * ProgressEvent comes several times a second. An aborted execution (SetAbortExecute) leaves the
 * receivers without arrays and keeps its results so far: if nothing else changes, the next Update()
 * goes on from there. If only lights or settings change, the next execution reuses the acceleration
 * structure.
 * Same input, same arrays: to the last bit, on any number of threads.
 *
 * A setting or an input that makes no sense is one error (vtkErrorMacro). The setting then stays as
 * it was; an execution passes the receivers through without arrays.
 *
 * @sa vtkGnomonSun
 */

#ifndef vtkGnomonVisibilityFilter_h
#define vtkGnomonVisibilityFilter_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkPolyDataAlgorithm.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

#include <memory> // For std::unique_ptr

class vtkGnomonSun;
VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkLight;
VTK_ABI_NAMESPACE_END

class GNOMONPLUGIN_EXPORT vtkGnomonVisibilityFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkGnomonVisibilityFilter* New();
  vtkTypeMacro(vtkGnomonVisibilityFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add a light that shines from one direction: towards the light, in world coordinates, of any
   * length. `hours` is how long it shines, 0 or more. Of arrays, `directions` has three components
   * and `hours` one, as many of them, or is null for an hour each. The arrays are read at once.
   */
  void AddDirection(const double towards[3], double hours = 1.0);
  void AddDirection(double x, double y, double z, double hours = 1.0);
  void AddDirections(vtkDataArray* directions, vtkDataArray* hours = nullptr)
    VTK_EXPECTS(directions != nullptr);
  ///@}

  ///@{
  /**
   * Add the suns of a day, or of a year, at a place (vtkGnomonSun::MakeDayPath, MakeYearPath). They
   * are found at once. Up becomes the sun's.
   */
  void AddSunDay(vtkGnomonSun* sun, double stepMinutes) VTK_EXPECTS(sun != nullptr);
  void AddSunYear(vtkGnomonSun* sun, int dayStep, double stepMinutes) VTK_EXPECTS(sun != nullptr);
  ///@}

  /**
   * Add a light, with its position or direction, cone and box (vtkGnomonLightKeys::SetBox) at the
   * time of the execution. Head and camera lights are taken through their transform matrix. Only
   * the centre of an area light shines; switches, colours and attenuation do not count.
   */
  void AddLight(vtkLight* light, double hours = 1.0) VTK_EXPECTS(light != nullptr);

  /**
   * Models of a sky.
   */
  enum SkyModelType
  {
    UNIFORM = 0, ///< as bright from everywhere, from below, too: ambient occlusion
    DOME = 1,    ///< as bright from everywhere above the horizon, dark below it
    OVERCAST = 2 ///< CIE's overcast sky: three times as bright in the zenith as at the horizon
  };

  /**
   * Add the light of a sky, or replace it: 1/pi times the integral of its radiance and the cosine,
   * over the directions that nothing hides. Of `directions` rays from each element their density is
   * in proportion to the cosine; they start at its Samples by chance. A point has the mean of the
   * cells that meet in it. With ReceivingSide BOTH, the side that sees more counts. Beside a wall,
   * 64 directions have a true error of 0.015 (RMS), 1,024 of 0.0023. SkyViewError is larger: 2 to 7
   * times that, with 16 to 4,096 directions.
   *
   * @param model a SkyModelType; DOME and OVERCAST need an Up
   * @param directions a power of two in [16, 65536]
   */
  void AddSky(int model, int directions = 1024);
  ///@{
  /**
   * The sky that was added; 0 directions without one.
   */
  int GetSkyModel();
  int GetSkyDirections();
  ///@}

  /**
   * Add the 145 patches of a sky (Tregenza 1987) as directions to their middles, each with its
   * solid angle in steradians as hours. So `Hours` is how much of the sky an element sees, and
   * `Bits` are the matrix of elements and patches that daylight is computed with. Patches go from
   * the horizon up, ring by ring, clockwise as seen from above. Each ring begins in the north.
   *
   * @param up towards the zenith, of any length; becomes Up
   * @param north of any length, not along up
   */
  void AddSkyPatches(const double up[3], const double north[3]);

  ///@{
  /**
   * Set the distance, in world coordinates, beyond which nothing hides the sky; 0: no limit.
   * Default: 0.
   */
  virtual void SetSkyDistance(double distance);
  vtkGetMacro(SkyDistance, double);
  ///@}

  /**
   * Remove all directions and lights, and the sky.
   */
  void ClearLights();

  /**
   * Return the number of directions, suns and lights. They are numbered from 0 in the order of
   * adding.
   */
  int GetNumberOfLights();

  ///@{
  /**
   * Return a light by its number. GetDirection gives a unit vector towards the light, and zeros for
   * a vtkLight; GetLight returns null for a direction. For a number that does not exist they give
   * zeros and null, and GetHours 0.
   */
  void GetDirection(int index, double towards[3]);
  vtkLight* GetLight(int index);
  double GetHours(int index);
  ///@}

  ///@{
  /**
   * Set the angle under which the scene sees a light with a direction, in degrees, in [0, 90). The
   * sun's is 0.53. Use it with Samples of 2 or more: each looks at another point of an even disc.
   * 0: a point. Default: 0. Other numbers are clamped to [0, 89]; NaN is an error and changes
   * nothing.
   */
  virtual void SetAngularDiameter(double degrees);
  vtkGetMacro(AngularDiameter, double);
  ///@}

  ///@{
  /**
   * Set the number of rays from an element to each light, in [1, 4096]. One ray starts in the
   * middle of a cell. More are spread evenly over it (scrambled Sobol points): best a power of two.
   * Points have one place, and more than one ray only with an AngularDiameter. Default: 1.
   */
  vtkSetClampMacro(Samples, int, 1, 4096);
  vtkGetMacro(Samples, int);
  ///@}

  /**
   * Elements that results belong to.
   */
  enum ElementType
  {
    CELLS = 0,
    POINTS = 1
  };

  ///@{
  /**
   * Choose results for the receivers' cells or points. A point is lit if one of the cells that meet
   * in it is lit there: its rays start a thousandth of the way into each. Default: CELLS.
   */
  vtkSetClampMacro(Elements, int, CELLS, POINTS);
  vtkGetMacro(Elements, int);
  void SetElementsToCells() { this->SetElements(CELLS); }
  void SetElementsToPoints() { this->SetElements(POINTS); }
  ///@}

  /**
   * Sides of a surface.
   */
  enum SideType
  {
    FRONT = 0,
    BACK = 1,
    BOTH = 2
  };

  ///@{
  /**
   * Set the side of the receivers that light falls on. BOTH: for each light the side that faces it.
   * Default: FRONT.
   */
  vtkSetClampMacro(ReceivingSide, int, FRONT, BOTH);
  vtkGetMacro(ReceivingSide, int);
  ///@}

  ///@{
  /**
   * Let the receivers cast shadows, too. Default: on.
   */
  vtkSetMacro(ReceiversCast, bool);
  vtkGetMacro(ReceiversCast, bool);
  vtkBooleanMacro(ReceiversCast, bool);
  ///@}

  ///@{
  /**
   * Set the vector that points up, of any length. A direction that is not above the horizon gives
   * no light. (0, 0, 0): there is no horizon. Default: (0, 0, 0), until suns are added.
   */
  virtual void SetUp(double x, double y, double z);
  void SetUp(const double up[3]) { this->SetUp(up[0], up[1], up[2]); }
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Add `Bits` to the output: an eighth of a byte for each light and element. Default: off.
   */
  vtkSetMacro(ComputeBits, bool);
  vtkGetMacro(ComputeBits, bool);
  vtkBooleanMacro(ComputeBits, bool);
  ///@}

  /**
   * The numbers in `Why`.
   */
  enum WhyType
  {
    LIT = 0,
    SELF = 1,          ///< the receivers are in the way
    OTHER = 2,         ///< one of the casters is
    TURNED_AWAY = 3,   ///< the surface does not face the light
    BELOW_HORIZON = 4, ///< the light is not above it
    OUT_OF_REACH = 5,  ///< outside of the light's cone or box
    NO_SURFACE = 6     ///< a vertex, a line, a cell or a point without area
  };

  ///@{
  /**
   * Add `Why`, `Blocker` and `BlockerInput` to the output, for the light with this number; -1: the
   * last one. Default: on, -1.
   */
  vtkSetMacro(ComputeReasons, bool);
  vtkGetMacro(ComputeReasons, bool);
  vtkBooleanMacro(ComputeReasons, bool);
  vtkSetMacro(ExplainedLight, int);
  vtkGetMacro(ExplainedLight, int);
  ///@}

  /**
   * Return the number of shadow rays of the last execution and of the aborted ones that it
   * continued. Surfaces send no rays to lights that they do not face.
   */
  vtkTypeInt64 GetNumberOfRays();

  ///@{
  /**
   * Return the names of the arrays.
   */
  static const char* GetLitFractionName() { return "LitFraction"; }
  static const char* GetLitFractionErrorName() { return "LitFractionError"; }
  static const char* GetHoursName() { return "Hours"; }
  static const char* GetBitsName() { return "Bits"; }
  static const char* GetSkyViewName() { return "SkyView"; }
  static const char* GetSkyViewErrorName() { return "SkyViewError"; }
  static const char* GetWhyName() { return "Why"; }
  static const char* GetBlockerName() { return "Blocker"; }
  static const char* GetBlockerInputName() { return "BlockerInput"; }
  ///@}

  /**
   * Return the time of the last change of the filter or its lights. An aborted execution is never
   * up to date.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkGnomonVisibilityFilter();
  ~vtkGnomonVisibilityFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

  double AngularDiameter = 0.0;
  double SkyDistance = 0.0;
  int Samples = 1;
  int Elements = CELLS;
  int ReceivingSide = FRONT;
  bool ReceiversCast = true;
  double Up[3] = { 0.0, 0.0, 0.0 };
  bool ComputeBits = false;
  bool ComputeReasons = true;
  int ExplainedLight = -1;

private:
  vtkGnomonVisibilityFilter(const vtkGnomonVisibilityFilter&) = delete;
  void operator=(const vtkGnomonVisibilityFilter&) = delete;

  bool CanRun();
  bool BeginRun(vtkPolyData* receivers, int samples);

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
