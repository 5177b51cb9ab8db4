#include "plugin/frame/TriangleNumbers.h"

#include "plugin/frame/FrameShaders.h"

#include <vtkShader.h>
#include <vtkShaderProgram.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <regex>

namespace gnomon
{
namespace
{

const std::string numberOutput = "gnomonPrimitiveGSOutput";

bool hasGeometryShaderOfVtk(vtkShaderProgram* program)
{
  const vtkShader* const shader = program->GetGeometryShader();
  const std::string source = shader ? shader->GetSource() : "";
  return !source.empty() && source.find(numberOutput) == std::string::npos;
}

int bitsOf(std::uint32_t number)
{
  int bits = 0;
  for (; number != 0; number >>= 1)
  {
    ++bits;
  }
  return bits;
}

} // namespace

bool TriangleNumbers::isNew(vtkShaderProgram* program, std::uint32_t primitives) const
{
  return this->known_.count({ program, bitsOf(primitives) }) == 0;
}

void TriangleNumbers::add(vtkShaderProgram* program, std::uint32_t primitives, int drawnSurface)
{
  const Draw draw(program, bitsOf(primitives));
  if (hasGeometryShaderOfVtk(program))
  {
    this->known_.insert(draw);
    return;
  }
  this->added_[draw].push_back(drawnSurface);
}

bool TriangleNumbers::isDue()
{
  const bool anyFirst = std::any_of(this->added_.begin(), this->added_.end(),
    [this](const auto& added) { return this->waiting_.count(added.first) == 0; });
  this->stagesWaited_ = anyFirst ? 0 : this->stagesWaited_ + 1;
  const bool isPowerOfTwo = (this->stagesWaited_ & (this->stagesWaited_ - 1)) == 0;
  return !this->added_.empty() && isPowerOfTwo;
}

NumberCheck TriangleNumbers::check(const ReceiverImages& images, const NumberTruth& truth,
  const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders)
{
  std::vector<std::uint8_t> compared(drawnSurfaces.size(), 0);
  for (const auto& added : this->added_)
  {
    for (const int surface : added.second)
    {
      compared[static_cast<std::size_t>(surface)] = 1;
    }
  }
  const NumberCheck found = checkNumbers(images, truth, drawnSurfaces, compared, occluders);
  this->waiting_.clear();
  for (const auto& added : this->added_)
  {
    const bool isSeen = std::any_of(added.second.begin(), added.second.end(),
      [&](int surface) { return found.pixels[static_cast<std::size_t>(surface)] > 0; });
    (isSeen ? this->known_ : this->waiting_).insert(added.first);
  }
  this->beginStage();
  return found;
}

std::string handOnDrawn(std::string& vertexShader, std::string& geometryShader)
{
  const std::string main = "\nvoid main(";        // comments begin otherwise
  const std::string body = "//VTK::PrimID::Impl"; // of VTK's geometry shaders
  const std::size_t begin = vertexShader.rfind(main);
  if (begin == std::string::npos ||
    (!geometryShader.empty() && geometryShader.find(body) == std::string::npos))
  {
    return "uniform int gnomonDrawn;\n#define gnomonDrawnVSOutput ivec2(gnomonDrawn, 0)\n";
  }
  // Programs of both stages place a surface at the same pixels.
  vertexShader.replace(begin, main.size(), "\ninvariant gl_Position;\n\nvoid gnomonMain(");
  vertexShader += "\n" + frameShaders().at("plugin/frame/hook_drawn.vert.glsl");
  // With a geometry shader, VTK makes the fragment shader read its outputs instead.
  vtkShaderProgram::Substitute(geometryShader, "//VTK::PrimID::Dec",
    "flat in ivec2 gnomonDrawnVSOutput[];\nflat out ivec2 gnomonDrawnGSOutput;\n"
    "//VTK::PrimID::Dec",
    false);
  vtkShaderProgram::Substitute(
    geometryShader, body, "gnomonDrawnGSOutput = gnomonDrawnVSOutput[i];\n    " + body, false);
  return "flat in ivec2 gnomonDrawnVSOutput;\n";
}

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
  std::string shader = frameShaders().at("plugin/frame/number.geom.glsl");
  const auto fill = [&](const char* mark, const std::string& text)
  { vtkShaderProgram::Substitute(shader, mark, text, false); };
  fill("//GNOMON::Extensions", extensions);
  fill("//GNOMON::Layout", layouts.at(static_cast<std::size_t>(corners) - 1));
  fill("//GNOMON::Varyings::Dec", declarations);
  fill("//GNOMON::Varyings::Impl", copies);
  return shader;
}

} // namespace gnomon
