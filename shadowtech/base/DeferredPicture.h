#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

class ShaderLibrary;

/// What is drawn along with a picture so that its shadows can follow: which triangle each pixel
/// shows, and its colour were the one light that casts hidden. While it is attached the picture
/// itself is drawn as if nothing hid the light.
class DeferredPicture
{
public:
  /// Why it cannot be attached to the framebuffer that is bound, as a clause; empty if it can.
  static std::string whyUnsupported();

  /// Attaches its images to the framebuffer that is bound, where the viewport is. The fragment
  /// shader's outputs go
  /// - 0: to the picture, as without;
  /// - 1: to the fragments, xy as in ReceiverImages, if they are wanted;
  /// - 2: to the colours in shadow, blended as the picture's.
  /// @param withFragments false: they stay those of the last picture
  /// @throws TextureMemoryError before anything is attached
  void attach(bool withFragments);

  /// Leaves the framebuffer as it was.
  void detach();

  /// Reads the fragments back.
  void read(ReceiverImages& images) const;
  /// Reads window depths back, one a pixel of the viewport, from the framebuffer that is bound.
  void readDepths(std::vector<float>& depths) const;

  /// Keeps where the picture has shadows.
  /// @param visibility of each pixel of the viewport
  void keepShadows(const std::vector<float>& visibility);

  /// Gives the pixels in shadow their colours, in the framebuffer that is bound. Those between
  /// light and shadow get a mixture of both colours, as the framebuffer's format rounds it.
  /// @param layers whose layer 0 is the visibility that was kept
  void darken(const TextureBinding& layers, ShaderLibrary& shaders);

  /// The viewport's size in pixels.
  const glm::ivec2& size() const { return this->size_; }
  std::size_t bytes() const;

private:
  void allocate(const glm::ivec2& extent, bool eightBit);
  void copyPicture() const;

  GlTexture fragments_;
  GlTexture inShadow_;
  GlFramebuffer framebuffer_; ///< of both, to clear and to read
  glm::ivec2 extent_{ 0 };    ///< of the images: up to the viewport's upper right corner
  bool eightBit_ = false;     ///< whether colours are 8-bit fixed point, as the picture's
  glm::ivec2 origin_{ 0 };    ///< of the viewport
  glm::ivec2 size_{ 0 };      ///< of the viewport
  bool blending_ = false;     ///< of the fragments, whether it was on

  GlBuffer corners_; ///< of the triangles that cover the tiles with shadows, in pixels
  GlVertexArray tiles_;
  GLsizei cornersInPart_ = 0; ///< of tiles of which some is lit, which come first
  GLsizei cornersWhole_ = 0;  ///< and of others
  bool mixes_ = false;        ///< whether some pixels are between light and shadow
};

} // namespace gnomon
