#include "plugin/frame/ShaderManager.h"

#include "plugin/frame/CastingLights.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gnomon
{
namespace
{

/// Return glGet's name for the binding of a texture target.
GLenum bindingOf(GLenum target)
{
  return target == GL_TEXTURE_2D_ARRAY ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D;
}

} // namespace

void ShaderManager::configure(const HookVariant& variant, const CastingLights& lights)
{
  VolumeHook volumes = variant.volumes ? VolumeHook(variant.vtkViewIsRigid, lights) : VolumeHook();
  HookGlsl glsl(variant, lights);
  if (!(glsl == this->glsl_) || !(volumes == this->volumes_))
  {
    this->volumes_ = std::move(volumes);
    this->glsl_ = std::move(glsl);
    this->samplers_ = this->glsl_.samplers();
    this->stageTime_.Modified();
  }
  this->lights_ = &lights;
}

void ShaderManager::numberByGeometryShaders(bool number)
{
  if (number != this->numbersByGeometryShaders_)
  {
    this->numbersByGeometryShaders_ = number;
    this->stageTime_.Modified();
  }
}

void ShaderManager::fillShader(const std::string& vertexShader, std::string& geometryShader,
  std::string& fragmentShader, bool drawsReceivers, int corners)
{
  ++this->rebuilds_;
  this->glsl_.fill(vertexShader, geometryShader, fragmentShader, drawsReceivers,
    this->numbersByGeometryShaders_ ? corners : 0);
  this->programs_.insert(std::hash<std::string>()(vertexShader + geometryShader + fragmentShader));
}

void ShaderManager::fillVolume(std::string& fragmentShader)
{
  ++this->rebuilds_;
  this->volumes_.fill(fragmentShader);
  this->programs_.insert(std::hash<std::string>()(fragmentShader));
}

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

void ShaderManager::beginStage(vtkOpenGLRenderWindow* window, const StageValues& values)
{
  this->window_ = window;
  if (this->glsl_.serve(values.receiversStage))
  {
    this->stageTime_.Modified();
  }
  this->layersSize_ = values.layersSize;
  this->reductionFactor_ = values.receiversStage ? 1 : values.reductionFactor;
  this->layersFit_ = true;
  this->ready_.clear();
  this->stageUniforms_.clear();
  const int spare = this->bindTexture({ GL_TEXTURE_2D, 0 });
  if (this->glsl_.variant().route == Route::Image)
  {
    this->stageUniforms_.push_back({ "gnomonStage", values.receiversStage ? 1 : 0 });
  }
  const glm::dmat3 turn(values.viewFromVtkView);
  const double stretch = std::cbrt(std::abs(glm::determinant(turn))); // of no use to normals
  this->stageUniforms_.push_back({ "gnomonViewFromVtkView", glm::mat4(values.viewFromVtkView) });
  this->stageUniforms_.push_back(
    { "gnomonNormalFromVtkView", glm::mat3(stretch * glm::transpose(glm::inverse(turn))) });
  this->stageUniforms_.push_back({ "gnomonEye", glm::vec4(values.eyeView) });
  int number = 0;
  for (const CastingLight& casting : *this->lights_)
  {
    const ShadowLight& light = casting.lightInShaders();
    this->stageUniforms_.push_back(
      { "gnomonStrength" + std::to_string(number), static_cast<float>(light.strength) });
    if (light.texture)
    {
      this->stageUniforms_.push_back({ litOf(casting, number), light.texture->mean });
    }
    ++number;
  }
  values.receiversStage ? this->separateSamplers() : this->bindVisibility(values);
  // VTK binds a texture that it creates to the active unit.
  this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(spare));
}

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

