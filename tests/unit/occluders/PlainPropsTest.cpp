// The cache of plain props never hides a change. After any change, a collector that has followed
// the scene equals one that sees it for the first time.

#include "plugin/scene/OccluderCollector.h"

#include "TestData.h"

#include "plugin/scene/PropRecords.h"
#include "plugin/vtkGnomonPropKeys.h"

#include "vtkActor2D.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <sstream>
#include <string>
#include <tuple>

using namespace gnomon;
using namespace gnomon::test;

namespace
{

/// A prop whose parts can all be changed. Its replacement parts are older than the parts that they
/// replace.
struct PlainScene
{
  vtkSmartPointer<vtkPolyData> otherSquare =
    meshOf({ { 0, 0, 0 }, { 3, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  vtkSmartPointer<vtkActor> otherActor = makeActor(otherSquare);
  vtkNew<vtkProperty> glass;
  vtkNew<vtkLookupTable> clearColours;
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTexture> perforated;
  vtkSmartPointer<vtkPoints> otherPoints =
    meshOf({ { 0, 0, 0 }, { 1, 0, 2 }, { 1, 1, 0 }, { 0, 1, 0 } }, {})->GetPoints();
  vtkSmartPointer<vtkCellArray> otherCells = makeCells({ { 0, 1, 2 } });
  vtkNew<vtkPlane> plane;
  vtkNew<vtkPlaneCollection> planes;

  vtkSmartPointer<vtkPolyData> square = makeSquare();
  vtkNew<vtkFloatArray> scalars;
  vtkNew<vtkLookupTable> colours;
  vtkNew<vtkTrivialProducer> producer;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkMatrix4x4> matrix;
  vtkNew<vtkActor> actor;
  vtkSmartPointer<vtkActor> neighbour = makeActor(makeSquare());
  vtkNew<vtkPlaneSource> source, otherSource;
  vtkNew<vtkTransform> filterTransform;
  vtkNew<vtkTransformPolyDataFilter> filter;
  vtkNew<vtkPolyDataMapper> filteredMapper;
  vtkNew<vtkActor> filtered;
  vtkNew<vtkRenderer> renderer;
  OccluderCollector collector;

  PlainScene()
  {
    this->glass->SetOpacity(0.5);
    for (vtkLookupTable* table : { this->clearColours.Get(), this->colours.Get() })
    {
      table->SetNumberOfTableValues(2);
      table->Build();
    }
    this->clearColours->SetTableValue(1, 1.0, 1.0, 1.0, 0.5);
    this->transform->Translate(0.0, 0.0, 4.0);
    this->perforated->SetInputData(makeVeil(2, 1, [](int x, int) { return x == 0 ? 255 : 0; }));
    this->plane->SetNormal(1.0, 0.0, 0.0);
    this->plane->SetOrigin(0.5, 0.0, 0.0);

    this->scalars->SetNumberOfTuples(4);
    this->scalars->Fill(0.0);
    this->square->GetPointData()->SetScalars(this->scalars);
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    coordinates->SetNumberOfTuples(4);
    coordinates->Fill(0.0);
    this->square->GetPointData()->SetTCoords(coordinates);
    this->producer->SetOutput(this->square);
    this->mapper->SetInputConnection(this->producer->GetOutputPort());
    this->mapper->SetLookupTable(this->colours);
    this->mapper->SetClippingPlanes(this->planes);
    this->actor->SetMapper(this->mapper);
    this->actor->SetUserMatrix(this->matrix);
    this->neighbour->SetPosition(5.0, 0.0, 0.0);
    vtkGnomonPropKeys::SetCasts(this->neighbour, true);
    this->renderer->AddActor(this->actor);
    this->renderer->AddActor(this->neighbour);
    this->otherSource->SetResolution(1, 2);
    this->otherSource->Update();
    this->filter->SetTransform(this->filterTransform);
    this->filter->SetInputConnection(this->source->GetOutputPort());
    this->filteredMapper->SetInputConnection(this->filter->GetOutputPort());
    this->filtered->SetMapper(this->filteredMapper);
    this->renderer->AddActor(this->filtered);
  }
};

/// Return all values of a collector for a scene, except versions.
std::string stateOf(OccluderCollector& collector, vtkRenderer* renderer)
{
  const Occluders& occluders = collector.occluders();
  std::ostringstream state;
  for (const Surface& surface : occluders.surfaces)
  {
    state << "surface" << surface.casts << surface.receives << surface.oneSided
          << (surface.cutout != nullptr);
    for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
    {
      const glm::uvec3 triangle = occluders.triangles[surface.firstTriangle + i];
      for (int corner = 0; corner < 3; ++corner)
      {
        const glm::dvec3 position =
          glm::dvec3(occluders.positionsCentred[triangle[corner]]) + occluders.frame.centre;
        state << " (" << position.x << " " << position.y << " " << position.z << ")";
      }
    }
    state << "\n";
  }
  state << collector.translucentReceivers() << " translucent\n";
  for (const std::string& note : collector.notes())
  {
    state << note << "\n";
  }
  vtkCollectionSimpleIterator iterator;
  renderer->GetViewProps()->InitTraversal(iterator);
  while (vtkProp* const prop = renderer->GetViewProps()->GetNextProp(iterator))
  {
    state << "stamp " << collector.props().stamp(prop, renderer) << "\n";
  }
  return state.str();
}

struct Alteration
{
  const char* name;
  std::function<void(PlainScene&)> apply;
};
std::ostream& operator<<(std::ostream& stream, const Alteration& alteration)
{
  return stream << alteration.name;
}

/// An alteration, and whether the snapshot is filled in a frame, after the renderer's culler.
struct PlainPropChange : testing::TestWithParam<std::tuple<Alteration, bool>>
{
  void collect(OccluderCollector& collector, vtkRenderer* renderer) const
  {
    if (!std::get<bool>(GetParam()))
    {
      collector.collect(renderer);
      return;
    }
    vtkCollectionSimpleIterator iterator;
    renderer->GetViewProps()->InitTraversal(iterator);
    while (vtkProp* const prop = renderer->GetViewProps()->GetNextProp(iterator))
    {
      if (prop->GetVisibility())
      {
        prop->GetBounds();
      }
    }
    ASSERT_TRUE(haveInputsRun(renderer));
    collector.collect(renderer, { false, true });
  }
};

const std::vector<Alteration> alterations = {
  { "visibility", [](PlainScene& s) { s.actor->VisibilityOff(); } },
  { "position", [](PlainScene& s) { s.actor->SetPosition(0.0, 0.0, 3.0); } },
  { "userMatrixInPlace", [](PlainScene& s) { s.matrix->SetElement(2, 3, 2.0); } },
  { "userTransform", [](PlainScene& s) { s.actor->SetUserTransform(s.transform); } },
  { "forceTranslucent", [](PlainScene& s) { s.actor->ForceTranslucentOn(); } },
  { "casts", [](PlainScene& s) { vtkGnomonPropKeys::SetCasts(s.actor, false); } },
  { "castsInPlace", [](PlainScene& s) { vtkGnomonPropKeys::SetCasts(s.neighbour, false); } },
  { "receives", [](PlainScene& s) { vtkGnomonPropKeys::SetReceives(s.actor, false); } },
  { "oneSided", [](PlainScene& s) { vtkGnomonPropKeys::SetOneSided(s.actor, true); } },
  { "opacity", [](PlainScene& s) { s.actor->GetProperty()->SetOpacity(0.5); } },
  { "representation",
    [](PlainScene& s) { s.actor->GetProperty()->SetRepresentationToWireframe(); } },
  { "olderProperty", [](PlainScene& s) { s.actor->SetProperty(s.glass); } },
  { "texture", [](PlainScene& s) { s.actor->SetTexture(s.perforated); } },
  { "textureOfTheProperty",
    [](PlainScene& s) { s.actor->GetProperty()->SetTexture("holes", s.perforated); } },
  { "olderMapper", [](PlainScene& s) { s.actor->SetMapper(s.otherActor->GetMapper()); } },
  { "noMapper", [](PlainScene& s) { s.actor->SetMapper(nullptr); } },
  { "clippingPlane", [](PlainScene& s) { s.mapper->AddClippingPlane(s.plane); } },
  { "clippingPlaneOfTheList", [](PlainScene& s) { s.planes->AddItem(s.plane); } },
  { "subPieces", [](PlainScene& s) { s.mapper->SetNumberOfSubPieces(2); } },
  { "olderInput", [](PlainScene& s) { s.mapper->SetInputData(s.otherSquare); } },
  { "olderOutputOfTheProducer", [](PlainScene& s) { s.producer->SetOutput(s.otherSquare); } },
  { "noOutputOfTheProducer", [](PlainScene& s) { s.producer->SetOutput(nullptr); } },
  { "noInput", [](PlainScene& s) { s.mapper->RemoveAllInputConnections(0); } },
  { "olderColours",
    [](PlainScene& s)
    {
      s.scalars->Fill(1.0);
      s.mapper->SetLookupTable(s.clearColours);
    } },
  { "coloursInPlace", [](PlainScene& s) { s.colours->SetTableValue(0, 1.0, 1.0, 1.0, 0.5); } },
  { "newScalars",
    [](PlainScene& s)
    {
      vtkNew<vtkUnsignedCharArray> bytes;
      bytes->SetNumberOfComponents(4);
      bytes->SetNumberOfTuples(4);
      bytes->Fill(100.0);
      s.square->GetPointData()->SetScalars(bytes);
    } },
  { "pointsOfTheData",
    [](PlainScene& s)
    {
      s.square->GetPoints()->SetPoint(2, 7.0, 7.0, 0.0);
      s.square->Modified();
    } },
  { "pointsOfThePoints",
    [](PlainScene& s)
    {
      s.square->GetPoints()->SetPoint(2, 7.0, 7.0, 0.0);
      s.square->GetPoints()->Modified();
    } },
  { "pointsOfTheArray",
    [](PlainScene& s)
    {
      s.square->GetPoints()->GetData()->SetComponent(2, 0, 7.0);
      s.square->GetPoints()->GetData()->Modified();
    } },
  { "olderPoints", [](PlainScene& s) { s.square->SetPoints(s.otherPoints); } },
  { "olderPolygons", [](PlainScene& s) { s.square->SetPolys(s.otherCells); } },
  { "strips", [](PlainScene& s) { s.square->SetStrips(s.otherCells); } },
  { "noCells", [](PlainScene& s) { s.square->SetPolys(nullptr); } },
  { "settingOfTheSource", [](PlainScene& s) { s.source->SetResolution(3, 2); } },
  { "settingOfTheFilter", [](PlainScene& s) { s.filterTransform->Translate(0.0, 0.0, 4.0); } },
  { "olderSource",
    [](PlainScene& s) { s.filter->SetInputConnection(s.otherSource->GetOutputPort()); } },
  { "olderSourceOfTheMapper",
    [](PlainScene& s) { s.filteredMapper->SetInputConnection(s.otherSource->GetOutputPort()); } },
  { "outputOfTheFilterInPlace",
    [](PlainScene& s)
    {
      s.filter->GetOutput()->GetPoints()->SetPoint(2, 7.0, 7.0, 0.0);
      s.filter->GetOutput()->GetPoints()->Modified();
    } },
  { "inputOfTheFilter",
    [](PlainScene& s)
    {
      s.filter->SetInputData(s.otherSquare);
      s.filteredMapper->StaticOn(); // VTK draws what the filter has made before
      s.filter->Update();
    } },
  { "colourOfTheFiltered", [](PlainScene& s) { s.filtered->GetProperty()->SetOpacity(0.5); } },
  { "castsOfTheFiltered", [](PlainScene& s) { vtkGnomonPropKeys::SetCasts(s.filtered, false); } },
  { "order",
    [](PlainScene& s)
    {
      s.renderer->RemoveActor(s.actor);
      s.renderer->AddActor(s.actor);
    } },
  { "olderActorInItsPlace",
    [](PlainScene& s) { s.renderer->GetViewProps()->ReplaceItem(0, s.otherActor); } },
  { "removed", [](PlainScene& s) { s.renderer->RemoveActor(s.actor); } },
};

INSTANTIATE_TEST_SUITE_P(All, PlainPropChange,
  testing::Combine(testing::ValuesIn(alterations), testing::Bool()),
  [](const auto& alteration)
  {
    return std::get<Alteration>(alteration.param).name +
      std::string(std::get<bool>(alteration.param) ? "InAFrame" : "");
  });

} // namespace

TEST_P(PlainPropChange, isSeen)
{
  PlainScene scene;
  this->collect(scene.collector, scene.renderer);
  this->collect(scene.collector, scene.renderer);
  const std::string before = stateOf(scene.collector, scene.renderer);
  std::get<Alteration>(GetParam()).apply(scene);
  this->collect(scene.collector, scene.renderer);
  const std::string after = stateOf(scene.collector, scene.renderer);
  EXPECT_NE(after, before);
  OccluderCollector fresh;
  this->collect(fresh, scene.renderer);
  EXPECT_EQ(after, stateOf(fresh, scene.renderer));
  this->collect(scene.collector, scene.renderer);
  EXPECT_EQ(after, stateOf(scene.collector, scene.renderer)) << "once it is remembered";
}

// Coordinates are not all that counts: colours change in place, and only the time of change of
// their own array shows it.
TEST(PlainProps, ScalarsInPlaceAreSeen)
{
  for (const bool ofField : { false, true })
  {
    PlainScene scene;
    vtkNew<vtkUnsignedCharArray> bytes;
    bytes->SetName("colours");
    bytes->SetNumberOfComponents(4);
    bytes->SetNumberOfTuples(4);
    bytes->Fill(255.0);
    scene.mapper->SelectColorArray("colours");
    if (ofField)
    {
      scene.square->GetFieldData()->AddArray(bytes);
      scene.mapper->SetScalarModeToUseFieldData();
    }
    else
    {
      scene.square->GetPointData()->AddArray(bytes);
      scene.mapper->SetScalarModeToUsePointFieldData();
    }
    scene.collector.collect(scene.renderer);
    scene.collector.collect(scene.renderer);
    EXPECT_EQ(scene.collector.occluders().surfaces.size(), 3u) << ofField;
    bytes->Fill(100.0);
    bytes->Modified();
    scene.collector.collect(scene.renderer);
    EXPECT_EQ(scene.collector.occluders().surfaces.size(), 2u) << ofField;
  }
}

TEST(PlainProps, AreFoundAgainAfterOthersCameAndWent)
{
  PlainScene scene;
  vtkNew<vtkPlaneSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> piped;
  piped->SetMapper(mapper);
  const auto expectAsFresh = [&](std::size_t surfaces)
  {
    scene.collector.collect(scene.renderer);
    EXPECT_EQ(scene.collector.occluders().surfaces.size(), surfaces);
    OccluderCollector fresh;
    fresh.collect(scene.renderer);
    EXPECT_EQ(stateOf(scene.collector, scene.renderer), stateOf(fresh, scene.renderer));
  };
  expectAsFresh(3);
  scene.renderer->GetViewProps()->ReplaceItem(0, piped); // removes the first
  scene.renderer->AddActor(scene.actor);
  expectAsFresh(4);
  source->SetResolution(3, 2);
  expectAsFresh(4);
  scene.renderer->RemoveAllViewProps();
  expectAsFresh(0);
  scene.renderer->AddActor(scene.neighbour);
  expectAsFresh(1);
}

TEST(PlainProps, AreAllTheSameBesideHiddenPropsAndAnnotations)
{
  PlainScene scene;
  vtkNew<vtkActor2D> annotation;
  scene.renderer->AddViewProp(annotation);
  scene.collector.collect(scene.renderer);
  PropRecords props;
  const auto areSame = [&] { return props.beginFrame(scene.renderer->GetViewProps(), false); };
  EXPECT_FALSE(areSame());
  EXPECT_FALSE(areSame()) << "nothing is remembered";
  EXPECT_TRUE(props.remember(0, scene.actor));
  EXPECT_TRUE(props.remember(1, scene.neighbour));
  EXPECT_TRUE(props.remember(2, scene.filtered));
  EXPECT_TRUE(areSame());
  scene.neighbour->VisibilityOff();
  EXPECT_FALSE(areSame());
  EXPECT_TRUE(areSame()) << "it stays hidden";
  annotation->SetPosition(3.0, 4.0);
  EXPECT_TRUE(areSame());
  scene.neighbour->VisibilityOn();
  EXPECT_FALSE(areSame());
  EXPECT_FALSE(areSame());
  EXPECT_TRUE(props.remember(1, scene.neighbour));
  EXPECT_TRUE(areSame());
  vtkGnomonPropKeys::SetReceives(scene.filtered, false);
  EXPECT_FALSE(areSame());
  EXPECT_EQ(props.unchanged(2), nullptr);
  EXPECT_NE(props.unchanged(1), nullptr);
}
