#include "Shapes.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>

namespace gnomon::test
{

vtkSmartPointer<vtkPlaneSource> planeOf(
  const glm::dvec3& origin, const glm::dvec3& point1, const glm::dvec3& point2, int cells)
{
  const auto plane = vtkSmartPointer<vtkPlaneSource>::New();
  plane->SetOrigin(origin.x, origin.y, origin.z);
  plane->SetPoint1(point1.x, point1.y, point1.z);
  plane->SetPoint2(point2.x, point2.y, point2.z);
  plane->SetResolution(cells, cells);
  return plane;
}

vtkSmartPointer<vtkPlaneSource> squareOf(double extent, double z, int cells)
{
  return planeOf({ -extent, -extent, z }, { extent, -extent, z }, { -extent, extent, z }, cells);
}

vtkSmartPointer<vtkCubeSource> boxOf(const glm::dvec3& lower, const glm::dvec3& upper)
{
  const auto box = vtkSmartPointer<vtkCubeSource>::New();
  box->SetBounds(lower.x, upper.x, lower.y, upper.y, lower.z, upper.z);
  return box;
}

vtkSmartPointer<vtkSphereSource> ballOf(
  const glm::dvec3& centre, double radius, int thetaResolution, int phiResolution)
{
  const auto ball = vtkSmartPointer<vtkSphereSource>::New();
  ball->SetCenter(centre.x, centre.y, centre.z);
  ball->SetRadius(radius);
  ball->SetThetaResolution(thetaResolution);
  ball->SetPhiResolution(phiResolution);
  return ball;
}

vtkSmartPointer<vtkPolyData> outputOf(vtkAlgorithm* source)
{
  source->Update();
  return vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPolyData> copyOf(vtkAlgorithm* source)
{
  const auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(outputOf(source));
  return copy;
}

vtkSmartPointer<vtkCellArray> cellsOf(const Cells& cells)
{
  const auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<vtkIdType>& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

vtkSmartPointer<vtkPolyData> meshOf(
  const std::vector<glm::dvec3>& points, const Cells& polygons, int dataType)
{
  vtkNew<vtkPoints> corners;
  corners->SetDataType(dataType);
  for (const glm::dvec3& point : points)
  {
    corners->InsertNextPoint(point.x, point.y, point.z);
  }
  const auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(corners);
  mesh->SetPolys(cellsOf(polygons));
  return mesh;
}

vtkSmartPointer<vtkMultiBlockDataSet> blocksOf(const std::vector<vtkDataObject*>& blocks)
{
  const auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* const block : blocks)
  {
    tree->SetBlock(tree->GetNumberOfBlocks(), block);
  }
  return tree;
}

void movePoints(vtkPolyData* mesh, const std::function<glm::dvec3(const glm::dvec3&)>& move)
{
  vtkPoints* const points = mesh->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 point;
    points->GetPoint(i, &point.x);
    point = move(point);
    points->SetPoint(i, &point.x);
  }
  points->Modified();
}

vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkAlgorithm* source)
{
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputConnection(source->GetOutputPort());
  return mapper;
}

vtkSmartPointer<vtkPolyDataMapper> mapperOf(vtkPolyData* data)
{
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  return mapper;
}

void clip(vtkAbstractMapper* mapper, const glm::dvec3& origin, const glm::dvec3& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.x, origin.y, origin.z);
  plane->SetNormal(normal.x, normal.y, normal.z);
  mapper->AddClippingPlane(plane);
}

vtkSmartPointer<vtkImageData> makeImage(
  int width, int height, const std::function<glm::dvec3(int, int)>& colourOf)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 3 * width * height; ++i)
  {
    const int x = i / 3 % width;
    const int y = i / 3 / width;
    image->SetScalarComponentFromDouble(x, y, 0, i % 3, 255.0 * colourOf(x, y)[i % 3]);
  }
  return image;
}

vtkSmartPointer<vtkImageData> makeVeil(
  int width, int height, const std::function<int(int, int)>& alphaOf)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int i = 0; i < 4 * width * height; ++i)
  {
    const int x = i / 4 % width;
    const int y = i / 4 / width;
    image->SetScalarComponentFromDouble(x, y, 0, i % 4, i % 4 == 3 ? alphaOf(x, y) : 255);
  }
  return image;
}

vtkSmartPointer<vtkTexture> textureOf(vtkImageData* image)
{
  const auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

void onEvent(vtkObject* object, unsigned long event, const std::function<void(void* data)>& call)
{
  using Call = std::function<void(void*)>;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Call(call));
  command->SetClientDataDeleteCallback([](void* data) { delete static_cast<Call*>(data); });
  command->SetCallback([](vtkObject*, unsigned long, void* function, void* data)
    { (*static_cast<Call*>(function))(data); });
  object->AddObserver(event, command);
}

} // namespace gnomon::test
