#include "Matrix.h"

#include "BuiltinScenes.h"
#include "Comparison.h"
#include "Errors.h"
#include "Files.h"
#include "Flicker.h"
#include "FrameVariant.h"
#include "Judge.h"
#include "Report.h"
#include "Text.h"
#include "VtkMessages.h"
#include "tests/check/Check.h"

#include "lights/LightManager.h"
#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Gl.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

namespace gnomon::hard
{
namespace
{

using tool::FrameVariant;
using tool::Motion;
using tool::VariantSpec;

constexpr std::array<const char*, 4> easyScenes = { "soft-stack", "soft-panels", "soft-plates",
  "soft-long-cube" };

/// The scene of moving shadows (Flicker.h).
constexpr const char* flickerScene = "terrain";
constexpr int flickerSteps = 5;

/// Softness: a lamp's size as a share of its distance to its focal point; a sun's in degrees.
constexpr double softLampShare = 0.05;
constexpr double softSunDegrees = 5.0;

/// A technique with or without a map, with settings that draw it at once.
VariantSpec specOf(const std::string& technique)
{
  VariantSpec spec = tool::parseTechnique(technique);
  const TechniqueInfo& info = estimatorOf(tool::settingsOf(spec)).info;
  spec.mapSizeTexels = info.bakesMap() ? bounds::mapSizeTexels : 0;
  spec.route = vtkGnomonShadowPass::ROUTE_IMAGE;
  if (has(info, "bake"))
  {
    spec.settings["bake"] = "always"; // the map is judged, not its fallback
  }
  return spec;
}

/// Return why lights of the scene refuse a variant's settings; empty if they do not.
std::string refusal(const VariantSpec& spec, vtkRenderer* renderer)
{
  try
  {
    for (ShadowLight light : LightManager().collect(renderer, tool::settingsOf(spec)).lights)
    {
      compose(light);
    }
    return {};
  }
  catch (const CompositionError& error)
  {
    return error.what();
  }
}

/// Return the first fault of pictures' numbers; empty if there is none.
std::string strangeNumber(const std::vector<std::vector<float>>& images)
{
  for (const std::vector<float>& image : images)
  {
    for (const float value : image)
    {
      if (!(value >= 0.0f && value <= 1.0f))
      {
        return "a visibility of " + std::to_string(value);
      }
    }
  }
  return images.empty() ? "no visibility" : "";
}

std::string openGlError()
{
  const GLenum error = glGetError();
  return error == GL_NO_ERROR ? "" : "OpenGL error " + std::to_string(error);
}

/// Mark a cell as broken if its numbers are invalid, or OpenGL or VTK reports an error.
void keepSound(
  Cell& cell, const std::vector<std::vector<float>>& images, const tool::VtkMessages& messages)
{
  std::string message = strangeNumber(images);
  if (message.empty())
  {
    message = openGlError();
  }
  if (message.empty() && !messages.errors().empty())
  {
    message = messages.errors().front();
  }
  if (!message.empty())
  {
    cell.outcome = Outcome::Broken;
    cell.message = message;
  }
}

VisibilityImages drawn(FrameVariant& variant)
{
  variant.pass()->KeepVisibilityOn();
  do
  {
    variant.drawFrame(Motion::Static, 0);
  } while (variant.pass()->GetProgress() < 1.0);
  return variant.pass()->GetVisibility();
}

/// Return the scene with lights that are points or have one direction.
tool::Scene hardened(tool::Scene scene)
{
  for (tool::SceneLight& light : scene.lights)
  {
    light.area.reset();
  }
  return scene;
}

/// Return the scene with lights that have an area.
tool::Scene softened(tool::Scene scene)
{
  for (tool::SceneLight& light : scene.lights)
  {
    if (light.area)
    {
      continue;
    }
    tool::Vec3 way;
    std::transform(light.target.begin(), light.target.end(), light.position.begin(), way.begin(),
      std::minus<>());
    const bool isSun = light.type == tool::SceneLight::Type::Directional;
    const double radius =
      isSun ? softSunDegrees : softLampShare * std::hypot(way[0], way[1], way[2]);
    light.settings["light_radius"] = std::to_string(radius);
  }
  return scene;
}

/// Return the pixels of a light that count and are wrong.
std::vector<std::size_t> wrongPixels(const VisibilityImages& images, const VisibilityImages& truth,
  std::size_t image, const tool::Scene& scene)
{
  const auto light = static_cast<std::size_t>(truth.sceneIndices[image]);
  const std::vector<unsigned char> facing = tool::facingPixels(truth, scene.lights[light]);
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < facing.size(); ++i)
  {
    if (facing[i] && !(std::abs(images.visibility[image][i] - truth.visibility[image][i]) <= 0.5f))
    {
      wrong.push_back(i);
    }
  }
  return wrong;
}

void judgeExact(Cell& cell, const VisibilityImages& images, const VisibilityImages& truth)
{
  for (std::size_t image = 0; image < truth.visibility.size(); ++image)
  {
    for (std::size_t i = 0; i < truth.coverage.size(); ++i)
    {
      cell.beyond += images.visibility[image][i] != truth.visibility[image][i] ? 1 : 0;
    }
  }
}

/// @param onFloor true if only the floor's pixels count
void judgeMap(Cell& cell, const VisibilityImages& images, const VisibilityImages& truth,
  const tool::Scene& scene, const Judge& judge, bool onFloor)
{
  bool isSeen = false;
  for (std::size_t image = 0; image < truth.visibility.size(); ++image)
  {
    const auto light = static_cast<std::size_t>(truth.sceneIndices[image]);
    const std::vector<unsigned char> facing = tool::facingPixels(truth, scene.lights[light]);
    for (std::size_t pixel = 0; pixel < facing.size() && !isSeen; ++pixel)
    {
      isSeen = facing[pixel] && (!onFloor || judge.isOnFloor(receiverAt(truth, pixel)));
    }
    for (const std::size_t pixel : wrongPixels(images, truth, image, scene))
    {
      const Receiver receiver = receiverAt(truth, pixel);
      const double distance =
        bounds::edgeTexels * judge.texelAt(receiver, light, bounds::mapSizeTexels);
      const bool isAllEdge =
        judge.cosineAt(receiver, light) * bounds::mapSizeTexels <= bounds::edgeTexels;
      const bool counts = !isAllEdge && (!onFloor || judge.isOnFloor(receiver));
      cell.beyond += counts && !judge.isNearEdge(receiver, light, distance) ? 1 : 0;
    }
  }
  cell.outcome = isSeen ? cell.outcome : Outcome::None;
}

/// Compare with the independent check, which knows only triangles.
void judgeTruth(Cell& cell, const VisibilityImages& truth, const Judge& judge)
{
  check::VisibilityFile file;
  file.width = truth.width;
  file.height = truth.height;
  file.origin = { truth.origin[0], truth.origin[1], truth.origin[2] };
  file.channels = { { "coverage", truth.coverage }, { "position.X", truth.positionX },
    { "position.Y", truth.positionY }, { "position.Z", truth.positionZ },
    { "normal.X", truth.normalX }, { "normal.Y", truth.normalY }, { "normal.Z", truth.normalZ } };
  for (std::size_t i = 0; i < truth.visibility.size(); ++i)
  {
    file.channels["visibility." + std::to_string(truth.sceneIndices[i])] = truth.visibility[i];
  }
  const check::Result result = check::compare(judge.scene(), file);
  for (const check::LightResult& light : result.lights)
  {
    cell.wrong += static_cast<std::int64_t>(
      light.falseLight.size() + light.falseShadow.size() + light.unlit.size());
  }
  const std::vector<std::string> failures = result.failures();
  if (!failures.empty())
  {
    cell.outcome = Outcome::Broken;
    cell.message = failures.front();
  }
}

/// Count pixels that face a light and whose truth turns. They are beyond the bound if no edge is
/// near.
/// @param turns called for each receiver and light; true if the truth turns there
template <typename Turns>
void judgeTurning(Cell& cell, const VisibilityImages& truth, const tool::Scene& scene,
  const Judge& judge, const Turns& turns)
{
  for (std::size_t image = 0; image < truth.visibility.size(); ++image)
  {
    const auto light = static_cast<std::size_t>(truth.sceneIndices[image]);
    const std::vector<unsigned char> facing = tool::facingPixels(truth, scene.lights[light]);
    for (std::size_t pixel = 0; pixel < facing.size(); ++pixel)
    {
      const Receiver receiver = receiverAt(truth, pixel);
      if (facing[pixel] && turns(receiver, light, truth.visibility[image][pixel] > 0.5f))
      {
        ++cell.wrong;
        const double distance = bounds::truthEdgePixels * judge.pixelAt(receiver, truth.height);
        cell.beyond += judge.isNearEdge(receiver, light, distance) ? 0 : 1;
      }
    }
  }
}

/// Compare with rays against balls of fine triangles.
void judgeTruthOfBalls(
  Cell& cell, const VisibilityImages& truth, const tool::Scene& scene, const Judge& judge)
{
  judgeTurning(cell, truth, scene, judge,
    [&](const Receiver& receiver, std::size_t light, bool isLit)
    { return judge.isLit(receiver, light, judge.storedOffset()) != isLit; });
}

void judgeOffset(
  Cell& cell, const VisibilityImages& truth, const tool::Scene& scene, const Judge& judge)
{
  const check::Vec3 origin(truth.origin[0], truth.origin[1], truth.origin[2]);
  judgeTurning(cell, truth, scene, judge,
    [&](const Receiver& receiver, std::size_t light, bool)
    {
      const double offset = judge.offsetOf(receiver, origin, truth.height);
      const bool isLit = judge.isLit(receiver, light, offset);
      return judge.isLit(receiver, light, 0.5 * offset) != isLit ||
        judge.isLit(receiver, light, 2.0 * offset) != isLit;
    });
}

void judgeSoft(Cell& cell, const Column& column, double error)
{
  cell.error = error;
  cell.bound = bounds::softFactor * bounds::easyErrors().at(column.name);
  if (cell.error > cell.bound)
  {
    cell.outcome = Outcome::Broken;
  }
}

/// A scene's cells.
class SceneRow
{
public:
  SceneRow(const Row& row, const tool::Scene& scene)
    : row_(row)
    , hard_(hardened(tool::withoutShadowSettings(scene)))
    , soft_(softened(tool::withoutShadowSettings(scene)))
    , judge_(this->hard_)
  {
  }

