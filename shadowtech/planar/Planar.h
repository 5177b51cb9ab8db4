#pragma once

#include "lights/LightSamples.h"
#include "lights/PlanarProjection.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/planar/ReceiverPlanes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon
{

/// `planar`: casters are projected from the light onto receiving planes (Blinn 1988), and rendered
/// there as the camera sees them (docs/techniques/planar.md). Receivers on no such plane show no
/// cast shadow.
class Planar : public GpuScreenTechnique
{
public:
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "planar";
    info.settings = { &planarSettings(), &lightSampleSettings(), &lightSeedSettings() };
    info.refused = { refusedSamples };
    return info;
  }

  void drawVisibility(const LayerInput& input, LightCounts& counts) override
  {
    const GlStateGuard guard;
    this->planes_.update(input.occluders, static_cast<std::size_t>(input.light.planar.planes));
    Sight sight{ lightPoint(input.light, input.occluders.frame.centre),
      lightSamples(input.light, input.occluders.frame.centre), {}, {} };
    for (const ReceiverPlane& plane : this->planes_.planes())
    {
      sight.planes.push_back(turnedTo(input.camera, plane.plane));
      sight.facing.push_back(standsBefore(sight.planes.back(), plane.thickness, sight.centre));
    }
    const std::size_t samples = sight.samples.size();
    counts.lightSamples = static_cast<int>(samples);
    this->allocate(input.receivers.width(), input.receivers.height());
    samples > samplesPerBatch
      ? this->lit_.begin(this->shadows_.width(), this->shadows_.height(), "the samples' shadows")
      : this->lit_.clear();
    const std::int64_t pixelsOffPlanes = this->findPlanesOfPixels(input);
    for (std::size_t first = 0; first < samples; first += samplesPerBatch)
    {
      const std::size_t count = std::min(samples - first, samplesPerBatch);
      const Batch batch{ first, count, first + count == samples };
      this->drawShadows(input, sight, batch);
      this->sumUp(input, sight, batch);
    }
    counts.planes = static_cast<int>(sight.planes.size());
    counts.pixelsOffPlanes = input.counting ? pixelsOffPlanes : 0;
    this->noteWhatIsLeftOut(input);
  }

  std::size_t bytesOfMaps() const override
  {
    return this->planesOfPixels_.bytes() + this->shadows_.bytes() + this->lit_.bytes();
  }

private:
  /// Number of samples rendered at a time: the bits of a texel.
  static constexpr std::size_t samplesPerBatch = 32;

  /// The plane of a pixel: nothing receives there, a receiver is on none of the chosen planes, or
  /// on the first one.
  static constexpr GLuint noReceiver = 0;

  static constexpr GLuint offPlanes = 1;

  static constexpr GLuint firstPlane = 2;

  /// Return a plane, oriented to the side that the camera sees.
  static glm::dvec4 turnedTo(const CameraView& camera, const glm::dvec4& plane)
  {
    const glm::dvec4 eye = glm::inverse(camera.viewFromCentred) * camera.eyeView();
    return glm::dot(plane, eye) < 0.0 ? -plane : plane;
  }

  /// Return true if a light stands before a plane by more than rounding. Parallel rays have
  /// facesLight()'s limit.
  static bool standsBefore(const glm::dvec4& plane, double thickness, const glm::dvec4& light)
  {
    return glm::dot(plane, light) > (light.w > 0.0 ? thickness : 9.5367431640625e-7); // 2^-20
  }

  /// Return the point of the light that replaces a sample on a plane. A sample behind the plane is
  /// replaced by the opposite point (sideOfSample()). That one stands before all planes that the
  /// light's centre stands before.
  static glm::dvec4 sampleBefore(
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
  static double highestAbove(const glm::dvec4& plane, const Bounds& bounds)
  {
    const glm::dvec3 farthest =
      glm::mix(bounds.lower, bounds.upper, glm::greaterThan(glm::dvec3(plane), glm::dvec3(0.0)));
    return glm::dot(plane, glm::dvec4(farthest, 1.0));
  }

  /// Set up OpenGL to render shadows into an image of bits.
  static void beginShadows(GLuint framebuffer, int width, int height)
  {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    ScreenPass::openState(1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_MULTISAMPLE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
    // Receivers are inside the camera's depth range, so their shadows must not be clipped.
    glEnable(GL_DEPTH_CLAMP);
    const GLuint nothing[4] = { 0, 0, 0, 0 };
    glClearBufferuiv(GL_COLOR, 0, nothing);
  }

  /// Return the planes that clip casters to the part that can cast onto a plane. It lies above the
  /// plane, and behind the near face of a box's light. Casters beyond the light need no plane.
  /// Their images have w < 0 (planarProjection()), and keep that sign where the camera would see
  /// them, so OpenGL clips them.
  static std::vector<glm::dvec4> castingPart(const ShadowLight& light,
    const glm::dvec3& centreWorld, const glm::dvec4& plane, double thickness)
  {
    std::vector<glm::dvec4> kept = { plane - glm::dvec4(0.0, 0.0, 0.0, thickness) };
    if (light.box)
    {
      kept.push_back(nearFaceCentred(light, centreWorld));
    }
    return kept;
  }

  struct Sight
  {
    glm::dvec4 centre;               ///< lightPoint()
    std::vector<glm::dvec4> samples; ///< lightSamples()
    std::vector<glm::dvec4> planes;  ///< the chosen planes, oriented to the camera
    std::vector<bool> facing;        ///< for each plane, true if it faces the light's centre
  };

  /// The samples rendered at a time.
  struct Batch
  {
    std::size_t first; ///< index into all samples
    std::size_t count;
    bool last;
  };

  void allocate(int width, int height)
  {
    glActiveTexture(GL_TEXTURE0);
    const TexelFormat integers{ GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT };
    this->planesOfPixels_.allocate(integers, width, height, 0, "the pixels' planes");
    this->shadows_.allocate(integers, width, height, 0, "the planes' shadows");
    glBindFramebuffer(GL_FRAMEBUFFER, this->shadowFramebuffer_.create());
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->shadows_.name(), 0);
  }

  /// Find the plane of each pixel's receiver, from the triangle that VTK drew there.
  /// @return the number of receivers on none of the chosen planes
  std::int64_t findPlanesOfPixels(const LayerInput& input)
  {
    ReceiverImages images;
    input.receivers.read(images);
    std::vector<GLuint> planes(images.fragments.size());
    constexpr std::size_t pixelsOfTask = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes.size(), pixelsOfTask),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          const glm::vec2 fragment = images.fragments[i];
          if (i > range.begin() && fragment == images.fragments[i - 1])
          {
            planes[i] = planes[i - 1];
            continue;
          }
          const std::uint32_t triangle =
            findTriangle(fragment.x, fragment.y, input.drawnSurfaces, input.occluders).triangle;
          planes[i] = !(fragment.x > 0.0f) ? noReceiver
            : triangle == notFound         ? offPlanes
                                           : offPlanes + this->planes_.planeOfTriangle()[triangle];
        }
      });
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, this->planesOfPixels_.name());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, this->shadows_.width(), this->shadows_.height(),
      GL_RED_INTEGER, GL_UNSIGNED_INT, planes.data());
    return std::count(planes.begin(), planes.end(), offPlanes);
  }

  void drawShadows(const LayerInput& input, const Sight& sight, const Batch& batch)
  {
    const std::string fragmentGlsl =
      ShaderLibrary::source("shadowtech/planar/planar_shadow.frag.glsl");
    const glm::dmat4 clipFromCentred = input.camera.clipFromCentred();
    beginShadows(this->shadowFramebuffer_.name(), this->shadows_.width(), this->shadows_.height());
    for (std::size_t i = 0; i < this->planes_.planes().size(); ++i)
    {
      const ReceiverPlane& receiver = this->planes_.planes()[i];
      if (!sight.facing[i] || !mayShow(clipFromCentred, receiver.boundsCentred))
      {
        continue;
      }
      for (std::size_t bit = 0; bit < batch.count; ++bit)
      {
        const glm::dvec4& plane = sight.planes[i];
        const glm::dvec4 sample =
          sampleBefore(plane, receiver.thickness, sight.samples[batch.first + bit], sight.centre);
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
              { "plane", static_cast<int>(i + firstPlane) },
              { "sampleBit", static_cast<int>(bit) } } });
      }
    }
  }

  /// Add a batch to the sum. After the last one, fill the light's layer.
  void sumUp(const LayerInput& input, const Sight& sight, const Batch& batch)
  {
    const glm::dmat4& viewFromCentred = input.camera.viewFromCentred;
    std::vector<std::string> defines = lightReachDefines(input.light);
    defines.push_back("PLANES " + std::to_string(mostPlanes));
    const GLuint program = ScreenPass::use(input.shaders,
      ShaderLibrary::source("shadowtech/planar/planar_visibility.frag.glsl"), defines);
    std::vector<Uniform> uniforms = {
      { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } },
      { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, input.receivers.points() } },
      { "planesOfPixels", TextureBinding{ GL_TEXTURE_2D, this->planesOfPixels_.name() } },
      { "shadows", TextureBinding{ GL_TEXTURE_2D, this->shadows_.name() } },
      { "sampleCount", static_cast<int>(batch.count) },
      { "lightView", glm::vec4(viewFromCentred * sight.centre) },
      { "sampleCountOfAll", batch.last ? static_cast<int>(sight.samples.size()) : 0 }
    };
    for (const std::vector<Uniform>& more : { this->lit_.before(),
           lightReachUniforms(input.light, input.occluders.frame.centre, viewFromCentred) })
    {
      uniforms.insert(uniforms.end(), more.begin(), more.end());
    }
    for (std::size_t i = 0; i < sight.facing.size(); ++i)
    {
      uniforms.push_back({ glslElement("planesFacingLight", i), sight.facing[i] ? 1 : 0 });
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

  void noteWhatIsLeftOut(const LayerInput& input) const
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

  ReceiverPlanes planes_;
  SizedTexture planesOfPixels_;
  SizedTexture shadows_;
  RunningSum lit_; ///< number of samples that are seen, summed over batches
  GlFramebuffer shadowFramebuffer_;
};

} // namespace gnomon
