#include "plugin/frame/HookGlsl.h"

#include "plugin/frame/CastingLights.h"
#include "plugin/frame/EdgeImage.h"
#include "plugin/frame/FrameShaders.h"
#include "plugin/frame/TriangleNumbers.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <vtkShaderProgram.h>

#include <algorithm>
#include <regex>
#include <tuple>
#include <utility>

namespace gnomon
{
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

/// Return the expression of one light's visibility. On the image route, translucent surfaces
/// compute it, as they are in no layer. The deferred route first draws opaque ones as lit.
std::string visibilityOf(const HookVariant& variant, const CastingLight& casting, int light)
{
  const char* const bit = variant.edgeBit == noBit ? "gnomonBit(" : "gnomonSmoothBit(";
  // A visibility of one channel scales the mean colour of the light's texture, or white.
  const bool isColour = casting.lightInShaders().texture || casting.plan.channels == 3;
  const std::string even = isColour ? litOf(casting, light) + " * " : "";
  const auto layer = [&](int channel)
  { return "gnomonLayer(" + std::to_string(casting.plan.layer + channel) + ")"; };
  const std::string fetched = variant.route == Route::Deferred ? litOf(casting, light)
    : casting.plan.bit != noBit  ? even + bit + std::to_string(casting.plan.bit) + ")"
    : casting.plan.channels == 3 ? "vec3(" + layer(0) + ", " + layer(1) + ", " + layer(2) + ")"
                                 : even + layer(0);
  const std::string computed =
    even + "visibility_" + std::to_string(light) + "(gnomonPosition, gnomonNormal)";
  return variant.route == Route::Inline ? computed
    : casting.pointwiseOfSurfaces()
    ? "(gnomonTranslucent == 0 ? " + fetched + " : " + computed + ")"
    : fetched;
}

/// Return the declaration that multiplies a light's colour by its visibility on props that receive.
std::string multiplicationOf(const CastingLight& casting, int light, const std::string& visibility)
{
  const std::string colour = "lightColor" + std::to_string(casting.lightInShaders().shaderIndex);
  const std::string lit = litOf(casting, light);
  return "  vec3 " + colour + " = " + colour + " * (gnomonReceives == 0 ? " + lit + " : mix(" +
    lit + ", " + visibility + ", gnomonStrength" + std::to_string(light) + "));\n";
}

/// Return the declaration of a light's colour where receivers are in its shadow. Black as a
/// constant saves the shader most of its second lighting.
std::string darkeningOf(const CastingLight& casting, int light)
{
  const std::string index = std::to_string(casting.lightInShaders().shaderIndex);
  return casting.lightInShaders().strength < 1.0 ? multiplicationOf(casting, light, "0.0")
                                                 : "  vec3 lightColor" + index + " = vec3(0.0);\n";
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

/// Have a shader compute no more of the colour than what decides its discards. VTK fails to draw
/// instances by a program without their normals.
void dropColour(const std::string& vertexShader, std::string& fragmentShader)
{
  if (vertexShader.find("glyphNormalMatrix") == std::string::npos)
  {
    fragmentShader.insert(fragmentShader.rfind('}'), "  gl_FragData[0] = vec4(0.0);\n");
  }
}

/// Return VTK's lighting, between the marks. A copy of it needs a scope of its own.
std::string lightingOf(const std::string& fragmentShader)
{
  const std::size_t begin = fragmentShader.find(beginMarker) + beginMarker.size();
  return fragmentShader.substr(begin, fragmentShader.find(endMarker) - begin);
}

/// Above this many layers, a loop is used. For fewer, Mesa makes a branch of each element of the
/// loop's array, which compiles longer than separate fetches. First frames by fetches and by the
/// loop, in s: with 14 lights 1.9 and 2.9, with 16 2.4 and 1.2, with 20 3.9 and 1.7 (llvmpipe,
/// `stack` under spots).
constexpr int mostFetchesOneByOne = 15;

} // namespace

std::string litOf(const CastingLight& casting, int light)
{
  return casting.lightInShaders().texture ? "gnomonLit" + std::to_string(light)
    : casting.plan.channels == 3          ? "vec3(1.0)"
                                          : "1.0";
}

HookGlsl::HookGlsl(const HookVariant& variant, const CastingLights& lights)
  : variant_(variant)
  , hasLights_(!lights.empty() || variant.skyLayer != noSkyLayer)
  , declarations_(std::string("#define VTK_VIEW_IS_RIGID ") +
      (variant.vtkViewIsRigid ? "1\n" : "0\n") + frameShaders().at("plugin/frame/hook.glsl"))
{
  const bool asksAtPoints = std::any_of(lights.begin(), lights.end(),
    [](const CastingLight& casting) { return casting.pointwiseOfSurfaces() != nullptr; });
  if (asksAtPoints || variant.receiverPoints)
  {
    this->uniformFlow_ = "vec3 gnomonPoint = gnomonInView(vertexVC.xyz);\n"
                         "vec3 gnomonNormal = gnomonFaceNormal(gnomonPoint);\n";
  }
  if (variant.route != Route::Inline)
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_receiver.glsl");
  }
  if (variant.route == Route::Image)
  {
    this->addImages();
  }
  if (asksAtPoints)
  {
    std::string position = "gnomonPoint";
    if (variant.multisampled)
    {
      this->declarations_ += frameShaders().at("plugin/frame/hook_multisample.glsl");
      this->uniformFlow_ +=
        "vec3 gnomonAtCentroid = gnomonInView(interpolateAtCentroid(vertexVCVSOutput).xyz);\n";
      position = "gnomonCentroid(gnomonAtCentroid, gnomonPoint, gnomonNormal)";
      // for interpolateAtCentroid
      this->extensions_ = "#extension GL_ARB_gpu_shader5 : require\n";
    }
    // Maps hold no translucent surface, unless it was asked to cast. So it hides no light from
    // itself, and faces the light where VTK's own normal does.
    this->multiplications_ += "  vec3 gnomonPosition = " + position +
      ";\n  gnomonNormal = gnomonTranslucent == 1 ? gnomonCurve : gnomonNormal;\n"
      "  curvedView = vec4(gnomonCurve, gnomonFacetHeight);\n";
  }
  this->addLights(lights);
  if (variant.skyLayer != noSkyLayer)
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_sky.glsl");
  }
  if (variant.anyCatcher)
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_catcher.glsl");
  }
}

