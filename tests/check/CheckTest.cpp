// Test the check itself: it passes files that are true by construction, and finds each planted
// error at its pixel.

#include "Check.h"
#include "TestFiles.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfVecAttribute.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace gnomon::check
{

namespace
{

constexpr int sidePixels = 100;
constexpr double cameraHeight = 10.0;
constexpr double halfGround = 9.0;
constexpr double plateHeight = 2.0;

/// A picture from above of a square ground at y = 0 with a square plate of side 2 over its middle.
/// With 90 degrees and the camera at 10, the picture's border is at 10 on the ground. No pixel's
/// centre lies on an edge.
nlohmann::json makeScene()
{
  const nlohmann::json light = { { "type", "directional" }, { "direction", { 1, -1, 0 } } };
  const nlohmann::json ground = { { "file", "square.obj" },
    { "matrix", { halfGround, 0, 0, 0, 0, halfGround, 0, 0, 0, 0, halfGround, 0, 0, 0, 0, 1 } } };
  const nlohmann::json plate = { { "file", "square.obj" },
    { "matrix", { 1, 0, 0, 0, 0, 1, 0, plateHeight, 0, 0, 1, 0, 0, 0, 0, 1 } } };
  return { { "camera",
             { { "position", { 0, cameraHeight, 0 } }, { "target", { 0, 0, 0 } },
               { "up", { 0, 0, -1 } }, { "fov", 90 } } },
    { "lights", { light } }, { "models", { ground, plate } } };
}

/// The file that is true for the scene, computed by hand.
struct TrueFile
{
  VisibilityFile file;

  TrueFile()
  {
    this->file.width = sidePixels;
    this->file.height = sidePixels;
    this->file.origin = { 1.0, 2.0, 3.0 };
    for (const char* name : { "coverage", "visibility.0", "position.X", "position.Y", "position.Z",
           "normal.X", "normal.Y", "normal.Z" })
    {
      this->file.channels[name].resize(sidePixels * sidePixels);
    }
    for (int i = 0; i < sidePixels * sidePixels; ++i)
    {
      this->fill(i % sidePixels, i / sidePixels);
    }
  }

  static bool onPlate(double x, double z) { return std::abs(x) < 1.0 && std::abs(z) < 1.0; }
  /// The light moves the plate's shadow to the right by the plate's height.
  static bool inShadow(double x, double z) { return onPlate(x - plateHeight, z); }

  float& at(const std::string& channel, int x, int y)
  {
    return this->file.channels.at(channel)[static_cast<std::size_t>(y * sidePixels + x)];
  }

  void fill(int x, int y)
  {
    // Return where the ray meets the ground and the plate.
    const double groundX = cameraHeight * (2.0 * (x + 0.5) / sidePixels - 1.0);
    const double groundZ = cameraHeight * (2.0 * (y + 0.5) / sidePixels - 1.0);
    const double nearer = (cameraHeight - plateHeight) / cameraHeight;
    const bool plate = onPlate(nearer * groundX, nearer * groundZ);
    if (!plate && std::max(std::abs(groundX), std::abs(groundZ)) > halfGround)
    {
      return;
    }
    const Vec3 position =
      plate ? Vec3(nearer * groundX, plateHeight, nearer * groundZ) : Vec3(groundX, 0.0, groundZ);
    this->setPosition(x, y, position);
    this->at("coverage", x, y) = 1.0f;
    this->at("normal.Y", x, y) = 1.0f;
    this->at("visibility.0", x, y) = !plate && inShadow(groundX, groundZ) ? 0.0f : 1.0f;
  }

  Vec3 position(int x, int y)
  {
    return this->file.origin +
      this->file.vector("position", static_cast<std::size_t>(y * sidePixels + x));
  }
  void setPosition(int x, int y, const Vec3& position)
  {
    const Vec3 stored = position - this->file.origin;
    this->at("position.X", x, y) = static_cast<float>(stored.x);
    this->at("position.Y", x, y) = static_cast<float>(stored.y);
    this->at("position.Z", x, y) = static_cast<float>(stored.z);
  }
};

void write(const VisibilityFile& file, const std::string& path)
{
  Imf::Header header(file.width, file.height);
  header.insert("origin", Imf::V3dAttribute(file.origin));
  Imf::FrameBuffer frame;
  for (const auto& [name, plane] : file.channels)
  {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    auto* const base = reinterpret_cast<char*>(const_cast<float*>(plane.data()));
    frame.insert(name,
      Imf::Slice(
        Imf::FLOAT, base, sizeof(float), sizeof(float) * static_cast<std::size_t>(file.width)));
  }
  Imf::OutputFile output(path.c_str(), header);
  output.setFrameBuffer(frame);
  output.writePixels(file.height);
}

/// Write an image of two texels; the left one has no alpha.
void writeHoles(const std::string& path)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int i = 0; i < 8; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] = i == 3 ? 0 : 255;
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

/// Check a file against a scene, both written to the disk and read back.
Result check(const nlohmann::json& scene, const VisibilityFile& file)
{
  const tool::TestFolder folder;
  std::ofstream(folder / "square.obj")
    << "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
       "f 1/1 2/2 3/3 4/4\n";
  writeHoles(folder / "left.png");
  std::ofstream(folder / "scene.json") << scene;
  write(file, folder / "file.exr");
  return compare(readScene(folder / "scene.json"), readVisibilityFile(folder / "file.exr"));
}

Pixels pixels(const std::vector<std::array<int, 2>>& places)
{
  Pixels result;
  for (const auto& [x, y] : places)
  {
    result.push_back(static_cast<std::size_t>(y * sidePixels + x));
  }
  return result;
}

} // namespace

