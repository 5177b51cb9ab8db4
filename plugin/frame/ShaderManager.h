#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/HookGlsl.h"
#include "plugin/frame/VolumeHook.h"
#include "plugin/scene/DrawnLookup.h"
#include "shadowtech/base/Technique.h"

#include <vtkTimeStamp.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The hook into VTK's shaders: has mappers rebuild their shaders where its GLSL differs, and
/// gives programs their textures and uniforms.
class ShaderManager
{
public:
  /// Set the tasks of the frame's shaders. If they differ from the last frame's, VTK's mappers
  /// rebuild their shaders (stageTime() changes).
  /// @param lights that last as long as the frame
  void configure(const HookVariant& variant, const CastingLights& lights);
  vtkMTimeType stageTime() const { return this->stageTime_.GetMTime(); }

  /// The frame's GLSL.
  const HookGlsl& glsl() const { return this->glsl_; }
  /// HookGlsl::fill() of the frame's GLSL.
  void fillShader(const std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, bool drawsReceivers, int corners);

  /// VolumeHook::fill() of the frame's GLSL.
  void fillVolume(std::string& fragmentShader);

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
    glm::vec3 skyLight{ 0.0f };               ///< image route: SkyPlan::light
    TextureBinding bits;                      ///< image route: the image of bits
    TextureBinding edges;                     ///< image route: EdgeImage::texture()
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
  void separateSamplers();
  void bindVisibility(const StageValues& values);
  int bindTexture(const TextureBinding& texture);
  bool findOrigin(glm::ivec2& origin);

  HookGlsl glsl_;
  VolumeHook volumes_;
  std::map<std::string, std::vector<std::string>> samplers_; ///< HookGlsl::samplers()
  bool numbersByGeometryShaders_ = false;
  vtkTimeStamp stageTime_;
  int rebuilds_ = 0;
  std::set<std::size_t> programs_; ///< hashes of all programs' sources

  const CastingLights* lights_ = nullptr;
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
  /// The uniforms that differ from prop to prop.
  struct PropUniforms
  {
    glm::ivec2 origin{ 0 };
    int receives = 0;
    int drawn = -1;
    int translucent = 0;
    int primitivesPerInstance = 0;
    int catches = 0;
    float facetHeight = 0.0f;
  };
  /// A program that has the stage's uniforms. Many props share one.
  struct ReadyProgram
  {
    std::array<GLint, 7> locations{}; ///< of PropUniforms
    std::optional<PropUniforms> last; ///< as set for the last prop
  };
  ReadyProgram& makeReady(vtkShaderProgram* program);

  std::unordered_map<vtkShaderProgram*, ReadyProgram> ready_;
};

} // namespace gnomon
