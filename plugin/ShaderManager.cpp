#include "plugin/ShaderManager.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>

#include <map>

namespace gnomon
{

const std::map<std::string, std::string>& hookShaders(); // generated from plugin/*.glsl

namespace
{

const std::string declarationMarker = "//GNOMON::Light::Dec";
const std::string normalMarker = "//GNOMON::Normal::Impl";
const std::string beginMarker = "//GNOMON::Light::Begin";
const std::string endMarker = "//GNOMON::Light::End";

void replace(std::string& source, const std::string& search, const std::string& text)
{
  vtkShaderProgram::Substitute(source, search, text, false);
}

/// What glGet calls the binding of a texture target.
GLenum bindingOf(GLenum target)
{
  return target == GL_TEXTURE_2D_ARRAY ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D;
}

/// Has a vertex shader pass the view coordinates on once more, to be interpolated at the centroid of
/// the covered samples. Where a pixel has several samples, its centre may lie off the triangle, and
/// the position there behind a neighbour's surface.
/// @return false for a shader without view coordinates
bool passCentroid(std::string& vertexShader)
{
  const std::string declaration = "out vec4 vertexVCVSOutput;";
  const std::size_t endOfMain = vertexShader.rfind('}');
  if (endOfMain == std::string::npos || vertexShader.find(declaration) == std::string::npos)
  {
    return false;
  }
  vertexShader.insert(endOfMain, "  gnomonCentroidView = vertexVCVSOutput;\n");
  replace(vertexShader, declaration, declaration + "\ncentroid out vec4 gnomonCentroidView;");
  return true;
}

/// The declarations of one light's visibility function, gnomonVisibilityN(position, normal).
std::string declare(Route route, const ShadedLight& shaded, int layer)
{
  const std::string number = std::to_string(layer);
  const std::string head = "float gnomonVisibility" + number + "(vec3 position, vec3 normal)\n{\n";
  if (!shaded.pointwise)
  {
    return head + "  return gnomonLayer(" + number + ");\n}\n";
  }
  const std::string fetch = route == Route::Image
    ? "  if (gnomonTranslucent == 0)\n  {\n    return gnomonLayer(" + number + ");\n  }\n"
    : "";
  return numberedForLight(shaded.pointwise->visibilityGlsl(shaded.light), layer) + head + fetch +
    "  return visibility_" + number + "(position, normal);\n}\n";
}

} // namespace

//------------------------------------------------------------------------------
void ShaderManager::configure(Route route, const std::vector<ShadedLight>& lights)
{
  std::string declarations = hookShaders().at("plugin/hook.glsl");
  if (route == Route::Image)
  {
    declarations += hookShaders().at("plugin/hook_image.glsl");
  }
  std::string multiplications;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const std::string number = std::to_string(i);
    declarations += declare(route, lights[i], static_cast<int>(i));
    declarations += "uniform float gnomonStrength" + number + ";\n";
    const std::string colour = "lightColor" + std::to_string(lights[i].light.shaderIndex);
    multiplications += "  vec3 " + colour + " = " + colour +
      " * (gnomonReceives == 0 ? 1.0 : mix(1.0, " + "gnomonVisibility" + number +
      "(gnomonCentroidView.xyz, gnomonNormal), gnomonStrength" + number + "));\n";
  }
  if (declarations != this->declarations_ || multiplications != this->multiplications_ ||
    route != this->route_)
  {
    this->declarations_ = declarations;
    this->multiplications_ = multiplications;
    this->route_ = route;
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
  // Where there is a geometry shader, VTK has the fragment shader read its outputs instead.
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
  if (passInstance(vertexShader, geometryShader))
  {
    replace(fragmentShader, "//VTK::PrimID::Dec",
      "flat in int gnomonInstanceVSOutput;\n//VTK::PrimID::Dec");
  }
  replace(fragmentShader, "//VTK::Light::Dec", "//VTK::Light::Dec\n" + declarationMarker);
  replace(
    fragmentShader, "//VTK::UniformFlow::Impl", normalMarker + "\n  //VTK::UniformFlow::Impl");
  replace(
    fragmentShader, "//VTK::Light::Impl", beginMarker + "\n  //VTK::Light::Impl\n  " + endMarker);
}

//------------------------------------------------------------------------------
void ShaderManager::fillShader(std::string& vertexShader, const std::string& geometryShader,
  std::string& fragmentShader, bool receiversStage)
{
  ++this->rebuilds_;
  // Unlit surfaces have no view coordinates and no lights to shadow; they only hide what is behind.
  const bool lit = fragmentShader.find("vec4 vertexVC") != std::string::npos;
  std::string declarations;
  std::string normal;
  std::string begin;
  std::string end;
  if (lit)
  {
    declarations = this->declarations_;
    const bool atCentroid = geometryShader.empty() && passCentroid(vertexShader);
    declarations += atCentroid ? "centroid in vec4 gnomonCentroidView;\n"
                               : "#define gnomonCentroidView vertexVC\n";
    normal = "vec3 gnomonNormal = gnomonFaceNormal(vertexVC.xyz, cameraParallel == 1);\n";
    begin = this->multiplications_;
  }
  if (this->route_ == Route::Image && receiversStage)
  {
    const bool instanced = fragmentShader.find("gnomonInstanceVSOutput") != std::string::npos;
    const std::string primitive = std::string("gl_PrimitiveID + PrimitiveIDOffset") +
      (instanced ? " + gnomonInstanceVSOutput * gnomonPrimitivesPerInstance" : "");
    const std::string write = lit
      ? "    float drawn = float(gnomonDrawn + 1) * (gnomonReceives == 1 ? 1.0 : -1.0);\n"
        "    gl_FragData[1] = vec4(vertexVC.xyz, float(" +
        primitive +
        "));\n"
        "    gl_FragData[2] = vec4(drawn, gnomonNormal);\n"
      : "    gl_FragData[1] = vec4(0.0);\n"
        "    gl_FragData[2] = vec4(0.0);\n";
    if (!lit)
    {
      declarations = "uniform int gnomonStage;\n";
    }
    begin = "if (gnomonStage == 1)\n  {\n    gl_FragData[0] = vec4(0.0, 0.0, 0.0, opacity);\n" +
      write + "  }\n  else\n  {\n" + begin;
    end = "  }\n";
  }
  replace(fragmentShader, declarationMarker, declarations);
  replace(fragmentShader, normalMarker, normal);
  replace(fragmentShader, beginMarker, begin);
  replace(fragmentShader, endMarker, end);
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
  this->upToDate_.clear();
  this->stageUniforms_.clear();
  const auto add = [this](std::string name, const auto& value) {
    this->stageUniforms_.push_back({ std::move(name), value });
  };
  if (this->route_ == Route::Image)
  {
    add("gnomonStage", values.receiversStage ? 1 : 0);
    add("gnomonOrigin", values.originPixels);
    // The receivers stage does not read the layers, but a sampler needs a unit of its own kind.
    add("gnomonLayers", this->bindTexture(values.layers));
  }
  for (std::size_t i = 0; i < this->lights_.size(); ++i)
  {
    const int light = static_cast<int>(i);
    add("gnomonStrength" + std::to_string(i), static_cast<float>(this->lights_[i].light.strength));
    if (this->lights_[i].pointwise)
    {
      for (Uniform uniform : this->lights_[i].pointwise->uniforms(values.centredFromView))
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
void ShaderManager::endStage()
{
  if (!this->window_)
  {
    return;
  }
  for (const BoundTexture& texture : this->bound_)
  {
    this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(texture.unit));
    // VTK may have deleted what a free unit still had bound.
    glBindTexture(texture.target, glIsTexture(texture.previous) ? texture.previous : 0);
    this->window_->GetState()->GetTextureUnitManager()->Free(texture.unit);
  }
  this->window_->GetState()->vtkglActiveTexture(GL_TEXTURE0);
  this->bound_.clear();
  this->upToDate_.clear();
  this->window_ = nullptr;
}

//------------------------------------------------------------------------------
void ShaderManager::setParameters(vtkShaderProgram* program, const Drawn& drawn)
{
  const auto handle = static_cast<GLuint>(program->GetHandle());
  if (this->upToDate_.insert(program).second)
  {
    for (const Uniform& uniform : this->stageUniforms_)
    {
      ShaderLibrary::setUniform(handle, uniform);
    }
  }
  ShaderLibrary::setUniform(handle, { "gnomonReceives", drawn.receives ? 1 : 0 });
  ShaderLibrary::setUniform(handle, { "gnomonDrawn", drawn.index });
  ShaderLibrary::setUniform(handle, { "gnomonTranslucent", drawn.translucent ? 1 : 0 });
  ShaderLibrary::setUniform(
    handle, { "gnomonPrimitivesPerInstance", static_cast<int>(drawn.primitivesPerInstance) });
}

} // namespace gnomon
