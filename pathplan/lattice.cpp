#include "pathplan/lattice.h"

#include <cmath>

namespace ramify::pathplan {

Nodes lattice_nodes(const Domain& domain, const Vec3& root, const Scatter& scatter, double cubic_metres) {
  const double edge = scatter.spacing > 0.0 ? scatter.spacing : std::cbrt(cubic_metres / scatter.nodes);
  const Box box = domain.solid.bounds();
  const Coord low(glm::ceil((box.low - root) / edge));
  const Coord high(glm::floor((box.high - root) / edge));
  Nodes nodes{.position = {root}, .spacing = edge};
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const Vec3 point = root + edge * Vec3(x, y, z);
        const bool is_root = x == 0 && y == 0 && z == 0;
        if (!is_root && domain.contains(point)) nodes.position.push_back(point);
      }
    }
  }
  return nodes;
}

}  // namespace ramify::pathplan
