// Textures with holes: parts of a surface that VTK does not draw cast no shadow.

#include "PassScene.h"

#include "plugin/vtk_versions/SharedBlocksMapper.h"
#include "shadowtech/base/CutoutMask.h"

#include <vtkGlyph3DMapper.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkLookupTable.h>

using namespace gnomon::test;

namespace
{

/// A texture's texels, row by row from v = 0: '#' is drawn, '.' is a hole.
using Pattern = std::vector<std::string>;

const Pattern checker = { "#.#.", ".#.#", "#.#.", ".#.#" };
/// A pattern without symmetry.
const Pattern letter = { "###..", "#....", "##..#" };
const Pattern whole = { "##", "##" };

/// How a pattern is sampled.
struct Sampling
{
  int wrap = vtkTexture::Repeat;
  bool interpolated = false;
};

/// Return the mask of a pattern. EmbreeTracerTest.cpp compares masks with OpenGL's specification.
gnomon::CutoutMask maskOf(const Pattern& pattern, const Sampling& sampling = {})
{
  gnomon::CutoutMask mask;
  mask.width = static_cast<int>(pattern.front().size());
  mask.height = static_cast<int>(pattern.size());
  for (const std::string& row : pattern)
  {
    for (const char c : row)
    {
      mask.texels.push_back(c == '#' ? 255 : 0);
    }
  }
  mask.wrap = sampling.wrap == vtkTexture::ClampToEdge ? gnomon::TextureWrap::ClampToEdge
    : sampling.wrap == vtkTexture::ClampToBorder       ? gnomon::TextureWrap::ClampToBorder
    : sampling.wrap == vtkTexture::MirroredRepeat      ? gnomon::TextureWrap::MirroredRepeat
                                                       : gnomon::TextureWrap::Repeat;
  mask.interpolated = sampling.interpolated;
  return mask;
}

vtkSmartPointer<vtkImageData> imageOf(const Pattern& pattern)
{
  const auto at = [&](int value) { return static_cast<std::size_t>(value); };
  return makeVeil(static_cast<int>(pattern.front().size()), static_cast<int>(pattern.size()),
    [&](int x, int y) { return pattern[at(y)][at(x)] == '#' ? 255 : 0; });
}

vtkSmartPointer<vtkTexture> makeTexture(const Pattern& pattern, const Sampling& sampling = {})
{
  auto texture = textureOf(imageOf(pattern));
  texture->SetWrap(sampling.wrap);
  texture->SetInterpolate(sampling.interpolated);
  return texture;
}

/// Return the square of half side 2 around the z axis at height 5, its front up. Its texture
/// coordinates go from `first` to `last`.
vtkSmartPointer<vtkPolyData> makeSquare(const glm::dvec2& first = glm::dvec2(0.0),
  const glm::dvec2& last = glm::dvec2(1.0), const char* array = nullptr)
{
  const auto square =
    meshOf({ { -2.0, -2.0, 5.0 }, { 2.0, -2.0, 5.0 }, { 2.0, 2.0, 5.0 }, { -2.0, 2.0, 5.0 } },
      { { 0, 1, 2, 3 } });
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (const glm::dvec2& c : { first, { last.x, first.y }, last, { first.x, last.y } })
  {
    coordinates->InsertNextTuple2(c.x, c.y);
  }
  if (array)
  {
    coordinates->SetName(array);
    square->GetPointData()->AddArray(coordinates);
  }
  else
  {
    square->GetPointData()->SetTCoords(coordinates);
  }
  return square;
}

/// The place where a floor point's ray to the light meets the square's plane, in shares of its
/// sides.
using PlaceOnSquare = std::function<glm::dvec2(const glm::dvec2&)>;

/// A square with holes above a floor, under a sun at 45 degrees that moves its shadow by 5 along x,
/// out from under the square. The camera sees the shadow from straight above.
struct Cutouts : PassTestOf<Way>
{
  Cutouts()
  {
    this->scene.addFloor(8.0);
    this->scene.addSun(slantingSun);
    this->scene.choose(GetParam());
    this->scene.lookDown(2.6, 5.0);
  }

  /// Return the width of the band at edges that is skipped; nearly 0 for exact techniques.
  static double band()
  {
    const std::string technique = GetParam().technique;
    return technique == "raytraced" ? 1e-4 : technique == "nsm" ? 0.12 : 0.3;
  }

