#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace gnomon
{

/// Which casters are drawn, and which of their sides.
struct CasterSelection
{
  /// False only if a box (centred) holds nothing that is to be drawn.
  std::function<bool(const Bounds&)> maySee;
  bool backOnly = false; ///< of the two-sided surfaces, too: only what faces away from the light
  /// Whether the picture is mirrored, so that fronts are clockwise there. Maps are: a light looks
  /// along +z of its right-handed space.
  bool mirrored = true;
};

/// The snapshot's casting surfaces on the GPU, for drawing maps and shadows.
class OccluderBuffers
{
public:
  /// Brings the buffers up to date; only what changed is sent.
  void update(const Occluders& occluders);

  /// Draws the casting triangles with the program in use, whose vertex shader is casters.vert.glsl.
  /// Surfaces that cannot be seen are left out, and those with a cut-out are left to drawCutouts().
  /// One-sided surfaces are drawn with their back faces culled, "front" being what the light sees
  /// counter-clockwise.
  void draw(const CasterSelection& selection) const;

  /// Whether there are surfaces with a cut-out.
  bool hasCutouts() const { return !this->cutouts_.empty(); }

  /// Draws the casting triangles of surfaces with a cut-out, otherwise like draw(). Texture
  /// coordinates are attribute 1, a vec2; the 2D texture of the active unit is, surface by surface,
  /// its mask, which is 0 exactly where the surface has a hole, filtered and repeated as VTK's
  /// texture is.
  void drawCutouts(const CasterSelection& selection) const;

  /// The number of casting surfaces that none of the views can see.
  int countUnseen(const std::vector<LightView>& views) const;

  /// The buffer of all the snapshot's positions, three floats each; 0 before the first update.
  GLuint positions() const { return this->positions_.name(); }

  /// On the GPU, and what is remembered of each surface.
  std::size_t bytes() const;

private:
  /// One surface's indices, and the box around what they lead to.
  struct Part
  {
    GLsizei first;
    GLsizei count;
    std::uint64_t positionsVersion; ///< as sent
    Bounds boundsCentred;
    GLuint firstInstance = 0; ///< in instances_; 0 is the identity, which what is drawn once takes
    GLsizei instances = 0;    ///< 0: drawn once
  };
  /// A surface with a cut-out.
  struct CutoutPart
  {
    Part part;
    bool oneSided;
    std::shared_ptr<const CutoutMask> mask;
    GLint baseVertex; ///< brings its indices to its first vertex, where both attributes begin
    GlBuffer textureCoordinates;
    GlVertexArray vertexArray;
  };
  void sendAll(const Occluders& occluders);
  void sendInstances(const Occluders& occluders);
  void sendMoved(const Occluders& occluders);
  void sendCutouts(const Occluders& occluders);
  void addPart(const Surface& surface, const Part& part);
  void drawParts(const std::vector<Part>& parts, const CasterSelection& selection) const;

  GlVertexArray vertexArray_;
  GlBuffer positions_;
  GlBuffer indices_;
  GlBuffer instances_; ///< matrices: the identity, then those of all drawn surfaces with instances
  std::vector<Part> twoSided_;
  std::vector<Part> oneSided_;
  std::vector<CutoutPart> cutouts_;
  std::map<std::shared_ptr<const CutoutMask>, GlTexture> masks_; ///< of cutouts_
  std::size_t bytesOnGpu_ = 0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon
