// vtkGnomonAreaLight, and the sizes of lights for shadows from all their sources.

#include "lights/vtkGnomonAreaLight.h"

#include "VtkMessages.h"

#include "lights/LightManager.h"
#include "lights/LightTexture.h"
#include "lights/SceneFrame.h"
#include "lights/vtkGnomonLightKeys.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Read a light as shadows see it.
LightSet read(vtkLight* light)
{
  vtkNew<vtkRenderer> renderer;
  renderer->AddLight(light);
  return LightManager().collect(renderer, {});
}

/// Return the area of a light that casts; a disk of size 0 if it has none.
LightArea areaOf(vtkLight* light)
{
  const LightSet set = read(light);
  EXPECT_EQ(set.lights.size(), 1u);
  return set.lights.empty() || !set.lights[0].area ? LightArea{} : *set.lights[0].area;
}

std::string reasonOf(vtkLight* light)
{
  LightSet set = read(light);
  return set.skipped.empty() ? enterFrame(set.lights[0], SceneFrame()) : set.skipped[0].reason;
}

vtkSmartPointer<vtkGnomonAreaLight> makeRectangle(double width, double height)
{
  auto light = vtkSmartPointer<vtkGnomonAreaLight>::New();
  light->SetPosition(1.0, 2.0, 5.0);
  light->SetFocalPoint(1.0, 2.0, 0.0);
  light->SetShapeToRectangle();
  light->SetWidth(width);
  light->SetHeight(height);
  return light;
}

/// Return the key that OSPRay's module defines, if it is loaded.
vtkInformationDoubleKey* ospRayKey()
{
  static vtkInformationDoubleKey* const key =
    vtkInformationDoubleKey::MakeKey("RADIUS", "vtkOSPRayLightNode");
  return key;
}

TEST(AreaLight, isARectangleInTheWorld)
{
  const auto light = makeRectangle(2.0, 0.5);
  const LightArea area = areaOf(light);
  EXPECT_EQ(area.shape, LightArea::Shape::Rectangle);
  EXPECT_NEAR(glm::distance(glm::abs(area.worldFromUnit[0]), { 1.0, 0.0, 0.0 }), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(area.worldFromUnit[1], { 0.0, 0.25, 0.0 }), 0.0, 1e-12);

  // The transform turns the light and its up direction, but does not scale it.
  vtkNew<vtkMatrix4x4> turn;
  const double numbers[16] = { 0, -3, 0, 7, 3, 0, 0, 8, 0, 0, 3, 9, 0, 0, 0, 1 };
  turn->DeepCopy(numbers);
  light->SetTransformMatrix(turn);
  const LightArea turned = areaOf(light);
  EXPECT_NEAR(glm::distance(turned.worldFromUnit[1], { -0.25, 0.0, 0.0 }), 0.0, 1e-12);
}

TEST(AreaLight, ofADirectionHasAngles)
{
  const auto light = makeRectangle(90.0, 60.0);
  light->PositionalOff();
  const LightArea area = areaOf(light);
  EXPECT_NEAR(glm::length(area.worldFromUnit[0]), 1.0, 1e-12);
  EXPECT_NEAR(glm::length(area.worldFromUnit[1]), std::tan(glm::pi<double>() / 6.0), 1e-12);
  light->SetShapeToDisk();
  light->SetRadius(90.0); // a sun's diameter in degrees
  EXPECT_NEAR(glm::length(areaOf(light).worldFromUnit[0]), 1.0, 1e-12);
  light->SetRadius(180.0);
  EXPECT_EQ(reasonOf(light), "it fills 180 degrees or more");
}

TEST(AreaLight, isADiskByDefault)
{
  vtkNew<vtkGnomonAreaLight> light;
  const LightSet set = read(light);
  ASSERT_EQ(set.lights.size(), 1u);
  EXPECT_EQ(set.lights[0].kind, LightKind::Point);
  const LightArea area = areaOf(light);
  EXPECT_EQ(area.shape, LightArea::Shape::Disk);
  EXPECT_NEAR(glm::length(area.worldFromUnit[0]), 0.5, 1e-12);
  EXPECT_NEAR(glm::length(area.worldFromUnit[1]), 0.5, 1e-12);
  EXPECT_NEAR(area.worldFromUnit[0].z, 0.0, 1e-12) << "it shines along -z";
}