  /// @param drawn true if the caster has a surface at a place, as a share of the square's sides
  void expectShadow(const std::function<bool(const glm::dvec2&)>& drawn, const char* what = "",
    const PlaceOnSquare& place = underSun)
  {
    const Picture picture = this->scene.render();
    const ExactFloor exact = [&](const glm::dvec2& point)
    {
      const glm::dvec2 share = place(point);
      const bool on = share.x >= 0.0 && share.x <= 1.0 && share.y >= 0.0 && share.y <= 1.0;
      return on && drawn(share) ? 0.0 : slantingSunValue;
    };
    SCOPED_TRACE(what);
    expectRight(checkFloor(this->scene, picture, exact, band()), picture.pixels() / 5);
  }
  static glm::dvec2 underSun(const glm::dvec2& point)
  {
    return (point - glm::dvec2(3.0, -2.0)) / 4.0;
  }
  /// @param coordinates texture coordinates, from a share of the square's sides
  void expectPattern(
    const Pattern& pattern, const Sampling& sampling = {}, const char* what = "",
    const PlaceOnSquare& coordinates = [](const glm::dvec2& share) { return share; })
  {
    const gnomon::CutoutMask mask = maskOf(pattern, sampling);
    this->expectShadow(
      [&](const glm::dvec2& share) { return mask.isDrawn(coordinates(share)); }, what);
  }
  vtkActor* addSquare(vtkTexture* texture, const glm::dvec2& first = glm::dvec2(0.0),
    const glm::dvec2& last = glm::dvec2(1.0))
  {
    vtkActor* square = this->scene.add(makeSquare(first, last));
    square->SetTexture(texture);
    return square;
  }
  void expectNoNotes() { EXPECT_THAT(this->scene.report().notes, testing::IsEmpty()); }

  PassScene scene{ 130, 130 };
};

INSTANTIATE_TEST_SUITE_P(Ways, Cutouts, allWays, nameOf);

} // namespace

TEST_P(Cutouts, goByTheTexturesWrapping)
{
  const glm::dvec2 first(-1.3, -0.8);
  const glm::dvec2 last(1.9, 2.1);
  for (int i = 0; i < 8; ++i)
  {
    const int wraps[] = { vtkTexture::ClampToEdge, vtkTexture::Repeat, vtkTexture::MirroredRepeat,
      vtkTexture::ClampToBorder };
    const Sampling sampling{ wraps[i / 2], i % 2 == 1 };
    vtkActor* square = this->addSquare(makeTexture(letter, sampling), first, last);
    square->ForceOpaqueOn();
    this->expectPattern(letter, sampling, std::to_string(sampling.wrap).c_str(),
      [&](const glm::dvec2& share) { return first + share * (last - first); });
    this->scene.renderer->RemoveActor(square);
  }
  const auto texture = makeTexture(letter, { vtkTexture::ClampToBorder, false });
  texture->SetBorderColor(1.0f, 1.0f, 1.0f, 1.0f);
  this->addSquare(texture, glm::dvec2(-0.5), glm::dvec2(1.5));
  gnomon::CutoutMask mask = maskOf(letter, { vtkTexture::ClampToBorder, false });
  mask.borderDrawn = true;
  this->expectShadow([&](const glm::dvec2& share) { return mask.isDrawn(2.0 * share - 0.5); });
}

/// Texels are stored once for all actors that share a texture, and are freed with it.
TEST_P(Cutouts, ofATextureThatActorsShareTakeItsMemoryOnce)
{
  const auto texture = makeTexture(letter);
  this->addSquare(texture);
  this->addSquare(texture)->SetPosition(0.0, 0.0, -0.1);
  this->scene.render();
  const auto bytes = [&] { return static_cast<double>(this->scene.report().bytesOccluders); };
  const double before = bytes();
  const auto large = imageOf(Pattern(512, std::string(512, '#')));
  large->SetScalarComponentFromDouble(0, 0, 0, 3, 0.0);
  texture->SetInputData(large);
  this->scene.render();
  const bool hasMap = std::string(GetParam().technique) != "raytraced";
  const double texels = (hasMap ? 2 : 1) * 512 * 512;
  EXPECT_NEAR(bytes() - before, texels, 0.01 * texels);
  texture->SetInputData(imageOf(letter));
  this->scene.render();
  EXPECT_EQ(bytes(), before);
}

