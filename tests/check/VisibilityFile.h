#pragma once

#include "Scene.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gnomon::check
{

/// The contents of a visibility file; row 0 on top.
struct VisibilityFile
{
  int width = 0;  ///< in pixels
  int height = 0; ///< in pixels
  Vec3 origin{ 0.0 };
  std::map<std::string, std::vector<float>> channels;

  /// @throws std::runtime_error if the channel is missing
  const std::vector<float>& channel(const std::string& name) const;
  /// Read three channels: name.X, name.Y, name.Z.
  Vec3 vector(const std::string& name, std::size_t pixel) const;
};

/// @throws std::exception with a message that names the file
VisibilityFile readVisibilityFile(const std::string& path);

} // namespace gnomon::check
