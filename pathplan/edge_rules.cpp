#include "pathplan/edge_rules.h"

#include "common/base/parallel.h"

namespace ramify::pathplan {

EdgeRules::EdgeRules(const Domain& domain, std::span<const Vec3> nodes, double max_length,
                     std::span<const std::uint32_t> subvolumes)
    : domain_(domain),
      nodes_(nodes),
      max_length_(max_length),
      subvolumes_(subvolumes),
      is_convex_(domain.solid.is_convex()) {
  if (is_convex_) return;
  part_.resize(nodes.size());
  parallel_for(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) part_[i] = domain.solid.convex_part(nodes[i]).value_or(kNoPart);
  });
}

bool EdgeRules::segment_is_inside(const Vec3& a, const Vec3& b) const {
  const Solid& solid = domain_.solid;
  return solid.contains(0.75 * a + 0.25 * b) && solid.contains(0.5 * a + 0.5 * b) &&
         solid.contains(0.25 * a + 0.75 * b);
}

}  // namespace ramify::pathplan
