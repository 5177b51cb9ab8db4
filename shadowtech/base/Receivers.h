#pragma once

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/PixelRays.h"
#include "shadowtech/base/SmoothFacet.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

struct Drawn;
struct Occluders;

/// The points that a camera sees, one per pixel, on the CPU and ready for shadow rays.
///
/// Row 0 is the *bottom* row, as in OpenGL; pixel (x, y) is at y * width + x. One array per number,
/// so that sixteen neighbours load as one vector.
struct ReceiverPixels
{
  int width = 0;
  int height = 0;

  /// The receiver, on its triangle, centred (relative to Occluders::centreWorld).
  std::vector<float> positionX, positionY, positionZ;
  /// The triangle's geometric normal, unit length, on the side that the camera sees.
  std::vector<float> normalX, normalY, normalZ;
  /// How far the shadow ray starts off the surface, along the normal (ShadowRay.h); 0 where nothing
  /// is covered.
  std::vector<float> offset;
  /// Occluders::surfaces index; `notCovered` where the camera sees no surface of the snapshot.
  std::vector<std::uint32_t> surface;
  /// `isLifted` where the normal is that of the curved surface above the triangle that the corners'
  /// normals imply, and the offset goes beyond it (SmoothFacet.h); `isBlocked` where a caster is in
  /// between; else 0.
  std::vector<std::uint8_t> lifted;
  static constexpr std::uint8_t isLifted = 1;
  static constexpr std::uint8_t isBlocked = 2;

  static constexpr std::uint32_t notCovered = 0xffffffffu;

  /// All arrays of floats.
  static const std::array<std::vector<float> ReceiverPixels::*, 7> planes;

  std::size_t size() const
  {
    return static_cast<std::size_t>(this->width) * static_cast<std::size_t>(this->height);
  }
  void resize(int newWidth, int newHeight)
  {
    this->width = newWidth;
    this->height = newHeight;
    for (const auto plane : planes)
    {
      (this->*plane).resize(this->size());
    }
    this->surface.resize(this->size());
    this->lifted.resize(this->size());
  }
  /// Memory that this holds: the floats' arrays and the surfaces' have the same type size, and grow
  /// alike.
  std::size_t bytes() const { return 8 * bytesOf(this->positionX) + bytesOf(this->lifted); }
};
inline constexpr std::array<std::vector<float> ReceiverPixels::*, 7> ReceiverPixels::planes = {
  &ReceiverPixels::positionX, &ReceiverPixels::positionY, &ReceiverPixels::positionZ,
  &ReceiverPixels::normalX, &ReceiverPixels::normalY, &ReceiverPixels::normalZ,
  &ReceiverPixels::offset
};

/// What the receivers stage reads back: which triangle VTK drew in each pixel. Where on the
/// triangle follows from the pixel's ray, more precisely than anything interpolated in float.
struct ReceiverImages
{
  int width = 0;
  int height = 0;
  /// x: the drawn surface + 1, negative where the prop does not receive, 0 where nothing was drawn;
  /// y: VTK's primitive number, as the drawn surface counts them (DrawnSurface).
  std::vector<glm::vec2> fragments;
  PixelRays rays;
};

/// How the fragments of one drawn surface find the snapshot. VTK draws a surface per mapper (or
/// mapper helper) and prop; composite helpers draw several blocks with one program and number the
/// primitives through them.
struct DrawnSurface
{
  struct Block
  {
    std::uint32_t firstPrimitive = 0; ///< VTK's number of the block's first triangle
    std::uint32_t primitiveCount = 0;
    std::uint32_t surface = 0; ///< Occluders::surfaces index

    bool operator==(const Block& other) const
    {
      return this->firstPrimitive == other.firstPrimitive &&
        this->primitiveCount == other.primitiveCount && this->surface == other.surface;
    }
  };
  std::vector<Block> blocks; ///< in order of firstPrimitive

  bool operator==(const DrawnSurface& other) const { return this->blocks == other.blocks; }
};

/// Who knows whether anything that casts is between two points. Asked from several threads at once.
class FreeSegments
{
public:
  virtual ~FreeSegments() = default;
  /// @param from, to centred
  /// @param free gets 1 for each pair with nothing in between, else 0
  virtual void areFree(std::size_t count, const PointArrays& from, const PointArrays& to,
    std::uint8_t* free) const = 0;
};

/// A part of the picture and its receivers.
struct ReceiverTile
{
  static constexpr std::size_t mostColumns = 64;
  static constexpr std::size_t mostRows = 16;

  std::size_t firstColumn, firstRow; ///< where it begins in the picture
  /// Its own receivers alone, which is fewer than the most at the picture's right and upper border.
  const ReceiverPixels& receivers;
  /// What a decider says of each receiver by its triangle and line; Uncertain without one. A
  /// receiver that is decided so is left out of `receivers`, as if its pixel showed nothing.
  const std::vector<Certainty>& known;
};

/// The receivers of a picture, made of what the receivers stage read back when somebody asks for
/// them: the points where the pixels' rays meet the triangles that were drawn there, with geometric
/// normals and shadow ray offsets.
///
/// Rasterisers move corners by up to 1/256 pixel, and so draw triangles in pixels whose rays pass
/// them by. The receiver is then the point of the triangle that is closest to the ray as the camera
/// sees it. Pixels whose triangle cannot be found count as not covered.
///
/// Shadow rays of facets that are shaded as if they were curved start above the curved surface, if
/// somebody can say that nothing is in between: what is there may be on the light's side of another
/// surface.
class Receivers
{
public:
  /// @param stored where all() keeps the receivers; empty until then
  /// @param freeSegments of the same snapshot; null: all receivers stay on their triangles
  Receivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
    const Occluders& occluders, ReceiverPixels& stored, const FreeSegments* freeSegments = nullptr);
  /// Receivers that are there: they may stand for themselves.
  Receivers(const ReceiverPixels& stored);

  const FreeSegments* freeSegments() const { return this->freeSegments_; }
  std::size_t width() const { return this->width_; }
  std::size_t height() const { return this->height_; }

  /// The receivers of all tiles, each for as long as it is visited; tiles are visited by several
  /// threads at once. They never leave the processor's cache, unless all() has been called: who
  /// works pixel by pixel asks here.
  /// @param decider decides receivers by their triangles and lines; null: none is decided so. It is
  /// not asked about receivers that all() has made.
  /// @param skipped by tile, row by row: 1 for those that are not visited; null: all are
  void visitTiles(const std::function<void(const ReceiverTile&)>& visit,
    const ReceiverDecider* decider = nullptr,
    const std::vector<std::uint8_t>* skipped = nullptr) const;

  /// What receivers are made of. Not for receivers that stand for themselves.
  Drawn drawn(const ReceiverDecider* decider = nullptr) const;

  /// The whole picture, for who looks at a pixel's neighbours. Made once.
  const ReceiverPixels& all();

private:
  const ReceiverImages* images_ = nullptr; ///< these three: null where the receivers are there
  const std::vector<DrawnSurface>* drawnSurfaces_ = nullptr;
  const Occluders* occluders_ = nullptr;
  const FreeSegments* freeSegments_ = nullptr;
  ReceiverPixels* toFill_ = nullptr;
  const ReceiverPixels* stored_ = nullptr; ///< null until they are there
  std::size_t width_, height_;
};

} // namespace gnomon
