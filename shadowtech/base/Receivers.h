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

/// The points that a camera sees, one per pixel, on the CPU, in the form that shadow rays need.
///
/// Row 0 is the *bottom* row, as in OpenGL; pixel (x, y) is at y * width + x. Each coordinate has
/// its own array, so that sixteen neighbours load as one vector.
struct ReceiverPixels
{
  int width = 0;
  int height = 0;

  /// The receiver, on its triangle, centred (relative to Occluders::centreWorld).
  std::vector<float> positionX, positionY, positionZ;
  /// The triangle's geometric normal, unit length, on the side that the camera sees.
  std::vector<float> normalX, normalY, normalZ;
  /// The distance of the shadow ray's start from the surface, along the normal (ShadowRay.h); 0 if
  /// nothing is covered.
  std::vector<float> offset;
  /// Occluders::surfaces index; `notCovered` if the camera sees no surface of the snapshot.
  std::vector<std::uint32_t> surface;
  /// The curved surface above a receiver, which its corners' normals imply (SmoothFacet.h).
  struct Curve
  {
    glm::vec3 normal;
    float height;                     ///< of the surface, along its normal
    std::uint32_t triangle, instance; ///< of the receiver (TriangleOfFragment)
    /// Of receivers that several processes share: with the triangle, the PatchName.
    std::uint32_t process = 0;
  };
  /// 1 if the receiver has a Curve, else 0.
  std::vector<std::uint8_t> curved;
  /// Those of the receivers that have one. Empty if none has.
  std::vector<Curve> curves;

  static constexpr std::uint32_t notCovered = 0xffffffffu;

  static const std::array<std::vector<float> ReceiverPixels::*, 7> planes;

  std::size_t size() const
  {
    return static_cast<std::size_t>(this->width) * static_cast<std::size_t>(this->height);
  }
  glm::vec3 position(std::size_t i) const
  {
    return { this->positionX[i], this->positionY[i], this->positionZ[i] };
  }
  glm::vec3 normal(std::size_t i) const
  {
    return { this->normalX[i], this->normalY[i], this->normalZ[i] };
  }
  /// Set a receiver without a curve.
  void put(std::size_t i, const glm::vec3& position, const glm::vec3& normal, float ofStart,
    std::uint32_t ofSurface)
  {
    this->positionX[i] = position.x;
    this->positionY[i] = position.y;
    this->positionZ[i] = position.z;
    this->normalX[i] = normal.x;
    this->normalY[i] = normal.y;
    this->normalZ[i] = normal.z;
    this->offset[i] = ofStart;
    this->surface[i] = ofSurface;
    this->curved[i] = 0;
  }
  void resize(int newWidth, int newHeight, bool withCurves = false)
  {
    this->width = newWidth;
    this->height = newHeight;
    for (const auto plane : planes)
    {
      (this->*plane).resize(this->size());
    }
    this->surface.resize(this->size());
    this->curved.resize(this->size());
    this->curves.resize(withCurves ? this->size() : 0);
  }
  /// Return the bytes on the heap. The arrays of floats and of surfaces have elements of the same
  /// size, and grow alike.
  std::size_t bytes() const
  {
    return 8 * bytesOf(this->positionX) + bytesOf(this->curved) + bytesOf(this->curves);
  }
};
inline constexpr std::array<std::vector<float> ReceiverPixels::*, 7> ReceiverPixels::planes = {
  &ReceiverPixels::positionX, &ReceiverPixels::positionY, &ReceiverPixels::positionZ,
  &ReceiverPixels::normalX, &ReceiverPixels::normalY, &ReceiverPixels::normalZ,
  &ReceiverPixels::offset
};

/// The triangles that VTK drew, by pixel, as the receivers stage reads them back. The pixel's ray
/// gives the place on the triangle, more precisely than interpolation in float.
struct ReceiverImages
{
  int width = 0;
  int height = 0;
  /// x: the drawn surface + 1, negative if the prop does not receive, 0 if nothing was drawn;
  /// y: VTK's primitive number within the drawn surface (DrawnSurface).
  std::vector<glm::vec2> fragments;
  PixelRays rays;
};

