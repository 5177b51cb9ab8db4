#include "shadowtech/pcss/Pcss.h"

#include "lights/LightSamples.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/pcss/PoissonSquare.h"

namespace gnomon
{
namespace
{

std::string define(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

std::string refused(const ShadowLight& light)
{
  return light.earlyOut == EarlyOut::Ring
    ? "'pcss' has no ring of points to believe, since its points are all over the light; its "
      "'early_out' is exact or none"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
PcssCounts pcssCounts(PcssSamples samples)
{
  switch (samples)
  {
    case PcssSamples::Low:
      return { 4 * 4, 4 * 4 };
    case PcssSamples::Medium:
      return { 6 * 6, 8 * 8 };
    case PcssSamples::High:
      break;
  }
  return { 8 * 8, 16 * 16 };
}

//------------------------------------------------------------------------------
std::vector<glm::vec2> pcssPoints(PcssSamples samples, LightArea::Shape shape)
{
  const PcssCounts counts = pcssCounts(samples);
  std::vector<glm::vec2> points;
  for (const int count : { counts.search, counts.filter })
  {
    for (const glm::dvec2& point : poissonSquare(count))
    {
      points.push_back(
        shape == LightArea::Shape::Rectangle ? glm::vec2(point) : diskPoint(glm::vec2(point)));
    }
  }
  return points;
}

//------------------------------------------------------------------------------
TechniqueInfo Pcss::info()
{
  TechniqueInfo info;
  info.name = "pcss";
  info.evaluation = Evaluation::Pointwise;
  info.needsMap = true;
  info.refused = refused;
  return info;
}

//------------------------------------------------------------------------------
MapReach Pcss::mapReach(const ShadowLight& light) const
{
  MapReach reach;
  reach.area = light.area.value_or(LightArea());
  return reach;
}

//------------------------------------------------------------------------------
void Pcss::bake(const MapInput& input)
{
  this->DepthMapTechnique::bake(input);
  this->bounds_.release();
  this->points_.reset();
  this->bytesOfPoints_ = 0;
  if (input.light.area)
  {
    this->bakeBounds(this->bounds_, input.shaders);
    this->bakePoints(input.light);
  }
}

//------------------------------------------------------------------------------
void Pcss::bakePoints(const ShadowLight& light)
{
  const GlStateGuard guard;
  const std::vector<glm::vec2> points = pcssPoints(light.pcssSamples, light.area->shape);
  const int count = static_cast<int>(points.size());
  allocateTexture(this->points_, { GL_RG32F, GL_RG, 2 }, count, 1, 0, "points of a light");
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, count, 1, GL_RG, GL_FLOAT, points.data());
  this->bytesOfPoints_ = points.size() * sizeof(glm::vec2);
}

//------------------------------------------------------------------------------
std::size_t Pcss::bytesOfMaps() const
{
  return this->DepthMapTechnique::bytesOfMaps() + this->bounds_.bytes() + this->bytesOfPoints_;
}

//------------------------------------------------------------------------------
std::vector<Uniform> Pcss::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
  if (this->bounds_)
  {
    uniforms.push_back(this->bounds_.uniform());
    uniforms.push_back(
      { "lightPoints_LIGHT", TextureBinding{ GL_TEXTURE_2D, this->points_.name() } });
    const std::vector<LightView>& views = this->views().views;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const glm::dmat3 viewFromUnit =
        glm::dmat3(views[i].rays.viewFromCentred) * this->reach().area.worldFromUnit;
      uniforms.push_back(
        { "viewFromUnitLight_LIGHT[" + std::to_string(i) + "]", glm::mat3(viewFromUnit) });
    }
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string Pcss::estimatorGlsl(const ShadowLight& light) const
{
  if (!light.area)
  {
    return ShaderLibrary::source("shadowtech/compare/compare_estimator.glsl");
  }
  const PcssCounts counts = pcssCounts(light.pcssSamples);
  const bool asksBounds = light.earlyOut == EarlyOut::Exact && !measuresAlongRay(light);
  return define("PCSS_BALL_LIGHT", light.area->shape == LightArea::Shape::Ball) +
    define("PCSS_RECTANGLE_LIGHT", light.area->shape == LightArea::Shape::Rectangle) +
    define("PCSS_SEARCH_POINTS_LIGHT", counts.search) +
    define("PCSS_FILTER_POINTS_LIGHT", counts.filter) +
    define("PCSS_ASKS_BOUNDS_LIGHT", asksBounds) +
    ShaderLibrary::source("shadowtech/pcss/pcss_estimator.glsl");
}

} // namespace gnomon