TEST(AreaLight, withoutSizeIsAPoint)
{
  const auto light = makeRectangle(0.0, 0.0);
  EXPECT_FALSE(read(light).lights.at(0).area.has_value());
  light->SetWidth(-3.0);
  EXPECT_EQ(light->GetWidth(), 0.0);
  light->SetHeight(1.0);
  EXPECT_TRUE(read(light).lights.at(0).area.has_value()) << "a tube";
}

const glm::dvec3 areaTravel = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
const LightArea allShapes[] = { rectangleArea(areaTravel, { 0.0, 0.0, 1.0 }, { 0.6, 0.2 }),
  diskArea(areaTravel, 0.5), ballArea(0.5) };

/// The rim lies at the light's reach, everywhere around its centre; no two points coincide.
TEST(AreaLight, hasARim)
{
  for (const LightArea& area : allShapes)
  {
    const bool ball = area.shape == LightArea::Shape::Ball;
    for (const std::size_t count : { 1u, 4u, 7u, 16u })
    {
      const std::vector<glm::dvec3> rim = rimOf(area, count);
      ASSERT_EQ(rim.size(), count);
      glm::dvec3 sum(0.0);
      for (std::size_t i = 0; i < count; ++i)
      {
        sum += rim[i];
        const glm::dvec3 &x = area.worldFromUnit[0], &y = area.worldFromUnit[1];
        const glm::dvec2 unit(
          glm::dot(rim[i], x) / glm::dot(x, x), glm::dot(rim[i], y) / glm::dot(y, y));
        const double extent = ball                    ? glm::length(rim[i]) / 0.5
          : area.shape == LightArea::Shape::Rectangle ? std::max(std::abs(unit.x), std::abs(unit.y))
                                                      : glm::length(unit);
        EXPECT_NEAR(extent, 1.0, 1e-12);
        EXPECT_TRUE(ball || std::abs(glm::dot(rim[i], areaTravel)) < 1e-12);
        for (std::size_t k = 0; k < i; ++k)
        {
          EXPECT_GT(glm::length(rim[i] - rim[k]), 1.2 * area.radius() / static_cast<double>(count));
        }
      }
      EXPECT_TRUE(
        count == 1 || glm::length(sum) < 0.2 * area.radius() * static_cast<double>(count));
    }
  }
  // A rectangle's four are its corners.
  for (const glm::dvec3& corner : rimOf(allShapes[0], 4))
  {
    EXPECT_NEAR(glm::length(corner), allShapes[0].radius(), 1e-12);
  }
}

/// The extent along any direction is that of the farthest rim point.
TEST(AreaLight, hasAnExtent)
{
  for (const LightArea& area : allShapes)
  {
    const std::vector<glm::dvec3> rim = rimOf(area, 20000);
    EXPECT_LT(
      area.extentAlong(areaTravel), area.shape == LightArea::Shape::Ball ? 0.5 + 1e-12 : 1e-12);
    for (const glm::dvec3& across : rimOf(ballArea(1.0), 50))
    {
      double farthest = 0.0;
      for (const glm::dvec3& point : rim)
      {
        farthest = std::max(farthest, glm::dot(point, across));
      }
      EXPECT_NEAR(area.extentAlong(across), farthest, 2e-4);
      EXPECT_EQ(area.extentAlong(-across), area.extentAlong(across));
    }
  }
}