/// Add how shaders find a pixel's visibility in images.
void HookGlsl::addImages()
{
  this->declarations_ += frameShaders().at("plugin/frame/hook_image.glsl");
  if (this->variant_.multisampled)
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_pixel_multisample.glsl");
    this->uniformFlow_ +=
      "float gnomonDepth = gl_FragCoord.z;\n"
      "vec2 gnomonDepthPerPixel = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));\n";
    this->multiplications_ = "  gnomonFindPixel(gnomonDepth, gnomonDepthPerPixel);\n";
  }
  else
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_pixel.glsl");
  }
  const int layers = this->variant_.layers;
  if (layers > mostFetchesOneByOne)
  {
    this->declarations_ += "const int gnomonMostLayers = " + std::to_string(layers) + ";\n" +
      frameShaders().at("plugin/frame/hook_layers.glsl");
    this->multiplications_ += "  gnomonFetchLayers();\n";
  }
  else
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_layer.glsl");
  }
  if (this->variant_.bits > 0)
  {
    this->declarations_ += frameShaders().at("plugin/frame/hook_bits.glsl");
    this->multiplications_ += "  gnomonFetchBits();\n";
  }
  const int edgeBit = this->variant_.edgeBit;
  if (edgeBit != noBit)
  {
    const int texels = (edgeBit + EdgeImage::lightsOfTexel - 1) / EdgeImage::lightsOfTexel;
    this->declarations_ += "const int gnomonEdgeBit = " + std::to_string(edgeBit) +
      ";\nconst int gnomonEdgeTexels = " + std::to_string(texels) + ";\n" +
      frameShaders().at("plugin/frame/hook_edges.glsl");
    this->multiplications_ += "  gnomonFetchEdges();\n";
  }
}

void HookGlsl::addLights(const CastingLights& lights)
{
  int number = 0;
  for (const CastingLight& casting : lights)
  {
    if (const PointwiseTechnique* const called = casting.pointwiseOfSurfaces())
    {
      this->declarations_ +=
        numberedForLight(called->visibilityGlsl(casting.lightInShaders()), number);
    }
    this->declarations_ += "uniform float gnomonStrength" + std::to_string(number) + ";\n";
    if (casting.lightInShaders().texture)
    {
      this->declarations_ += "uniform vec3 " + litOf(casting, number) + ";\n";
    }
    this->multiplications_ +=
      multiplicationOf(casting, number, visibilityOf(this->variant_, casting, number));
    if (this->variant_.route == Route::Deferred)
    {
      this->darkenings_ += darkeningOf(casting, number);
    }
    if (this->variant_.anyCatcher)
    {
      this->brightenings_ += multiplicationOf(casting, number, litOf(casting, number));
    }
    ++number;
  }
}