  /// @param column one of columns()
  Cell draw(const Column& column)
  {
    const bool isSoft = this->isSoft(column);
    const tool::Scene& scene = isSoft ? this->soft_ : this->hard_;
    const int width = isSoft ? bounds::softWidth : bounds::width;
    const int height = isSoft ? bounds::softHeight : bounds::height;
    Cell cell{ &this->row_, &column };
    const tool::VtkMessages messages;
    const VariantSpec spec = specOf(column.technique);
    FrameVariant variant(spec, scene, width, height);
    cell.message = refusal(spec, variant.renderer());
    if (!cell.message.empty())
    {
      variant.drawFrame(Motion::Static, 0);
      const std::vector<std::string>& said = messages.errors();
      const bool isSaid = std::any_of(said.begin(), said.end(),
        [&](const std::string& text) { return text.find(cell.message) != std::string::npos; });
      cell.outcome = isSaid ? Outcome::Refused : Outcome::Broken;
      return cell;
    }
    cell.outcome = Outcome::Kept;
    const VisibilityImages images = drawn(variant);
    this->judge(cell, column, images, scene);
    keepSound(cell, images.visibility, messages);
    if (cell.outcome == Outcome::Kept && cell.counted == 0)
    {
      cell.outcome = Outcome::Broken;
      cell.message = "nothing is seen that faces a light";
    }
    return cell;
  }

private:
  static bool isSoft(const Column& column)
  {
    return column.kind == Kind::Soft || column.technique == "penumbra";
  }