/// Alpha of all kinds of images: by a lookup table, beside grey, of numbers, and of one column,
/// which VTK takes for a row.
TEST_P(Cutouts, ofAllKindsOfImages)
{
  vtkNew<vtkTexture> texture;
  this->addSquare(texture);
  const auto imageOfTwo = [](int type, int channels, double value)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 1, 1);
    image->AllocateScalars(type, channels);
    image->GetPointData()->GetScalars()->Fill(value);
    return image;
  };
  const auto grey = imageOfTwo(VTK_UNSIGNED_CHAR, 2, 255.0);
  grey->SetScalarComponentFromDouble(1, 0, 0, 1, 0.0);
  texture->SetInputData(grey);
  this->expectPattern({ "#." }, {}, "grey");
  const auto numbers = imageOfTwo(VTK_FLOAT, 4, 1.0);
  numbers->SetScalarComponentFromDouble(0, 0, 0, 3, 0.0);
  texture->SetInputData(numbers);
  texture->SetColorMode(VTK_COLOR_MODE_DIRECT_SCALARS);
  this->expectPattern({ ".#" }, {}, "numbers");
  texture->SetColorMode(VTK_COLOR_MODE_DEFAULT);
  texture->SetInputData(imageOf({ "#", "." }));
  this->expectPattern({ "#." }, {}, "a column");
  const auto keys = imageOfTwo(VTK_SHORT, 1, 7.0);
  keys->SetScalarComponentFromDouble(1, 0, 0, 0, 8.0);
  vtkNew<vtkLookupTable> colors;
  colors->SetNumberOfTableValues(2);
  colors->SetTableRange(7.0, 8.0);
  texture->SetInputData(keys);
  texture->SetLookupTable(colors);
  for (const int hole : { 0, 1 })
  {
    colors->SetTableValue(hole, 1.0, 1.0, 1.0, 0.0);
    colors->SetTableValue(1 - hole, 1.0, 1.0, 1.0, 1.0);
    this->expectPattern({ hole == 0 ? ".#" : "#." }, {}, "a table");
  }
}

TEST_P(Cutouts, ofTranslucentSurfacesCountWhereTheseCast)
{
  // Between texels with and without alpha, alpha lies in between, so VTK treats the square as
  // translucent.
  vtkActor* square = this->scene.add(makeSquare());
  const Sampling interpolated{ vtkTexture::Repeat, true };
  square->SetTexture(makeTexture(letter, interpolated));
  this->expectPattern({ "." }, {}, "not asked to cast");
  EXPECT_FALSE(square->HasOpaqueGeometry());
  vtkGnomonPropKeys::SetTransmits(square, vtkGnomonPropKeys::TRANSMITS_NOTHING);
  vtkGnomonPropKeys::SetCasts(square, true);
  this->expectPattern(letter, interpolated, "asked to cast");
}

/// The clipping planes stay in place in world coordinates.
TEST_P(Cutouts, areCutAtClippingPlanes)
{
  vtkActor* square = this->addSquare(makeTexture(letter));
  clip(square->GetMapper(), { 0.3, 0.1, 5.0 }, { 1.0, 0.6, 0.0 });
  const gnomon::CutoutMask mask = maskOf(letter);
  for (const double y : { 0.0, 0.2 })
  {
    square->SetPosition(0.0, y, 0.0);
    const auto drawn = [&](const glm::dvec2& share)
    {
      const glm::dvec2 world = 4.0 * share + glm::dvec2(-2.0, y - 2.0);
      return glm::dot(world - glm::dvec2(0.3, 0.1), glm::dvec2(1.0, 0.6)) >= 0.0 &&
        mask.isDrawn(share);
    };
    this->expectShadow(drawn, y > 0.0 ? "moved" : "",
      [y](const glm::dvec2& point) { return underSun(point - glm::dvec2(0.0, y)); });
  }
}

TEST_P(Cutouts, ofOneSidedSurfacesCastFromTheirFront)
{
  vtkActor* square = this->addSquare(makeTexture(letter));
  vtkGnomonPropKeys::SetOneSided(square, true);
  this->expectPattern(letter);
  square->SetScale(1.0, -1.0, 1.0); // mirrored: its front is below
  this->expectPattern({ "." }, {}, "from behind");
}

