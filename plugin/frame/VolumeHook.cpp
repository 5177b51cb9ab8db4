#include "plugin/frame/VolumeHook.h"

#include "plugin/frame/FrameShaders.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <regex>

namespace gnomon
{
namespace
{

/// Return the expression of a light's share that reaches a sample: a number or a colour.
std::string factorOf(const ShadedLight& shaded, int light)
{
  const std::string number = std::to_string(light);
  const std::string lit = litOf(shaded, light);
  return "mix(" + lit + ", " + lit + " * gnomonVisibilityAt_" + number +
    "(gnomonSample), gnomonStrength" + number + ")";
}

} // namespace

//------------------------------------------------------------------------------
VolumeHook::VolumeHook(bool viewIsRigid, const std::vector<ShadedLight>& lights)
  : declarations_(std::string("#define VTK_VIEW_IS_RIGID ") + (viewIsRigid ? "1\n" : "0\n") +
      frameShaders().at("plugin/frame/hook.glsl"))
{
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const ShadedLight& shaded = lights[i];
    const int number = static_cast<int>(i);
    this->declarations_ += numberedForLight(shaded.pointwise->visibilityGlsl(shaded.light) +
        frameShaders().at("plugin/frame/hook_volume_light.glsl"),
      number);
    this->declarations_ += "uniform float gnomonStrength" + std::to_string(i) + ";\n";
    if (shaded.light.texture)
    {
      this->declarations_ += "uniform vec3 " + litOf(shaded, number) + ";\n";
    }
    this->factors_.emplace_back(shaded.light.shaderIndex, factorOf(shaded, number));
  }
  this->declarations_ += frameShaders().at("plugin/frame/hook_volume.glsl");
}

//------------------------------------------------------------------------------
void VolumeHook::fill(std::string& fragmentShader) const
{
  static const std::regex array(R"(uniform vec3 in_lightDiffuseColor\[(\d+)\];)");
  static const std::regex lighting(R"(vec4\s+computeLighting\(vec4 color,[^)]*\)\s*\{)");
  std::smatch size;
  std::smatch head;
  if (this->factors_.empty() || !std::regex_search(fragmentShader, size, array) ||
    !std::regex_search(fragmentShader, head, lighting))
  {
    return;
  }
  const auto hidden = [&](const std::string& name)
  { return "  vec3 " + name + "[" + size.str(1) + "] = " + name + ";\n"; };
  std::string body = "\n" + hidden("in_lightDiffuseColor") + hidden("in_lightSpecularColor") +
    "  if (gnomonReceives == 1)\n  {\n    vec3 gnomonSample = gnomonSampleInView();\n"
    "    vec3 gnomonShare;\n";
  for (const auto& [index, factor] : this->factors_)
  {
    const std::string number = "[" + std::to_string(index) + "]";
    if (index < std::stoi(size.str(1))) // VTK has room for so many
    {
      body += "    gnomonShare = vec3(" + factor + ");\n    in_lightDiffuseColor" + number +
        " *= gnomonShare;\n    in_lightSpecularColor" + number + " *= gnomonShare;\n";
    }
  }
  const auto begin = static_cast<std::size_t>(head.position());
  const auto length = static_cast<std::size_t>(head.length());
  fragmentShader.insert(begin + length, body + "  }\n");
  fragmentShader.insert(begin, this->declarations_);
}

} // namespace gnomon
