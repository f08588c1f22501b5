#include "tests/common/trees.h"

#include "common/base/rng.h"
#include "common/skeleton/passes.h"

namespace ramify::test {

void add_node(Skeleton& s, const Vec3& position, std::uint32_t parent, double diameter) {
  s.position.push_back(position);
  s.parent.push_back(parent);
  s.diameter.push_back(diameter);
  s.kind.push_back(Kind::stem);
}

Skeleton pole(int internodes) {
  Skeleton s;
  add_node(s, Vec3(0.0), kNoParent, 0.2);
  for (int i = 1; i <= internodes; ++i) {
    add_node(s, Vec3(0, i, 0), static_cast<std::uint32_t>(i - 1), 0.2 - 0.1 * i / internodes);
  }
  assign_axes(s);
  return s;
}

Skeleton binary_tree(int depth) {
  Skeleton s;
  add_node(s, Vec3(0.0), kNoParent, 1.0);
  add_node(s, Vec3(0, 1, 0), 0, 1.0);
  std::uint32_t first = 1;
  for (int level = 1; level <= depth; ++level) {
    const auto last = static_cast<std::uint32_t>(s.node_count());
    for (std::uint32_t parent = first; parent < last; ++parent) {
      const double spread = std::pow(0.5, level);
      const double width = s.diameter[parent];
      add_node(s, s.position[parent] + Vec3(-spread, 1, 0), parent, width * 0.71);
      add_node(s, s.position[parent] + Vec3(spread, 1, 0), parent, width * 0.70);
    }
    first = last;
  }
  assign_axes(s);
  return s;
}

Skeleton random_tree(std::uint64_t seed, int internodes) {
  Rng random = Rng::stream(seed, Stream::bud, 0);
  Skeleton s;
  add_node(s, Vec3(0.0), kNoParent, 0.5);
  for (int i = 1; i <= internodes; ++i) {
    const auto parent = static_cast<std::uint32_t>(random.below(s.node_count()));
    const Vec3 step(random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1));
    add_node(s, s.position[parent] + step, parent, s.diameter[parent] * random.uniform(0.5, 1.0));
  }
  assign_axes(s);
  for (std::size_t node = 0; node < s.node_count(); ++node) {
    const bool is_root = s.is_root(node);
    s.birth_step.push_back(is_root ? 0 : s.birth_step[s.parent[node]] + 1);
    s.shed_step.push_back(!is_root && s.is_shed(s.parent[node]) ? s.shed_step[s.parent[node]] : kAlive);
    if (!is_root && !s.is_shed(node) && random.uniform() < 0.1) s.shed_step[node] = s.birth_step[node] + 100;
    s.level.push_back(static_cast<std::uint16_t>(1 + random.below(4)));
    s.light.push_back(static_cast<float>(random.uniform()));
    s.vigour.push_back(static_cast<float>(random.uniform(0, 10)));
  }
  return s;
}

}  // namespace ramify::test
