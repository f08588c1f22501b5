// How many edges the kinds of graphs have on the same nodes.
#pragma once

namespace ramify::bench {

/// Edges a node.
struct GraphSizes {
  int nodes = 0;
  double cube_faces = 0.0;          // Yao, 6 sectors
  double octants = 0.0;             // 8
  double faces_and_corners = 0.0;   // 14
  double neighbours = 0.0;          // the plain version's
  double threshold = 0.0;           // the sparsest threshold graph in one piece
  double threshold_spacings = 0.0;  // its greatest distance
};

/// In the volume of XM12 Fig. 5.
GraphSizes graph_sizes(int nodes);

/// Beside what Xu & Mould 2012 say of theirs.
void print(const GraphSizes& sizes);

}  // namespace ramify::bench
