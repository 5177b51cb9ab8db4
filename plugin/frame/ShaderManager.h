#pragma once

#include "lights/ShadowLight.h"
#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/Route.h"
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

/// What the shaders of a frame have to do, besides their lights.
struct HookVariant
{
  Route route = Route::Inline;
  bool receiverPoints = false; ///< image route: the receivers stage draws points and normals, too
  bool multisampled = false;   ///< pixels have several samples, of which a surface may have some
  bool namesTriangles = true;  ///< not on the inline route: what pixels show may be drawn
};

/// One casting light, as the shader hook needs it.
struct ShadedLight
{
  ShadowLight light;
  int channels = 1; ///< of its visibility, a layer each (channelsOf())
  int layer = 0;    ///< image route: of the visibility layers, its first
  int bit = noBit;  ///< or of their image of bits
  /// What the shader computes visibility with: on the inline route for all surfaces, on the image
  /// route for translucent ones, since the layers show what is opaque. Null where nothing needs it.
  const PointwiseTechnique* pointwise = nullptr;
};

/// Has the shaders of VTK's glyphs pass the number of the instance on, as the fragment shader's
/// `flat in int gnomonInstanceVSOutput`: gl_PrimitiveID counts within an instance. Called before
/// VTK's replacements.
/// @return false where nothing is drawn as instances
bool passInstance(std::string& vertexShader, std::string& geometryShader);

/// The hook into VTK's lighting. In front of VTK's light loop it puts, per casting light N,
///     vec3 lightColorN = lightColorN * (visibility of light N);
/// Of a light with a texture that is a colour, and what is lit has the texture's mean.
/// The local variable hides VTK's uniform of the same name, so that the loop, of whatever shading
/// model and kind of light, works with the shadowed colour. Only the uniforms' names are relied on.
///
/// On the image route the same programs also serve the receivers stage: a uniform chooses, so that
/// VTK need not rebuild any shader between the stages. On the deferred route they light each
/// fragment twice, as if all of it were lit and as if none were, and say what it shows.
class ShaderManager
{
public:
  /// States what the frame's shaders must do. When it differs from the last frame's, VTK's mappers
  /// rebuild their shaders (stageTime() changes).
  void configure(const HookVariant& variant, const std::vector<ShadedLight>& lights);
  vtkMTimeType stageTime() const { return this->stageTime_.GetMTime(); }

  /// First and second half of the hook, around VTK's own replacements.
  /// @param drawsReceivers whether this prop's shader must be able to say what receives
  /// @param corners of the primitives that it draws then; 0 if it draws none of the snapshot's
  void markShader(
    std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const;
  void fillShader(const std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, bool drawsReceivers, int corners);

  /// From now on primitives are numbered by geometry shaders (TriangleNumbers.h); VTK's mappers
  /// rebuild theirs.
  void numberByGeometryShaders();
  bool numbersByGeometryShaders() const { return this->numbersByGeometryShaders_; }

  /// The values that stay the same for all props of a stage.
  struct StageValues
  {
    bool receiversStage = false; ///< receivers are drawn, alone or with the picture
    ReceiverSpace space;
    TextureBinding layers;      ///< image route: the visibility layers
    TextureBinding bits;        ///< and their image of bits
    glm::ivec2 layersSize{ 0 }; ///< and their size in pixels
    TextureBinding depths;      ///< of the receivers that the layers are of
  };
  /// Between beginStage and endStage VTK draws: textures are bound to units of their own. endStage
  /// also ends a stage that has failed half way, and does nothing where there is none.
  /// @return endStage: false if something was drawn at another size than the layers have
  void beginStage(vtkOpenGLRenderWindow* window, const StageValues& values);
  bool endStage();

  /// Sets the hook's uniforms of a program that is about to draw.
  void setParameters(vtkShaderProgram* program, const Drawn& drawn);

  /// Shaders rebuilt by VTK since the start.
  int rebuilds() const { return this->rebuilds_; }
  /// Of these, programs that were not there before.
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
  std::string multiplications_; ///< and those in front of VTK's light loop
  std::string darkenings_;      ///< deferred route: what stands there for the colour in shadow
  bool numbersByGeometryShaders_ = false;
  vtkTimeStamp stageTime_;
  int rebuilds_ = 0;
  std::set<std::size_t> programs_; ///< hashes of all programs' sources

  std::vector<ShadedLight> lights_;
  vtkOpenGLRenderWindow* window_ = nullptr;
  glm::ivec2 layersSize_{ 0 };
  bool layersFit_ = true;
  std::vector<Uniform> stageUniforms_; ///< with units in place of textures
  struct BoundTexture
  {
    int unit;
    GLenum target;
    GLuint previous; ///< what was bound there before
  };
  std::vector<BoundTexture> bound_;
  std::set<vtkShaderProgram*> upToDate_; ///< programs that have the stage's uniforms
};

} // namespace gnomon
