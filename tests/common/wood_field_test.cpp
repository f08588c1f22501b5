#include "common/mesh/wood_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "common/mesh/field_items.h"
#include "common/mesh/leaf_field.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

constexpr double kVoxelSize = 0.01;  // metres

/// Thick wood that goes up, `bend_deg` aside for a short way, and up again; in the first bend a lateral
/// leaves it to the other side.
Skeleton crank(double bend_deg, double lateral_deg) {
  const auto aside = [](double angle_deg) {
    return Vec3(std::sin(radians(angle_deg)), std::cos(radians(angle_deg)), 0);
  };
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.3);
  add_node(s, {0, 0.6, 0}, 0, 0.3);
  add_node(s, s.position[1] + 0.2 * aside(bend_deg), 1, 0.28);
  add_node(s, s.position[2] + Vec3(0, 0.6, 0), 2, 0.26);
  add_node(s, s.position[1] + 0.5 * aside(lateral_deg), 1, 0.26);
  s.axis = {0, 0, 0, 0, 1};
  return s;
}

/// The greatest change of the field, in voxels, in a tenth of a voxel of a way that the surface is near to.
float greatest_step(const WoodField& field, const Vec3& center) {
  const FieldItems items(field);
  std::vector<std::uint32_t> all(items.size());
  std::iota(all.begin(), all.end(), 0u);
  LeafField leaf;
  leaf.reset(items, all, center, kVoxelSize);
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  const auto any_direction = [&] {
    return glm::normalize(Vec3f(normal(random), normal(random), normal(random)));
  };
  float greatest = 0.0f;
  for (int way = 0; way < 4000; ++way) {
    const Vec3f from = any_direction() * std::uniform_real_distribution<float>(0.0f, 40.0f)(random);
    const Vec3f step = any_direction() * 0.1f;
    leaf.focus(from, 0.1f * kBatch);
    Batch batch;
    for (int i = 0; i < kBatch; ++i) {
      const Vec3f at = from + step * static_cast<float>(i);
      const auto lane = static_cast<std::size_t>(i);
      batch.x[lane] = at.x;
      batch.y[lane] = at.y;
      batch.z[lane] = at.z;
    }
    leaf.values(batch);
    for (std::size_t lane = 1; lane < kBatch; ++lane) {
      const auto [low, high] = std::minmax(batch.value[lane - 1], batch.value[lane]);
      if (low < 1.0f && high > -1.0f) greatest = std::max(greatest, high - low);
    }
  }
  return greatest;
}

}  // namespace

TEST_CASE("wood field: on the inner side of a bend at a fork the surface has no steps") {
  for (const double bend_deg : {30.0, 50.0, 70.0, 90.0, 110.0}) {
    for (const double lateral_deg : {-30.0, -20.0, 10.0, 20.0, 40.0}) {
      const Skeleton tree = crank(bend_deg, lateral_deg);
      const WoodField field = wood_field(tree, std::vector<bool>(tree.node_count(), true), 1.0);
      INFO("bend " << bend_deg << ", lateral " << lateral_deg << " degrees");
      CHECK(greatest_step(field, tree.position[1]) < 0.15f);
    }
  }
}
