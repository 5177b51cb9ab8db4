#pragma once

#include "SyntheticScene.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::test
{

/// Return the mesh of a Wavefront file; polygons are fanned.
inline Mesh readObj(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error("cannot read " + path);
  }
  Mesh mesh;
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v")
    {
      glm::dvec3 point;
      words >> point.x >> point.y >> point.z;
      mesh.points.push_back(point);
    }
    else if (kind == "f")
    {
      std::vector<unsigned int> corners;
      for (std::string corner; words >> corner;)
      {
        corners.push_back(static_cast<unsigned int>(std::stoul(corner)) - 1);
      }
      for (std::size_t i = 2; i < corners.size(); ++i)
      {
        mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
      }
    }
  }
  return mesh;
}

} // namespace gnomon::test
