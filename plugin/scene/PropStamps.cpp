#include "plugin/scene/PropStamps.h"

#include "lights/Hash.h"
#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/MapperKind.h"
#include "plugin/vtkGnomonPropKeys.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkLODProp3D.h"
#include "vtkMapper2D.h"
#include "vtkMatrix4x4.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointGaussianMapper.h"
#include "vtkProp3DFollower.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkShaderProperty.h"
#include "vtkTextActor.h"
#include "vtkTextActor3D.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

namespace gnomon
{
namespace
{

bool isOneOf(vtkObjectBase* object, std::initializer_list<const char*> classes)
{
  return std::any_of(classes.begin(), classes.end(),
    [own = object->GetClassName()](const char* name) { return std::strcmp(name, own) == 0; });
}

/// Asks each kind of prop and mapper what it draws from. An object that gets another part gets
/// another time, so times tell of all changes. Places are values, because VTK sets those of parts
/// while it draws the whole.
class Stamper
{
public:
  explicit Stamper(vtkRenderer* renderer)
    : renderer_(renderer)
  {
  }
  void addViewProp(vtkProp* prop);
  void addTexture(vtkTexture* texture);

  PropStamp stamp;

private:
  template <typename Value>
  void add(const Value& value)
  {
    hashCombine(this->stamp.hash, value);
  }
  /// Add objects, which may be null, with their times.
  template <typename... Objects>
  void addObjects(Objects*... objects)
  {
    ((this->add(objects), this->add(objects ? objects->GetMTime() : 0)), ...);
  }
  void addElements(const double* elements, int count)
  {
    std::for_each(elements, elements + count, [this](double element) { this->add(element); });
  }
  void addKeys(vtkProp* prop);
  void addLeaf(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addActor(vtkActor* actor, vtkMatrix4x4* matrix);
  void addAnnotation(vtkActor2D* annotation);
  void addInnerProps(vtkProp* prop);
  void addLook(vtkProperty* property);
  void addSurfaces(vtkMapper* mapper);
  void addMapper(vtkAbstractMapper* mapper, bool isStatic = false);
  void addData(vtkAlgorithm* consumer, bool isStatic = false);

  vtkRenderer* renderer_;
};

void Stamper::addViewProp(vtkProp* prop)
{
  this->addKeys(prop);
  if (isPlainActor(prop) ||
    (!prop->IsA("vtkAssembly") && !prop->IsA("vtkPropAssembly") && !prop->IsA("vtkImageStack")))
  {
    this->addLeaf(prop, prop->GetMatrix());
    return;
  }
  prop->InitPathTraversal();
  while (vtkAssemblyPath* const path = prop->GetVisibility() ? prop->GetNextPath() : nullptr)
  {
    vtkCollectionSimpleIterator iterator;
    path->InitTraversal(iterator);
    while (vtkAssemblyNode* const node = path->GetNextNode(iterator))
    {
      this->addKeys(node->GetViewProp());
    }
    this->addLeaf(path->GetLastNode()->GetViewProp(), path->GetLastNode()->GetMatrix());
  }
}

/// Add what a prop hands down to its parts. VTK changes the time of the keys in every frame.
void Stamper::addKeys(vtkProp* prop)
{
  this->add(prop);
  this->add(prop->GetVisibility());
  this->add(keysOf(prop));
  if (vtkInformation* const keys = prop->GetPropertyKeys())
  {
    vtkInformationDoubleVectorKey* const transform = vtkProp::GeneralTextureTransform();
    this->addElements(keys->Get(transform), keys->Length(transform));
  }
}

/// @param matrix of the leaf's path; null if it has none
void Stamper::addLeaf(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  if (!leaf->GetVisibility())
  {
    return;
  }
  if (matrix)
  {
    this->addElements(matrix->GetData(), 16);
  }
  if (auto* actor = vtkActor::SafeDownCast(leaf))
  {
    this->addActor(actor, matrix ? matrix : actor->GetMatrix());
  }
  else if (auto* levels = vtkLODProp3D::SafeDownCast(leaf))
  {
    if (vtkProp3D* const level = selectedLevel(levels))
    {
      this->add<vtkProp*>(level);
      this->addLeaf(level, matrix);
    }
  }
  else if (auto* follower = vtkProp3DFollower::SafeDownCast(leaf))
  {
    follower->GetBounds(); // places the followed prop, as VTK does before drawing
    if (follower->GetProp3D())
    {
      this->addViewProp(follower->GetProp3D());
    }
  }
  else if (auto* slice = vtkImageSlice::SafeDownCast(leaf))
  {
    this->add(slice->GetForceTranslucent());
    this->addObjects(slice->GetProperty());
    this->addMapper(slice->GetMapper());
  }
  else if (auto* volume = vtkVolume::SafeDownCast(leaf))
  {
    this->addObjects(volume->GetProperty(), volume->GetShaderProperty());
    this->addMapper(volume->GetMapper());
  }
  else if (auto* annotation = vtkActor2D::SafeDownCast(leaf))
  {
    this->addAnnotation(annotation);
  }
  else if (auto* text = vtkTextActor3D::SafeDownCast(leaf))
  {
    this->addObjects(text, text->GetTextProperty());
  }
  else if (auto* label = vtkBillboardTextActor3D::SafeDownCast(leaf))
  {
    this->addObjects(label, label->GetTextProperty());
  }
  else
  {
    this->addInnerProps(leaf);
  }
  if (!isOneOf(leaf,
        { "vtkOpenGLActor", "vtkFollower", "vtkLODActor", "vtkQuadricLODActor", "vtkOpenGLSkybox",
          "vtkLODProp3D", "vtkProp3DFollower", "vtkImageSlice", "vtkImageActor", "vtkVolume",
          "vtkActor2D", "vtkTexturedActor2D", "vtkOpenGLTextActor", "vtkScalarBarActor",
          "vtkOpenGLTextActor3D", "vtkOpenGLBillboardTextActor3D" }))
  {
    this->add(leaf->GetRedrawMTime()); // which may leave out changes
    this->stamp.unknown = leaf->GetClassName();
  }
}

void Stamper::addActor(vtkActor* actor, vtkMatrix4x4* matrix)
{
  this->add(actor->GetForceOpaque());
  this->add(actor->GetForceTranslucent());
  this->addLook(actor->GetProperty());
  this->addLook(actor->GetBackfaceProperty());
  this->addTexture(actor->GetTexture());
  this->addObjects(actor->GetShaderProperty());
  if (vtkMapper* const mapper = actor->GetMapper())
  {
    this->addSurfaces(mapper);
    vtkMapper* const drawn = actorDrawing(actor, matrix, this->renderer_).mapper;
    if (drawn && drawn != mapper)
    {
      this->addSurfaces(drawn); // a level of detail
    }
  }
}

void Stamper::addAnnotation(vtkActor2D* annotation)
{
  this->addObjects(annotation);
  this->addMapper(annotation->GetMapper());
  if (auto* textured = vtkTexturedActor2D::SafeDownCast(annotation))
  {
    this->addTexture(textured->GetTexture());
  }
  if (auto* text = vtkTextActor::SafeDownCast(annotation))
  {
    this->addObjects(text->GetTextProperty());
  }
  if (auto* bar = vtkScalarBarActor::SafeDownCast(annotation))
  {
    this->addObjects(bar->GetLookupTable(), bar->GetTitleTextProperty(),
      bar->GetLabelTextProperty(), bar->GetAnnotationTextProperty(), bar->GetBackgroundProperty(),
      bar->GetFrameProperty());
  }
}

/// Add the props by which one of unknown kind draws, as far as it tells of them.
void Stamper::addInnerProps(vtkProp* prop)
{
  vtkNew<vtkPropCollection> parts;
  prop->GetActors(parts);
  prop->GetVolumes(parts);
  vtkCollectionSimpleIterator iterator;
  parts->InitTraversal(iterator);
  while (vtkProp* const part = parts->GetNextProp(iterator))
  {
    if (part != prop)
    {
      this->addLeaf(part, part->GetMatrix());
    }
  }
}

void Stamper::addLook(vtkProperty* property)
{
  this->addObjects(property);
  if (property)
  {
    for (const auto& [name, texture] : property->GetAllTextures())
    {
      this->addTexture(texture);
    }
  }
}

void Stamper::addTexture(vtkTexture* texture)
{
  this->addObjects(texture);
  if (texture)
  {
    this->addObjects(texture->GetLookupTable(), texture->GetTransform());
    this->addData(texture);
  }
}

/// Add an actor's mapper.
void Stamper::addSurfaces(vtkMapper* mapper)
{
  this->addMapper(mapper, mapper->GetStatic());
  const MapperKind kind = kindOf(mapper);
  if (kind == MapperKind::Glyphs)
  {
    this->addObjects(static_cast<vtkGlyph3DMapper*>(mapper)->GetBlockAttributes());
  }
  else if (kind == MapperKind::Splats)
  {
    auto* const splats = static_cast<vtkPointGaussianMapper*>(mapper);
    this->addObjects(splats->GetScaleFunction(), splats->GetScalarOpacityFunction());
  }
  else if (kind == MapperKind::Other)
  {
    this->stamp.unknown = mapper->GetClassName();
  }
}

/// @param mapper may be null
/// @param isStatic true if VTK does not update its input
void Stamper::addMapper(vtkAbstractMapper* mapper, bool isStatic)
{
  this->addObjects(mapper);
  if (!mapper)
  {
    return;
  }
  vtkPlaneCollection* const planes = mapper->GetClippingPlanes();
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    this->addObjects(planes->GetItem(i));
  }
  this->addData(mapper, isStatic);
}

/// Add the data on all inputs, brought up to date as VTK does when it draws. A composite data set's
/// time leaves out its blocks'.
void Stamper::addData(vtkAlgorithm* consumer, bool isStatic)
{
  for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < consumer->GetNumberOfInputConnections(port); ++i)
    {
      int output = 0;
      vtkAlgorithm* const producer = consumer->GetInputAlgorithm(port, i, output);
      if (!isStatic && !producer->IsA("vtkTrivialProducer"))
      {
        producer->Update(output);
      }
      vtkDataObject* const data = consumer->GetInputDataObject(port, i);
      this->addObjects(data);
      if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
      {
        const auto blocks =
          vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
        for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
        {
          this->addObjects(blocks->GetCurrentDataObject());
        }
      }
    }
  }
}

} // namespace

int keysOf(vtkProp* prop)
{
  return (vtkGnomonPropKeys::GetCasts(prop) ? 1 : 0) +
    (vtkGnomonPropKeys::GetReceives(prop) ? 2 : 0) +
    (vtkGnomonPropKeys::GetOneSided(prop) ? 4 : 0) +
    (vtkGnomonPropKeys::GetShadowCatcher(prop) ? 8 : 0);
}

PropStamp stampOf(vtkProp* prop, vtkRenderer* renderer)
{
  Stamper stamper(renderer);
  stamper.addViewProp(prop);
  return stamper.stamp;
}

void hashTexture(std::size_t& seed, vtkTexture* texture)
{
  Stamper stamper(nullptr);
  stamper.addTexture(texture);
  hashCombine(seed, stamper.stamp.hash);
}

} // namespace gnomon
