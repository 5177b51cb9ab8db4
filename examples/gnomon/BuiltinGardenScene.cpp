#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkMath.h>

#include <cmath>
#include <utility>

// A replacement for the scene of Morais' thesis, "Rasterization + Ray Tracing: Rendering of Hard
// Shadows" (Minho), section 5.1, and of its sibling on selective ray tracing: two trees, a lamp, a
// flower box and a bench on a ground plane. Light, cameras and number of triangles are the theses';
// their models are not available. A unit is about a quarter of a metre.

namespace gnomon::tool
{

namespace
{

constexpr vtkIdType trianglesOfTheThesis = 55026;

/// Two directions perpendicular to a third and to each other.
struct Frame
{
  explicit Frame(const Vec3& axis)
    : right(normalized(cross(std::abs(axis[1]) < 0.9 ? up : Vec3{ { 1.0, 0.0, 0.0 } }, axis)))
    , back(cross(right, axis))
  {
  }
  Vec3 right;
  Vec3 back;
};

/// Return a direction that leans away from `axis` by the angle `lean`, towards the angle `turn`
/// around it; in radians.
Vec3 leaning(const Vec3& axis, double lean, double turn)
{
  const Frame frame(axis);
  return std::cos(lean) * axis +
    std::sin(lean) * (std::cos(turn) * frame.right + std::sin(turn) * frame.back);
}

/// Add a round limb that tapers from one point to another. Its ends are open, as other limbs
/// continue there.
void addLimb(
  MeshBuilder& mesh, const Vec3& from, const Vec3& to, double radius, double taper, int segments)
{
  const double size = length(to - from);
  mesh.addLathe(
    { from, normalized(to - from) }, { { radius, 0.0 }, { taper * radius, size } }, segments);
}

/// Add a leaf or petal of 8 triangles: an open sheet, pointed at both ends, folded along its middle
/// and bent. The unit vector `along` points from foot to tip, `across` to one side.
void addLeaf(MeshBuilder& mesh, const Vec3& foot, const Vec3& along, const Vec3& across,
  double size, double width, double bend)
{
  const Vec3 normal = cross(across, along);
  mesh.addSheet(2, 3,
    [&](double u, double v)
    {
      const double side = 2.0 * u - 1.0;
      // Widest in the middle; 0 at tip and foot, as `v * (1 - v)` is.
      const double half = 2.0 * width * v * (1.0 - v);
      return foot + (size * v) * along + (side * half) * across +
        (0.3 * std::abs(side) * half - bend * size * v * v) * normal;
    });
}

//------------------------------------------------------------------------------
// Ground

// The lawn fills all views, also in pictures of 16:9.
constexpr double lawnWest = -74.0;
constexpr double lawnNorth = -112.0;
constexpr double lawnSouth = 144.0;
constexpr double stripeWidth = 8.0; ///< of the mower's tracks, north and south
constexpr int stripes = 27;

SceneModel makeLawn(bool light)
{
  // The lawn consists of squares. A rasteriser that clips two long neighbours at different places
  // may leave a pixel open between them.
  MeshBuilder mesh;
  for (int i = light ? 0 : 1; i < stripes; i += 2)
  {
    const double west = lawnWest + stripeWidth * i;
    const double east = west + stripeWidth;
    for (double north = lawnNorth; north < lawnSouth; north += stripeWidth)
    {
      const double south = north + stripeWidth;
      mesh.addPolygon({ { { west, 0.0, south } }, { { east, 0.0, south } },
        { { east, 0.0, north } }, { { west, 0.0, north } } });
    }
  }
  return light ? makeModel("lawn, light stripes", mesh.build(), { { 0.46, 0.6, 0.32 } })
               : makeModel("lawn, dark stripes", mesh.build(), { { 0.41, 0.55, 0.29 } });
}

/// Return the earth below the lawn.
SceneModel makeEarth()
{
  MeshBuilder mesh;
  mesh.addBox(
    { { lawnWest, -2.0, lawnNorth } }, { { lawnWest + stripes * stripeWidth, -0.2, lawnSouth } });
  return makeModel("earth", mesh.build(), { { 0.4, 0.3, 0.22 } });
}

/// Return stepping stones and the terrace below the bench.
SceneModel makeGardenPaving()
{
  MeshBuilder mesh;
  for (int row = 0; row < 5; ++row)
  {
    for (int column = 0; column < 9; ++column)
    {
      const double x = -8.0 + 1.8 * column + (row % 2 ? 0.4 : 0.0);
      const double z = -4.0 + 1.8 * row;
      mesh.addBox({ { x, 0.0, z } }, { { x + 1.7, 0.12, z + 1.7 } });
    }
  }
  return makeModel("paving", mesh.build(), { { 0.66, 0.62, 0.56 } });
}

//------------------------------------------------------------------------------
// Bench

/// Return seven slats for the seat and five for the leaning back. The bench faces +z.
SceneModel makeBenchSlats()
{
  constexpr double half = 6.0;
  MeshBuilder mesh;
  for (int i = 0; i < 7; ++i)
  {
    const double z = -1.4 + 0.42 * i;
    mesh.addBox({ { -half, 1.8, z } }, { { half, 1.95, z + 0.34 } });
  }
  for (int i = 0; i < 5; ++i)
  {
    const double y = 2.3 + 0.44 * i;
    const double z = -1.6 - 0.11 * i;
    mesh.addBox({ { -half, y, z - 0.12 } }, { { half, y + 0.36, z } });
  }
  return makeModel("bench slats", mesh.build(), { { 0.62, 0.4, 0.24 } });
}

/// Return two feet, two posts and a curled arm rest on each side, and bolt heads on the slats.
SceneModel makeBenchFrame()
{
  MeshBuilder mesh;
  for (const double x : { -5.2, 0.0, 5.2 })
  {
    mesh.addBox({ { x - 0.12, 0.0, 1.1 } }, { { x + 0.12, 1.8, 1.35 } });
    mesh.addBox({ { x - 0.12, 0.0, -1.5 } }, { { x + 0.12, 1.8, -1.25 } });
    mesh.addBox({ { x - 0.12, 1.6, -1.24 } }, { { x + 0.12, 1.79, 1.09 } });
    // The post behind the leaning back.
    addLimb(mesh, { { x, 1.8, -1.66 } }, { { x, 4.6, -2.36 } }, 0.13, 0.7, 10);
    if (x != 0.0)
    {
      addLimb(mesh, { { x, 1.95, 1.25 } }, { { x, 3.1, 1.25 } }, 0.09, 1.0, 10);
      mesh.addBox({ { x - 0.2, 3.1, -1.9 } }, { { x + 0.2, 3.22, 1.6 } });
    }
    for (int i = 0; i < 7; ++i)
    {
      mesh.addSphere({ { x, 1.95, -1.23 + 0.42 * i } }, 0.06, 8, 4);
    }
  }
  return makeModel("bench frame", mesh.build(), { { 0.25, 0.28, 0.27 } });
}

//------------------------------------------------------------------------------
// Lamp

/// Return a pole on a turned foot. It is thinner than a texel of a map over the whole garden.
SceneModel makeLampPole(const Vec3& foot)
{
  MeshBuilder mesh;
  mesh.addLathe({ foot, up },
    { { 0.0, 0.0 }, { 0.7, 0.0 }, { 0.7, 0.25 }, { 0.5, 0.4 }, { 0.3, 0.5 }, { 0.22, 1.6 },
      { 0.3, 1.75 }, { 0.3, 1.9 }, { 0.08, 2.2 }, { 0.08, 16.6 }, { 0.2, 16.8 }, { 0.2, 17.0 },
      { 0.0, 17.0 } },
    20);
  // The lamplighters' ladder bar, with a ball at each end.
  addLimb(
    mesh, foot + Vec3{ { -0.9, 15.4, 0.0 } }, foot + Vec3{ { 0.9, 15.4, 0.0 } }, 0.05, 1.0, 8);
  mesh.addSphere(foot + Vec3{ { -0.95, 15.4, 0.0 } }, 0.12, 12, 8);
  mesh.addSphere(foot + Vec3{ { 0.95, 15.4, 0.0 } }, 0.12, 12, 8);
  return makeModel("lamp pole", mesh.build(), { { 0.22, 0.3, 0.28 } });
}

SceneModel makeLampHead(const Vec3& foot)
{
  MeshBuilder mesh;
  mesh.addSphere(foot + 18.0 * up, 0.95, 32, 20);
  return makeModel("lamp globe", mesh.build(), { { 0.95, 0.93, 0.84 } });
}

/// Return the hood above the globe, an open sheet.
SceneModel makeLampHood(const Vec3& foot)
{
  MeshBuilder mesh;
  mesh.addLathe({ foot, up },
    { { 1.6, 18.7 }, { 1.2, 19.1 }, { 0.6, 19.45 }, { 0.15, 19.6 }, { 0.08, 20.0 }, { 0.0, 20.2 } },
    24);
  return makeModel("lamp hood", mesh.build(), { { 0.2, 0.42, 0.36 } });
}

//------------------------------------------------------------------------------
// Trees

struct Tree
{
  Vec3 foot;
  double height;
  double crownRadius;
  double leafSize;
  std::uint32_t seed;
};

/// Builds wood and leaves of one tree. Limbs carry thinner limbs along their outer part, in two
/// generations. Twigs carry leaves.
class TreeMaker
{
public:
  TreeMaker(const Tree& tree, MeshBuilder& wood, MeshBuilder& leaves)
    : tree_(tree)
    , wood_(wood)
    , leaves_(leaves)
    , random_(tree.seed)
  {
  }

