// Pictures of glass beside a tracer in double precision that knows neither maps nor structures.

#include "PassScene.h"

#include <tbb/parallel_for.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDepthPeelingPass.h>
#include <vtkGlyph3DMapper.h>
#include <vtkRenderStepsPass.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>

namespace gnomon::test
{
namespace
{

/// A corner as VTK interpolates it.
struct TracedCorner
{
  glm::dvec3 place, normal;
  glm::dvec4 colour; ///< with the property's opacity
  glm::dvec2 texture{ 0.0 };
};

struct TracedFace
{
  std::array<TracedCorner, 3> corners;
  bool isGlass = false;
  bool isColoured = false; ///< TRANSMITS
  bool hasNormals = false;
  const std::function<double(const glm::dvec2&)>* alphaAt = nullptr; ///< of a texture
};

struct TracedHit
{
  double at;
  const TracedFace* face;
  glm::dvec3 weights;

  template <typename Value>
  Value mix(Value TracedCorner::*member) const
  {
    const auto& corners = this->face->corners;
    return this->weights[0] * (corners[0].*member) + this->weights[1] * (corners[1].*member) +
      this->weights[2] * (corners[2].*member);
  }
  glm::dvec4 colour() const
  {
    glm::dvec4 colour = this->mix(&TracedCorner::colour);
    colour.a *= this->face->alphaAt ? (*this->face->alphaAt)(this->mix(&TracedCorner::texture)) : 1;
    return colour;
  }
};

/// Lights and blends every crossing of every ray, front to back. Surfaces have no ambient and no
/// specular light.
class DoubleTracer
{
public:
  /// Add what an actor draws.
  /// @param worldFromModel in place of the actor's own matrix
  void add(vtkActor* actor, vtkPolyData* data, const glm::dmat4& worldFromModel,
    const std::function<double(const glm::dvec2&)>* alphaAt = nullptr)
  {
    vtkProperty* const property = actor->GetProperty();
    vtkDataArray* const ofCells = data->GetCellData()->GetScalars();
    vtkDataArray* const colours = ofCells ? ofCells : data->GetPointData()->GetScalars();
    vtkDataArray* const normals = data->GetPointData()->GetNormals();
    vtkDataArray* const textures = data->GetPointData()->GetTCoords();
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(worldFromModel)));
    const auto cornerOf = [&](vtkIdType point, vtkIdType cell)
    {
      TracedCorner corner;
      corner.place =
        glm::dvec3(worldFromModel * glm::dvec4(glm::make_vec3(data->GetPoint(point)), 1.0));
      corner.normal = normals ? turn * glm::make_vec3(normals->GetTuple(point)) : glm::dvec3(0.0);
      corner.colour = glm::dvec4(glm::make_vec3(property->GetDiffuseColor()), 1.0);
      if (colours)
      {
        corner.colour = glm::make_vec4(colours->GetTuple(ofCells ? cell : point)) / 255.0;
      }
      const bool isGlyph = actor->GetMapper()->IsA("vtkGlyph3DMapper"); // takes it twice
      corner.colour.a *= std::pow(property->GetOpacity(), isGlyph ? 2 : 1);
      corner.texture = textures ? glm::make_vec2(textures->GetTuple(point)) : glm::dvec2(0.0);
      return corner;
    };
    const auto cells = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
    const auto addFace = [&](vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType cell = 0)
    {
      TracedFace face;
      face.corners = { cornerOf(a, cell), cornerOf(b, cell), cornerOf(c, cell) };
      face.isGlass = alphaAt || face.corners[0].colour.a < 1.0 || face.corners[1].colour.a < 1.0 ||
        face.corners[2].colour.a < 1.0;
      face.isColoured =
        vtkGnomonPropKeys::GetTransmits(actor) == vtkGnomonPropKeys::TRANSMITS_COLORED;
      face.hasNormals = normals != nullptr;
      face.alphaAt = alphaAt;
      this->faces_.push_back(face);
    };
    for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* points = nullptr;
      cells->GetCurrentCell(count, points);
      for (vtkIdType i = 2; i < count; ++i)
      {
        addFace(points[0], points[i - 1], points[i], cells->GetCurrentCellId());
      }
    }
    const vtkIdType* strip = nullptr;
    vtkIdType count = 0;
    for (data->GetStrips()->InitTraversal(); data->GetStrips()->GetNextCell(count, strip);)
    {
      for (vtkIdType i = 2; i < count; ++i)
      {
        addFace(strip[i - 2 + i % 2], strip[i - 1 - i % 2], strip[i]);
      }
    }
  }

  /// Draw what the camera sees by the renderer's only light.
  Picture draw(vtkRenderer* renderer, const glm::ivec2& size) const
  {
    vtkCamera* const camera = renderer->GetActiveCamera();
    const glm::dvec3 eye = glm::make_vec3(camera->GetPosition());
    const glm::dvec3 ahead = glm::make_vec3(camera->GetDirectionOfProjection());
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::make_vec3(camera->GetViewUp())));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double tangent = std::tan(glm::radians(0.5 * camera->GetViewAngle()));
    Picture picture{ size.x, size.y, std::vector<unsigned char>(3u * size.x * size.y) };
    tbb::parallel_for(0, size.y,
      [&](int y)
      {
        for (int x = 0; x < size.x; ++x)
        {
          const glm::dvec2 place =
            tangent * (2.0 * glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(size)) / double(size.y);
          const glm::dvec3 seen =
            this->see(eye, ahead + place.x * right + place.y * up, lightOf(renderer));
          for (int channel = 0; channel < 3; ++channel)
          {
            picture.rgb[static_cast<std::size_t>(3 * (y * size.x + x) + channel)] =
              static_cast<unsigned char>(std::min(seen[channel], 1.0) * 255.0 + 0.5);
          }
        }
      });
    return picture;
  }

