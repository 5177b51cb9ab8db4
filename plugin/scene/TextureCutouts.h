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

/// What VTK cuts out of an actor's surface by a texture.
struct TextureCutout
{
  std::shared_ptr<const CutoutMask> mask; ///< null where nothing is cut out
  std::string texture;                    ///< its name in VTK's shader
  glm::mat4 transform{ 1.0f };            ///< of its texture coordinates (s, t, 0, 1)
};

/// Reads the alpha of textures, and keeps what it read while it is asked for.
class TextureCutouts
{
public:
  /// Begins a frame: what was not asked for since the last call is forgotten.
  void beginFrame();

  /// What VTK cuts out of an actor's surface. VTK may call the surface opaque all the same: where
  /// no texel is half transparent, and with any albedo texture. Brings the texture's input up to
  /// date, as VTK does when it draws.
  ///
  /// @param keys those that the actor has while it is drawn
  /// @param reason set where a cut-out is not served, to the reason; the mask is null then
  TextureCutout find(vtkActor* actor, vtkMapper* mapper, vtkInformation* keys, const char*& reason);

  /// Memory of the masks.
  std::size_t bytes() const;

private:
  /// A texture's mask as of a time; the pointer to the texture names, it is not followed.
  struct Known
  {
    vtkMTimeType time = 0;
    std::shared_ptr<const CutoutMask> mask;
    bool tooLarge = false;
    bool asked = false;
  };
  const Known& known(vtkTexture* texture);

  std::unordered_map<const vtkTexture*, Known> known_;
};

/// The array that holds a surface's coordinates of a texture; null where VTK has none, and draws
/// without the texture.
vtkDataArray* textureCoordinates(vtkMapper* mapper, const std::string& texture, vtkPolyData* data);

} // namespace gnomon
