#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

class ShaderLibrary;

/// Images drawn along with a picture, for shading its shadows afterwards: the triangle of each
/// pixel, and the pixel's colour if the one casting light were hidden. While they are attached, the
/// picture itself is drawn without shadows.
class DeferredPicture
{
public:
  /// Return why the images cannot be attached to the bound framebuffer, as a clause; empty if they
  /// can.
  static std::string whyUnsupported();

  /// Attach the images to the bound framebuffer, for the current viewport. The fragment shader's
  /// outputs go
  /// - 0: to the picture, as without this class;
  /// - 1: to the fragments, xy as in ReceiverImages, if they are wanted;
  /// - 2: to the colours in shadow, blended like the picture's.
  /// @param withFragments false: reuse the fragments of the last picture
  /// @param cleared the colour of all of the picture so far, if it has just one
  /// @throws TextureMemoryError before anything is attached
  void attach(bool withFragments, const std::optional<glm::vec4>& cleared);

  /// Restore the framebuffer.
  void detach();

  /// Read the fragments back.
  void read(ReceiverImages& images) const;
  /// Read window depths back from the bound framebuffer, one per pixel of the viewport.
  void readDepths(std::vector<float>& depths) const;

  /// Cache which tiles of the picture have shadows; and the visibility, if some is between 0 and 1.
  /// @param visibility of each pixel of the viewport, in [0, 1]
  void keepShadows(const std::vector<float>& visibility);

  /// Draw the colours in shadow into the bound framebuffer, at the pixels in shadow. Pixels between
  /// light and shadow get a mixture of both colours, rounded by the framebuffer's format.
  /// @param visibility for those of keepShadows() that are all 0 or 1: layer 0 of an array texture,
  /// or the lowest bit of a GL_TEXTURE_2D
  void darken(const TextureBinding& visibility, ShaderLibrary& shaders);

  /// The viewport's size in pixels.
  const glm::ivec2& size() const { return this->size_; }
  std::size_t bytes() const;

private:
  void allocate(const glm::ivec2& extent, bool eightBit);
  void uploadMixed(const std::vector<float>& visibility);
  void copyPicture() const;

  GlTexture fragments_;
  GlTexture inShadow_;
  GlFramebuffer framebuffer_; ///< of both images, for clearing and reading
  glm::ivec2 extent_{ 0 };    ///< of the images: up to the viewport's upper right corner
  bool eightBit_ = false;     ///< colours are 8-bit fixed point, as in the picture
  glm::ivec2 origin_{ 0 };    ///< of the viewport
  glm::ivec2 size_{ 0 };      ///< of the viewport
  bool blending_ = false;     ///< was on for output 1 before attach()

  GlBuffer corners_; ///< of triangles over the tiles with shadows, in pixels
  GlVertexArray tiles_;
  GLsizei cornersInPart_ = 0; ///< of partly lit tiles, which come first
  GLsizei cornersWhole_ = 0;  ///< of the other tiles
  bool mixes_ = false;        ///< some pixels are between light and shadow
  SizedTexture mixed_;        ///< then, the visibility of each pixel of the viewport
};

} // namespace gnomon
