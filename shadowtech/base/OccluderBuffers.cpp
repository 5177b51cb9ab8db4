#include "shadowtech/base/OccluderBuffers.h"

#include "shadowtech/base/GlState.h"

#include <vector>

namespace gnomon
{

//------------------------------------------------------------------------------
void OccluderBuffers::update(const Occluders& occluders)
{
  if (this->vertexArray_ && this->topologyVersion_ == occluders.topologyVersion &&
    this->positionsVersion_ == occluders.positionsVersion)
  {
    return;
  }
  const GlStateGuard guard; // an index buffer that others bind must not land in this vertex array
  glBindVertexArray(this->vertexArray_.create());
  glBindBuffer(GL_ARRAY_BUFFER, this->positions_.create());
  const std::size_t positionBytes = occluders.positionsCentred.size() * sizeof(glm::vec3);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(positionBytes),
    occluders.positionsCentred.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glEnableVertexAttribArray(0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, this->indices_.create());

  if (this->topologyVersion_ != occluders.topologyVersion)
  {
    std::vector<glm::uvec3> triangles;
    triangles.reserve(occluders.triangles.size());
    const auto append = [&](bool oneSided)
    {
      for (const Surface& surface : occluders.surfaces)
      {
        if (surface.casts && surface.oneSided == oneSided)
        {
          const auto first = occluders.triangles.begin() + surface.firstTriangle;
          triangles.insert(triangles.end(), first, first + surface.triangleCount);
        }
      }
    };
    append(false);
    this->twoSidedCount_ = static_cast<GLsizei>(3 * triangles.size());
    append(true);
    this->oneSidedCount_ = static_cast<GLsizei>(3 * triangles.size()) - this->twoSidedCount_;
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
      static_cast<GLsizeiptr>(triangles.size() * sizeof(glm::uvec3)), triangles.data(),
      GL_STATIC_DRAW);
    this->bytes_ = positionBytes + triangles.size() * sizeof(glm::uvec3);
  }
  this->topologyVersion_ = occluders.topologyVersion;
  this->positionsVersion_ = occluders.positionsVersion;
}

//------------------------------------------------------------------------------
void OccluderBuffers::draw() const
{
  glBindVertexArray(this->vertexArray_.name());
  glDisable(GL_CULL_FACE);
  glDrawElements(GL_TRIANGLES, this->twoSidedCount_, GL_UNSIGNED_INT, nullptr);
  if (this->oneSidedCount_ > 0)
  {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    // A light looks along +z of its right-handed space, so that its picture is mirrored.
    glFrontFace(GL_CW);
    const std::size_t offset = static_cast<std::size_t>(this->twoSidedCount_) * sizeof(GLuint);
    glDrawElements(
      GL_TRIANGLES, this->oneSidedCount_, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset));
    glDisable(GL_CULL_FACE);
  }
}

} // namespace gnomon
