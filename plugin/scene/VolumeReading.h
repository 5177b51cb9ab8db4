#pragma once

#include "lights/vtkGnomonVersions.h"
#include "shadowtech/base/Volume.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkImageData;
class vtkMatrix4x4;
class vtkVolume;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Reads volumes that cast, and caches them while they are in use.
class VolumeReading
{
public:
  /// Begin a frame: drop volumes that nothing asked for since the last call.
  void beginFrame();

  /// Read a volume, after updating its mapper's input, as VTK does when it draws. The same pointers
  /// are the same volumes.
  /// @param matrix from the volume's to world coordinates
  /// @param why set to the reason, as a clause, if the volume cannot cast
  /// @return one for each block; none if it cannot cast, or has nothing to draw
  std::vector<std::shared_ptr<const Volume>> find(
    vtkVolume* volume, vtkMatrix4x4* matrix, const char*& why);

  std::size_t bytes() const;

private:
  struct Known
  {
    std::vector<double> source; ///< times and values that the volume was read from
    vtkSmartPointer<vtkDataArray> array;
    std::shared_ptr<const Volume> volume;
    bool asked = false;
  };
  std::shared_ptr<const Volume> findBlock(
    vtkVolume* volume, vtkMatrix4x4* matrix, vtkImageData* data, std::size_t block);

  /// By volume and number of the block. The pointer is only an identity and is never dereferenced.
  std::map<std::pair<const vtkVolume*, std::size_t>, Known> known_;
};

} // namespace gnomon
