/**
 * @class   vtkGnomonShadowPass
 * @brief   draws a renderer's scene with shadows, by a choice of techniques
 *
 * @code
 * vtkNew<vtkGnomonShadowPass> shadows;
 * renderer->SetPass(shadows);
 * @endcode
 *
 * The pass multiplies each light's colour by its visibility, a number in [0, 1] per point, while
 * VTK shades; materials, ambient light and everything else stay VTK's. A frame is: lights,
 * occluders, receivers, maps, visibility, shading (docs/dev/architecture.md).
 *
 * Lights are the renderer's vtkLights. What one of them asks for is said with vtkGnomonLightKeys,
 * what one prop does (casts, receives, one-sided) with vtkGnomonPropKeys. Opaque surfaces cast and
 * receive, by mappers of polydata, data sets, composite data and glyphs, under actors, assemblies,
 * followers and props with levels of detail (docs/guide/what_casts.md). Translucent surfaces
 * receive, and cast only if asked. Volumes receive, if shaded. Everything else is drawn as VTK
 * draws it; a warning names what is lit and left out. A headlight that is the only light casts only
 * if asked.
 *
 * Other passes may stand around it, or inside it as its delegate (docs/guide/passes.md).
 *
 * The pass steps aside for hardware selection, and draws the scene as plain VTK does, without a map
 * or a ray, when no light casts. It leaves the OpenGL state as it found it.
 *
 * The pass says once what is wrong with a frame, by an error or a warning. It says so again if the
 * text changes, or if the mistake returns after a frame without it.
 *
 * Techniques take OpenGL 4.3. Those that trace from the CPU (raytraced, silhouette, crsm, crsma,
 * penumbra) take 3.2; below 4.3 lights with others have raytraced instead, after an error
 * (vtkErrorMacro). Below 3.2 the scene is drawn without shadows, after an error.
 */

#ifndef vtkGnomonShadowPass_h
#define vtkGnomonShadowPass_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkGnomonVersions.h"  // For VTK_ABI_NAMESPACE_BEGIN
#include "vtkOpenGLRenderPass.h"
#include "vtkWrappingHints.h" // For VTK_EXPECTS

#include <memory>   // For std::unique_ptr
#include <optional> // For std::optional
#include <string>   // For std::string

/// vtkGnomonShadowPass::SetTimeBudget(): as much time as the window has for a frame.
#define GNOMON_TIME_BUDGET_OF_WINDOW -1

class vtkGnomonShadowSettings;
VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkMultiProcessController;
class vtkRenderWindow;
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace gnomon
{
struct FrameEnd;
struct FrameReport;
struct FrameWishes;
struct VisibilityImages;
}

