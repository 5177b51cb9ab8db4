#include "plugin/frame/VisibilityStage.h"

#include "plugin/frame/KeptVisibility.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/tracing/Refinement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace gnomon
{
namespace
{

/// True if no other part changed than the props and the snapshot.
bool leavesTiles(const std::set<std::string>& changedParts)
{
  return std::all_of(changedParts.begin(), changedParts.end(),
    [](const std::string& name) { return name == propsPart || name == snapshotPart; });
}

/// Return the number of pixels of each class.
std::vector<ClassCount> countClasses(
  const std::vector<PixelClass>& classes, const std::vector<std::uint8_t>& ofPixels)
{
  std::vector<ClassCount> counts;
  for (const PixelClass& pixelClass : classes)
  {
    counts.push_back({ pixelClass.name, 0 });
  }
  constexpr std::size_t run = 64; // pixels, which mostly are all of one class
  for (std::size_t first = 0; first < ofPixels.size(); first += run)
  {
    const std::uint8_t* const pixels = &ofPixels[first];
    const std::size_t count = std::min(run, ofPixels.size() - first);
    if (std::memcmp(pixels, pixels + 1, count - 1) == 0)
    {
      counts[*pixels].pixels += static_cast<std::int64_t>(count);
      continue;
    }
    std::for_each(pixels, pixels + count, [&](std::uint8_t of) { ++counts[of].pixels; });
  }
  return counts;
}

} // namespace

VisibilityStage::VisibilityStage(Frame& frame, const Occluders& occluders, OccluderBuffers& buffers,
  SnapshotTracer& tracer, ShaderLibrary& shaders)
  : frame_(frame)
  , occluders_(occluders)
  , buffers_(buffers)
  , tracer_(tracer)
  , shaders_(shaders)
{
}

/// The key of a light's visibility; its maps follow from the same parts.
ValueKey VisibilityStage::keyOf(const CastingLight& casting) const
{
  const TechniqueInfo& info = casting.info();
  ValueKey key = *this->frame_.view->receivers.key;
  key.add("the light", casting.plan.identity);
  key.add("its technique", std::pair(&casting.own->estimator(), casting.light().fittedToReceivers));
  key.add("its settings", settingsOf(info, SettingsOf::Estimator, casting.light()));
  key.add("its volumes", std::pair(casting.plan.marches, this->frame_.wishes.volumeResolution));
  key.add("its layer", std::pair(casting.plan.layer, casting.plan.bit));
  return key;
}

/// True if this frame stores pixel classes.
bool VisibilityStage::classifies() const
{
  return this->frame_.wishes.keepVisibility || this->frame_.wishes.measureStages;
}

/// Return what a value lacks that is made from the same parts, as a clause; empty if nothing.
std::string VisibilityStage::whyUnfinished(
  const CastingLight& casting, const VisibilityValue& value) const
{
  if (casting.light().area && value.counts.progress < 1.0)
  {
    return "more of the light's points";
  }
  if (value.edgeSamples < casting.plan.edgeSamples)
  {
    return "edges of its shadows are to be smooth";
  }
  return this->classifies() && !value.classified ? "how pixels were decided is asked for" : "";
}

void VisibilityStage::findStale()
{
  std::vector<VisibilityValue>& values = this->frame_.view->visibility;
  values.resize(this->frame_.lights.size());
  auto value = values.begin();
  std::vector<std::string> changesOf;
  for (CastingLight& casting : this->frame_.lights)
  {
    const ValueKey key = this->keyOf(casting);
    std::string changes = value->key ? key.changesFrom(*value->key) : "there was none";
    casting.mayKeepTiles =
      value->key && !changes.empty() && leavesTiles(key.changedParts(*value->key));
    value->samples = changes.empty() ? value->samples : 0;
    casting.smooths =
      casting.plan.edgeSamples > 1 && (changes.empty() || !casting.plan.edgesFollow);
    changes = changes.empty() ? this->whyUnfinished(casting, *value) : changes;
    casting.isStale = !changes.empty();
    changesOf.push_back(changes);
    ++value;
  }
  this->agreeOnStale();
  value = values.begin();
  auto changes = changesOf.begin();
  for (CastingLight& casting : this->frame_.lights)
  {
    const bool isOthers = casting.isStale && changes->empty();
    this->frame_.noteReuse("visibility of " + nameOf(casting.light()),
      isOthers ? "another process's part of the scene" : *changes);
    ++changes;
    if (!casting.isStale)
    {
      casting.counts = value->counts;
      casting.tracedShare = value->tracedShare;
    }
    else
    {
      value->key.reset(); // in case of an error
    }
    ++value;
  }
}

/// Have all processes compute the visibility of lights that is stale in one of them.
void VisibilityStage::agreeOnStale()
{
  constexpr std::size_t bitsOfWord = 64;
  std::vector<std::uint64_t> stale((this->frame_.lights.size() + bitsOfWord - 1) / bitsOfWord, 0);
  std::size_t number = 0;
  for (const CastingLight& casting : this->frame_.lights)
  {
    stale[number / bitsOfWord] |= std::uint64_t(casting.isStale) << number % bitsOfWord;
    ++number;
  }
  this->frame_.ranks->uniteBits(stale);
  number = 0;
  for (CastingLight& casting : this->frame_.lights)
  {
    casting.isStale = (stale[number / bitsOfWord] >> number % bitsOfWord & 1u) != 0;
    ++number;
  }
}

/// Classify tiles without rays, where the technique can skip them.
void VisibilityStage::judge()
{
  const std::optional<ReceiverBoxes>& boxes = this->frame_.view->receivers.boxes;
  if (!boxes)
  {
    return;
  }
  tbb::parallel_for(std::size_t(0), this->verdicts_.size(),
    [&](std::size_t i)
    {
      const CastingLight& casting = this->frame_.lights.begin()[static_cast<std::ptrdiff_t>(i)];
      if (casting.isStale && casting.isOnCpu() && casting.info().exact &&
        !casting.light().texture && casting.edgeSamples() == 1)
      {
        this->verdicts_[i].emplace(casting.light(), this->occluders_, *boxes, this->tracer_.get());
      }
    });
  this->frame_.endStage("visibility: judge tiles");
}

void VisibilityStage::compute()
{
  FrameCounts& counts = this->frame_.counts;
  ViewValues& view = *this->frame_.view;
  this->verdicts_.clear();
  this->verdicts_.resize(this->frame_.lights.size());
  if (std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(),
        [](const CastingLight& casting) { return casting.isStale && casting.isOnCpu(); }))
  {
    this->tracer_.update();
    this->frame_.onCpu->prepare();
    this->judge();
  }
  this->darkBits_.clear();
  auto value = view.visibility.begin();
  auto verdicts = this->verdicts_.begin();
  for (CastingLight& casting : this->frame_.lights)
  {
    if (casting.isStale)
    {
      value->classified = this->classifies();
      const double start = steadyMilliseconds();
      this->fill(casting, verdicts->has_value() ? &**verdicts : nullptr, *value);
      casting.milliseconds = steadyMilliseconds() - start;
      const std::vector<PixelClass>& named = casting.info().classes;
      if (value->classified && !named.empty())
      {
        casting.counts.classes = countClasses(named, value->classes);
      }
      value->key = this->keyOf(casting);
      value->edgeSamples = casting.smooths ? casting.plan.edgeSamples : 1;
      if (!casting.smooths && casting.plan.edgeSamples > 1)
      {
        casting.counts.progress = 1.0 / casting.plan.edgeSamples;
      }
      value->counts = casting.counts;
      ++counts.visibilityComputed;
      counts.raysTraced += casting.counts.rays;
    }
    counts.notes.insert(counts.notes.end(), value->notes.begin(), value->notes.end());
    ++value;
    ++verdicts;
  }
  if (!this->darkBits_.empty())
  {
    view.layers.darkenBits(this->darkBits_, view.receivers.boxes->receives());
  }
  this->updateEdges();
  if (view.layers.uploadBits())
  {
    this->frame_.endStage("visibility: upload");
  }
  ReceiversOnCpu& onCpu = *this->frame_.onCpu;
  const bool isOther = counts.visibilityComputed > 0 || this->imagesOf_ != &view ||
    this->images_.visibility.empty() || this->imageNames_ != onCpu.names();
  if (this->frame_.ranks->isAny(this->frame_.wishes.keepVisibility && isOther))
  {
    this->images_ = keepVisibility(
      this->frame_.lights, view, onCpu.receivers().all(), onCpu.surfaces(), onCpu.names());
    this->imagesOf_ = &view;
    this->imageNames_ = onCpu.names();
  }
}

