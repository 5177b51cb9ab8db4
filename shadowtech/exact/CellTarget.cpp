#include "shadowtech/exact/CellTarget.h"

#include "shadowtech/base/TextureMemory.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace gnomon
{
namespace
{

/// Binding points of the shaders' buffers.
enum CellBinding : GLuint
{
  polygonsBinding,
  sidesBinding,
  segmentsBinding,
  cellsBinding,
  walksBinding,
  ringsBinding,
  bindings
};

constexpr const char* whatIsDrawnFrom = "the records of a conservative map";

constexpr const char* folder = "shadowtech/exact/";

/// OpenGL guarantees this many work groups per dispatch and axis.
constexpr std::size_t mostGroups = 65535;

/// In the order of texel_cells.glsl.
enum Number
{
  nearest,
  contained,
  sharpEnd,
  first,
  second,
  climb,
  noise,
  numbers
};
constexpr std::size_t bytesOfCell = numbers * sizeof(std::uint32_t);

/// The shaders' ordered bits of infinity, with which all minima start.
constexpr std::uint32_t nothing = 0xff800000u;

float numberOf(std::uint32_t ordered)
{
  const std::uint32_t bits = ordered & 0x80000000u ? ordered & 0x7fffffffu : ~ordered;
  float number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

Cell cellOf(const std::uint32_t* ordered)
{
  Cell cell;
  cell.nearest = numberOf(ordered[nearest]);
  cell.contained = numberOf(ordered[contained]);
  cell.sharpEnd = numberOf(ordered[sharpEnd]);
  cell.first = numberOf(ordered[first]);
  cell.second = numberOf(ordered[second]);
  cell.climb = std::max(0.0f, -numberOf(ordered[climb]));
  cell.noise = std::max(0.0f, -numberOf(ordered[noise]));
  return cell;
}

/// Return a number as a GLSL literal in double precision.
std::string literalOf(double number)
{
  std::ostringstream text;
  text << std::scientific << std::setprecision(std::numeric_limits<double>::max_digits10 - 1)
       << number << "lf";
  return text.str();
}

const std::vector<std::string>& sampleDefines()
{
  static const std::vector<std::string> defines{ "SAMPLE_OFFSET " + literalOf(sampleOffset),
    "SAMPLE_ON_EDGE " + literalOf(sampleOnEdge) };
  return defines;
}

/// Upload elements to a buffer and bind it. Shaders do not read a binding without elements.
template <typename Element>
void bind(CellBinding binding, GlBuffer& buffer, const std::vector<Element>& elements)
{
  if (!elements.empty())
  {
    allocateStorage(buffer, elements.size() * sizeof(Element), elements.data(), whatIsDrawnFrom);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  }
}

} // namespace

//------------------------------------------------------------------------------
std::string CellTarget::whyUnsupported()
{
  if (!GNOMON_HAS_GL(VERSION_4_3))
  {
    const GLubyte* version = glGetString(GL_VERSION);
    return std::string("baking conservative maps on the GPU needs OpenGL 4.3, whose shaders have "
                       "double precision, and this is ") +
      (version ? reinterpret_cast<const char*>(version) : "none");
  }
  GLint buffers = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &buffers);
  return buffers < static_cast<GLint>(bindings) ? "shaders take too few buffers" : "";
}

//------------------------------------------------------------------------------
CellTarget::CellTarget(ShaderLibrary& shaders, int width, Span rows)
  : bindings_(bindings)
  , shaders_(shaders)
  , width_(width)
  , rows_(rows)
{
  const auto texels =
    static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.last - rows.first + 1);
  allocateStorage(this->cells_, texels * bytesOfCell, nullptr, "the cells of a conservative map");
  glClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, cellsBinding, this->cells_.name());
  this->requireNoError();
}

//------------------------------------------------------------------------------
int CellTarget::mostRows(int width, std::size_t mostBytes)
{
  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  const std::size_t bytes = std::min(static_cast<std::size_t>(largest), mostBytes);
  return static_cast<int>(
    std::max<std::size_t>(bytes / (bytesOfCell * static_cast<std::size_t>(width)), 1));
}