  /// Return the truth for a column.
  const VisibilityImages& truthOf(const Column& column)
  {
    if (column.kind == Kind::Soft)
    {
      return truth(this->manySamples_,
        "raytraced:light_seed=1:light_samples=" + std::to_string(bounds::truthSamples), this->soft_,
        bounds::softWidth, bounds::softHeight);
    }
    if (this->isSoft(column))
    {
      return truth(
        this->sameSamples_, "raytraced", this->soft_, bounds::softWidth, bounds::softHeight);
    }
    return truth(this->oneRay_, "raytraced", this->hard_, bounds::width, bounds::height);
  }
  static const VisibilityImages& truth(std::optional<VisibilityImages>& kept,
    const std::string& technique, const tool::Scene& scene, int width, int height)
  {
    if (!kept)
    {
      FrameVariant variant(specOf(technique), scene, width, height);
      kept = drawn(variant);
    }
    return *kept;
  }

  void judge(
    Cell& cell, const Column& column, const VisibilityImages& images, const tool::Scene& scene)
  {
    const VisibilityImages& truth = this->truthOf(column);
    const tool::VisibilityError error = tool::measureError(images, truth, scene.lights);
    cell.counted = error.facingPixels;
    cell.wrong = error.wrongPixels();
    switch (column.kind)
    {
      case Kind::Truth:
        scene.props.empty() ? judgeTruth(cell, images, this->judge_)
                            : judgeTruthOfBalls(cell, images, scene, this->judge_);
        break;
      case Kind::Offset:
        judgeOffset(cell, truth, scene, this->judge_);
        break;
      case Kind::Exact:
        judgeExact(cell, images, truth);
        break;
      case Kind::Map:
        judgeMap(cell, images, truth, scene, this->judge_, false);
        break;
      case Kind::Plane:
        judgeMap(cell, images, truth, scene, this->judge_, true);
        break;
      case Kind::Soft:
        judgeSoft(cell, column, error.meanAbsolute);
        break;
    }
    if (cell.beyond > 0)
    {
      cell.outcome = Outcome::Broken;
    }
  }

