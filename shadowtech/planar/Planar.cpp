#include "shadowtech/planar/Planar.h"

#include "lights/LightSamples.h"
#include "lights/PlanarProjection.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightReach.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <algorithm>

namespace gnomon
{
namespace
{

/// Number of samples rendered at a time: the bits of a texel.
constexpr std::size_t samplesPerBatch = 32;

/// Values of planes_of_pixels.frag.glsl: receivers on none of the chosen planes, and on the first
/// one.
constexpr unsigned int offPlanes = 1;
constexpr int firstPlane = 2;

/// Return a plane, oriented to the side that the camera sees.
glm::dvec4 turnedTo(const CameraView& camera, const glm::dvec4& plane)
{
  const glm::dvec4 eye = glm::inverse(camera.viewFromCentred) * camera.eyeView();
  return glm::dot(plane, eye) < 0.0 ? -plane : plane;
}

/// Return true if a light stands before a plane by more than rounding. Parallel rays have
/// facesLight()'s limit.
bool standsBefore(const glm::dvec4& plane, double thickness, const glm::dvec4& light)
{
  return glm::dot(plane, light) > (light.w > 0.0 ? thickness : 9.5367431640625e-7); // 2^-20
}

/// Return the point of the light that replaces a sample on a plane. A sample behind the plane is
/// replaced by the opposite point (sideOfSample()). That one stands before all planes that the
/// light's centre stands before.
glm::dvec4 sampleBefore(
  const glm::dvec4& plane, double thickness, const glm::dvec4& sample, const glm::dvec4& centre)
{
  if (standsBefore(plane, thickness, sample))
  {
    return sample;
  }
  if (centre.w > 0.0)
  {
    return 2.0 * centre - sample;
  }
  // Samples of a directional light lie on the plane at distance 1.
  return glm::normalize(2.0 * centre - sample / glm::dot(centre, sample));
}

/// Return the largest signed distance of a box from a plane.
double highestAbove(const glm::dvec4& plane, const Bounds& bounds)
{
  const glm::dvec3 farthest =
    glm::mix(bounds.lower, bounds.upper, glm::greaterThan(glm::dvec3(plane), glm::dvec3(0.0)));
  return glm::dot(plane, glm::dvec4(farthest, 1.0));
}

/// Set up OpenGL to render shadows into an image of bits.
void beginShadows(GLuint framebuffer, int width, int height)
{
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_MULTISAMPLE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisablei(GL_BLEND, 0);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_OR);
  // Receivers are inside the camera's depth range, so their shadows must not be clipped.
  glEnable(GL_DEPTH_CLAMP);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  const GLuint nothing[4] = { 0, 0, 0, 0 };
  glClearBufferuiv(GL_COLOR, 0, nothing);
}

/// Return the planes that clip casters to the part that can cast onto a plane. It lies above the
/// plane, and behind the near face of a box's light. Casters beyond the light need no plane. Their
/// images have w < 0 (planarProjection()), and keep that sign where the camera would see them, so
/// OpenGL clips them.
std::vector<glm::dvec4> castingPart(const ShadowLight& light, const glm::dvec3& centreWorld,
  const glm::dvec4& plane, double thickness)
{
  std::vector<glm::dvec4> kept = { plane - glm::dvec4(0.0, 0.0, 0.0, thickness) };
  if (light.box)
  {
    kept.push_back(nearFaceCentred(light, centreWorld));
  }
  return kept;
}

} // namespace

//------------------------------------------------------------------------------
/// The samples rendered at a time.
struct Planar::Batch
{
  std::size_t first = 0; ///< index into all samples
  std::size_t count = 0;
  bool last = false;
  std::vector<glm::dvec4> planes; ///< the chosen planes, oriented to the camera
  std::vector<bool> facing;       ///< for each plane, true if it faces the light's centre
};

//------------------------------------------------------------------------------
TechniqueInfo Planar::info()
{
  TechniqueInfo info;
  info.name = "planar";
  info.settings = { &planarSettings(), &lightSampleSettings(), &lightSeedSettings() };
  info.refused = { refusedSamples };
  return info;
}

