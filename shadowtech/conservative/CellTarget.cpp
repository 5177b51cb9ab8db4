#include "shadowtech/conservative/CellTarget.h"

#include "shadowtech/base/TextureMemory.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <sstream>

namespace gnomon
{
namespace
{

/// Bindings of buffers, as the shaders have them.
enum Binding : GLuint
{
  polygonsBinding,
  sidesBinding,
  segmentsBinding,
  cellsBinding,
  walksBinding,
  ringsBinding,
  bindings
};

constexpr const char* folder = "shadowtech/conservative/";

constexpr int invocationsPerGroup = 64;
/// What has more texels is worth a work group.
constexpr double mostTexelsOfWalk = 256.0;
/// As OpenGL promises of one dispatch.
constexpr std::size_t mostGroups = 65535;

/// As texel_cells.glsl orders them.
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

/// The bits of infinity, as shaders order them: of all minima, before there is any.
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

/// A number as GLSL's double precision has it.
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

/// The extension's switch; 0 where there is none.
GLenum conservativeSwitch()
{
  return GLEW_NV_conservative_raster        ? GL_CONSERVATIVE_RASTERIZATION_NV
    : GLEW_INTEL_conservative_rasterization ? GL_CONSERVATIVE_RASTERIZATION_INTEL
                                            : 0;
}

/// Gives shaders a buffer of what there is; where there is nothing they do not look.
template <typename Element>
void bind(Binding binding, GlBuffer& buffer, const std::vector<Element>& elements)
{
  if (!elements.empty())
  {
    allocateStorage(buffer, elements.size() * sizeof(Element), elements.data(),
      "what a conservative map is drawn from");
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  }
}

/// A rectangle with a side along a unit vector.
struct TurnedBox
{
  glm::dvec2 along;
  glm::dvec2 low, high; ///< along that vector, and to its left

