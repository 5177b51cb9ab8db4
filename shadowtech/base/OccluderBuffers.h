#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/Instances.h"
#include "shadowtech/base/Occluders.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon
{

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
  void update(const Occluders& occluders)
  {
    const bool sameTopology =
      this->vertexArray_ && this->topologyVersion_ == occluders.topologyVersion;
    if (sameTopology && this->positionsVersion_ == occluders.positionsVersion)
    {
      return;
    }
    const GlStateGuard guard; // index buffers bound later must not land in this vertex array
    glBindVertexArray(this->vertexArray_.create());
    glBindBuffer(GL_ARRAY_BUFFER, this->positions_.create());
    sameTopology ? this->sendMoved(occluders) : this->sendAll(occluders);
    this->topologyVersion_ = occluders.topologyVersion;
    this->positionsVersion_ = occluders.positionsVersion;
  }

  /// Draw the casting triangles with the program in use, whose vertex shader is casters.vert.glsl.
  /// Leaves out surfaces that the selection does not see, and surfaces with a cut-out
  /// (drawCutouts()). Culls the back faces of one-sided surfaces; the light sees fronts
  /// counter-clockwise.
  void draw(const CasterSelection& selection) const
  {
    glBindVertexArray(this->vertexArray_.name());
    cull(false, selection);
    this->drawParts(this->twoSided_, selection);
    cull(true, selection);
    this->drawParts(this->oneSided_, selection);
    glDisable(GL_CULL_FACE);
  }

  bool hasCutouts() const { return !this->cutouts_.empty(); }

  /// Draw the casting triangles of surfaces with a cut-out, otherwise like draw(). Texture
  /// coordinates are attribute 1, a vec2. The 2D texture of the active unit is each surface's mask:
  /// 0 exactly in the surface's holes, and filtered and repeated like VTK's texture.
  void drawCutouts(const CasterSelection& selection) const
  {
    for (const CutoutPart& cutout : this->cutouts_)
    {
      const Part& part = cutout.part;
      if (!selection.maySee(part.boundsCentred))
      {
        continue;
      }
      cull(cutout.oneSided, selection);
      glBindVertexArray(cutout.vertexArray.name());
      glBindTexture(GL_TEXTURE_2D, this->masks_.at(cutout.mask).name());
      glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, part.count, GL_UNSIGNED_INT,
        offsetOf<GLuint>(static_cast<std::size_t>(part.first)), std::max(part.instances, 1),
        cutout.baseVertex, part.firstInstance);
    }
    glDisable(GL_CULL_FACE);
  }

  /// Return the number of casting surfaces that no view can see.
  int countUnseen(const std::vector<LightView>& views) const
  {
    const auto isUnseen = [&](const Part& part)
    {
      return std::none_of(views.begin(), views.end(),
        [&](const LightView& view) { return view.maySee(part.boundsCentred); });
    };
    const auto count = std::count_if(this->twoSided_.begin(), this->twoSided_.end(), isUnseen) +
      std::count_if(this->oneSided_.begin(), this->oneSided_.end(), isUnseen) +
      std::count_if(this->cutouts_.begin(), this->cutouts_.end(),
        [&](const CutoutPart& cutout) { return isUnseen(cutout.part); });
    return static_cast<int>(count);
  }

  /// Return the bytes on the GPU and of the cached lists of surfaces.
  std::size_t bytes() const
  {
    return this->bytesOnGpu_ + bytesOf(this->twoSided_) + bytesOf(this->oneSided_) +
      bytesOf(this->cutouts_);
  }

