// The mesher and the mesh files measured on the largest tree, each in a process of its own. What the lines
// mean: README.md.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/fingerprint.h"
#include "bench/lone_run.h"
#include "bench/program.h"
#include "bench/results.h"
#include "bench/trees.h"
#include "common/base/parallel.h"
#include "common/config/provenance.h"
#include "common/mesh/gltf.h"
#include "common/mesh/mesher.h"
#include "common/mesh/obj.h"
#include "common/mesh/ply.h"
#include "common/mesh/tree_mesh.h"
#include "growth/engine.h"

namespace ramify::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "Usage: bench_mesher [--quick] [--benchmark_...]\n"
    "Measures the mesher and the writers of mesh files on the tree of 640,000 internodes.\n"
    "  --quick  on one of 100,000\n"
    "Google Benchmark's own options, such as --benchmark_filter=REGEX, work too.\n";

constexpr int kQuickSteps = 40;
constexpr int kRepetitions = 5;

// Works of a trial.
constexpr const char* kFloor = "floor";             // as many bytes as the mesh has, written to fresh memory
constexpr const char* kFloorAgain = "floor/again";  // and to memory that was written before
constexpr const char* kSmooth = "smooth";           // into fresh memory
constexpr const char* kSmoothAgain = "smooth/again";  // into the memory of the mesh before
constexpr const char* kDressed = "dressed";           // with bark, tangents and leaves
constexpr const char* kCurved = "catmull-rom";
constexpr const char* kCones = "cones";
constexpr const char* kLevel = "lod";
constexpr const char* kGlb = "glb";
constexpr const char* kObj = "obj";
constexpr const char* kPly = "ply";

std::string threads_name(const char* work) {
  return fmt::format("{}/threads:2", work);
}

std::size_t bytes_of(const Mesh& mesh) {
  return mesh.vertex_count() * (2 * sizeof(Vec3f) + sizeof(Vec2f) + sizeof(std::uint32_t)) +
         mesh.triangles.size() * sizeof(mesh.triangles[0]);
}

MesherOptions options_of(const std::string& work) {
  MesherOptions options;
  if (work == kCurved) options.centre_line = CentreLine::catmull_rom;
  if (work == kCones) options.method = MeshMethod::cones;
  if (work == kLevel) options.lod = 1;
  return options;
}

Looks looks_of(const std::string& work) {
  Looks looks;
  looks.mesher = options_of(work);
  looks.leaves.shape = LeafShape::ovate;
  return looks;
}

/// A file on a disk that is kept in memory, where there is one.
fs::path scratch_file() {
  const fs::path memory = "/dev/shm";
  const fs::path folder = fs::is_directory(memory) ? memory : fs::temp_directory_path();
  return folder / fmt::format("ramify-bench-{}", getpid());
}

/// Seconds to write a mesh file, which has `count` bytes.
Outcome write(const Mesh& mesh, const std::string& work) {
  const Provenance provenance{.version = version(), .engine = "growth", .config = "engine = \"growth\"\n"};
  const fs::path path = scratch_file();
  Outcome outcome = measured([&] {
    std::ofstream out(path, std::ios::binary);
    if (work == kGlb) write_gltf(mesh, provenance, GltfForm::binary, out);
    if (work == kObj) write_obj(mesh, provenance, "tree.mtl", out);
    if (work == kPly) write_ply(mesh, provenance, out);
    out.close();
  });
  outcome.count = static_cast<double>(fs::file_size(path));
  fs::remove(path);
  return outcome;
}

/// The quickest of some runs in this process, after one that is not counted.
Outcome repeated(const std::function<void()>& work) {
  work();
  Outcome best = measured(work);
  for (int i = 1; i < kRepetitions; ++i) {
    const Outcome outcome = measured(work);
    if (outcome.seconds < best.seconds) best = outcome;
  }
  return best;
}

/// As many bytes as the mesh has, in the same kind of memory: no mesher can be quicker.
Outcome write_floor(const Mesh& mesh, bool is_again) {
  BulkVector<std::uint32_t> bytes;
  const std::size_t words = bytes_of(mesh) / sizeof(std::uint32_t);
  const auto fill = [&] {
    bytes.resize(words);
    std::memset(static_cast<void*>(bytes.data()), 1, words * sizeof(std::uint32_t));
    benchmark::DoNotOptimize(bytes.data());
    benchmark::ClobberMemory();
  };
  Outcome outcome = is_again ? repeated(fill) : measured(fill);
  outcome.count = static_cast<double>(mesh.triangles.size());
  return outcome;
}

