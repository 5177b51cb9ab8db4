#include "MtlFile.h"

#include "Errors.h"
#include "Files.h"
#include "ModelChecks.h"
#include "SceneFraming.h"
#include "Text.h"
#include "TextureFile.h"

#include <filesystem>

namespace gnomon::tool
{

namespace
{

/// A statement of the file.
struct Statement
{
  std::string place; ///< "FILE: line 3: ", for errors
  std::vector<std::string> words;

  /// Return the number at this index of the words, in [low, high].
  double number(std::size_t word, double low, double high) const
  {
    const std::optional<double> value = parseWord<double>(this->words, word);
    if (!value || !(*value >= low && *value <= high))
    {
      throw BadInput(this->place + "found " + quotedWord(this->words, word) + ", expected " +
        this->words[0] + " and a number from " + std::to_string(static_cast<int>(low)) + " to " +
        std::to_string(static_cast<int>(high)));
    }
    return *value;
  }

  /// Return red, green and blue. A single number applies to all three.
  Vec3 color() const
  {
    const double red = this->number(1, 0.0, 1.0);
    return this->words.size() == 2
      ? Vec3{ { red, red, red } }
      : Vec3{ { red, this->number(2, 0.0, 1.0), this->number(3, 0.0, 1.0) } };
  }

  /// Return a map's file name, which follows the options and may contain spaces.
  std::string fileName() const
  {
    std::string name;
    for (std::size_t i = 1; i < this->words.size(); ++i)
    {
      const std::string& word = this->words[i];
      const bool option =
        word[0] == '-' || parseNumber<double>(word) || word == "on" || word == "off";
      if (!name.empty() || !option)
      {
        name += (name.empty() ? "" : " ") + word;
      }
    }
    if (name.empty())
    {
      throw BadInput(this->place + "expected " + this->words[0] + " and a file's name");
    }
    return name;
  }
};

void apply(const Statement& statement, const std::filesystem::path& folder, Material& material)
{
  const std::string& keyword = statement.words[0];
  if (keyword == "Kd")
  {
    const Vec3 color = statement.color();
    material.property->SetDiffuseColor(color[0], color[1], color[2]);
    material.property->SetAmbientColor(color[0], color[1], color[2]);
  }
  else if (keyword == "Ks")
  {
    const Vec3 color = statement.color();
    material.property->SetSpecularColor(color[0], color[1], color[2]);
    material.property->SetSpecular(1.0);
  }
  else if (keyword == "Ns")
  {
    material.property->SetSpecularPower(statement.number(1, 0.0, 10000.0));
  }
  else if (keyword == "d")
  {
    material.property->SetOpacity(statement.number(1, 0.0, 1.0));
  }
  else if (keyword == "Tr")
  {
    material.property->SetOpacity(1.0 - statement.number(1, 0.0, 1.0));
  }
  else if (keyword == "map_Kd")
  {
    try
    {
      material.texture = readTexture((folder / statement.fileName()).string());
    }
    catch (const BadInput& error)
    {
      throw BadInput(statement.place + error.what());
    }
    material.texture->InterpolateOn();
  }
}

} // namespace

//------------------------------------------------------------------------------
std::map<std::string, Material> readMaterials(const std::string& path)
{
  const std::vector<std::string> lines = split(readWholeFile(path, largestModelBytes), '\n');
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::map<std::string, Material> materials;
  Material* current = nullptr;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Statement statement{ path + ": line " + std::to_string(i + 1) + ": ",
      splitWords(lines[i]) };
    if (statement.words.size() >= 2 && statement.words[0] == "newmtl")
    {
      current = &materials[statement.words[1]];
      current->property = defaultProperty();
    }
    else if (current && !statement.words.empty())
    {
      apply(statement, folder, *current);
    }
  }
  return materials;
}

} // namespace gnomon::tool