/// Bind the images and maps of the lights' visibility.
void ShaderManager::bindVisibility(const StageValues& values)
{
  const auto add = [this](std::string name, const auto& value) {
    this->stageUniforms_.push_back({ std::move(name), value });
  };
  if (this->glsl_.variant().route == Route::Image)
  {
    add("gnomonLayers", this->bindTexture(values.layers));
    add("gnomonLayerCount", this->glsl_.variant().layers);
    add("gnomonSkyLight", values.skyLight);
    if (this->glsl_.variant().bits > 0)
    {
      add("gnomonBits", this->bindTexture(values.bits));
    }
    if (this->glsl_.variant().edgeBit != noBit)
    {
      add("gnomonEdgeImage", this->bindTexture(values.edges));
    }
    if (this->glsl_.variant().multisampled)
    {
      add("gnomonDepths", this->bindTexture(values.depths));
    }
  }
  int number = 0;
  for (const CastingLight& casting : *this->lights_)
  {
    if (const PointwiseTechnique* const technique = casting.pointwise())
    {
      for (Uniform uniform : technique->uniforms(values.space))
      {
        uniform.name = numberedForLight(uniform.name, number);
        if (const auto* texture = std::get_if<TextureBinding>(&uniform.value))
        {
          uniform.value = this->bindTexture(*texture);
        }
        this->stageUniforms_.push_back(std::move(uniform));
      }
    }
    ++number;
  }
}

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
  this->ready_.clear();
  this->window_ = nullptr;
  return this->layersFit_;
}

/// Find the layers' first pixel in the present viewport: passes between this one and the props may
/// have a framebuffer of their own.
/// @return false if the layers do not fit it
bool ShaderManager::findOrigin(glm::ivec2& origin)
{
  GLint viewport[4];
  this->window_->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  const glm::ivec2 shown(
    viewport[2] / this->reductionFactor_, viewport[3] / this->reductionFactor_);
  const bool fits = glm::max(shown, 1) == this->layersSize_;
  this->layersFit_ = this->layersFit_ && fits;
  origin = { viewport[0], viewport[1] };
  return fits;
}

ShaderManager::ReadyProgram& ShaderManager::makeReady(vtkShaderProgram* program)
{
  const auto [ready, isNew] = this->ready_.try_emplace(program);
  if (isNew)
  {
    const auto handle = static_cast<GLuint>(program->GetHandle());
    for (const Uniform& uniform : this->stageUniforms_)
    {
      ShaderLibrary::setUniform(handle, uniform);
    }
    constexpr std::array<const char*, 7> names = { "gnomonOrigin", "gnomonReceives", "gnomonDrawn",
      "gnomonTranslucent", "gnomonPrimitivesPerInstance", "gnomonCatches", "gnomonFacetHeight" };
    std::transform(names.begin(), names.end(), ready->second.locations.begin(),
      [handle](const char* name) { return glGetUniformLocation(handle, name); });
  }
  return ready->second;
}

void ShaderManager::setParameters(vtkShaderProgram* program, const HookedSurface& drawn)
{
  ReadyProgram& ready = this->makeReady(program);
  PropUniforms now;
  now.receives = drawn.receives ? 1 : 0;
  if (this->glsl_.variant().route == Route::Image && !drawn.translucent)
  {
    now.receives = this->findOrigin(now.origin) ? now.receives : 0;
  }
  now.drawn = drawn.index;
  now.translucent = drawn.translucent ? 1 : 0;
  now.primitivesPerInstance = static_cast<int>(drawn.primitivesPerInstance);
  now.catches = drawn.catches ? 1 : 0;
  now.facetHeight = drawn.facetHeight;

  const auto [origin, receives, drawnAs, translucent, perInstance, catches, facetHeight] =
    ready.locations;
  const std::optional<PropUniforms>& last = ready.last;
  const auto set = [&](GLint location, int PropUniforms::*member)
  {
    if (!last || (*last).*member != now.*member)
    {
      glUniform1i(location, now.*member);
    }
  };
  if (!last || last->origin != now.origin)
  {
    glUniform2i(origin, now.origin.x, now.origin.y);
  }
  set(receives, &PropUniforms::receives);
  set(drawnAs, &PropUniforms::drawn);
  set(translucent, &PropUniforms::translucent);
  set(perInstance, &PropUniforms::primitivesPerInstance);
  set(catches, &PropUniforms::catches);
  if (!last || last->facetHeight != now.facetHeight)
  {
    glUniform1f(facetHeight, now.facetHeight);
  }
  ready.last = now;
}

} // namespace gnomon
