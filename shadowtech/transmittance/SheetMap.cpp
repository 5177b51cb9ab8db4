#include "shadowtech/transmittance/SheetMap.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon
{
namespace
{

constexpr std::size_t ofTexel = 4; ///< numbers

/// Return the corners of a box that is a little larger, so that it has a volume.
std::vector<glm::dvec3> cornersAround(const Bounds& bounds)
{
  const std::array<glm::dvec3, 8> corners = inflated(bounds, 1e-3 * bounds.radius()).corners();
  return { corners.begin(), corners.end() };
}

std::uint16_t in65535ths(double share)
{
  return static_cast<std::uint16_t>(std::clamp(share, 0.0, 1.0) * 65535.0 + 0.5);
}

} // namespace

//------------------------------------------------------------------------------
SheetMap::SheetMap(
  const Sheets& sheets, const Bounds& bounds, const ShadowRayLight& light, int resolution)
  : grids_(cornersAround(bounds), light, glm::dmat3(1.0))
  , channels_(sheets.isColoured() ? 3 : 1)
{
  if (this->empty())
  {
    return;
  }
  std::vector<LightGrid>& grids = this->grids_.grids();
  for (LightGrid& grid : grids)
  {
    const double texels = this->grids_.isCube() ? resolution / 2 : resolution;
    const double longest = std::max(grid.sides.x, grid.sides.y);
    grid.points = glm::ivec3(glm::max(glm::ceil(grid.sides * (texels / longest)), 2.0));
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  const glm::ivec3& points = grids.front().points;
  this->texture_.allocate({ GL_RGBA16, GL_RGBA, 4, GL_UNSIGNED_SHORT }, points.x, points.y,
    this->layers() * static_cast<int>(grids.size()), "what sheets leave of a light");
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  int first = 0;
  for (const LightGrid& grid : grids)
  {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, first, points.x, points.y, this->layers(),
      GL_RGBA, GL_UNSIGNED_SHORT, this->trace(sheets, grid).data());
    first += this->layers();
  }
}

//------------------------------------------------------------------------------
/// Return the layers of a grid.
int SheetMap::layers() const
{
  return static_cast<int>((1 + this->channels_) * crossings / ofTexel);
}

//------------------------------------------------------------------------------
/// Trace the texels' central rays, and return the texels of a grid. Places without a crossing are
/// behind everything.
std::vector<std::uint16_t> SheetMap::trace(const Sheets& sheets, const LightGrid& grid) const
{
  const auto columns = static_cast<std::size_t>(grid.points.x);
  const std::size_t size = columns * static_cast<std::size_t>(grid.points.y);
  std::vector<std::uint16_t> texels(
    size * ofTexel * static_cast<std::size_t>(this->layers()), 65535);
  const double extent = grid.upper.z - grid.lower.z;
  tbb::parallel_for(0, grid.points.y,
    [&](int y)
    {
      std::vector<SheetCrossing> found;
      for (int x = 0; x < grid.points.x; ++x)
      {
        const LightGrids::Ray ray = this->grids_.rayOf(grid, x, y);
        sheets.findCrossings(glm::vec3(ray.from + grid.lower.z * ray.along),
          glm::vec3(extent * ray.along), 1.0f, found);
        const std::size_t texel =
          static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
        const auto put = [&](std::size_t part, std::size_t crossing, double share)
        {
          const std::size_t layer = (part * crossings + crossing) / ofTexel;
          texels[(layer * size + texel) * ofTexel + crossing % ofTexel] = in65535ths(share);
        };
        glm::dvec3 left(1.0);
        for (std::size_t i = 0; i < found.size(); ++i)
        {
          const std::size_t place = std::min(i, crossings - 1);
          left *= found[i].left;
          if (i == place)
          {
            put(0, place, found[i].at);
          }
          for (std::size_t channel = 0; channel < this->channels_; ++channel)
          {
            put(1 + channel, place, left[static_cast<glm::length_t>(channel)]);
          }
        }
      }
    });
  return texels;
}

//------------------------------------------------------------------------------
std::string SheetMap::glsl() const
{
  return glslDefine("SHEET_GRIDS_LIGHT", static_cast<int>(this->grids_.grids().size())) +
    glslDefine("SHEET_LAMP_LIGHT", this->grids_.isOfLamp() ? 1 : 0) +
    glslDefine("SHEET_DEPTHS_LIGHT", static_cast<int>(crossings / ofTexel)) +
    "#define SHEET_SHARE_LIGHT " + (this->isColoured() ? "vec3" : "float") + "\n" +
    glslDefine("SHEET_COLOURED_LIGHT", this->isColoured() ? 1 : 0) +
    ShaderLibrary::source("shadowtech/transmittance/sheets.glsl");
}

//------------------------------------------------------------------------------
std::vector<Uniform> SheetMap::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->grids_.uniforms("sheet", space);
  uniforms.push_back(
    { "sheets_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->texture_.name() } });
  return uniforms;
}

} // namespace gnomon
