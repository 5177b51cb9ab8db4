#pragma once

#include "lights/vtkGnomonVersions.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkProp;
class vtkRenderer;
class vtkTexture;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A hash of all that a prop's picture depends on, beside the camera and the lights.
struct PropStamp
{
  std::size_t hash = 0; ///< the same number means the same picture
  /// The class of a prop or mapper of unknown kind: VTK's redraw time may miss its changes. Null if
  /// there is none.
  const char* unknown = nullptr;
};

/// Return a prop's keys of vtkGnomonPropKeys, as bits.
int keysOf(vtkProp* prop);

/// Stamp a prop by the times and values of all that VTK draws it from, down to the data. Updates
/// the pipelines first, as VTK does when it draws.
PropStamp stampOf(vtkProp* prop, vtkRenderer* renderer);

/// Add a texture with its pixels to a hash.
/// @param texture may be null
void hashTexture(std::size_t& seed, vtkTexture* texture);

/// Stamps props from frame to frame. What changes whenever VTK draws a prop, as the matrix of a
/// text that faces the camera, is no change of the prop: else nothing that refines would finish.
class PropStamps
{
public:
  /// Begin a frame: forget props that nothing asked for since the last call.
  void beginFrame();
  /// Begin a frame in which no prop has changed: keep all stamps.
  void keepAll() { this->due_.clear(); }

  /// Keep the last frame's stamp of a prop in this frame, if there is one: it has not changed.
  void keep(vtkProp* prop);

  /// Return a prop's stamp before it is drawn.
  std::size_t of(vtkProp* prop, vtkRenderer* renderer);

  /// End a frame, after VTK has drawn the props.
  void endFrame(vtkRenderer* renderer);

  /// Return a sentence for each kind of prop and mapper that is unknown.
  std::vector<std::string> notes() const;

private:
  struct Known
  {
    PropStamp last;                 ///< the last one found
    std::size_t stamp = 0;          ///< the last one whose change no drawing made but the first
    bool mayChangeInDrawing = true; ///< new, or changed by the last drawing
    bool wasDrawn = false;          ///< since it is new, or last changed
    bool asked = false;             ///< the stamp is this frame's
  };
  std::unordered_map<const vtkProp*, Known> known_;
  std::vector<vtkSmartPointer<vtkProp>> due_; ///< to be looked at after drawing
};

} // namespace gnomon