void VisibilityStage::dropImages()
{
  this->images_ = VisibilityImages{};
  this->imagesOf_ = nullptr;
}

/// Begin a light's image, in which unchanged tiles of the last one may be reused.
/// @param traced the light, with as many samples as the image has
/// @return null where all tiles are computed
TracedTiles* VisibilityStage::beginTiles(
  const CastingLight& casting, const ShadowLight& traced, VisibilityValue& value)
{
  const Occluders& occluders = this->occluders_;
  const ReceiversValue& receivers = this->frame_.view->receivers;
  const TechniqueInfo& info = casting.info();
  const bool isDecidedByMap = info.conservativeMap && casting.own->usesMap();
  // Of a single surface nothing stays where it was.
  if (!info.exact || isDecidedByMap || casting.edgeSamples() > 1 ||
    !this->frame_.plan.reusesTiles || occluders.surfaces.size() < 2)
  {
    value.dropTiles();
    return nullptr;
  }
  const bool classifies = value.classified || casting.smooths;
  const bool isFollowed = casting.mayKeepTiles && value.receiversNumber == receivers.numberBefore &&
    (!classifies || !value.classes.empty());
  if (!isFollowed || !classifies)
  {
    value.classes.clear();
  }
  value.tiles.begin(
    occluders, traced, receivers.images, isFollowed ? &receivers.fragmentsBefore : nullptr);
  value.receiversNumber = receivers.number;
  return &value.tiles;
}

