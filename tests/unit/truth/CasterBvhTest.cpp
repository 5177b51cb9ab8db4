// The tree that the GPU traverses: it holds every triangle once, in boxes that enclose it, and
// updates keep that true.

#include "shadowtech/tracing/CasterBvh.h"

#include "InstancedScene.h"
#include "SyntheticScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

namespace gnomon::test
{
namespace
{

/// Traverses a tree and counts its records.
class Inspection
{
public:
  Inspection(const CasterBvh& bvh, const Occluders& occluders)
    : bvh_(bvh)
    , occluders_(occluders)
  {
    if (!bvh.empty())
    {
      this->visit(bvh.root(), bvh.bounds(), 1, bvh.stackSize());
    }
  }

  /// The number of times that each record is found, of triangles and of instances.
  std::map<std::array<std::uint32_t, 4>, int> found;

private:
  void visit(std::uint32_t link, const Bounds& box, int waiting, int most)
  {
    ASSERT_LE(waiting, most);
    if (!BvhLink::isLeaf(link))
    {
      for (std::uint32_t i = 0; i < 2; ++i)
      {
        const BvhNode& node = this->bvh_.nodes()[link + i];
        const Bounds own{ glm::dvec3(node.lower), glm::dvec3(node.upper) };
        this->expectInside(box, own.lower);
        this->expectInside(box, own.upper);
        this->visit(node.link, own, waiting + 1, most);
      }
      return;
    }
    for (std::uint32_t i = 0; i < BvhLink::count(link); ++i)
    {
      const BvhRecord& record = this->bvh_.records()[BvhLink::first(link) + i];
      ++this->found[{ record.x, record.y, record.z, record.w }];
      if (record.w & BvhFlag::instance)
      {
        this->visitInstance(record.x, box, waiting, most);
        continue;
      }
      for (int corner = 0; corner < 3; ++corner)
      {
        this->expectInside(box, glm::dvec3(this->occluders_.positionsCentred[record[corner]]));
      }
    }
  }

  void visitInstance(std::uint32_t number, const Bounds& box, int waiting, int most)
  {
    const BvhInstance& instance = this->bvh_.instances()[number];
    glm::dmat3 rows(glm::dvec3(instance.sourceFromCentred[0]),
      glm::dvec3(instance.sourceFromCentred[1]), glm::dvec3(instance.sourceFromCentred[2]));
    const glm::dvec3 origin(instance.sourceFromCentred[0].w, instance.sourceFromCentred[1].w,
      instance.sourceFromCentred[2].w);
    const glm::dmat3 centredFromSource = glm::inverse(glm::transpose(rows));
    const Bounds source{ glm::dvec3(instance.lowerSource), glm::dvec3(instance.upperSource) };
    for (const glm::dvec3& corner : source.corners())
    {
      this->expectInside(box, centredFromSource * (corner - origin), 1e-5);
    }
    this->visit(
      instance.root, source, waiting + static_cast<int>(BvhLink::mostRecordsOfLeaf) + 1, most);
  }

  static void expectInside(const Bounds& box, const glm::dvec3& point, double margin = 0.0)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_GE(point[axis], box.lower[axis] - margin);
      ASSERT_LE(point[axis], box.upper[axis] + margin);
    }
  }

  const CasterBvh& bvh_;
  const Occluders& occluders_;
};

void expectAllFoundOnce(const CasterBvh& bvh, const Occluders& occluders, std::size_t count)
{
  const Inspection inspection(bvh, occluders);
  EXPECT_EQ(inspection.found.size(), count);
  for (const auto& [record, times] : inspection.found)
  {
    ASSERT_EQ(times, 1);
  }
}

TEST(CasterBvh, HoldsEveryCastingTriangleOnce)
{
  Prop deaf{ makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)) };
  deaf.casts = false;
  Occluders occluders =
    makeOccluders({ { makeSphere(20, 30, 0.2) }, deaf, { makeTriangleSoup(5000, 3) }, { Mesh() } });
  CasterBvh bvh;
  EXPECT_TRUE(bvh.empty());
  EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::Built);
  const std::size_t count =
    occluders.surfaces[0].triangleCount + occluders.surfaces[2].triangleCount;
  EXPECT_EQ(bvh.records().size(), count);
  expectAllFoundOnce(bvh, occluders, count);
  EXPECT_LT(bvh.stackSize(), 40);
  EXPECT_LT(bvh.bytes(), 200 * count);
}

