#include "plugin/frame/TriangleNumbers.h"

#include <vtkShader.h>
#include <vtkShaderProgram.h>

#include <array>
#include <map>
#include <regex>

namespace gnomon
{

const std::map<std::string, std::string>& hookShaders(); // generated from plugin/*.glsl

namespace
{

const std::string numberOutput = "gnomonPrimitiveGSOutput";

bool hasGeometryShaderOfVtk(vtkShaderProgram* program)
{
  const vtkShader* const shader = program->GetGeometryShader();
  const std::string source = shader ? shader->GetSource() : "";
  return !source.empty() && source.find(numberOutput) == std::string::npos;
}

} // namespace

//------------------------------------------------------------------------------
void TriangleNumbers::beginStage()
{
  this->added_.clear();
  this->compared_.clear();
}

//------------------------------------------------------------------------------
void TriangleNumbers::add(vtkShaderProgram* program, int drawnSurface, bool movesVertices)
{
  if (movesVertices || hasGeometryShaderOfVtk(program))
  {
    this->known_.insert(program);
    return;
  }
  this->added_.insert(program);
  const auto index = static_cast<std::size_t>(drawnSurface);
  if (this->compared_.size() <= index)
  {
    this->compared_.resize(index + 1, 0);
  }
  this->compared_[index] = 1;
}

//------------------------------------------------------------------------------
NumberCheck TriangleNumbers::check(const ReceiverImages& images,
  const std::vector<float>& windowDepths, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, const glm::dmat4& clipFromCentred)
{
  const NumberCheck found =
    checkNumbers(images, windowDepths, drawnSurfaces, this->compared_, occluders, clipFromCentred);
  this->known_.insert(this->added_.begin(), this->added_.end());
  this->beginStage();
  return found;
}

//------------------------------------------------------------------------------
std::string numberingShader(const std::string& vertexShader, int corners)
{
  static const std::regex output(
    R"((flat +|smooth +|noperspective +|centroid +)*out +(\w+) +(\w+)(\[\d+\])? *;)");
  std::string declarations;
  std::string copies;
  std::string extensions;
  for (std::sregex_iterator found(vertexShader.begin(), vertexShader.end(), output), end;
       found != end; ++found)
  {
    const std::smatch& part = *found;
    const std::string qualifier = part[1];
    const std::string type = part[2];
    const std::string input = part[3];
    const std::string extent = part[4];
    // VTK makes the fragment shader read ...GSOut... for each ...VSOut... of the vertex shader.
    const std::size_t mark = input.find("VSOut");
    if (mark == std::string::npos)
    {
      return "";
    }
    const std::string renamed = std::string(input).replace(mark, 1, "G");
    declarations += qualifier + "in " + type + " " + input + "[]" + extent + ";\n" + qualifier +
      "out " + type + " " + renamed + extent + ";\n";
    copies += renamed + " = " + input + "[i];\n    ";
    if (!extent.empty())
    {
      extensions = "#extension GL_ARB_arrays_of_arrays : require\n";
    }
  }
  constexpr std::array<const char*, 3> layouts = {
    "layout(points) in;\nlayout(points, max_vertices = 1) out;\n",
    "layout(lines) in;\nlayout(line_strip, max_vertices = 2) out;\n",
    "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\n"
  };
  std::string shader = hookShaders().at("plugin/frame/number.geom.glsl");
  const auto fill = [&](const char* mark, const std::string& text)
  { vtkShaderProgram::Substitute(shader, mark, text, false); };
  fill("//GNOMON::Extensions", extensions);
  fill("//GNOMON::Layout", layouts.at(static_cast<std::size_t>(corners) - 1));
  fill("//GNOMON::Varyings::Dec", declarations);
  fill("//GNOMON::Varyings::Impl", copies);
  return shader;
}

} // namespace gnomon
