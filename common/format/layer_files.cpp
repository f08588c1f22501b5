#include "common/format/layer_files.h"

#include <fmt/format.h>

#include <ostream>

namespace ramify {

void write_edge_table(const LineLayer& graph, std::ostream& out) {
  out << "u,v,weight\n";
  for (std::size_t i = 0; i < graph.lines.size(); ++i) {
    out << fmt::format("{},{},{}\n", graph.lines[i][0], graph.lines[i][1], graph.values[i]);
  }
}

void write_node_table(const LineLayer& graph, std::ostream& out) {
  out << "id,x,y,z,subvolume\n";
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const Vec3& p = graph.points[i];
    out << fmt::format("{},{},{},{},{}\n", i, p.x, p.y, p.z, graph.point_values[i]);
  }
}

}  // namespace ramify
