#include "plugin/frame/ShaderManager.h"

#include "plugin/frame/TriangleNumbers.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>

namespace gnomon
{

const std::map<std::string, std::string>& hookShaders(); // generated from plugin/*.glsl

namespace
{

const std::string declarationMarker = "//GNOMON::Light::Dec";
const std::string uniformFlowMarker = "//GNOMON::UniformFlow::Impl";
const std::string beginMarker = "//GNOMON::Light::Begin";
const std::string endMarker = "//GNOMON::Light::End";

void replace(std::string& source, const std::string& search, const std::string& text)
{
  vtkShaderProgram::Substitute(source, search, text, false);
}

/// Return glGet's name for the binding of a texture target.
GLenum bindingOf(GLenum target)
{
  return target == GL_TEXTURE_2D_ARRAY ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D;
}

/// Return the expression of the factor of a light's colour if nothing hides the light.
std::string litOf(const ShadedLight& shaded, int light)
{
  return shaded.light.texture ? "gnomonLit" + std::to_string(light) : "1.0";
}

/// Return the expression of one light's visibility. On the image route, translucent surfaces
/// compute it, as they are in no layer. The deferred route first draws opaque ones as lit.
std::string visibilityOf(Route route, const ShadedLight& shaded, int light)
{
  // A visibility of one channel scales the mean colour of the light's texture.
  const std::string even = shaded.light.texture ? litOf(shaded, light) + " * " : "";
  const auto layer = [&](int channel)
  { return "gnomonLayer(" + std::to_string(shaded.layer + channel) + ")"; };
  const std::string fetched = route == Route::Deferred ? litOf(shaded, light)
    : shaded.bit != noBit  ? "gnomonBit(" + std::to_string(shaded.bit) + ")"
    : shaded.channels == 3 ? "vec3(" + layer(0) + ", " + layer(1) + ", " + layer(2) + ")"
                           : even + layer(0);
  const std::string computed =
    even + "visibility_" + std::to_string(light) + "(gnomonPosition, gnomonNormal)";
  if (route == Route::Inline)
  {
    return computed;
  }
  return shaded.pointwise ? "(gnomonTranslucent == 0 ? " + fetched + " : " + computed + ")"
                          : fetched;
}

/// Return the declaration that multiplies a light's colour by its visibility on props that receive.
std::string multiplicationOf(const ShadedLight& shaded, int light, const std::string& visibility)
{
  const std::string colour = "lightColor" + std::to_string(shaded.light.shaderIndex);
  const std::string lit = litOf(shaded, light);
  return "  vec3 " + colour + " = " + colour + " * (gnomonReceives == 0 ? " + lit + " : mix(" +
    lit + ", " + visibility + ", gnomonStrength" + std::to_string(light) + "));\n";
}

/// Return the declaration of a light's colour where receivers are in its shadow. Black as a
/// constant saves the shader most of its second lighting.
std::string darkeningOf(const ShadedLight& shaded, int light)
{
  return shaded.light.strength < 1.0
    ? multiplicationOf(shaded, light, "0.0")
    : "  vec3 lightColor" + std::to_string(shaded.light.shaderIndex) + " = vec3(0.0);\n";
}

/// Return statements before VTK's lighting for shaders that draw a solid on a sprite. They replace
/// the sprite's values by the solid's. Empty for triangles.
std::string moveToSolid(const std::string& fragmentShader, const std::string& uniformFlow)
{
  const auto has = [&](const char* text) { return fragmentShader.find(text) != std::string::npos; };
  const bool isImpostor = has("centerVCVSOutput");
  const bool isSizedInPixels = has("ZCalcR"); // points and lines
  std::string moves;
  if (!isImpostor && !isSizedInPixels)
  {
    return moves;
  }
  if (uniformFlow.find("gnomonNormal") != std::string::npos)
  {
    moves += "  gnomonNormal = normalize(gnomonNormalInView(normalVCVSOutput));\n";
    // vertexVC of points and lines is at their middle. ZCalcR is the radius at depth 1.
    moves += isImpostor
      ? "  gnomonPoint = gnomonInView(vertexVC.xyz);\n"
      : "  gnomonPoint = gnomonInView(vertexVC.xyz + normalize(normalVCVSOutput) * ZCalcR *\n"
        "    (cameraParallel == 1 ? 1.0 : -vertexVC.z));\n";
  }
  if (isSizedInPixels && uniformFlow.find("gnomonAtCentroid") != std::string::npos)
  {
    moves += "  gnomonAtCentroid = gnomonPoint;\n";
  }
  if (uniformFlow.find("gnomonDepth") != std::string::npos)
  {
    moves += "  gnomonDepth = gl_FragDepth;\n  gnomonDepthPerPixel = vec2(0.0);\n";
  }
  return moves;
}

/// Return the expression of the normal of the curve that corner normals imply; the triangle's where
/// a shader interpolates none. VTK's own normal may have bumps of a texture or of drawn edges.
/// @param declarations gets the function that it calls
std::string curveNormal(const std::string& fragmentShader, std::string& declarations)
{
  if (fragmentShader.find("in vec3 normalVCVSOutput;") == std::string::npos)
  {
    return "gnomonTranslucent == 1 ? gnomonNormalInView(normalVCVSOutput) : gnomonNormal";
  }
  // VTK's main hides this input by a variable of the same name.
  declarations += "vec3 gnomonInterpolatedNormal()\n{\n"
                  "  return (gl_FrontFacing ? 1.0 : -1.0) *\n"
                  "    normalize(gnomonNormalInView(normalVCVSOutput));\n}\n";
  return "gnomonInterpolatedNormal()";
}

/// Mark the end of a user's whole fragment shader, which lacks VTK's marks. Its main becomes a
/// function, so that it may return early.
void markEndOfMain(std::string& fragmentShader)
{
  static const std::regex head(R"(\bvoid\s+main\s*\(\s*(void)?\s*\))");
  fragmentShader = std::regex_replace(
    fragmentShader, head, "void gnomonMain()", std::regex_constants::format_first_only);
  fragmentShader +=
    "\n" + declarationMarker + "\nvoid main()\n{\n  gnomonMain();\n  " + endMarker + "\n}\n";
}

/// Above this many layers, a loop is used. For fewer, Mesa makes a branch of each element of the
/// loop's array, which compiles longer than separate fetches. First frames by fetches and by the
/// loop, in s: with 14 lights 1.9 and 2.9, with 16 2.4 and 1.2, with 20 3.9 and 1.7 (llvmpipe,
/// `stack` under spots).
constexpr int mostFetchesOneByOne = 15;

/// Return the number of the lights' layers.
int layersOf(const std::vector<ShadedLight>& lights)
{
  int layers = 0;
  for (const ShadedLight& shaded : lights)
  {
    layers = shaded.bit != noBit ? layers : std::max(layers, shaded.layer + shaded.channels);
  }
  return layers;
}

bool haveBits(const std::vector<ShadedLight>& lights)
{
  return std::any_of(
    lights.begin(), lights.end(), [](const ShadedLight& shaded) { return shaded.bit != noBit; });
}

/// Return the names of a source's samplers by type.
std::map<std::string, std::vector<std::string>> samplersOf(const std::string& source)
{
  static const std::regex declaration("uniform ([iu]?sampler\\w+) (\\w+);");
  std::map<std::string, std::vector<std::string>> samplers;
  for (std::sregex_iterator found(source.begin(), source.end(), declaration), end; found != end;
       ++found)
  {
    samplers[(*found)[1]].push_back((*found)[2]);
  }
  return samplers;
}

} // namespace

//------------------------------------------------------------------------------
void ShaderManager::configure(const HookVariant& variant, const std::vector<ShadedLight>& lights)
{
  const bool asksAtPoints = std::any_of(lights.begin(), lights.end(),
    [](const ShadedLight& shaded) { return shaded.pointwise != nullptr; });
  std::string declarations = std::string("#define VTK_VIEW_IS_RIGID ") +
    (variant.vtkViewIsRigid ? "1\n" : "0\n") + hookShaders().at("plugin/frame/hook.glsl");
  std::string position = "gnomonPoint";
  std::string extensions;
  std::string uniformFlow;
  if (asksAtPoints || variant.receiverPoints)
  {
    uniformFlow = "vec3 gnomonPoint = gnomonInView(vertexVC.xyz);\n"
                  "vec3 gnomonNormal = gnomonFaceNormal(gnomonPoint);\n";
  }
  std::string multiplications;
  std::string darkenings;
  if (variant.route != Route::Inline)
  {
    declarations += hookShaders().at("plugin/frame/hook_receiver.glsl");
  }
  if (variant.route == Route::Image)
  {
    declarations += hookShaders().at("plugin/frame/hook_image.glsl");
    if (variant.multisampled)
    {
      declarations += hookShaders().at("plugin/frame/hook_pixel_multisample.glsl");
      uniformFlow +=
        "float gnomonDepth = gl_FragCoord.z;\n"
        "vec2 gnomonDepthPerPixel = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));\n";
      multiplications = "  gnomonFindPixel(gnomonDepth, gnomonDepthPerPixel);\n";
    }
    else
    {
      declarations += hookShaders().at("plugin/frame/hook_pixel.glsl");
    }
    const int layers = layersOf(lights);
    if (layers > mostFetchesOneByOne)
    {
      declarations += "const int gnomonMostLayers = " + std::to_string(layers) + ";\n" +
        hookShaders().at("plugin/frame/hook_layers.glsl");
      multiplications += "  gnomonFetchLayers();\n";
    }
    else
    {
      declarations += hookShaders().at("plugin/frame/hook_layer.glsl");
    }
    if (haveBits(lights))
    {
      declarations += hookShaders().at("plugin/frame/hook_bits.glsl");
      multiplications += "  gnomonFetchBits();\n";
    }
  }
  if (asksAtPoints && variant.multisampled)
  {
    declarations += hookShaders().at("plugin/frame/hook_multisample.glsl");
    uniformFlow +=
      "vec3 gnomonAtCentroid = gnomonInView(interpolateAtCentroid(vertexVCVSOutput).xyz);\n";
    position = "gnomonCentroid(gnomonAtCentroid, gnomonPoint, gnomonNormal)";
    extensions = "#extension GL_ARB_gpu_shader5 : require\n"; // for interpolateAtCentroid
  }
  if (asksAtPoints)
  {
    // Maps hold no translucent surface, unless it was asked to cast. So it hides no light from
    // itself, and faces the light where VTK's own normal does.
    multiplications += "  vec3 gnomonPosition = " + position +
      ";\n  gnomonNormal = gnomonTranslucent == 1 ? gnomonCurve : gnomonNormal;\n"
      "  curvedView = vec4(gnomonCurve, gnomonFacetHeight);\n";
  }
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const ShadedLight& shaded = lights[i];
    const int number = static_cast<int>(i);
    if (shaded.pointwise)
    {
      declarations += numberedForLight(shaded.pointwise->visibilityGlsl(shaded.light), number);
    }
    declarations += "uniform float gnomonStrength" + std::to_string(i) + ";\n";
    if (shaded.light.texture)
    {
      declarations += "uniform vec3 " + litOf(shaded, number) + ";\n";
    }
    multiplications +=
      multiplicationOf(shaded, number, visibilityOf(variant.route, shaded, number));
    darkenings += darkeningOf(shaded, number);
  }
  if (declarations != this->declarations_ || multiplications != this->multiplications_ ||
    (variant.route == Route::Deferred && darkenings != this->darkenings_) ||
    variant.route != this->variant_.route ||
    variant.receiverPoints != this->variant_.receiverPoints ||
    variant.namesTriangles != this->variant_.namesTriangles ||
    variant.anySeenThrough != this->variant_.anySeenThrough)
  {
    this->declarations_ = declarations;
    this->samplers_ = samplersOf(declarations);
    this->multiplications_ = multiplications;
    this->darkenings_ = darkenings;
    this->variant_ = variant;
    this->extensions_ = extensions;
    this->uniformFlow_ = uniformFlow;
    this->stageTime_.Modified();
  }
  this->lights_ = lights;
}