private:
  static bool isDrawn(const Surface& surface) { return surface.casts && surface.triangleCount > 0; }

  static Bounds verticesBounds(const Surface& surface, const Occluders& occluders)
  {
    const glm::vec3* positions = occluders.positionsCentred.data() + surface.firstVertex;
    if (surface.isInstanced())
    {
      return instancesBounds(positions, surface.vertexCount, surface.centredFromSource);
    }
    Bounds bounds;
    for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
    {
      bounds.add(glm::dvec3(positions[i]));
    }
    return bounds;
  }

  /// Upload some elements of an array to a place in the bound buffer, counted in elements.
  template <typename Element>
  static void send(GLenum target, const std::vector<Element>& elements, std::size_t first,
    std::size_t count, std::size_t place)
  {
    glBufferSubData(target, static_cast<GLintptr>(place * sizeof(Element)),
      static_cast<GLsizeiptr>(count * sizeof(Element)), elements.data() + first);
  }

  static GLint wrapOf(TextureWrap wrap)
  {
    return wrap == TextureWrap::ClampToEdge ? GL_CLAMP_TO_EDGE
      : wrap == TextureWrap::MirroredRepeat ? GL_MIRRORED_REPEAT
      : wrap == TextureWrap::ClampToBorder  ? GL_CLAMP_TO_BORDER
                                            : GL_REPEAT;
  }

  /// Return a mask as the red channel of a texture, with the filter and wrap of VTK's texture.
  static GlTexture makeTexture(const CutoutMask& mask)
  {
    GlTexture texture;
    glBindTexture(GL_TEXTURE_2D, texture.create());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, mask.width, mask.height, 0, GL_RED, GL_UNSIGNED_BYTE,
      mask.texels.data());
    const GLint filter = mask.interpolated ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapOf(mask.wrap));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapOf(mask.wrap));
    const GLfloat border[4] = { mask.borderDrawn ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f };
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
    return texture;
  }

  /// Return the offset of an element of the bound buffer, in the form that OpenGL expects.
  template <typename Element>
  static const void* offsetOf(std::size_t number)
  {
    return reinterpret_cast<const void*>(number * sizeof(Element));
  }

  /// Make the bound vertex array read a matrix per instance from the bound buffer.
  static void readMatrices()
  {
    for (GLuint column = 0; column < 4; ++column)
    {
      const GLuint attribute = 2 + column;
      glVertexAttribPointer(
        attribute, 3, GL_FLOAT, GL_FALSE, sizeof(glm::mat4x3), offsetOf<glm::vec3>(column));
      glVertexAttribDivisor(attribute, 1);
      glEnableVertexAttribArray(attribute);
    }
  }

  /// Cull the sides of surfaces that are not drawn.
  static void cull(bool oneSided, const CasterSelection& selection)
  {
    glFrontFace(selection.mirrored ? GL_CW : GL_CCW);
    glCullFace(oneSided ? GL_BACK : GL_FRONT);
    oneSided || selection.backOnly ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
  }

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
  void sendAll(const Occluders& occluders)
  {
    this->twoSided_.clear();
    this->oneSided_.clear();
    this->cutouts_.clear();
    std::size_t triangles = 0;
    std::size_t instances = 1;
    for (const Surface& surface : occluders.surfaces)
    {
      if (isDrawn(surface))
      {
        const std::size_t own = surface.centredFromSource.size();
        this->addPart(surface,
          { static_cast<GLsizei>(3 * triangles), static_cast<GLsizei>(3 * surface.triangleCount),
            surface.positionsVersion, verticesBounds(surface, occluders),
            static_cast<GLuint>(own > 0 ? instances : 0), static_cast<GLsizei>(own) });
        triangles += surface.triangleCount;
        instances += own;
      }
    }

    const std::size_t positionBytes = occluders.positionsCentred.size() * sizeof(glm::vec3);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(positionBytes),
      occluders.positionsCentred.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glEnableVertexAttribArray(0);

    const std::size_t triangleBytes = triangles * sizeof(glm::uvec3);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, this->indices_.create());
    glBufferData(
      GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangleBytes), nullptr, GL_STATIC_DRAW);
    std::size_t place = 0;
    for (auto first = occluders.surfaces.begin(); first != occluders.surfaces.end();)
    {
      // Upload neighbours at once.
      std::size_t count = 0;
      auto last = first;
      for (; last != occluders.surfaces.end() && last->casts; ++last)
      {
        count += last->triangleCount;
      }
      send(GL_ELEMENT_ARRAY_BUFFER, occluders.triangles, first->firstTriangle, count, place);
      place += count;
      first = last == occluders.surfaces.end() ? last : last + 1;
    }
    this->bytesOnGpu_ = positionBytes + triangleBytes;
    this->sendInstances(occluders);
    this->sendCutouts(occluders);
  }

  /// Upload the matrices of all drawn instances, and attach them to the bound vertex array.
  void sendInstances(const Occluders& occluders)
  {
    std::vector<glm::mat4x3> instances{ glm::mat4x3(1.0f) };
    for (const Surface& surface : occluders.surfaces)
    {
      if (isDrawn(surface))
      {
        instances.insert(
          instances.end(), surface.centredFromSource.begin(), surface.centredFromSource.end());
      }
    }
    const std::size_t bytes = instances.size() * sizeof(glm::mat4x3);
    glBindBuffer(GL_ARRAY_BUFFER, this->instances_.create());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), instances.data(), GL_STATIC_DRAW);
    readMatrices();
    this->bytesOnGpu_ += bytes;
  }

  void sendMoved(const Occluders& occluders)
  {
    auto twoSided = this->twoSided_.begin();
    auto oneSided = this->oneSided_.begin();
    auto cutout = this->cutouts_.begin();
    for (const Surface& surface : occluders.surfaces)
    {
      if (!isDrawn(surface))
      {
        continue;
      }
      Part& part = surface.cutout ? (cutout++)->part : surface.oneSided ? *oneSided++ : *twoSided++;
      if (part.positionsVersion != surface.positionsVersion)
      {
        part.positionsVersion = surface.positionsVersion;
        part.boundsCentred = verticesBounds(surface, occluders);
        if (surface.isInstanced()) // only its matrices changed
        {
          glBindBuffer(GL_ARRAY_BUFFER, this->instances_.name());
          send(GL_ARRAY_BUFFER, surface.centredFromSource, 0, surface.centredFromSource.size(),
            part.firstInstance);
          continue;
        }
        glBindBuffer(GL_ARRAY_BUFFER, this->positions_.name());
        send(GL_ARRAY_BUFFER, occluders.positionsCentred, surface.firstVertex, surface.vertexCount,
          surface.firstVertex);
      }
    }
  }

  /// Upload texture coordinates and masks of surfaces with a cut-out. Masks still in use are
  /// reused.
  void sendCutouts(const Occluders& occluders)
  {
    std::map<std::shared_ptr<const CutoutMask>, GlTexture> masks;
    glActiveTexture(GL_TEXTURE0);
    auto cutout = this->cutouts_.begin();
    for (const Surface& surface : occluders.surfaces)
    {
      if (!isDrawn(surface) || !surface.cutout)
      {
        continue;
      }
      CutoutPart& part = *cutout++;
      glBindVertexArray(part.vertexArray.create());
      glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, this->indices_.name());
      glBindBuffer(GL_ARRAY_BUFFER, this->positions_.name());
      glVertexAttribPointer(
        0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), offsetOf<glm::vec3>(surface.firstVertex));
      glEnableVertexAttribArray(0);
      glBindBuffer(GL_ARRAY_BUFFER, this->instances_.name());
      readMatrices();
      glBindBuffer(GL_ARRAY_BUFFER, part.textureCoordinates.create());
      const std::size_t bytes = surface.textureCoordinates.size() * sizeof(glm::vec2);
      glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes),
        surface.textureCoordinates.data(), GL_STATIC_DRAW);
      glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
      glEnableVertexAttribArray(1);
      this->bytesOnGpu_ += bytes;

      GlTexture& texture = masks[part.mask];
      if (!texture)
      {
        const auto sent = this->masks_.find(part.mask);
        texture = sent != this->masks_.end() ? std::move(sent->second) : makeTexture(*part.mask);
        this->bytesOnGpu_ += part.mask->texels.size();
      }
    }
    this->masks_ = std::move(masks);
  }

  void addPart(const Surface& surface, const Part& part)
  {
    if (surface.cutout)
    {
      this->cutouts_.push_back({ part, surface.oneSided, surface.cutout,
        -static_cast<GLint>(surface.firstVertex), {}, {} });
    }
    else
    {
      (surface.oneSided ? this->oneSided_ : this->twoSided_).push_back(part);
    }
  }

  void drawParts(const std::vector<Part>& parts, const CasterSelection& selection) const
  {
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    GLsizei end = -1; // of the current run of neighbours
    for (const Part& part : parts)
    {
      if (!selection.maySee(part.boundsCentred))
      {
        continue;
      }
      const void* first = offsetOf<GLuint>(static_cast<std::size_t>(part.first));
      if (part.instances > 0)
      {
        glDrawElementsInstancedBaseInstance(
          GL_TRIANGLES, part.count, GL_UNSIGNED_INT, first, part.instances, part.firstInstance);
        continue;
      }
      if (part.first == end)
      {
        counts.back() += part.count;
      }
      else
      {
        counts.push_back(part.count);
        offsets.push_back(first);
      }
      end = part.first + part.count;
    }
    if (!counts.empty())
    {
      glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
        static_cast<GLsizei>(counts.size()));
    }
  }

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
