/**
 * @class   vtkPVGnomonShadows
 * @brief   the shadows of one of ParaView's render views
 *
 * ParaView adds it to a view of any class, as a representation without data. Before each frame it
 * puts a vtkGnomonShadowPass between the camera's pass and the one that draws the view. Where
 * several processes draw the view, each its own part of the data, that one composites their
 * pictures, and the pass shares its rays with theirs. Tile displays and CAVEs have no shadows.
 */

#ifndef vtkPVGnomonShadows_h
#define vtkPVGnomonShadows_h

#include "vtkDataRepresentation.h"
#include "vtkGnomonViewsModule.h" // for export macro
#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkGnomonShadowPass;
class vtkPVRenderView;
class vtkPVSession;

class VTKGNOMONVIEWS_EXPORT vtkPVGnomonShadows : public vtkDataRepresentation
{
public:
  static vtkPVGnomonShadows* New();
  vtkTypeMacro(vtkPVGnomonShadows, vtkDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Have lights cast shadows. Default off.
   */
  vtkSetMacro(ShowShadows, bool);
  vtkGetMacro(ShowShadows, bool);
  ///@}

  /**
   * The share of each light that its shadows remove, in [0, 1]. Default 1.
   */
  vtkSetClampMacro(ShadowStrength, double, 0.0, 1.0);
  vtkGetMacro(ShadowStrength, double);

  ///@{
  /**
   * Have translucent surfaces cast: each takes its opacity's share of the light. Default off.
   */
  vtkSetMacro(TranslucentCasts, bool);
  vtkGetMacro(TranslucentCasts, bool);
  ///@}

  /**
   * As vtkGnomonShadowPass::SetVolumeCasters(). Default off.
   */
  void SetVolumesCast(bool cast);

  /**
   * As vtkGnomonShadowPass::SetSkyIntensity(). Default 0.
   */
  void SetSkyIntensity(double intensity);

  /**
   * As vtkGnomonShadowPass::SetSmoothTerminators(). Default on.
   */
  void SetSmoothTerminators(bool smooth);

  /**
   * Which lights cast, as vtkGnomonShadowPass::SetCasting().
   */
  void SetCasting(int casting);

  ///@{
  /**
   * Of all lights: vtkGnomonShadowPass::SetTechnique(), by default "auto"; the settings
   * `edge_samples`, `light_radius` (world units, of directional lights degrees) and
   * `light_samples`.
   */
  void SetTechnique(const char* name);
  void SetEdgeSamples(int samples);
  void SetLightSize(double radius);
  void SetLightSamples(int samples);
  ///@}

  /**
   * Measure the time of each stage for GetReportText().
   */
  void SetMeasureStages(bool measure);

  /**
   * Where the first process writes each frame's visibility, as an image (.vti); null or empty:
   * nowhere, the default.
   */
  void SetVisibilityFile(const char* path);

  /**
   * Return what the last frame did, in JSON; valid until the next call. On a client, it comes from
   * the server's first process.
   */
  const char* GetReportText();

protected:
  vtkPVGnomonShadows();
  ~vtkPVGnomonShadows() override;

  /**
   * Called by a view to which this is added. Returns false: the view has nothing to draw for it.
   */
  bool AddToView(vtkView* view) override;

  bool ShowShadows = false;
  double ShadowStrength = 1.0;
  bool TranslucentCasts = false;

private:
  vtkPVGnomonShadows(const vtkPVGnomonShadows&) = delete;
  void operator=(const vtkPVGnomonShadows&) = delete;

  void BeginFrame();
  void EndFrame();
  void PlacePass();
  void SetKeys();
  void WriteVisibility();
  void ShareReport();
  void TellOnce(const char* why);
  void LeaveToReport() {}

  vtkWeakPointer<vtkPVRenderView> View;
  vtkWeakPointer<vtkPVSession> Session; ///< that made the view
  vtkNew<vtkGnomonShadowPass> Pass;
  std::string Told; ///< the last warning
  std::string VisibilityFile;
  std::string ReportText;
  std::string ServersReport; ///< on a client, of the last frame if its server drew it
};

#endif
