#ifndef gnomon_shadowtech_Registry_h
#define gnomon_shadowtech_Registry_h

#include "shadowtech/base/Technique.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon
{

/// A technique's line in the registry.
struct RegistryEntry
{
  TechniqueInfo info;
  std::unique_ptr<Technique> (*create)();
};

/// All techniques, in the order in which they are listed to people.
const std::vector<RegistryEntry>& registry();

/// The entry of that name; nullptr when there is none.
const RegistryEntry* findTechnique(const std::string& name);

/// "nsm, raytraced, ...": for error messages.
std::string techniqueNames();

/// The technique of lights and passes that name none. Stated here and nowhere else.
inline constexpr const char* defaultTechnique = "nsm";

/// What shades translucent surfaces where a light's own technique works on the screen, which shows
/// only the opaque ones: a pointwise technique.
inline constexpr const char* plainTechnique = "nsm";

} // namespace gnomon

#endif
