#pragma once

#include "plugin/scene/ImageRectangles.h"
#include "plugin/scene/PropRecords.h"
#include "plugin/scene/TextureCutouts.h"
#include "plugin/scene/VolumeReading.h"

#include <cstddef>

namespace gnomon
{

/// findDrawnProps()'s caches of a renderer's props.
struct PropMemory
{
  PropRecords records;
  TextureCutouts cutouts;
  ImageRectangles images;
  VolumeReading volumes;

  std::size_t bytes() const
  {
    return this->records.bytes() + this->cutouts.bytes() + this->images.bytes() +
      this->volumes.bytes();
  }
};

} // namespace gnomon
