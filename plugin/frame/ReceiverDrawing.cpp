#include "plugin/frame/ReceiverDrawing.h"

#include "lights/Hash.h"
#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/MapperKind.h"
#include "plugin/scene/PropRecords.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkCommand.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseVectorKey.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

namespace gnomon
{
namespace
{

/// While it lives, hides all render passes but one from a prop's shaders, since other passes may
/// write other outputs.
class WithoutOtherPasses
{
public:
  WithoutOtherPasses(vtkProp* prop, vtkObjectBase* pass)
    : keys_(prop->GetPropertyKeys())
  {
    if (this->keys_ && this->keys_->Length(vtkOpenGLRenderPass::RenderPasses()) > 1)
    {
      this->hidden_ = vtkSmartPointer<vtkInformation>::New();
      this->hidden_->CopyEntry(this->keys_, vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Remove(vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Append(vtkOpenGLRenderPass::RenderPasses(), pass);
    }
  }
  ~WithoutOtherPasses()
  {
    if (this->hidden_)
    {
      this->keys_->CopyEntry(this->hidden_, vtkOpenGLRenderPass::RenderPasses());
    }
  }
  WithoutOtherPasses(const WithoutOtherPasses&) = delete;
  WithoutOtherPasses& operator=(const WithoutOtherPasses&) = delete;

private:
  vtkInformation* keys_;
  vtkSmartPointer<vtkInformation> hidden_;
};

struct PropAccess : vtkProp
{
  /// Return null if a prop has none; vtkProp's own function would create one.
  static vtkShaderProperty* shaderProperty(vtkProp* prop)
  {
    return prop->*(&PropAccess::ShaderProperty);
  }
};

/// True if a mapper may have shaders that differ from VTK's template, as its class is not listed.
/// Derived classes write other outputs (vtkSurfaceLICMapper) or draw labels.
bool mayHaveOwnShaders(vtkMapper* mapper)
{
  constexpr std::array<const char*, 9> usual = { "vtkOpenGLPolyDataMapper", "vtkDataSetMapper",
    "vtkCompositePolyDataMapper", "vtkCompositePolyDataMapper2", "vtkOpenGLGlyph3DMapper",
    "vtkOpenGLMoleculeMapper", "vtkOpenGLSphereMapper", "vtkOpenGLStickMapper",
    "vtkOpenGLPointGaussianMapper" };
  return std::none_of(usual.begin(), usual.end(),
    [mapper](const char* name) { return std::strcmp(name, mapper->GetClassName()) == 0; });
}

/// Facts about the shaders of a prop's parts: if any part has it, the prop has it.
struct PartFacts
{
  bool ofUser = false;   ///< code of a user's own
  bool ofMapper = false; ///< mayHaveOwnShaders()
  bool physicallyBased = false;

  /// @param actor the part itself; null if it is of another class
  void add(vtkProp* part, vtkActor* actor)
  {
    vtkMapper* const mapper = actor ? actor->GetMapper() : nullptr;
    vtkShaderProperty* const code = PropAccess::shaderProperty(part);
    this->ofUser = this->ofUser ||
      (code &&
        (code->HasVertexShaderCode() || code->HasGeometryShaderCode() ||
          code->HasFragmentShaderCode() || code->GetNumberOfShaderReplacements() > 0)) ||
      (mapper && mapper->HasObserver(vtkCommand::UpdateShaderEvent));
    this->ofMapper = this->ofMapper || (mapper && mayHaveOwnShaders(mapper));
    this->physicallyBased =
      this->physicallyBased || (actor && actor->GetProperty()->GetInterpolation() == VTK_PBR);
  }
};

PartFacts factsOf(vtkProp* prop)
{
  PartFacts facts;
  if (isPlainActor(prop))
  {
    facts.add(prop, static_cast<vtkActor*>(prop));
    return facts;
  }
  vtkNew<vtkPropCollection> actors;
  prop->GetActors(actors);
  vtkCollectionSimpleIterator iterator;
  actors->InitTraversal(iterator);
  while (vtkProp* const part = actors->GetNextProp(iterator))
  {
    facts.add(part, vtkActor::SafeDownCast(part));
  }
  return facts;
}

bool isAssembly(vtkProp* prop)
{
  return !isPlainActor(prop) && (prop->IsA("vtkAssembly") || prop->IsA("vtkPropAssembly"));
}

/// True if render passes can add to the shaders of a prop without parts.
bool isLeafDrawnByPasses(vtkProp* leaf)
{
  if (isPlainActor(leaf))
  {
    vtkMapper* const mapper = static_cast<vtkActor*>(leaf)->GetMapper();
    return mapper && !hasOwnFramebuffer(mapper);
  }
  // These draw internal props without handing on their property keys.
  if (leaf->IsA("vtkAxisFollower") || leaf->IsA("vtkProp3DAxisFollower") ||
    leaf->IsA("vtkImageStack") || leaf->IsA("vtkSkybox"))
  {
    return false;
  }
  auto* actor = vtkActor::SafeDownCast(leaf);
  return actor
    ? actor->GetMapper() && !hasOwnFramebuffer(actor->GetMapper())
    : leaf->IsA("vtkImageSlice") || leaf->IsA("vtkLODProp3D") || leaf->IsA("vtkProp3DFollower");
}

} // namespace

bool hasOwnShaders(vtkProp* prop)
{
  return factsOf(prop).ofUser;
}

ShownProps readShownProps(const vtkRenderState* s, PropRecords& records)
{
  ShownProps shown;
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* const prop = s->GetPropArray()[i];
    vtkInformation* const keys = prop->GetPropertyKeys();
    const PartFacts facts = factsOf(prop);
    shown.ownShaders = shown.ownShaders || facts.ofUser || facts.ofMapper ||
      (keys && keys->Has(vtkOpenGLRenderPass::RenderPasses()));
    shown.physicallyBased = shown.physicallyBased || facts.physicallyBased;
    shown.partsOfBothKinds =
      shown.partsOfBothKinds || (isAssembly(prop) && drawnByPasses(prop) == ByPasses::Some);
    // Annotations, such as a text with the frame's time, do not change the receivers.
    if (isPlainActor(prop) || (!vtkActor2D::SafeDownCast(prop) && !vtkVolume::SafeDownCast(prop)))
    {
      hashCombine(shown.hash, records.stamp(prop, s->GetRenderer()));
      if (facts.ofUser)
      {
        static std::atomic<std::size_t> different{ 0 };
        hashCombine(shown.hash, ++different);
      }
    }
  }
  hashCombine(shown.hash, vtkMapper::GetResolveCoincidentTopology()); // no prop's time includes it
  return shown;
}

ByPasses drawnByPasses(vtkProp* prop)
{
  if (!isAssembly(prop))
  {
    return isLeafDrawnByPasses(prop) ? ByPasses::All : ByPasses::Nothing;
  }
  bool any = false;
  bool all = true;
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    const bool is = isLeafDrawnByPasses(path->GetLastNode()->GetViewProp());
    any = any || is;
    all = all && is;
  }
  return all ? ByPasses::All : any ? ByPasses::Some : ByPasses::Nothing;
}

void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target)
{
  // VTK draws here and tracks OpenGL's state, so state changes go through its copy.
  vtkRenderer* renderer = s->GetRenderer();
  vtkOpenGLState* state =
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const auto open = [&]
  {
    state->vtkglViewport(0, 0, size.x, size.y);
    state->vtkglScissor(0, 0, size.x, size.y);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglDepthFunc(GL_LEQUAL);
    state->vtkglEnable(GL_DEPTH_TEST);
  };
  open();
  target.begin(size.x, size.y, withPoints);
  state->PushFramebufferBindings();
  state->ResetFramebufferBindings(); // VTK's copy must name the target, or debug builds warn
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* const prop = s->GetPropArray()[i];
    // Shaders that passes do not reach would leave anything in the images. What they hide receives
    // in vain.
    if (drawnByPasses(prop) != ByPasses::Nothing)
    {
      const WithoutOtherPasses alone(prop, pass);
      prop->RenderOpaqueGeometry(renderer);
      if (factsOf(prop).ofMapper)
      {
        open();
        target.bind();
        state->ResetFramebufferBindings();
      }
    }
  }
  target.end(state->GetEnumState(GL_BLEND));
  state->PopFramebufferBindings();
}

} // namespace gnomon
