#pragma once

#include "lights/vtkGnomonVersions.h"
#include "shadowtech/base/Sheet.h"

#include "vtkType.h"

#include <cstdint>
#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct DrawnActor;
struct DrawnBlock;
struct DrawnProp;
struct Surface;
struct SurfaceRecord;

/// Source of a surface's sheet.
struct SheetSource
{
  int transmits = 0; ///< vtkGnomonPropKeys::TransmitsType
  int prop = -1;     ///< DrawnProp::number
  std::uint64_t topologyVersion = 0;
  vtkMTimeType propertyTime = 0;
  vtkMTimeType colourTime = 0; ///< of mapper and data

  bool operator==(const SheetSource& other) const
  {
    return this->transmits == other.transmits && this->prop == other.prop &&
      this->topologyVersion == other.topologyVersion && this->propertyTime == other.propertyTime &&
      this->colourTime == other.colourTime;
  }
};

/// Return why a translucent actor must cast as if opaque, as a clause; null if its blocks can let
/// light through.
const char* whyNoSheet(const DrawnActor& drawn, const DrawnProp& prop);

/// Return the source of a surface's sheet; a default one if it lets no light through.
SheetSource sheetSource(const DrawnProp& prop, const DrawnBlock& block, const Surface& surface);

/// Read the colour and opacity with which VTK draws a surface.
/// @param record of the surface in the snapshot
std::shared_ptr<const Sheet> readSheet(const DrawnProp& prop, const DrawnBlock& block,
  const Surface& surface, const SurfaceRecord& record);

} // namespace gnomon