TEST(AreaLight, takesOSPRaysRadius)
{
  vtkNew<vtkLight> sun;
  EXPECT_FALSE(read(sun).lights.at(0).area.has_value());
  sun->GetInformation()->Set(ospRayKey(), 90.0);
  EXPECT_EQ(areaOf(sun).shape, LightArea::Shape::Disk);
  EXPECT_NEAR(glm::length(areaOf(sun).worldFromUnit[0]), 1.0, 1e-12);

  vtkNew<vtkLight> spot;
  spot->PositionalOn();
  spot->SetConeAngle(40.0);
  spot->GetInformation()->Set(ospRayKey(), 0.25);
  EXPECT_EQ(areaOf(spot).shape, LightArea::Shape::Disk);
  EXPECT_NEAR(glm::length(areaOf(spot).worldFromUnit[0]), 0.25, 1e-12);
  spot->SetConeAngle(90.0); // OSPRay draws it as a sphere
  EXPECT_EQ(areaOf(spot).shape, LightArea::Shape::Ball);
  EXPECT_EQ(areaOf(spot).worldFromUnit, glm::dmat3(0.25));

  // The class takes precedence over the key, and the setting over both.
  const auto area = makeRectangle(2.0, 2.0);
  area->GetInformation()->Set(ospRayKey(), 0.25);
  EXPECT_EQ(areaOf(area).shape, LightArea::Shape::Rectangle);
  vtkGnomonLightKeys::SetSetting(area, "light_radius", "0.125");
  EXPECT_EQ(areaOf(area).worldFromUnit, glm::dmat3(0.125));
}

TEST(AreaLight, setsOSPRaysRadius)
{
  ospRayKey(); // loads the key of OSPRay's module
  const auto told = [](vtkLight* light)
  {
    vtkInformation* const keys = light->GetInformation();
    return keys->Has(ospRayKey()) ? keys->Get(ospRayKey()) : -1.0;
  };
  vtkNew<vtkGnomonAreaLight> disk;
  EXPECT_EQ(told(disk), disk->GetRadius());
  disk->SetRadius(0.25);
  EXPECT_EQ(told(disk), 0.25);
  disk->SetShapeToRectangle();
  EXPECT_EQ(told(disk), -1.0);
  disk->SetShapeToDisk();
  EXPECT_EQ(told(disk), 0.25);
  disk->SetRadius(-1.0);
  EXPECT_EQ(disk->GetRadius(), 0.0);
  EXPECT_EQ(told(disk), 0.0);
  disk->GetInformation()->Remove(ospRayKey()); // as if the module were loaded afterwards
  disk->SetRadius(0.0);
  EXPECT_EQ(told(disk), 0.0);
  disk->SetRadius(std::numeric_limits<double>::infinity());
  EXPECT_EQ(told(disk), -1.0);

  vtkNew<vtkGnomonAreaLight> copy;
  disk->SetRadius(3.0);
  copy->DeepCopy(disk);
  EXPECT_EQ(told(copy), 3.0);
  vtkNew<vtkLight> plain;
  copy->DeepCopy(plain);
  EXPECT_EQ(told(copy), copy->GetRadius()) << "the information is the other light's";
  const auto rectangle = makeRectangle(2.0, 1.0);
  rectangle->GetInformation()->Set(ospRayKey(), 0.75); // set by the application
  copy->DeepCopy(rectangle);
  EXPECT_EQ(told(copy), 0.75);
}

