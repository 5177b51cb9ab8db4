#include "MtlFile.h"

#include "Errors.h"
#include "Files.h"
#include "ImageFile.h"
#include "ModelFile.h"
#include "SceneFraming.h"
#include "Text.h"

#include <filesystem>

namespace gnomon::tool
{

namespace
{

using Words = std::vector<std::string>; ///< of a line

/// Return the number at this index, in [0, high].
double numberAt(const Words& words, std::size_t index, double high)
{
  const std::optional<double> value = parseWord<double>(words, index);
  if (!value || !(*value >= 0.0 && *value <= high))
  {
    throw BadInput("found " + quotedWord(words, index) + ", expected " + words[0] +
      " and a number from 0 to " + std::to_string(static_cast<int>(high)));
  }
  return *value;
}

/// Return a map's file name, which follows the options and may contain spaces.
std::string fileNameOf(const Words& words)
{
  std::string name;
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    const std::string& word = words[i];
    if (!name.empty() ||
      !(word[0] == '-' || parseNumber<double>(word) || word == "on" || word == "off"))
    {
      name += (name.empty() ? "" : " ") + word;
    }
  }
  return name;
}

void apply(const Words& words, const std::filesystem::path& folder, Material& material)
{
  const std::string& keyword = words[0];
  vtkProperty* const property = material.property;
  if (keyword == "Kd" || keyword == "Ks")
  {
    Vec3 color;
    for (std::size_t i = 0; i < 3; ++i)
    {
      color[i] = numberAt(words, words.size() == 2 ? 1 : i + 1, 1.0); // one number is grey
    }
    if (keyword == "Kd")
    {
      property->SetDiffuseColor(color.data());
      property->SetAmbientColor(color.data());
    }
    else
    {
      property->SetSpecularColor(color.data());
      property->SetSpecular(1.0);
    }
  }
  else if (keyword == "Ns")
  {
    property->SetSpecularPower(numberAt(words, 1, 10000.0));
  }
  else if (keyword == "d" || keyword == "Tr")
  {
    const double value = numberAt(words, 1, 1.0);
    property->SetOpacity(keyword == "d" ? value : 1.0 - value);
  }
  else if (keyword == "map_Kd")
  {
    material.texture = readTexture((folder / fileNameOf(words)).string());
    material.texture->InterpolateOn();
  }
}

} // namespace

//------------------------------------------------------------------------------
std::map<std::string, Material> readMaterials(const std::string& path)
{
  const std::vector<std::string> lines = split(readWholeFile(path, largestModelBytes), '\n');
  std::map<std::string, Material> materials;
  Material* current = nullptr;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Words words = splitWords(lines[i]);
    if (words.size() >= 2 && words[0] == "newmtl")
    {
      current = &materials[words[1]];
      current->property = defaultProperty();
    }
    else if (current && !words.empty())
    {
      try
      {
        apply(words, std::filesystem::path(path).parent_path(), *current);
      }
      catch (const BadInput& error)
      {
        throw BadInput(path + ": line " + std::to_string(i + 1) + ": " + error.what());
      }
    }
  }
  return materials;
}

} // namespace gnomon::tool