private:
  /// Return all crossings of a ray, from its start on.
  std::vector<TracedHit> hits(const glm::dvec3& from, const glm::dvec3& along, double end) const
  {
    std::vector<TracedHit> hits;
    for (const TracedFace& face : this->faces_)
    {
      const glm::dvec3 a = face.corners[0].place;
      const glm::dvec3 toB = face.corners[1].place - a;
      const glm::dvec3 toC = face.corners[2].place - a;
      const glm::dvec3 across = glm::cross(along, toC);
      const double volume = glm::dot(toB, across);
      const glm::dvec3 start = from - a;
      const double b = glm::dot(start, across) / volume;
      const glm::dvec3 other = glm::cross(start, toB);
      const double c = glm::dot(along, other) / volume;
      const double at = glm::dot(toC, other) / volume;
      if (b >= 0.0 && c >= 0.0 && b + c < 1.0 && at > 1e-7 && at < end)
      {
        hits.push_back({ at, &face, { 1.0 - b - c, b, c } });
      }
    }
    std::sort(hits.begin(), hits.end(),
      [](const TracedHit& one, const TracedHit& two) { return one.at < two.at; });
    return hits;
  }

  glm::dvec3 see(const glm::dvec3& eye, const glm::dvec3& along, vtkLight* light) const
  {
    glm::dvec3 seen(0.0);
    double left = 1.0;
    for (const TracedHit& hit : this->hits(eye, along, 1e9))
    {
      const glm::dvec4 colour = hit.colour();
      seen += left * colour.a * glm::dvec3(colour) * this->lightAt(hit, along, light);
      left *= 1.0 - colour.a;
    }
    return seen;
  }

  glm::dvec3 lightAt(const TracedHit& hit, const glm::dvec3& along, vtkLight* light) const
  {
    const auto& corners = hit.face->corners;
    const glm::dvec3 place = hit.mix(&TracedCorner::place);
    glm::dvec3 facet = glm::normalize(
      glm::cross(corners[1].place - corners[0].place, corners[2].place - corners[0].place));
    glm::dvec3 normal =
      hit.face->hasNormals ? glm::normalize(hit.mix(&TracedCorner::normal)) : facet;
    if (glm::dot(facet, along) > 0.0)
    {
      facet = -facet;
      normal = -normal;
    }
    const glm::dvec3 position = glm::make_vec3(light->GetPosition());
    const bool isLamp = light->GetPositional();
    const glm::dvec3 toLight =
      isLamp ? position - place : 100.0 * (position - glm::make_vec3(light->GetFocalPoint()));
    const double cosine = glm::dot(normal, glm::normalize(toLight));
    if (cosine <= 0.0 || (!hit.face->isGlass && glm::dot(facet, toLight) <= 0.0))
    {
      return glm::dvec3(0.0);
    }
    glm::dvec3 arrives(cosine);
    for (const TracedHit& before : this->hits(place, toLight, 1.0))
    {
      const glm::dvec4 colour = before.colour();
      arrives *= !before.face->isGlass ? glm::dvec3(0.0)
        : before.face->isColoured      ? 1.0 - colour.a * (1.0 - glm::dvec3(colour))
                                       : glm::dvec3(1.0 - colour.a);
    }
    return arrives;
  }

  std::vector<TracedFace> faces_;
};