//------------------------------------------------------------------------------
void Planar::drawVisibility(const LayerInput& input, LightCounts& counts)
{
  const GlStateGuard guard;
  this->planes_.update(input.occluders, static_cast<std::size_t>(input.light.planar.planes));
  this->centre_ = lightPoint(input.light, input.occluders.frame.centre);
  this->samples_ = lightSamples(input.light, input.occluders.frame.centre);
  counts.lightSamples = static_cast<int>(this->samples_.size());
  this->allocate(input.receivers.width(), input.receivers.height());
  this->samples_.size() > samplesPerBatch
    ? this->lit_.begin(this->width_, this->height_, "the samples' shadows")
    : this->lit_.clear();
  this->sendPlanes(input);
  this->findPlanesOfPixels(input);
  for (std::size_t first = 0; first < this->samples_.size(); first += samplesPerBatch)
  {
    const Batch batch = this->makeBatch(input, first);
    this->drawShadows(input, batch);
    this->sumUp(input, batch);
  }
  counts.planes = static_cast<int>(this->planes_.planes().size());
  counts.pixelsOffPlanes = input.counting ? this->countPixelsOffPlanes() : 0;
  this->noteWhatIsLeftOut(input);
}

//------------------------------------------------------------------------------
void Planar::allocate(int width, int height)
{
  if (this->width_ == width && this->height_ == height)
  {
    return;
  }
  this->width_ = 0; // stays 0 if memory runs out
  glActiveTexture(GL_TEXTURE0);
  const TexelFormat integers{ GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT };
  allocateTexture(this->planesOfPixels_, integers, width, height, 0, "the pixels' planes");
  allocateTexture(this->shadows_, integers, width, height, 0, "the planes' shadows");
  glBindFramebuffer(GL_FRAMEBUFFER, this->shadowFramebuffer_.create());
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->shadows_.name(), 0);
  this->width_ = width;
  this->height_ = height;
}

//------------------------------------------------------------------------------
/// Update the tables that map VTK's primitives to planes.
void Planar::sendPlanes(const LayerInput& input)
{
  if (this->sentVersion_ != this->planes_.version())
  {
    this->planesOfPrimitives_.set(this->planes_.planeOfDrawn(), "a table of planes");
    this->sentVersion_ = this->planes_.version();
  }
  std::vector<glm::uvec4> blocks;
  for (std::size_t drawn = 0; drawn < input.drawnSurfaces.size(); ++drawn)
  {
    for (const DrawnSurface::Block& block : input.drawnSurfaces[drawn].blocks)
    {
      if (!input.occluders.surfaces[block.surface].isInstanced()) // instances have no planes
      {
        blocks.emplace_back(drawn, block.firstPrimitive, this->planes_.drawnBegin(block.surface),
          block.primitiveCount);
      }
    }
  }
  this->blockCount_ = static_cast<int>(blocks.size());
  this->blocks_.set(std::move(blocks), "a table of surfaces");
}

//------------------------------------------------------------------------------
void Planar::findPlanesOfPixels(const LayerInput& input)
{
  const GLuint program = ScreenPass::use(
    input.shaders, ShaderLibrary::source("shadowtech/planar/planes_of_pixels.frag.glsl"));
  ShaderLibrary::setUniforms(program,
    { { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } },
      { "blocks", TextureBinding{ GL_TEXTURE_2D, this->blocks_.texture() } },
      { "blockCount", this->blockCount_ },
      { "planesOfPrimitives",
        TextureBinding{ GL_TEXTURE_2D, this->planesOfPrimitives_.texture() } } },
    0, 0);
  this->screenPass_.fill({ { this->planesOfPixels_.name() } }, this->width_, this->height_);
}

//------------------------------------------------------------------------------
Planar::Batch Planar::makeBatch(const LayerInput& input, std::size_t first) const
{
  Batch batch;
  batch.first = first;
  batch.count = std::min(this->samples_.size() - first, samplesPerBatch);
  batch.last = first + batch.count == this->samples_.size();
  for (const ReceiverPlane& plane : this->planes_.planes())
  {
    batch.planes.push_back(turnedTo(input.camera, plane.plane));
    batch.facing.push_back(standsBefore(batch.planes.back(), plane.thickness, this->centre_));
  }
  return batch;
}

