#include "plugin/scene/GlyphInstances.h"

#include "vtkBitArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkQuaternion.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

using Quaternion = vtkQuaternion<double>;

/// Arrays that a mapper reads from a data set, null if it reads none. Only subclasses have access
/// to them.
struct ArrayAccess : vtkGlyph3DMapper
{
  static vtkDataArray* mask(vtkGlyph3DMapper* mapper, vtkDataSet* points)
  {
    return (mapper->*(&ArrayAccess::GetMaskArray))(points);
  }
  static vtkDataArray* sourceIndices(vtkGlyph3DMapper* mapper, vtkDataSet* points)
  {
    return (mapper->*(&ArrayAccess::GetSourceIndexArray))(points);
  }
  static vtkDataArray* scales(vtkGlyph3DMapper* mapper, vtkDataSet* points)
  {
    return (mapper->*(&ArrayAccess::GetScaleArray))(points);
  }
  static vtkDataArray* orientations(vtkGlyph3DMapper* mapper, vtkDataSet* points)
  {
    return (mapper->*(&ArrayAccess::GetOrientationArray))(points);
  }
};

/// Return the mapper's table of sources: polydata or trees of them. It is empty if VTK draws
/// nothing, or only the line that replaces a missing source.
std::vector<vtkDataObject*> sourcesOf(vtkGlyph3DMapper* mapper)
{
  std::vector<vtkDataObject*> sources;
  if (mapper->GetUseSourceTableTree())
  {
    vtkDataObjectTree* table = mapper->GetSourceTableTree();
    if (!table || mapper->GetNumberOfInputConnections(1) > 1)
    {
      return {};
    }
    using Options = vtk::DataObjectTreeOptions;
    for (vtkDataObject* source : vtk::Range(table, Options::SkipEmptyNodes))
    {
      sources.push_back(source);
    }
    return sources;
  }
  for (int i = 0; i < mapper->GetNumberOfInputConnections(1); ++i)
  {
    sources.push_back(mapper->GetSource(i));
  }
  const bool complete =
    std::all_of(sources.begin(), sources.end(), [](const auto* source) { return source; });
  return complete ? sources : std::vector<vtkDataObject*>();
}

/// Return the data sets at whose points the mapper draws.
std::vector<vtkDataSet*> pointSetsOf(vtkGlyph3DMapper* mapper)
{
  std::vector<vtkDataSet*> sets;
  const auto add = [&sets](vtkDataObject* object)
  {
    auto* set = vtkDataSet::SafeDownCast(object);
    if (set && set->GetNumberOfPoints() > 0)
    {
      sets.push_back(set);
    }
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    vtkCompositeDataDisplayAttributes* attributes = mapper->GetBlockAttributes();
    for (vtkDataObject* block : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      if (!attributes || !attributes->HasBlockVisibility(block) ||
        attributes->GetBlockVisibility(block))
      {
        add(block);
      }
    }
  }
  else
  {
    add(input);
  }
  return sets;
}

/// Return a point's scale. Like VTK, it replaces 0 by a tiny number.
glm::dvec3 scaleOf(vtkGlyph3DMapper* mapper, vtkDataArray* array, vtkIdType point)
{
  glm::dvec3 scale(1.0);
  if (array)
  {
    const int components = array->GetNumberOfComponents();
    if (mapper->GetScaleMode() == vtkGlyph3DMapper::SCALE_BY_MAGNITUDE)
    {
      scale = glm::dvec3(vtkMath::Norm(array->GetTuple(point), components));
    }
    else if (mapper->GetScaleMode() == vtkGlyph3DMapper::SCALE_BY_COMPONENTS && components == 3)
    {
      scale = glm::make_vec3(array->GetTuple(point));
    }
    if (mapper->GetClamping())
    {
      const double* range = mapper->GetRange();
      const double width = range[1] - range[0];
      scale = (glm::clamp(scale, range[0], range[1]) - range[0]) / (width == 0.0 ? 1.0 : width);
    }
  }
  scale *= mapper->GetScaleFactor();
  constexpr double smallest = 1.0e-10;
  for (int i = 0; i < 3; ++i)
  {
    scale[i] = scale[i] == 0.0 ? smallest : scale[i];
  }
  return scale;
}

Quaternion aboutAxis(int axis, double degrees)
{
  const double half = 0.5 * vtkMath::RadiansFromDegrees(degrees);
  std::array<double, 4> elements{ { std::cos(half), 0.0, 0.0, 0.0 } };
  elements.at(static_cast<std::size_t>(axis) + 1) = std::sin(half);
  return Quaternion(elements.data());
}

