#include "Noise.h"
#include "SceneParts.h"
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

constexpr double fullTurn = 6.28;

struct Tree
{
  Vec3 foot;
  double height;
  double crownRadius;
  double leafSize;
  std::uint32_t seed;
};
// One tree's shadow falls on the open lawn; the other shades the bench and part of the flowers.
const Tree trees[] = { { { -50.0, 0.0, -42.0 }, 46.0, 14.0, 1.7, 1 },
  { { -2.0, 0.0, -44.0 }, 60.0, 27.0, 3.4, 2 } };

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
    const double radius = 0.035 * tree.height;
    // The trunk, from below the ground, with a swelling foot.
    wood.addLathe({ tree.foot, up },
      { { 0.0, -1.0 }, { 1.5 * radius, -1.0 }, { 1.5 * radius, 0.0 }, { 1.1 * radius, 1.5 },
        { 0.9 * radius, 0.25 * tree.height }, { 0.7 * radius, 0.5 * tree.height },
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
    this->wood_.addLimb(from, middle, radius, 0.65, segments);
    this->wood_.addLimb(middle, end, 0.65 * radius, 0.4, segments);
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
        leaning(direction, this->random_.between(0.3, 1.3), this->random_.between(0.0, fullTurn));
      const Vec3 across = Frame(along).at(this->random_.between(0.0, fullTurn));
      const double size = this->tree_.leafSize * this->random_.between(0.7, 1.3);
      addLeaf(
        this->leaves_, foot, along, across, size, 0.7 * size, this->random_.between(0.0, 0.3));
    }
  }

  const Tree& tree_;
  MeshBuilder& wood_;
  MeshBuilder& leaves_;
  Random random_;
};

const Vec3 boxCenter{ -13.0, 0.0, 10.0 }; ///< of the flower box

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
  { "tulip", { 0.82, 0.16, 0.2 }, 6, 0.75, 0.5, 0.28, 2.6, 34 },
  { "daisy", { 0.95, 0.94, 0.9 }, 14, 0.6, 0.16, 1.35, 1.8, 44 },
  { "anemone", { 0.5, 0.35, 0.75 }, 8, 0.55, 0.34, 0.95, 1.4, 44 },
};

/// Return the place of flower i in jittered rows, which keep flowers apart.
Vec3 flowerPlace(int i, Random& random)
{
  constexpr int columns = 18;
  const double x = (i % columns + 0.5) / columns * 2.0 - 1.0;
  const double z = (i / columns + 0.5) / 7.0 * 2.0 - 1.0;
  const double jitter = random.between(-0.16, 0.16);
  return boxCenter + Vec3{ 4.5 * x + jitter, 1.15, 1.45 * z + random.between(-0.12, 0.12) };
}

void addFlower(const Species& species, const Vec3& foot, Random& random, MeshBuilder& green,
  MeshBuilder& petals, MeshBuilder& hearts)
{
  const double way = random.between(0.0, fullTurn);
  const Vec3 direction = leaning(up, random.between(0.0, 0.3), way);
  const double height = species.stemHeight * random.between(0.75, 1.25);
  // The stem starts in the soil and bends once.
  const Vec3 middle = foot + (0.5 * height) * up;
  const Vec3 head = middle + (0.5 * height) * direction;
  green.addLimb(foot - 0.1 * up, middle, 0.05, 0.8, 5);
  green.addLimb(middle, head, 0.04, 0.8, 5);
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 along = leaning(up, random.between(0.4, 1.0), 2.1 * i + random.between(0.0, 1.0));
    addLeaf(green, foot + (0.12 * (i + 1)) * up, along, Frame(along).right,
      random.between(0.7, 1.2), 0.22, random.between(0.1, 0.4));
  }
  const Frame frame(direction);
  const double turn = random.between(0.0, fullTurn);
  for (int i = 0; i < species.petals; ++i)
  {
    const Vec3 outward = frame.at(turn + 2.0 * vtkMath::Pi() * i / species.petals);
    const Vec3 along = std::cos(species.opening) * direction + std::sin(species.opening) * outward;
    addLeaf(petals, head + 0.05 * outward, along, cross(direction, outward), species.petalLength,
      species.petalWidth, random.between(0.0, 0.25));
  }
  hearts.addSphere(head, 0.11, 8, 4);
}

} // namespace

void addTrees(Scene& scene)
{
  MeshBuilder wood, leaves;
  for (const Tree& tree : trees)
  {
    TreeMaker(tree, wood, leaves);
  }
  add(scene, "wood", wood, { 0.45, 0.34, 0.26 });
  add(scene, "leaves", leaves, { 0.34, 0.52, 0.22 });
}

void addFlowers(Scene& scene)
{
  Random random(20);
  MeshBuilder green, hearts;
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
    add(scene, species.name, petals, species.petalColor);
  }
  add(scene, "stems", green, { 0.33, 0.5, 0.22 });
  add(scene, "hearts", hearts, { 0.9, 0.72, 0.2 });
}

/// Blades of grass are open sheets of one triangle, in tufts where a mower cannot go.
void addGrass(Scene& scene)
{
  vtkIdType blades = 55026; // the thesis' number of triangles
  for (const SceneModel& model : scene.models)
  {
    blades -= model.surface->GetNumberOfPolys();
  }
  Random random(30);
  std::vector<Vec3> tufts;
  const auto addTuft = [&](const Vec3& middle, double distance, double turn)
  { tufts.push_back(middle + distance * leaning(up, 0.5 * vtkMath::Pi(), turn)); };
  for (const Tree& tree : trees)
  {
    for (int i = 0; i < 30; ++i)
    {
      const double turn = random.between(0.0, fullTurn);
      addTuft(tree.foot, random.between(2.0, 4.0), turn);
    }
  }
  for (int i = 0; i < 12; ++i)
  {
    addTuft({ -7.5, 0.0, -6.5 }, random.between(0.8, 1.4), 0.52 * i); // around the lamp
  }
  for (int i = 0; i < 40; ++i)
  {
    const double x = random.between(-5.4, 5.4);
    tufts.push_back(boxCenter + Vec3{ x, 0.0, (i % 2 ? 1.0 : -1.0) * random.between(2.3, 2.8) });
  }
  MeshBuilder mesh;
  for (vtkIdType i = 0; i < blades; ++i)
  {
    const double x = random.between(-0.35, 0.35);
    Vec3 foot = tufts[static_cast<std::size_t>(i) % tufts.size()] +
      Vec3{ x, 0.0, random.between(-0.35, 0.35) };
    foot[1] = -0.05; // below the ground
    const double turn = random.between(0.0, fullTurn);
    const Vec3 along = leaning(up, random.between(0.05, 0.6), turn);
    const Vec3 across = random.between(0.04, 0.08) * Frame(along).right;
    mesh.addPolygon({ foot - across, foot + across, foot + random.between(0.5, 1.1) * along });
  }
  add(scene, "grass", mesh, { 0.36, 0.55, 0.24 });
}

} // namespace gnomon::tool
