#include "plugin/scene/MapperKind.h"

#include "plugin/scene/SplatSpheres.h"
#include "plugin/vtk_versions/CompositeMappers.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkGlyph3DMapper.h"
#include "vtkInformation.h"
#include "vtkMapper.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon
{

MapperKind kindOf(vtkMapper* mapper)
{
  if (std::strcmp(mapper->GetClassName(), "vtkOpenGLPolyDataMapper") == 0)
  {
    return MapperKind::PlainPolyData;
  }
  const BlockDrawing blocks = blockDrawing(mapper);
  if (blocks != BlockDrawing::None)
  {
    return blocks == BlockDrawing::Shared ? MapperKind::Composite : MapperKind::Parts;
  }
  if (mapper->IsA("vtkPolyDataMapper"))
  {
    const bool solids = mapper->IsA("vtkOpenGLSphereMapper") || mapper->IsA("vtkOpenGLStickMapper");
    return solids                             ? MapperKind::Solids
      : mapper->IsA("vtkPointGaussianMapper") ? MapperKind::Splats
                                              : MapperKind::PolyData;
  }
  return mapper->IsA("vtkDataSetMapper")     ? MapperKind::DataSet
    : mapper->IsA("vtkGlyph3DMapper")        ? MapperKind::Glyphs
    : mapper->IsA("vtkOpenGLMoleculeMapper") ? MapperKind::Molecule
                                             : MapperKind::Other;
}

bool drawnAsSurface(vtkProperty* property, vtkMapper* mapper)
{
  if (property->GetRepresentation() == VTK_SURFACE)
  {
    return true;
  }
  const MapperKind kind = kindOf(mapper);
  return kind == MapperKind::Solids || kind == MapperKind::Molecule || kind == MapperKind::Splats;
}

bool isSeenThrough(vtkActor* actor)
{
  return actor->GetForceOpaque() &&
    (actor->GetProperty()->GetOpacity() < 1.0 ||
      (actor->GetMapper() && actor->GetMapper()->HasTranslucentPolygonalGeometry()));
}

bool hasOwnFramebuffer(vtkMapper* mapper)
{
  constexpr std::array<const char*, 3> classes = { "vtkSurfaceLICMapper",
    "vtkCompositeSurfaceLICMapper", "vtkOpenGLSurfaceProbeVolumeMapper" };
  return std::strcmp(mapper->GetClassName(), "vtkOpenGLPolyDataMapper") != 0 &&
    std::any_of(
      classes.begin(), classes.end(), [mapper](const char* name) { return mapper->IsA(name); });
}

bool mayMoveVertices(vtkActor* actor)
{
  vtkShaderProperty* code = actor->GetShaderProperty();
  bool may = code->HasVertexShaderCode() || code->HasGeometryShaderCode();
  for (int i = 0; i < code->GetNumberOfShaderReplacements(); ++i)
  {
    may = may || code->GetNthShaderReplacementTypeAsString(i) != "Fragment";
  }
  return may;
}

bool showsLight(vtkProperty* property)
{
  return property->GetLighting() &&
    (property->GetInterpolation() == VTK_PBR || property->GetDiffuse() > 0.0 ||
      property->GetSpecular() > 0.0);
}

void runInput(vtkMapper* mapper, MapperKind kind)
{
  if (kind != MapperKind::PlainPolyData && kind != MapperKind::PolyData &&
    kind != MapperKind::Composite && kind != MapperKind::Solids)
  {
    mapper->Update(); // all of its inputs
    return;
  }
  // A trivial producer holds data that was set by hand, so there is no filter to run.
  vtkAlgorithm* input = mapper->GetInputAlgorithm();
  if (input->IsA("vtkTrivialProducer"))
  {
    return;
  }
  if (kind != MapperKind::Composite)
  {
    auto* polyDataMapper = static_cast<vtkPolyDataMapper*>(mapper);
    input->UpdateInformation();
    vtkInformation* information = mapper->GetInputInformation();
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    information->Set(Pipeline::UPDATE_PIECE_NUMBER(), polyDataMapper->GetPiece());
    information->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), polyDataMapper->GetNumberOfPieces());
    information->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), polyDataMapper->GetGhostLevel());
  }
  input->Update();
}

const char* reasonAgainst(vtkMapper* mapper, MapperKind kind)
{
  if (kind == MapperKind::Other)
  {
    return "mapper not served";
  }
  if (kind == MapperKind::Splats)
  {
    return reasonAgainstSplats(static_cast<vtkPointGaussianMapper*>(mapper));
  }
  if (kind == MapperKind::Glyphs)
  {
    return static_cast<vtkGlyph3DMapper*>(mapper)->GetCullingAndLOD()
      ? "glyphs are culled and simplified on the GPU"
      : nullptr;
  }
  auto* polyDataMapper = vtkPolyDataMapper::SafeDownCast(mapper);
  return polyDataMapper && polyDataMapper->GetNumberOfSubPieces() > 1
    ? "input drawn in several pieces"
    : nullptr;
}

std::vector<glm::dvec4> clipPlanesOf(vtkAbstractMapper* mapper)
{
  constexpr int mostPlanes = 6;
  std::vector<glm::dvec4> planes;
  const int count = std::min<int>(mapper->GetNumberOfClippingPlanes(), mostPlanes);
  for (int i = 0; i < count; ++i)
  {
    vtkPlane* plane = mapper->GetClippingPlanes()->GetItem(i);
    const glm::dvec3 normal = glm::make_vec3(plane->GetNormal());
    planes.emplace_back(normal, -glm::dot(normal, glm::make_vec3(plane->GetOrigin())));
  }
  return planes;
}

} // namespace gnomon
