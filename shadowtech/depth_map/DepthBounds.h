#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>

namespace gnomon
{

/// What `adaptive` and `pcss` ask before they read their whole kernel.
enum class EarlyOut
{
  None, ///< nothing
  Ring, ///< the outermost points, and believe them where they agree
  Exact ///< the least and the largest depth around the point, which never errs
};
struct EarlyOutSettings
{
  EarlyOut earlyOut = EarlyOut::Exact;
};
const SettingsTable& earlyOutSettings();

/// The least and the largest depth of a map's blocks of 2, 4, 8, ... texels, up to the whole layer:
/// a pyramid that tells what all texels of a region say without reading them (depth_bounds.glsl).
///
/// A surface's linear depth is monotonic along every line of the map, so that blocks bound the
/// depths of planes, too. Depths along the ray are not bounded by those of a block's corners.
class DepthBounds
{
public:
  /// @param map a texture array of depths
  /// @param layers at least 1
  /// @throws TextureMemoryError
  void bake(GLuint map, int sizeTexels, int layers, ShaderLibrary& shaders);
  void release();

  explicit operator bool() const { return static_cast<bool>(this->bounds_); }
  std::size_t bytes() const { return this->bytes_; }
  Uniform uniform() const;

private:
  GlTexture bounds_;
  ScreenPass screenPass_;
  std::size_t bytes_ = 0;
};

} // namespace gnomon
