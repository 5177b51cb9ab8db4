#include "shadowtech/base/OccluderBuffers.h"

#include "shadowtech/base/GlState.h"

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
    for (const Surface& surface : occluders.surfaces)
    {
      if (surface.casts && surface.triangleCount > 0)
      {
        const auto first = occluders.triangles.begin() + surface.firstTriangle;
        triangles.insert(triangles.end(), first, first + surface.triangleCount);
      }
    }
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
      static_cast<GLsizeiptr>(triangles.size() * sizeof(glm::uvec3)), triangles.data(),
      GL_STATIC_DRAW);
    this->bytes_ = positionBytes + triangles.size() * sizeof(glm::uvec3);
  }
  this->twoSided_.clear();
  this->oneSided_.clear();
  GLsizei first = 0;
  for (const Surface& surface : occluders.surfaces)
  {
    if (surface.casts && surface.triangleCount > 0)
    {
      Part part{ first, static_cast<GLsizei>(3 * surface.triangleCount), {} };
      const glm::vec3* positions = occluders.positionsCentred.data() + surface.firstVertex;
      for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
      {
        part.boundsCentred.add(glm::dvec3(positions[i]));
      }
      first += part.count;
      (surface.oneSided ? this->oneSided_ : this->twoSided_).push_back(part);
    }
  }
  this->topologyVersion_ = occluders.topologyVersion;
  this->positionsVersion_ = occluders.positionsVersion;
}

//------------------------------------------------------------------------------
void OccluderBuffers::drawParts(const std::vector<Part>& parts, const LightView& view) const
{
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  GLsizei end = -1; // of the run of neighbours that is being extended
  for (const Part& part : parts)
  {
    if (view.perspective && !view.maySee(part.boundsCentred))
    {
      continue;
    }
    if (part.first == end)
    {
      counts.back() += part.count;
    }
    else
    {
      counts.push_back(part.count);
      const std::size_t offset = static_cast<std::size_t>(part.first) * sizeof(GLuint);
      offsets.push_back(reinterpret_cast<const void*>(offset));
    }
    end = part.first + part.count;
  }
  if (!counts.empty())
  {
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
      static_cast<GLsizei>(counts.size()));
  }
}

//------------------------------------------------------------------------------
void OccluderBuffers::draw(const LightView& view) const
{
  glBindVertexArray(this->vertexArray_.name());
  glDisable(GL_CULL_FACE);
  this->drawParts(this->twoSided_, view);
  if (!this->oneSided_.empty())
  {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    // A light looks along +z of its right-handed space, so that its picture is mirrored.
    glFrontFace(GL_CW);
    this->drawParts(this->oneSided_, view);
    glDisable(GL_CULL_FACE);
  }
}

} // namespace gnomon