TEST_P(Cutouts, changeWithTheirTexture)
{
  vtkActor* square = this->addSquare(makeTexture(checker));
  this->expectPattern(checker);
  EXPECT_TRUE(square->HasOpaqueGeometry());
  this->expectNoNotes();
  const auto image = imageOf(checker);
  square->GetTexture()->SetInputData(image);
  this->expectPattern(checker, {}, "another image, the same holes");
  EXPECT_EQ(this->scene.report().mapBakes, 0);
  EXPECT_EQ(this->scene.report().bvhBuilds, 0);
  image->DeepCopy(imageOf(letter));
  this->expectPattern(letter, {}, "other texels");
  EXPECT_EQ(this->scene.report().surfacesExtracted, 0);
  EXPECT_EQ(this->scene.report().bvhBuilds, 0);
  image->DeepCopy(imageOf(whole));
  this->expectPattern(whole, {}, "no holes");
  image->DeepCopy(imageOf(letter));
  this->expectPattern(letter, {}, "holes again");
  square->SetTexture(makeTexture(checker));
  this->expectPattern(checker, {}, "another texture");
  square->SetTexture(nullptr);
  this->expectPattern(whole, {}, "no texture");
  square->SetTexture(makeTexture(checker));
  this->expectPattern(checker, {}, "a texture again");
  square->GetTexture()->SetWrap(vtkTexture::ClampToBorder);
  this->expectPattern(checker, { vtkTexture::ClampToBorder, false }, "another wrapping");
  square->GetTexture()->InterpolateOn();
  square->ForceOpaqueOn();
  this->expectPattern(checker, { vtkTexture::ClampToBorder, true }, "interpolated");
}

TEST_P(Cutouts, goThroughTextureTransforms)
{
  vtkActor* square = this->addSquare(makeTexture(letter));
  vtkNew<vtkTransform> transform;
  transform->Translate(0.2, 0.1, 0.0);
  transform->Scale(1.5, -2.0, 1.0);
  const auto transformed = [](const glm::dvec2& share)
  { return share * glm::dvec2(1.5, -2.0) + glm::dvec2(0.2, 0.1); };
  square->GetTexture()->SetTransform(transform);
  this->expectPattern(letter, {}, "the texture's own", transformed);
  transform->Translate(0.5, 0.0, 0.0);
  this->expectPattern(letter, {}, "changed",
    [&](const glm::dvec2& share) { return transformed(share + glm::dvec2(0.5, 0.0)); });

  square->GetTexture()->SetTransform(nullptr);
  this->expectPattern(letter);
  vtkNew<vtkInformation> keys;
  square->SetPropertyKeys(keys);
  transform->Translate(-0.5, 0.0, 0.0);
  keys->Set(vtkProp::GNOMON_VTK_TEXTURE_TRANSFORM(), transform->GetMatrix()->GetData(), 16);
  this->expectPattern(letter, {}, "the actor's key", transformed);
}

TEST_P(Cutouts, ofAlbedoTexturesCountForPhysicalMaterials)
{
  vtkActor* square = this->scene.add(makeSquare());
  const auto texture = makeTexture(letter, { vtkTexture::Repeat, true });
  texture->UseSRGBColorSpaceOn();
  square->GetProperty()->SetBaseColorTexture(texture);
  this->expectPattern(whole, {}, "VTK's other shading does not look at it");
  square->GetProperty()->SetInterpolationToPBR();
  this->expectPattern(letter, { vtkTexture::Repeat, true });
  EXPECT_TRUE(square->HasOpaqueGeometry());
  // Surfaces behind the holes show their own visibility: the square itself is in this box's shadow.
  vtkActor* box = this->scene.addBox({ -5.5, -2.5, 8.0 }, { -0.9, 2.5, 8.1 });
  this->scene.lookDown(2.6);
  const Picture picture = this->scene.render();
  for (const glm::dvec2& share : { glm::dvec2(0.8, 0.3), glm::dvec2(0.6, 0.67) })
  {
    ASSERT_FALSE(maskOf(letter, { vtkTexture::Repeat, true }).isDrawn(share));
    EXPECT_NEAR(
      this->scene.redAt(picture, 4.0 * share.x - 2.0, 4.0 * share.y - 2.0), slantingSunValue, 1.0);
  }
  EXPECT_LT(this->scene.redAt(picture, 0.0, -1.33), 30) << "a texel of the square";
  this->scene.renderer->RemoveActor(box);
  this->scene.lookDown(2.6, 5.0);
  square->GetProperty()->SetBaseColorTexture(nullptr);
  square->GetProperty()->RemoveTexture("albedoTex");
  square->SetTexture(makeTexture(letter));
  this->expectPattern(whole, {}, "physically based shading does not look at the actor's texture");
}