  const Row& row_;
  tool::Scene hard_;
  tool::Scene soft_;
  Judge judge_;
  std::optional<VisibilityImages> oneRay_;
  std::optional<VisibilityImages> manySamples_;
  std::optional<VisibilityImages> sameSamples_; ///< as many samples as techniques have
};

/// The cells of a movement.
class MovementRow
{
public:
  explicit MovementRow(const Row& row)
    : row_(row)
    , scene_(hardened(tool::withoutShadowSettings(tool::loadScene(flickerScene))))
  {
  }

  /// @param column one of columns()
  Cell draw(const Column& column)
  {
    Cell cell{ &this->row_, &column };
    const bool isHard = column.kind == Kind::Map || column.kind == Kind::Exact;
    if (!isHard || column.technique == "penumbra")
    {
      return cell;
    }
    cell.outcome = Outcome::Kept;
    const tool::VtkMessages messages;
    const Movement movement = *this->row_.movement;
    // A turned light has no map that moves with the camera.
    const bool isFitted = movement != Movement::LightTurned;
    const Frames frames = this->framesOf(column.technique, movement, isFitted);
    if (!this->truth_)
    {
      this->truth_ = this->framesOf("raytraced", movement, false);
    }
    cell.error = flicker(frames, *this->truth_, bounds::width);
    cell.bound = column.kind == Kind::Exact ? 0.0 : bounds::flickerFactor * this->plain();
    if (cell.error > cell.bound)
    {
      cell.outcome = Outcome::Broken;
    }
    keepSound(cell, frames, messages);
    return cell;
  }

private:
  /// Return the flicker of `nsm` under a turning light.
  double plain()
  {
    if (!this->plain_)
    {
      constexpr Movement turned = Movement::LightTurned;
      this->plain_ = flicker(this->framesOf("nsm", turned, false),
        this->framesOf("raytraced", turned, false), bounds::width);
    }
    return *this->plain_;
  }

  /// @param isFitted true if uniform maps are fitted to the camera's view
  Frames framesOf(const std::string& technique, Movement movement, bool isFitted) const
  {
    VariantSpec spec = specOf(technique);
    const bool isUniform = findTechnique(technique)->projection == Projection::Uniform;
    if (isFitted && isUniform && spec.mapSizeTexels > 0)
    {
      spec.settings["fit"] = "frame";
    }
    return drawMovement(spec, this->scene_, bounds::width, bounds::height, movement, flickerSteps);
  }

  const Row& row_;
  tool::Scene scene_;
  std::optional<Frames> truth_;
  std::optional<double> plain_;
};

template <typename RowOfCells>
std::vector<Cell> drawAll(RowOfCells&& row, const std::vector<const Column*>& columns)
{
  std::vector<Cell> cells;
  for (const Column* column : columns)
  {
    cells.push_back(row.draw(*column));
  }
  return cells;
}

constexpr std::size_t largestTableBytes = 1 << 20;

const char* nameOf(Outcome outcome)
{
  static const std::map<Outcome, const char*> names = { { Outcome::Kept, "kept" },
    { Outcome::Broken, "broken" }, { Outcome::Refused, "refused" }, { Outcome::None, "none" } };
  return names.at(outcome);
}

/// Return a cell's result as text.
std::string findingOf(const Cell& cell)
{
  std::string text = cell.row->name + ", " + cell.column->name + ": " + nameOf(cell.outcome);
  if (cell.counted > 0)
  {
    text += "; " + std::to_string(cell.wrong) + " of " + std::to_string(cell.counted) +
      " pixels wrong, " + std::to_string(cell.beyond) + " beyond the bound";
  }
  if (cell.bound > 0.0 || cell.error > 0.0)
  {
    text += "; error " + tool::threeDigits(cell.error) + ", bound " + tool::threeDigits(cell.bound);
  }
  return text + (cell.message.empty() ? "" : "; " + cell.message);
}

} // namespace