//------------------------------------------------------------------------------
void Planar::drawShadows(const LayerInput& input, const Batch& batch)
{
  const std::string fragmentGlsl =
    ShaderLibrary::source("shadowtech/planar/planar_shadow.frag.glsl");
  const glm::dmat4 clipFromCentred = input.camera.clipFromCentred();
  beginShadows(this->shadowFramebuffer_.name(), this->width_, this->height_);
  for (std::size_t i = 0; i < this->planes_.planes().size(); ++i)
  {
    const ReceiverPlane& receiver = this->planes_.planes()[i];
    if (!batch.facing[i] || !mayShow(clipFromCentred, receiver.boundsCentred))
    {
      continue;
    }
    for (std::size_t bit = 0; bit < batch.count; ++bit)
    {
      const glm::dvec4& plane = batch.planes[i];
      const glm::dvec4 sample =
        sampleBefore(plane, receiver.thickness, this->samples_[batch.first + bit], this->centre_);
      CasterPicture picture;
      picture.clipFromCentred = clipFromCentred * planarProjection(plane, sample);
      picture.keptFromCentred =
        castingPart(input.light, input.occluders.frame.centre, plane, receiver.thickness);
      // The camera looks at the same side of the plane as the light.
      picture.selection.mirrored = false;
      picture.selection.maySee = [&](const Bounds& bounds)
      { return highestAbove(plane, bounds) > receiver.thickness; };
      drawCasters(picture, input.buffers, input.shaders,
        { fragmentGlsl, {},
          { { "planesOfPixels", TextureBinding{ GL_TEXTURE_2D, this->planesOfPixels_.name() } },
            { "plane", static_cast<int>(i) + firstPlane },
            { "sampleBit", static_cast<int>(bit) } } });
    }
  }
}

//------------------------------------------------------------------------------
/// Add a batch to the sum. After the last one, fill the light's layer.
void Planar::sumUp(const LayerInput& input, const Batch& batch)
{
  const glm::dmat4& viewFromCentred = input.camera.viewFromCentred;
  std::vector<std::string> defines = lightReachDefines(input.light);
  defines.push_back("PLANES " + std::to_string(mostPlanes));
  const GLuint program = ScreenPass::use(
    input.shaders, ShaderLibrary::source("shadowtech/planar/planar_visibility.frag.glsl"), defines);
  std::vector<Uniform> uniforms = {
    { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } },
    { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, input.receivers.points() } },
    { "planesOfPixels", TextureBinding{ GL_TEXTURE_2D, this->planesOfPixels_.name() } },
    { "shadows", TextureBinding{ GL_TEXTURE_2D, this->shadows_.name() } },
    { "sampleCount", static_cast<int>(batch.count) },
    { "lightView", glm::vec4(viewFromCentred * this->centre_) },
    { "sampleCountOfAll", batch.last ? static_cast<int>(this->samples_.size()) : 0 }
  };
  for (const std::vector<Uniform>& more : { this->lit_.before(),
         lightReachUniforms(input.light, input.occluders.frame.centre, viewFromCentred) })
  {
    uniforms.insert(uniforms.end(), more.begin(), more.end());
  }
  for (std::size_t i = 0; i < batch.facing.size(); ++i)
  {
    uniforms.push_back({ "planesFacingLight[" + std::to_string(i) + "]", batch.facing[i] ? 1 : 0 });
  }
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  if (batch.last)
  {
    input.layers.fill(input.layer);
  }
  else
  {
    this->lit_.fill();
  }
}

//------------------------------------------------------------------------------
void Planar::noteWhatIsLeftOut(const LayerInput& input) const
{
  double served = 0.0;
  for (const ReceiverPlane& plane : this->planes_.planes())
  {
    served += plane.area;
  }
  // Round down, so that 100 % means all.
  const int percent = static_cast<int>(100.0 * served / std::max(this->planes_.area(), served));
  if (served < this->planes_.area() * (1.0 - 1e-9))
  {
    input.notes.push_back(nameOf(input.light) + ": planar shadows fall on " +
      std::to_string(this->planes_.planes().size()) + " planes with " + std::to_string(percent) +
      " % of the receiving area; the rest shows no cast shadows of this light");
  }
}

//------------------------------------------------------------------------------
std::int64_t Planar::countPixelsOffPlanes() const
{
  std::vector<GLuint> planes(
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_));
  readTexture(this->planesOfPixels_.name(), GL_RED_INTEGER, GL_UNSIGNED_INT, planes.data());
  return std::count(planes.begin(), planes.end(), offPlanes);
}

//------------------------------------------------------------------------------
std::size_t Planar::bytesOfMaps() const
{
  const auto pixels =
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  return 2 * pixels * sizeof(float) + this->lit_.bytes() + this->planesOfPrimitives_.bytes() +
    this->blocks_.bytes();
}

} // namespace gnomon
