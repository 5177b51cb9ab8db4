#ifndef gnomon_tests_unit_plugin_LitPlane_h
#define gnomon_tests_unit_plugin_LitPlane_h

#include "PassScene.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::test
{

/// Gives a scene the technique that is tested, its light, or both.
using Choose = std::function<void(PassScene&, vtkLight*)>;

///@{
/// Expects a plane that nothing hides to be fully lit, with maps of 64 and 1024 texels.

/// Under a sun at these angles from the plane's normal, turned off the axes, so that texels and edges do
/// not agree.
void expectNoAcneUnderTheSun(const Choose& choose, const std::vector<double>& degrees);

/// The same of a plane that is seen along itself from its near end, where views are warped by much;
/// with maps of 64 and 256 texels.
void expectNoAcneAlongALongPlane(const Choose& choose, const std::vector<double>& degrees);

/// Under spot lights of these cones, from above to grazing.
void expectNoAcneUnderASpot(const Choose& choose, const std::vector<double>& conesDegrees);

/// Expects a trough of a floor and two walls without thickness, which the sun sees from within, to be
/// fully lit.
void expectNoAcneInATrough(const Choose& choose, const std::vector<int>& mapSizes);
///@}

/// That trough, of side 4 around the origin.
void addTrough(PassScene& scene);

/// What is to be true of a picture of a plane under a sun, which `where` names.
using CheckSun = std::function<void(
  const VisibilityImages& kept, const glm::dvec3& toLight, const std::string& where)>;

/// Draws that plane.
void checkAlongALongPlane(
  const Choose& choose, const std::vector<double>& degrees, const CheckSun& check);

} // namespace gnomon::test

#endif