//------------------------------------------------------------------------------
bool passInstance(std::string& vertexShader, std::string& geometryShader)
{
  const std::string declaration = "//VTK::Glyph::Dec";
  const std::string body = "//VTK::Glyph::Impl";
  if (vertexShader.find(body) == std::string::npos)
  {
    return false;
  }
  replace(vertexShader, declaration, "flat out int gnomonInstanceVSOutput;\n" + declaration);
  replace(vertexShader, body, "gnomonInstanceVSOutput = gl_InstanceID;\n  " + body);
  // With a geometry shader, VTK makes the fragment shader read its outputs instead.
  replace(geometryShader, "//VTK::PrimID::Dec",
    "flat in int gnomonInstanceVSOutput[];\nflat out int gnomonInstanceGSOutput;\n"
    "//VTK::PrimID::Dec");
  replace(geometryShader, "//VTK::PrimID::Impl",
    "gnomonInstanceGSOutput = gnomonInstanceVSOutput[i];\n    //VTK::PrimID::Impl");
  return true;
}

//------------------------------------------------------------------------------
void ShaderManager::markShader(
  std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const
{
  const std::string light = "//VTK::Light::Impl";
  if (fragmentShader.find(light) == std::string::npos)
  {
    markEndOfMain(fragmentShader);
    return;
  }
  if (passInstance(vertexShader, geometryShader))
  {
    replace(fragmentShader, "//VTK::PrimID::Dec",
      "flat in int gnomonInstanceVSOutput;\n//VTK::PrimID::Dec");
  }
  replace(fragmentShader, "//VTK::Light::Dec", "//VTK::Light::Dec\n" + declarationMarker);
  replace(
    fragmentShader, "//VTK::UniformFlow::Impl", uniformFlowMarker + "\n  //VTK::UniformFlow::Impl");
  // VTK lights, then multiplies by textures. A user's own shaders may lack the texture mark.
  const std::string texture = "//VTK::TCoord::Impl";
  const std::string& last = fragmentShader.find(texture) != std::string::npos ? texture : light;
  replace(fragmentShader, last, last + "\n  " + endMarker);
  replace(fragmentShader, light, beginMarker + "\n  " + light);
}

//------------------------------------------------------------------------------
void ShaderManager::numberByGeometryShaders(bool number)
{
  if (number != this->numbersByGeometryShaders_)
  {
    this->numbersByGeometryShaders_ = number;
    this->stageTime_.Modified();
  }
}

//------------------------------------------------------------------------------
void ShaderManager::fillShader(const std::string& vertexShader, std::string& geometryShader,
  std::string& fragmentShader, bool drawsReceivers, int corners)
{
  ++this->rebuilds_;
  const auto has = [&](const std::string& text)
  { return fragmentShader.find(text) != std::string::npos; };
  // Unlit surfaces have no view coordinates and no lights to shadow. They only hide other surfaces.
  // If no light casts, only receivers are needed, which need neither.
  const bool receives = has(beginMarker) && (this->lights_.empty() || has("vec4 vertexVC"));
  std::string declarations;
  std::string uniformFlow;
  std::string begin;
  std::string end;
  if (receives)
  {
    declarations = this->declarations_;
    uniformFlow = this->uniformFlow_;
    begin = moveToSolid(fragmentShader, uniformFlow);
    if (this->multiplications_.find("gnomonCurve") != std::string::npos)
    {
      begin += "  vec3 gnomonCurve = " + curveNormal(fragmentShader, declarations) + ";\n";
    }
    begin += this->multiplications_;
  }
  if (this->variant_.route != Route::Inline && drawsReceivers)
  {
    const bool instanced = has("gnomonInstanceVSOutput");
    std::string primitive = "gl_PrimitiveID";
    if (this->numbersByGeometryShaders_ && corners > 0 && receives && geometryShader.empty())
    {
      geometryShader = numberingShader(vertexShader, corners);
      if (!geometryShader.empty())
      {
        primitive = "gnomonPrimitiveVSOutput"; // VTK changes this to GSOutput
        declarations += "flat in int " + primitive + ";\n";
      }
    }
    end = this->writeReceiver(receives, instanced, primitive);
    if (this->variant_.route == Route::Image)
    {
      if (!receives)
      {
        declarations = "uniform int gnomonStage;\nuniform int gnomonTranslucent;\n";
      }
      if (this->variant_.anySeenThrough)
      {
        end = "    if (gnomonTranslucent == 1) discard; // it hides no receiver\n" + end;
      }
      // VTK lights in both stages: a user's code may continue with the colour, and VTK's discard
      // cuts holes of textures by its alpha. The receivers stage draws no colour.
      end = "if (gnomonStage == 1)\n  {\n" + end + "  }\n";
    }
    else if (receives)
    {
      begin = this->lightInShadow(fragmentShader) + begin;
      end += "    gl_FragData[2] = gnomonInShadow;\n";
    }
  }
  // VTK puts its #version line at this mark, and extensions must follow it.
  replace(fragmentShader, "//VTK::System::Dec", "//VTK::System::Dec\n" + this->extensions_);
  replace(fragmentShader, declarationMarker, declarations);
  replace(fragmentShader, uniformFlowMarker, uniformFlow);
  replace(fragmentShader, beginMarker, begin);
  replace(fragmentShader, endMarker, end);
  this->programs_.insert(std::hash<std::string>()(vertexShader + geometryShader + fragmentShader));
}

//------------------------------------------------------------------------------
/// Return statements that compute gnomonInShadow, the fragment's colour with the light hidden. They
/// are a copy of VTK's lighting between the marks, in a scope of its own.
std::string ShaderManager::lightInShadow(const std::string& fragmentShader) const
{
  const std::size_t begin = fragmentShader.find(beginMarker) + beginMarker.size();
  const std::size_t end = fragmentShader.find(endMarker);
  return "  vec4 gnomonInShadow;\n  {\n" + this->darkenings_ +
    fragmentShader.substr(begin, end - begin) + "\n  gnomonInShadow = gl_FragData[0];\n  }\n";
}

//------------------------------------------------------------------------------
/// Return statements that write the receiver's outputs.
/// @param primitive the expression of the driver's number
std::string ShaderManager::writeReceiver(
  bool receives, bool instanced, const std::string& primitive) const
{
  const std::string instance =
    instanced ? " + gnomonInstanceVSOutput * gnomonPrimitivesPerInstance" : "";
  const std::string fragment =
    "vec2(gnomonDrawnSurface(), float(" + primitive + " + PrimitiveIDOffset" + instance + "))";
  if (!receives || !this->variant_.namesTriangles)
  {
    return "    gl_FragData[1] = vec4(0.0);\n"
           "    gl_FragData[2] = vec4(0.0);\n";
  }
  if (!this->variant_.receiverPoints)
  {
    return "    gl_FragData[1] = vec4(" + fragment + ", 0.0, 0.0);\n";
  }
  return "    gl_FragData[1] = vec4(" + fragment + ", gnomonNormal.xy);\n" +
    "    gl_FragData[2] = vec4(gnomonPoint, gnomonNormal.z);\n";
}

//------------------------------------------------------------------------------
int ShaderManager::bindTexture(const TextureBinding& texture)
{
  const int unit = this->window_->GetState()->GetTextureUnitManager()->Allocate();
  if (unit < 0)
  {
    throw ShaderError("no texture unit is left for a shadow map");
  }
  this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  GLint previous = 0;
  glGetIntegerv(bindingOf(texture.target), &previous);
  glBindTexture(texture.target, texture.texture);
  this->bound_.push_back({ unit, texture.target, static_cast<GLuint>(previous) });
  return unit;
}

//------------------------------------------------------------------------------
void ShaderManager::beginStage(vtkOpenGLRenderWindow* window, const StageValues& values)
{
  this->window_ = window;
  this->layersSize_ = values.layersSize;
  this->reductionFactor_ = values.receiversStage ? 1 : values.reductionFactor;
  this->layersFit_ = true;
  this->upToDate_.clear();
  this->stageUniforms_.clear();
  const int spare = this->bindTexture({ GL_TEXTURE_2D, 0 });
  if (this->variant_.route == Route::Image)
  {
    this->stageUniforms_.push_back({ "gnomonStage", values.receiversStage ? 1 : 0 });
  }
  const glm::dmat3 turn(values.viewFromVtkView);
  const double stretch = std::cbrt(std::abs(glm::determinant(turn))); // of no use to normals
  this->stageUniforms_.push_back({ "gnomonViewFromVtkView", glm::mat4(values.viewFromVtkView) });
  this->stageUniforms_.push_back(
    { "gnomonNormalFromVtkView", glm::mat3(stretch * glm::transpose(glm::inverse(turn))) });
  this->stageUniforms_.push_back({ "gnomonEye", glm::vec4(values.eyeView) });
  for (std::size_t i = 0; i < this->lights_.size(); ++i)
  {
    const ShadowLight& light = this->lights_[i].light;
    this->stageUniforms_.push_back(
      { "gnomonStrength" + std::to_string(i), static_cast<float>(light.strength) });
    if (light.texture)
    {
      this->stageUniforms_.push_back(
        { litOf(this->lights_[i], static_cast<int>(i)), light.texture->mean });
    }
  }
  values.receiversStage ? this->separateSamplers() : this->bindVisibility(values);
  // VTK binds a texture that it creates to the active unit.
  this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(spare));
}

