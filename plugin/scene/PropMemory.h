#pragma once

#include "plugin/scene/ImageRectangles.h"
#include "plugin/scene/PlainProps.h"
#include "plugin/scene/PropStamps.h"
#include "plugin/scene/TextureCutouts.h"
#include "plugin/scene/VolumeReading.h"

#include <cstddef>

namespace gnomon
{

/// findDrawnProps()'s caches of a renderer's props.
struct PropMemory
{
  PlainProps plainProps;
  PropStamps stamps;
  TextureCutouts cutouts;
  ImageRectangles images;
  VolumeReading volumes;

  std::size_t bytes() const
  {
    return this->plainProps.bytes() + this->cutouts.bytes() + this->images.bytes() +
      this->volumes.bytes();
  }
};

} // namespace gnomon