/// Fill a light's layers by its technique.
/// @param verdicts null: nothing is known of its tiles
/// @param value whose classes, if they are asked for, and notes are filled
void VisibilityStage::fill(
  CastingLight& casting, const TileVerdicts* verdicts, VisibilityValue& value)
{
  value.notes.clear();
  value.edges.clear();
  value.tracedShare.reset();
  if (!casting.isOnCpu())
  {
    value.dropTiles();
  }
  std::vector<std::uint8_t>* const classes = value.classified ? &value.classes : nullptr;
  const ShadowLight& light = casting.light();
  const Occluders& occluders = this->occluders_;
  const ReceiversValue& receivers = this->frame_.view->receivers;
  VisibilityLayers& layers = this->frame_.view->layers;
  if (auto* pointwise = casting.own->as<PointwiseTechnique>())
  {
    const auto& technique = casting.filtered ? *casting.filtered : *pointwise;
    layers.estimate(casting.plan.layer, technique, light, receivers.target, this->frame_.space,
      this->shaders_, casting.info().classes.empty() ? nullptr : classes);
    this->frame_.endStage("visibility: estimate");
  }
  else if (auto* onGpu = casting.own->as<GpuScreenTechnique>())
  {
    this->buffers_.update(occluders);
    LayerInput input{ light, casting.own->fitting(), this->frame_.camera, this->frame_.space,
      occluders, this->buffers_, receivers.target, receivers.drawnSurfaces, layers, this->shaders_,
      value.notes, this->frame_.counts.mapBakes };
    input.layer = casting.plan.layer;
    input.receiversShown = receivers.number;
    input.severalViews = this->frame_.scene.picture.severalViews;
    input.counting = value.classified;
    input.classes = classes;
    namingLight(light, [&] { onGpu->drawVisibility(input, casting.counts); });
    this->frame_.endStage("visibility: draw");
  }
  else
  {
    this->trace(casting, verdicts, value);
  }
}

