#pragma once

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/SurfaceRecord.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace gnomon
{

/// One surface of the snapshot after this frame.
struct WantedSurface
{
  SurfaceKey key;
  DrawnBlock block;
  const DrawnProp* prop;
  std::size_t old = none;              ///< its present index in the snapshot
  std::unique_ptr<FreshSurface> fresh; ///< set until it is put into the snapshot

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

/// List the surfaces of drawn props, each with its index in the snapshot if it is there already.
///
/// @param drawn must outlive the list
/// @param records of the snapshot's surfaces
std::vector<WantedSurface> wantedSurfaces(
  const DrawnProps& drawn, const std::vector<SurfaceRecord>& records);

} // namespace gnomon
