#ifndef gnomon_shadowtech_conservative_WeldedVertices_h
#define gnomon_shadowtech_conservative_WeldedVertices_h

#include "shadowtech/base/Occluders.h"

#include <cstdint>
#include <vector>

namespace gnomon
{

/// For each vertex of a surface, counted from its first, the first one at exactly the same place: surfaces
/// that are drawn are split where their normals or texture coordinates break.
std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface);

} // namespace gnomon

#endif
