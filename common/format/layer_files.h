// Layers as tables for other programs.
#pragma once

#include <iosfwd>

#include "common/config/layer.h"

namespace ramify {

/// One row a line: u,v,weight. Points count from 0; each line once.
void write_edge_table(const LineLayer& graph, std::ostream& out);

/// One row a point: id,x,y,z,subvolume; world metres.
void write_node_table(const LineLayer& graph, std::ostream& out);

}  // namespace ramify