/// Return the rotation of +x to a direction, half a turn around the bisector of the two. The zero
/// vector gives the identity.
Quaternion towards(const glm::dvec3& direction)
{
  if (direction.y == 0.0 && direction.z == 0.0)
  {
    return direction.x < 0.0 ? Quaternion(0.0, 0.0, 1.0, 0.0) : Quaternion(1.0, 0.0, 0.0, 0.0);
  }
  const glm::dvec3 axis = glm::normalize(direction + glm::dvec3(glm::length(direction), 0.0, 0.0));
  return { 0.0, axis.x, axis.y, axis.z };
}

glm::dmat3 orientationOf(vtkGlyph3DMapper* mapper, vtkDataArray* array, vtkIdType point)
{
  if (!array)
  {
    return glm::dmat3(1.0);
  }
  std::array<double, 4> tuple{ { 0.0, 0.0, 0.0, 0.0 } };
  array->GetTuple(point, tuple.data());
  Quaternion quaternion;
  switch (mapper->GetOrientationMode())
  {
    case vtkGlyph3DMapper::ROTATION:
      quaternion = aboutAxis(2, tuple[2]) * aboutAxis(0, tuple[0]) * aboutAxis(1, tuple[1]);
      break;
    case vtkGlyph3DMapper::QUATERNION:
      quaternion.Set(tuple.data());
      break;
    default:
      quaternion = towards(glm::make_vec3(tuple.data()));
  }
  double rows[3][3];
  quaternion.ToMatrix3x3(rows);
  return glm::transpose(glm::make_mat3(&rows[0][0]));
}

/// True if the orientation array fits the mode. If not, VTK draws nothing.
bool orientable(vtkGlyph3DMapper* mapper, vtkDataArray* array)
{
  const int components = mapper->GetOrientationMode() == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
  return !array || array->GetNumberOfComponents() == components;
}

} // namespace

std::vector<Glyph> drawnGlyphs(vtkGlyph3DMapper* mapper)
{
  std::vector<Glyph> glyphs;
  const std::vector<vtkDataObject*> sources = sourcesOf(mapper);
  for (vtkDataSet* points : pointSetsOf(mapper))
  {
    for (std::size_t source = 0; source < sources.size(); ++source)
    {
      const auto add = [&](vtkDataObject* object)
      {
        auto* data = vtkPolyData::SafeDownCast(object);
        if (data && data->GetNumberOfPoints() > 0)
        {
          glyphs.push_back({ data, points, static_cast<int>(source) });
        }
      };
      if (auto* tree = vtkCompositeDataSet::SafeDownCast(sources[source]))
      {
        for (vtkDataObject* leaf : vtk::Range(tree, vtk::CompositeDataSetOptions::SkipEmptyNodes))
        {
          add(leaf);
        }
      }
      else
      {
        add(sources[source]);
      }
    }
  }
  return glyphs;
}

std::vector<glm::mat4> glyphInstances(vtkGlyph3DMapper* mapper, vtkDataSet* points, int source)
{
  vtkDataArray* orientations = ArrayAccess::orientations(mapper, points);
  auto* mask = vtkArrayDownCast<vtkBitArray>(ArrayAccess::mask(mapper, points));
  if (!orientable(mapper, orientations) || (mask && mask->GetNumberOfComponents() != 1))
  {
    return {};
  }
  vtkDataArray* scales = ArrayAccess::scales(mapper, points);
  vtkDataArray* indices = ArrayAccess::sourceIndices(mapper, points);
  const int lastSource = static_cast<int>(sourcesOf(mapper).size()) - 1;

  std::vector<glm::mat4> instances;
  for (vtkIdType point = 0; point < points->GetNumberOfPoints(); ++point)
  {
    int chosen = 0;
    if (indices)
    {
      // A norm beyond int's range (NaN too) selects the first source, as on x86.
      const double norm = vtkMath::Norm(indices->GetTuple(point), indices->GetNumberOfComponents());
      chosen =
        norm <= std::numeric_limits<int>::max() ? std::min(static_cast<int>(norm), lastSource) : 0;
    }
    if (chosen != source || (mask && mask->GetValue(point) == 0))
    {
      continue;
    }
    glm::dmat3 turned = orientationOf(mapper, orientations, point);
    if (mapper->GetScaling())
    {
      const glm::dvec3 scale = scaleOf(mapper, scales, point);
      turned = { turned[0] * scale.x, turned[1] * scale.y, turned[2] * scale.z };
    }
    glm::dmat4 instance(turned);
    instance[3] = glm::dvec4(glm::make_vec3(points->GetPoint(point)), 1.0);
    instances.emplace_back(instance);
  }
  instances.shrink_to_fit();
  return instances;
}

} // namespace gnomon