  void make()
  {
    const Tree& tree = this->tree_;
    const double radius = 0.035 * tree.height;
    // The trunk, from below the ground, with a swelling foot.
    const double fork = 0.5 * tree.height;
    this->wood_.addLathe({ tree.foot, up },
      { { 0.0, -1.0 }, { 1.5 * radius, -1.0 }, { 1.5 * radius, 0.0 }, { 1.1 * radius, 1.5 },
        { 0.9 * radius, 0.25 * tree.height }, { 0.7 * radius, fork },
        { 0.3 * radius, 0.8 * tree.height }, { 0.0, 0.85 * tree.height } },
      12);
    constexpr int boughs = 11;
    for (int i = 0; i < boughs; ++i)
    {
      const double share = (i + 0.5) / boughs;
      const double lean = vtkMath::RadiansFromDegrees(80.0 - 60.0 * share);
      // Branches follow each other by the golden angle.
      const Vec3 direction = leaning(up, lean, 2.4 * i + this->random_.between(-0.3, 0.3));
      const Vec3 from = tree.foot + ((0.36 + 0.4 * share) * tree.height) * up;
      const double reach = std::sin(lean) * tree.crownRadius + 0.2 * std::cos(lean) * tree.height;
      this->addBranch(from, direction, reach, (0.45 - 0.2 * share) * radius, 0);
    }
  }

private:
  void addBranch(const Vec3& from, const Vec3& direction, double size, double radius, int order)
  {
    // A limb has two pieces; the outer one bends upwards.
    const Vec3 middle = from + (0.5 * size) * direction;
    const Vec3 bent = normalized(direction + 0.25 * up);
    const Vec3 end = middle + (0.5 * size) * bent;
    const int segments = order == 0 ? 8 : order == 1 ? 5 : 3;
    addLimb(this->wood_, from, middle, radius, 0.65, segments);
    addLimb(this->wood_, middle, end, 0.65 * radius, 0.4, segments);
    if (order == 2)
    {
      this->addLeaves(middle, end, bent);
      return;
    }
    const int children = order == 0 ? 6 : 4;
    for (int i = 0; i < children; ++i)
    {
      const double share = (i + 1.0) / children;
      const Vec3 place =
        share < 0.5 ? from + (share * size) * direction : middle + ((share - 0.5) * size) * bent;
      const double lean = this->random_.between(0.6, 1.1) * (i + 1 < children ? 1.0 : 0.4);
      this->addBranch(place, leaning(bent, lean, 2.4 * i + this->random_.between(0.0, 1.5)),
        this->random_.between(0.35, 0.5) * size, 0.45 * radius, order + 1);
    }
  }

  void addLeaves(const Vec3& from, const Vec3& to, const Vec3& direction)
  {
    constexpr int count = 4;
    for (int i = 0; i < count; ++i)
    {
      const Vec3 foot = from + ((i + 1.0) / count) * (to - from);
      const Vec3 along =
        leaning(direction, this->random_.between(0.3, 1.3), this->random_.between(0.0, 6.28));
      const Frame frame(along);
      const double roll = this->random_.between(0.0, 6.28);
      const double size = this->tree_.leafSize * this->random_.between(0.7, 1.3);
      addLeaf(this->leaves_, foot, along,
        std::cos(roll) * frame.right + std::sin(roll) * frame.back, size, 0.7 * size,
        this->random_.between(0.0, 0.3));
    }
  }

  const Tree& tree_;
  MeshBuilder& wood_;
  MeshBuilder& leaves_;
  Random random_;
};

//------------------------------------------------------------------------------
// Flowers

const Vec3 boxCenter{ { -13.0, 0.0, 10.0 } };
constexpr double boxHalfLength = 5.0;
constexpr double boxHalfWidth = 1.8;
constexpr double soilHeight = 1.15;

/// Return boards with posts at the corners, and soil.
SceneModel makeFlowerBox()
{
  MeshBuilder mesh;
  const auto addBox = [&](const Vec3& low, const Vec3& high)
  { mesh.addBox(boxCenter + low, boxCenter + high); };
  for (const double side : { -1.0, 1.0 })
  {
    for (int board = 0; board < 3; ++board)
    {
      const double y = 0.1 + 0.42 * board;
      const double z = side * boxHalfWidth;
      addBox({ { -boxHalfLength, y, z - 0.1 } }, { { boxHalfLength, y + 0.4, z + 0.1 } });
      const double x = side * boxHalfLength;
      addBox(
        { { x - 0.1, y, 0.12 - boxHalfWidth } }, { { x + 0.1, y + 0.4, boxHalfWidth - 0.12 } });
    }
    for (const double end : { -1.0, 1.0 })
    {
      const double x = end * (boxHalfLength + 0.12);
      const double z = side * (boxHalfWidth + 0.12);
      addBox({ { x - 0.15, 0.0, z - 0.15 } }, { { x + 0.15, 1.5, z + 0.15 } });
    }
  }
  return makeModel("flower box", mesh.build(), { { 0.55, 0.36, 0.24 } });
}

SceneModel makeSoil()
{
  MeshBuilder mesh;
  mesh.addBox(boxCenter + Vec3{ { 0.15 - boxHalfLength, 0.05, 0.15 - boxHalfWidth } },
    boxCenter + Vec3{ { boxHalfLength - 0.15, soilHeight, boxHalfWidth - 0.15 } });
  return makeModel("soil", mesh.build(), { { 0.3, 0.22, 0.17 } });
}

/// A kind of flower.
struct Species
{
  const char* name;
  Vec3 petalColor;
  int petals;
  double petalLength;
  double petalWidth;
  double opening;    ///< angle between petal and stem, radians
  double stemHeight; ///< mean height
  int count;
};

const Species allSpecies[] = {
  { "tulip", { { 0.82, 0.16, 0.2 } }, 6, 0.75, 0.5, 0.28, 2.6, 34 },
  { "daisy", { { 0.95, 0.94, 0.9 } }, 14, 0.6, 0.16, 1.35, 1.8, 44 },
  { "anemone", { { 0.5, 0.35, 0.75 } }, 8, 0.55, 0.34, 0.95, 1.4, 44 },
};

/// Return the place of flower i in jittered rows, which keep flowers apart.
Vec3 flowerPlace(int i, Random& random)
{
  constexpr int columns = 18;
  const double x = (i % columns + 0.5) / columns * 2.0 - 1.0;
  const double z = (i / columns + 0.5) / 7.0 * 2.0 - 1.0;
  return boxCenter +
    Vec3{ { (boxHalfLength - 0.5) * x + random.between(-0.16, 0.16), soilHeight,
      (boxHalfWidth - 0.35) * z + random.between(-0.12, 0.12) } };
}

void addFlower(const Species& species, const Vec3& foot, Random& random, MeshBuilder& green,
  MeshBuilder& petals, MeshBuilder& hearts)
{
  const Vec3 direction = leaning(up, random.between(0.0, 0.3), random.between(0.0, 6.28));
  const double height = species.stemHeight * random.between(0.75, 1.25);
  // The stem starts in the soil and bends once.
  const Vec3 middle = foot + (0.5 * height) * up;
  const Vec3 head = middle + (0.5 * height) * direction;
  addLimb(green, foot - 0.1 * up, middle, 0.05, 0.8, 5);
  addLimb(green, middle, head, 0.04, 0.8, 5);
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 along = leaning(up, random.between(0.4, 1.0), 2.1 * i + random.between(0.0, 1.0));
    addLeaf(green, foot + (0.12 * (i + 1)) * up, along, Frame(along).right,
      random.between(0.7, 1.2), 0.22, random.between(0.1, 0.4));
  }
  const Frame frame(direction);
  const double turn = random.between(0.0, 6.28);
  for (int i = 0; i < species.petals; ++i)
  {
    const double angle = turn + 2.0 * vtkMath::Pi() * i / species.petals;
    const Vec3 outward = std::cos(angle) * frame.right + std::sin(angle) * frame.back;
    const Vec3 across = cross(direction, outward);
    const Vec3 along = std::cos(species.opening) * direction + std::sin(species.opening) * outward;
    addLeaf(petals, head + 0.05 * outward, along, across, species.petalLength, species.petalWidth,
      random.between(0.0, 0.25));
  }
  hearts.addSphere(head, 0.11, 8, 4);
}

void addFlowers(Scene& scene)
{
  Random random(20);
  MeshBuilder green;
  MeshBuilder hearts;
  std::vector<const Species*> bed;
  for (const Species& species : allSpecies)
  {
    bed.insert(bed.end(), static_cast<std::size_t>(species.count), &species);
  }
  // Shuffled here, as std::shuffle differs between libraries.
  for (std::size_t i = bed.size() - 1; i > 0; --i)
  {
    std::swap(bed[i], bed[static_cast<std::size_t>(random.between(0.0, i + 1.0))]);
  }
  for (const Species& species : allSpecies)
  {
    MeshBuilder petals;
    for (std::size_t i = 0; i < bed.size(); ++i)
    {
      if (bed[i] == &species)
      {
        const Vec3 foot = flowerPlace(static_cast<int>(i), random);
        addFlower(species, foot, random, green, petals, hearts);
      }
    }
    scene.models.push_back(makeModel(species.name, petals.build(), species.petalColor));
  }
  scene.models.push_back(makeModel("stems", green.build(), { { 0.33, 0.5, 0.22 } }));
  scene.models.push_back(makeModel("hearts", hearts.build(), { { 0.9, 0.72, 0.2 } }));
}

//------------------------------------------------------------------------------
/// Return blades of grass, open sheets of one triangle, in tufts where a mower cannot go.
SceneModel makeGrass(vtkIdType blades, const std::vector<Tree>& trees, const Vec3& lampFoot)
{
  Random random(30);
  std::vector<Vec3> tufts;
  for (const Tree& tree : trees)
  {
    for (int i = 0; i < 30; ++i)
    {
      tufts.push_back(tree.foot +
        random.between(2.0, 4.0) * leaning(up, 0.5 * vtkMath::Pi(), random.between(0.0, 6.28)));
    }
  }
  for (int i = 0; i < 12; ++i)
  {
    tufts.push_back(
      lampFoot + random.between(0.8, 1.4) * leaning(up, 0.5 * vtkMath::Pi(), 0.52 * i));
  }
  for (int i = 0; i < 40; ++i)
  {
    const double side = i % 2 ? 1.0 : -1.0;
    tufts.push_back(
      boxCenter + Vec3{ { random.between(-5.4, 5.4), 0.0, side * random.between(2.3, 2.8) } });
  }
  MeshBuilder mesh;
  for (vtkIdType i = 0; i < blades; ++i)
  {
    Vec3 foot = tufts[static_cast<std::size_t>(i) % tufts.size()] +
      Vec3{ { random.between(-0.35, 0.35), 0.0, random.between(-0.35, 0.35) } };
    foot[1] = -0.05; // below the ground
    const Vec3 along = leaning(up, random.between(0.05, 0.6), random.between(0.0, 6.28));
    const Vec3 across = Frame(along).right;
    const double width = random.between(0.04, 0.08);
    mesh.addPolygon(
      { foot - width * across, foot + width * across, foot + random.between(0.5, 1.1) * along });
  }
  return makeModel("grass", mesh.build(), { { 0.36, 0.55, 0.24 } });
}

Scene makeGarden()
{
  Scene scene;
  const Vec3 lampFoot{ { -7.5, 0.0, -6.5 } };
  // One tree shades the bench and part of the flowers; the other's shadow falls on the open lawn.
  const std::vector<Tree> trees = { { { { -50.0, 0.0, -42.0 } }, 46.0, 14.0, 1.7, 1 },
    { { { -2.0, 0.0, -44.0 } }, 60.0, 27.0, 3.4, 2 } };

  scene.models = { makeLawn(true), makeLawn(false), makeEarth(), makeGardenPaving(),
    placed(makeBenchSlats(), { { 0.5, 0.12, 0.5 } }, 12.0),
    placed(makeBenchFrame(), { { 0.5, 0.12, 0.5 } }, 12.0), makeLampPole(lampFoot),
    makeLampHead(lampFoot), makeLampHood(lampFoot), makeFlowerBox(), makeSoil() };
  MeshBuilder wood;
  MeshBuilder leaves;
  for (const Tree& tree : trees)
  {
    TreeMaker(tree, wood, leaves).make();
  }
  scene.models.push_back(makeModel("wood", wood.build(), { { 0.45, 0.34, 0.26 } }));
  scene.models.push_back(makeModel("leaves", leaves.build(), { { 0.34, 0.52, 0.22 } }));
  addFlowers(scene);

  vtkIdType count = 0;
  for (const SceneModel& model : scene.models)
  {
    count += model.surface->GetNumberOfPolys();
  }
  scene.models.push_back(makeGrass(trianglesOfTheThesis - count, trees, lampFoot));
  return scene;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<SceneView>& gardenViews()
{
  // Cameras of the thesis' section 5.1. "with" looks along the light, "against" towards it, "side"
  // across it.
  static const std::vector<SceneView> views = {
    { "bench-with", "garden of two trees, lamp, flower box and bench, seen along the light",
      { { -37.034573, 35.208973, -8.597797 } }, { { 0.605439, -0.732089, 0.312232 } } },
    { "bench-side", "the garden, seen across the light", { { -23.277, 18.541, 30.143 } },
      { { 0.397, -0.644774, -0.652 } } },
    { "bench-against", "the garden, seen against the light",
      { { 27.214222, 27.875109, 27.032139 } }, { { -0.560848, -0.777942, -0.283293 } } },
    { "trees-with", "a tree's shadow on the garden's lawn: large triangles, along the light",
      { { 42.947086, 24.103859, -27.831772 } }, { { 0.415959, -0.784187, 0.460467 } } },
    { "trees-side", "the tree's shadow, across the light",
      { { 101.010887, 30.839497, -23.4187145 } }, { { -0.235037, -0.802447, 0.548369 } } },
    { "trees-against", "the tree's shadow, against the light",
      { { 90.8069972, 35.846294, 24.138012 } }, { { -0.400057, -0.835954, 0.37568 } } },
    { "flowers-with", "the garden's flowers: small triangles, along the light",
      { { -17.561422, 24.968716, 4.010894 } }, { { 0.386402, -0.873032, 0.297505 } } },
    { "flowers-side", "the flowers, across the light", { { -0.260709, 22.376335, 6.046194 } },
      { { -0.387214, -0.852832, 0.350347 } } },
    { "flowers-against", "the flowers, against the light", { { -3.263903, 24.423452, 12.998949 } },
      { { -0.239566, -0.958412, -0.155095 } } },
  };
  return views;
}

//------------------------------------------------------------------------------
Scene makeGardenScene(const SceneView& view)
{
  Scene scene = makeGarden();
  scene.camera = makeCamera(view.position, view.position + 40.0 * view.direction, 60.0);
  scene.lights = { makeSun(
    { { 0.744, -0.408, 0.527 } }, { { 1.0, 0.96, 0.88 } }, 2.2) }; // a low sun
  setAmbient(scene, 0.35);
  scene.background = { { 0.75, 0.85, 0.95 } };
  return scene;
}

} // namespace gnomon::tool