TEST(Check, FindsNothingInATrueFile)
{
  const TrueFile image;
  const Result result = check(makeScene(), image.file);
  EXPECT_EQ(result.failures(), std::vector<std::string>());
  EXPECT_EQ(result.pixels, 10000u);
  EXPECT_EQ(result.covered, 8100u); // halfGround of 10, squared
  ASSERT_EQ(result.lights.size(), 1u);
  const LightResult& light = result.lights[0];
  EXPECT_EQ(light.counted, 8100u);
  for (const Pixels& found : { result.coverage, result.position, result.otherSurface,
         result.otherFace, result.normal, light.falseLight, light.falseShadow, light.unlit })
  {
    EXPECT_EQ(found, Pixels());
  }
}

TEST(Check, FindsTheFlippedPixelsAndNoOthers)
{
  TrueFile image;
  // Row 52 crosses the plate (columns 44 to 55) and the visible shadow beside it (to 64).
  ASSERT_EQ(image.at("visibility.0", 60, 52), 0.0f);
  ASSERT_EQ(image.at("visibility.0", 50, 52), 1.0f);
  image.at("visibility.0", 58, 50) = 1.0f;
  image.at("visibility.0", 60, 52) = 0.6f;
  image.at("visibility.0", 61, 52) = 0.4f; // on the right side
  image.at("visibility.0", 20, 30) = 0.0f;
  image.at("visibility.0", 50, 52) = std::numeric_limits<float>::quiet_NaN();
  image.at("coverage", 1, 1) = 1.0f;
  image.at("coverage", 70, 80) = 0.0f;
  const Result result = check(makeScene(), image.file);
  EXPECT_EQ(result.lights[0].falseLight, pixels({ { 58, 50 }, { 60, 52 } }));
  EXPECT_EQ(result.lights[0].falseShadow, pixels({ { 20, 30 }, { 50, 52 } }));
  EXPECT_EQ(result.lights[0].counted, 8099u);
  EXPECT_EQ(result.coverage, pixels({ { 1, 1 }, { 70, 80 } }));
  EXPECT_EQ(result.position, Pixels());
  EXPECT_EQ(result.failures().size(), 1u); // 2 of 10,000 pixels is still a coverage
}

TEST(Check, FindsWrongPositionsAndNormals)
{
  TrueFile image;
  const Vec3 aside(0.0, 1.0, 0.0);
  image.setPosition(30, 30, image.position(30, 30) + 0.0005 * aside); // 0.00004 of the distance
  image.setPosition(31, 30, image.position(31, 30) + 0.0020 * aside);
  image.setPosition(32, 30, image.position(33, 30)); // the neighbour's
  image.at("position.X", 33, 31) = std::numeric_limits<float>::infinity();
  image.at("normal.Y", 34, 32) = -1.0f;
  image.at("normal.X", 35, 32) = 0.01f;
  image.at("normal.X", 36, 32) = std::numeric_limits<float>::quiet_NaN();
  const Result result = check(makeScene(), image.file);
  EXPECT_EQ(result.position, pixels({ { 31, 30 }, { 32, 30 }, { 33, 31 } }));
  EXPECT_EQ(result.normal, pixels({ { 34, 32 }, { 35, 32 }, { 36, 32 } }));
  EXPECT_EQ(result.failures().size(), 1u); // 3 of 8,100 normals are within the tolerance
}

