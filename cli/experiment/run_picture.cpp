#include "cli/experiment/run_picture.h"

#include <algorithm>
#include <array>
#include <vector>

#include "cli/experiment/run_folder.h"
#include "common/base/image.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/obstacle_mesh.h"
#include "common/mesh/tree_mesh.h"

namespace ramify::cli {
namespace {

// More would take longer to make than all the rest, and a picture this small shows none of it.
constexpr int kBarkResolution = 64;  // pixels

}  // namespace

std::string Studio::draw(const std::filesystem::path& run, const EngineRegistry& registry) {
  const Job job = load_job(registry, (run / kRunConfig).string());
  const Skeleton tree = read_skeleton(run / kRunTree).skeleton;
  Looks looks = job.looks();
  looks.bark.resolution = std::min(looks.bark.resolution, kBarkResolution);
  const Mesh mesh = make_tree_mesh(tree, looks, job.seed()).mesh;
  Box room = frame_.room;  // leaves reach beyond the wood
  room.low -= Vec3(job.leaves.length);
  room.high += Vec3(job.leaves.length);
  const std::array<Vec3, 8> around = corners(room);
  const std::vector<Vec3f> points(around.begin(), around.end());
  RenderOptions options;
  options.width = options.height = frame_.side;
  options.room_for = points;
  options.obstacles_take_room = false;
  options.with_occlusion = false;  // else drawing takes longer than growing, for shades too fine to be seen
  const Mesh obstacles = obstacle_mesh(job);
  return png_bytes(renderer_.render({.mesh = &mesh, .skeleton = &tree, .obstacles = &obstacles}, options));
}

}  // namespace ramify::cli
