/**
 * @class   vtkGnomonLightSamplingPass
 * @brief   shades a scene from many points of each area light, and shows the mean
 *
 * @code
 * vtkNew<vtkGnomonShadowPass> shadows; // of any technique with hard shadows
 * vtkNew<vtkGnomonLightSamplingPass> sampling;
 * sampling->SetDelegatePass(shadows);
 * renderer->SetPass(sampling);
 * @endcode
 *
 * vtkGnomonShadowPass multiplies what VTK shades from an area light's centre by the share of the
 * light that is seen. This pass has its delegate draw the scene again and again instead: for each
 * picture, every area light (vtkGnomonAreaLight, and what else has a radius) is a point light, at
 * one of its points, and the pictures are averaged. So cosines, attenuation, spot cones, highlights
 * and every material see the light where it is: what arrives is what the whole area sends, as
 * closely as so many points tell (Heckbert and Herf 1997). A light's points come in opposite pairs,
 * from the middle outwards, an odd number of them beginning with the centre.
 *
 * <b>Lights.</b> Those without area stay as they are. An area light's points are as it is itself,
 * but for where they shine from: the cone of a spot moves along with its point, so that the edge of
 * what it lights is soft; a directional light turns about its position, and its box with it. What a
 * light says of its size counts (vtkGnomonLightKeys' "light_radius" included, but not that of a
 * shadow pass), and so do its "light_seed" and "light_sampling", "sobol" or "random"; Samples takes
 * the place of "light_samples". The points of a light with a texture have its colours, and their
 * mean is the texture's; at its centre the light has that. A light whose area or texture cannot be
 * is an error (vtkGnomonAreaLight). The renderer's lights are its own again after the frame, and
 * have not been modified.
 *
 * <b>Pictures</b> are of 32-bit floats, so that they may be brighter than any display and are not
 * rounded, with the window's samples per pixel. Memory does not grow with their number. They are
 * drawn in front of what a renderer that is transparent (a layer) has below it. The mean's colours,
 * alpha and depths are the pass's result.
 *
 * <b>Other passes.</b> The delegate may be any pass that draws into the framebuffer that its render
 * state names: vtkGnomonShadowPass, vtkRenderStepsPass. As around vtkGnomonShadowPass, the
 * renderer's own depth peeling, ambient occlusion and FXAA are the delegate's business
 * (docs/guide/passes.md).
 *
 * With one point the delegate draws, with each light at its centre, as if this pass were not there;
 * without area lights, and while something is selected (vtkHardwareSelector), just as it would. So
 * it does, after an error, below OpenGL 4.3, without memory, where an outer pass has it draw into
 * several images at once, and where what is in the depth buffer before is to be kept.
 */

#ifndef vtkGnomonLightSamplingPass_h
#define vtkGnomonLightSamplingPass_h

#include "GnomonPluginModule.h" // For export macro
#include "vtkRenderPass.h"

#include <memory> // For std::unique_ptr

class GNOMONPLUGIN_EXPORT vtkGnomonLightSamplingPass : public vtkRenderPass
{
public:
  static vtkGnomonLightSamplingPass* New();
  vtkTypeMacro(vtkGnomonLightSamplingPass, vtkRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Draw the mean of the delegate's pictures into the current framebuffer.
   */
  void Render(const vtkRenderState* s) override;

  ///@{
  /**
   * The pass that draws the scene from one point of each light. Without one, which is the default,
   * VTK draws it, without shadows (vtkRenderStepsPass).
   */
  virtual void SetDelegatePass(vtkRenderPass* pass);
  vtkGetObjectMacro(DelegatePass, vtkRenderPass);
  ///@}

  ///@{
  /**
   * Points of each area light, and so pictures. 1 shows what the delegate shows from the centre.
   * Default 64.
   */
  vtkSetClampMacro(Samples, int, 1, 65536);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * Pictures that each frame adds while nothing changes. The first frame after a change then shows
   * what the delegate shows from the lights' centres, and the last one, bit for bit, what one frame
   * with all of them shows; after it, nothing is drawn any more but the mean. 0, the default, draws
   * all in every frame. So do windows that show several views by one pass (stereo, tiles, several
   * renderers), and renderers that are transparent (a layer), since what is below them is a part of
   * each picture, and may change without notice.
   *
   * Changes of the camera, of lights, of all that VTK draws props from, and of this pass, its
   * delegate and their settings restart the mean. Call this pass's Modified() where something else
   * changed, as a pass inside of the delegate.
   */
  vtkSetClampMacro(SamplesPerFrame, int, 0, 65536);
  vtkGetMacro(SamplesPerFrame, int);
  ///@}

  ///@{
  /**
   * How the delegate's colours stand for light: they are its power of 1 / Gamma, and the mean is
   * that of the light. VTK's physically based shading ends in a power of 1 / 2.2, all other shading
   * in none. 0, the default, takes 2.2 where some surface in view is physically based, and else 1.
   * In scenes with both kinds, the penumbrae of one of them are not those of its light. Other
   * numbers are clamped to [0, 10]; NaN is an error and changes nothing.
   */
  virtual void SetGamma(double gamma);
  vtkGetMacro(Gamma, double);
  ///@}

  /**
   * How many of the pictures the last frame showed, in [0, 1]: below 1 while SamplesPerFrame leaves
   * some for later frames. Selections leave it as it is.
   *
   * Events are those of vtkGnomonShadowPass: a frame that brings more ends with a
   * vtkCommand::ProgressEvent, whose call data is this number (a double), and the one that
   * completes it, once, with a vtkCommand::EndEvent. Observers must not draw. A timer of the
   * window's interactor draws the next frames; without one, an application draws them when it is
   * idle, while this is below 1 (PictureUnfinishedEvent).
   */
  double GetProgress() const;

  /**
   * That of vtkGnomonShadowPass.
   */
  enum
  {
    PictureUnfinishedEvent = 1731
  };

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkGnomonLightSamplingPass();
  ~vtkGnomonLightSamplingPass() override;

  vtkRenderPass* DelegatePass = nullptr;
  int Samples = 64;
  int SamplesPerFrame = 0;
  double Gamma = 0.0;

private:
  vtkRenderPass* Delegate() const;
  void DrawByDelegate(const vtkRenderState* s);
  void DrawFromCentres(const vtkRenderState* s);
  double DrawMeanOrAlone(const vtkRenderState* s);
  double DrawMean(const vtkRenderState* s);
  void AddPictures(const vtkRenderState* s, std::size_t wanted);
  double GammaOf(const vtkRenderState* s) const;
  std::size_t HashOfShown(const vtkRenderState* s);

  vtkGnomonLightSamplingPass(const vtkGnomonLightSamplingPass&) = delete;
  void operator=(const vtkGnomonLightSamplingPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
