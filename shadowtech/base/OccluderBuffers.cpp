#include "shadowtech/base/OccluderBuffers.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/Instances.h"

namespace gnomon
{
namespace
{

bool isDrawn(const Surface& surface)
{
  return surface.casts && surface.triangleCount > 0;
}

Bounds verticesBounds(const Surface& surface, const Occluders& occluders)
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

/// Sends some elements of an array to the same place in the bound buffer.
template <typename Element>
void send(GLenum target, const std::vector<Element>& elements, std::size_t first, std::size_t count,
  std::size_t place)
{
  glBufferSubData(target, static_cast<GLintptr>(place * sizeof(Element)),
    static_cast<GLsizeiptr>(count * sizeof(Element)), elements.data() + first);
}

} // namespace

//------------------------------------------------------------------------------
void OccluderBuffers::update(const Occluders& occluders)
{
  const bool sameTopology =
    this->vertexArray_ && this->topologyVersion_ == occluders.topologyVersion;
  if (sameTopology && this->positionsVersion_ == occluders.positionsVersion)
  {
    return;
  }
  const GlStateGuard guard; // an index buffer that others bind must not land in this vertex array
  glBindVertexArray(this->vertexArray_.create());
  glBindBuffer(GL_ARRAY_BUFFER, this->positions_.create());
  sameTopology ? this->sendMoved(occluders) : this->sendAll(occluders);
  this->topologyVersion_ = occluders.topologyVersion;
  this->positionsVersion_ = occluders.positionsVersion;
}

//------------------------------------------------------------------------------
void OccluderBuffers::sendAll(const Occluders& occluders)
{
  this->twoSided_.clear();
  this->oneSided_.clear();
  std::size_t triangles = 0;
  std::size_t instances = 1;
  for (const Surface& surface : occluders.surfaces)
  {
    if (isDrawn(surface))
    {
      const std::size_t own = surface.centredFromSource.size();
      this->partsOf(surface).push_back(
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
    // Neighbours go at once.
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
}

//------------------------------------------------------------------------------
void OccluderBuffers::sendInstances(const Occluders& occluders)
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
  for (GLuint column = 0; column < 4; ++column)
  {
    const GLuint attribute = 1 + column;
    const std::size_t offset = column * sizeof(glm::vec3);
    glVertexAttribPointer(
      attribute, 3, GL_FLOAT, GL_FALSE, sizeof(glm::mat4x3), reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(attribute, 1);
    glEnableVertexAttribArray(attribute);
  }
  this->bytesOnGpu_ += bytes;
}

//------------------------------------------------------------------------------
void OccluderBuffers::sendMoved(const Occluders& occluders)
{
  auto twoSided = this->twoSided_.begin();
  auto oneSided = this->oneSided_.begin();
  for (const Surface& surface : occluders.surfaces)
  {
    if (!isDrawn(surface))
    {
      continue;
    }
    Part& part = surface.oneSided ? *oneSided++ : *twoSided++;
    if (part.positionsVersion != surface.positionsVersion)
    {
      part.positionsVersion = surface.positionsVersion;
      part.boundsCentred = verticesBounds(surface, occluders);
      if (surface.isInstanced()) // whose vertices stay
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

//------------------------------------------------------------------------------
std::vector<OccluderBuffers::Part>& OccluderBuffers::partsOf(const Surface& surface)
{
  return surface.oneSided ? this->oneSided_ : this->twoSided_;
}

//------------------------------------------------------------------------------
std::size_t OccluderBuffers::bytes() const
{
  return this->bytesOnGpu_ + bytesOf(this->twoSided_) + bytesOf(this->oneSided_);
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
    const std::size_t offset = static_cast<std::size_t>(part.first) * sizeof(GLuint);
    const void* first = reinterpret_cast<const void*>(offset);
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
