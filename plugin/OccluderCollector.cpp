#include "plugin/OccluderCollector.h"
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkMapper.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkMatrix4x4.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <map>
namespace gnomon
{
struct OccluderCollector::Impl
{
  Occluders occluders;
  std::vector<DrawnSurface> drawn;
  std::map<vtkAbstractMapper*, int> index;
};
OccluderCollector::OccluderCollector() : impl_(new Impl) {}
OccluderCollector::~OccluderCollector() = default;
OccluderCollector::Change OccluderCollector::collect(vtkRenderer* ren) {
  auto& o = impl_->occluders; if (o.topologyVersion) return {};
  auto* ac = ren->GetActors(); ac->InitTraversal();
  while (auto* a = ac->GetNextActor()) {
    auto* pd = vtkPolyData::SafeDownCast(a->GetMapper()->GetInputDataObject(0,0));
    Surface s; s.firstVertex=o.positionsCentred.size(); s.firstTriangle=o.triangles.size(); s.topologyVersion=s.positionsVersion=1;
    for (vtkIdType i=0;i<pd->GetNumberOfPoints();i++){ double p[4]; pd->GetPoint(i,p); p[3]=1; a->GetMatrix()->MultiplyPoint(p,p); glm::vec3 q(p[0],p[1],p[2]); o.positionsCentred.push_back(q); o.castersCentred.add(glm::dvec3(q)); }
    auto it=vtk::TakeSmartPointer(pd->GetPolys()->NewIterator()); for(it->GoToFirstCell();!it->IsDoneWithTraversal();it->GoToNextCell()){ vtkIdType n; const vtkIdType* c; it->GetCurrentCell(n,c); for(int k=1;k+1<n;k++) o.triangles.push_back({s.firstVertex+c[0],s.firstVertex+c[k],s.firstVertex+c[k+1]}); }
    s.vertexCount=o.positionsCentred.size()-s.firstVertex; s.triangleCount=o.triangles.size()-s.firstTriangle; 
    impl_->index[a->GetMapper()]=impl_->drawn.size(); impl_->drawn.push_back({{{0,s.triangleCount,(uint32_t)o.surfaces.size()}}}); o.surfaces.push_back(s);
  }
  o.positionsCentred.reserve(o.positionsCentred.size()+1);
  o.allCentred=o.castersCentred; o.topologyVersion=o.positionsVersion=1; return {}; }
const Occluders& OccluderCollector::occluders() const { return impl_->occluders; }
OccluderCollector::Drawn OccluderCollector::drawn(vtkAbstractMapper* m, vtkProp*) { auto i=impl_->index.find(m); return i==impl_->index.end()?Drawn{}:Drawn{i->second,true}; }
const std::vector<DrawnSurface>& OccluderCollector::drawnSurfaces() const { return impl_->drawn; }
}
