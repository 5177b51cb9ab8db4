#pragma once

#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <map>
#include <string>

namespace gnomon::tool
{

/// A material of an .mtl file.
struct Material
{
  vtkSmartPointer<vtkProperty> property;
  vtkSmartPointer<vtkTexture> texture; ///< may be null
};

/// Read diffuse and specular colour, opacity and diffuse texture (Kd, Ks, Ns, d, Tr, map_Kd) of a
/// material library. Other statements have no counterpart and are skipped.
/// @throws BadInput
std::map<std::string, Material> readMaterials(const std::string& path);

} // namespace gnomon::tool
