#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/Refinement.h"
#include "shadowtech/tracing/TraceAll.h"

namespace gnomon
{

/// `penumbra`: shadows of an area light, bit for bit those of `raytraced`, by few of its rays. If
/// no caster's edge lies between a receiver and the light, one ray decides. In penumbrae, edges
/// tell which samples of the light share a visibility. Lights without area get one ray per pixel.
class Penumbra : public CpuScreenTechnique
{
public:
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "penumbra";
    info.exact = true;
    info.settings = { &lightSampleSettings(), &lightSeedSettings(), &refinementSettings() };
    info.refused = { refusedSamples, refusedMovingSamples };
    info.seesTextures = true;
    info.classes = classesOfPenumbra();
    return info;
  }

  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override
  {
    // Counting ignores colours of samples, and the tree only holds edges of triangles. Few rays
    // take less time than finding edges.
    constexpr int fewSamples = 8;
    if (!input.light.area || input.light.texture || input.occluders.castsSolids() ||
      input.light.lightSamples <= fewSamples)
    {
      traceAllReceivers(input, visibility, counts);
      return;
    }
    this->tree_.update(input.occluders);
    const PenumbraChooser chooser(this->tree_, input.light, input.occluders.frame.centre);
    counts.lightSamples = input.light.lightSamples;
    counts.rays = static_cast<std::int64_t>(input.tracer.traceArea(input.light, input.occluders,
      input.receivers, visibility, nullptr, input.classes, &chooser, input.tiles, input.verdicts));
    counts.tracedPixels = chooser.tracedPixels();
    if (input.classes)
    {
      for (std::size_t i = 0; i < visibility.size(); ++i)
      {
        std::uint8_t& of = (*input.classes)[i];
        const bool blocked =
          of == static_cast<std::uint8_t>(TracedClass::Lit) && visibility[i] == 0.0f;
        of = blocked ? static_cast<std::uint8_t>(TracedClass::Shadow) : of;
      }
    }
  }

  std::size_t bytesOfMaps() const override { return this->tree_.bytes(); }

private:
  EdgeTree tree_;
};

} // namespace gnomon