//------------------------------------------------------------------------------
/// Throw if OpenGL reports an error. Must be called before the next allocation, which clears
/// errors.
void CellTarget::requireNoError() const
{
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR)
  {
    return;
  }
  std::ostringstream what;
  what << "a conservative map of " << this->width_ << " texels could not be baked on the GPU: ";
  if (error == GL_OUT_OF_MEMORY)
  {
    throw TextureMemoryError(what.str() + "OpenGL is out of memory");
  }
  what << "OpenGL reports error 0x" << std::hex << error;
  throw std::runtime_error(what.str());
}

//------------------------------------------------------------------------------
void CellTarget::walk(const RowWalks& walks, const char* shader, std::vector<std::string> defines)
{
  defines.insert(defines.end(), sampleDefines().begin(), sampleDefines().end());
  defines.push_back("GROUP " + std::to_string(invocationsPerGroup));
  for (const bool rowEach : { false, true })
  {
    const std::vector<glm::uvec2>& list = rowEach ? walks.ofRows : walks.ofShapes;
    if (list.empty())
    {
      continue;
    }
    if (rowEach)
    {
      defines.emplace_back("ROW_EACH");
    }
    bind(walksBinding, this->walks_, list);
    const GLuint program = this->shaders_.program(
      { { GL_COMPUTE_SHADER, ShaderLibrary::source(std::string(folder) + shader) } }, defines);
    glUseProgram(program);
    ShaderLibrary::setUniforms(
      program, { { "width", this->width_ }, { "firstRow", this->rows_.first } }, 0, 0);
    const std::size_t ofGroup = rowEach ? 1 : invocationsPerGroup;
    for (std::size_t from = 0; from < list.size(); from += mostGroups * ofGroup)
    {
      const std::size_t count = std::min(list.size() - from, mostGroups * ofGroup);
      ShaderLibrary::setUniforms(program,
        { { "firstWalk", static_cast<int>(from) }, { "walkCount", static_cast<int>(count) } }, 0,
        0);
      glDispatchCompute(static_cast<GLuint>((count + ofGroup - 1) / ofGroup), 1, 1);
    }
    this->requireNoError();
  }
}

//------------------------------------------------------------------------------
void CellTarget::send(const PolygonBatch& polygons)
{
  bind(polygonsBinding, this->polygons_, polygons.records);
  bind(sidesBinding, this->sides_, polygons.sides);
}

//------------------------------------------------------------------------------
void CellTarget::draw(const SegmentBatch& batch)
{
  bind(segmentsBinding, this->segments_, batch.records);
  this->walk(batch.walks, "draw_segments.comp.glsl", {});
}

//------------------------------------------------------------------------------
void CellTarget::walkPolygons(const TriangleBatch& batch, std::vector<std::string> defines)
{
  this->send(batch.polygons);
  this->walk(batch.walks, "draw_polygons.comp.glsl", std::move(defines));
}

//------------------------------------------------------------------------------
void CellTarget::spoil(const TriangleBatch& batch)
{
  this->walkPolygons(batch, { "POISON" });
}

//------------------------------------------------------------------------------
void CellTarget::draw(const TriangleBatch& batch)
{
  this->walkPolygons(batch, {});
}

//------------------------------------------------------------------------------
void CellTarget::drawNoise(const TriangleBatch& batch)
{
  this->walkPolygons(batch, { "NOISE" });
}

//------------------------------------------------------------------------------
void CellTarget::endPass()
{
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

//------------------------------------------------------------------------------
void CellTarget::draw(const RingBatch& batch)
{
  this->send(batch.polygons);
  bind(segmentsBinding, this->segments_, batch.borders);
  bind(ringsBinding, this->rings_, batch.records);
  this->walk(batch.walks, "draw_rings.comp.glsl", {});
}

//------------------------------------------------------------------------------
void CellTarget::read(const std::function<void(std::size_t texel, const Cell& cell)>& take)
{
  const auto texels = static_cast<std::size_t>(this->width_) *
    static_cast<std::size_t>(this->rows_.last - this->rows_.first + 1);
  std::vector<std::uint32_t> ordered(numbers * texels);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->cells_.name());
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
    static_cast<GLsizeiptr>(ordered.size() * sizeof(std::uint32_t)), ordered.data());
  this->requireNoError();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels, 4096),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        take(i, cellOf(&ordered[numbers * i]));
      }
    });
}

} // namespace gnomon
