#pragma once

#include "MeshBuilder.h"

namespace gnomon::tool
{

// The parts of built-in scenes that need more than a list of shapes. Each function adds models,
// props or lights to a scene; BuiltinScenes.json names them.

void addArcades(Scene& scene); ///< of the atrium, with balustrades
void addBooks(Scene& scene);   ///< of the office's shelf
void addBuildingLamps(Scene& scene);
void addCity(Scene& scene);       ///< streets and towers, 10 million triangles
void addCloth(Scene& scene);      ///< banners and awnings of the atrium
void addDeskThings(Scene& scene); ///< pencils, and a pile of paper
void addFlowers(Scene& scene);    ///< of the garden
void addGrass(Scene& scene);      ///< fills the garden up to 55,026 triangles
void addImpostors(Scene& scene);  ///< balls on the floor, above it, and intersecting each other
void addMolecule(Scene& scene);   ///< 100,000 atoms as balls, and their bonds as sticks
void addPlants(Scene& scene);     ///< of the atrium, in pots
void addProps(Scene& scene);      ///< a prop of every kind that VTK has
void addRooms(Scene& scene);      ///< of the building: 8 x 8, with doors
void addScreens(Scene& scene);    ///< sheets with holes of textures
void addSlivers(Scene& scene);    ///< triangles thousands of times as long as high
void addTerrain(Scene& scene);    ///< hills, trees, rocks and posts
void addThinPosts(Scene& scene);  ///< of about a texel's width, with decreasing gaps
void addTrees(Scene& scene);      ///< of the garden

/// Add a model of the package glmark2-data on a plane of four times its size, with a camera and a
/// sun.
/// @throws BadInput without the package (the environment variable GNOMON_MODELS may name another
/// folder)
void addModelOnPlane(Scene& scene, const std::string& file, const Vec3& color);

/// Return the picture of a window: two by two coloured panes between dark bars.
vtkSmartPointer<vtkImageData> makePanes();

inline void add(
  Scene& scene, const std::string& name, const MeshBuilder& mesh, const Vec3& color = casterColor)
{
  scene.models.push_back(makeModel(name, mesh.build(), color));
}

} // namespace gnomon::tool