/// Maps the fragments of one drawn surface to surfaces of the snapshot. VTK draws a surface per
/// mapper (or mapper helper) and prop. Composite helpers draw several blocks with one program and
/// number the primitives through them.
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

/// Return how many tiles cover a side of the picture.
inline std::size_t tilesAcross(std::size_t pixels, std::size_t ofTile)
{
  return (pixels + ofTile - 1) / ofTile;
}

/// A part of the picture and its receivers.
struct ReceiverTile
{
  static constexpr std::size_t mostColumns = 64;
  static constexpr std::size_t mostRows = 16;

  std::size_t firstColumn, firstRow; ///< its lower left pixel in the picture
  std::size_t columns, rows;       ///< fewer than the most at the picture's right and upper border
  const ReceiverPixels& receivers; ///< the tile's alone, or those of the picture
  std::size_t first;               ///< index of the tile's first receiver
  /// The certainty of each pixel of the tile by its triangle and line, row by row; Uncertain
  /// without a decider. Receivers decided so are left out of `receivers`, as if their pixels showed
  /// nothing.
  const std::vector<Certainty>& known;

  std::size_t size() const { return this->columns * this->rows; }
  /// Return the tile's number among those of the picture, row by row.
  std::size_t number(std::size_t tilesAcross) const
  {
    return this->firstRow / mostRows * tilesAcross + this->firstColumn / mostColumns;
  }
  /// Return the index of a pixel's receiver.
  std::size_t at(std::size_t column, std::size_t row) const
  {
    return this->first + row * static_cast<std::size_t>(this->receivers.width) + column;
  }
};

/// The receivers of a picture, computed on demand from the images of the receivers stage. A
/// receiver is the point where the pixel's ray meets the drawn triangle, with the geometric normal
/// and the shadow ray's offset.
///
/// Rasterisers move corners by up to 1/256 pixel, and so draw triangles in pixels whose rays miss
/// them. The receiver is then the point of the triangle that the camera sees closest to the ray.
/// Pixels whose triangle cannot be found count as not covered.
class Receivers
{
public:
  /// @param stored where all() caches the receivers; empty until then
  /// @param findCurves true if smooth shading implies curves above receivers
  Receivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
    const Occluders& occluders, ReceiverPixels& stored, bool findCurves = false);
  /// Wrap receivers that exist already. The conversion is implicit, so they can be passed directly.
  Receivers(const ReceiverPixels& stored);

  bool findsCurves() const { return this->findCurves_; }
  std::size_t width() const { return this->width_; }
  std::size_t height() const { return this->height_; }

  /// Visit all tiles, by several threads at once. A tile's receivers are valid during its visit.
  /// They stay in the processor's cache unless all() has been called, so code that works pixel by
  /// pixel should prefer this function to all().
  /// @param decider decides receivers by their triangles and lines; null: decides none. It is not
  /// called for receivers that all() has computed.
  /// @param skipped by tile, row by row: 1 for tiles that are not visited; null: visits all
  void visitTiles(const std::function<void(const ReceiverTile&)>& visit,
    const ReceiverDecider* decider = nullptr,
    const std::vector<std::uint8_t>* skipped = nullptr) const;

  /// Return the data that receivers are computed from. Not for wrapped receivers.
  Drawn drawn(const ReceiverDecider* decider = nullptr) const;

  /// Return the whole picture, for code that reads a pixel's neighbours. Computed once.
  const ReceiverPixels& all();

private:
  const ReceiverImages* images_ = nullptr; ///< these three are null for wrapped receivers
  const std::vector<DrawnSurface>* drawnSurfaces_ = nullptr;
  const Occluders* occluders_ = nullptr;
  bool findCurves_ = false;
  ReceiverPixels* toFill_ = nullptr;
  const ReceiverPixels* stored_ = nullptr; ///< null until computed
  std::size_t width_, height_;
};

} // namespace gnomon
