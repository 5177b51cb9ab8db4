#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/transmittance/LightGrids.h"
#include "shadowtech/transmittance/PointFilter.h"
#include "shadowtech/transmittance/Sheets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// A light's sheets as a deep shadow map (Lokovic and Veach, SIGGRAPH 2000): each texel holds the
/// first crossings of its central ray, with what is left behind them. The last one has what is left
/// behind all of the ray's.
///
/// A point is between four texels. At each it asks for the crossings before its own plane, so that
/// it does not count its own sheet. For rounding and curves it leaves out those in front of the
/// plane by less than (1 + s^2) / 4 texels, where s is the plane's slope against the ray; slopes
/// are limited to 8. So sheets shadow each other from there on, and their shadows' edges are a
/// texel wide.
class SheetMap : public PointFilter
{
public:
  /// The most crossings that a texel tells apart.
  static constexpr std::size_t crossings = 8;

  /// @param sheets needed for this call alone
  /// @param bounds of the sheets, centred
  /// @param resolution the texels along the longer side; half as many for the sides of a cube
  /// @throws TextureMemoryError
  SheetMap(const Sheets& sheets, const Bounds& bounds, const ShadowRayLight& light, int resolution)
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

  bool isColoured() const override { return this->channels_ == 3; }
  std::string name() const override { return "gnomonSheets_LIGHT"; }
  std::string glsl() const override
  {
    return glslDefine("SHEET_GRIDS_LIGHT", static_cast<int>(this->grids_.grids().size())) +
      glslDefine("SHEET_LAMP_LIGHT", this->grids_.isOfLamp() ? 1 : 0) +
      glslDefine("SHEET_DEPTHS_LIGHT", static_cast<int>(crossings / ofTexel)) +
      "#define SHEET_SHARE_LIGHT " + (this->isColoured() ? "vec3" : "float") + "\n" +
      glslDefine("SHEET_COLOURED_LIGHT", this->isColoured() ? 1 : 0) +
      ShaderLibrary::source("shadowtech/transmittance/sheets.glsl");
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms = this->grids_.uniforms("sheet", space);
    uniforms.push_back(
      { "sheets_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->texture_.name() } });
    return uniforms;
  }

  /// True if the light shines on no sheet.
  bool empty() const { return this->grids_.grids().empty(); }
  std::size_t bytes() const { return this->texture_.bytes(); }

private:
  static constexpr std::size_t ofTexel = 4; ///< numbers

  /// Return the corners of a box that is a little larger, so that it has a volume.
  static std::vector<glm::dvec3> cornersAround(const Bounds& bounds)
  {
    const std::array<glm::dvec3, 8> corners = inflated(bounds, 1e-3 * bounds.radius()).corners();
    return { corners.begin(), corners.end() };
  }

  static std::uint16_t in65535ths(double share)
  {
    return static_cast<std::uint16_t>(std::clamp(share, 0.0, 1.0) * 65535.0 + 0.5);
  }

  /// Trace the texels' central rays, and return the texels of a grid. Places without a crossing are
  /// behind everything.
  std::vector<std::uint16_t> trace(const Sheets& sheets, const LightGrid& grid) const
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

  int layers() const { return static_cast<int>((1 + this->channels_) * crossings / ofTexel); }

  LightGrids grids_;
  std::size_t channels_;
  SizedTexture texture_; ///< of each grid the crossings' z, then what is left by channel
};

} // namespace gnomon