/// A scene of glass, which it also adds to a tracer.
struct GlassScene : PassScene
{
  static constexpr int width = 200, height = 150;

  GlassScene()
    : PassScene(width, height)
  {
    // VTK's own choice, dual depth peeling, loses layers before an opaque floor.
    vtkNew<vtkTranslucentPass> layer;
    this->peeling->SetTranslucentPass(layer);
    this->peeling->SetMaximumNumberOfPeels(50);
    this->peeling->SetOcclusionRatio(0.0);
    this->steps->SetTranslucentPass(this->peeling);
    this->pass->SetDelegatePass(this->steps);
    this->pass->TranslucentCastersOn();
    this->lookFrom({ 2.0, -7.0, 5.0 }, { 0.0, 0.0, 0.6 });
  }
  vtkActor* place(vtkAlgorithm* source, double opacity, const glm::dvec3& colour = glm::dvec3(1.0))
  {
    vtkActor* const actor = this->add(source);
    actor->GetProperty()->SetOpacity(opacity);
    actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
    if (colour != glm::dvec3(1.0) && opacity < 1.0)
    {
      vtkGnomonPropKeys::SetTransmits(actor, vtkGnomonPropKeys::TRANSMITS_COLORED);
    }
    return actor;
  }
  vtkActor* pane(const glm::dvec3& middle, double opacity, double turn = 0.0,
    const glm::dvec3& colour = glm::dvec3(1.0))
  {
    vtkActor* const actor = this->place(squareOf(1.0), opacity, colour);
    actor->SetPosition(middle.x, middle.y, middle.z);
    actor->RotateX(turn);
    return actor;
  }
  /// Trace what the scene shows. Instances are the test's.
  Picture trace()
  {
    vtkActorCollection* const actors = this->renderer->GetActors();
    for (int i = 0; i < actors->GetNumberOfItems(); ++i)
    {
      auto* const actor = vtkActor::SafeDownCast(actors->GetItemAsObject(i));
      actor->GetMapper()->Update();
      if (auto* const data = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputAsDataSet());
          data && !actor->GetMapper()->IsA("vtkGlyph3DMapper"))
      {
        const glm::dmat4 matrix =
          glm::transpose(glm::make_mat4(&actor->GetMatrix()->Element[0][0]));
        this->tracer.add(actor, data, matrix, actor->GetTexture() ? &this->alphaAt : nullptr);
      }
    }
    return this->tracer.draw(this->renderer, { width, height });
  }

  DoubleTracer tracer;
  std::function<double(const glm::dvec2&)> alphaAt;
  vtkNew<vtkDepthPeelingPass> peeling;
  vtkNew<vtkRenderStepsPass> steps;
};

