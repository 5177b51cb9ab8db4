#pragma once

#include "lights/ShadowLight.h"
#include "lights/vtkGnomonVersions.h"
#include "plugin/plan/Route.h"
#include "plugin/scene/DrawnLookup.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <vtkTimeStamp.h>

#include <map>
#include <set>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The tasks of a frame's shaders, besides their lights.
struct HookVariant
{
  Route route = Route::Inline;
  bool receiverPoints = false; ///< image route: the receivers stage writes points and normals, too
  bool multisampled = false;   ///< pixels have several samples, and a surface may cover some of
                               ///< them
  bool namesTriangles = true;  ///< not on the inline route: triangle numbers may be written
  bool vtkViewIsRigid = true;  ///< ShownView::viewFromVtkView is the identity
  bool anySeenThrough = false; ///< true if DrawnProps::seenThrough has some
};

/// One casting light, as the shader hook needs it.
struct ShadedLight
{
  ShadowLight light;
  int channels = 1; ///< of its visibility, a layer each (channelsOf())
  int layer = 0;    ///< image route: its first visibility layer
  int bit = noBit;  ///< or its bit in the image of bits
  /// The technique that the shader calls: on the inline route for all surfaces, on the image route
  /// for translucent ones, since the layers hold opaque ones. Null if none is needed.
  const PointwiseTechnique* pointwise = nullptr;
};

/// Make the shaders of VTK's glyphs hand on the instance number, as the fragment shader's `flat in
/// int gnomonInstanceVSOutput`: gl_PrimitiveID counts within an instance. Call it before VTK's
/// replacements.
/// @return false if the shaders draw no instances
bool passInstance(std::string& vertexShader, std::string& geometryShader);

/// The hook into VTK's lighting. Before VTK's light loop it puts, per casting light N,
///     vec3 lightColorN = lightColorN * (visibility of light N);
/// For a light with a texture the visibility is a colour, and the texture's mean in full light. The
/// local variable hides VTK's uniform of the same name, so VTK's loop works with the shadowed
/// colour, for every shading model and kind of light. The hook relies on the uniforms' names alone.
///
/// On the image route the same programs also serve the receivers stage. A uniform selects the
/// stage, so VTK rebuilds no shader between stages. On the deferred route they light each fragment
/// twice, as if all of it were lit and as if none were, and write its triangle.
class ShaderManager
{
public:
  /// Set the tasks of the frame's shaders. If they differ from the last frame's, VTK's mappers
  /// rebuild their shaders (stageTime() changes).
  void configure(const HookVariant& variant, const std::vector<ShadedLight>& lights);
  vtkMTimeType stageTime() const { return this->stageTime_.GetMTime(); }

  /// First and second half of the hook, around VTK's own replacements.
  /// @param drawsReceivers true if this prop's shader must be able to write receivers
  /// @param corners of the primitives that it draws then; 0 if it draws none of the snapshot's
  void markShader(
    std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const;
  void fillShader(const std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, bool drawsReceivers, int corners);

  /// Number primitives by geometry shaders or not, from here on (TriangleNumbers.h). VTK's mappers
  /// rebuild their shaders.
  void numberByGeometryShaders(bool number);
  bool numbersByGeometryShaders() const { return this->numbersByGeometryShaders_; }

  /// The values that are constant for all props of a stage.
  struct StageValues
  {
    bool receiversStage = false; ///< receivers are drawn, alone or with the picture
    ReceiverSpace space;
    glm::dmat4 viewFromVtkView{ 1.0 };        ///< ShownView
    glm::dvec4 eyeView{ 0.0, 0.0, 0.0, 1.0 }; ///< CameraView::eyeView()
    TextureBinding layers;                    ///< image route: the visibility layers
    TextureBinding bits;                      ///< image route: the image of bits
    glm::ivec2 layersSize{ 0 };               ///< size of both in pixels
    int reductionFactor = 1;                  ///< FrameWishes::reductionFactor
    TextureBinding depths;                    ///< of the layers' receivers
  };
  /// Bind textures to units of their own while VTK draws between beginStage and endStage. endStage
  /// also ends a stage that has failed half way. It has no effect without a stage.
  /// @return endStage: false if something was drawn at another size than the layers have
  void beginStage(vtkOpenGLRenderWindow* window, const StageValues& values);
  bool endStage();

  /// Set the hook's uniforms of a program that is about to draw.
  void setParameters(vtkShaderProgram* program, const HookedSurface& drawn);

  /// Return the number of shaders that VTK has rebuilt since the start.
  int rebuilds() const { return this->rebuilds_; }
  /// Return how many of these were new programs.
  int newPrograms() const { return static_cast<int>(this->programs_.size()); }

private:
  std::string lightInShadow(const std::string& fragmentShader) const;
  std::string writeReceiver(bool receives, bool instanced, const std::string& primitive) const;
  void separateSamplers();
  void bindVisibility(const StageValues& values);
  int bindTexture(const TextureBinding& texture);
  bool setLayersOrigin(GLuint program);

  HookVariant variant_;
  std::string extensions_;
  std::string declarations_;
  std::map<std::string, std::vector<std::string>> samplers_; ///< of the declarations, by type
  std::string uniformFlow_;     ///< statements that must be in uniform control flow
  std::string multiplications_; ///< and statements before VTK's light loop
  std::string darkenings_;      ///< deferred route: the same for the colour in shadow
  bool numbersByGeometryShaders_ = false;
  vtkTimeStamp stageTime_;
  int rebuilds_ = 0;
  std::set<std::size_t> programs_; ///< hashes of all programs' sources

  std::vector<ShadedLight> lights_;
  vtkOpenGLRenderWindow* window_ = nullptr;
  glm::ivec2 layersSize_{ 0 };
  int reductionFactor_ = 1;
  bool layersFit_ = true;
  std::vector<Uniform> stageUniforms_; ///< with units instead of textures
  struct BoundTexture
  {
    int unit;
    GLenum target;
    GLuint previous; ///< earlier binding of the unit
  };
  std::vector<BoundTexture> bound_;
  std::set<vtkShaderProgram*> upToDate_; ///< programs that have the stage's uniforms
};

} // namespace gnomon
