#include "plugin/frame/VolumeHook.h"

#include "plugin/frame/CastingLights.h"
#include "plugin/frame/FrameShaders.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <regex>

namespace gnomon
{
namespace
{

/// Return the expression of a light's share that reaches a sample: a number or a colour.
std::string factorOf(const CastingLight& casting, int light)
{
  const std::string number = std::to_string(light);
  const std::string lit = litOf(casting, light);
  return "mix(" + lit + ", " + lit + " * visibilityAt_" + number +
    "(gnomonSample), gnomonStrength" + number + ")";
}

/// The share of each light that reaches a sample: variables, with a function that finds a light's,
/// and what sets them.
struct ShareCode
{
  std::string declarations, values;
};

/// @param factors by VTK's number of the light
/// @param room the number of lights that VTK has room for
ShareCode codeOf(const std::vector<std::pair<int, std::string>>& factors, int room)
{
  std::string variables;
  std::string found;
  std::string values;
  for (const auto& [index, factor] : factors)
  {
    if (index < room)
    {
      const std::string light = std::to_string(index);
      const std::string share = "gnomonShare" + light;
      variables += "vec3 " + share + " = vec3(1.0);\n";
      found += "light == " + light + " ? " + share + " : ";
      values += "    " + share + " = vec3(" + factor + ");\n";
    }
  }
  return { variables + "vec3 gnomonShare(int light)\n{\n  return " + found + "vec3(1.0);\n}\n",
    "\n  if (gnomonReceives == 1)\n  {\n"
    "    vec3 gnomonSample = (gnomonViewFromData * vec4(g_dataPos, 1.0)).xyz;\n" +
      values + "  }\n" };
}

} // namespace

VolumeHook::VolumeHook(bool viewIsRigid, const CastingLights& lights)
  : declarations_(std::string("#define VTK_VIEW_IS_RIGID ") + (viewIsRigid ? "1\n" : "0\n") +
      frameShaders().at("plugin/frame/hook.glsl"))
{
  int number = 0;
  for (const CastingLight& casting : lights)
  {
    this->declarations_ +=
      numberedForLight(casting.pointwise()->visibilityGlsl(casting.lightInShaders()), number);
    this->declarations_ += "uniform float gnomonStrength" + std::to_string(number) + ";\n";
    if (casting.lightInShaders().texture)
    {
      this->declarations_ += "uniform vec3 " + litOf(casting, number) + ";\n";
    }
    this->factors_.emplace_back(casting.lightInShaders().shaderIndex, factorOf(casting, number));
    ++number;
  }
  this->declarations_ += frameShaders().at("plugin/frame/hook_volume.glsl");
}

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
  const ShareCode shares = codeOf(this->factors_, std::stoi(size.str(1)));
  static const std::regex colour(R"((in_light(?:Diffuse|Specular)Color)\[(\w+)\])");
  static const std::regex main(R"(void main\(\)\s*\{)");
  const std::string lit =
    std::regex_replace(head.suffix().str(), colour, "($1[$2] * gnomonShare($2))");
  fragmentShader = head.prefix().str() + this->declarations_ + shares.declarations + head.str() +
    shares.values + std::regex_replace(lit, main, "$&\n  gnomonPlaceSamples();");
}

} // namespace gnomon
