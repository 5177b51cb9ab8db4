#include "plugin/scene/TextureCutouts.h"

#include "plugin/scene/ForgetUnasked.h"

#include "plugin/scene/MapperInternals.h"

#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon
{
namespace
{

/// VTK reads the array that the texture's user has chosen. Only subclasses have access to it.
struct TextureAccess : vtkTexture
{
  static vtkDataArray* texels(vtkTexture* texture, vtkImageData* image)
  {
    using Getter = vtkDataArray* (vtkAlgorithm::*)(int, vtkDataObject*);
    return (texture->*static_cast<Getter>(&TextureAccess::GetInputArrayToProcess))(0, image);
  }
};

/// The side that every OpenGL since version 4.1 supports. VTK resamples larger images.
constexpr int largestSide = 16384;

/// Return the number of texels that VTK makes of an image along both directions; zero if it makes
/// none.
glm::ivec2 sizeOf(vtkImageData* image, vtkDataArray* texels)
{
  glm::ivec3 size(0);
  image->GetDimensions(&size.x);
  if (image->GetNumberOfCells() == texels->GetNumberOfTuples())
  {
    size = glm::max(size - 1, glm::min(size, 1)); // one texel for each cell
  }
  const glm::ivec2 used = size.x == 1 ? glm::ivec2(size.y, size.z)
    : size.y == 1                     ? glm::ivec2(size.x, size.z)
                                      : glm::ivec2(size.x, size.y);
  const bool flat = size.x == 1 || size.y == 1 || size.z == 1;
  const vtkIdType count = vtkIdType(used.x) * used.y;
  return flat && count <= texels->GetNumberOfTuples() ? used : glm::ivec2(0);
}

/// Return the colours that VTK hands to OpenGL, as in vtkOpenGLTexture. Three or four components
/// pass unchanged if their type allows it. Others become RGBA by the lookup table.
vtkSmartPointer<vtkDataArray> colorsOf(vtkTexture* texture, vtkDataArray* texels)
{
  const int mode = texture->GetColorMode();
  const int type = texels->GetDataType();
  const bool direct = (mode != VTK_COLOR_MODE_MAP_SCALARS && type == VTK_UNSIGNED_CHAR) ||
    (mode == VTK_COLOR_MODE_DIRECT_SCALARS && (type == VTK_UNSIGNED_SHORT || type == VTK_FLOAT));
  if (direct && texels->GetNumberOfComponents() >= 3)
  {
    return texels;
  }
  vtkSmartPointer<vtkScalarsToColors> colors = texture->GetLookupTable();
  if (!colors)
  {
    colors = vtkSmartPointer<vtkLookupTable>::New(); // like VTK's, always with alpha
  }
  return vtk::TakeSmartPointer<vtkDataArray>(colors->MapScalars(texels, mode, -1));
}

TextureWrap wrapOf(vtkTexture* texture)
{
  switch (texture->GetWrap())
  {
    case vtkTexture::ClampToEdge:
      return TextureWrap::ClampToEdge;
    case vtkTexture::MirroredRepeat:
      return TextureWrap::MirroredRepeat;
    case vtkTexture::ClampToBorder:
      return TextureWrap::ClampToBorder;
    default:
      return TextureWrap::Repeat;
  }
}

/// Return a texture's alpha; null if it is 1 everywhere.
std::shared_ptr<const CutoutMask> readAlpha(
  vtkTexture* texture, vtkDataArray* texels, glm::ivec2 size)
{
  const vtkSmartPointer<vtkDataArray> colors = colorsOf(texture, texels);
  constexpr int alpha = 3;
  if (!colors || colors->GetNumberOfComponents() <= alpha || size.x <= 0 || size.y <= 0)
  {
    return nullptr;
  }
  CutoutMask mask;
  mask.width = size.x;
  mask.height = size.y;
  mask.wrap = wrapOf(texture);
  mask.interpolated = texture->GetInterpolate() != 0;
  mask.borderDrawn = texture->GetBorderColor()[alpha] > 0.0f;
  mask.texels.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  const auto fill = [&](const auto& alphaOf)
  {
    for (std::size_t i = 0; i < mask.texels.size(); ++i)
    {
      mask.texels[i] = alphaOf(static_cast<vtkIdType>(i));
    }
  };
  if (auto* bytes = vtkArrayDownCast<vtkUnsignedCharArray>(colors.Get()))
  {
    const int components = bytes->GetNumberOfComponents();
    const unsigned char* first = bytes->GetPointer(alpha);
    fill([=](vtkIdType i) { return first[i * components]; });
  }
  else
  {
    const double whole = colors->GetDataType() == VTK_UNSIGNED_SHORT ? 65535.0 : 1.0;
    fill(
      [&](vtkIdType i)
      {
        const double value = colors->GetComponent(i, alpha) / whole;
        return static_cast<std::uint8_t>(
          value <= 0.0 ? 0.0 : std::clamp(std::round(255.0 * value), 1.0, 255.0));
      });
  }
  const bool isOpaque = std::all_of(mask.texels.begin(), mask.texels.end(),
                          [](std::uint8_t texel) { return texel == 255; }) &&
    (mask.wrap != TextureWrap::ClampToBorder || mask.borderDrawn);
  return isOpaque ? nullptr : std::make_shared<const CutoutMask>(std::move(mask));
}

/// Return the mask of a texture's alpha: null if it has no holes, the alpha itself if it has no
/// values between.
std::shared_ptr<const CutoutMask> maskOf(const std::shared_ptr<const CutoutMask>& alpha)
{
  const bool hasHoles = alpha &&
    (std::find(alpha->texels.begin(), alpha->texels.end(), 0) != alpha->texels.end() ||
      (alpha->wrap == TextureWrap::ClampToBorder && !alpha->borderDrawn));
  if (!hasHoles)
  {
    return nullptr;
  }
  CutoutMask mask = *alpha;
  for (std::uint8_t& texel : mask.texels)
  {
    texel = texel > 0 ? 255 : 0;
  }
  return mask == *alpha ? alpha : std::make_shared<const CutoutMask>(std::move(mask));
}

/// True for textures that materials read by name, not as colours to blend.
bool isSpecial(const std::string& name)
{
  static const std::array<const char*, 7> special = { "albedoTex", "normalTex", "materialTex",
    "brdfTex", "emissiveTex", "anisotropyTex", "coatNormalTex" };
  return std::any_of(
    special.begin(), special.end(), [&](const char* other) { return name == other; });
}

/// True if a texture that is not the first changes the alpha of the first.
bool blendsAlpha(vtkTexture* texture)
{
  switch (texture->GetBlendingMode())
  {
    case vtkTexture::VTK_TEXTURE_BLENDING_MODE_REPLACE:
    case vtkTexture::VTK_TEXTURE_BLENDING_MODE_MODULATE:
    case vtkTexture::VTK_TEXTURE_BLENDING_MODE_ADD:
    case vtkTexture::VTK_TEXTURE_BLENDING_MODE_ADD_SIGNED:
      return true;
    default:
      return false;
  }
}

using NamedTexture = std::pair<std::string, vtkTexture*>;

/// Return the textures whose alpha counts, in VTK's order. Physically based shading uses the albedo
/// texture only, other shading all other flat textures.
std::vector<NamedTexture> texturesWithAlpha(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  std::vector<NamedTexture> textures;
  if (property->GetInterpolation() == VTK_PBR && property->GetLighting())
  {
    if (vtkTexture* albedo = property->GetTexture("albedoTex"))
    {
      textures.emplace_back("albedoTex", albedo);
    }
    return textures;
  }
  if (actor->GetTexture())
  {
    textures.emplace_back("actortexture", actor->GetTexture());
  }
  for (const auto& [name, texture] : property->GetAllTextures())
  {
    if (!isSpecial(name))
    {
      textures.emplace_back(name, texture);
    }
  }
  textures.erase(std::remove_if(textures.begin(), textures.end(),
                   [](const NamedTexture& texture) { return texture.second->GetCubeMap(); }),
    textures.end());
  return textures;
}

/// Return the matrix by which VTK's vertex shader transforms texture coordinates. The actor's own
/// texture sets that key while VTK draws the actor.
glm::mat4 transformOf(vtkActor* actor, vtkInformation* keys)
{
  const double* rows = nullptr;
  if (actor->GetTexture() && actor->GetTexture()->GetTransform())
  {
    rows = actor->GetTexture()->GetTransform()->GetMatrix()->GetData();
  }
  else if (keys && keys->Has(vtkProp::GNOMON_VTK_TEXTURE_TRANSFORM()))
  {
    rows = keys->Get(vtkProp::GNOMON_VTK_TEXTURE_TRANSFORM());
  }
  glm::mat4 transform(1.0f);
  for (int i = 0; rows && i < 16; ++i)
  {
    transform[i % 4][i / 4] = static_cast<float>(rows[i]);
  }
  return transform;
}

/// Return why the textures of a mapper or a property are not supported; null if they are.
const char* unservedReason(vtkActor* actor, vtkMapper* mapper)
{
  auto* polyDataMapper = vtkPolyDataMapper::SafeDownCast(mapper);
  if (polyDataMapper && (polyDataMapper->GetSeamlessU() || polyDataMapper->GetSeamlessV()))
  {
    return "seamless texture coordinates";
  }
  if (mapper->GetScalarVisibility() && mapper->GetInterpolateScalarsBeforeMapping())
  {
    return "scalars interpolated before mapping";
  }
  return actor->GetProperty()->GetShowTexturesOnBackface() ? nullptr : "textures on the front only";
}

} // namespace

void TextureCutouts::beginFrame()
{
  forgetUnasked(this->known_);
}

/// Return a texture's mask in its present state.
const TextureCutouts::Known& TextureCutouts::known(vtkTexture* texture)
{
  Known& known = this->known_[texture];
  if (std::exchange(known.asked, true))
  {
    return known; // another actor has it, too
  }
  vtkAlgorithm* source = texture->GetInputAlgorithm();
  if (source && !source->IsA("vtkTrivialProducer"))
  {
    source->UpdateWholeExtent();
  }
  vtkImageData* image = texture->GetInput();
  vtkScalarsToColors* colors = texture->GetLookupTable();
  const vtkMTimeType time = std::max(
    { texture->GetMTime(), image ? image->GetMTime() : 0, colors ? colors->GetMTime() : 0 });
  if (known.time != time)
  {
    known.time = time;
    vtkDataArray* texels = image ? TextureAccess::texels(texture, image) : nullptr;
    const glm::ivec2 size = texels ? sizeOf(image, texels) : glm::ivec2(0);
    // Other colours may have the same alpha, or the same holes.
    const auto replace = [](auto& old, const auto& with)
    {
      if (!with || !old || !(*with == *old))
      {
        old = with;
      }
    };
    replace(known.alpha, texels ? readAlpha(texture, texels, size) : nullptr);
    replace(known.mask, maskOf(known.alpha));
    known.tooLarge = std::max(size.x, size.y) > largestSide;
  }
  return known;
}

TextureCutout TextureCutouts::find(
  vtkActor* actor, vtkMapper* mapper, vtkInformation* keys, bool wantsAlpha, const char*& reason)
{
  TextureCutout cutout;
  if (!actor->GetTexture() && actor->GetProperty()->GetNumberOfTextures() == 0)
  {
    return cutout; // nearly always
  }
  const std::vector<NamedTexture> textures = texturesWithAlpha(actor);
  bool counts = false;
  for (std::size_t i = 0; i < textures.size(); ++i)
  {
    const auto& [name, texture] = textures[i];
    if (i > 0 && !blendsAlpha(texture))
    {
      continue;
    }
    const Known& known = this->known(texture);
    counts = counts || known.mask || (wantsAlpha && known.alpha);
    if (i == 0)
    {
      cutout.mask = known.mask;
      cutout.alpha = known.alpha;
      cutout.texture = name;
      reason = known.tooLarge ? "texture too large" : nullptr;
    }
    else
    {
      reason = "textures blended";
    }
  }
  if (!counts)
  {
    reason = nullptr;
    return {};
  }
  reason = reason ? reason : unservedReason(actor, mapper);
  if (reason)
  {
    return {};
  }
  cutout.transform = transformOf(actor, keys);
  return cutout;
}

std::size_t TextureCutouts::bytes() const
{
  return bytesOfTable(this->known_) +
    bytesOfAll(this->known_,
      [](const auto& entry)
      {
        const auto& [mask, alpha] = std::pair(entry.second.mask.get(), entry.second.alpha.get());
        return (mask ? mask->bytes() : 0) + (alpha && alpha != mask ? alpha->bytes() : 0);
      });
}

vtkDataArray* textureCoordinates(vtkMapper* mapper, const std::string& texture, vtkPolyData* data)
{
  const char* const own = texture == "albedoTex" ? nullptr : coordinatesArray(mapper, texture);
  vtkDataArray* array =
    own ? data->GetPointData()->GetArray(own) : data->GetPointData()->GetTCoords();
  const int components = array ? array->GetNumberOfComponents() : 0;
  return components == 1 || components == 2 ? array : nullptr;
}

} // namespace gnomon
