#ifndef gnomon_tests_unit_plugin_MapLayout_h
#define gnomon_tests_unit_plugin_MapLayout_h

#include "PassScene.h"

#include "shadowtech/Registry.h"

#include <ostream>
#include <string>
#include <utility>

namespace gnomon::test
{

/// A technique and a way to lay out its map, as settings.
struct MapLayout
{
  const char* technique;
  const char* projection = "technique";
  const char* fit = "off";
  const char* snap = "on";
  const char* blur = "box";
  const char* mipMaps = "off";

  void choose(PassScene& scene) const
  {
    const TechniqueInfo& info = findTechnique(this->technique)->estimator->info;
    scene.pass->SetTechnique(this->technique);
    for (const auto& [name, value] :
      { std::pair("projection", this->projection), { "fit", this->fit }, { "snap", this->snap },
        { "blur", this->blur }, { "mip_maps", this->mipMaps } })
    {
      if (has(info, name))
      {
        scene.pass->SetSetting(name, value);
      }
    }
  }
  /// Warps and splits are for lights with a single view.
  bool takesCubes() const
  {
    const std::string name = this->projection;
    return name == "uniform" ||
      (name == "technique" && findTechnique(this->technique)->projection == Projection::Uniform);
  }
  /// What differs from the defaults: "nsm_frame_unsnapped".
  std::string name() const
  {
    const MapLayout plain{ this->technique };
    std::string text = this->technique;
    text +=
      this->projection == std::string(plain.projection) ? "" : "_" + std::string(this->projection);
    text += this->fit == std::string(plain.fit) ? "" : "_" + std::string(this->fit);
    text += this->snap == std::string(plain.snap) ? "" : "_unsnapped";
    text += this->blur == std::string(plain.blur) ? "" : "_" + std::string(this->blur);
    text += this->mipMaps == std::string(plain.mipMaps) ? "" : "_levels";
    return text;
  }
};

inline std::ostream& operator<<(std::ostream& stream, const MapLayout& layout)
{
  return stream << layout.name();
}

} // namespace gnomon::test

#endif
