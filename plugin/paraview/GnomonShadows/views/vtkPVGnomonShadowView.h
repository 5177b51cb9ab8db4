/**
 * @class   vtkPVGnomonShadowView
 * @brief   ParaView's render view with shadows
 *
 * Puts a vtkGnomonShadowPass between the camera's pass and the one that draws the view. Where
 * several processes draw the view, each its own part of the data, that one composites their
 * pictures, and the pass shares its rays with theirs. Tile displays and CAVEs have no shadows.
 */

#ifndef vtkPVGnomonShadowView_h
#define vtkPVGnomonShadowView_h

#include "vtkGnomonViewsModule.h" // for export macro
#include "vtkNew.h"
#include "vtkPVRenderView.h"

#include <string>

class vtkGnomonShadowPass;

class VTKGNOMONVIEWS_EXPORT vtkPVGnomonShadowView : public vtkPVRenderView
{
public:
  static vtkPVGnomonShadowView* New();
  vtkTypeMacro(vtkPVGnomonShadowView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether lights cast shadows. Default on.
   */
  vtkSetMacro(ShowShadows, bool);
  vtkGetMacro(ShowShadows, bool);
  ///@}

  ///@{
  /**
   * Of all lights: vtkGnomonShadowPass::SetTechnique(), by default "raytraced"; the settings
   * `edge_samples`, `light_radius` (world units, of directional lights degrees) and
   * `light_samples`.
   */
  void SetTechnique(const char* name);
  void SetEdgeSamples(int samples);
  void SetLightSize(double radius);
  void SetLightSamples(int samples);
  ///@}

  /**
   * Whether GetReportText() has the time of each stage.
   */
  void SetMeasureStages(bool measure);

  /**
   * Where the first process writes each frame's visibility, as an image (.vti); null or empty:
   * nowhere, the default.
   */
  void SetVisibilityFile(const char* path);

  /**
   * What the last frame did, in JSON; valid until the next call. On a client, it is the report of
   * the server's first process.
   */
  const char* GetReportText();

  /**
   * Put the pass into the view's chain of passes. Called by ParaView, on each process that draws.
   */
  void AboutToRenderOnLocalProcess(bool interactive) override;

protected:
  vtkPVGnomonShadowView();
  ~vtkPVGnomonShadowView() override;
  void Render(bool interactive, bool skipRendering) override;

  bool ShowShadows = true;

private:
  vtkPVGnomonShadowView(const vtkPVGnomonShadowView&) = delete;
  void operator=(const vtkPVGnomonShadowView&) = delete;

  void TellOnce(const char* why);
  void LeaveToReport() {}
  void ShareReport(bool isDistributed);

  vtkNew<vtkGnomonShadowPass> Pass;
  std::string Told; ///< the last warning
  std::string VisibilityFile;
  std::string ReportText;
  std::string ServersReport; ///< on a client, of the last frame if its server drew it
};

#endif