/// A rasteriser may draw the plate's edge in a pixel whose ray passes the plate and meets the
/// ground.
TEST(Check, AnotherSurfaceAtItsEdgeIsADifferenceInCoverage)
{
  // The plate's right edge is at 8 of 10 times the border's tangent. The ray of the first pixel
  // beside it passes at the given distance, in pixels.
  const auto compareWith = [](double pixels, double along, float visibility = 1.0f)
  {
    TrueFile image;
    nlohmann::json scene = makeScene();
    const int column = 56;
    const double tangent = 2.0 * (column + 0.5 - pixels) / sidePixels - 1.0;
    const double edge = (cameraHeight - plateHeight) * tangent;
    scene["models"][1]["matrix"][0] = edge;
    const double z = (cameraHeight - plateHeight) * (2.0 * 50.5 / sidePixels - 1.0);
    image.setPosition(column, 50, Vec3(edge - along, plateHeight, z));
    image.at("visibility.0", column, 50) = visibility;
    return check(scene, image.file);
  };
  const Result closely = compareWith(1.0 / 256.0, 0.0);
  EXPECT_EQ(closely.otherSurface, pixels({ { 56, 50 } }));
  EXPECT_EQ(closely.position, Pixels());
  // The plate is lit, and the ground behind it is not. The surface in the file counts.
  EXPECT_EQ(closely.lights[0].falseLight, Pixels());
  EXPECT_EQ(compareWith(1.0 / 256.0, 0.0, 0.0f).lights[0].falseShadow, pixels({ { 56, 50 } }));
  EXPECT_EQ(compareWith(1.0 / 16.0, 0.0).lights[0].falseLight, pixels({ { 56, 50 } }));
  // Too far beside the ray for a rasteriser, and not where the ray comes closest.
  EXPECT_EQ(compareWith(1.0 / 16.0, 0.0).otherSurface, Pixels());
  EXPECT_EQ(compareWith(1.0 / 16.0, 0.0).position, pixels({ { 56, 50 } }));
  EXPECT_EQ(compareWith(1.0 / 256.0, 0.05).position, pixels({ { 56, 50 } }));
  // The rays meet the plate where the file shows the ground. A ray just inside the edge allows
  // that.
  EXPECT_EQ(compareWith(-1.0 / 256.0, 0.0).position, Pixels());
  EXPECT_GT(compareWith(-1.0 / 256.0, 0.0).otherSurface.size(), 20u);
  EXPECT_EQ(compareWith(-1.0 / 16.0, 0.0).otherSurface, Pixels());
  EXPECT_GT(compareWith(-1.0 / 16.0, 0.0).position.size(), 20u);
}

/// Two faces meet in an edge beside the pixel's ray: positions there agree, normals do not.
TEST(Check, TheOtherFaceAtAnEdgeHasItsOwnLight)
{
  // The plate lies on the ground and is tilted about its left edge, away from the light.
  const auto compareWith = [](double beside, float visibility)
  {
    TrueFile image;
    nlohmann::json scene = makeScene();
    scene["lights"][0]["direction"] = { -1, -0.1, 0 };
    const int column = 60;
    const double tangent = 2.0 * (column + 0.5 + beside) / sidePixels - 1.0;
    const double edge = cameraHeight * tangent;
    const double slope = 0.5;
    scene["models"][1]["matrix"] = { 1, 0, 0, edge + 1.0, slope, 0, 0, slope, 0, 0, 1, 0, 0, 0, 0,
      1 };
    const double length = std::hypot(1.0, slope);
    image.at("normal.X", column, 50) = static_cast<float>(-slope / length);
    image.at("normal.Y", column, 50) = static_cast<float>(1.0 / length);
    image.at("visibility.0", column, 50) = visibility;
    const Result result = check(scene, image.file);
    const auto is = [&](const Pixels& found) {
      return std::binary_search(found.begin(), found.end(), pixels({ { column, 50 } })[0]);
    };
    return std::array<bool, 4>{ is(result.otherFace), is(result.lights[0].falseLight),
      is(result.lights[0].falseShadow), is(result.lights[0].unlit) };
  };
  EXPECT_EQ(compareWith(1.0 / 256.0, 0.0f), (std::array<bool, 4>{ true, false, false, false }));
  EXPECT_EQ(compareWith(1.0 / 256.0, 1.0f), (std::array<bool, 4>{ true, false, false, true }));
  EXPECT_EQ(compareWith(1.0 / 16.0, 1.0f)[0], false);
}

TEST(Check, HolesAreNeitherSeenNorCast)
{
  TrueFile image;
  nlohmann::json scene = makeScene();
  scene["models"][1]["texture"] = "left.png";
  Pixels seen;
  Pixels cast;
  for (int i = 0; i < sidePixels * sidePixels; ++i)
  {
    const int x = i % sidePixels, y = i / sidePixels;
    const Vec3 position = image.position(x, y);
    if (position.y > 1.0 && position.x < 0.0)
    {
      seen.push_back(pixels({ { x, y } })[0]);
    }
    // On the ground below the plate, too, the shadow's left half is not visible.
    if (image.at("coverage", x, y) > 0.5f && image.at("visibility.0", x, y) == 0.0f &&
      position.x < plateHeight)
    {
      cast.push_back(pixels({ { x, y } })[0]);
    }
  }
  ASSERT_GT(cast.size(), 10u);
  const Result result = check(scene, image.file);
  EXPECT_EQ(result.position, seen);
  EXPECT_EQ(result.lights[0].falseShadow, cast);
  EXPECT_EQ(result.lights[0].falseLight, Pixels());
}

TEST(Check, RefusesFilesThatLackSomething)
{
  TrueFile image;
  image.file.channels.erase("visibility.0");
  EXPECT_THROW(check(makeScene(), image.file), std::runtime_error);
  nlohmann::json scene = makeScene();
  scene.erase("camera");
  EXPECT_THROW(check(scene, TrueFile().file), std::runtime_error);
  scene = makeScene();
  scene["models"][0]["file"] = "missing.obj";
  EXPECT_THROW(check(scene, TrueFile().file), std::runtime_error);
}

} // namespace gnomon::check