class GNOMONPLUGIN_EXPORT vtkGnomonShadowPass : public vtkOpenGLRenderPass
{
public:
  static vtkGnomonShadowPass* New();
  vtkTypeMacro(vtkGnomonShadowPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Take a place in a renderer's chain of passes. Passes that work on the finished picture
   * (vtkSSAAPass, vtkOpenGLFXAAPass, vtkEDLShading and others) stay around this one. Those below
   * them, which draw, become its delegate. Shadows of another pass give way, and VTK's own with a
   * warning, and so does everything that draws if there is a delegate already. Without a pass,
   * Install() is vtkRenderer::SetPass(). Uninstall() puts back what was replaced. It leaves a chain
   * alone from which another caller took this pass.
   */
  void Install(vtkRenderer* renderer) VTK_EXPECTS(renderer != nullptr);
  void Uninstall(vtkRenderer* renderer) VTK_EXPECTS(renderer != nullptr);
  ///@}

  /**
   * Draw the renderer's props with shadows into the current framebuffer.
   */
  void Render(const vtkRenderState* s) override;

  ///@{
  /**
   * The technique of lights that name none: "auto", or one by name: "nsm", "pcf", "raytraced" (see
   * GetTechniqueName). An unknown name is an error and changes nothing. Default:
   * GetDefaultTechnique(), which is "auto".
   *
   * "auto" shows exact shadows in every picture at rest: `silhouette`, of area lights `penumbra`.
   * While the picture moves (see Interactive) it takes what MaximumError, MaximumSoftError and
   * TimeBudget allow: plain maps in place of rays for hard shadows, hard shadows or fewer samples
   * of area lights. GetReport() says what it took, and why.
   */
  virtual bool SetTechnique(const char* name);
  const char* GetTechnique() const;
  ///@}

  /**
   * The technique that a new pass starts with.
   */
  static const char* GetDefaultTechnique();

  ///@{
  /**
   * All techniques that can be named beside "auto", by number in [0, GetNumberOfTechniques()). The
   * summary is also there by name, that of "auto", too.
   */
  static int GetNumberOfTechniques();
  static const char* GetTechniqueName(int index);
  static const char* GetTechniqueSummary(int index);
  static const char* GetTechniqueSummary(const char* name);
  ///@}

  ///@{
  /**
   * Side of the maps of lights that name none, in texels; clamped to [16, 16384]. Default 1024.
   */
  virtual void SetMapSize(int mapSizeTexels);
  int GetMapSize() const;
  ///@}

  ///@{
  /**
   * Set the default settings for lights without their own. Several passes may share them. Null: new
   * ones with all defaults.
   */
  virtual void SetSettings(vtkGnomonShadowSettings* settings);
  vtkGnomonShadowSettings* GetSettings();
  ///@}

  ///@{
  /**
   * The same by name: any of vtkGnomonLightKeys's settings, as text or as a number, technique and
   * map size included; and the pass's own sky_intensity, sky_model ("uniform", "dome",
   * "overcast"), sky_distance and sky_directions. A setting that does not exist, and a value that
   * it does not take, are an error, return false and change nothing; GetSettingError then says why
   * (vtkGnomonNamedSettings). GetSetting returns an empty string for what does not exist.
   */
  virtual bool SetSetting(const char* name, const char* value);
  bool SetSetting(const char* name, double number);
  std::string GetSettingError() const;
  std::string GetSetting(const char* name) const;
  ///@}

  /**
   * All settings in JSON: an object by name, with the members type ("choice", "integer" or "real"),
   * range (the choices; or the least and the most, null without a limit), unit, default, meaning,
   * and techniques, the names of those that have the setting.
   */
  static std::string GetSettingsText();

  /**
   * How visibility reaches the picture. INLINE: VTK's fragment shader computes it; only pointwise
   * techniques can. IMAGE: it is computed for all pixels beforehand, from a prepass. DEFERRED: VTK
   * draws the picture once, with what each pixel shows and its colour in shadow, and visibility
   * chooses afterwards; only for the hard shadows of one light, by exact techniques, where pixels
   * have one sample. AUTO: the cheapest one that can be taken.
   */
  enum RouteType
  {
    ROUTE_AUTO = 0,
    ROUTE_INLINE = 1,
    ROUTE_IMAGE = 2,
    ROUTE_DEFERRED = 3
  };

  ///@{
  /**
   * The route to take. Asking for INLINE with a technique that works on the screen, or for DEFERRED
   * where there is a reason against it, is an error; the frame then takes the image route. Default
   * ROUTE_AUTO.
   */
  vtkSetClampMacro(Route, int, ROUTE_AUTO, ROUTE_DEFERRED);
  vtkGetMacro(Route, int);
  ///@}

  ///@{
  /**
   * Ask a surface's own shadow from the curve that normals of points imply, where facets are
   * coarse: the shadow's edge on a smooth-shaded sphere of few triangles is then smooth,
   * too. Other casters, also those in the same polydata, cast on the triangles. It is
   * for techniques that trace from the CPU (`silhouette`, `raytraced` and the like) by Embree, and
   * for maps on the inline route, on opaque surfaces without clipping planes. Off, receivers are on
   * the triangles. Default on.
   */
  vtkSetMacro(SmoothTerminators, bool);
  vtkGetMacro(SmoothTerminators, bool);
  vtkBooleanMacro(SmoothTerminators, bool);
  ///@}

  ///@{
  /**
   * Have all translucent props cast, but for those whose key CASTS is 0. Each crossing of such a
   * surface leaves 1 - a of the light, where a is the opacity with which VTK draws it; see
   * vtkGnomonPropKeys::TRANSMITS. Rays find what is left, so lights with other techniques take
   * `raytraced`. Translucent surfaces and volumes read it from a map, whose texels tell eight
   * crossings apart. Default off: translucent props cast if their key asks.
   */
  vtkSetMacro(TranslucentCasters, bool);
  vtkGetMacro(TranslucentCasters, bool);
  vtkBooleanMacro(TranslucentCasters, bool);
  ///@}

  ///@{
  /**
   * Have samples of volumes show the shadows of surfaces, where VTK's GPU mapper lights
   * them: with ShadeOn, blended by opacity, unless the prop's key RECEIVES is 0. Volumes show the
   * light's own technique if it works at points, else `pcf`. Other volumes stay as they are.
   * Default on.
   */
  vtkSetMacro(VolumesReceive, bool);
  vtkGetMacro(VolumesReceive, bool);
  vtkBooleanMacro(VolumesReceive, bool);
  ///@}

  ///@{
  /**
   * Have all volumes cast, but for those whose key CASTS is 0. A ray keeps
   * exp(-integral of extinction) of its light. The extinction is that of VTK's drawing with short
   * steps: scalar and gradient opacity by the unit distance, components, mask, cropping, clipping
   * planes. Techniques that draw on the screen without rays (`planar`) take `raytraced`. Images
   * with composite blending are served; the pass's warning lists others. Default off: volumes cast
   * if their key asks.
   */
  vtkSetMacro(VolumeCasters, bool);
  vtkGetMacro(VolumeCasters, bool);
  vtkBooleanMacro(VolumeCasters, bool);
  ///@}

  ///@{
  /**
   * The resolution of the light that volumes leave, in steps along the longest side of a grid in
   * the light's space: 16 to 512. Lights with `raytraced` march through the volumes instead. On
   * scans of 64 samples a side, 99 % of points are wrong by at most 0.03 at 256, the default, by
   * 0.13 at 128; of a lamp near a volume's face by 0.05 at 256. Time and memory grow with its cube:
   * 34 MB at 256.
   */
  vtkSetClampMacro(VolumeResolution, int, 16, 512);
  vtkGetMacro(VolumeResolution, int);
  ///@}

  /**
   * Which lights cast, of those whose own key (vtkGnomonLightKeys::CASTS) does not say. A headlight
   * does not, nor a camera light that stands at the camera, which hardly sees their shadows.
   */
  enum CastingType
  {
    CASTING_AUTO = 0,     ///< those of the scene, and the brightest of those that follow the camera
    CASTING_ALL = 1,      ///< all of them
    CASTING_BRIGHTEST = 2 ///< the one of most intensity times luminance; of equal ones, the first
  };

  ///@{
  /**
   * The report says why a light does not cast. Default CASTING_AUTO.
   */
  vtkSetClampMacro(Casting, int, CASTING_AUTO, CASTING_BRIGHTEST);
  vtkGetMacro(Casting, int);
  ///@}

  /**
   * Say if frames belong to a picture that moves. AUTO: a window with an interactor asks for a
   * higher update rate than the interactor's StillUpdateRate (and 0.01), as interactor styles have
   * it do while their user drags, and camera, lights or props changed less than half a second ago.
   * Pictures without an interactor are at rest: off-screen ones, movies, image tests.
   */
  enum InteractiveType
  {
    INTERACTIVE_AUTO = 0,
    INTERACTIVE_OFF = 1,
    INTERACTIVE_ON = 2
  };

  ///@{
  /**
   * For AUTO, a timer of the interactor draws what is left of a picture that the last frame left
   * unfinished: the picture at rest half a second after the last change of one that moves (lights
   * whose technique is "auto"), and more of lights' samples (GetProgress()) at once. On screen, the
   * first picture at rest may show some of the samples of area lights. No timer runs while the user
   * holds a button or an interactor style acts. OFF and ON: no timer. Default INTERACTIVE_AUTO.
   */
  vtkSetClampMacro(Interactive, int, INTERACTIVE_AUTO, INTERACTIVE_ON);
  vtkGetMacro(Interactive, int);
  ///@}

  /**
   * Event of an unfinished frame that no timer can finish: the interactor's Render() does not draw
   * (Qt Quick), the pass was made in another thread, or there is no interactor. The call data
   * points to an int: the milliseconds after which the program is to draw. Observers must not draw.
   * See docs/guide/toolkits.md.
   */
  enum
  {
    PictureUnfinishedEvent = 1731 // from vtkCommand::UserEvent on
  };

  ///@{
  /**
   * The errors that "auto" allows while the picture moves. MaximumError is the share of wrong
   * pixels of hard shadows, among pixels that face the light. MaximumSoftError is the root mean
   * square error of the visibility of area lights. 0 is exact. Rays check maps at 4,096 to 32,768
   * pixels, so a MaximumError below 0.000125 cannot be proved and is exact, too. Numbers outside of
   * [0, 1] are an error and change nothing. Default 0.005 and 0.03.
   */
  virtual void SetMaximumError(double share);
  vtkGetMacro(MaximumError, double);
  virtual void SetMaximumSoftError(double rootMeanSquare);
  vtkGetMacro(MaximumSoftError, double);
  ///@}

  /**
   * GNOMON_TIME_BUDGET_OF_WINDOW, for Python.
   */
  enum
  {
    TIME_BUDGET_OF_WINDOW = GNOMON_TIME_BUDGET_OF_WINDOW
  };

  ///@{
  /**
   * The most milliseconds for a frame while the picture moves. "auto" then takes rays if they fit,
   * else maps that keep MaximumError; if neither fits, the report says so. Choices then depend on
   * measured times. 0 means no budget: "auto" takes the fastest way that keeps the errors.
   *
   * The default, GNOMON_TIME_BUDGET_OF_WINDOW, is 0 unless the window's interactor asks for a rate
   * (vtkRenderWindow::SetDesiredUpdateRate()), as styles do while one drags. Then a moving frame
   * has vtkRenderer::GetAllocatedRenderTime(), but at least 1.3 times what VTK's drawing takes.
   * "auto" first takes what keeps the errors; where that is too slow, fewer samples of area lights,
   * then hard shadows of their centres, then maps of any error. `penumbra` and
   * `raytraced` use fewer samples, too, unless `moving_samples` names them. Over several processes
   * the first one's time and budget count, and a budget in milliseconds limits these samples, too.
   *
   * Other negative numbers are an error and change nothing.
   */
  virtual void SetTimeBudget(double milliseconds);
  vtkGetMacro(TimeBudget, double);
  ///@}

  ///@{
  /**
   * The most memory for lights' maps and images of visibility, in MiB. Lights get their share in
   * the order of the light that they can give to what is visible. A map that does not fit is
   * halved, down to 256 texels a side. A light whose map still does not fit, or whose map's size is
   * not known beforehand (`selective`, `coherence`, `crsm`, `crsma`, `silhouette`), takes rays. A
   * light whose image does not fit shows no shadow. GetReport() says so. The budget is each
   * renderer's and view's. Not counted is what lights share (the snapshot, the rays' structure, the
   * receivers, the view of the sky), what volumes leave of a light, values at edges, and the maps
   * by which translucent surfaces and volumes show shadows of other techniques, of 256 texels where
   * a light takes rays for the budget's sake. Negative numbers are an error and change nothing. 0,
   * the default, is no budget.
   */
  virtual void SetMemoryBudget(double mebibytes);
  vtkGetMacro(MemoryBudget, double);
  ///@}

  ///@{
  /**
   * The intensity of a sky: 1 shows a white surface below the open sky as white. 0, the default,
   * is no sky. Its light is SkyColor times the material's diffuse colour. What each point sees of
   * the sky scales the sum of that and the material's ambient term, and the diffuse light of an
   * environment on physically based materials. Other light, highlights and unlit props stay as they
   * are: where no light is switched on, VTK shows all props unlit. Surfaces that show no shadows,
   * and translucent ones, see all of the sky. Negative numbers, and those above 1e6, are an error
   * and change nothing.
   *
   * Rays find the view, so receivers are drawn first (the image route). At rest it is complete
   * after SkyDirections rays from each pixel, on screen in steps (GetProgress()). Moving pictures
   * have two rays from each pixel, and those of its neighbours. Where these do not keep the rate
   * that the window asks for (SetTimeBudget()), all surfaces see all of the sky until the picture
   * rests. Several processes have no sky.
   */
  virtual void SetSkyIntensity(double intensity);
  vtkGetMacro(SkyIntensity, double);
  virtual void SetSkyColor(double red, double green, double blue);
  void SetSkyColor(const double rgb[3]) { this->SetSkyColor(rgb[0], rgb[1], rgb[2]); }
  vtkGetVector3Macro(SkyColor, double);
  ///@}

  /**
   * Models of a sky.
   */
  enum SkyModelType
  {
    SKY_UNIFORM = 0, ///< as bright from everywhere, from below, too: ambient occlusion
    SKY_DOME = 1,    ///< as bright from everywhere above the horizon, dark below it
    SKY_OVERCAST = 2 ///< CIE's overcast sky: three times as bright in the zenith as at the horizon
  };

  ///@{
  /**
   * The sky's model, and which way is up in the world, by a vector of any length but 0. Default:
   * SKY_UNIFORM, (0, 0, 1). In all models a horizontal surface below the open sky sees 1.
   */
  vtkSetClampMacro(SkyModel, int, SKY_UNIFORM, SKY_OVERCAST);
  vtkGetMacro(SkyModel, int);
  virtual void SetSkyUp(double x, double y, double z);
  void SetSkyUp(const double up[3]) { this->SetSkyUp(up[0], up[1], up[2]); }
  vtkGetVector3Macro(SkyUp, double);
  ///@}

  ///@{
  /**
   * The distance, in world coordinates, beyond which nothing hides the sky. 0, the default, is no
   * limit. Negative numbers are an error and change nothing.
   */
  virtual void SetSkyDistance(double distance);
  vtkGetMacro(SkyDistance, double);
  ///@}

  ///@{
  /**
   * Rays to the sky from each pixel: a power of two in [16, 65536]; anything else is an error and
   * changes nothing. Default: 256.
   */
  virtual void SetSkyDirections(int directions);
  vtkGetMacro(SkyDirections, int);
  ///@}

  /**
   * Have "auto" go by what frames cost on this machine, in a file that `gnomon calibrate` wrote. A
   * file that is none is an error and changes nothing. Null: the default factors, those of llvmpipe
   * on two cores where OpenGL draws by software, and of an NVIDIA H200 beside 16 cores where
   * hardware does. A new pass reads the file that the environment variable GNOMON_FACTORS names.
   * Pictures at rest do not depend on factors.
   */
  virtual void ReadCostFactors(const char* path);

  ///@{
  /**
   * Measure the stages of a frame: each then ends with glFinish, so that its time is its own; that
   * makes frames slower. Default off.
   */
  vtkSetMacro(MeasureStages, bool);
  vtkGetMacro(MeasureStages, bool);
  vtkBooleanMacro(MeasureStages, bool);
  ///@}

  ///@{
  /**
   * Keep the visibility of every light and the receivers of the next frames for GetVisibility(). It
   * takes the image route and reads images back. Default off.
   */
  vtkSetMacro(KeepVisibility, bool);
  vtkGetMacro(KeepVisibility, bool);
  vtkBooleanMacro(KeepVisibility, bool);
  ///@}

  ///@{
  /**
   * The pass that draws the scene while shadows are in place: vtkRenderStepsPass, or a chain of
   * passes that ends in it. It moves the camera, clears and draws; lights and shadows are prepared
   * before. Without one, which is the default, the pass draws what the renderer draws by itself,
   * with the renderer's own depth peeling, ambient occlusion and FXAA; where another pass is around
   * this one and hands in a framebuffer, it draws by a vtkRenderStepsPass, and those are that
   * pass's business.
   *
   * Techniques that work on the screen have one visibility per pixel of the renderer, so their
   * delegate must shade at the renderer's resolution. Where it does not (vtkSSAAPass) that is an
   * error, and the props are drawn without shadows; let such a pass have this one as its delegate.
   */
  virtual void SetDelegatePass(vtkRenderPass* pass);
  vtkGetObjectMacro(DelegatePass, vtkRenderPass);
  ///@}

  ///@{
  /**
   * The processes that draw one picture together, each its own part of the scene, and composite it
   * by depth (sort-last rendering). A point is lit if no process's casters block its ray.
   *
   * All must have the same lights, cameras (clipping ranges included), picture sizes and UseShadows
   * if it is obeyed, and must render equally often, also those without data or out of view. The
   * pass never calls the controller while the delegate draws. Meanwhile, each process takes its
   * share of the cores of its machine. If one meets an error, all draw without shadows, and all
   * say why.
   *
   * Lights have the technique `raytraced`, and no textures; another technique is an error, "auto"
   * is not. Embree traces, MemoryBudget has no effect, and translucent surfaces show no shadows.
   * Null, the default, or a controller of one process: this process has the whole scene.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * The delegate draws the picture in the lower left part of its viewport, smaller by this factor
   * in width and height, as vtkIceTCompositePass does for an image reduction factor. Without a
   * delegate it has no effect. In [1, 50]; default 1.
   */
  vtkSetClampMacro(ImageReductionFactor, int, 1, 50);
  vtkGetMacro(ImageReductionFactor, int);
  ///@}

  ///@{
  /**
   * True to draw without shadows while the renderer's UseShadows is off, as OSPRay's pass does. Off
   * by default: renderers start with UseShadows off, which would silently disable this pass. Switch
   * it on in programs whose own shadow switch is UseShadows.
   *
   * In either case VTK's own shadow maps, which UseShadows brings into the frame, are left out, so
   * that no shadow falls twice.
   */
  vtkSetMacro(ObeyUseShadows, bool);
  vtkGetMacro(ObeyUseShadows, bool);
  vtkBooleanMacro(ObeyUseShadows, bool);
  ///@}

  /**
   * Return what the last frame did: lights and reasons, route, counters, times, memory
   * (vtkGnomonFrameReport.h).
   */
  const gnomon::FrameReport& GetReport() const;

  ///@{
  /**
   * The same as text, in JSON, and its lights as rows of a table, of numbers and strings. Both are
   * the caller's own. `lights[i].map_size_texels` of the text is the column `map_size_texels`.
   */
  std::string GetReportText() const;
  void GetReportTable(vtkTable* lights) const VTK_EXPECTS(lights != nullptr);
  ///@}

  /**
   * How much of what lights' techniques are to show the last frame showed, in [0, 1]: below 1 where
   * they take several frames (the settings `progressive` of `sampled` and `moving_samples`), and
   * further frames of the same scene bring more. It is the least of all lights'. Selections
   * (vtkHardwareSelector) leave it as it is. Windows that show several views by one pass (stereo,
   * tiles, several renderers) get all in every frame.
   *
   * A frame that brings more ends with a vtkCommand::ProgressEvent, whose call data is this number
   * (a double), and the one that completes it, once, with a vtkCommand::EndEvent. Observers must
   * not draw. Without an interactor (see SetInteractive), an application draws the next frame when
   * it is idle, while this is below 1.
   */
  double GetProgress() const;

  /**
   * The last frame's visibility and receivers (vtkGnomonVisibilityImages.h); the receivers alone
   * where no light casts. Empty unless KeepVisibility was on while it was drawn.
   */
  const gnomon::VisibilityImages& GetVisibility() const;

  /**
   * The same as an image of a point a pixel, row 0 at the bottom, which is the caller's own. Its
   * point data: "light N" for each light that casts, by its number in the renderer's collection, 1
   * lit, 0 in shadow (three components of a light with a texture); "position", in world
   * coordinates; "normal", geometric, of unit length, on the camera's side; "coverage", 1 where a
   * surface was drawn, else 0, and the numbers so far mean nothing; "prop", an integer, the number
   * in vtkRenderer::GetViewProps() of what was drawn, -1 for nothing; "cell", an integer, the cell
   * of the mapper's input where that is a vtkPolyData, as for picking. It is -1 for other input
   * (composite data, other data sets, glyphs, molecules), parts of assemblies, levels of detail,
   * and spheres and tubes in place of points and lines.
   */
  void GetVisibilityImage(vtkImageData* image) const VTK_EXPECTS(image != nullptr);

  /**
   * Includes the time of the settings.
   */
  vtkMTimeType GetMTime() override;

  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /**
   * The hook into VTK's shaders; called by mappers.
   */
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop)
    VTK_EXPECTS(mapper != nullptr) VTK_EXPECTS(prop != nullptr) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) VTK_EXPECTS(program != nullptr)
    VTK_EXPECTS(mapper != nullptr) VTK_EXPECTS(prop != nullptr) override;
  vtkMTimeType GetShaderStageMTime() override;
  ///@}

