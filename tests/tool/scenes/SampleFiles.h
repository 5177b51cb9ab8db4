#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace gnomon::tool
{

// Small good files of every kind that the program reads, as bytes. Every model is the same pyramid:
// 5 vertices, 6 triangles, from -1 to 1 in x and z, from 0 to 2 in y.

std::string sampleObj();
std::string sampleAsciiPly();
std::string sampleBinaryPly(bool bigEndian);
std::string sampleAsciiStl();
std::string sampleBinaryStl();
std::string sampleVtp();
std::string sample3ds();

/// Positions, indices, texture coordinates and an image, as the glTF document's buffer has them.
std::string sampleGltfBuffer();
/// A document with a mesh, a camera, a spot light and a directional light. Its buffer has no URI
/// yet.
nlohmann::json sampleGltf();
/// The same, with the buffer as a data URI.
nlohmann::json sampleGltfWithBuffer();
std::string makeGlb(const nlohmann::json& document, const std::string& buffer);

std::string base64(const std::string& bytes);

/// A picture of 8 x 8 pixels.
std::string samplePng();

/// All models, by file name: one of each type, some in several encodings.
std::map<std::string, std::string> sampleModels();

/// A scene file that uses model.obj.
nlohmann::json sampleScene();

} // namespace gnomon::tool
