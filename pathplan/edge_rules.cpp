#include "pathplan/edge_rules.h"

#include "common/base/parallel.h"

namespace ramify::pathplan {

EdgeRules::EdgeRules(const Volume& volume, std::span<const Vec3> nodes, double max_length)
    : solid_(volume), nodes_(nodes), max_length_(max_length), part_(nodes.size()) {
  parallel_for(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) part_[i] = solid_.convex_part(nodes[i]).value_or(kNoPart);
  });
}

bool EdgeRules::segment_is_inside(const Vec3& a, const Vec3& b) const {
  return solid_.contains(0.75 * a + 0.25 * b) && solid_.contains(0.5 * a + 0.5 * b) &&
         solid_.contains(0.25 * a + 0.75 * b);
}

}  // namespace ramify::pathplan
