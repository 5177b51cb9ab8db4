#include "plugin/scene/ImageRectangles.h"

#include "plugin/scene/ForgetUnasked.h"

#include "shadowtech/base/Bytes.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkImageSlice.h"
#include "vtkOpenGLImageSliceMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <array>

namespace gnomon
{
namespace
{

// The mapper's inner actor is a protected member. Naming it through a subclass gives access to it
// without a cast.
struct SliceMapperAccess : vtkOpenGLImageSliceMapper
{
  static vtkActor* actor(vtkOpenGLImageSliceMapper* mapper)
  {
    return mapper->*(&SliceMapperAccess::PolyDataActor);
  }
  static std::array<double, 12> corners(vtkOpenGLImageSliceMapper* mapper)
  {
    std::array<double, 12> corners;
    (mapper->*(&SliceMapperAccess::MakeTextureGeometry))(
      mapper->*(&SliceMapperAccess::DisplayExtent), corners.data(), nullptr);
    return corners;
  }
};

/// Return the triangles of vtkOpenGLImageSliceMapper::RenderPolygon.
vtkSmartPointer<vtkPolyData> makeRectangle()
{
  auto rectangle = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points; // floats, like the mapper's
  points->SetNumberOfPoints(4);
  rectangle->SetPoints(points);
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell({ 3, 0, 2 });
  triangles->InsertNextCell({ 2, 0, 1 });
  rectangle->SetPolys(triangles);
  return rectangle;
}

/// Move the corners if they differ.
void place(vtkPoints* points, const std::array<double, 12>& corners)
{
  bool moved = false;
  for (vtkIdType i = 0; i < 4; ++i)
  {
    const double* corner = &corners[static_cast<std::size_t>(3 * i)];
    for (int axis = 0; axis < 3; ++axis)
    {
      moved =
        moved || points->GetPoint(i)[axis] != static_cast<double>(static_cast<float>(corner[axis]));
    }
    points->SetPoint(i, corner);
  }
  if (moved)
  {
    points->Modified();
  }
}

} // namespace

void ImageRectangles::beginFrame()
{
  forgetUnasked(this->known_);
}

ImageRectangle ImageRectangles::find(vtkImageSlice* slice)
{
  auto* mapper = vtkOpenGLImageSliceMapper::SafeDownCast(slice->GetMapper());
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0)
  {
    return {};
  }
  mapper->Update();
  Known& known = this->known_[slice];
  if (!known.data)
  {
    known.data = makeRectangle();
  }
  known.asked = true;
  place(known.data->GetPoints(), SliceMapperAccess::corners(mapper));
  vtkActor* actor = SliceMapperAccess::actor(mapper);
  return { actor, static_cast<vtkPolyDataMapper*>(actor->GetMapper())->GetInput(), known.data };
}

std::size_t ImageRectangles::bytes() const
{
  return bytesOfTable(this->known_); // and a rectangle each
}

} // namespace gnomon