protected:
  vtkGnomonShadowPass();
  ~vtkGnomonShadowPass() override;

  int Route = ROUTE_AUTO;
  bool SmoothTerminators = true;
  int Casting = CASTING_AUTO;
  int Interactive = INTERACTIVE_AUTO;
  double MaximumError = 0.005;
  double MaximumSoftError = 0.03;
  double TimeBudget = GNOMON_TIME_BUDGET_OF_WINDOW;
  double MemoryBudget = 0.0;
  bool TranslucentCasters = false;
  bool VolumeCasters = false;
  int VolumeResolution = 256;
  bool VolumesReceive = true;
  double SkyIntensity = 0.0;
  double SkyColor[3] = { 1.0, 1.0, 1.0 };
  int SkyModel = SKY_UNIFORM;
  double SkyUp[3] = { 0.0, 0.0, 1.0 };
  double SkyDistance = 0.0;
  int SkyDirections = 256;
  bool MeasureStages = false;
  bool KeepVisibility = false;
  vtkRenderPass* DelegatePass = nullptr;
  vtkMultiProcessController* Controller = nullptr;
  int ImageReductionFactor = 1;
  bool ObeyUseShadows = false;

private:
  vtkRenderPass* FindDelegate(const vtkRenderState* s);
  struct SkySetting;
  class HookMarks;
  gnomon::FrameEnd DrawFrame(const vtkRenderState* s);
  std::optional<std::string> EnterContext(vtkRenderer* renderer);
  void DrawShadows(const vtkRenderState* s, gnomon::FrameEnd& end);
  void EndPlain(const vtkRenderState* s, const gnomon::FrameEnd& end);
  bool Moves(const vtkRenderState* s);
  bool MayRefine(const vtkRenderState* s);
  gnomon::FrameWishes Wishes(vtkRenderer* renderer) const;
  void BeginView(const vtkRenderState* s);
  void DrawScene(const vtkRenderState* s);
  void ComputeShadows(const vtkRenderState* s, bool onImage);
  void DrawDeferred(const vtkRenderState* s);
  void CompareSurfaces(const vtkRenderState* s, bool failed);
  void DrawPlain(const vtkRenderState* s);

  vtkGnomonShadowPass(const vtkGnomonShadowPass&) = delete;
  void operator=(const vtkGnomonShadowPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