  glm::dvec2 placeOf(const glm::dvec2& at) const
  {
    return at.x * this->along + at.y * glm::dvec2(-this->along.y, this->along.x);
  }
  double area() const
  {
    const glm::dvec2 sides = glm::max(this->high - this->low, 0.0);
    return sides.x * sides.y;
  }
};

/// The one that holds all squares around corners with sides of twice the reach.
TurnedBox rectangleAround(
  const std::vector<glm::dvec2>& corners, const glm::dvec2& along, double reach)
{
  TurnedBox result{ along, glm::dvec2(std::numeric_limits<double>::infinity()),
    glm::dvec2(-std::numeric_limits<double>::infinity()) };
  for (const glm::dvec2& corner : corners)
  {
    const glm::dvec2 at(glm::dot(along, corner), along.x * corner.y - along.y * corner.x);
    result.low = glm::min(result.low, at);
    result.high = glm::max(result.high, at);
  }
  const double further = reach * (std::abs(along.x) + std::abs(along.y));
  result.low -= further;
  result.high += further;
  return result;
}

} // namespace

//------------------------------------------------------------------------------
const char* nameOf(CellPath path)
{
  switch (path)
  {
    case CellPath::Compute:
      return "compute";
    case CellPath::Rasterised:
      return "rasterised";
    case CellPath::Extension:
      return GLEW_NV_conservative_raster ? "GL_NV_conservative_raster"
                                         : "GL_INTEL_conservative_rasterization";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string whyUnsupported(CellPath path)
{
  if (!GLEW_VERSION_4_3)
  {
    const GLubyte* version = glGetString(GL_VERSION);
    return std::string("drawing conservative maps on the GPU takes OpenGL 4.3, whose shaders have "
                       "double precision, and this is ") +
      (version ? reinterpret_cast<const char*>(version) : "none");
  }
  if (path == CellPath::Extension && conservativeSwitch() == 0)
  {
    return "OpenGL has neither GL_NV_conservative_raster nor GL_INTEL_conservative_rasterization";
  }
  GLint buffers = 0;
  glGetIntegerv(path == CellPath::Compute ? GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS
                                          : GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS,
    &buffers);
  return buffers >= static_cast<GLint>(bindings) ? std::string() : "shaders take too few buffers";
}

//------------------------------------------------------------------------------
void RowWalks::add(std::size_t shape, Span rows, double columns)
{
  const auto number = static_cast<std::uint32_t>(shape);
  if (rows.first > rows.last)
  {
    return;
  }
  if (columns * (rows.last - rows.first + 1) <= mostTexelsOfWalk)
  {
    this->ofShapes.emplace_back(number, static_cast<std::uint32_t>(rows.first));
    return;
  }
  for (int row = rows.first; row <= rows.last; row += invocationsPerGroup)
  {
    this->ofRows.emplace_back(number, static_cast<std::uint32_t>(row));
  }
}

//------------------------------------------------------------------------------
std::size_t PolygonBatch::add(const PolygonOnTexels& polygon)
{
  this->records.push_back(polygon.record());
  PolygonRecord& record = this->records.back();
  record.firstSide = static_cast<std::uint32_t>(this->sides.size());
  this->sides.insert(this->sides.end(), polygon.sides(), polygon.sides() + record.sideCount);
  return this->records.size() - 1;
}

//------------------------------------------------------------------------------
void SegmentBatch::draw(const SegmentOnTexels& segment)
{
  const SegmentRecord& record = segment.record();
  const Span rows = segment.rows();
  // Of what is steeper, each row has few columns.
  this->walks.add(this->records.size(), rows,
    2.0 + std::abs(record.alongX) * std::min(1.0, std::abs(record.perY)));
  this->records.push_back(record);
}

//------------------------------------------------------------------------------
void TriangleBatch::draw(
  const MapPolygon& polygon, double margin, int width, Span rows, CellPath path)
{
  const PolygonOnTexels texels(polygon, margin, rows);
  if (texels.rows().first > texels.rows().last)
  {
    return;
  }
  const std::size_t number = this->polygons.add(texels);
  const PolygonRecord& record = texels.record();
  this->walks.add(number, texels.rows(),
    std::min(record.touchedRight, static_cast<double>(width)) - std::max(record.touchedLeft, 0.0));
  if (path != CellPath::Compute)
  {
    // What OpenGL rounds places to, and what floats do.
    const double snap = 0.0625 + std::ldexp(width, -19);
    const std::array<glm::vec2, 3> shape =
      shapeAround(polygon, margin + snap + (path == CellPath::Extension ? 0.0 : 0.5), width, rows);
    this->placesClip.insert(this->placesClip.end(), shape.begin(), shape.end());
  }
}

//------------------------------------------------------------------------------
void RingBatch::draw(const MapRing& ring, double margin, Span rows)
{
  const auto firstPolygon = static_cast<std::uint32_t>(this->polygons.records.size());
  for (const MapPolygon& triangle : ring.triangles)
  {
    this->polygons.add(PolygonOnTexels(triangle, margin, rows));
  }
  const auto firstSegment = static_cast<std::uint32_t>(this->borders.size());
  for (const MapSegment& border : ring.border)
  {
    this->borders.push_back(SegmentOnTexels(border, margin, rows).record());
  }
  const PolygonRecord& middle = this->polygons.records[firstPolygon];
  this->walks.add(this->records.size(), { middle.firstRow, middle.lastRow },
    middle.touchedRight - middle.touchedLeft);
  this->records.push_back({ firstPolygon, static_cast<std::uint32_t>(ring.triangles.size()),
    firstSegment, static_cast<std::uint32_t>(ring.border.size()) });
}

//------------------------------------------------------------------------------
std::array<glm::vec2, 3> shapeAround(const MapPolygon& polygon, double reach, int width, Span rows)
{
  // From the middle of what is drawn.
  const glm::dvec2 half(0.5 * width, 0.5 * (rows.last - rows.first + 1));
  const glm::dvec2 middle(half.x, rows.first + half.y);
  std::vector<glm::dvec2> corners;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    corners.push_back(glm::dvec2(polygon.corners[i].x, polygon.corners[i].y) - middle);
  }
  glm::dvec2 longest(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
    longest = glm::dot(side, side) > glm::dot(longest, longest) ? side : longest;
  }
  std::array<glm::dvec2, 3> shape;
  const auto isTriangle = [&]
  {
    if (corners.size() != 3)
    {
      return false;
    }
    // All sides move outwards by enough as it is scaled about its centre of gravity, which is a third of the height from
    // a side; a square reaches along a unit normal sqrt(2) < 1.5 times as far as in x and in y.
    const glm::dvec2 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    const glm::dvec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    const double area = std::abs(ab.x * ac.y - ab.y * ac.x);
    // Of a point it is 0 / 0, which is not less than 1.
    const double further = 3.0 * 1.5 * reach * glm::length(longest) / area;
    for (std::size_t k = 0; k < 3; ++k)
    {
      shape[k] = centre + (1.0 + further) * (corners[k] - centre);
    }
    // Twice as large at most. The specification does not say how exactly OpenGL cuts what is larger than what is drawn into.
    return further < 1.0 &&
      std::all_of(shape.begin(), shape.end(),
        [&](const glm::dvec2& corner) { return glm::all(glm::lessThan(glm::abs(corner), half)); });
  };
  if (!isTriangle())
  {
    // A right angle around a rectangle: the box's part of what is drawn, or along the longest side, as of needles.
    TurnedBox rectangle = rectangleAround(corners, { 1.0, 0.0 }, reach);
    rectangle.low = glm::max(rectangle.low, -half);
    rectangle.high = glm::min(rectangle.high, half);
    const double length = glm::length(longest);
    if (length > 1.0)
    {
      const TurnedBox needle = rectangleAround(corners, longest / length, reach);
      const glm::dvec2 centre = needle.placeOf(0.5 * (needle.low + needle.high));
      const glm::dvec2 side = 0.5 * (needle.high - needle.low);
      const glm::dvec2 extent = glm::abs(side.x * needle.along) +
        glm::abs(side.y * glm::dvec2(needle.along.y, needle.along.x));
      if (glm::all(glm::lessThan(glm::abs(centre) + extent, half)) &&
        needle.area() < rectangle.area())
      {
        rectangle = needle;
      }
    }
    const glm::dvec2 twice = rectangle.low + 2.0 * (rectangle.high - rectangle.low);
    shape = { { rectangle.placeOf(rectangle.low), rectangle.placeOf({ twice.x, rectangle.low.y }),
      rectangle.placeOf({ rectangle.low.x, twice.y }) } };
  }
  return { { glm::vec2(shape[0] / half), glm::vec2(shape[1] / half), glm::vec2(shape[2] / half) } };
}

//------------------------------------------------------------------------------
CellTarget::CellTarget(ShaderLibrary& shaders, CellPath path, int width, Span rows)
  : bindings_(bindings)
  , shaders_(shaders)
  , path_(path)
  , width_(width)
  , rows_(rows)
{
  const auto texels =
    static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.last - rows.first + 1);
  allocateStorage(this->cells_, texels * bytesOfCell, nullptr, "the cells of a conservative map");
  glClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, cellsBinding, this->cells_.name());
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
void CellTarget::use(GLuint program) const
{
  glUseProgram(program);
  ShaderLibrary::setUniforms(
    program, { { "width", this->width_ }, { "firstRow", this->rows_.first } }, 0, 0);
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
    this->use(program);
    const std::size_t ofGroup = rowEach ? 1 : invocationsPerGroup;
    for (std::size_t from = 0; from < list.size(); from += mostGroups * ofGroup)
    {
      const std::size_t count = std::min(list.size() - from, mostGroups * ofGroup);
      ShaderLibrary::setUniforms(program,
        { { "firstWalk", static_cast<int>(from) }, { "walkCount", static_cast<int>(count) } }, 0,
        0);
      glDispatchCompute(static_cast<GLuint>((count + ofGroup - 1) / ofGroup), 1, 1);
    }
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
void CellTarget::spoil(const TriangleBatch& batch)
{
  this->send(batch.polygons);
  this->walk(batch.walks, "draw_polygons.comp.glsl", { "POISON" });
}

//------------------------------------------------------------------------------
void CellTarget::endEdges()
{
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

//------------------------------------------------------------------------------
void CellTarget::draw(const TriangleBatch& batch)
{
  this->send(batch.polygons);
  if (this->path_ == CellPath::Compute)
  {
    this->walk(batch.walks, "draw_polygons.comp.glsl", {});
  }
  else if (!batch.polygons.records.empty())
  {
    this->rasterise(batch);
  }
}

//------------------------------------------------------------------------------
void CellTarget::rasterise(const TriangleBatch& batch)
{
  const int height = this->rows_.last - this->rows_.first + 1;
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, this->width_);
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
  glViewport(0, 0, this->width_, height);
  for (const GLenum off : { GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_SCISSOR_TEST,
         GL_MULTISAMPLE, GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1 })
  {
    glDisable(off);
  }
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBindVertexArray(this->vertexArray_.create());
  glBindBuffer(GL_ARRAY_BUFFER, this->places_.create());
  glBufferData(GL_ARRAY_BUFFER,
    static_cast<GLsizeiptr>(batch.placesClip.size() * sizeof(glm::vec2)), batch.placesClip.data(),
    GL_STREAM_DRAW);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(0);
  this->use(this->shaders_.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source(std::string(folder) + "draw_polygons.vert.glsl") },
      { GL_FRAGMENT_SHADER,
        ShaderLibrary::source(std::string(folder) + "draw_polygons.frag.glsl") } },
    sampleDefines()));
  const GLenum conservative = this->path_ == CellPath::Extension ? conservativeSwitch() : 0;
  conservative ? glEnable(conservative) : void();
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(batch.placesClip.size()));
  conservative ? glDisable(conservative) : void();
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