/// Return statements that light a fragment by the sky, before VTK's lights; empty if VTK does not
/// light it.
/// @param view the expression of the fragment's view of the sky
std::string HookGlsl::lightOfSky(const std::string& fragmentShader, const std::string& view) const
{
  // VTK may declare lights for unlit props, and computes nothing with them.
  if (this->variant_.skyLayer == noSkyLayer ||
    fragmentShader.find("lightColor", fragmentShader.find(beginMarker)) == std::string::npos)
  {
    return "";
  }
  // Edges of meshes have their colour in the ambient term, and are unlit.
  static const std::regex edges(R"(mix\(\s*ambientColor, edgeColor, (emix[^)]*)\))");
  std::smatch edge;
  const std::string share = std::regex_search(fragmentShader, edge, edges) ? edge.str(1) : "0.0";
  return "  gnomonSkyView = " + view +
    ";\n  ambientColor = mix(\n"
    "    gnomonSkyView * (ambientColor + gnomonSkyLight * diffuseColor), ambientColor, " +
    share + ");\n";
}

bool HookGlsl::operator==(const HookGlsl& other) const
{
  const auto parts = [](const HookGlsl& of)
  {
    return std::tie(of.variant_.route, of.variant_.receiverPoints, of.variant_.numbering,
      of.variant_.anySeenThrough, of.variant_.skyLayer, of.declarations_, of.multiplications_,
      of.darkenings_);
  };
  return parts(*this) == parts(other);
}

bool HookGlsl::serve(bool receiversStage)
{
  const bool hasOwn = this->variant_.numbering == Numbering::Receivers && receiversStage;
  return std::exchange(this->receiversStage_, hasOwn) != hasOwn;
}

std::map<std::string, std::vector<std::string>> HookGlsl::samplers() const
{
  static const std::regex declaration("uniform ([iu]?sampler\\w+) (\\w+);");
  const std::string& source = this->declarations_;
  std::map<std::string, std::vector<std::string>> samplers;
  for (std::sregex_iterator found(source.begin(), source.end(), declaration), end; found != end;
       ++found)
  {
    samplers[(*found)[1]].push_back((*found)[2]);
  }
  return samplers;
}

