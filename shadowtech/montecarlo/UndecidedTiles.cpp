#include "shadowtech/montecarlo/UndecidedTiles.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{
namespace
{

constexpr int tileSide = 16; // pixels

const std::string& tileDefine()
{
  static const std::string define = "TILE_PIXELS " + std::to_string(tileSide);
  return define;
}

} // namespace

//------------------------------------------------------------------------------
int UndecidedTiles::tilesOf(int pixels)
{
  return (pixels + tileSide - 1) / tileSide;
}

//------------------------------------------------------------------------------
void UndecidedTiles::find(const SizedTexture& visibilityAndClass, ShaderLibrary& shaders)
{
  this->size_ = { visibilityAndClass.width(), visibilityAndClass.height() };
  this->contents_.allocate({ GL_RGBA32F, GL_RGBA, 4 }, tilesOf(this->size_.x),
    tilesOf(this->size_.y), 0, "what there is in tiles");
  const GLuint program = ScreenPass::use(shaders,
    ShaderLibrary::source("shadowtech/montecarlo/undecided_tiles.frag.glsl"), { tileDefine() });
  ShaderLibrary::setUniforms(program,
    { { "visibilityAndClass", TextureBinding{ GL_TEXTURE_2D, visibilityAndClass.name() } } }, 0, 0);
  this->screenPass_.fill(
    { { this->contents_.name() } }, this->contents_.width(), this->contents_.height());
}

//------------------------------------------------------------------------------
GLuint UndecidedTiles::use(
  ShaderLibrary& shaders, const std::string& fragmentGlsl, const std::vector<std::string>& defines)
{
  std::vector<std::string> all = defines;
  all.push_back(tileDefine());
  return ScreenPass::use(shaders,
    ShaderLibrary::source("shadowtech/montecarlo/undecided_tiles.vert.glsl"), fragmentGlsl, all);
}

//------------------------------------------------------------------------------
std::vector<Uniform> UndecidedTiles::uniforms(const glm::ivec2& reachTiles) const
{
  return { { "tiles", TextureBinding{ GL_TEXTURE_2D, this->contents_.name() } },
    { "pictureSize", this->size_ }, { "reachTiles", reachTiles } };
}

//------------------------------------------------------------------------------
void UndecidedTiles::fill(const std::vector<ScreenPass::Image>& images)
{
  this->screenPass_.fillQuads(
    images, this->size_.x, this->size_.y, this->contents_.width() * this->contents_.height());
}

} // namespace gnomon