/// Grows the tree, then measures the trial's work on it. `count` is triangles, of files bytes.
Outcome perform(const Trial& trial) {
  const Skeleton skeleton = growth::Engine::run(trial_parameters(trial.assignments), {}).skeleton;
  const ThreadLimit limit(trial.threads);
  const MesherOptions options = options_of(trial.work);
  Mesh mesh;
  Outcome outcome;
  if (trial.work == kSmoothAgain) {
    outcome = repeated([&] { mesh = build_mesh(skeleton, options, std::move(mesh)); });
  } else if (trial.work == kDressed) {
    outcome = measured([&] { mesh = make_tree_mesh(skeleton, looks_of(trial.work), 1).mesh; });
  } else {
    outcome = measured([&] { mesh = build_mesh(skeleton, options); });
  }
  outcome.count = static_cast<double>(mesh.triangles.size());
  outcome.skeleton = fingerprint(mesh);
  if (trial.work == kFloor || trial.work == kFloorAgain) return write_floor(mesh, trial.work == kFloorAgain);
  if (trial.work == kGlb || trial.work == kObj || trial.work == kPly) return write(mesh, trial.work);
  return outcome;
}

void register_trials(Results& results, bool is_quick) {
  const auto add = [&](const std::string& name, const char* work, int threads) {
    Trial trial{.work = work, .threads = threads};
    if (is_quick) trial.assignments.push_back(fmt::format("steps={}", kQuickSteps));
    register_work(results, name, kRepetitions, [trial] { return run_alone(trial); });
  };
  for (const char* work :
       {kFloor, kFloorAgain, kSmooth, kSmoothAgain, kCurved, kCones, kLevel, kDressed, kGlb, kObj, kPly}) {
    add(work, work, 1);
  }
  add(threads_name(kSmooth), kSmooth, 2);
  add(threads_name(kSmoothAgain), kSmoothAgain, 2);
  add(threads_name(kDressed), kDressed, 2);
  add(threads_name(kGlb), kGlb, 2);
  add(threads_name(kObj), kObj, 2);
}

/// Millions or thousands of millions a second of what was counted.
std::optional<double> rate(const Results& results, const std::string& name, double unit) {
  const std::optional<Outcome> outcome = results.find(name);
  return outcome ? std::optional(outcome->count / outcome->seconds / unit) : std::nullopt;
}

/// The rows of performance.md that are about meshes.
void print_goals(const Results& results) {
  constexpr double million = 1e6;
  constexpr double giga = 1e9;
  const std::optional<Outcome> one = results.find(kSmooth);
  const std::optional<Outcome> two = results.find(threads_name(kSmooth));
  GoalTable table;
  table.add("smooth, sides 3 to 12, one thread, the memory used again", rate(results, kSmoothAgain, million),
            " M triangles/s", Goal{100.0, 250.0, false});
  table.add("  writing as many bytes, the memory used again", rate(results, kFloorAgain, million),
            " M triangles/s");
  table.add("  two threads against one", results.ratio(kSmoothAgain, threads_name(kSmoothAgain)), "x",
            Goal{1.5, 1.8, false});
  table.add("the same into fresh memory", rate(results, kSmooth, million), " M triangles/s");
  if (one) table.add("  its triangles", one->count / million, " M");
  table.add("  writing as many bytes to fresh memory", rate(results, kFloor, million), " M triangles/s");
  table.add("  two threads against one", results.ratio(kSmooth, threads_name(kSmooth)), "x");
  table.add_claim("  and they make the same mesh, to the last bit",
                  one && two ? std::optional(one->skeleton == two->skeleton) : std::nullopt);
  if (one)
    table.add("  memory beside tree and program", (one->peak_bytes - one->bytes_at_start) / million, " MB");
  table.add("smooth along Catmull-Rom curves", rate(results, kCurved, million), " M triangles/s");
  table.add("cones", rate(results, kCones, million), " M triangles/s");
  table.add("level 1, its tolerance looked for, a triangle of level 0", results.ratio(kLevel, kSmooth), "x");
  table.add("with bark, tangents and leaves, one thread", rate(results, kDressed, million), " M triangles/s");
  if (const auto dressed = results.find(kDressed))
    table.add("  its triangles", dressed->count / million, " M");
  table.add("  two threads against one", results.ratio(kDressed, threads_name(kDressed)), "x");
  table.add("GLB written, one thread", rate(results, kGlb, giga), " GB/s", Goal{1.5, 3.0, false});
  table.add("  two threads", rate(results, threads_name(kGlb), giga), " GB/s");
  table.add("OBJ written, one thread", rate(results, kObj, giga), " GB/s", Goal{0.5, 1.0, false});
  table.add("  two threads", rate(results, threads_name(kObj), giga), " GB/s");
  table.add("PLY written, one thread", rate(results, kPly, giga), " GB/s");
  table.print();
}

int run(int argc, char** argv) {
  const bool is_quick = take_flag(argc, argv, "--quick");
  if (take_flag(argc, argv, "--help")) {
    fmt::print("{}", kUsage);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Results results;
  register_trials(results, is_quick);
  run_registered_work();
  benchmark::Shutdown();
  print_goals(results);
  return results.has_failed() ? 1 : 0;
}

}  // namespace
}  // namespace ramify::bench

int main(int argc, char** argv) {
  return ramify::bench::run_program(argc, argv, ramify::bench::run, ramify::bench::perform);
}
