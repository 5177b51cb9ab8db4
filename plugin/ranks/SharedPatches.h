#pragma once

#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Patches.h"
#include "shadowtech/base/Receivers.h"

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

namespace gnomon
{

/// Names the patches (Patches) of surfaces whose parts several ranks have. Patches of one surface
/// that have a common edge, in any ranks, have one name.
class SharedPatches
{
public:
  /// Name the patches of all surfaces that some receivers' curves lie on, unless they have names;
  /// collective.
  /// @param names of the snapshot's surfaces
  /// @param own receivers of this rank
  /// @return false if no rank's receivers have curves
  bool update(Ranks& ranks, const Occluders& snapshot, const std::vector<SharedName>& names,
    const ReceiverPixels& own);

  /// Return the names as of the last update that returned true.
  const PatchNames& names() const { return this->names_; }
  std::size_t bytes() const;

private:
  void name(Ranks& ranks, const Occluders& snapshot, const std::vector<SharedName>& names);

  std::set<SharedName> asked_; ///< surfaces whose patches have names; the same on all ranks
  std::vector<std::shared_ptr<Patches>> patches_; ///< by surface; null for others
  std::uint64_t ranks_ = 0;                       ///< serial of the ranks that they are named for
  PatchNames names_;
};

} // namespace gnomon