TEST_P(Cutouts, ofAPropertysTextureWithCoordinatesOfItsOwn)
{
  const glm::dvec2 last(2.0, 3.0);
  const auto data = makeSquare(glm::dvec2(0.0), last, "places");
  vtkActor* square = this->scene.add(data);
  square->GetProperty()->SetTexture("leaves", makeTexture(letter));
  square->GetProperty()->SetTexture("normalTex", makeTexture({ "." }));
  auto* mapper = vtkPolyDataMapper::SafeDownCast(square->GetMapper());
  mapper->MapDataArrayToMultiTextureAttribute(
    "leaves", "places", vtkDataObject::FIELD_ASSOCIATION_POINTS);
  this->expectPattern(letter, {}, "", [&](const glm::dvec2& share) { return share * last; });
  this->expectNoNotes();
}

TEST_P(Cutouts, ofCompositeBlocksGlyphsAndStrips)
{
  const auto data = makeSquare();
  const auto texture = makeTexture(letter);

  vtkNew<gnomon::SharedBlocksMapper> composite;
  composite->SetInputDataObject(blocksOf({ data }));
  const auto actor = actorOf(composite);
  actor->SetTexture(texture);
  this->scene.renderer->AddActor(actor);
  this->expectPattern(letter, {}, "composite");

  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(meshOf({ { -1.0, 0.0, 2.5 }, { 1.0, 0.0, 2.5 } }, {}));
  glyphs->SetSourceData(data);
  glyphs->SetScaleFactor(0.5);
  actor->SetMapper(glyphs);
  this->expectShadow(
    [](const glm::dvec2& share)
    {
      const double y = 2.0 * share.y - 0.5;
      return y >= 0.0 && y <= 1.0 && maskOf(letter).isDrawn({ 2.0 * share.x, y });
    },
    "glyphs");
  this->scene.renderer->RemoveActor(actor);

  data->SetPolys(nullptr);
  data->SetStrips(cellsOf({ { 0, 1, 3, 2 } }));
  this->scene.add(data)->SetTexture(texture);
  this->expectPattern(letter, {}, "strip");
}

TEST_P(Cutouts, thatAreNotServedCastAsAWholeAndAreNoted)
{
  vtkActor* square = this->addSquare(makeTexture(letter));
  const auto expectNote = [&](const char* why)
  {
    this->expectPattern(whole, {}, why);
    EXPECT_THAT(this->scene.report().notes,
      testing::ElementsAre(testing::AllOf(testing::HasSubstr("holes"), testing::HasSubstr(why))));
  };
  square->GetProperty()->ShowTexturesOnBackfaceOff();
  expectNote("front only");
  vtkGnomonPropKeys::SetCasts(square, false);
  this->expectPattern({ "." }, {}, "what does not cast");
  this->expectNoNotes();
  vtkGnomonPropKeys::SetCasts(square, true);
  square->GetProperty()->ShowTexturesOnBackfaceOn();
  auto* mapper = vtkPolyDataMapper::SafeDownCast(square->GetMapper());
  mapper->SeamlessUOn();
  expectNote("seamless");
  mapper->SeamlessUOff();
  const auto second = makeTexture(whole);
  square->GetProperty()->SetTexture("second", second);
  this->expectPattern(letter, {}, "a second texture that VTK does not blend");
  this->expectNoNotes();
  second->SetBlendingMode(vtkTexture::VTK_TEXTURE_BLENDING_MODE_MODULATE);
  expectNote("blended");
}

TEST_P(Cutouts, areLookedThroughAtWhatLiesBehind)
{
  vtkActor* upper = this->scene.add(makeSquare());
  upper->SetTexture(makeTexture({ "#." }));
  vtkActor* lower = this->scene.add(makeSquare());
  lower->SetTexture(makeTexture({ "##", ".." }));
  lower->SetPosition(1.0, 0.0, -1.0); // in the upper one's shadow
  this->expectPattern({ "##", "#." });
}
