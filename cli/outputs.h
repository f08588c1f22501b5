// The files that a run writes, each by its ending.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/files.h"
#include "common/config/job.h"
#include "common/mesh/tree_mesh.h"

namespace ramify::cli {

enum class OutputForm { glb, gltf, obj, ply, stl, pov_scene, skeleton, picture, shadow_grid, graph };

struct Output {
  OutputForm form = OutputForm::glb;
  std::filesystem::path path;

  bool needs_mesh() const;
  /// The layer that it shows; empty if none.
  std::string layer() const;
  /// The files it consists of for certain: an .obj has its .mtl and may have images, a graph its .nodes.csv.
  std::vector<std::filesystem::path> files() const;
};

/// ".glb .obj": all that output_of() knows.
std::string known_endings();

/// Which form a file's ending asks for. Throws InputError naming the endings known.
Output output_of(const std::string& path);

/// What outputs are made of.
struct Results {
  const Job& job;
  const RunResult& run;
  const TreeMesh& tree;  // empty where no output needs it
};

/// Adds the output's files to `files`. The run must have made the output's layer. Throws RunError.
void write_output(const Output& output, const Results& results, OutputFiles& files);

}  // namespace ramify::cli