/// A picture of glass over a ground, under the sun if it has no lamp.
struct GlassPicture
{
  const char* name;
  void (*fill)(GlassScene& scene);
};

void lamp(GlassScene& scene, const glm::dvec3& place)
{
  scene.addSpot(place, glm::dvec3(0.0), allDirections);
}

const GlassPicture glassPictures[] = {
  { "pane",
    [](GlassScene& scene) {
      scene.pane({ 0.0, 0.0, 1.0 }, 0.4);
    } },
  { "five_panes",
    [](GlassScene& scene)
    {
      for (int i = 0; i < 5; ++i)
      {
        scene.pane({ 0.3 * i - 0.6, 0.0, 0.4 + 0.4 * i }, 0.3, 8.0 * i);
      }
      lamp(scene, { -1.0, -1.0, 6.0 });
    } },
  { "nested_shells",
    [](GlassScene& scene)
    {
      for (int i = 0; i < 4; ++i)
      {
        scene.place(ballOf({ 0.0, 0.0, 1.2 }, 1.1 - 0.25 * i, 32, 16), 0.25);
      }
    } },
  { "ball_in_box",
    [](GlassScene& scene)
    {
      scene.place(boxOf({ -1.0, -1.0, 0.1 }, { 1.0, 1.0, 1.9 }), 0.35);
      scene.place(ballOf({ 0.2, 0.0, 0.9 }, 0.5, 32, 16), 1.0, { 0.9, 0.8, 0.4 });
    } },
  { "stained_panes",
    [](GlassScene& scene)
    {
      scene.pane({ -0.5, 0.0, 1.0 }, 0.7, 20.0, { 1.0, 0.7, 0.8 });
      scene.pane({ 0.5, 0.2, 1.5 }, 0.6, -20.0, { 0.1, 0.4, 1.0 });
    } },
  { "panes_in_a_T",
    [](GlassScene& scene)
    {
      scene.pane({ 0.0, 0.0, 0.8 }, 0.5);
      scene.pane({ 0.0, 0.0, 1.8 }, 0.5, 90.0);
    } },
  { "lamp_in_a_shade",
    [](GlassScene& scene)
    {
      scene.place(ballOf({ 0.0, 0.0, 1.2 }, 0.7, 32, 16), 0.5, { 1.0, 0.7, 0.3 });
      for (int i = 0; i < 5; ++i)
      {
        const double turn = 1.2566 * i;
        const glm::dvec3 at(1.6 * std::cos(turn), 1.6 * std::sin(turn), 0.0);
        scene.place(boxOf(at - 0.1, at + glm::dvec3(0.1, 0.1, 1.0)), 1.0);
      }
      lamp(scene, { 0.05, 0.1, 1.25 });
    } },
  { "alpha_of_vertices",
    [](GlassScene& scene)
    {
      const vtkSmartPointer<vtkPolyData> data = copyOf(squareOf(1.2, 1.0, 1));
      vtkNew<vtkUnsignedCharArray> colours;
      colours->SetNumberOfComponents(4);
      for (const int alpha : { 20, 120, 160, 240 })
      {
        colours->InsertNextTuple4(255, 200, 120, alpha);
      }
      data->GetPointData()->SetScalars(colours);
      scene.add(data);
      scene.pane({ 0.3, 0.2, 0.5 }, 0.5);
    } },
  { "alpha_of_cells",
    [](GlassScene& scene)
    {
      const vtkSmartPointer<vtkPolyData> data = copyOf(squareOf(1.2, 1.0, 3));
      vtkNew<vtkUnsignedCharArray> colours;
      colours->SetNumberOfComponents(4);
      for (int cell = 0; cell < 9; ++cell)
      {
        colours->InsertNextTuple4(255, 90 + 20 * cell, 120, 20 + 25 * cell);
      }
      data->GetCellData()->SetScalars(colours);
      scene.add(data);
    } },
  { "alpha_of_a_texture",
    [](GlassScene& scene)
    {
      vtkActor* const pane = scene.pane({ 0.0, 0.0, 1.0 }, 1.0);
      pane->SetTexture(
        textureOf(makeVeil(4, 4, [](int x, int y) { return 50 * ((x + y) % 4) + 30; })));
      pane->GetTexture()->InterpolateOff();
      scene.alphaAt = [](const glm::dvec2& place)
      {
        const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(4.0 * place)), 0, 3);
        return (50 * ((texel.x + texel.y) % 4) + 30) / 255.0;
      };
      scene.pane({ 0.3, 0.2, 0.5 }, 0.5);
    } },
  { "instances",
    [](GlassScene& scene)
    {
      const vtkSmartPointer<vtkCubeSource> box = boxOf(glm::dvec3(-0.3), glm::dvec3(0.3));
      vtkNew<vtkGlyph3DMapper> mapper;
      mapper->SetSourceConnection(box->GetOutputPort());
      mapper->ScalingOff();
      vtkActor* const boxes = scene.add(mapper);
      boxes->GetProperty()->SetOpacity(0.4);
      std::vector<glm::dvec3> places;
      for (int i = 0; i < 6; ++i)
      {
        places.emplace_back(0.8 * (i % 3) - 0.8, 0.9 * (i / 3) - 0.4, 0.6 + 0.25 * i);
        scene.tracer.add(boxes, outputOf(box), glm::translate(glm::dmat4(1.0), places.back()));
      }
      mapper->SetInputData(meshOf(places, {}));
    } },
  { "glass_over_an_edge",
    [](GlassScene& scene)
    {
      scene.place(boxOf({ -1.5, -0.2, 0.0 }, { 0.0, 0.2, 1.2 }), 1.0);
      scene.pane({ 0.2, 0.0, 1.6 }, 0.5);
      scene.pane({ -0.3, 0.4, 2.0 }, 0.5, 15.0);
    } },
  { "cabinet",
    [](GlassScene& scene)
    {
      scene.place(boxOf({ -1.4, -0.7, 0.05 }, { 1.4, 0.7, 2.0 }), 0.2, { 0.6, 0.9, 0.8 });
      scene.place(squareOf(0.65, 1.0), 0.3)->SetScale(2.0, 1.0, 1.0);
      scene.place(ballOf({ -0.7, 0.0, 0.4 }, 0.3, 32, 16), 1.0, { 0.8, 0.3, 0.2 });
      scene.place(ballOf({ 0.6, 0.1, 1.35 }, 0.3, 32, 16), 0.5, { 0.3, 0.4, 1.0 });
      scene.place(boxOf({ 0.3, -0.3, 0.1 }, { 0.9, 0.3, 0.7 }), 1.0, { 0.4, 0.7, 0.3 });
      lamp(scene, { -3.0, -3.0, 6.0 });
    } },
};

using GlassPictures = PassTestOf<GlassPicture>;

TEST_P(GlassPictures, areThoseOfTheTracer)
{
  GlassScene scene;
  scene.place(squareOf(3.0), 1.0); // the ground
  GetParam().fill(scene);
  if (scene.renderer->GetLights()->GetNumberOfItems() == 0)
  {
    scene.addSun({ 0.5, 0.3, -1.0 });
  }
  const Picture truth = scene.trace();
  const Picture picture = scene.render("raytraced");
  EXPECT_LT(rmsDifference(truth, picture), 2.0);
  EXPECT_LT(differingPixels(truth, picture, 8), 60u) << "at edges";
}

INSTANTIATE_TEST_SUITE_P(, GlassPictures, testing::ValuesIn(glassPictures), byName);

} // namespace
} // namespace gnomon::test
