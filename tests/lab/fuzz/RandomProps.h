#pragma once

#include "RandomSettings.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkProp3D.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <string>
#include <vector>

namespace gnomon::fuzz
{

/// Props of one kind.
struct RandomProps
{
  std::string kind;
  std::vector<vtkSmartPointer<vtkProp3D>> props;
};

/// Draw props that lie within a few units of the origin, most of them above z = 0.
RandomProps drawProps(Random& random);

/// The surface of one mesh of such props.
vtkSmartPointer<vtkPolyData> drawSurface(Random& random);

/// An image of random bytes.
vtkSmartPointer<vtkImageData> drawImage(Random& random, int width, int height, int components);

/// A texture with holes.
vtkSmartPointer<vtkTexture> drawHoles(Random& random);

} // namespace gnomon::fuzz