TEST(AreaLight, withInvalidSizesCastsNothing)
{
  vtkNew<vtkLight> sun;
  sun->GetInformation()->Set(ospRayKey(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(reasonOf(sun), "its area is not finite");
  auto light = makeRectangle(std::numeric_limits<double>::infinity(), 1.0);
  EXPECT_EQ(reasonOf(light), "its area is too large");
  light->SetWidth(1.0);
  EXPECT_EQ(reasonOf(light), "");
  for (const double z : { 1.0, -3.0, 0.0 })
  {
    light->SetUp(0.0, 0.0, z);
    EXPECT_EQ(reasonOf(light), "its area has its up direction along the light");
  }
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(2, 1, 1e300);
  light->SetTransformMatrix(matrix);
  light->SetPosition(1.0, 0.0, 5.0);
  light->SetFocalPoint(1.0, 0.0, 0.0);
  light->SetUp(0.0, 1e100, 0.0);
  EXPECT_EQ(reasonOf(light), "its area's up direction is not finite");
  light->SetTransformMatrix(nullptr);
  light->SetUp(0.0, 1.0, 0.0);
  light->SetFocalPoint(light->GetPosition());
  EXPECT_EQ(reasonOf(light), "its position and focal point give no direction");
  light->SetSwitch(false);
  EXPECT_EQ(reasonOf(light), "switched off") << "what comes first";
}

TEST(AreaLight, refusesNumbersThatAreNone)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const tool::VtkMessages messages;
  const auto light = makeRectangle(2.0, 0.5);
  light->SetRadius(nan);
  light->SetWidth(nan);
  light->SetHeight(nan);
  light->SetUp(0.0, nan, 1.0);
  EXPECT_EQ(messages.errors().size(), 4u);
  EXPECT_EQ(light->GetRadius(), 0.5);
  EXPECT_EQ(light->GetWidth(), 2.0);
  EXPECT_EQ(light->GetHeight(), 0.5);
  EXPECT_EQ(light->GetUp()[1], 1.0);
}

TEST(AreaLight, isCopied)
{
  const auto light = makeRectangle(2.0, 0.5);
  light->SetUp(1.0, 2.0, 3.0);
  light->SetRadius(7.0);
  light->SetIntensity(0.25);
  light->SetTexture(vtkNew<vtkImageData>());
  vtkNew<vtkMatrix4x4> matrix;
  light->SetTransformMatrix(matrix);
  vtkNew<vtkGnomonAreaLight> copy;
  copy->DeepCopy(light);
  EXPECT_NE(copy->GetTransformMatrix(), light->GetTransformMatrix());
  const auto clone = vtkSmartPointer<vtkLight>::Take(light->ShallowClone());
  EXPECT_EQ(clone->GetTransformMatrix(), light->GetTransformMatrix());
  for (vtkLight* other : { static_cast<vtkLight*>(copy.Get()), clone.Get() })
  {
    auto* area = vtkGnomonAreaLight::SafeDownCast(other);
    ASSERT_NE(area, nullptr);
    EXPECT_EQ(area->GetShape(), vtkGnomonAreaLight::RECTANGLE);
    EXPECT_EQ(area->GetWidth(), 2.0);
    EXPECT_EQ(area->GetHeight(), 0.5);
    EXPECT_EQ(area->GetRadius(), 7.0);
    EXPECT_EQ(area->GetUp()[2], 3.0);
    EXPECT_EQ(area->GetTexture(), light->GetTexture());
    EXPECT_EQ(area->GetIntensity(), 0.25);
    EXPECT_EQ(area->GetPosition()[2], 5.0);
  }
  vtkNew<vtkLight> plain;
  plain->SetIntensity(0.5);
  copy->DeepCopy(plain);
  EXPECT_EQ(copy->GetIntensity(), 0.5);
  EXPECT_EQ(copy->GetWidth(), 2.0);
}

TEST(AreaLight, hasAModificationTimeAndPrints)
{
  vtkNew<vtkGnomonAreaLight> light;
  const auto changes = [&](const auto& change)
  {
    const vtkMTimeType before = light->GetMTime();
    change();
    return light->GetMTime() > before;
  };
  EXPECT_TRUE(changes([&] { light->SetShapeToRectangle(); }));
  EXPECT_TRUE(changes([&] { light->SetWidth(3.0); }));
  EXPECT_TRUE(changes([&] { light->SetHeight(4.0); }));
  EXPECT_TRUE(changes([&] { light->SetRadius(5.0); }));
  EXPECT_TRUE(changes([&] { light->SetUp(1.0, 0.0, 0.0); }));
  EXPECT_FALSE(changes([&] { light->SetWidth(3.0); }));
  std::ostringstream text;
  light->Print(text);
  for (const char* part :
    { "Shape: Rectangle", "Radius: 5", "Width: 3", "Height: 4", "Up: (1, 0, 0)" })
  {
    EXPECT_NE(text.str().find(part), std::string::npos) << part;
  }
}

// Textures of area lights: which images are valid, where their texels lie, and when lights read
// them.

vtkSmartPointer<vtkImageData> makeImage(
  int width, int height, int type, int components, double value)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(type, components);
  image->GetPointData()->GetScalars()->Fill(value);
  return image;
}

/// An image of 2 x 2 texels: below green and blue, above red and yellow.
vtkSmartPointer<vtkImageData> makeFour()
{
  const auto image = makeImage(2, 2, VTK_UNSIGNED_CHAR, 3, 0.0);
  image->SetScalarComponentFromDouble(0, 0, 0, 1, 255.0);
  image->SetScalarComponentFromDouble(1, 0, 0, 2, 255.0);
  image->SetScalarComponentFromDouble(0, 1, 0, 0, 255.0);
  image->SetScalarComponentFromDouble(1, 1, 0, 0, 255.0);
  image->SetScalarComponentFromDouble(1, 1, 0, 1, 255.0);
  return image;
}

