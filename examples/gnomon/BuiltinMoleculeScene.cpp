#include "BuiltinParts.h"
#include "BuiltinScenes.h"

#include <vtkActor.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>

#include <array>
#include <cmath>

// A double helix wound around a ring, as balls and sticks.

namespace gnomon::tool
{

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr int pairs = 25000; ///< of four atoms each
constexpr double radiusOfHelix = 1.6;
constexpr double pairsPerTurn = 10.5;
constexpr double radiusOfRing = 120.0;
constexpr double radiusOfWinding = 50.0;
constexpr double windings = 80.0;

/// Return the place of the helix's axis at a share, in [0, 1], of its length.
Vec3 axisAt(double share)
{
  const double around = 2.0 * pi * share;
  const double winding = windings * around;
  const double distance = radiusOfRing + radiusOfWinding * std::cos(winding);
  return { { distance * std::cos(around), radiusOfWinding * std::sin(winding),
    distance * std::sin(around) } };
}

/// Return the direction away from the middle of the winding.
Vec3 outwardsAt(double share)
{
  const double around = 2.0 * pi * share;
  const double winding = windings * around;
  return { { std::cos(winding) * std::cos(around), std::sin(winding),
    std::cos(winding) * std::sin(around) } };
}

/// Return a point at an angle around the axis.
Vec3 pointAt(double share, double angle, double distance)
{
  const Vec3 axis = axisAt(share);
  const Vec3 outwards = outwardsAt(share);
  const double around = 2.0 * pi * share;
  // The axis makes 80 turns on its way around the ring, so the point lies across it within a
  // degree.
  const Vec3 along{ { -std::sin(around), 0.0, std::cos(around) } };
  Vec3 point;
  for (std::size_t i = 0; i < 3; ++i)
  {
    point[i] = axis[i] + distance * (std::cos(angle) * outwards[i] + std::sin(angle) * along[i]);
  }
  return point;
}

vtkSmartPointer<vtkMolecule> makeMolecule()
{
  auto molecule = vtkSmartPointer<vtkMolecule>::New();
  constexpr std::array<unsigned short, 4> elements = { 15, 7, 6, 15 }; // along a pair
  constexpr std::array<double, 4> places = { -1.0, -0.33, 0.33, 1.0 };
  std::array<vtkIdType, 4> before{};
  for (int pair = 0; pair < pairs; ++pair)
  {
    const double share = static_cast<double>(pair) / pairs;
    std::array<vtkIdType, 4> atoms{};
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Vec3 at = pointAt(share, 2.0 * pi * pair / pairsPerTurn, places[i] * radiusOfHelix);
      atoms[i] = molecule->AppendAtom(elements[i], at[0], at[1], at[2]).GetId();
    }
    for (std::size_t i = 0; i + 1 < 4; ++i)
    {
      molecule->AppendBond(atoms[i], atoms[i + 1], 1);
    }
    for (const std::size_t strand : { 0u, 3u })
    {
      if (pair > 0)
      {
        molecule->AppendBond(before[strand], atoms[strand], 1);
      }
    }
    before = atoms;
  }
  return molecule;
}

vtkSmartPointer<vtkProp3D> makeActor()
{
  vtkNew<vtkMoleculeMapper> mapper;
  mapper->SetInputData(makeMolecule());
  mapper->UseBallAndStickSettings();
  mapper->SetBondRadius(0.12f);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetPosition(0.0, radiusOfWinding + 4.0, 0.0);
  return actor;
}

} // namespace

//------------------------------------------------------------------------------
Scene makeMoleculeScene()
{
  Scene scene;
  scene.models = { makePlane(origin, 800.0) };
  scene.props.push_back({ "molecule", makeActor });
  scene.lights = { makeSun({ { 0.5, -1.0, -0.3 } }) };
  scene.camera = makeCamera({ { 60.0, 190.0, 280.0 } }, { { 0.0, 40.0, 20.0 } }, 40.0);
  return scene;
}

} // namespace gnomon::tool
