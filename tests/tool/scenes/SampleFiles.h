#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace gnomon::tool
{

// Small good files of every kind that the program reads, as bytes, from the folder samples. Every
// model but textured.obj is the same pyramid: 5 vertices, 6 triangles, from -1 to 1 in x and z,
// from 0 to 2 in y. buffer.bin holds the glTF document's positions, indices, texture coordinates
// and image, picture.png 8 x 8 pixels.

std::string sampleFile(const std::string& name);
/// All models, by file name: one of each type, some in several encodings.
std::map<std::string, std::string> sampleModels();

/// A document with a mesh, a camera, a spot light and a directional light.
nlohmann::json sampleGltfWithBuffer();
/// The same without its buffer, which a .glb file holds.
nlohmann::json sampleGltf();
std::string makeGlb(const nlohmann::json& document, const std::string& buffer);

/// A scene file that uses model.obj.
nlohmann::json sampleScene();

} // namespace gnomon::tool
