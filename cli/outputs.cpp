#include "cli/outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "common/analysis/metrics.h"
#include "common/base/errors.h"
#include "common/base/image.h"
#include "common/format/layer_files.h"
#include "common/format/pov_scene.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/gltf.h"
#include "common/mesh/obj.h"
#include "common/mesh/obstacle_mesh.h"
#include "common/mesh/ply.h"
#include "common/mesh/stl.h"
#include "common/skeleton/passes.h"
#include "common/volume/voxel_file.h"
#include "viewer/renderer.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

struct Ending {
  std::string_view text;
  OutputForm form;
};

constexpr std::array kEndings = {
    Ending{".glb", OutputForm::glb},
    Ending{".gltf", OutputForm::gltf},
    Ending{".obj", OutputForm::obj},
    Ending{".skel.ply", OutputForm::skeleton},  // before .ply, in which it ends
    Ending{".ply", OutputForm::ply},
    Ending{".stl", OutputForm::stl},
    Ending{".pov", OutputForm::pov_scene},
    Ending{".csv", OutputForm::skeleton},
    Ending{".swc", OutputForm::skeleton},
    Ending{".mtg", OutputForm::skeleton},
    Ending{".png", OutputForm::picture},
    Ending{".vdb", OutputForm::shadow_grid},
};

fs::path node_table_path(fs::path edges) {
  return edges.replace_extension(".nodes.csv");
}

fs::path material_path(fs::path obj) {
  return obj.replace_extension(".mtl");
}

template <class Data>
const Data& layer_data(const Results& results, const Output& output) {
  const std::vector<Layer>& layers = results.run.layers;
  const auto is_named = [&](const Layer& layer) { return layer.name == output.layer(); };
  return std::get<Data>(std::find_if(layers.begin(), layers.end(), is_named)->data);
}

bool is_ending_of(std::string_view ending, const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  return name.size() > ending.size() && name.ends_with(ending);
}

Image picture(const Results& results) {
  Renderer renderer;
  const Mesh obstacles = obstacle_mesh(results.job);
  return renderer.render(
      {.mesh = &results.tree.mesh, .skeleton = &results.run.skeleton, .obstacles = &obstacles}, {});
}

std::vector<std::pair<std::string, double>> metrics_of(const Skeleton& skeleton) {
  const Metrics metrics = measure(skeleton);
  std::vector<std::pair<std::string, double>> values;
  for (const MetricInfo& info : metric_table()) {
    if (const auto value = info.value(metrics)) values.emplace_back(info.key, *value);
  }
  return values;
}

}  // namespace

bool Output::needs_mesh() const {
  switch (form) {
    case OutputForm::glb:
    case OutputForm::gltf:
    case OutputForm::obj:
    case OutputForm::ply:
    case OutputForm::stl:
    case OutputForm::picture:
      return true;
    case OutputForm::pov_scene:
    case OutputForm::skeleton:
    case OutputForm::shadow_grid:
    case OutputForm::graph:
      return false;
  }
  return false;
}

std::string Output::layer() const {
  if (form == OutputForm::shadow_grid) return "shadow";
  if (form == OutputForm::graph) return "graph";
  return {};
}

std::vector<fs::path> Output::files() const {
  if (form == OutputForm::obj) return {path, material_path(path)};
  if (form == OutputForm::graph) return {path, node_table_path(path)};
  return {path};
}

std::string known_endings() {
  std::vector<std::string_view> endings;
  for (const Ending& known : kEndings) endings.push_back(known.text);
  return fmt::format("{}", fmt::join(endings, " "));
}

Output output_of(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  for (const Ending& known : kEndings) {
    if (is_ending_of(known.text, path)) return {known.form, path};
  }
  throw InputError(fmt::format("{}: unknown ending '{}' ({})", path, ending, known_endings()));
}

void write_output(const Output& output, const Results& results, OutputFiles& files) {
  Provenance provenance = provenance_of(results.job);
  if (output.form == OutputForm::glb || output.form == OutputForm::gltf) {
    provenance.metrics = metrics_of(results.run.skeleton);
  }
  const fs::path& path = output.path;
  switch (output.form) {
    case OutputForm::glb:
      write_gltf(results.tree.mesh, provenance, GltfForm::binary, files.add(path));
      break;
    case OutputForm::gltf:
      write_gltf(results.tree.mesh, provenance, GltfForm::text, files.add(path));
      break;
    case OutputForm::obj:
      write_obj(results.tree.mesh, provenance, material_path(path).filename().string(), files.add(path));
      write_mtl(results.tree.mesh, path.stem().string(), files.add(material_path(path)));
      for (const ImageFile& image : image_files(results.tree.mesh, path.stem().string())) {
        files.add(fs::path(path).replace_filename(image.name)) << png_bytes(image.image);
      }
      break;
    case OutputForm::ply:
      write_ply(results.tree.mesh, provenance, files.add(path));
      break;
    case OutputForm::stl:
      write_stl(results.tree.mesh, provenance, files.add(path));
      break;
    case OutputForm::pov_scene:
      write_pov_scene(living(results.run.skeleton), provenance, files.add(path));
      break;
    case OutputForm::skeleton:
      write_skeleton(results.run.skeleton, *skeleton_form(path), provenance, files.add(path));
      break;
    case OutputForm::picture:
      write_png(picture(results), files.add(path));
      break;
    case OutputForm::shadow_grid:
      write_vdb(layer_data<VoxelLayer>(results, output), "shadow", files.add(path));
      break;
    case OutputForm::graph: {
      const auto& graph = layer_data<LineLayer>(results, output);
      write_edge_table(graph, files.add(path));
      write_node_table(graph, files.add(node_table_path(path)));
      break;
    }
  }
}

}  // namespace ramify::cli