//------------------------------------------------------------------------------
/// Bind empty textures. The receivers stage reads none, and maps may be missing. But samplers of
/// different types must not share a unit, or OpenGL draws nothing.
void ShaderManager::separateSamplers()
{
  for (const auto& [type, names] : this->samplers_)
  {
    const bool isArray = type.find("Array") != std::string::npos;
    const GLenum target = isArray ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    const int unit = this->bindTexture({ target, 0 });
    for (const std::string& name : names)
    {
      this->stageUniforms_.push_back({ name, unit });
    }
  }
}

//------------------------------------------------------------------------------
/// Bind the images and maps of the lights' visibility.
void ShaderManager::bindVisibility(const StageValues& values)
{
  const auto add = [this](std::string name, const auto& value) {
    this->stageUniforms_.push_back({ std::move(name), value });
  };
  if (this->variant_.route == Route::Image)
  {
    add("gnomonLayers", this->bindTexture(values.layers));
    add("gnomonLayerCount", layersOf(this->lights_));
    if (haveBits(this->lights_))
    {
      add("gnomonBits", this->bindTexture(values.bits));
    }
    if (this->variant_.multisampled)
    {
      add("gnomonDepths", this->bindTexture(values.depths));
    }
  }
  for (std::size_t i = 0; i < this->lights_.size(); ++i)
  {
    const int light = static_cast<int>(i);
    if (this->lights_[i].pointwise)
    {
      for (Uniform uniform : this->lights_[i].pointwise->uniforms(values.space))
      {
        uniform.name = numberedForLight(uniform.name, light);
        if (const auto* texture = std::get_if<TextureBinding>(&uniform.value))
        {
          uniform.value = this->bindTexture(*texture);
        }
        this->stageUniforms_.push_back(std::move(uniform));
      }
    }
  }
}