void HookGlsl::mark(
  std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const
{
  const std::string light = "//VTK::Light::Impl";
  if (fragmentShader.find(light) == std::string::npos)
  {
    markEndOfMain(fragmentShader);
    return;
  }
  const std::string drawn =
    this->variant_.route == Route::Inline ? "" : handOnDrawn(vertexShader, geometryShader);
  replace(fragmentShader, "//VTK::Light::Dec", "//VTK::Light::Dec\n" + drawn + declarationMarker);
  replace(
    fragmentShader, "//VTK::UniformFlow::Impl", uniformFlowMarker + "\n  //VTK::UniformFlow::Impl");
  // VTK lights, then multiplies by textures. A user's own shaders may lack the texture mark.
  const std::string texture = "//VTK::TCoord::Impl";
  const std::string& last = fragmentShader.find(texture) != std::string::npos ? texture : light;
  replace(fragmentShader, last, last + "\n  " + endMarker);
  replace(fragmentShader, light, beginMarker + "\n  " + light);
}

void HookGlsl::fill(const std::string& vertexShader, std::string& geometryShader,
  std::string& fragmentShader, bool drawsReceivers, int corners) const
{
  const auto has = [&](const std::string& text)
  { return fragmentShader.find(text) != std::string::npos; };
  // Unlit surfaces have no view coordinates and no lights to shadow. They only hide other surfaces.
  // If no light casts, only receivers are needed, which need neither.
  const bool receives = has(beginMarker) && (!this->hasLights_ || has("vec4 vertexVC"));
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
    const std::string sky = this->lightOfSky(fragmentShader,
      "gnomonReceives == 0 || gnomonTranslucent == 1\n    ? 1.0 : gnomonLayer(" +
        std::to_string(this->variant_.skyLayer) + ")");
    begin += this->multiplications_ + sky;
    if (!sky.empty())
    {
      // Of physically based materials; other shaders have no such lines.
      vtkShaderProgram::Substitute(fragmentShader, "vec3 Lo = vec3(0.0);",
        "vec3 Lo = gnomonSkyView * gnomonSkyLight * (1.0 - metallic) * albedo;");
      vtkShaderProgram::Substitute(fragmentShader, "vec3 color = iblDiffuse + iblSpecular;",
        "vec3 color = gnomonSkyView * iblDiffuse + iblSpecular;");
    }
  }
  if (this->variant_.route != Route::Inline && drawsReceivers)
  {
    std::string primitive = "gl_PrimitiveID";
    if (corners > 0 && receives && geometryShader.empty())
    {
      geometryShader = numberingShader(vertexShader, corners);
      if (!geometryShader.empty())
      {
        primitive = "gnomonPrimitiveVSOutput"; // VTK changes this to GSOutput
        declarations += "flat in int " + primitive + ";\n";
      }
    }
    end = this->writeReceiver(receives, primitive);
    if (this->variant_.route == Route::Image)
    {
      if (!receives)
      {
        declarations = "uniform int gnomonTranslucent;\n";
      }
      // A constant tells the compiler that a program has one stage.
      declarations =
        (this->variant_.numbering == Numbering::Receivers
            ? "const int gnomonStage = " + std::to_string(this->receiversStage_) + ";\n"
            : "uniform int gnomonStage;\n") +
        declarations;
      if (this->variant_.anySeenThrough)
      {
        end = "    if (gnomonTranslucent == 1) discard; // it hides no receiver\n" + end;
      }
      // VTK lights in both stages: its discard of a hole, and a user's, read the colour.
      end = "if (gnomonStage == 1)\n  {\n" + end + "  }\n";
      if (receives && this->receiversStage_)
      {
        dropColour(vertexShader, fragmentShader);
      }
    }
    else if (receives)
    {
      begin = this->lightInShadow(fragmentShader) + begin;
      end += "    gl_FragData[2] = gnomonInShadow;\n";
    }
  }
  if (receives && this->hasLights_ && this->variant_.anyCatcher)
  {
    const char* const gamma = has("color = pow(color, vec3(1.0/2.2));") ? "2.2" : "1.0";
    begin = this->lightWithoutCasters(fragmentShader) + begin;
    end += std::string("  if (gnomonCatches == 1)\n  {\n    gl_FragData[0] = gnomonCaught("
                       "gl_FragData[0], gnomonUnshadowed, ") +
      gamma + ");\n  }\n";
  }
  // VTK puts its #version line at this mark, and extensions must follow it.
  replace(fragmentShader, "//VTK::System::Dec", "//VTK::System::Dec\n" + this->extensions_);
  replace(fragmentShader, declarationMarker, declarations);
  replace(fragmentShader, uniformFlowMarker, uniformFlow);
  replace(fragmentShader, beginMarker, begin);
  replace(fragmentShader, endMarker, end);
}

/// Return statements that compute gnomonInShadow, the fragment's colour with the light hidden, in a
/// scope of their own.
std::string HookGlsl::lightInShadow(const std::string& fragmentShader) const
{
  return "  vec4 gnomonInShadow;\n  {\n" + this->darkenings_ + lightingOf(fragmentShader) +
    "\n  gnomonInShadow = gl_FragData[0];\n  }\n";
}

/// Return statements that compute gnomonUnshadowed, the colour of a shadow catcher that nothing
/// hides a light from. They end its highlights: these belong to the camera, not to the place.
std::string HookGlsl::lightWithoutCasters(const std::string& fragmentShader) const
{
  const bool shines = fragmentShader.find("vec3 specularColor") != std::string::npos;
  return "  vec4 gnomonUnshadowed;\n  if (gnomonCatches == 1)\n  {\n" +
    std::string(shines ? "  specularColor = vec3(0.0);\n" : "") +
    "  vec3 gnomonAmbient = ambientColor;\n" + this->brightenings_ +
    this->lightOfSky(fragmentShader, "1.0") + lightingOf(fragmentShader) +
    "\n  gnomonUnshadowed = gl_FragData[0];\n  ambientColor = gnomonAmbient;\n  }\n";
}

/// Return statements that write the receiver's outputs.
/// @param primitive the expression of the driver's number
std::string HookGlsl::writeReceiver(bool receives, const std::string& primitive) const
{
  const std::string fragment = "vec2(gnomonDrawnSurface(), float(" + primitive +
    " + PrimitiveIDOffset + gnomonDrawnVSOutput.y))";
  if (!receives || this->variant_.numbering == Numbering::None)
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

} // namespace gnomon