std::shared_ptr<const LightTexture> readGood(vtkImageData* image)
{
  std::string reason;
  const std::shared_ptr<const LightTexture> texture = readLightTexture(image, reason);
  EXPECT_TRUE(texture) << reason;
  EXPECT_EQ(reason, "");
  return texture;
}

std::string reasonOf(vtkImageData* image)
{
  std::string reason;
  EXPECT_FALSE(readLightTexture(image, reason));
  return reason;
}

/// A lamp that shines down onto the origin.
class TexturedLight : public testing::Test
{
protected:
  TexturedLight()
  {
    this->light->SetPosition(0.0, 0.0, 5.0);
    this->light->SetFocalPoint(0.0, 0.0, 0.0);
    this->light->SetShapeToRectangle();
    this->light->SetWidth(4.0);
    this->light->SetHeight(2.0);
    this->light->SetTexture(makeFour());
    this->renderer->AddLight(this->light);
  }

  ShadowLight read()
  {
    const LightSet set = this->manager.collect(this->renderer, {});
    EXPECT_EQ(set.lights.size(), 1u);
    return set.lights.empty() ? ShadowLight() : set.lights[0];
  }
  std::string reason()
  {
    const LightSet set = this->manager.collect(this->renderer, {});
    return set.skipped.empty() ? "" : set.skipped[0].reason;
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGnomonAreaLight> light;
  LightManager manager;
};

TEST(LightTexture, isReadFromGreyAndColoursOfFourTypes)
{
  struct Case
  {
    int type;
    double half; ///< the type's 128 / 255
  };
  for (const Case& of : { Case{ VTK_UNSIGNED_CHAR, 128.0 }, { VTK_UNSIGNED_SHORT, 32896.0 },
         { VTK_FLOAT, 128.0 / 255.0 }, { VTK_DOUBLE, 128.0 / 255.0 } })
  {
    for (const int components : { 1, 2, 3, 4 })
    {
      const auto image = makeImage(3, 2, of.type, components, 0.0);
      image->SetScalarComponentFromDouble(2, 1, 0, 0, of.half);
      const auto texture = readGood(image);
      ASSERT_TRUE(texture);
      EXPECT_EQ(texture->width, 3);
      EXPECT_EQ(texture->height, 2);
      const bool grey = components < 3;
      EXPECT_EQ(texture->texels[5], glm::u8vec3(128, grey ? 128 : 0, grey ? 128 : 0));
      EXPECT_EQ(texture->texels[4], glm::u8vec3(0));
      EXPECT_NEAR(texture->meanOfRectangle.r, 128.0 / 255.0 / 6.0, 1e-12);
    }
  }
}

TEST(LightTexture, refusesInvalidImages)
{
  vtkNew<vtkImageData> empty;
  EXPECT_EQ(reasonOf(empty), "its texture has no points with scalars");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  EXPECT_EQ(reasonOf(bare), "its texture has no points with scalars");
  const auto short1 = makeImage(2, 2, VTK_UNSIGNED_CHAR, 3, 255.0);
  short1->GetPointData()->GetScalars()->SetNumberOfTuples(3);
  EXPECT_EQ(reasonOf(short1), "its texture has no points with scalars");
  vtkNew<vtkImageData> thick;
  thick->SetDimensions(2, 2, 3);
  thick->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  EXPECT_EQ(reasonOf(thick), "its texture has 3 slices instead of 1");
  EXPECT_EQ(reasonOf(makeImage(2, 2, VTK_UNSIGNED_CHAR, 5, 1.0)),
    "its texture has 5 components instead of 1 to 4");
  EXPECT_EQ(reasonOf(makeImage(2, 2, VTK_INT, 3, 1.0)),
    "its texture has values of type int, expected unsigned char, unsigned short, float or double");
  for (const double bad : { -0.25, 1.5, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    const auto image = makeImage(3, 2, VTK_FLOAT, 3, 1.0);
    image->SetScalarComponentFromDouble(1, 1, 0, 2, bad);
    EXPECT_EQ(reasonOf(image),
      "its texture is " + std::to_string(bad) + " at texel (1, 1), expected 0 to 1");
  }
  // Alpha is ignored.
  const auto image = makeImage(3, 2, VTK_FLOAT, 4, 1.0);
  image->SetScalarComponentFromDouble(1, 1, 0, 3, -3.0);
  EXPECT_TRUE(readGood(image));
}

TEST(LightTexture, hasTheMeanOfItsShape)
{
  const auto white = readGood(makeImage(7, 3, VTK_UNSIGNED_CHAR, 3, 255.0));
  EXPECT_EQ(white->meanOfRectangle, glm::dvec3(1.0));
  EXPECT_EQ(white->meanOfDisk, glm::dvec3(1.0));

  const auto four = readGood(makeFour());
  EXPECT_NEAR(glm::distance(four->meanOfRectangle, { 0.5, 0.5, 0.25 }), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(four->meanOfDisk, { 0.5, 0.5, 0.25 }), 0.0, 1e-9);

  // Three columns, the middle one lit. On a disk that is |x| < a = 1 / 3, a share of (2 / pi) (a
  // sqrt(1 - a^2) + asin a).
  const auto column = makeImage(3, 3, VTK_UNSIGNED_CHAR, 1, 0.0);
  for (int y = 0; y < 3; ++y)
  {
    column->SetScalarComponentFromDouble(1, y, 0, 0, 255.0);
  }
  EXPECT_NEAR(readGood(column)->meanOfRectangle.g, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(readGood(column)->meanOfDisk.g, 0.4164, 2e-4);
}

TEST_F(TexturedLight, isUprightSeenFromTheScene)
{
  // A viewer who looks up has y up, and so -x to the right.
  const glm::vec3 red(255, 0, 0);
  const glm::vec3 green(0, 255, 0);
  const glm::vec3 blue(0, 0, 255);
  const glm::vec3 yellow(255, 255, 0);
  for (const bool disk : { false, true })
  {
    disk ? this->light->SetShapeToDisk() : this->light->SetShapeToRectangle();
    const ShadowLight read = this->read();
    ASSERT_TRUE(read.texture.has_value());
    EXPECT_EQ(read.texture->colourAt({ 0.1, 0.1, 0.0 }), red);
    EXPECT_EQ(read.texture->colourAt({ -0.1, 0.1, 0.0 }), yellow);
    EXPECT_EQ(read.texture->colourAt({ 0.1, -0.1, 0.0 }), green);
    EXPECT_EQ(read.texture->colourAt({ -0.1, -0.1, 0.0 }), blue);
  }
  // The picture's up is the light's up, also if that is not across the light. The transform turns
  // it.
  this->light->SetShapeToRectangle();
  this->light->SetUp(1.0, 0.0, 7.0);
  EXPECT_EQ(this->read().texture->colourAt({ 0.1, 0.1, 0.0 }), yellow);
  EXPECT_EQ(this->read().texture->colourAt({ 0.1, -0.1, 0.0 }), red);
  EXPECT_EQ(this->read().texture->colourAt({ -0.1, -0.1, 0.0 }), green);
  this->light->SetUp(0.0, 1.0, 0.0);
  vtkNew<vtkMatrix4x4> turn;
  const double numbers[16] = { 0, -3, 0, 7, 3, 0, 0, 8, 0, 0, 3, 9, 0, 0, 0, 1 };
  turn->DeepCopy(numbers);
  this->light->SetTransformMatrix(turn);
  EXPECT_EQ(this->read().texture->colourAt({ -0.1, 0.1, 0.0 }), red);
}

TEST_F(TexturedLight, fillsItsShapeAndEndsThere)
{
  const auto image = makeImage(4, 2, VTK_UNSIGNED_CHAR, 1, 0.0);
  for (int x = 0; x < 4; ++x)
  {
    image->SetScalarComponentFromDouble(x, 0, 0, 0, 10.0 * x);
    image->SetScalarComponentFromDouble(x, 1, 0, 0, 10.0 * x + 100.0);
  }
  this->light->SetTexture(image);
  const ShadowLight read = this->read();
  // Texels of this rectangle are 1 by 1.
  for (int x = 0; x < 4; ++x)
  {
    for (const float inTexel : { 0.01f, 0.99f })
    {
      const float place = 2.0f - (static_cast<float>(x) + inTexel);
      EXPECT_EQ(read.texture->colourAt({ place, -0.99f, 0.0f }).r, 10.0f * static_cast<float>(x));
      EXPECT_EQ(
        read.texture->colourAt({ place, 0.01f, 0.0f }).r, 10.0f * static_cast<float>(x) + 100.0f);
    }
  }
  // Rounding may take a point beyond the border.
  EXPECT_EQ(read.texture->colourAt({ 2.001f, 1.001f, 0.0f }).r, 100.0f);
  EXPECT_EQ(read.texture->colourAt({ -2.001f, -1.001f, 0.0f }).r, 30.0f);
}

TEST_F(TexturedLight, isReadOnceUntilItChanges)
{
  const auto first = this->read().texture->texture;
  EXPECT_EQ(this->read().texture->texture, first);
  this->light->SetWidth(3.0);
  EXPECT_EQ(this->read().texture->texture, first);
  vtkImageData* const image = this->light->GetTexture();
  image->SetScalarComponentFromDouble(0, 0, 0, 0, 77.0);
  EXPECT_EQ(this->read().texture->texture, first) << "nobody said that it was modified";
  image->GetPointData()->GetScalars()->Modified();
  const auto second = this->read().texture->texture;
  EXPECT_NE(second, first);
  EXPECT_EQ(second->texels[0].r, 77);
  this->light->SetTexture(nullptr);
  EXPECT_FALSE(this->read().texture.has_value());
}

TEST_F(TexturedLight, sharesAnImageThatIsReadOnce)
{
  vtkNew<vtkGnomonAreaLight> other;
  other->DeepCopy(this->light);
  this->renderer->AddLight(other);
  std::shared_ptr<const LightTexture> first;
  for (int frame = 0; frame < 2; ++frame)
  {
    const gnomon::LightSet set = this->manager.collect(this->renderer, {});
    ASSERT_EQ(set.lights.size(), 2u);
    EXPECT_EQ(set.lights[1].texture->texture, set.lights[0].texture->texture);
    first = first ? first : set.lights[0].texture->texture;
    EXPECT_EQ(set.lights[0].texture->texture, first);
  }
}

TEST_F(TexturedLight, isSkippedWithAReason)
{
  vtkGnomonLightKeys::SetSetting(this->light, "light_radius", "0.5");
  EXPECT_EQ(this->reason(), "its texture lies on its own area, which 'light_radius' replaces");
  vtkGnomonLightKeys::SetSetting(this->light, "light_radius", "0");
  EXPECT_EQ(this->reason(), "");
  this->light->SetShapeToDisk();
  this->light->SetUp(0.0, 0.0, 1.0);
  EXPECT_EQ(this->reason(), "its area has its up direction along the light");
  this->light->SetUp(0.0, 1.0, 0.0);
  this->light->SetTexture(makeImage(1, 1, VTK_FLOAT, 1, -1.0));
  for (int frame = 0; frame < 2; ++frame) // the second frame does not read the image again
  {
    EXPECT_EQ(this->reason(), "its texture is -1.000000 at texel (0, 0), expected 0 to 1");
  }
  this->light->SwitchOff();
  EXPECT_EQ(this->reason(), "switched off");
}

TEST_F(TexturedLight, ofNoSizeHasItsMean)
{
  this->light->SetWidth(0.0);
  this->light->SetHeight(0.0);
  const ShadowLight point = this->read();
  EXPECT_FALSE(point.area.has_value());
  ASSERT_TRUE(point.texture.has_value());
  EXPECT_EQ(point.texture->mean, glm::vec3(0.5f, 0.5f, 0.25f));
  // A line-shaped light has the texels along it.
  this->light->SetWidth(4.0);
  const ShadowLight line = this->read();
  EXPECT_EQ(line.texture->colourAt({ 1.0, 0.0, 0.0 }), glm::vec3(255, 0, 0));
  EXPECT_EQ(line.texture->colourAt({ -1.0, 0.0, 0.0 }), glm::vec3(255, 255, 0));
}

} // namespace
} // namespace gnomon::test
