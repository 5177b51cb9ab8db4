#pragma once

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkImageData.h>
#include <vtkMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>

#include <glm/glm.hpp>

#include <functional>
#include <vector>

/// @file
/// VTK's sources, meshes, mappers and images in one expression.

namespace gnomon::test
{

///@{
/// Sources. A plane goes from its origin to two neighbouring corners, in cells by cells squares.
vtkSmartPointer<vtkPlaneSource> planeOf(
  const glm::dvec3& origin, const glm::dvec3& point1, const glm::dvec3& point2, int cells = 1);
vtkSmartPointer<vtkCubeSource> boxOf(const glm::dvec3& lower, const glm::dvec3& upper);
vtkSmartPointer<vtkSphereSource> ballOf(
  const glm::dvec3& centre, double radius, int thetaResolution = 8, int phiResolution = 8);
///@}
/// Return a square of half side `extent` around the z axis.
vtkSmartPointer<vtkPlaneSource> squareOf(double extent, double z = 0.0, int cells = 1);

/// Return a source's data, brought up to date.
vtkSmartPointer<vtkPolyData> outputOf(vtkAlgorithm* source);
/// Return a copy of a source's data, which a test may change.
vtkSmartPointer<vtkPolyData> copyOf(vtkAlgorithm* source);
/// Cells name their corners by number.
using Cells = std::vector<std::vector<vtkIdType>>;
vtkSmartPointer<vtkCellArray> cellsOf(const Cells& cells);
/// Return a mesh of polygons.
vtkSmartPointer<vtkPolyData> meshOf(
  const std::vector<glm::dvec3>& points, const Cells& polygons, int dataType = VTK_FLOAT);
/// Return composite data of these blocks.
vtkSmartPointer<vtkMultiBlockDataSet> blocksOf(const std::vector<vtkDataObject*>& blocks);
/// Replace each point of a mesh, and tell of it.
void movePoints(vtkPolyData* mesh, const std::function<glm::dvec3(const glm::dvec3&)>& move);

vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkAlgorithm* source);
vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkPolyData* data);
template <typename Actor = vtkActor>
vtkSmartPointer<Actor> actorOf(vtkMapper* mapper)
{
  const auto actor = vtkSmartPointer<Actor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// Cut off what lies behind a plane.
void clip(vtkAbstractMapper* mapper, const glm::dvec3& origin, const glm::dvec3& normal);

/// Make an image of three channels, texel by texel.
vtkSmartPointer<vtkImageData> makeImage(
  int width, int height, const std::function<glm::dvec3(int, int)>& colourOf);
/// Make a white image, whose alpha is from 0 to 255.
vtkSmartPointer<vtkImageData> makeVeil(
  int width, int height, const std::function<int(int, int)>& alphaOf);
vtkSmartPointer<vtkTexture> textureOf(vtkImageData* image);

/// Call a function at an event of an object, with the event's data.
void onEvent(vtkObject* object, unsigned long event, const std::function<void(void* data)>& call);

} // namespace gnomon::test
