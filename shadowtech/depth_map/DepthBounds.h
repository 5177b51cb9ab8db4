#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <cstddef>

namespace gnomon
{

/// A pyramid of the least and the largest depth of a map's blocks of 2, 4, 8, ... texels, up to the
/// whole layer. It bounds all texels of a region without reading them (depth_bounds.glsl).
///
/// A surface's linear depth is monotonic along every line of the map, so the corners of a block
/// bound the depths of planes, too. They do not bound depths along the ray.
class DepthBounds
{
public:
  /// Build the pyramid of a map.
  /// @param map a texture array of depths
  /// @param layers at least 1
  /// @throws TextureMemoryError
  void bake(GLuint map, int sizeTexels, int layers, ShaderLibrary& shaders);
  /// Free the pyramid.
  void release() { this->bounds_.reset(); }

  /// True if the pyramid is built.
  explicit operator bool() const { return static_cast<bool>(this->bounds_); }
  std::size_t bytes() const { return this->bounds_.bytes(); }
  /// Return the uniform of depth_bounds.glsl.
  Uniform uniform() const;

private:
  SizedTexture bounds_;
  ScreenPass screenPass_;
};

} // namespace gnomon