const std::vector<Column>& columns()
{
  static const std::vector<Column> all = []
  {
    std::vector<Column> of = { { "raytraced", "raytraced", Kind::Truth },
      { "ray offset", "raytraced", Kind::Offset } };
    for (const TechniqueEntry& entry : registry())
    {
      const bool isSoft =
        entry.name == "pcss" || entry.name == "sampled" || entry.name == "montecarlo";
      if (entry.name != "raytraced")
      {
        of.push_back({ entry.name, entry.name,
          isSoft                          ? Kind::Soft
            : entry.estimator->info.exact ? Kind::Exact
            : entry.name == "planar"      ? Kind::Plane
                                          : Kind::Map });
      }
    }
    return of;
  }();
  return all;
}

const std::vector<Row>& rows()
{
  static const std::vector<Row> all = []
  {
    std::vector<Row> of;
    for (const tool::BuiltinScene& scene : tool::hardScenes())
    {
      of.push_back({ scene.name });
    }
    of.push_back({ "camera-moves-aside", Movement::CameraAside });
    of.push_back({ "camera-turns", Movement::CameraTurned });
    of.push_back({ "light-turns", Movement::LightTurned });
    return of;
  }();
  return all;
}

std::vector<Cell> drawRow(const Row& row, const std::vector<const Column*>& columns)
{
  return columns.empty() ? std::vector<Cell>()
    : row.movement       ? drawAll(MovementRow(row), columns)
                         : drawAll(SceneRow(row, tool::loadScene(row.name)), columns);
}

double easyError(const Column& column)
{
  double sum = 0.0;
  for (const char* name : easyScenes)
  {
    const Row row{ name };
    sum += SceneRow(row, tool::loadScene(name)).draw(column).error;
  }
  return sum / static_cast<double>(easyScenes.size());
}

std::string csvHeading()
{
  return "case,technique,outcome,counted,wrong,beyond,error,bound,message\r\n";
}

std::string csvLine(const Cell& cell)
{
  return tool::csvLine({ cell.row->name, cell.column->name, nameOf(cell.outcome), cell.counted,
    cell.wrong, cell.beyond, cell.error, cell.bound, tool::oneLine(cell.message) });
}

KnownCells readKnownCells(const std::string& path)
{
  KnownCells known;
  const std::vector<std::string> lines =
    tool::split(tool::readWholeFile(path, largestTableBytes), '\n');
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    if (lines[i].empty() || lines[i][0] == '#')
    {
      continue;
    }
    const std::vector<std::string> parts = tool::split(lines[i], '\t');
    const auto isNamed = [](const auto& all, const std::string& name) {
      return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
    };
    if (parts.size() != 3 || !isNamed(rows(), parts[0]) || !isNamed(columns(), parts[1]))
    {
      throw tool::BadInput(path + ", line " + std::to_string(i + 1) +
        ": a row, a column and a reason are expected, separated by tabs");
    }
    known[{ parts[0], parts[1] }] = parts[2];
  }
  return known;
}

std::vector<std::string> surprisesIn(const std::vector<Cell>& cells, const KnownCells& known)
{
  std::vector<std::string> surprises;
  for (const Cell& cell : cells)
  {
    const bool isKnown = known.count({ cell.row->name, cell.column->name }) > 0;
    if (isKnown != (cell.outcome == Outcome::Broken))
    {
      surprises.push_back((isKnown ? "no more broken: " : "broken: ") + findingOf(cell));
    }
  }
  return surprises;
}

void writeTable(const std::string& folder, const std::vector<Cell>& cells)
{
  std::string csv = csvHeading();
  for (const Cell& cell : cells)
  {
    csv += csvLine(cell);
  }
  tool::writeWholeFile(folder + "/hard_cases.csv", csv);
}

} // namespace gnomon::hard
