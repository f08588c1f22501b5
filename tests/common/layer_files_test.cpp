#include "common/format/layer_files.h"

#include <sstream>

#include "common/volume/voxel_file.h"
#include "tests/catch.h"

using namespace ramify;

TEST_CASE("graph tables: one row an edge and one a node") {
  LineLayer graph;
  graph.points = {{0, 0, 0}, {1, 0.5, 0}};
  graph.point_values = {0, 1};
  graph.lines = {{0, 1}};
  graph.values = {0.25};
  std::ostringstream edges;
  std::ostringstream nodes;
  write_edge_table(graph, edges);
  write_node_table(graph, nodes);
  CHECK(edges.str() == "u,v,weight\n0,1,0.25\n");
  CHECK(nodes.str() == "id,x,y,z,subvolume\n0,0,0,0,0\n1,1,0.5,0,1\n");
}

TEST_CASE("voxel files: an OpenVDB stream that names its grid") {
  VoxelLayer layer;
  layer.voxel_size = 0.5;
  layer.voxels = {{0, 0, 0}, {100, -3, 7}};
  layer.values = {1.0f, 2.0f};
  std::ostringstream out;
  write_vdb(layer, "shadow", out);
  CHECK(out.str().substr(0, 4) == " BDV");  // the magic number, 64-bit little-endian
  CHECK(out.str().find("shadow") != std::string::npos);
}