/// Cases with nothing to split, or with nearly all triangles on one side of every split: the tree
/// must not become too deep.
TEST(CasterBvh, TakesTrianglesThatCannotBeSortedApart)
{
  Mesh same;
  same.points = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  same.triangles.assign(3000, { 0, 1, 2 });
  CasterBvh bvh;
  Occluders occluders = makeOccluders({ { same } });
  bvh.update(occluders);
  EXPECT_EQ(bvh.records().size(), 3000u);
  EXPECT_EQ(Inspection(bvh, occluders).found.size(), 1u);

  Mesh shrinking;
  for (unsigned int i = 0; i < 4000; ++i)
  {
    const double size = std::pow(0.99, i);
    shrinking.points.insert(shrinking.points.end(),
      { { size, 0.0, 0.0 }, { size, size, 0.0 }, { size, 0.0, 0.5 * size } });
    shrinking.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  occluders = makeOccluders({ { shrinking } });
  bvh.update(occluders);
  expectAllFoundOnce(bvh, occluders, 4000);
}

TEST(CasterBvh, KeepsTrianglesOfInstancesOnce)
{
  Occluders occluders = cupsOverFloor(false, true);
  occluders.surfaces[1].centredFromSource[7] = glm::mat4x3(0.0f);
  CasterBvh bvh;
  bvh.update(occluders);
  EXPECT_EQ(bvh.instances().size(), 59u);
  const Inspection inspection(bvh, occluders);
  EXPECT_EQ(inspection.found.size(),
    59u + occluders.surfaces[0].triangleCount + occluders.surfaces[1].triangleCount);

  for (glm::mat4x3& instance : occluders.surfaces[1].centredFromSource)
  {
    instance[3] += Surface::isLeftOut(instance) ? glm::vec3(0.0f) : glm::vec3(0.3f, -2.0f, 1.0f);
  }
  occluders.surfaces[1].positionsVersion = occluders.positionsVersion += 1000000;
  EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::Refitted);
  EXPECT_EQ(Inspection(bvh, occluders).found, inspection.found);

  std::fill(occluders.surfaces[1].centredFromSource.begin(),
    occluders.surfaces[1].centredFromSource.end(), glm::mat4x3(0.0f));
  occluders.surfaces[0].casts = false;
  occluders.topologyVersion += 1000000;
  bvh.update(occluders);
  EXPECT_TRUE(bvh.empty()) << "nothing is left";
}

TEST(CasterBvh, IsRefittedWhileItIsGoodAndBuiltAnewWhenItIsNot)
{
  std::vector<Prop> props;
  for (int i = 0; i < 20; ++i)
  {
    props.push_back({ makeSphere(8, 12), at({ 3.0 * i, 0.0, 0.0 }) });
  }
  Occluders occluders = makeOccluders(props);
  CasterBvh bvh;
  EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::Built);
  EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::None);
  const std::size_t count = bvh.records().size();
  for (int step = 0; step < 5; ++step)
  {
    moveSurface(occluders, 4, { 0.1, -0.3, 0.2 });
    EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::Refitted);
    expectAllFoundOnce(bvh, occluders, count);
  }
  for (std::uint32_t i = 0; i < occluders.positionsCentred.size(); ++i)
  {
    // Positions as after a shuffle of all props.
    occluders.positionsCentred[i] =
      glm::vec3(static_cast<float>(i * 7919 % 61), static_cast<float>(i * 104729 % 59), 0.0f);
  }
  occluders.positionsVersion += 1000000;
  EXPECT_EQ(bvh.update(occluders), CasterBvh::Change::Built);
  expectAllFoundOnce(bvh, occluders, count);
}

} // namespace
} // namespace gnomon::test
