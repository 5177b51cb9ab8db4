#include "SplitScene.h"

#include <vtkAppendPolyData.h>
#include <vtkCollectionRange.h>
#include <vtkIdList.h>
#include <vtkMPIController.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkTriangleFilter.h>

namespace gnomon::test
{
namespace
{

/// Runs MPI around all cases.
class Mpi : public testing::Environment
{
public:
  void SetUp() override
  {
    int argc = 0;
    char** argv = nullptr;
    this->controller_->Initialize(&argc, &argv);
    vtkMultiProcessController::SetGlobalController(this->controller_);
  }
  void TearDown() override
  {
    vtkMultiProcessController::SetGlobalController(nullptr);
    this->controller_->Finalize();
  }

private:
  vtkNew<vtkMPIController> controller_;
};

const testing::Environment* const mpi = testing::AddGlobalTestEnvironment(new Mpi);

int blockOf(vtkIdType triangle, vtkIdType triangles, int ranks)
{
  return static_cast<int>(triangle * ranks / std::max<vtkIdType>(triangles, 1));
}

/// Return a surface's triangles.
vtkSmartPointer<vtkPolyData> trianglesOf(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(surface);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  return filter->GetOutput();
}

/// Return a scene with other surfaces.
tool::Scene withSurfaces(
  tool::Scene scene, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& surfaceOf)
{
  for (tool::SceneModel& model : scene.models)
  {
    model.surface = surfaceOf(trianglesOf(model.surface));
  }
  return scene;
}

/// Return the triangles of a surface that one process has.
vtkSmartPointer<vtkPolyData> partOf(
  vtkPolyData* surface, const Distribution& distribution, int rank, int ranks)
{
  const vtkIdType triangles = surface->GetNumberOfPolys();
  const vtkIdType ghosts = distribution.hasGhosts ? triangles / 10 : 0;
  vtkNew<vtkPoints> points;
  points->SetDataType(surface->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> cells;
  vtkDataArray* const normals = surface->GetPointData()->GetNormals();
  vtkNew<vtkFloatArray> ownNormals;
  ownNormals->SetNumberOfComponents(3);
  std::vector<vtkIdType> taken(static_cast<std::size_t>(surface->GetNumberOfPoints()), -1);
  vtkNew<vtkIdList> corners;
  for (vtkIdType triangle = 0; triangle < triangles; ++triangle)
  {
    const bool isGhost = triangle >= ghosts &&
      distribution.rankOf(triangle - ghosts, triangles, ranks) == rank && ghosts > 0;
    if (distribution.rankOf(triangle, triangles, ranks) != rank && !isGhost)
    {
      continue;
    }
    surface->GetPolys()->GetCellAtId(triangle, corners);
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      vtkIdType& id = taken[static_cast<std::size_t>(corners->GetId(i))];
      if (id < 0)
      {
        id = points->InsertNextPoint(surface->GetPoint(corners->GetId(i)));
        if (normals)
        {
          ownNormals->InsertNextTuple(normals->GetTuple(corners->GetId(i)));
        }
      }
      corners->SetId(i, id);
    }
    cells->InsertNextCell(corners);
  }
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(points);
  part->SetPolys(cells);
  part->GetPointData()->SetNormals(normals ? ownNormals.Get() : nullptr);
  return part;
}

} // namespace

const Distribution blocks{ "blocks", blockOf };
const Distribution roundRobin{ "round_robin",
  [](vtkIdType triangle, vtkIdType, int ranks) { return static_cast<int>(triangle % ranks); } };
const Distribution byChance{ "random",
  [](vtkIdType triangle, vtkIdType, int ranks)
  {
    const auto mixed = static_cast<std::uint64_t>(triangle + 1) * 0x9e3779b97f4a7c15ull;
    return static_cast<int>((mixed >> 33) % static_cast<std::uint64_t>(ranks));
  } };
const Distribution blocksWithGhosts{ "ghosts", blockOf, true };
const Distribution wholes{ "wholes", [](vtkIdType, vtkIdType triangles, int ranks) {
                            return static_cast<int>(triangles / 2 % ranks);
                          } };

RankView::RankView(const tool::Scene& scene, int width, int height)
  : BuiltinPass(scene, width, height)
{
  // VTK shifts vertices of parts that are small and far from the origin, and so rounds depths
  // otherwise than those of the whole.
  for (vtkActor* actor : vtk::Range(this->renderer->GetActors()))
  {
    if (auto* mapper = vtkOpenGLPolyDataMapper::SafeDownCast(actor->GetMapper()))
    {
      mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    }
  }
  this->pass->SetTechnique("raytraced");
}

SplitScene::SplitScene(tool::Scene scene, const Distribution& distribution, int width, int height)
{
  const int ranks = controller()->GetNumberOfProcesses();
  const auto ownPart = [&](vtkPolyData* surface)
  { return partOf(surface, distribution, controller()->GetLocalProcessId(), ranks); };
  const auto allParts = [&](vtkPolyData* surface)
  {
    vtkNew<vtkAppendPolyData> all;
    for (int rank = 0; rank < ranks; ++rank)
    {
      all->AddInputData(partOf(surface, distribution, rank, ranks));
    }
    all->Update();
    return vtkSmartPointer<vtkPolyData>(all->GetOutput());
  };
  this->shared_ = std::make_unique<RankView>(withSurfaces(scene, ownPart), width, height);
  this->shared_->pass->SetController(controller());
  this->alone_ = std::make_unique<RankView>(withSurfaces(scene, allParts), width, height);
  // The range that the camera sees must not depend on the part.
  this->shared_->renderer->GetActiveCamera()->SetClippingRange(
    this->alone_->renderer->GetActiveCamera()->GetClippingRange());
}

void SplitScene::change(const std::function<void(vtkRenderer*)>& of)
{
  of(this->shared_->renderer);
  of(this->alone_->renderer);
}

void SplitScene::turnCamera(double degrees)
{
  this->change([=](vtkRenderer* renderer) { renderer->GetActiveCamera()->Azimuth(degrees); });
}

void SplitScene::smooth(const char* edgeSamples)
{
  this->shared_->pass->SetSetting("edge_samples", edgeSamples);
  this->alone_->pass->SetSetting("edge_samples", edgeSamples);
}

void SplitScene::smoothTerminators(bool smooth)
{
  this->shared_->pass->SetSmoothTerminators(smooth);
  this->alone_->pass->SetSmoothTerminators(smooth);
}

std::size_t SplitScene::mixedPixels() const
{
  std::size_t mixed = 0;
  for (const std::vector<float>& visibility : this->shared_->pass->GetVisibility().visibility)
  {
    mixed += countBetween(visibility);
  }
  return mixed;
}

std::size_t SplitScene::expectSame()
{
  const VisibilityImages& shared = this->shared_->draw();
  const VisibilityImages& alone = this->alone_->draw();
  EXPECT_EQ(this->shared_->report().route, "image") << this->shared_->report().routeReason;
  EXPECT_FALSE(alone.visibility.empty());
  EXPECT_EQ(shared.sceneIndices, alone.sceneIndices);
  const auto isSameReceiver = [&](std::size_t pixel)
  {
    return shared.coverage[pixel] == alone.coverage[pixel] &&
      (shared.coverage[pixel] == 0.0f || positionOf(shared, pixel) == positionOf(alone, pixel)) &&
      normalOf(shared, pixel) == normalOf(alone, pixel);
  };
  std::int64_t otherReceivers = 0;
  std::size_t wrong = 0;
  for (std::size_t pixel = 0; pixel < alone.coverage.size(); ++pixel)
  {
    if (!isSameReceiver(pixel))
    {
      ++otherReceivers;
      continue;
    }
    for (std::size_t light = 0; light < alone.visibility.size(); ++light)
    {
      wrong += shared.visibility[light][pixel] != alone.visibility[light][pixel] ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0u);
  // OpenGL decides equal depths by the order in which triangles are drawn.
  EXPECT_LE(otherReceivers, this->shared_->report().depthTies);
  EXPECT_LE(this->shared_->report().depthTies, 40);
  std::size_t dark = 0;
  for (const std::vector<float>& visibility : shared.visibility)
  {
    dark += static_cast<std::size_t>(
      std::count_if(visibility.begin(), visibility.end(), [](float v) { return v < 0.5f; }));
  }
  return dark;
}

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

} // namespace gnomon::test
