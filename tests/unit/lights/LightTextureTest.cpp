// Textures of area lights: which images are valid, where their texels lie, and when lights read
// them.

#include "lights/LightTexture.h"

#include "lights/LightManager.h"
#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

namespace gnomon::test
{
namespace
{

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
