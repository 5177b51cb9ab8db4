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
  /// False only if nothing inside a box (centred) has to be drawn.
  std::function<bool(const Bounds&)> maySee;
  bool backOnly = false; ///< draw only sides that face away from the light
  /// True if the picture is mirrored, so that fronts are clockwise there. Maps are mirrored: a
  /// light looks along +z of its right-handed space.
  bool mirrored = true;
};

/// The snapshot's casting surfaces on the GPU, for baking maps and drawing shadows.
class OccluderBuffers
{
public:
  /// Upload what changed since the last call.
  void update(const Occluders& occluders);

  /// Draw the casting triangles with the program in use, whose vertex shader is casters.vert.glsl.
  /// Leaves out surfaces that the selection does not see, and surfaces with a cut-out
  /// (drawCutouts()). Culls the back faces of one-sided surfaces; the light sees fronts
  /// counter-clockwise.
  void draw(const CasterSelection& selection) const;

  bool hasCutouts() const { return !this->cutouts_.empty(); }

  /// Draw the casting triangles of surfaces with a cut-out, otherwise like draw(). Texture
  /// coordinates are attribute 1, a vec2. The 2D texture of the active unit is each surface's mask:
  /// 0 exactly in the surface's holes, and filtered and repeated like VTK's texture.
  void drawCutouts(const CasterSelection& selection) const;

  /// Return the number of casting surfaces that no view can see.
  int countUnseen(const std::vector<LightView>& views) const;

  /// Return the bytes on the GPU and of the cached lists of surfaces.
  std::size_t bytes() const;

private:
  /// One surface's range of indices, and the box around its triangles.
  struct Part
  {
    GLsizei first;
    GLsizei count;
    std::uint64_t positionsVersion; ///< as uploaded
    Bounds boundsCentred;
    GLuint firstInstance = 0; ///< in instances_; 0, the identity, if drawn once
    GLsizei instances = 0;    ///< 0: drawn once
  };
  /// A surface with a cut-out.
  struct CutoutPart
  {
    Part part;
    bool oneSided;
    std::shared_ptr<const CutoutMask> mask;
    GLint baseVertex; ///< makes its indices relative to its first vertex
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
