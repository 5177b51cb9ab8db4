#pragma once

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/CutoutMask.h"

#include "vtkType.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkDataArray;
class vtkInformation;
class vtkMapper;
class vtkPolyData;
class vtkTexture;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The holes that VTK cuts into an actor's surface by a texture.
struct TextureCutout
{
  std::shared_ptr<const CutoutMask> mask;  ///< null if nothing is cut out
  std::shared_ptr<const CutoutMask> alpha; ///< with all its values; null if it is 1
  std::string texture;                     ///< its name in VTK's shader
  glm::mat4 transform{ 1.0f };             ///< of its texture coordinates (s, t, 0, 1)
};

/// Reads the alpha of textures, and caches it while it is in use.
class TextureCutouts
{
public:
  /// Begin a frame: drop masks that nothing asked for since the last call.
  void beginFrame();

  /// Return the holes in an actor's surface. VTK may still call the surface opaque: if no texel is
  /// half transparent, and with any albedo texture. Updates the texture's input, as VTK does when
  /// it draws.
  ///
  /// @param wantsAlpha true if the surface may let light through, so that a texture without holes
  /// counts, too
  /// @param keys those that the actor has while VTK draws it
  /// @param reason receives why a cut-out is not supported; then the mask is null
  TextureCutout find(
    vtkActor* actor, vtkMapper* mapper, vtkInformation* keys, bool wantsAlpha, const char*& reason);

  /// Return the bytes of memory of the masks.
  std::size_t bytes() const;

private:
  /// A texture's mask at a time. The pointer to the texture is never dereferenced.
  struct Known
  {
    vtkMTimeType time = 0;
    std::shared_ptr<const CutoutMask> mask, alpha; ///< as in TextureCutout; one if they are alike
    bool tooLarge = false;
    bool asked = false;
  };
  const Known& known(vtkTexture* texture);

  std::unordered_map<const vtkTexture*, Known> known_;
};

/// Return the array of a surface's coordinates for a texture; null if VTK has none and draws
/// without the texture.
vtkDataArray* textureCoordinates(vtkMapper* mapper, const std::string& texture, vtkPolyData* data);

} // namespace gnomon