/// Fill a light's layers or bit by a technique that traces.
/// @param verdicts null: nothing is known of its tiles
void VisibilityStage::trace(
  CastingLight& casting, const TileVerdicts* verdicts, VisibilityValue& value)
{
  const ShadowLight& light = casting.light();
  VisibilityLayers& layers = this->frame_.view->layers;
  const std::size_t edgeSamples =
    casting.smooths ? static_cast<std::size_t>(casting.plan.edgeSamples) : casting.edgeSamples();
  std::vector<std::uint8_t>* const classes =
    value.classified || edgeSamples > 1 ? &value.classes : nullptr;
  auto& technique = *casting.own->as<CpuScreenTechnique>();
  ShadowLight traced = light;
  traced.lightSamples = samplesOfStep(casting.plan.firstSamples, value.samples, light.lightSamples);
  value.samples = traced.lightSamples;
  casting.counts.progress = static_cast<double>(traced.lightSamples) / light.lightSamples;
  ReceiversOnCpu& onCpu = *this->frame_.onCpu;
  const bool hasBit = casting.plan.bit != noBit;

  if (verdicts)
  {
    casting.tracedShare = value.tracedShare = verdicts->tell(light, casting.counts);
  }
  casting.own->tellRays(!verdicts || verdicts->needManyRays());
  const bool isDeferred = this->frame_.route() == Route::Deferred;
  if (verdicts && hasBit && !isDeferred && verdicts->areAllDark()) // and there are no edges
  {
    value.dropTiles();
    this->darkBits_.push_back(casting.plan.bit);
    if (classes)
    {
      verdicts->classifyAllDark(*classes);
    }
    this->frame_.endStage("visibility: trace");
    return;
  }
  TracedTiles* const tiles = this->beginTiles(casting, traced, value);
  std::vector<float>& visibility = tiles && !hasBit ? value.onCpu : this->onCpu_;
  if (tiles && hasBit && casting.mayKeepTiles)
  {
    layers.readBit(casting.plan.bit, visibility);
  }
  ScreenInput input{ traced, casting.own->fitting(), onCpu.surfaces(), onCpu.receivers(),
    this->tracer_.get(), this->frame_.counts.mapBakes };
  input.usesMap = casting.own->usesMap();
  input.classes = classes;
  input.tiles = tiles;
  input.verdicts = verdicts;
  const RayFilter* const ofMeans = this->tracer_.get().filter();
  if (ofMeans && light.area)
  {
    this->tracer_.get().filterSamples(&this->tracer_.filterOf(casting.plan));
  }
  namingLight(light, [&] { technique.computeVisibility(input, visibility, casting.counts); });
  this->tracer_.get().filterSamples(ofMeans);
  this->frame_.endStage("visibility: trace");
  if (hasBit)
  {
    layers.fillBit(casting.plan.bit, visibility);
  }
  const RayFilter* const filter =
    this->frame_.plan.transmits && !light.area ? &this->tracer_.filterOf(casting.plan) : nullptr;
  if (filter)
  {
    casting.counts.rays += static_cast<std::int64_t>(
      scaleByFilter(*filter, traced, onCpu.surfaces(), onCpu.receivers(), visibility));
    this->frame_.endStage("visibility: transmittance");
  }
  std::vector<EdgePixel> edges;
  if (edgeSamples > 1)
  {
    const auto smooth = [&](const SharedPicture* several)
    {
      edges = this->edges_.smooth(
        technique, input, *input.classes, edgeSamples, visibility, filter, several, casting.counts);
    };
    namingLight(light, [&] { onCpu.smoothEdges(smooth); });
    this->frame_.endStage("visibility: edges");
  }
  const std::size_t channels = filter && filter->isColoured() ? 3 : 1;
  for (const EdgePixel& edge : edges)
  {
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
      visibility[visibility.size() / channels * channel + edge.pixel] =
        edge.visibility[static_cast<glm::length_t>(channel)];
    }
  }
  if (!hasBit)
  {
    layers.upload(casting.plan.layer, visibility);
  }
  if (isDeferred)
  {
    this->frame_.view->receivers.deferred.keepShadows(visibility);
  }
  if (casting.smooths && !isDeferred)
  {
    value.edges = std::move(edges);
  }
  this->frame_.endStage("visibility: upload");
}

/// Bring the picture's edges on the image route up to date with those of the lights.
void VisibilityStage::updateEdges()
{
  ViewValues& view = *this->frame_.view;
  const int edgeBit = this->frame_.plan.edgeBit;
  if (edgeBit == noBit || this->frame_.counts.visibilityComputed == 0)
  {
    return;
  }
  std::vector<const std::vector<EdgePixel>*> ofBits(static_cast<std::size_t>(edgeBit));
  std::vector<std::uint32_t> pixels;
  auto value = view.visibility.begin();
  for (const CastingLight& casting : this->frame_.lights)
  {
    if (casting.plan.bit != noBit)
    {
      ofBits[static_cast<std::size_t>(casting.plan.bit)] = &value->edges;
      std::transform(value->edges.begin(), value->edges.end(), std::back_inserter(pixels),
        [](const EdgePixel& edge) { return edge.pixel; });
    }
    ++value;
  }
  if (!pixels.empty())
  {
    view.edges.update(this->frame_.size, ofBits);
  }
  if (!pixels.empty() || view.marksEdges)
  {
    view.layers.markBit(edgeBit, pixels);
    view.marksEdges = !pixels.empty();
    this->frame_.endStage("visibility: edges");
  }
}

} // namespace gnomon