//------------------------------------------------------------------------------
bool ShaderManager::endStage()
{
  if (!this->window_)
  {
    return true;
  }
  for (const BoundTexture& texture : this->bound_)
  {
    this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(texture.unit));
    // VTK may have deleted the texture bound to a free unit.
    glBindTexture(texture.target, glIsTexture(texture.previous) ? texture.previous : 0);
    this->window_->GetState()->GetTextureUnitManager()->Free(texture.unit);
  }
  this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0);
  this->bound_.clear();
  this->upToDate_.clear();
  this->window_ = nullptr;
  return this->layersFit_;
}

//------------------------------------------------------------------------------
bool ShaderManager::setLayersOrigin(GLuint program)
{
  // The present viewport: passes between this one and the props may have a framebuffer of their
  // own.
  GLint viewport[4];
  this->window_->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  ShaderLibrary::setUniform(program, { "gnomonOrigin", glm::ivec2(viewport[0], viewport[1]) });
  const glm::ivec2 shown(
    viewport[2] / this->reductionFactor_, viewport[3] / this->reductionFactor_);
  const bool fits = glm::max(shown, 1) == this->layersSize_;
  this->layersFit_ = this->layersFit_ && fits;
  return fits;
}

//------------------------------------------------------------------------------
void ShaderManager::setParameters(vtkShaderProgram* program, const HookedSurface& drawn)
{
  const auto handle = static_cast<GLuint>(program->GetHandle());
  if (this->upToDate_.insert(program).second)
  {
    for (const Uniform& uniform : this->stageUniforms_)
    {
      ShaderLibrary::setUniform(handle, uniform);
    }
  }
  bool receives = drawn.receives;
  if (this->variant_.route == Route::Image && !drawn.translucent)
  {
    receives = this->setLayersOrigin(handle) && receives;
  }
  ShaderLibrary::setUniform(handle, { "gnomonReceives", receives ? 1 : 0 });
  ShaderLibrary::setUniform(handle, { "gnomonDrawn", drawn.index });
  ShaderLibrary::setUniform(handle, { "gnomonTranslucent", drawn.translucent ? 1 : 0 });
  ShaderLibrary::setUniform(handle, { "gnomonFacetHeight", drawn.facetHeight });
  ShaderLibrary::setUniform(
    handle, { "gnomonPrimitivesPerInstance", static_cast<int>(drawn.primitivesPerInstance) });
}

} // namespace gnomon
