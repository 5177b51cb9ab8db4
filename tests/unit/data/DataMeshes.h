#pragma once

#include "SyntheticScene.h"

#include "plugin/vtkGnomonVisibilityFilter.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace gnomon::test
{

/// Return the mesh, moved, as polydata with double points.
vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh, const glm::dvec3& by = glm::dvec3(0.0));

/// Return one quad with these corners.
vtkSmartPointer<vtkPolyData> quad(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Return the floor z = 0 between two corners as cells x cells quads, facing +z: cell y * cells +
/// x.
vtkSmartPointer<vtkPolyData> floorOf(const glm::dvec2& lower, const glm::dvec2& upper, int cells);

/// Join several polydata with polygons into one.
vtkSmartPointer<vtkPolyData> together(const std::vector<vtkSmartPointer<vtkPolyData>>& parts);

/// Return an array of the result, of cells or else of points, as doubles: all its components in a
/// row. Empty if there is no such array.
std::vector<double> shownArrayOf(vtkGnomonVisibilityFilter* filter, const char* name);
/// Update the filter first.
std::vector<double> arrayOf(vtkGnomonVisibilityFilter* filter, const char* name);

/// Calls a function on each progress event.
class Progress
{
public:
  Progress(vtkAlgorithm* algorithm, const std::function<void(double)>& told)
    : algorithm_(algorithm)
    , told_(told)
  {
    this->command_->SetClientData(this);
    this->command_->SetCallback([](vtkObject* caller, unsigned long, void* self, void*)
      { static_cast<Progress*>(self)->told_(vtkAlgorithm::SafeDownCast(caller)->GetProgress()); });
    this->tag_ = algorithm->AddObserver(vtkCommand::ProgressEvent, this->command_);
  }
  ~Progress() { this->algorithm_->RemoveObserver(this->tag_); }

private:
  vtkAlgorithm* algorithm_;
  std::function<void(double)> told_;
  vtkNew<vtkCallbackCommand> command_;
  unsigned long tag_;
};

} // namespace gnomon::test
