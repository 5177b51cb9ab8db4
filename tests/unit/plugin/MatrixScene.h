#pragma once

#include "PassScene.h"

namespace gnomon::test
{

/// A way to bring one or several balls into the scene.
struct MatrixKind
{
  const char* name;
  vtkSmartPointer<vtkActor> (*make)(vtkRenderer* renderer);
  bool served = true;
};
const std::vector<MatrixKind>& matrixKinds();

/// A look: colours and shading of the balls.
struct MatrixLook
{
  const char* name;
  void (*apply)(vtkActor* actor, vtkRenderer* renderer);
  bool gamma = false; ///< true if VTK's shader ends with a power of 1/2.2, like PBR's
};
const std::vector<MatrixLook>& matrixLooks();
/// The look lit by an environment picture. VTK needs a second or two to prepare it.
std::size_t imageBasedLook();

/// A light that puts a part of the balls in the beam's shadow.
struct MatrixLight
{
  const char* name;
  vtkLight* (*add)(PassScene& scene);
};
const std::vector<MatrixLight>& matrixLights();

/// The balls of a kind with a look, on a green floor, half in the shadow of a blue beam.
class MatrixScene : public PassScene
{
public:
  MatrixScene(const MatrixKind& kind, const MatrixLook& look);

  static constexpr int width = 96;
  static constexpr int height = 72;
};

} // namespace gnomon::test
